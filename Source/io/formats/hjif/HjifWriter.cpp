#include "io/formats/ForeignText.h"
#include "io/formats/LossList.h"
#include "io/formats/VoiceReduction.h"
#include "io/formats/hjif/HjifEvents.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/hjif/HjifVoices.h"

#include <pacini/foundation/NumberText.h>
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

/// An amplitude of 1 or less to within half a percent of itself: keyframes are many.
std::string threeDigits(double amplitude)
{
    return shortDecimalText(amplitude, amplitude >= 0.1 ? 3 : amplitude >= 0.01 ? 4 : 5);
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
            if (!isLastHere) // what comes before the step ends with the first point here
                continue;
            tick = last + 1;
        }
        put(tick, curve[i].value);
        moved = std::max(moved, std::abs(static_cast<double>(tick) / ticksPerSecond - curve[i].time));
        last = tick;
    }
    return moved;
}

double highestSum(const Clip& clip, const std::vector<HjifEvent>& events)
{
    std::vector<double> times;
    for (const Band& band : clip.bands)
        for (const Breakpoint& point : band.amplitude)
            times.push_back(point.time);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end()); // bands often have them in common
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
    highest = std::max(highest, hjifHighestLevel(clip)); // on a step the earlier value may be the larger one
    for (const Transient& event : clip.transients)
        highest = std::max(highest, event.amplitude);
    for (const HjifEvent& event : events)
        highest = std::max(highest, event.tap);
    return highest;
}

class Writer
{
public:
    Writer(const Clip& clipToWrite, const std::vector<HjifEvent>& eventsToWrite, const ExportParams& wanted)
        : clip(clipToWrite),
          told(eventsToWrite),
          params(wanted),
          gain(std::max(1.0, std::ceil(highestSum(clip, told) * 1000.0) / 1000.0))
    {
    }

    std::string write(const std::string& name)
    {
        std::vector<std::string> bands;
        for (const Band& band : clip.bands)
            if (std::any_of(band.amplitude.begin(), band.amplitude.end(), [](const auto& p) { return p.value > 0.0; }))
                bands.push_back(vectorialBand(band));
        addEvents(bands);
        if (bands.empty())
            losses.add(LossKind::empty, 0.0, clip.duration, 0.0, "nothing sounds");
        if (movedTime > 1e-9)
            losses.add(LossKind::timeStep, 0.0, clip.duration, movedTime, "times are rounded to milliseconds");
        if (bentPitch > 1e-9)
            losses.add(LossKind::frequency, 0.0, clip.duration, bentPitch, "frequencies are rounded to 1 Hz");

        // A line for the file and for each band: the rest of the keyframes' long names is enough.
        const bool simple = bands.size() <= bandsOfLevel1;
        return fmt::format(
            R"({{"version":"2023","profile":{},"level":{},"date":"2023-01-01","description":{},"timescale":{},)"
            R"("avatars":[],"syncs":[],"perceptions":[{{"id":0,"avatar_id":0,"description":{},)"
            R"("perception_modality":"Vibrotactile","effect_library":[],"channels":[{{"id":0,"description":{},)"
            R"("gain":{},"mixing_coefficient":1,"body_part_mask":0,"frequency_sampling":{},"sample_count":{},)"
            R"("bands":[{}]}}]}}]}})"
            "\n",
            inQuotes(simple ? "Simple Parametric" : "Main"), simple ? 1 : 2, inQuotes(name), ticksPerSecond,
            inQuotes(name), inQuotes(name), shortDecimalText(gain, 3), outputRate,
            std::llround(clip.duration * outputRate), fmt::join(bands, ","));
    }

    LossList losses;

private:
    static constexpr int outputRate = 8000; // Hz, of players that ask the file

