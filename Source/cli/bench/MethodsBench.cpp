#include "cli/bench/Bench.h"
#include "cli/bench/Timed.h"

#include <pacini/analysis/EncodeSound.h>
#include <pacini/analysis/MonoMix.h>
#include <pacini/analysis/methods/Method.h>
#include <pacini/clip/PackedClip.h>
#include <pacini/evaluate/Hts.h>
#include <pacini/evaluate/LowPart.h>
#include <pacini/evaluate/SignalMetrics.h>
#include <pacini/evaluate/match/MatchParts.h>
#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/DecoderChoice.h>

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <optional>
#include <tuple>
#include <utility>

namespace pacini::cli
{

namespace
{
/// A sound with all that candidates are compared with.
class Judges
{
public:
    explicit Judges(const BenchSound& soundToJudge)
        : sound(soundToJudge),
          judge(signalAnalysisLength(sound.mono.size(), sound.sampleRate)),
          judged(signalFeatures(judge, std::span(sound.mono), sound.sampleRate).value()),
          felt(htsSourceFeatures(hts, std::span(sound.mono), sound.sampleRate).value()),
          heard(heardTrack(sound.mono, sound.sampleRate).value())
    {
    }

    struct Verdict
    {
        double match = 0.0;
        double hts = 0.0;
        LowPart low;
        SignalMetrics measures;
        std::vector<double> detected; ///< s, events in the candidate by the neutral detector
    };

    [[nodiscard]] Verdict of(std::span<const float> candidate, int sampleRate)
    {
        auto found = signalFeatures(judge, candidate, sampleRate).value();
        const auto feltCandidate = htsCandidateFeatures(hts, candidate, sampleRate).value();
        const auto touched = touchTrack(touch, candidate, sampleRate).value();
        return {predictedMatch(matchParts(heard, touched)), compare(felt, feltCandidate, HtsMode::translation).score,
                compareLowPart(felt, feltCandidate), compare(judged, found), std::move(found.onsets)};
    }

private:
    const BenchSound& sound;
    SignalAnalyzer judge;
    HtsAnalyzer hts;
    SignalFeatures judged;
    HtsFeatures felt;
    HeardTrack heard;
    TouchAnalyzer touch;
};

/// Hits twice, and events that are there or claimed: F-measure over any number of sounds is the ratio of the sums.
struct EventCounts
{
    BenchCell agreeing, all;
};

EventCounts countEvents(const BenchSound& sound, const std::vector<double>& detections)
{
    if (!sound.events)
        return {};
    const EventScore score = scoreEvents(sound.events->onsets, detections, 0.025, sound.events->ambiguous);
    const auto agreeing = static_cast<double>(2 * score.truePositives);
    return {agreeing, agreeing + static_cast<double>(score.falsePositives + score.falseNegatives)};
}

struct PackedSound
{
    Clip clip;
    std::vector<std::byte> bytes;
};

/// Names the clip as `pacini encode` does and packs it.
PackedSound packed(Clip clip, const BenchSound& sound)
{
    clip.source = {sound.name, static_cast<double>(sound.sampleRate), sound.channels};
    clip.name = sound.path.stem().string();
    PackedSound result{std::move(clip), {}};
    result.bytes = packClip(result.clip, packParamsFor(result.clip));
    return result;
}

constexpr int candidateRate = 8000; // Hz, of the judge

std::vector<float> decoded(const Clip& clip)
{
    constexpr double resonance = 67.0; // Hz, of the thesis' actuator
    DecoderParams params;
    params.sampleRate = candidateRate;
    Decoder decoder(clip, decoderParamsFor(clip, params, {}, resonance));
    std::vector<float> signal(static_cast<std::size_t>(decoder.totalFrames()));
    decoder.process(signal);
    return signal;
}

class Measurement
{
public:
    Measurement(const BenchSound& soundToMeasure, const BenchSettings& benchSettings, BenchTable& table)
        : sound(soundToMeasure), settings(benchSettings), rows(table), judges(soundToMeasure)
    {
    }

