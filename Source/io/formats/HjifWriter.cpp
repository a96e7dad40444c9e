#include "io/formats/ForeignText.h"
#include "io/formats/FormatLosses.h"
#include "io/formats/HjifFormat.h"
#include "io/formats/PlayedClip.h"

#include <pacini/simplify/Simplify.h>
#include <pacini/synthesis/VoiceMerge.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>

namespace pacini
{

namespace
{
constexpr double ticksPerSecond = 1000.0;
constexpr std::size_t bandsOfLevel1 = 7;
constexpr std::size_t bandsOfLevel2 = 63;

struct Keyframe
{
    std::optional<double> amplitude;
    std::optional<int> frequency;
};
using Keyframes = std::map<std::int64_t, Keyframe>;

std::int64_t tickOf(double time)
{
    return std::llround(time * ticksPerSecond);
}

/// Puts a curve on the ticks. A step takes one tick, since a player divides by the distance of its keyframes.
template <typename Put>
double putOnTicks(const Curve& curve, Put put)
{
    double moved = 0.0;
    std::int64_t last = -1;
    for (std::size_t i = 0; i < curve.size(); ++i)
    {
        std::int64_t tick = std::max(tickOf(curve[i].time), std::int64_t{0});
        const bool isLastHere = i + 1 == curve.size() || tickOf(curve[i + 1].time) > tick;
        if (tick <= last)
        {
            if (!isLastHere && last > tick)
                continue;
            tick = last + (isLastHere ? 1 : 0);
        }
        put(tick, curve[i].value);
        moved = std::max(moved, std::abs(static_cast<double>(tick) / ticksPerSecond - curve[i].time));
        last = tick;
    }
    return moved;
}

/// No more points than are asked for, else as few as keep the curve within `error`.
Curve simplified(const Curve& curve, std::optional<double> pointsPerSecond, double error, double duration)
{
    if (pointsPerSecond)
        return thinned(curve, *pointsPerSecond, duration);
    SimplifyParams params;
    params.method = SimplifyMethod::douglasPeucker;
    params.maxError = error;
    const auto simple = simplify(curve, params);
    return simple ? *simple : curve;
}

double highestSum(const Clip& clip)
{
    std::vector<double> times;
    for (const Band& band : clip.bands)
        for (const Breakpoint& point : band.amplitude)
            times.push_back(point.time);
    std::sort(times.begin(), times.end());
    std::vector<CurveReader> readers;
    for (const Band& band : clip.bands)
        readers.emplace_back(band.amplitude);
    double highest = 0.0;
    for (const double time : times)
    {
        double sum = 0.0;
        for (CurveReader& reader : readers)
            sum += reader.at(time);
        highest = std::max(highest, sum);
    }
    for (const Band& band : clip.bands) // on a step the earlier value may be the larger one
        for (const Breakpoint& point : band.amplitude)
            highest = std::max(highest, point.value);
    for (const Transient& event : clip.transients)
        highest = std::max(highest, event.amplitude);
    return highest;
}

class Writer
{
public:
    Writer(const Clip& clipToWrite, const ExportParams& wanted, bool bandsAreBaked)
        : clip(clipToWrite),
          params(wanted),
          baked(bandsAreBaked),
          gain(std::max(1.0, std::ceil(highestSum(clip) * 1000.0) / 1000.0))
    {
    }

    std::string write(const std::string& name)
    {
        std::vector<std::string> bands;
        for (const Band& band : clip.bands)
            if (std::any_of(band.amplitude.begin(), band.amplitude.end(), [](const auto& p) { return p.value > 0.0; }))
                bands.push_back(vectorialBand(band));
        if (!clip.transients.empty())
            bands.push_back(transientBand());
        if (bands.empty())
            losses.addEmpty(clip.duration);
        if (movedTime > 1e-9)
            losses.add(LossKind::timeStep, 0.0, clip.duration, movedTime, "times are rounded to milliseconds");
        if (bentPitch > 1e-9)
            losses.add(LossKind::frequency, 0.0, clip.duration, bentPitch, "frequencies are rounded to 1 Hz");

        const bool simple = bands.size() <= bandsOfLevel1;
        return fmt::format(R"({{
  "version": "2023",
  "profile": {},
  "level": {},
  "date": "2023-01-01",
  "description": {},
  "timescale": {},
  "avatars": [],
  "syncs": [],
  "perceptions": [
    {{
      "id": 0,
      "avatar_id": 0,
      "description": {},
      "perception_modality": "Vibrotactile",
      "effect_library": [],
      "channels": [
        {{
          "id": 0,
          "description": {},
          "gain": {},
          "mixing_coefficient": 1,
          "body_part_mask": 0,
          "frequency_sampling": {},
          "sample_count": {},
          "bands": [{}{}]
        }}
      ]
    }}
  ]
}}
)",
                           inQuotes(simple ? "Simple Parametric" : "Main"), simple ? 1 : 2, inQuotes(name),
                           ticksPerSecond, inQuotes(name), inQuotes(name), decimal(gain, 3), outputRate,
                           std::llround(clip.duration * outputRate), fmt::join(bands, ","),
                           bands.empty() ? "" : "\n          ");
    }

    FormatLosses losses;