    std::string vectorialBand(const Band& band)
    {
        const Curve amplitude =
            params.amplitudePoints ? thinned(band.amplitude, *params.amplitudePoints, clip.duration) : band.amplitude;
        losses.addThinned(band.amplitude, amplitude);
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
        std::string text = fmt::format(
            "\n"
            R"({{"band_type":"VectorialWave","lower_frequency_limit":{},"upper_frequency_limit":{},"effects":[)",
            std::floor(lowest), std::ceil(highest));
        const char* separator = "";
        for (const Curve& sound : soundsOf(amplitude))
        {
            text += separator + effect(sound, pitch, band.phase);
            separator = ",";
        }
        return text + "]}";
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

    /// One effect, whose wave goes on from where a wave of `firstPhase` cycles at the start of the clip would be.
    std::string effect(const Curve& sound, const Curve& pitch, double firstPhase)
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
        const double cycles = firstPhase + cyclesUntil(pitch, sound.front().time);
        const double phase = 2.0 * std::numbers::pi * (cycles - std::floor(cycles));
        std::string text = fmt::format(R"({{"effect_type":"Basis","position":{},"phase":{},"keyframes":[)", start,
                                       shortDecimalText(phase, 3));
        const char* separator = "";
        for (const auto& [tick, keyframe] : keyframes)
        {
            text += fmt::format("{}{{\"relative_position\":{}", separator, tick - start);
            if (keyframe.amplitude)
                text += fmt::format(",\"amplitude_modulation\":{}", threeDigits(*keyframe.amplitude));
            if (keyframe.frequency)
                text += fmt::format(",\"frequency_modulation\":{}", *keyframe.frequency);
            text += '}';
            separator = ",";
        }
        return text + "]}";
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

    /// A place in the file as text, and the frequencies in it.
    struct EventBand
    {
        std::string effects;
        double lowest = limits::frequency, highest = 0.0;

        void add(const std::string& effect, double low, double high)
        {
            effects += (effects.empty() ? "" : ",") + effect;
            lowest = std::min(lowest, low);
            highest = std::max(highest, high);
        }
        [[nodiscard]] std::string band(std::string_view type) const
        {
            return fmt::format(
                "\n"
                R"({{"band_type":"{}","lower_frequency_limit":{},"upper_frequency_limit":{},"effects":[{}]}})",
                type, std::floor(lowest), std::ceil(highest), effects);
        }
    };

    void addEvents(std::vector<std::string>& bands)
    {
        EventBand transients, waves;
        for (std::size_t i = 0; i < told.size(); ++i)
        {
            const Transient& event = clip.transients[i];
            if (told[i].tap <= 0.0 && told[i].wave <= 0.0)
                continue;
            const std::int64_t tick = tickOf(event.time);
            movedTime = std::max(movedTime, std::abs(static_cast<double>(tick) / ticksPerSecond - event.time));
            if (told[i].wave > 0.0)
                waves.add(wavePulse(tick, told[i]), told[i].frequency, told[i].frequency);
            if (told[i].inTrain && told[i].tap <= 0.0)
                losses.add(LossKind::event, event.time, told[i].length, 0.0,
                           "events of a fast train are written as short waves: transients would fill its gaps");
            if (told[i].tap > 0.0 && told[i].wave > 0.0)
                losses.add(LossKind::event, event.time, hjifTransientLength, 0.0,
                           "sharp events are written as a transient, which is dull and 22 ms long in the reference "
                           "player, and a short wave at their frequency");
            if (told[i].tap > 0.0)
            {
                const double place = hjifDullFrequency + event.sharpness * (hjifSharpFrequency - hjifDullFrequency);
                transients.add(transient(tick, told[i].tap, place), hjifDullFrequency, hjifSharpFrequency);
            }
        }
        if (!transients.effects.empty())
            bands.push_back(transients.band("Transient"));
        if (!waves.effects.empty())
            bands.push_back(waves.band("VectorialWave"));
    }

    [[nodiscard]] std::string transient(std::int64_t tick, double amplitude, double frequency) const
    {
        return fmt::format(R"({{"effect_type":"Basis","position":{},"keyframes":[{{"relative_position":0,)"
                           R"("amplitude_modulation":{},"frequency_modulation":{}}}]}})",
                           tick, threeDigits(amplitude / gain), std::llround(frequency));
    }

    /// A few periods under a Hann window, as the decoder plays an event, in straight lines: between keyframes of every
    /// eighth of it, its peak among them, they are within 4 % of its height.
    [[nodiscard]] std::string wavePulse(std::int64_t tick, const HjifEvent& event) const
    {
        constexpr std::int64_t pieces = 8;
        const std::int64_t half = std::llround(0.5 * event.length * ticksPerSecond); // 3 ms at least
        std::string text = fmt::format(R"({{"effect_type":"Basis","position":{},"phase":0,"keyframes":[)", tick);
        std::int64_t last = -1;
        for (std::int64_t n = 0; n <= pieces; ++n)
        {
            const std::int64_t at = (2 * half * n + pieces / 2) / pieces;
            if (at == last)
                continue;
            text += fmt::format(
                R"({}{{"relative_position":{},"amplitude_modulation":{}{}}})", n == 0 ? "" : ",", at,
                threeDigits(hannAt(static_cast<double>(at) / static_cast<double>(2 * half)) * event.wave / gain),
                n == 0 ? fmt::format(R"(,"frequency_modulation":{})", event.frequency) : "");
            last = at;
        }
        return text + "]}";
    }

    const Clip& clip;
    const std::vector<HjifEvent>& told;
    const ExportParams& params;
    double gain; ///< of the channel: amplitudes are at most 1, and a player cuts the sum of the bands there
    double movedTime = 0.0, bentPitch = 0.0;
};
} // namespace

Result<ExportedClip> writeHjif(const Clip& clip, const ExportParams& params)
{
    LossList losses;
    HjifVoices voices = hjifVoicesOf(clip, losses, params.quick ? HjifEffort::usual : HjifEffort::search,
                                     params.events.value_or(hjifEvents));
    Clip& played = voices.clip;
    losses.addNoise(clip);
    losses.addText(clip, true);
    const std::size_t room = bandsOfLevel2 - (played.transients.empty() ? 0 : 2); // events take up to two
    if (played.bands.size() > room)
    {
        losses.add(LossKind::bands, 0.0, clip.duration, 0.0,
                   fmt::format("{} bands share {}", played.bands.size(), room));
        mergeVoices(played, room);
    }
    Writer writer(played, voices.events, params);
    writer.losses = std::move(losses);
    std::string text = writer.write(nameOfClip(clip, params.name)); // finds losses
    return oneFile(std::move(text), std::move(writer.losses));
}

} // namespace pacini
