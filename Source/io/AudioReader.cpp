#include "io/AudioReader.h"

#include "io/AudioHeader.h"
#include "io/InputFile.h"
#include "io/SoundHandle.h"

#include <pacini/foundation/DspBlock.h>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
// libsndfile reads through these: it never sees the file's name, so content alone decides the format, and a failing
// disk can be told from a damaged file.
sf_count_t streamLength(void* user)
{
    auto* file = static_cast<std::FILE*>(user);
    const auto here = tellStream(file);
    if (!seekStream(file, 0, SEEK_END))
        return -1;
    const auto length = tellStream(file);
    seekStream(file, here, SEEK_SET);
    return length;
}

sf_count_t streamSeek(sf_count_t offset, int origin, void* user)
{
    auto* file = static_cast<std::FILE*>(user);
    return seekStream(file, offset, origin) ? tellStream(file) : -1;
}

sf_count_t streamRead(void* bytes, sf_count_t count, void* user)
{
    if (count <= 0)
        return 0;
    return static_cast<sf_count_t>(
        std::fread(bytes, 1, static_cast<std::size_t>(count), static_cast<std::FILE*>(user)));
}

sf_count_t streamTell(void* user)
{
    return tellStream(static_cast<std::FILE*>(user));
}

Error invalid(std::string message)
{
    return {ErrorCode::invalidData, "", std::move(message)};
}

Error truncated(std::uint64_t present, std::uint64_t promised, std::string_view unit = "frames")
{
    return {ErrorCode::truncated, "",
            fmt::format("is truncated: it has {} {} of {}; get a complete copy", present, unit, promised)};
}

/// Bytes of one sample, 0 for codecs that pack samples together.
std::uint64_t sampleBytes(int format)
{
    switch (format & SF_FORMAT_SUBMASK)
    {
    case SF_FORMAT_PCM_S8:
    case SF_FORMAT_PCM_U8:
    case SF_FORMAT_ULAW:
    case SF_FORMAT_ALAW:
        return 1;
    case SF_FORMAT_PCM_16:
        return 2;
    case SF_FORMAT_PCM_24:
        return 3;
    case SF_FORMAT_PCM_32:
    case SF_FORMAT_FLOAT:
        return 4;
    case SF_FORMAT_DOUBLE:
        return 8;
    default:
        return 0;
    }
}

/// The Error for a header that promises more than the file has, or nothing.
std::optional<Error> brokenPromise(const AudioDataSize& data, const SF_INFO& info)
{
    if (data.present >= data.promised)
        return {};
    const auto width = sampleBytes(info.format);
    if (width == 0)
        return truncated(data.present, data.promised, "bytes of audio");
    const auto frameBytes = width * static_cast<std::uint64_t>(info.channels);
    if (data.present / frameBytes == data.promised / frameBytes)
        return {};
    // libsndfile delivers a frame or two less than fit in some formats.
    const auto delivers = static_cast<std::uint64_t>(std::max<sf_count_t>(info.frames, 0));
    return truncated(std::min(data.present / frameBytes, delivers), data.promised / frameBytes);
}

/// Why libsndfile could not open a file that exists.
Error openingFailed(const std::optional<AudioDataSize>& data)
{
    if (sf_error(nullptr) == SF_ERR_UNRECOGNISED_FORMAT)
        return invalid("is not audio in a supported format; convert it to WAV, AIFF, FLAC, Ogg or CAF");
    if (data && data->present < data->promised)
        return truncated(data->present, data->promised, "bytes of audio");
    auto reason = soundError(nullptr);
    // What it says of rates and channels that cannot be.
    if (reason.starts_with("internal error"))
        reason = "its header is damaged";
    // What its MP3 part says of every file that is too short to start.
    if (reason.starts_with("file does not exist"))
        reason = "its audio is incomplete";
    return invalid(fmt::format("cannot be read as audio ({}); get a complete copy or convert it to WAV", reason));
}
} // namespace

struct AudioReader::State
{
    FileHandle file; // outlives sound, which reads through it
    SoundHandle sound;
    SF_INFO info{};
    AudioReadOptions options;
    std::optional<std::uint64_t> promisedFrames;
    std::uint64_t slackFrames = 0; ///< frames that a promise may be off
    std::uint64_t delivered = 0;
    std::uint64_t replaced = 0;

    /// Replaces or reports samples that are no numbers. `samples` starts at frame `delivered`.
    Result<void> checkFinite(std::span<float> samples)
    {
        if (areWithinLimit(samples))
            return {};
        for (std::size_t i = 0; i < samples.size(); ++i)
        {
            if (std::abs(samples[i]) <= limits::sample)
                continue;
            const auto channels = static_cast<std::size_t>(info.channels);
            if (!options.allowNan)
                return Error{
                    ErrorCode::notFinite, fmt::format("frame {}, channel {}", delivered + i / channels, i % channels),
                    std::isfinite(samples[i])
                        ? fmt::format("is {:g}, far beyond full scale (counted from 0); repair the file", samples[i])
                        : fmt::format("is {}, not a number (counted from 0); repair the file",
                                      std::isnan(samples[i]) ? "NaN" : "infinite")};
            samples[i] = 0.0f;
            ++replaced;
        }
        return {};
    }

