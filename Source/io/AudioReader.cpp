#include "io/AudioReader.h"

#include "io/AudioHeader.h"
#include "io/ByteWindow.h"
#include "io/FilmSound.h"
#include "io/InputFile.h"
#include "io/RateRaiser.h"
#include "io/SoundCodec.h"
#include "io/SoundHandle.h"
#include "io/SoundMarkers.h"
#include "io/SoundPartView.h"
#include "io/SoundParts.h"

#include <pacini/foundation/DspBlock.h>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
sf_count_t viewLength(void* user)
{
    return static_cast<sf_count_t>(static_cast<SoundPartView*>(user)->size());
}

sf_count_t viewSeek(sf_count_t offset, int origin, void* user)
{
    auto& view = *static_cast<SoundPartView*>(user);
    if (origin == SEEK_CUR)
        offset += static_cast<sf_count_t>(view.place);
    else if (origin == SEEK_END && view.hidesEnd)
        return -1;
    else if (origin == SEEK_END)
        offset += static_cast<sf_count_t>(view.size());
    return offset >= 0 && view.goTo(static_cast<std::uint64_t>(offset)) ? offset : -1;
}

sf_count_t viewRead(void* bytes, sf_count_t count, void* user)
{
    if (count <= 0)
        return 0;
    return static_cast<sf_count_t>(
        static_cast<SoundPartView*>(user)->read({static_cast<char*>(bytes), static_cast<std::size_t>(count)}));
}

sf_count_t viewTell(void* user)
{
    return static_cast<sf_count_t>(static_cast<SoundPartView*>(user)->place);
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
std::optional<Error> brokenPromise(const SoundPart& part, const SF_INFO& info)
{
    if (part.isWhole || !part.promisedBytes)
        return {};
    const auto width = sampleBytes(info.format);
    if (width == 0)
        return truncated(part.presentBytes, *part.promisedBytes, "bytes of audio");
    const auto frameBytes = width * static_cast<std::uint64_t>(info.channels);
    if (part.presentBytes / frameBytes == *part.promisedBytes / frameBytes)
        return {};
    // libsndfile delivers a frame or two less than fit in some formats.
    const auto delivers = static_cast<std::uint64_t>(std::max<sf_count_t>(info.frames, 0));
    return truncated(std::min(part.presentBytes / frameBytes, delivers), *part.promisedBytes / frameBytes);
}

/// By the map of channels that a WAV or CAF has.
SpecialChannels specialChannelsOf(SNDFILE* sound, int channels)
{
    std::vector<int> map(static_cast<std::size_t>(channels));
    if (channels < 3 ||
        sf_command(sound, SFC_GET_CHANNEL_MAP_INFO, map.data(), static_cast<int>(map.size() * sizeof(int))) == SF_FALSE)
        return {};
    const auto placeOf = [&map](int role)
    {
        const auto found = std::find(map.begin(), map.end(), role);
        return found != map.end() ? std::optional(static_cast<std::size_t>(found - map.begin())) : std::nullopt;
    };
    return {.lowFrequency = placeOf(SF_CHANNEL_MAP_LFE), .centre = placeOf(SF_CHANNEL_MAP_CENTER)};
}

/// Whether the file begins as an object of JSON does.
bool isJson(std::FILE* file)
{
    constexpr std::size_t most = 256;
    ByteWindow window(file);
    const auto head = window.at(window.has(0, "\xEF\xBB\xBF") ? 3 : 0, most);
    const auto first =
        std::find_if(head.begin(), head.end(),
                     [](unsigned char one) { return one != ' ' && one != '\t' && one != '\r' && one != '\n'; });
    return first != head.end() && *first == '{';
}

/// Why libsndfile could not open a file that exists.
Error openingFailed(std::FILE* file, const SoundPart& part)
{
    const bool isUnknown = sf_error(nullptr) == SF_ERR_UNRECOGNISED_FORMAT;
    if (isUnknown && isJson(file))
        return invalid("holds JSON, not sound; a clip is for 'pacini render' and 'pacini convert'");
    if (isUnknown)
        return invalid("is not audio in a supported format; convert it to WAV, AIFF, FLAC, Ogg or CAF");
    if (!part.isWhole && part.promisedBytes)
        return truncated(part.presentBytes, *part.promisedBytes, "bytes of audio");
    auto reason = soundError(nullptr);
    // What it says of rates and channels that cannot be.
    if (reason.starts_with("internal error"))
        reason = "its header is damaged";
    if (reason.starts_with("unspecified internal error"))
        reason = "its header is damaged, or states an unknown format of samples";
    if (reason.find("No 'data' chunk marker") != std::string::npos)
        reason = "no sound is where its header leads";
    // What its MP3 part says of every file that is too short to start.
    if (reason.starts_with("file does not exist"))
        reason = "its audio is incomplete";
    return invalid(fmt::format("cannot be read as audio ({}); get a complete copy or convert it to WAV", reason));
}
} // namespace

