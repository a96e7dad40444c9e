#include "io/AudioWriter.h"

#include "io/AudioReader.h"
#include "io/CueChunks.h"
#include "io/FileExtension.h"
#include "io/SoundHandle.h"

#include <pacini/foundation/Random.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
// libsndfile writes through these. AtomicFile remembers the first failure, which sf_close would lose.
sf_count_t fileLength(void* user)
{
    return static_cast<AtomicFile*>(user)->size();
}

sf_count_t fileSeek(sf_count_t offset, int origin, void* user)
{
    auto* file = static_cast<AtomicFile*>(user);
    return file->seek(offset, origin) ? file->tell() : -1;
}

sf_count_t fileRead(void*, sf_count_t, void*)
{
    return 0;
}

sf_count_t fileWrite(const void* bytes, sf_count_t count, void* user)
{
    const auto size = static_cast<std::size_t>(std::max<sf_count_t>(count, 0));
    return static_cast<AtomicFile*>(user)->write({static_cast<const std::byte*>(bytes), size}) ? count : 0;
}

sf_count_t fileTell(void* user)
{
    return static_cast<AtomicFile*>(user)->tell();
}

// The container of a WAV counts in 32 bits; what stands before the samples is far below 4 kB.
constexpr std::uint64_t largestWav = 0xFFFFFFFFull - 4096;

int bits(SampleEncoding encoding)
{
    return encoding == SampleEncoding::float32 ? 32 : encoding == SampleEncoding::pcm24 ? 24 : 16;
}

int subformat(SampleEncoding encoding)
{
    return encoding == SampleEncoding::float32 ? SF_FORMAT_FLOAT
           : encoding == SampleEncoding::pcm24 ? SF_FORMAT_PCM_24
                                               : SF_FORMAT_PCM_16;
}

Error badArgument(std::string message)
{
    return {ErrorCode::invalidArgument, "", std::move(message)};
}

/// The libsndfile format for `path`, or what is wrong with the parameters.
Result<int> formatOf(const fs::path& path, const AudioWriteParams& params)
{
    const std::string extension = lowerExtension(path);
    const bool flac = extension == ".flac";
    if (!flac && extension != ".wav" && !isStream(path)) // WAV is what a stream gets
        return badArgument("must have the extension .wav or .flac");
    const int maxChannels = flac ? 8 : limits::channels;
    if (params.channels < 1 || params.channels > maxChannels)
        return badArgument(fmt::format("{} channels are not supported; write 1 to {}", params.channels, maxChannels));
    if (params.sampleRate < limits::lowestWrittenRate || params.sampleRate > limits::highestSampleRate)
        return badArgument(fmt::format("a sample rate of {} Hz is not supported; choose {} to {} Hz", params.sampleRate,
                                       limits::lowestWrittenRate, limits::highestSampleRate));
    if (flac && params.encoding == SampleEncoding::float32)
        return badArgument("FLAC does not support float samples; choose 16 or 24 bit, or write a .wav");
    constexpr int anyFlacRate = 65535, highestFlacRate = 655350; // Hz, as its frames can state them
    if (flac && params.sampleRate > anyFlacRate && (params.sampleRate % 10 != 0 || params.sampleRate > highestFlacRate))
        return badArgument(
            fmt::format("FLAC does not support a sample rate of {} Hz; choose (--rate) {} to {} Hz, or a "
                        "multiple of 10 Hz up to {} Hz, or write a .wav",
                        params.sampleRate, limits::lowestWrittenRate, anyFlacRate, highestFlacRate));
    const auto frameBytes = static_cast<std::uint64_t>(params.channels * bits(params.encoding) / 8);
    const bool large = params.expectedFrames > largestWav / frameBytes;
    return (flac ? SF_FORMAT_FLAC : large ? SF_FORMAT_RF64 : SF_FORMAT_WAV) | subformat(params.encoding);
}
} // namespace

struct AudioWriter::State
{
    State(AtomicFile opened, const AudioWriteParams& audioParams, int soundFormat)
        : file(std::move(opened)), params(audioParams), format(soundFormat), random(audioParams.ditherSeed.value_or(0))
    {
    }