    void clip(const std::string& method, const std::string& variant, bool statesEvents,
              const std::function<Clip()>& encode)
    {
        const auto encoded = timed(settings.repeats, [&] { return packed(encode(), sound); });
        const Clip clip = unpackClip(encoded.result.bytes).value();
        const auto rendered = timed(settings.repeats, [&] { return decoded(clip); });
        EventCounts stated;
        if (statesEvents)
        {
            std::vector<double> times;
            for (const Transient& transient : clip.transients)
                times.push_back(transient.time);
            stated = countEvents(sound, times);
        }
        const auto bytes = static_cast<double>(encoded.result.bytes.size());
        add(method, variant, bytes / sound.duration(), static_cast<double>(breakpointCount(clip)) / sound.duration(),
            encoded.seconds, rendered.seconds, judges.of(rendered.result, candidateRate), stated);
    }

    void signal(const std::string& method, const std::function<std::vector<float>()>& translate)
    {
        const auto translated = timed(settings.repeats, translate);
        add(method, "", {}, {}, translated.seconds, {}, judges.of(translated.result, sound.sampleRate), {});
    }

    /// What the scores of methods are to be read against: it takes no time.
    void reference(const std::string& name, const std::vector<float>& signal)
    {
        add(name, "", {}, {}, {}, {}, judges.of(signal, sound.sampleRate), {});
    }

private:
    void add(const std::string& method, const std::string& variant, BenchCell bytesPerSecond, BenchCell pointsPerSecond,
             BenchCell encodeSeconds, BenchCell renderSeconds, const Judges::Verdict& verdict,
             const EventCounts& stated)
    {
        const EventCounts detected = countEvents(sound, verdict.detected);
        const SignalMetrics& m = verdict.measures;
        // Against silence only the level of the candidate means anything.
        const auto cellOf = [](const std::optional<double>& value)
        {
            BenchCell cell;
            if (value)
                cell = *value;
            return cell;
        };
        const auto measure = [&m](double value)
        {
            BenchCell cell;
            if (!m.silentReference)
                cell = value;
            return cell;
        };
        rows.add({sound.name, method, variant, sound.duration(), std::move(encodeSeconds), std::move(renderSeconds),
                  std::move(bytesPerSecond), std::move(pointsPerSecond), measure(verdict.match), verdict.hts,
                  cellOf(verdict.low.kept), cellOf(verdict.low.beat), measure(m.logSpectralDistance),
                  measure(m.wideSnr), measure(m.centroidError), stated.agreeing, stated.all, detected.agreeing,
                  detected.all});
    }