struct AudioReader::State
{
    FileHandle file; // outlives sound, which reads through it
    std::vector<SoundPart> parts;
    std::size_t current = 0;
    SoundPartView view; // likewise
    SoundHandle sound;
    SF_INFO info{};
    AudioReadOptions options;
    std::uint64_t delivered = 0;       ///< frames
    std::uint64_t deliveredBefore = 0; ///< those of earlier parts, and silence in front of this one
    std::uint64_t silence = 0;         ///< frames that are still to come before the current part
    std::uint64_t replaced = 0;
    bool ended = false;
    std::vector<std::string> warnings;
    FoundMarkers markers; // of the parts up to the current one
    SpecialChannels special;
    std::vector<float> gains; ///< of the channels; empty: all 1
    bool markersAreTold = false;
    std::optional<RateRaiser> raiser;
    std::optional<FilmSound> film; // instead of parts, view and sound

    /// Opens a sound that ffmpeg decodes. `parts` are those of a file of chunks, or empty.
    Result<void> openFilm(const fs::path& path, std::uint64_t begin = 0)
    {
        const SoundPart* const chunked = parts.empty() ? nullptr : &parts.front();
        const bool isCut = chunked && chunked->promisedBytes && !chunked->isWhole;
        if (isCut && !options.allowTruncated)
            return truncated(chunked->presentBytes, *chunked->promisedBytes, "bytes of audio");
        auto opened =
            FilmSound::open(path, file.get(), {options.allowTruncated, chunked && chunked->promisedBytes, begin});
        if (!opened)
            return opened.error();
        film.emplace(std::move(*opened));
        if (isCut)
            warn("is cut off: {} of {} bytes of its sound are there", chunked->presentBytes, *chunked->promisedBytes);
        else if (chunked && chunked->promisedBytes)
            warn("has a header that states {} bytes of sound, but {} are there; save it anew", *chunked->promisedBytes,
                 chunked->presentBytes);
        if (parts.size() > 1)
            warn("has another sound behind its first, which is left out ({} bytes); save it as a file of its own",
                 parts.back().end - parts[1].begin);
        info.samplerate = film->sampleRate();
        info.channels = film->channels();
        special = film->specialChannels();
        pacini::addMarkers(markers, film->takeMarkers(), 0.0);
        addWarnings(film->takeWarnings());
        return checkRange();
    }