    /// Why fewer frames came than were asked for; ok at a regular end.
    Result<void> explainEnd() const
    {
        if (std::ferror(file.get()) != 0)
            return fileError(EIO);
        if (options.allowTruncated)
            return {};
        const auto type = info.format & SF_FORMAT_TYPEMASK;
        if (info.frames == SF_COUNT_MAX && type == SF_FORMAT_OGG)
            return Error{
                ErrorCode::truncated, "",
                fmt::format("is truncated: it has {} frames, but no end marker; get a complete copy", delivered)};
        if (promisedFrames && delivered + slackFrames < *promisedFrames)
            return truncated(delivered, *promisedFrames);
        if (sf_error(sound.get()) != SF_ERR_NO_ERROR)
            return Error{
                ErrorCode::truncated, "",
                fmt::format("is damaged after frame {} ({}); get a complete copy", delivered, soundError(sound.get()))};
        return {};
    }
};

AudioReader::AudioReader(std::unique_ptr<State> opened) noexcept : state(std::move(opened)) {}
AudioReader::AudioReader(AudioReader&&) noexcept = default;
AudioReader& AudioReader::operator=(AudioReader&&) noexcept = default;
AudioReader::~AudioReader() = default;

Result<AudioReader> AudioReader::open(const fs::path& path, AudioReadOptions options)
{
    auto file = openRewindable(path);
    if (!file)
        return file.error();
    if (streamLength(file->get()) == 0)
        return invalid("is empty; choose a file with audio");

    auto state = std::make_unique<State>();
    state->file = std::move(*file);
    state->options = options;
    const auto data = audioDataSize(state->file.get());
    const bool countsItsFrames = hasMp3FrameCount(state->file.get());
    seekStream(state->file.get(), 0, SEEK_SET);

    SF_VIRTUAL_IO io{streamLength, streamSeek, streamRead, nullptr, streamTell};
    SF_INFO& info = state->info;
    {
        const SoundLibraryCall inside;
        state->sound.reset(sf_open_virtual(&io, SFM_READ, &info, state->file.get()));
    }
    if (!state->sound)
        return openingFailed(data);
    if (info.channels < 1 || info.samplerate < 1)
        return invalid(fmt::format("has a damaged header without {}; get a complete copy",
                                   info.channels < 1 ? "channels" : "sample rate"));
    if (info.channels > limits::channels)
        return invalid(fmt::format("has {} channels, but only 1 to {} are supported; mix it down", info.channels,
                                   limits::channels));
    if (info.samplerate < options.lowestSampleRate || info.samplerate > limits::highestSampleRate)
        return invalid(fmt::format("has a sample rate of {} Hz, but only {} to {} Hz are supported; resample it",
                                   info.samplerate, options.lowestSampleRate, limits::highestSampleRate));
    if (data && !options.allowTruncated)
        if (auto broken = brokenPromise(*data, info))
            return *broken;
    const bool mp3 = (info.format & SF_FORMAT_TYPEMASK) == SF_FORMAT_MPEG;
    if (info.frames < SF_COUNT_MAX && (!mp3 || countsItsFrames))
        state->promisedFrames = static_cast<std::uint64_t>(std::max<sf_count_t>(info.frames, 0));
    // Encoders disagree on whether the padding of the first and last of the 1152-frame blocks counts.
    state->slackFrames = mp3 ? 2 * 1152 : 0;
    return AudioReader(std::move(state));
}

int AudioReader::sampleRate() const noexcept
{
    return state->info.samplerate;
}

int AudioReader::channels() const noexcept
{
    return state->info.channels;
}

std::optional<std::uint64_t> AudioReader::frames() const noexcept
{
    if (state->info.frames < 0 || state->info.frames == SF_COUNT_MAX)
        return {};
    return static_cast<std::uint64_t>(state->info.frames);
}

Result<std::size_t> AudioReader::read(std::span<float> interleaved)
{
    const auto channels = static_cast<std::size_t>(state->info.channels);
    assert(interleaved.size() % channels == 0);
    const auto wanted = interleaved.size() / channels;
    sf_count_t count = 0;
    {
        const SoundLibraryCall inside;
        count = sf_readf_float(state->sound.get(), interleaved.data(), static_cast<sf_count_t>(wanted));
    }
    const auto got = static_cast<std::size_t>(std::max<sf_count_t>(count, 0));
    if (!state->options.keepNan)
        if (auto finite = state->checkFinite(interleaved.first(got * channels)); !finite)
            return finite.error();
    state->delivered += got;
    if (got < wanted)
        if (auto end = state->explainEnd(); !end)
            return end.error();
    return got;
}

std::uint64_t AudioReader::replacedSamples() const noexcept
{
    return state->replaced;
}

Error tooManyFrames(std::uint64_t maximumFrames)
{
    return {ErrorCode::tooLarge, "", fmt::format("is longer than {} frames; cut it into parts", maximumFrames)};
}

Result<AudioData> readAudio(const fs::path& path, AudioReadOptions options, std::uint64_t maximumFrames)
{
    auto opened = AudioReader::open(path, options);
    if (!opened)
        return opened.error();
    AudioReader& reader = *opened;
    AudioData audio{reader.sampleRate(), reader.channels(), {}, 0};
    const auto channels = static_cast<std::size_t>(audio.channels);
    // Memory follows the frames that really come; the header's count is not believed.
    bool fits = true;
    const auto done = reader.forEachBlock(65536 / channels,
                                          [&](std::span<const float> block)
                                          {
                                              fits = (audio.samples.size() + block.size()) / channels <= maximumFrames;
                                              if (fits)
                                                  audio.samples.insert(audio.samples.end(), block.begin(), block.end());
                                              return fits;
                                          });
    if (!done)
        return done.error();
    if (!fits)
        return tooManyFrames(maximumFrames);
    audio.replacedSamples = reader.replacedSamples();
    return audio;
}

} // namespace pacini