    const BenchSound& sound;
    const BenchSettings& settings;
    BenchTable& rows;
    Judges judges;
};

std::string settingText(const EncoderParams& params)
{
    return fmt::format("{} bands, {:g}/s, {} bit, audible {:g}{}", params.bands, params.breakpoints, params.quantise,
                       params.audible, params.heard == HeardRole::instead ? " instead" : "");
}

void measureOwn(Measurement& measurement, const BenchSound& sound, const EncoderParams& params)
{
    Encoder encoder(params); // kept between sounds by `pacini encode`, so its making is not timed
    measurement.clip(std::string(methodInfo(Method::a2vt).name), settingText(params), true,
                     [&]
                     {
                         return encodePrecisely(encoder, {sound.sampleRate, sound.channels},
                                                SoundParts(sound.interleaved, sound.channels))
                             .value();
                     });
}

void measureMethods(const BenchSound& sound, const BenchSettings& settings, BenchTable& rows)
{
    Measurement measurement(sound, settings, rows);
    const EncoderParams usual;
    EncoderParams bandsAlone; // what HTS, LSD and the others can judge: they hear nothing above the range of touch
    bandsAlone.audible = 0.0;
    measureOwn(measurement, sound, usual);
    measureOwn(measurement, sound, bandsAlone);
    EncoderParams loudnessLeads;
    loudnessLeads.heard = HeardRole::instead;
    measureOwn(measurement, sound, loudnessLeads);
    for (const MethodInfo& info : methodTable)
    {
        const std::string name(info.name);
        const double fs = sound.sampleRate;
        const auto mix = [&sound]
        {
            return monoMix(sound.interleaved, static_cast<std::size_t>(sound.channels));
        };
        if (info.output == MethodOutput::signal)
            measurement.signal(name, [&] { return translateToSignal(info.method, mix(), fs); });
        else if (info.method != Method::a2vt)
            measurement.clip(name, "", info.method == Method::thesis || info.method == Method::decomposition,
                             [&] { return translateToClip(info.method, mix(), fs); });
    }
    measurement.reference("sound itself", sound.mono);
    measurement.reference("silence", std::vector<float>(sound.mono.size(), 0.0f));
    if (!settings.sweep)
        return;
    for (const double audible : {0.25, 0.5, 0.75})
    {
        EncoderParams params;
        params.audible = audible;
        measureOwn(measurement, sound, params);
    }
    for (const int bands : {6, 12, 24})
        for (const double breakpoints : {5.0, 10.0, 20.0, 40.0})
            for (const int quantise : {5, 6, 8, 12})
            {
                EncoderParams params = bandsAlone;
                params.bands = bands;
                params.breakpoints = breakpoints;
                params.quantise = quantise;
                // All numbers of bands and points at the usual bits, all bits at the usual bands and points.
                const bool usualPlace = bands == usual.bands && breakpoints == usual.breakpoints;
                if (params != bandsAlone && (quantise == usual.quantise || usualPlace))
                    measureOwn(measurement, sound, params);
            }
}
} // namespace

Bench methodsBench()
{
    const auto figure = [](std::string name, std::string title, std::string x, std::string y)
    {
        return BenchFigure{
            std::move(name), std::move(title), "method", std::move(x), std::move(y), "variant", {}, {}, false};
    };
    return {
        "methods",
        "Translation methods",
        "Each sound is encoded, packed, unpacked and rendered at 8 kHz; quality and time come from the same run. "
        "Means over the sounds, times real time as total over total. B/s is the size of the file; signals have none. "
        "Match: the rating by people, 0 to 100, that is predicted. HTS: haptic translation similarity, 0 to 100. LSD: "
        "log spectral distance. Low kept: correlation of the envelopes of 30 to 120 and 120 to 300 Hz with those of "
        "the "
        "sound; beat kept: level in the strongest low events against that between them, as a share of the same ratio "
        "of "
        "the sound. Events F1 (within 25 ms of the "
        "annotated onsets, pooled over the sounds) once for the events that a clip states and once for those that a "
        "neutral detector finds in the rendered signal. The rows 'sound itself' (felt as it is) and 'silence' are what "
        "the others are to be read against. Columns with Sd: standard deviation over the sounds. The best match comes "
        "first.",
        columnsOf({"method", "variant"},
                  {summed("duration", "s"),
                   summed("encodeSeconds", "s"),
                   summed("renderSeconds", "s"),
                   {"bytesPerSecond", "B/s"},
                   {"pointsPerSecond", "1/s"},
                   {"match", ""},
                   {"matchSd", "", Reduction::spread, "match"},
                   {"hts", ""},
                   {"htsSd", "", Reduction::spread, "hts"},
                   {"lowKept", ""},
                   {"beatKept", ""},
                   {"lsd", "dB"},
                   {"lsdSd", "dB", Reduction::spread, "lsd"},
                   {"wideSnr", "dB"},
                   {"centroidError", "%"},
                   summed("statedAgreeing"),
                   summed("statedAll"),
                   summed("detectedAgreeing"),
                   summed("detectedAll"),
                   {"statedF1", "", Reduction::ratio, "statedAgreeing", "statedAll"},
                   {"detectedF1", "", Reduction::ratio, "detectedAgreeing", "detectedAll"},
                   {"encodeTimesRealTime", "", Reduction::ratio, "duration", "encodeSeconds"},
                   {"renderTimesRealTime", "", Reduction::ratio, "duration", "renderSeconds"},
                   {"encodeTime", "ms/s", Reduction::ratio, "encodeSeconds", "duration", 1000.0, false},
                   {"relativeTime", "", Reduction::relative, "encodeTime"}}),
        {figure("", "Log spectral distance against encoding time", "encodeTime", "lsd"),
         figure("rate", "Log spectral distance against size", "bytesPerSecond", "lsd"),
         figure("match", "Predicted match against size", "bytesPerSecond", "match")},
        {"method", "variant"},
        measureMethods,
        true,
        false,
        "match"};
}

} // namespace pacini::cli