private:
    static constexpr int outputRate = 8000; // Hz, of players that ask the file

    std::string vectorialBand(const Band& band)
    {
        static const double inaudible = getenv("TOL") ? atof(getenv("TOL")) : 0.002;
        const Curve amplitude = baked || params.amplitudePoints
                                    ? simplified(band.amplitude, params.amplitudePoints, inaudible, clip.duration)
                                    : band.amplitude;
        reportPoints(band.amplitude, amplitude);
        Curve pitch = params.frequencyPoints ? thinned(band.pitch, *params.frequencyPoints, clip.duration) : band.pitch;
        if (pitch.empty())
            pitch = {{0.0, std::max(band.centreFrequency, 1.0)}};
        double lowest = band.lowFrequency, highest = band.highFrequency;
        for (Breakpoint& point : pitch)
        {
            const double rounded = std::max(1.0, std::round(point.value));
            bentPitch = std::max(bentPitch, std::abs(std::log2(rounded / point.value)));
            lowest = std::min(lowest, rounded);
            highest = std::max(highest, rounded);
        }
        std::string text = fmt::format(R"(
            {{"band_type": "VectorialWave", "lower_frequency_limit": {}, "upper_frequency_limit": {}, "effects": [)",
                                       std::floor(lowest), std::ceil(highest));
        const char* separator = "";
        for (const Curve& sound : soundsOf(amplitude))
        {
            text += separator + effect(sound, pitch);
            separator = ",";
        }
        return text + "\n            ]}";
    }

    /// The parts of an amplitude between silences, each with its first and last value; before its first point and after
    /// its last a curve holds their values.
    [[nodiscard]] std::vector<Curve> soundsOf(Curve curve) const
    {
        if (curve.front().time > 0.0)
            curve.insert(curve.begin(), {0.0, curve.front().value});
        if (curve.back().time < clip.duration)
            curve.push_back({clip.duration, curve.back().value});
        std::vector<Curve> sounds(1);
        for (std::size_t i = 0; i < curve.size(); ++i)
        {
            const bool rests = i + 1 < curve.size() && curve[i].value == 0.0 && curve[i + 1].value == 0.0;
            const bool jumpsUp = i + 1 < curve.size() && curve[i].value == 0.0 && curve[i + 1].time == curve[i].time;
            const bool fallen = i > 0 && curve[i].value == 0.0 && curve[i - 1].time == curve[i].time;
            if (!(sounds.back().empty() && (rests || jumpsUp)) && !fallen)
                sounds.back().push_back(curve[i]);
            if ((rests || jumpsUp || fallen) && !sounds.back().empty())
                sounds.emplace_back();
        }
        std::erase_if(sounds,
                      [](const Curve& sound) {
                          return std::all_of(sound.begin(), sound.end(), [](const auto& p) { return p.value == 0.0; });
                      });
        return sounds;
    }

    /// One effect, whose wave goes on from where a wave from the start of the clip would be.
    std::string effect(const Curve& sound, const Curve& pitch)
    {
        Keyframes keyframes;
        movedTime = std::max(movedTime, putOnTicks(sound, [&](std::int64_t tick, double value)
                                                   { keyframes[tick].amplitude = value / gain; }));
        const std::int64_t start = keyframes.begin()->first;
        const std::int64_t end = keyframes.rbegin()->first;
        const auto hertz = [&](double value)
        {
            return static_cast<int>(std::max(1.0, std::round(value)));
        };
        movedTime = std::max(movedTime, putOnTicks(pitch,
                                                   [&](std::int64_t tick, double value)
                                                   {
                                                       if (tick > start && tick < end)
                                                           keyframes[tick].frequency = hertz(value);
                                                   }));
        keyframes[start].frequency = hertz(valueAt(pitch, sound.front().time));
        if (pitch.size() > 1)
            keyframes[end].frequency = hertz(valueAt(pitch, sound.back().time));
        const double phase = 2.0 * std::numbers::pi * cyclesUntil(pitch, sound.front().time);
        std::string text = fmt::format(R"(
              {{"effect_type": "Basis", "position": {}, "phase": {}, "base_signal": "Sine", "keyframes": [)",
                                       start, decimal(phase, 4));
        const char* separator = "";
        for (const auto& [tick, keyframe] : keyframes)
        {
            text += fmt::format("{}\n                {{\"relative_position\": {}", separator, tick - start);
            if (keyframe.amplitude)
                text += fmt::format(", \"amplitude_modulation\": {}", decimal(*keyframe.amplitude, 5));
            if (keyframe.frequency)
                text += fmt::format(", \"frequency_modulation\": {}", *keyframe.frequency);
            text += '}';
            separator = ",";
        }
        return text + "\n              ]}";
    }

    /// Fraction of a cycle at `time` of a wave that starts at phase 0.
    static double cyclesUntil(const Curve& pitch, double time)
    {
        double cycles = 0.0, before = 0.0;
        for (std::size_t i = 0; i <= pitch.size() && before < time; ++i)
        {
            const double until = i < pitch.size() ? std::min(pitch[i].time, time) : time;
            cycles += 0.5 * (valueAt(pitch, before) + valueAt(pitch, until)) * (until - before);
            before = std::max(before, until);
        }
        return cycles - std::floor(cycles);
    }

    std::string transientBand()
    {
        std::string text = fmt::format(R"(
            {{"band_type": "Transient", "lower_frequency_limit": {}, "upper_frequency_limit": {}, "effects": [)",
                                       hjifDullFrequency, hjifSharpFrequency);
        const char* separator = "";
        for (const Transient& event : clip.transients)
        {
            const std::int64_t tick = tickOf(event.time);
            movedTime = std::max(movedTime, std::abs(static_cast<double>(tick) / ticksPerSecond - event.time));
            const double frequency = hjifDullFrequency + event.sharpness * (hjifSharpFrequency - hjifDullFrequency);
            text += fmt::format("{}\n              {{\"effect_type\": \"Basis\", \"position\": {}, \"keyframes\": [",
                                separator, tick);
            text +=
                fmt::format(R"({{"relative_position": 0, "amplitude_modulation": {}, "frequency_modulation": {}}}]}})",
                            decimal(event.amplitude / gain * (getenv("TF")?std::sqrt((0.375*2/(100*std::pow(2.8,event.sharpness)))/0.022):1), 5), std::llround(frequency));
            separator = ",";
        }
        return text + "\n            ]}";
    }

    void reportPoints(const Curve& before, const Curve& after)
    {
        if (after.size() >= before.size())
            return;
        double worst = 0.0;
        CurveReader reader(after);
        for (const Breakpoint& point : before)
            worst = std::max(worst, std::abs(reader.at(point.time) - point.value));
        losses.add(LossKind::points, 0.0, clip.duration, worst, "amplitudes have fewer points than are played");
    }

    const Clip& clip;
    const ExportParams& params;
    bool baked;
    double gain; ///< of the channel: amplitudes are at most 1, and a player cuts the sum of the bands there
    double movedTime = 0.0, bentPitch = 0.0;
};
} // namespace

Result<ExportedClip> writeHjif(const Clip& clip, const ExportParams& params)
{
    Clip played = playedClip(clip, 1.0, 1.0 / ticksPerSecond);
    FormatLosses losses;
    losses.addNoiseAndText(clip, true);
    const std::size_t room = bandsOfLevel2 - (played.transients.empty() ? 0 : 1);
    if (played.bands.size() > room)
    {
        losses.addBands(clip, fmt::format("{} bands share {}", played.bands.size(), room));
        mergeVoices(played, room);
    }
    Writer writer(played, params, !clip.envelope.empty());
    writer.losses = std::move(losses);
    ExportedClip result;
    result.files.push_back({"", writer.write(nameOfClip(clip, params.name))});
    result.losses = std::move(writer.losses).sorted();
    return result;
}

} // namespace pacini