    AtomicFile file; // outlives sound, which writes through it
    AudioWriteParams params;
    int format;
    Random random;
    SoundHandle sound;
    AudioWriteReport report;
    std::optional<Error> broken; ///< why writing was given up

    /// What the disk says, else what libsndfile says.
    Error failed(const std::string& message) const
    {
        return file.failure().value_or(Error{ErrorCode::io, "", "libsndfile cannot write this: " + message});
    }

    /// `x` as an integer of 32 bits whose upper bits hold the sample: libsndfile takes PCM of any width so.
    int quantised(float x) noexcept
    {
        const int width = bits(params.encoding);
        const double fullScale = std::ldexp(1.0, width - 1);
        if (std::abs(x) > 1.0f)
            ++report.clippedSamples;
        double scaled = static_cast<double>(x) * fullScale;
        if (params.ditherSeed)
            scaled += random.uniform() - random.uniform();
        const double held = std::clamp(std::nearbyint(scaled), -fullScale, fullScale - 1.0);
        return static_cast<int>(held) * (1 << (32 - width));
    }

    /// Writes a part of whole frames; false when the disk refuses.
    bool writePart(std::span<const float> part) noexcept
    {
        const auto count = static_cast<sf_count_t>(part.size());
        if (params.encoding == SampleEncoding::float32)
            return sf_write_float(sound.get(), part.data(), count) == count;
        std::array<int, partSamples> integers;
        std::transform(part.begin(), part.end(), integers.begin(), [this](float x) { return quantised(x); });
        return sf_write_int(sound.get(), integers.data(), count) == count;
    }

    Result<void> append(std::span<const float> interleaved)
    {
        const auto channels = static_cast<std::size_t>(params.channels);
        assert(interleaved.size() % channels == 0);
        const auto bad =
            std::find_if_not(interleaved.begin(), interleaved.end(), [](float x) { return std::isfinite(x); });
        if (bad != interleaved.end())
        {
            const auto index = static_cast<std::size_t>(bad - interleaved.begin());
            return Error{ErrorCode::notFinite,
                         fmt::format("frame {}, channel {}", report.frames + index / channels, index % channels),
                         "is not a finite number (counted from 0); only numbers can be written"};
        }
        const auto frames = interleaved.size() / channels;
        const auto frameBytes = channels * static_cast<std::size_t>(bits(params.encoding)) / 8;
        if ((format & SF_FORMAT_TYPEMASK) == SF_FORMAT_WAV && report.frames + frames > largestWav / frameBytes)
            return Error{ErrorCode::tooLarge, "",
                         "a WAV file ends at 4 GB; announce the length first to get an RF64, or use FLAC"};
        const auto partFrames = partSamples / channels;
        for (std::size_t done = 0; done < frames; done += partFrames)
        {
            const auto count = std::min(partFrames, frames - done);
            if (!writePart(interleaved.subspan(done * channels, count * channels)))
                return failed(soundError(sound.get()));
        }
        report.frames += frames;
        return {};
    }

    /// Adds the markers to a file that is finished otherwise: behind the samples, since libsndfile has room for some
    /// hundred of them before.
    Result<void> addCues()
    {
        const int type = format & SF_FORMAT_TYPEMASK;
        std::erase_if(
            params.markers, [&](const Marker& marker)
            { return std::llround(marker.time * params.sampleRate) > static_cast<std::int64_t>(report.frames); });
        const std::string chunks = cueChunks(params.markers, params.sampleRate);
        if (chunks.empty() || (type != SF_FORMAT_WAV && type != SF_FORMAT_RF64))
            return {};
        const auto size = static_cast<std::uint64_t>(std::max<std::int64_t>(file.size(), 0));
        const std::string added = std::string(size % 2, '\0') + chunks;
        const std::uint64_t stated = size + added.size() - 8;
        std::array<char, 4> id{}; // an endless one may have become a WAV
        const bool large = file.seek(0, SEEK_SET) && file.read(std::as_writable_bytes(std::span(id))) == id.size() &&
                           id[1] == 'F'; // RF64, whose size is the first of its chunk ds64
        if (!large && stated > std::numeric_limits<std::uint32_t>::max())
            return Error{ErrorCode::tooLarge, "", "a WAV file ends at 4 GB, and its markers have no room there"};
        std::array<std::byte, 8> number{};
        for (std::size_t i = 0; i < number.size(); ++i)
            number[i] = static_cast<std::byte>(stated >> (8 * i) & 0xFFu);
        const bool done = file.seek(0, SEEK_END) && file.write(std::as_bytes(std::span(added))) &&
                          file.seek(large ? 20 : 4, SEEK_SET) && file.write(std::span(number).first(large ? 8 : 4));
        return done ? Result<void>() : failed("its markers");
    }