    void addWarnings(std::vector<std::string> more)
    {
        warnings.insert(warnings.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    }

    /// Finds the channels whose gains are not 1, of what is open.
    void findGains()
    {
        gains.clear();
        if (options.withoutCentre && !special.centre)
            warn("names no centre channel, so nothing is left out");
        const auto setGain = [this](std::optional<std::size_t> channel, double gain)
        {
            if (!channel || gain == 1.0 || *channel >= static_cast<std::size_t>(info.channels))
                return;
            gains.resize(static_cast<std::size_t>(info.channels), 1.0f);
            gains[*channel] = static_cast<float>(gain);
        };
        setGain(special.lowFrequency, options.lowFrequencyGain);
        setGain(special.centre, options.withoutCentre ? 0.0 : 1.0);
    }

    void applyGains(std::span<float> interleaved) const noexcept
    {
        for (std::size_t frame = 0; !gains.empty() && frame < interleaved.size(); frame += gains.size())
            for (std::size_t c = 0; c < gains.size(); ++c)
                interleaved[frame + c] *= gains[c];
    }

    /// Whether channels and rate are supported.
    [[nodiscard]] Result<void> checkRange() const
    {
        if (info.channels > limits::channels)
            return invalid(fmt::format("has {} channels, but only 1 to {} are supported; mix it down", info.channels,
                                       limits::channels));
        if (info.samplerate < limits::slowestSound || info.samplerate > limits::highestSampleRate)
            return invalid(fmt::format("has a sample rate of {} Hz, but only {} to {} Hz are supported; resample it",
                                       info.samplerate, limits::slowestSound, limits::highestSampleRate));
        return {};
    }

    /// Fills `interleaved` at the rate of the file.
    Result<std::size_t> read(std::span<float> interleaved);

    /// Whether the first part has a codec that libsndfile does not know.
    [[nodiscard]] bool isForeign()
    {
        ByteWindow window(file.get());
        return startsSound(window, part().begin) &&
               soundCodecOf(window, part().begin, part().end) == SoundCodec::foreign;
    }

    [[nodiscard]] const SoundPart& part() const { return parts[current]; }
    [[nodiscard]] double seconds(std::uint64_t frames) const { return static_cast<double>(frames) / info.samplerate; }
    [[nodiscard]] bool isFormat(int type) const { return (info.format & SF_FORMAT_TYPEMASK) == type; }

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

    /// The time that so many bytes of the current part take, as near as can be told.
    [[nodiscard]] double secondsOf(std::uint64_t bytes) const
    {
        if (const auto width = sampleBytes(info.format); width > 0)
            return seconds(bytes / (width * static_cast<std::uint64_t>(info.channels)));
        const auto whole = view.size();
        return whole > 0 ? static_cast<double>(bytes) / static_cast<double>(whole) * seconds(partFrames().value_or(0))
                         : 0.0;
    }

    /// Frames of the current part as far as a header or the decoder tells.
    [[nodiscard]] std::optional<std::uint64_t> partFrames() const
    {
        if (info.frames >= 0 && info.frames < SF_COUNT_MAX)
            return static_cast<std::uint64_t>(info.frames);
        return part().countedFrames ? part().countedFrames : part().promisedFrames;
    }

    template <typename... Values>
    void warn(fmt::format_string<Values...> text, Values&&... values)
    {
        warnings.push_back(fmt::format(text, std::forward<Values>(values)...));
    }

    bool openView(bool hideEnd)
    {
        sound.reset();
        view = {file.get(), &part(), 0, hideEnd};
        view.goTo(0);
        SF_VIRTUAL_IO io{viewLength, viewSeek, viewRead, nullptr, viewTell};
        info = {};
        const SoundLibraryCall inside;
        sound.reset(sf_open_virtual(&io, SFM_READ, &info, &view));
        return sound != nullptr;
    }

    /// Adds the markers of the current part, which is open and not read yet.
    void findMarkers()
    {
        if (part().isContinued)
            return; // they are those of the file
        const auto before = current > 0 ? parts[current - 1].end : 0;
        const auto from = std::min(before, part().begin);
        auto next = current + 1;
        while (next < parts.size() && parts[next].isContinued)
            ++next;
        const auto until = next < parts.size() ? parts[next].begin : ByteWindow(file.get()).size();
        pacini::addMarkers(markers, soundMarkers(file.get(), part(), from, until, info.samplerate), seconds(delivered));
        view.goTo(view.place); // where libsndfile left it
    }

    /// Opens parts[current].
    Result<void> openPart()
    {
        // The decoder of MP3 guesses the number of frames from the size if it can, and libsndfile reads no more of
        // them.
        if (!part().countedFrames || part().promisedFrames || !openView(true))
            openView(false);
        if (!sound)
            return openingFailed(file.get(), part());
        if (info.channels < 1 || info.samplerate < 1)
            return invalid(fmt::format("has a damaged header, which names no {}; get a complete copy",
                                       info.channels < 1 ? "channels" : "sample rate"));
        if (auto range = checkRange(); !range)
            return range;
        const auto broken = brokenPromise(part(), info);
        if (broken && !options.allowTruncated)
            return *broken;
        if (broken)
            warn("is cut off: {:.3f} s of {:.3f} s are there", secondsOf(part().presentBytes),
                 secondsOf(*part().promisedBytes));
        else if (part().promisedBytes && part().isWhole)
            warnOfPromise(secondsOf(*part().promisedBytes), secondsOf(part().presentBytes));
        // Where libsndfile takes other bytes for the audio.
        const auto frameBytes = sampleBytes(info.format) * static_cast<std::uint64_t>(info.channels);
        const auto there = frameBytes > 0 ? part().presentBytes / frameBytes : 0;
        if (const auto frames = partFrames().value_or(there); !broken && frames + 1 < there)
            warn("is damaged: {:.3f} s of {:.3f} s can be read", seconds(frames), seconds(there));
        if (const auto stated = part().statedFrameBytes; stated > 0 && frameBytes > 0 && stated != frameBytes)
            warn("has a header that states frames of {} bytes, but its samples make frames of {}; read by these it "
                 "lasts {:.3f} s, by the others it would last {:.3f} s; save it anew",
                 stated, frameBytes, seconds(partFrames().value_or(there)), seconds(part().presentBytes / stated));
        if (!part().sampleWarning.empty())
            warnings.push_back(part().sampleWarning);
        if (!part().offsetWarning.empty())
            warnings.push_back(part().offsetWarning);
        // 529 frames of the decoder, and 576 of most encoders.
        constexpr int mpegPriming = 1105;
        if (current == 0 && part().countedFrames && !part().promisedFrames)
            warnings.push_back(primingWarning(mpegPriming, info.samplerate));
        if (part().hasOtherFormat)
            warn("has two descriptions of its samples that differ; it is read by the first, as {} channels at {} Hz, "
                 "and lasts {:.3f} s; save it anew",
                 info.channels, info.samplerate, seconds(partFrames().value_or(there)));
        const auto left = passOver(part().leadFrames);
        if (info.frames < SF_COUNT_MAX)
            info.frames -= std::min(info.frames, static_cast<sf_count_t>(part().leadFrames - left));
        return {};
    }

    /// Reads frames of the current part and drops them; how many of these are not there.
    std::uint64_t passOver(std::uint64_t frames)
    {
        constexpr std::uint64_t most = 4096;
        const SoundLibraryCall inside;
        std::vector<float> passed;
        while (frames > 0)
        {
            passed.resize(most * static_cast<std::size_t>(info.channels));
            const auto count =
                sf_readf_float(sound.get(), passed.data(), static_cast<sf_count_t>(std::min(frames, most)));
            if (count <= 0)
                break;
            frames -= static_cast<std::uint64_t>(count);
        }
        return frames;
    }

    void warnOfPromise(double promised, double present)
    {
        if (promised == present)
            return;
        // As many digits as it takes to tell them apart.
        const int digits = fmt::format("{:.3f}", promised) == fmt::format("{:.3f}", present) ? 6 : 3;
        warn("has a header that states {} s, but {} s are there and all of them are read; save it anew",
             fmt::format("{:.{}f}", promised, digits), fmt::format("{:.{}f}", present, digits));
    }

    /// Why fewer frames came than were asked for; ok at a regular end.
    Result<void> explainEnd()
    {
        if (std::ferror(file.get()) != 0)
            return fileError(EIO);
        const auto here = delivered - deliveredBefore;
        if (info.frames == SF_COUNT_MAX && isFormat(SF_FORMAT_OGG))
        {
            if (!options.allowTruncated)
                return Error{
                    ErrorCode::truncated, "",
                    fmt::format("is cut off: {} frames are there, but not the mark of its end; get a complete copy",
                                here)};
            warn("is cut off after {:.3f} s: the mark of its end is missing", seconds(here));
        }
        else if (part().isUnended && isFormat(SF_FORMAT_OGG))
            warn("lacks the mark of its end behind {:.3f} s; it may have been cut off", seconds(here));
        if (part().preSkip > 0 && part().preSkip >= part().packetFrames && part().packetFrames > 0)
            return invalid(fmt::format("has a header that leaves out {:.3f} s at its beginning, but only {:.3f} s are "
                                       "there; get a complete copy",
                                       static_cast<double>(part().preSkip) / 48000.0,
                                       static_cast<double>(part().packetFrames) / 48000.0));
        // RFC 7845 advises 80 ms.
        constexpr std::uint64_t mostPreSkip = 4800;
        if (part().preSkip > mostPreSkip)
            warn("has a header that leaves out {:.3f} s at its beginning",
                 static_cast<double>(part().preSkip) / 48000.0);
        if (auto loudness = opusGainWarning(part().opusGain))
            warnings.push_back(std::move(*loudness));
        if (part().shiftedFrames > 0)
            warn(
                "has times by which its first {:.3f} s lie before its start, more than an edit can; all of it is read; "
                "save it anew",
                seconds(part().shiftedFrames));
        if (part().streamsBeside == 1)
            warn("has another sound at the same time, which is left out; save it as a file of its own");
        else if (part().streamsBeside > 1)
            warn("has {} other sounds at the same time, which are left out; save each as a file of its own",
                 part().streamsBeside);
        if (isFormat(SF_FORMAT_MPEG))
            return explainMpegEnd(here);
        if (isFormat(SF_FORMAT_OGG))
            warnOfLostPages(here);
        if (isFormat(SF_FORMAT_FLAC) && sf_error(sound.get()) != SF_ERR_NO_ERROR &&
            here >= part().promisedFrames.value_or(here + 1))
            warn("has bytes behind its sound that are left out");
        std::optional<std::uint64_t> promised = part().promisedFrames;
        if (!promised && info.frames < SF_COUNT_MAX)
            promised = static_cast<std::uint64_t>(std::max<sf_count_t>(info.frames, 0));
        return promised ? checkPromise(here, *promised) : checkDecoder(here);
    }

    Result<void> explainMpegEnd(std::uint64_t here)
    {
        // Encoders disagree on whether the padding of the first and last block counts.
        constexpr std::uint64_t block = 1152; // frames
        constexpr std::uint64_t slack = 2 * block;
        const auto counted = part().countedFrames.value_or(here);
        if (const auto stated = part().promisedFrames.value_or(counted);
            counted + slack < stated || stated + slack < counted)
            return checkPromise(counted, stated);
        // With a header, the decoder leaves out what its encoder filled up the first and last block with.
        const bool cuts = part().promisedFrames && info.frames < SF_COUNT_MAX;
        const auto expected = cuts ? static_cast<std::uint64_t>(std::max<sf_count_t>(info.frames, 0)) : counted;
        if (here + slack < expected)
            return checkPromise(here, expected);
        // A decoder's delay and what fills up two blocks are less than this.
        if (here + 3 * block < counted)
            warn("has a header that leaves out {:.3f} s of {:.3f} s at its beginning and end", seconds(counted - here),
                 seconds(counted));
        return checkDecoder(here);
    }

    /// The Error or the warning of a header that promises another number of frames than `here`.
    Result<void> checkPromise(std::uint64_t here, std::uint64_t promised)
    {
        if (here < promised && !options.allowTruncated)
            return truncated(here, promised);
        if (here < promised)
            warn("is cut off: {:.3f} s of {:.3f} s are there", seconds(here), seconds(promised));
        else if (here > promised)
            warnOfPromise(seconds(promised), seconds(here));
        return {};
    }

    Result<void> checkDecoder(std::uint64_t here)
    {
        if (sf_error(sound.get()) == SF_ERR_NO_ERROR)
            return {};
        if (!options.allowTruncated)
            return Error{
                ErrorCode::truncated, "",
                fmt::format("is damaged after frame {} ({}); get a complete copy", here, soundError(sound.get()))};
        warn("is damaged after {:.3f} s ({})", seconds(here), soundError(sound.get()));
        return {};
    }

    /// The pages of an Ogg stream say when they end. The decoder leaves out damaged ones without a word.
    void warnOfLostPages(std::uint64_t here)
    {
        const bool opus = (info.format & SF_FORMAT_SUBMASK) == SF_FORMAT_OPUS;
        const double unit = opus ? 48000.0 : info.samplerate;
        if (part().framesLeftOut > 0)
            warn("has times that leave out {:.3f} s at its end", static_cast<double>(part().framesLeftOut) / unit);
        // Pages that were cut off before the first may count from any time; what is damaged may be the first.
        const auto first = part().skippedBytes > 0 ? 0 : part().firstTime;
        const double missing = static_cast<double>(part().lastTime - first) / unit - seconds(here);
        if (part().damagedPages > 0)
        {
            const double held =
                static_cast<double>(part().packetFrames) - static_cast<double>(part().preSkip + part().framesLeftOut);
            // Of pages that are not found at all only the times of those behind them tell.
            const double unfound =
                part().skippedBytes > 0 ? static_cast<double>(part().lastRightTime) / unit - seconds(here) : 0.0;
            warn("is damaged: {} of its pages have wrong checksums, about {:.3f} s are missing", part().damagedPages,
                 std::max({part().packetFrames > 0 ? held / unit - seconds(here) : missing, unfound, 0.0}));
        }
        else if (part().skippedBytes > 0)
            warn("is damaged: {} bytes are no sound, about {:.3f} s are missing", part().skippedBytes,
                 std::max(missing, 0.0));
        else if (part().lostPages > 0)
            warn("lacks {} of its pages, by their times about {:.3f} s", part().lostPages,
                 std::max(static_cast<double>(part().lastTime) / unit - seconds(here), 0.0));
        else if (missing > 0.0)
            warn("is damaged: about {:.3f} s are missing", missing);
    }

    /// Ends the current FLAC stream where another begins, if it was on that one that the decoder lost its way, and goes
    /// to the same place anew; whether it was.
    bool endBeforeNextFlac()
    {
        auto next = nextFlac(file.get(), part().begin + 4, part().end);
        if (!next)
            return false;
        parts[current].end = next->begin;
        if (parts[current].isNumbered)
            parts[current].promisedFrames = flacFrames(file.get(), part().begin, part().end);
        parts.insert(parts.begin() + static_cast<std::ptrdiff_t>(current) + 1, std::move(*next));
        if (!openView(false))
            return false;
        return passOver(delivered - deliveredBefore) == 0;
    }

    /// What of the current part and of what follows is not sound.
    void warnOfRest()
    {
        if (part().endsInFrame)
            warn("ends within a block of its codec at {:.3f} s; it may have been cut off", seconds(delivered));
        if (part().leftOutBytes > 0)
            warn("has {} bytes behind its sound that are left out; as sound they would be {:.3f} s",
                 part().leftOutBytes, secondsOf(part().leftOutBytes));
    }

    void warnOfGap()
    {
        if (part().skippedBytes > 0 && !isFormat(SF_FORMAT_OGG))
            warn("is damaged at {:.3f} s: {} bytes are no sound, about {:.3f} s are missing", seconds(delivered),
                 part().skippedBytes, secondsOf(part().skippedBytes));
    }

    /// Goes on to the next part that can be read; whether there is one.
    bool openNext()
    {
        const auto before = info;
        warnOfRest();
        while (current + 1 < parts.size())
        {
            ++current;
            if (part().end <= part().begin)
            {
                warnOfGap();
                continue;
            }
            const auto opened = openPart();
            if (opened && info.samplerate == before.samplerate && info.channels == before.channels)
            {
                warnOfGap();
                silence = part().silence;
                deliveredBefore = delivered + silence;
                findMarkers();
                return true;
            }
            const auto bytes = part().end - part().begin;
            if (!opened)
                warn("has another sound behind {:.3f} s, which is left out: it {} ({} bytes)",
                     static_cast<double>(delivered) / before.samplerate, opened.error().message, bytes);
            else
                warn("has another sound behind {:.3f} s, which is left out: it has {} channels at {} Hz ({:.3f} s); "
                     "save it as a file of its own",
                     static_cast<double>(delivered) / before.samplerate, info.channels, info.samplerate,
                     secondsOf(bytes));
            info = before;
        }
        return false;
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
    auto state = std::make_unique<State>();
    state->file = std::move(*file);
    state->options = options;
    bool film = isFilm(state->file.get(), 0);
    std::uint64_t filmBegin = 0;
    if (!film)
    {
        state->parts = soundParts(state->file.get());
        if (state->parts.empty())
            return invalid("is empty; choose a file with audio");
        filmBegin = state->parts.front().begin; // behind a tag
        film = isFilm(state->file.get(), filmBegin);
        if (film)
            state->parts.clear();
    }
    auto opened = film ? state->openFilm(path, filmBegin) : state->openPart();
    if (!opened && !film && !state->sound && state->isForeign())
    {
        film = true;
        opened = state->openFilm(path);
        if (opened)
            state->findMarkers();
    }
    if (!opened)
        return opened.error();
    if (!film)
    {
        state->warnOfGap();
        state->silence = state->deliveredBefore = state->part().silence;
        state->findMarkers();
    }
    if (!film)
        state->special = specialChannelsOf(state->sound.get(), state->info.channels);
    state->findGains();
    if (const int rate = state->info.samplerate; rate < options.lowestSampleRate)
    {
        state->raiser.emplace(rate, options.lowestSampleRate, static_cast<std::size_t>(state->info.channels));
        state->warn("is sampled at {} Hz, so all above {} Hz is missing; it is read at {} Hz", rate, rate / 2,
                    rate * state->raiser->multiple());
    }
    return AudioReader(std::move(state));
}

int AudioReader::sampleRate() const noexcept
{
    return state->info.samplerate * (state->raiser ? state->raiser->multiple() : 1);
}

double AudioReader::lowFrequencyGain() const noexcept
{
    const auto place = state->special.lowFrequency;
    return place && *place < state->gains.size() ? static_cast<double>(state->gains[*place]) : 1.0;
}

const std::vector<Marker>& AudioReader::markers() const noexcept
{
    return state->markers.markers;
}

void AudioReader::addMarkers(FoundMarkers found)
{
    pacini::addMarkers(state->markers, std::move(found), 0.0);
}

std::vector<Marker> AudioReader::takeMarkers(double duration)
{
    auto& [all, told] = state->markers;
    std::vector<Marker> within;
    std::size_t behind = 0, bytes = 0;
    for (const Marker& marker : all)
    {
        behind += marker.time > duration ? 1u : 0u;
        if (marker.time > duration || within.size() == limits::soundMarkers ||
            bytes + marker.name.size() > limits::soundMarkerBytes)
            continue;
        bytes += marker.name.size();
        within.push_back(marker);
    }
    if (std::exchange(state->markersAreTold, true))
        return within;
    state->warnings.insert(state->warnings.end(), told.begin(), told.end());
    if (behind == 1)
        state->warn("has a marker behind the end of its sound, which is left out");
    else if (behind > 1)
        state->warn("has {} markers behind the end of its sound, which are left out", behind);
    if (const auto left = all.size() - behind - within.size(); left > 0)
        state->warn("has more markers than the {} or the {} bytes of names that a clip takes; {} are left out",
                    limits::soundMarkers, limits::soundMarkerBytes, left);
    return within;
}

int AudioReader::channels() const noexcept
{
    return state->info.channels;
}

std::optional<std::uint64_t> AudioReader::frames() const noexcept
{
    auto frames = state->film ? state->film->frames() : state->partFrames();
    if (frames && state->raiser)
        *frames *= static_cast<std::uint64_t>(state->raiser->multiple());
    if (!frames || state->film || state->parts.size() == 1 || state->view.size() == 0)
        return frames;
    double bytes = 0.0;
    for (const SoundPart& part : state->parts)
        bytes += static_cast<double>(part.end - std::min(part.end, part.begin));
    return static_cast<std::uint64_t>(static_cast<double>(*frames) / static_cast<double>(state->view.size()) * bytes);
}

Result<std::size_t> AudioReader::read(std::span<float> interleaved)
{
    if (!state->raiser)
        return state->read(interleaved);
    return state->raiser->read(interleaved, [this](std::span<float> block) { return state->read(block); });
}

Result<std::size_t> AudioReader::State::read(std::span<float> interleaved)
{
    const auto channels = static_cast<std::size_t>(info.channels);
    assert(interleaved.size() % channels == 0);
    const auto wanted = interleaved.size() / channels;
    std::size_t done = 0;
    while (done < wanted && !ended)
    {
        const auto rest = interleaved.subspan(done * channels);
        if (silence > 0)
        {
            const auto frames = static_cast<std::size_t>(std::min<std::uint64_t>(silence, wanted - done));
            std::fill_n(rest.begin(), frames * channels, 0.0f);
            silence -= frames;
            delivered += frames;
            done += frames;
            continue;
        }
        sf_count_t count = 0;
        if (film)
        {
            const auto read = film->read(rest);
            if (!read)
                return read.error();
            count = static_cast<sf_count_t>(*read);
        }
        else
        {
            const SoundLibraryCall inside;
            count = sf_readf_float(sound.get(), rest.data(), static_cast<sf_count_t>(wanted - done));
        }
        if (!film && isFormat(SF_FORMAT_FLAC) && sf_error(sound.get()) != SF_ERR_NO_ERROR && endBeforeNextFlac())
            continue;
        const auto got = static_cast<std::size_t>(std::max<sf_count_t>(count, 0));
        if (!options.keepNan)
            if (auto finite = checkFinite(rest.first(got * channels)); !finite)
                return finite.error();
        if (!film && part().gain != 1.0)
            for (float& sample : rest.first(got * channels))
                sample *= static_cast<float>(part().gain);
        applyGains(rest.first(got * channels));
        delivered += got;
        done += got;
        if (done == wanted)
            break;
        if (film)
        {
            addWarnings(film->takeWarnings());
            ended = true;
            break;
        }
        if (auto end = explainEnd(); !end)
            return end.error();
        ended = !openNext();
    }
    return done;
}

const std::vector<std::string>& AudioReader::warnings() const noexcept
{
    return state->warnings;
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
    AudioData audio{reader.sampleRate(), reader.channels(), {}, 0, {}};
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
    audio.warnings = reader.warnings();
    return audio;
}

} // namespace pacini
