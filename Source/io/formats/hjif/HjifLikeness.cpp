#include "io/formats/hjif/HjifLikeness.h"

#include "io/formats/hjif/HjifEvents.h"
#include "io/formats/hjif/HjifFormat.h"

#include <pacini/evaluate/EventMatching.h>
#include <pacini/evaluate/Hts.h>
#include <pacini/foundation/SizeInMemory.h>
#include <pacini/synthesis/Decoder.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>

namespace pacini
{

namespace
{
constexpr double rate = HtsFeatures::sampleRate;
constexpr double eventTolerance = 0.006; // s: HTS has 8 ms, of which the render itself takes some

std::vector<float> played(const Clip& clip, DecoderParams params)
{
    params.sampleRate = rate;
    Decoder decoder(clip, params);
    std::vector<float> samples(std::max<std::size_t>(sizeInMemory(decoder.totalFrames()), 1));
    decoder.process(samples);
    return samples;
}

/// Adds `amplitude` times shape(s since `time`) over `length` s.
template <typename Shape>
void addPulse(std::vector<float>& samples, double time, double length, double amplitude, Shape shape)
{
    if (amplitude <= 0.0)
        return;
    const auto end = std::min(static_cast<std::size_t>(std::ceil((time + length) * rate)), samples.size());
    for (auto n = static_cast<std::size_t>(std::ceil(time * rate)); n < end; ++n)
        samples[n] += static_cast<float>(amplitude * shape(static_cast<double>(n) / rate - time));
}

std::vector<float> playedAsFile(const Clip& file, const std::vector<HjifEvent>& events)
{
    Clip waves = file;
    waves.transients.clear();
    std::vector<float> samples = played(waves, {});
    constexpr double tau = 2.0 * std::numbers::pi;
    for (std::size_t i = 0; i < events.size(); ++i)
    {
        const HjifEvent& event = events[i];
        const double time = file.transients[i].time;
        addPulse(samples, time, hjifTransientLength, event.tap,
                 [](double since) { return std::sin(2.0 * tau * since / hjifTransientLength); });
        addPulse(samples, time, event.length, event.wave,
                 [&](double since) { return hannAt(since / event.length) * std::sin(tau * event.frequency * since); });
    }
    return samples;
}

/// Mean difference of levels where either is felt, as a share of the difference that counts as a complete mismatch.
class LevelDistance
{
public:
    LevelDistance(double strongestWanted, double gainOfHeard)
        : strongest(std::max(strongestWanted, 1e-12)), gain(gainOfHeard)
    {
    }

    void add(std::span<const float> wanted, std::span<const float> heard)
    {
        constexpr double another = 12.0; // dB
        for (std::size_t i = 0; i < std::min(wanted.size(), heard.size()); ++i)
        {
            const double a = detail::sensationLevel(static_cast<double>(wanted[i]), strongest);
            const double b = detail::sensationLevel(gain * static_cast<double>(heard[i]), strongest);
            const double weight = std::max(a, b);
            total += weight;
            apart += weight * std::min(std::abs(a - b) / another, 1.0);
        }
    }

    [[nodiscard]] double value() const { return partOf(*this); }

    /// What of `whole` is in here.
    [[nodiscard]] double partOf(const LevelDistance& whole) const
    {
        return whole.total > 0.0 ? apart / whole.total : 0.0;
    }

private:
    double strongest, gain;
    double total = 0.0, apart = 0.0;
};

/// The values from `first` to before `end`, both in s, and one at least, of a track with one every `spacing` s.
template <typename Track>
auto partOf(const Track& track, double spacing, double first, double end)
{
    const auto size = static_cast<double>(track.size());
    const double from = std::min(std::floor(std::max(first, 0.0) / spacing), size);
    const double to = std::min(std::max(std::floor(end / spacing), from + 1.0), size);
    return std::span(track).subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(to - from));
}

/// Distances of the levels of both, all together and in parts.
class LevelDistances
{
public:
    LevelDistances(const HtsFeatures& ownFeatures, const HtsFeatures& heardFeatures)
        : own(ownFeatures),
          heard(heardFeatures),
          gain(std::sqrt(detail::energy(own.felt) / std::max(detail::energy(heard.felt), 1e-30))),
          strongest(detail::highest(own.felt))
    {
        for (const auto& frame : own.spectrum)
            strongestCell = std::max(strongestCell, detail::highest(frame));
        all = between(0.0, std::numeric_limits<double>::infinity());
    }

