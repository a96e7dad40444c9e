#pragma once

// Encoder of sounds by any translation method: a file, or samples in memory, into a clip or a drive signal. All of it
// is in this header, since signal processing is compiled for speed and the files of this module are not.

#include "io/AtomicFile.h"
#include "io/AudioReader.h"
#include "io/ClipSeal.h"
#include "io/FinishedClip.h"
#include "io/Stopwatch.h"

#include <pacini/analysis/EncodeSound.h>
#include <pacini/analysis/Encoder.h>
#include <pacini/analysis/MonoMix.h>
#include <pacini/analysis/SoundSurvey.h>
#include <pacini/analysis/methods/Method.h>
#include <pacini/clip/PackedClip.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini
{

/// Parameters of the translation and reading of sounds.
struct SoundEncoderParams : TranslationParams
{
    AudioReadOptions reading{.lowFrequencyGain = lowFrequencyEffectsGain};
};

/// What a clip says of its encoder when the centre channel was left out, and how much more, in dB, the channel of
/// low-frequency effects counts.
inline constexpr std::string_view withoutCentreName = "withoutCentre";
inline constexpr std::string_view lowFrequencyEffectsName = "lowFrequencyEffects";

/// What the reading of a sound did to its samples, as a clip records it: a clip whose record is another is not up to
/// date. Empty for sounds whose channels all count alike.
[[nodiscard]] inline std::vector<EncoderParameter> readingRecord(const AudioReadOptions& reading,
                                                                 double lowFrequencyGain)
{
    std::vector<EncoderParameter> record;
    if (reading.withoutCentre)
        record.push_back({std::string(withoutCentreName), true});
    if (lowFrequencyGain != 1.0)
        record.push_back({std::string(lowFrequencyEffectsName), std::round(20.0 * std::log10(lowFrequencyGain))});
    return record;
}

/// The parts of an open file. Errors: those of AudioReader.
class SoundFileParts
{
public:
    SoundFileParts(AudioReader& opened, const std::function<void(double)>& toTell)
        : reader(opened),
          progress(toTell),
          expected(static_cast<double>(opened.frames().value_or(0))),
          buffer(soundPartLength(static_cast<std::size_t>(opened.channels())))
    {
    }

    [[nodiscard]] SoundPart operator()()
    {
        if (expected > 0.0 && frames > 0)
            progress(static_cast<double>(frames) / expected);
        const auto got = reader.read(buffer);
        if (!got)
            return got.error();
        frames += *got;
        return std::span<const float>(buffer).first(*got * static_cast<std::size_t>(reader.channels()));
    }

private:
    AudioReader& reader;
    const std::function<void(double)>& progress;
    double expected;
    std::vector<float> buffer;
    std::uint64_t frames = 0;
};

/// Encodes one sound after another with one set of parameters; keeps filters and transforms between them. a2vt takes a
/// sound piece by piece; the other methods hold all of it. One thread at a time.
class SoundEncoder
{
public:
    using Progress = std::function<void(double)>;

    /// `params.params` must be valid.
    explicit SoundEncoder(const SoundEncoderParams& wanted) : settings(wanted), encoder(wanted.params) {}

    /// The clip of an open file, named by `input`: on its grids and sealed, as clip files hold it. Only for methods
    /// that make clips. `progress(share)` is called now and then; `work` counts the time without access to files. Long
    /// files are read twice. Markers of the file are the clip's. Errors: those of AudioReader, tooLarge beyond 24
    /// hours.
    [[nodiscard]] Result<Clip> clipOf(AudioReader& reader, const std::filesystem::path& input, const Progress& progress,
                                      Stopwatch& work)
    {
        std::optional<SoundScale> scale;
        double done = 0.0;
        if (settings.method == Method::a2vt && isLong(reader) && !isStream(input))
        {
            done = shareOfSurvey();
            const auto found = survey(
                input, [&](double part) { progress(done * part); }, work);
            if (!found)
                return found.error();
            scale = *found;
        }
        const Progress rest = [&](double part)
        {
            progress(done + (1.0 - done) * part);
        };
        SoundFileParts file(reader, rest);
        auto clip = clipOf({reader.sampleRate(), reader.channels(), reader.frames().value_or(0), scale}, file,
                           clipNamesOf(input), work);
        if (const auto record = readingRecord(settings.reading, reader.lowFrequencyGain()); clip && !record.empty())
        {
            clip->encoder.insert(clip->encoder.end(), record.begin(), record.end());
            sealClip(*clip);
        }
        if (clip)
            addMarkers(*clip, reader.takeMarkers(clip->duration));
        return clip;
    }

    /// The same of the sound that `next()` hands out as SoundPart by SoundPart. Errors: those of next(), tooLarge
    /// beyond 24 hours.
    template <typename Next>
    [[nodiscard]] Result<Clip> clipOf(const SoundFormat& format, Next& next, ClipNames names, Stopwatch& work)
    {
        if (settings.method != Method::a2vt)
        {
            const auto mono = readMono(format, next, work);
            if (!mono)
                return mono.error();
            Clip clip;
            work.run(
                [&]
                {
                    clip = translateToClip(settings.method, *mono, format.sampleRate, settings.choices);
                    clip.source.sampleRate = format.sampleRate;
                    clip.source.channels = format.channels;
                    clip = finishClip(onGrids(std::move(clip)), std::move(names));
                });
            return clip;
        }
        Stopwatch reading;
        Result<Clip> clip = Clip();
        work.run(
            [&]
            {
                const auto timed = [&]
                {
                    SoundPart part = std::span<const float>();
                    reading.run([&] { part = next(); });
                    return part;
                };
                clip = encodeSound(encoder, format, timed);
                if (clip)
                    clip = finishClip(std::move(*clip), std::move(names));
            });
        work.leaveOut(reading);
        return clip;
    }

    /// The drive signal of a sound, as long as it and at its rate. Only for methods that make signals. Errors: those of
    /// next().
    template <typename Next>
    [[nodiscard]] Result<std::vector<float>> signalOf(const SoundFormat& format, Next& next, Stopwatch& work) const
    {
        const auto mono = readMono(format, next, work);
        if (!mono)
            return mono.error();
        std::vector<float> signal;
        work.run([&] { signal = translateToSignal(settings.method, *mono, format.sampleRate); });
        return signal;
    }

private:
    /// Onto its grid, and sealed with them: they may be edited as well.
    static void addMarkers(Clip& clip, std::vector<Marker> markers)
    {
        if (markers.empty())
            return;
        clip.markers = std::move(markers);
        clip = onGrids(std::move(clip));
        sealClip(clip);
    }

    /// Whether a sound is long enough to be read twice, so that its analysis need not be kept.
    [[nodiscard]] static bool isLong(const AudioReader& reader)
    {
        constexpr double seconds = 1200.0;
        return static_cast<double>(reader.frames().value_or(0)) > seconds * reader.sampleRate();
    }

    /// Returns the share of the survey in the time of encoding a long sound.
    [[nodiscard]] double shareOfSurvey() const { return settings.params.audible > 0.0 ? 0.4 : 0.2; }

    template <typename Next>
    [[nodiscard]] static Result<std::vector<float>> readMono(const SoundFormat& format, Next& next, Stopwatch& work)
    {
        std::vector<float> samples;
        const auto read = forEachPart(format, next,
                                      [&samples](std::span<const float> part)
                                      { samples.insert(samples.end(), part.begin(), part.end()); });
        if (!read)
            return read.error();
        work.run([&] { samples = monoMix(samples, static_cast<std::size_t>(format.channels)); });
        return samples;
    }

    [[nodiscard]] Result<SoundScale> survey(const std::filesystem::path& input, const Progress& progress,
                                            Stopwatch& work) const
    {
        auto reader = AudioReader::open(input, settings.reading);
        if (!reader)
            return reader.error();
        SoundSurvey whole(settings.params);
        whole.start(reader->sampleRate(), reader->channels());
        SoundFileParts file(*reader, progress);
        const auto read = forEachPart({reader->sampleRate(), reader->channels()}, file,
                                      [&](std::span<const float> part) { work.run([&] { whole.push(part); }); });
        if (!read)
            return read.error();
        SoundScale found;
        work.run([&] { found = whole.finish(); });
        return found;
    }

    SoundEncoderParams settings;
    Encoder encoder;
};

} // namespace pacini
