#include "io/formats/hjif/HjifModel.h"

#include "io/formats/ForeignText.h"
#include "io/formats/VoiceReduction.h"
#include "io/formats/hjif/HjifEvents.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/hjif/HjifVoices.h"

#include <pacini/synthesis/VoiceMerge.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace pacini
{

namespace
{
constexpr double ticksPerSecond = 1000.0;
constexpr double outputRate = 8000.0; ///< Hz, of players that ask the file
constexpr std::size_t bandsOfLevel1 = 7;
constexpr std::size_t bandsOfLevel2 = 63;

struct Values
{
    std::optional<double> amplitude, frequency;
};
using Keyframes = std::map<std::int64_t, Values>;

std::int64_t tickOf(double time)
{
    return std::llround(time * ticksPerSecond);
}

double hertz(double value)
{
    return std::max(1.0, std::round(value));
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

/// What the waves or the events of a clip make together.
struct HjifRange
{
    HjifBand band;
    double lowest = limits::frequency, highest = 0.0;

    void add(HjifEffect effect, double low, double high)
    {
        band.effects.push_back(std::move(effect));
        lowest = std::min(lowest, low);
        highest = std::max(highest, high);
    }
    [[nodiscard]] HjifBand taken(const char* type)
    {
        band.type = type;
        band.low = std::floor(lowest);
        band.high = std::ceil(highest);
        return std::move(band);
    }
};

class Model
{
public:
    Model(const Clip& clipToWrite, const std::vector<HjifEvent>& eventsToWrite, const ExportParams& wanted,
          const HjifModelParams& limitsOfFile, LossList& lossesFound)
        : clip(clipToWrite),
          told(eventsToWrite),
          params(wanted),
          most(limitsOfFile),
          losses(lossesFound),
          gain(std::max(most.lowestGain, std::ceil(highestSum(clip, told) * most.gainSteps) / most.gainSteps))
    {
    }

    HjifFile file()
    {
        HjifChannel channel{
            .gain = gain, .rate = outputRate, .samples = std::round(clip.duration * outputRate), .bands = {}};
        for (const Band& band : clip.bands)
            if (std::any_of(band.amplitude.begin(), band.amplitude.end(), [](const auto& p) { return p.value > 0.0; }))
                channel.bands.push_back(vectorialBand(band));
        addEvents(channel.bands);
        if (channel.bands.empty())
            losses.add(LossKind::empty, 0.0, clip.duration, 0.0, "nothing sounds");
        if (movedTime > 1e-9)
            losses.add(LossKind::timeStep, 0.0, clip.duration, movedTime, "times are rounded to milliseconds");
        if (bentPitch > 1e-9)
            losses.add(LossKind::frequency, 0.0, clip.duration, bentPitch, "frequencies are rounded to 1 Hz");
        HjifFile made;
        made.ticks = ticksPerSecond;
        made.perceptions.push_back({.modality = "Vibrotactile", .library = {}, .channels = {}});
        made.perceptions.back().channels.push_back(std::move(channel));
        return made;
    }

private:
    HjifBand vectorialBand(const Band& band)
    {
        const Curve amplitude =
            params.amplitudePoints ? thinned(band.amplitude, *params.amplitudePoints, clip.duration) : band.amplitude;
        losses.addThinned(band.amplitude, amplitude);
        Curve pitch = params.frequencyPoints ? thinned(band.pitch, *params.frequencyPoints, clip.duration) : band.pitch;
        if (pitch.empty())
            pitch = {{0.0, std::max(band.centreFrequency, 1.0)}};
        HjifRange range;
        range.lowest = band.lowFrequency;
        range.highest = band.highFrequency;
        for (const Breakpoint& point : pitch)
        {
            const double rounded = hertz(point.value);
            bentPitch = std::max(bentPitch, std::abs(std::log2(rounded / point.value)));
            range.lowest = std::min(range.lowest, rounded);
            range.highest = std::max(range.highest, rounded);
        }
        for (const Curve& sound : soundsOf(amplitude))
            for (const Curve& piece : piecesOf(sound))
                range.band.effects.push_back(effect(piece, pitch, band.phase));
        return range.taken("VectorialWave");
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

    /// A sound in pieces that are no longer than an effect may be.
    [[nodiscard]] std::vector<Curve> piecesOf(const Curve& sound) const
    {
        std::vector<Curve> pieces(1);
        for (const Breakpoint& point : sound)
        {
            while (!pieces.back().empty() && point.time - pieces.back().front().time > most.longestEffect)
            {
                const Breakpoint cut{pieces.back().front().time + most.longestEffect,
                                     valueAt(sound, pieces.back().front().time + most.longestEffect)};
                if (pieces.back().back().time < cut.time)
                    pieces.back().push_back(cut);
                pieces.push_back({cut});
            }
            pieces.back().push_back(point);
        }
        return pieces;
    }

    /// One effect, whose wave goes on from where a wave of `firstPhase` cycles at the start of the clip would be.
    HjifEffect effect(const Curve& sound, const Curve& pitch, double firstPhase)
    {
        Keyframes keyframes;
        movedTime = std::max(movedTime, putOnTicks(sound, [&](std::int64_t tick, double value)
                                                   { keyframes[tick].amplitude = value / gain; }));
        const std::int64_t start = keyframes.begin()->first;
        const std::int64_t end = keyframes.rbegin()->first;
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
        HjifEffect made = effectAt(start);
        made.phase = 2.0 * std::numbers::pi * (cycles - std::floor(cycles));
        for (const auto& [tick, values] : keyframes)
            made.keyframes.push_back({static_cast<double>(tick - start), values.amplitude, values.frequency});
        return made;
    }

    [[nodiscard]] static HjifEffect effectAt(std::int64_t tick)
    {
        HjifEffect made;
        made.type = "Basis";
        made.position = static_cast<double>(tick);
        return made;
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

    void addEvents(std::vector<HjifBand>& bands)
    {
        HjifRange transients, waves;
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
                HjifEffect tap = effectAt(tick);
                tap.keyframes.push_back({0.0, told[i].tap / gain, std::round(place)});
                transients.add(std::move(tap), hjifDullFrequency, hjifSharpFrequency);
            }
        }
        if (!transients.band.effects.empty())
            bands.push_back(transients.taken("Transient"));
        if (!waves.band.effects.empty())
            bands.push_back(waves.taken("VectorialWave"));
    }

    /// A few periods under a Hann window, as the decoder plays an event, in straight lines: between keyframes of every
    /// eighth of it, its peak among them, they are within 4 % of its height.
    [[nodiscard]] HjifEffect wavePulse(std::int64_t tick, const HjifEvent& event) const
    {
        constexpr std::int64_t pieces = 8;
        const std::int64_t half = std::llround(0.5 * event.length * ticksPerSecond); // 3 ms at least
        HjifEffect made = effectAt(tick);
        made.phase = 0.0;
        std::int64_t last = -1;
        for (std::int64_t n = 0; n <= pieces; ++n)
        {
            const std::int64_t at = (2 * half * n + pieces / 2) / pieces;
            if (at == last)
                continue;
            const double place = static_cast<double>(at) / static_cast<double>(2 * half);
            made.keyframes.push_back({static_cast<double>(at), hannAt(place) * event.wave / gain, {}});
            last = at;
        }
        made.keyframes.front().frequency = event.frequency;
        return made;
    }

    const Clip& clip;
    const std::vector<HjifEvent>& told;
    const ExportParams& params;
    const HjifModelParams most;
    LossList& losses;
    double gain; ///< of the channel: amplitudes are at most 1, and a player cuts the sum of the bands there
    double movedTime = 0.0, bentPitch = 0.0;
};
} // namespace

HjifFile hjifModelOf(const Clip& clip, const ExportParams& params, LossList& losses, const HjifModelParams& limits)
{
    HjifVoices voices = hjifVoicesOf(clip, losses, params.quick ? HjifEffort::usual : HjifEffort::search,
                                     params.events.value_or(hjifEvents));
    Clip& played = voices.clip;
    losses.addNoise(clip);
    losses.addText(clip, true);
    const std::size_t room = bandsOfLevel2 - (played.transients.empty() ? 0 : 2); // events take up to two
    if (played.bands.size() > room)
    {
        losses.addShared(clip, played.bands.size(), room);
        mergeVoices(played, room);
    }
    HjifFile file = Model(played, voices.events, params, limits, losses).file();
    file.description = nameOfClip(clip, params.name);
    return file;
}

HjifProfile hjifProfileOf(const HjifFile& file)
{
    for (const HjifPerception& perception : file.perceptions)
        for (const HjifChannel& channel : perception.channels)
            if (channel.bands.size() > bandsOfLevel1)
                return {"Main", 2};
    return {"Simple Parametric", 1};
}

} // namespace pacini
