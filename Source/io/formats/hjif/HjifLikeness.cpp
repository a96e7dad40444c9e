#include "io/formats/hjif/HjifLikeness.h"

#include "io/formats/hjif/HjifEvents.h"
#include "io/formats/hjif/HjifFormat.h"

#include <pacini/evaluate/EventMatching.h>
#include <pacini/evaluate/Hts.h>
#include <pacini/synthesis/Decoder.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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
    std::vector<float> samples(static_cast<std::size_t>(std::max<std::int64_t>(decoder.totalFrames(), 1)));
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

std::vector<float> playedAsFile(const Clip& file)
{
    Clip waves = file;
    waves.transients.clear();
    std::vector<float> samples = played(waves, {});
    const std::vector<HjifEvent> events = hjifEventsOf(file);
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

/// Mean difference of levels where either is felt, as a share of what counts as another level altogether.
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

    [[nodiscard]] double value() const { return total > 0.0 ? apart / total : 0.0; }

private:
    double strongest, gain;
    double total = 0.0, apart = 0.0;
};

double levelDistance(const HtsFeatures& own, const HtsFeatures& heard)
{
    // Features are scaled by powers of two.
    const double gain = std::sqrt(detail::energy(own.felt) / std::max(detail::energy(heard.felt), 1e-30));
    const double strongest = detail::highest(own.felt);
    LevelDistance wide(strongest, gain), bands(strongest, gain);
    wide.add(own.felt, heard.felt);
    for (std::size_t k = 0; k < HtsFeatures::bandCount; ++k)
        bands.add(own.bands[k], heard.bands[k]);
    double strongestCell = 0.0;
    for (const auto& frame : own.spectrum)
        strongestCell = std::max(strongestCell, detail::highest(frame));
    LevelDistance spectrum(strongestCell, gain);
    for (std::size_t m = 0; m < std::min(own.spectrum.size(), heard.spectrum.size()); ++m)
        spectrum.add(own.spectrum[m], heard.spectrum[m]);
    return 35.0 * wide.value() + 20.0 * bands.value() + 20.0 * spectrum.value();
}

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

HjifDistance HjifLikeness::distanceTo(const Clip& file)
{
    const auto heard = analyzer.analyze(std::span<const float>(playedAsFile(file)), HtsRole::candidate);
    HjifDistance distance{levelDistance(own, heard), {}};
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

} // namespace pacini
