#include "cli/live/LiveInput.h"

#include "cli/Console.h"
#include "cli/Counted.h"
#include "io/AudioReader.h"
#include "io/FileHandle.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#else
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace pacini::cli
{

namespace
{
namespace fs = std::filesystem;

/// Bytes of a pipe.
class Pipe
{
public:
    Pipe(int openDescriptor, bool toClose, const std::atomic<bool>& stopping)
        : descriptor(openDescriptor), owned(toClose), stop(stopping)
    {
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe()
    {
        if (owned)
#if defined(_WIN32)
            _close(descriptor);
#else
            ::close(descriptor);
#endif
    }

    /// Whether what is read was there before.
    [[nodiscard]] bool isFile() const
    {
#if defined(_WIN32)
        return false;
#else
        struct stat status = {};
        return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
#endif
    }

    [[nodiscard]] bool isStopped() const
    {
        return stop.load();
    }

    /// Waits for bytes; how many there were, 0 at the end or when it is stopped.
    [[nodiscard]] Result<std::size_t> read(std::span<std::byte> bytes)
    {
#if defined(_WIN32)
        const int got = _read(descriptor, bytes.data(), static_cast<unsigned>(bytes.size()));
        if (got < 0)
            return fileError(errno);
        return static_cast<std::size_t>(got);
#else
        constexpr int glance = 50; // ms
        while (!stop.load())
        {
            pollfd wanted{.fd = descriptor, .events = POLLIN, .revents = 0};
            if (const int ready = ::poll(&wanted, 1, glance); ready == 0 || (ready < 0 && errno == EINTR))
                continue;
            const auto got = ::read(descriptor, bytes.data(), bytes.size());
            if (got < 0 && (errno == EINTR || errno == EAGAIN))
                continue;
            if (got < 0)
                return fileError(errno);
            return static_cast<std::size_t>(got);
        }
        return std::size_t{0};
#endif
    }

private:
    int descriptor;
    bool owned;
    const std::atomic<bool>& stop;
};

std::uint32_t littleEndian(std::span<const std::byte> bytes)
{
    std::uint32_t value = 0;
    for (std::size_t i = bytes.size(); i > 0; --i)
        value = value << 8 | std::to_integer<std::uint32_t>(bytes[i - 1]);
    return value;
}

std::size_t bytesOf(RawSamples samples)
{
    return samples == RawSamples::s16 ? 2 : samples == RawSamples::s24 ? 3 : 4;
}

float sampleOf(RawSamples samples, std::span<const std::byte> bytes)
{
    const std::uint32_t value = littleEndian(bytes);
    if (samples == RawSamples::f32)
        return std::bit_cast<float>(value);
    const auto shifted = std::bit_cast<std::int32_t>(value << (32 - 8 * static_cast<unsigned>(bytes.size())));
    return static_cast<float>(static_cast<double>(shifted) / 2147483648.0);
}

Error invalid(std::string where, std::string message)
{
    return {ErrorCode::invalidData, std::move(where), std::move(message)};
}

/// A pipe with samples.
class PipedInput final : public LiveInput
{
public:
    explicit PipedInput(std::unique_ptr<Pipe> opened) : pipe(std::move(opened)) {}

    [[nodiscard]] double sampleRate() const override { return format.sampleRate; }
    [[nodiscard]] std::size_t channels() const override { return format.channels; }
    [[nodiscard]] bool isLive() const override { return !pipe->isFile(); }

    /// Takes the format from the header of a WAV.
    [[nodiscard]] Result<void> readHeader()
    {
        std::vector<std::byte> head;
        if (const auto done = exactly(head, 12); !done)
            return done.error();
        if (!is(head, 0, "RIFF") && !is(head, 0, "RF64"))
            return invalid("", "is not a WAV; give the format of raw samples with --raw");
        if (!is(head, 8, "WAVE"))
            return invalid("", "is not a WAV; give the format of raw samples with --raw");
        bool known = false;
        for (;;)
        {
            std::vector<std::byte> chunk;
            if (const auto done = exactly(chunk, 8); !done)
                return done.error();
            const std::uint32_t size = littleEndian(std::span(chunk).last(4));
            if (is(chunk, 0, "data"))
            {
                if (!known)
                    return invalid("fmt", "is missing before the samples");
                // Programs that cannot go back write 0, or the largest number that they think of.
                left = size == 0 || size >= 0x7F000000u ? unknown : size;
                stated = left;
                return {};
            }
            constexpr std::uint32_t longest = 1 << 24;
            if (size > longest)
                return invalid("", "has no samples within its first 16 MB");
            std::vector<std::byte> content;
            if (const auto done = exactly(content, size + size % 2); !done)
                return done.error();
            if (!is(chunk, 0, "fmt "))
                continue;
            if (const auto done = readFormat(content); !done)
                return done.error();
            known = true;
        }
    }

    void setFormat(const RawFormat& raw)
    {
        format = raw;
        left = stated = unknown;
    }

    [[nodiscard]] Result<std::size_t> read(std::span<float> interleaved) override
    {
        const std::size_t width = bytesOf(format.samples);
        const std::size_t frame = width * format.channels;
        const std::size_t room = interleaved.size() / format.channels * frame;
        bytes.resize(std::max(bytes.size(), room));
        while (held < frame)
        {
            const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(room - held, left));
            const auto got = pipe->read(std::span(bytes).subspan(held, wanted));
            if (!got)
                return got.error();
            if (*got == 0)
            {
                hasEnded = !pipe->isStopped();
                return std::size_t{0}; // a part of a frame at the end is none
            }
            held += *got;
            left -= left == unknown ? 0 : *got;
        }
        const std::size_t frames = held / frame;
        for (std::size_t i = 0; i < frames * format.channels; ++i)
        {
            const float sample = sampleOf(format.samples, std::span(bytes).subspan(i * width, width));
            const bool isUsable = std::abs(sample) <= limits::sample; // NaN is not
            interleaved[i] = isUsable ? sample : 0.0f;
            unusable += isUsable ? 0u : 1u;
        }
        std::copy(bytes.begin() + static_cast<std::ptrdiff_t>(frames * frame),
                  bytes.begin() + static_cast<std::ptrdiff_t>(held), bytes.begin());
        held -= frames * frame;
        return frames;
    }

    [[nodiscard]] std::vector<std::string> losses() const override
    {
        std::vector<std::string> texts;
        const auto frame = static_cast<double>(bytesOf(format.samples) * format.channels);
        const auto seconds = [&](std::uint64_t count)
        {
            return durationText(static_cast<double>(count) / (frame * format.sampleRate));
        };
        if (unusable > 0)
            texts.push_back(fmt::format("{} not a number, infinite or beyond {:g} and played as 0",
                                        counted(unusable, "sample was", "samples were"), limits::sample));
        if (hasEnded && stated != unknown && left > 0)
            texts.push_back(
                fmt::format("ends after {} of the {} that its header states", seconds(stated - left), seconds(stated)));
        if (hasEnded && held > 0)
            texts.push_back(fmt::format("ends within a frame, {} after the last whole one; check its format",
                                        counted(held, "byte", "bytes")));
        return texts;
    }

private:
    static constexpr std::uint64_t unknown = std::numeric_limits<std::uint64_t>::max();

    [[nodiscard]] static bool is(std::span<const std::byte> from, std::size_t at, std::string_view name)
    {
        return std::memcmp(from.data() + at, name.data(), name.size()) == 0;
    }

    [[nodiscard]] Result<void> exactly(std::vector<std::byte>& into, std::size_t count)
    {
        into.resize(count);
        for (std::size_t have = 0; have < count;)
        {
            const auto got = pipe->read(std::span(into).subspan(have));
            if (!got)
                return got.error();
            if (*got == 0)
                return invalid("", have == 0 && count == 12 ? "is empty" : "ends within the header of a WAV");
            have += *got;
        }
        return {};
    }

    [[nodiscard]] Result<void> readFormat(std::span<const std::byte> fmt)
    {
        if (fmt.size() < 16)
            return invalid("fmt", "is too short");
        std::uint32_t kind = littleEndian(fmt.first(2));
        if (kind == 0xFFFE && fmt.size() >= 26)
            kind = littleEndian(fmt.subspan(24, 2));
        const std::uint32_t bits = littleEndian(fmt.subspan(14, 2));
        format.channels = littleEndian(fmt.subspan(2, 2));
        format.sampleRate = littleEndian(fmt.subspan(4, 4));
        if (kind == 1 && bits == 16)
            format.samples = RawSamples::s16;
        else if (kind == 1 && bits == 24)
            format.samples = RawSamples::s24;
        else if (kind == 1 && bits == 32)
            format.samples = RawSamples::s32;
        else if (kind == 3 && bits == 32)
            format.samples = RawSamples::f32;
        else
            return invalid("fmt", fmt::format("has samples of kind {} with {} bits; send whole numbers of 16, 24 or 32 "
                                              "bits, or floats of 32",
                                              kind, bits));
        if (format.channels < 1 || format.channels > limits::channels)
            return invalid("fmt", fmt::format("has {} channels; 1 to {} are read", format.channels, limits::channels));
        if (format.sampleRate < limits::lowestSampleRate || format.sampleRate > limits::highestSampleRate)
            return invalid("fmt", fmt::format("has {} Hz; {} to {} are read", format.sampleRate,
                                              limits::lowestSampleRate, limits::highestSampleRate));
        return {};
    }

    std::unique_ptr<Pipe> pipe;
    RawFormat format;
    std::uint64_t left = 0;   ///< bytes, or unknown
    std::uint64_t stated = 0; ///< likewise, by the header
    std::size_t unusable = 0; ///< samples
    bool hasEnded = false;    ///< of its own accord
    std::vector<std::byte> bytes;
    std::size_t held = 0; ///< bytes that are not yet a frame
};

/// A sound file.
class FileInput final : public LiveInput
{
public:
    explicit FileInput(AudioReader opened) : reader(std::move(opened)) {}

    [[nodiscard]] double sampleRate() const override { return reader.sampleRate(); }
    [[nodiscard]] std::size_t channels() const override { return static_cast<std::size_t>(reader.channels()); }
    [[nodiscard]] bool isLive() const override { return false; }
    [[nodiscard]] Result<std::size_t> read(std::span<float> interleaved) override
    {
        return reader.read(interleaved.first(interleaved.size() / channels() * channels()));
    }

private:
    AudioReader reader;
};
} // namespace

Result<std::unique_ptr<LiveInput>> LiveInput::open(const std::string& path, const std::optional<RawFormat>& raw,
                                                   const std::atomic<bool>& stop)
{
    std::error_code ignored;
    const auto status = fs::status(path, ignored);
    if (path != "-" && !raw && !(fs::exists(status) && fs::is_other(status)))
    {
        auto reader = AudioReader::open(path);
        if (!reader)
            return reader.error();
        return std::unique_ptr<LiveInput>(std::make_unique<FileInput>(std::move(*reader)));
    }
#if defined(_WIN32)
    int descriptor = 0;
    if (path == "-")
        _setmode(descriptor, _O_BINARY);
    else
        descriptor = _wopen(fs::path(path).c_str(), _O_RDONLY | _O_BINARY);
#else
    const int descriptor = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
#endif
    if (descriptor < 0)
        return fileError(errno);
    auto piped = std::make_unique<PipedInput>(std::make_unique<Pipe>(descriptor, path != "-", stop));
    if (raw)
        piped->setFormat(*raw);
    else if (const auto done = piped->readHeader(); !done)
        return done.error();
    return std::unique_ptr<LiveInput>(std::move(piped));
}

} // namespace pacini::cli
