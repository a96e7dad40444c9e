// Comparison of a haptic signal with its sound, by all measures.

#include "python/native/Support.h"

#include <pacini/evaluate/ComparisonReport.h>
#include <pacini/filters/Resampler.h>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini::python
{

namespace
{
/// Sink of a report that fills a dictionary.
struct DictSink
{
    nb::dict dict;

    static nb::str key(std::string_view name) { return nb::str(name.data(), name.size()); }

    template <typename Value>
    void value(std::string_view name, const Value& value)
    {
        dict[key(name)] = value;
    }
    void none(std::string_view name) { dict[key(name)] = nb::none(); }
    void group(std::string_view name, auto&& fill)
    {
        DictSink inner;
        fill(inner);
        dict[key(name)] = inner.dict;
    }
};

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

/// Keep transforms between the comparisons of a thread, which refuse what no sound has, or take it as silence.
thread_local std::array<std::shared_ptr<Comparer>, 2> kept;

nb::dict compareSounds(const SoundArray& reference, int referenceRate, const SoundArray& candidate, int candidateRate,
                       std::optional<std::vector<double>> onsets, std::optional<std::vector<double>> events,
                       std::vector<double> ambiguous, bool allowNan)
{
    MonoSound source = monoSound(reference, "sample_rate", referenceRate);
    MonoSound target = monoSound(candidate, "candidate_rate", candidateRate);
    checkTimes("onsets", onsets);
    checkTimes("events", events);
    checkTimes("ambiguous", ambiguous);
    auto comparer = std::exchange(kept[allowNan ? 1 : 0], nullptr);
    if (!comparer)
        comparer = std::make_shared<Comparer>(allowNan ? UnsoundFrames::silence : UnsoundFrames::refuse);
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
    kept[allowNan ? 1 : 0] = std::move(comparer);
    if (!compared && compared.error().code == ErrorCode::notFinite)
        raise({ErrorCode::notFinite, compared.error().where,
               compared.error().message + "; repair the sound, or take such samples as silence with allow_nan"});
    DictSink sink;
    reportComparison(take(std::move(compared)), sink);
    return sink.dict;
}
} // namespace

void bindCompare(nb::module_& module)
{
    module.def("compare", &compareSounds, "reference"_a, "reference_rate"_a, "candidate"_a, "candidate_rate"_a,
               "onsets"_a.none(), "events"_a.none(), "ambiguous"_a, "allow_nan"_a);
}

} // namespace pacini::python
