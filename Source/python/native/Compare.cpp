// Comparison of a haptic signal with its sound, by all measures.

#include "python/native/Support.h"

#include <pacini/evaluate/Comparison.h>
#include <pacini/filters/Resampler.h>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pacini::python
{

namespace
{
nb::object orNone(const auto& value)
{
    return value ? nb::cast(*value) : nb::none();
}

nb::dict eventsOf(const EventScore& score)
{
    nb::dict result;
    result["f1"] = score.f;
    result["hits"] = score.truePositives;
    result["spurious"] = score.falsePositives;
    result["missed"] = score.falseNegatives;
    return result;
}

nb::dict partsOf(const HtsScore& score)
{
    nb::dict result;
    result["wide"] = score.wide;
    result["band"] = score.band;
    result["spectrum"] = score.spectrum;
    result["event"] = score.event;
    return result;
}

nb::dict partsOf(const MatchParts& parts)
{
    nb::dict result;
    result["attacks"] = parts.attacks;
    result["envelope"] = parts.envelope;
    result["roughness"] = parts.roughness;
    result["brightness"] = parts.brightness;
    result["movement"] = parts.movement;
    result["silence"] = parts.silence;
    return result;
}

nb::dict impressionOf(const FeltFigures& figures)
{
    const FeltImpression impression = feltImpression(figures);
    nb::dict parts;
    parts["level"] = figures.level;
    parts["meanLevel"] = figures.meanLevel;
    parts["octave"] = figures.octave;
    parts["pulses"] = figures.pulses;
    parts["fluctuation"] = figures.fluctuation;
    nb::dict result;
    result["strength"] = impression.strength;
    result["tempo"] = impression.tempo;
    result["roughness"] = impression.roughness;
    result["parts"] = parts;
    return result;
}

/// The keys of `pacini compare --json`.
nb::dict dictOf(const Comparison& comparison)
{
    nb::dict result;
    result["duration"] = comparison.duration;
    result["candidateDuration"] = comparison.candidateDuration;
    for (const ComparisonFigure& figure : comparisonFigures)
        result[nb::str(figure.key.data(), figure.key.size())] = orNone(figure.value(comparison));
    result["matchLag"] = comparison.match ? nb::cast(comparison.matchLag) : nb::none();
    result["matchAligned"] = comparison.aligned;
    result["matchParts"] = comparison.match ? nb::object(partsOf(*comparison.match)) : nb::none();
    result["impression"] = impressionOf(comparison.impression);
    result["htsParts"] = partsOf(comparison.hts);
    result["htsFParts"] = partsOf(comparison.htsFidelity);
    result["lag"] = orNone(comparison.measures.lag);
    result["gain"] = orNone(comparison.measures.gain);
    result["outOfBand"] = orNone(comparison.measures.outOfBand);
    result["notFinite"] = comparison.notFinite;
    result["silentReference"] = comparison.measures.silentReference;
    result["events"] = comparison.events ? nb::object(eventsOf(*comparison.events)) : nb::none();
    return result;
}

void checkRate(const char* where, int rate)
{
    if (rate < lowestResamplerRate || rate > highestResamplerRate)
        raise({ErrorCode::invalidArgument, where, "must be 2000 to 768000 Hz"});
}

struct MonoSound
{
    std::vector<float> samples;
    int rate = 0;
};

MonoSound monoSound(const SoundArray& array, const char* where, int rate)
{
    checkRate(where, rate);
    const SoundView sound = soundOf(array);
    if (static_cast<double>(sound.frames) / rate > limits::duration)
        raise({ErrorCode::tooLarge, "sound", "is longer than 24 hours; cut it into parts"});
    return {unlocked([&] { return monoOf(sound); }), rate};
}

void checkTimes(const char* where, const std::optional<std::vector<double>>& times)
{
    for (std::size_t i = 0; times && i < times->size(); ++i)
        if (!std::isfinite((*times)[i]))
            raise({ErrorCode::notFinite, std::string(where) + "[" + std::to_string(i) + "]", "must be a finite time"});
}

/// Keeps transforms between the comparisons of a thread.
thread_local std::shared_ptr<Comparer> kept;

nb::dict compareSounds(const SoundArray& reference, int referenceRate, const SoundArray& candidate, int candidateRate,
                       std::optional<std::vector<double>> onsets, std::optional<std::vector<double>> events,
                       std::vector<double> ambiguous)
{
    MonoSound source = monoSound(reference, "sample_rate", referenceRate);
    MonoSound target = monoSound(candidate, "candidate_rate", candidateRate);
    checkTimes("onsets", onsets);
    checkTimes("events", events);
    checkTimes("ambiguous", ambiguous);
    auto comparer = std::exchange(kept, nullptr);
    if (!comparer)
        comparer = std::make_shared<Comparer>();
    auto compared = abandonable(
        [comparer, source = std::move(source), target = std::move(target), onsets = std::move(onsets),
         events = std::move(events), ambiguous = std::move(ambiguous)]() -> Result<Comparison>
        {
            if (auto done = comparer->setReference(source.samples, source.rate); !done)
                return done.error();
            if (auto done = comparer->setCandidate(target.samples, target.rate); !done)
                return done.error();
            Comparison comparison = comparer->compare();
            if (onsets)
                scoreEvents(comparison, *onsets, events ? *events : comparer->onsets(), ambiguous);
            return comparison;
        });
    kept = std::move(comparer);
    return dictOf(take(std::move(compared)));
}
} // namespace

void bindCompare(nb::module_& module)
{
    module.def("compare", &compareSounds, "reference"_a, "reference_rate"_a, "candidate"_a, "candidate_rate"_a,
               "onsets"_a.none(), "events"_a.none(), "ambiguous"_a);
}

} // namespace pacini::python