    [[nodiscard]] double value() const { return all.weighted(all); }

    /// What of it lies in a part, from and to in s.
    [[nodiscard]] double valueOf(double from, double to) const { return between(from, to).weighted(all); }

private:
    struct Three
    {
        LevelDistance wide, bands, spectrum;

        [[nodiscard]] double weighted(const Three& whole) const
        {
            return 35.0 * wide.partOf(whole.wide) + 20.0 * bands.partOf(whole.bands) +
                   20.0 * spectrum.partOf(whole.spectrum);
        }
    };

    [[nodiscard]] Three between(double from, double to) const
    {
        constexpr double envelopeStep = HtsFeatures::envelopeSpacing / rate;
        constexpr double frameStep = 0.064; // s
        // Features are scaled by powers of two.
        Three found{{strongest, gain}, {strongest, gain}, {strongestCell, gain}};
        found.wide.add(partOf(own.felt, envelopeStep, from, to), partOf(heard.felt, envelopeStep, from, to));
        for (std::size_t k = 0; k < HtsFeatures::bandCount; ++k)
            found.bands.add(partOf(own.bands[k], envelopeStep, from, to),
                            partOf(heard.bands[k], envelopeStep, from, to));
        const auto wanted = partOf(own.spectrum, frameStep, from, to);
        const auto played = partOf(heard.spectrum, frameStep, from, to);
        for (std::size_t m = 0; m < std::min(wanted.size(), played.size()); ++m)
            found.spectrum.add(wanted[m], played[m]);
        return found;
    }

    const HtsFeatures& own;
    const HtsFeatures& heard;
    double gain, strongest;
    double strongestCell = 0.0;
    Three all{{0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0}};
};

void addUnmatched(std::vector<double>& unmatched, const std::vector<double>& events, const std::vector<double>& others)
{
    for (const double time : events)
    {
        const auto next = std::lower_bound(others.begin(), others.end(), time - eventTolerance);
        if (next == others.end() || *next > time + eventTolerance)
            unmatched.push_back(time);
    }
}
} // namespace

HjifLikeness::HjifLikeness(const Clip& clip, const DecoderParams& decoder)
    : own(analyzer.analyze(std::span<const float>(played(clip, decoder)), HtsRole::candidate))
{
}

HtsFeatures HjifLikeness::featuresOf(const Clip& file, const std::vector<HjifEvent>& events)
{
    return analyzer.analyze(std::span<const float>(playedAsFile(file, events)), HtsRole::candidate);
}

HjifDistance HjifLikeness::distanceTo(const Clip& file, const std::vector<HjifEvent>& events)
{
    const HtsFeatures heard = featuresOf(file, events);
    HjifDistance distance{LevelDistances(own, heard).value(), {}};
    // An event is one thing that changes, not 5 ms of many: it weighs half as much again as in HTS.
    constexpr double points = 1.5 * 25.0;
    const auto both = static_cast<double>(own.feltEvents.size() + heard.feltEvents.size());
    const auto hits = static_cast<double>(matchEvents(own.feltEvents, heard.feltEvents, eventTolerance).size());
    if (both > 0.0)
        distance.value += points * (1.0 - 2.0 * hits / both);
    addUnmatched(distance.events, own.feltEvents, heard.feltEvents);
    addUnmatched(distance.events, heard.feltEvents, own.feltEvents);
    return distance;
}

std::vector<double> HjifLikeness::distancesAround(const Clip& file, const std::vector<HjifEvent>& events)
{
    constexpr double before = 0.02, after = 0.06; // s
    constexpr double rises = 0.004;               // s: an event is felt when it has risen
    constexpr double points = 25.0;               // as in HTS
    const HtsFeatures heard = featuresOf(file, events);
    std::vector<double> wanted, unmatched, distances;
    for (const Transient& event : file.transients)
        wanted.push_back(event.time + rises);
    addUnmatched(unmatched, wanted, heard.feltEvents);
    addUnmatched(unmatched, heard.feltEvents, wanted);
    const auto both = static_cast<double>(wanted.size() + heard.feltEvents.size());
    const LevelDistances levels(own, heard);
    for (const Transient& event : file.transients)
    {
        const auto isHere = [&](double time)
        {
            return time > event.time - before && time < event.time + after;
        };
        const auto lost = static_cast<double>(std::count_if(unmatched.begin(), unmatched.end(), isHere));
        distances.push_back(levels.valueOf(event.time - before, event.time + after) + points * lost / both);
    }
    return distances;
}

} // namespace pacini