    /// Completes the origin of a file that is finished otherwise.
    void seal()
    {
        if (!params.origin || !file.seek(0, SEEK_SET))
            return;
        const auto found = sealOf([this](std::span<std::byte> bytes) { return file.read(bytes); });
        if (found && file.seek(found->offset, SEEK_SET))
            file.write(std::as_bytes(std::span(found->digits)));
    }

    static constexpr std::size_t partSamples = 4096;
};

AudioWriter::AudioWriter(std::unique_ptr<State> opened) noexcept : state(std::move(opened)) {}
AudioWriter::AudioWriter(AudioWriter&&) noexcept = default;
AudioWriter::~AudioWriter() = default;

Result<AudioWriter> AudioWriter::create(const fs::path& path, const AudioWriteParams& params)
{
    const auto format = formatOf(path, params);
    if (!format)
        return format.error();
    auto file = AtomicFile::create(path, params.existing);
    if (!file)
        return file.error();

    auto state = std::make_unique<State>(std::move(*file), params, *format);
    SF_INFO info{};
    info.samplerate = params.sampleRate;
    info.channels = params.channels;
    info.format = *format;
    SF_VIRTUAL_IO io{fileLength, fileSeek, fileRead, fileWrite, fileTell};
    state->sound.reset(sf_open_virtual(&io, SFM_WRITE, &info, &state->file));
    if (!state->sound)
        return state->failed(soundError(nullptr));
    // The peak chunk of float files holds the time of day: without it the same samples give the same bytes.
    sf_command(state->sound.get(), SFC_SET_ADD_PEAK_CHUNK, nullptr, SF_FALSE);
    if (params.expectedFrames == AudioWriteParams::endless)
        sf_command(state->sound.get(), SFC_RF64_AUTO_DOWNGRADE, nullptr, SF_TRUE);
    if (params.origin)
        sf_set_string(state->sound.get(), SF_STR_COMMENT, originText(*params.origin).c_str());
    return AudioWriter(std::move(state));
}

Result<void> AudioWriter::write(std::span<const float> interleaved)
{
    if (!state->broken)
        if (auto appended = state->append(interleaved); !appended)
            state->broken = appended.error();
    if (state->broken)
        return *state->broken;
    return {};
}

Result<AudioWriteReport> AudioWriter::finish()
{
    if (state->broken)
        return *state->broken;
    // Without samples libsndfile would not even start a FLAC.
    if (state->report.frames == 0)
        sf_command(state->sound.get(), SFC_UPDATE_HEADER_NOW, nullptr, 0);
    state->sound.reset();
    if (auto added = state->addCues(); !added)
        return added.error();
    state->seal();
    const auto size = state->file.size();
    if (auto done = state->file.commit(); !done)
        return done.error();
    state->report.bytes = static_cast<std::uint64_t>(std::max<std::int64_t>(size, 0));
    return state->report;
}

Result<AudioWriteReport> writeAudio(const fs::path& path, std::span<const float> interleaved,
                                    const AudioWriteParams& params)
{
    auto known = params;
    known.expectedFrames = interleaved.size() / static_cast<std::size_t>(std::max(params.channels, 1));
    auto writer = AudioWriter::create(path, known);
    if (!writer)
        return writer.error();
    if (auto written = writer->write(interleaved); !written)
        return written.error();
    return writer->finish();
}

} // namespace pacini
