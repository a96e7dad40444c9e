#pragma once

// Report of a comparison: its keys, common to JSON and dictionaries.

#include <pacini/evaluate/Comparison.h>

#include <optional>

namespace pacini
{

/// Reports the counts of an event score to `sink`.
void reportEvents(const EventScore& score, auto& sink)
{
    sink.value("f1", score.f);
    sink.value("hits", score.truePositives);
    sink.value("spurious", score.falsePositives);
    sink.value("missed", score.falseNegatives);
}

/// Reports the parts of a haptic translation score to `sink`.
void reportHts(const HtsScore& score, auto& sink)
{
    sink.value("wide", score.wide);
    sink.value("band", score.band);
    sink.value("spectrum", score.spectrum);
    sink.value("event", score.event);
}

/// Reports the parts of a predicted match to `sink`.
void reportMatch(const MatchParts& parts, auto& sink)
{
    sink.value("attacks", parts.attacks);
    sink.value("envelope", parts.envelope);
    sink.value("roughness", parts.roughness);
    sink.value("brightness", parts.brightness);
    sink.value("movement", parts.movement);
    sink.value("silence", parts.silence);
}

/// Reports the predicted impression of a candidate, and the parts of its prediction, to `sink`.
void reportImpression(const FeltFigures& figures, auto& sink)
{
    const FeltImpression impression = feltImpression(figures);
    sink.value("strength", impression.strength);
    sink.value("tempo", impression.tempo);
    sink.value("roughness", impression.roughness);
    sink.group("parts",
               [&](auto& parts)
               {
                   parts.value("level", figures.level);
                   parts.value("meanLevel", figures.meanLevel);
                   parts.value("octave", figures.octave);
                   parts.value("pulses", figures.pulses);
                   parts.value("fluctuation", figures.fluctuation);
               });
}

/// Reports a whole comparison to `sink`, in the order of reports. A sink has `value(key, number or bool or optional of
/// these)`, `none(key)` and `group(key, fill)`, which calls `fill` with a sink for the entries below the key.
void reportComparison(const Comparison& comparison, auto& sink)
{
    sink.value("duration", comparison.duration);
    sink.value("candidateDuration", comparison.candidateDuration);
    for (const ComparisonFigure& figure : comparisonFigures)
        sink.value(figure.key, figure.value(comparison));
    sink.value("matchLag", comparison.match ? std::optional(comparison.matchLag) : std::nullopt);
    sink.value("matchAligned", comparison.aligned);
    if (comparison.match)
        sink.group("matchParts", [&](auto& parts) { reportMatch(*comparison.match, parts); });
    else
        sink.none("matchParts");
    sink.group("impression", [&](auto& parts) { reportImpression(comparison.impression, parts); });
    sink.group("htsParts", [&](auto& parts) { reportHts(comparison.hts, parts); });
    sink.group("htsFParts", [&](auto& parts) { reportHts(comparison.htsFidelity, parts); });
    sink.value("lag", comparison.measures.lag);
    sink.value("gain", comparison.measures.gain);
    sink.value("outOfBand", comparison.measures.outOfBand);
    sink.value("notFinite", comparison.notFinite);
    sink.value("silentReference", comparison.measures.silentReference);
    if (comparison.events)
        sink.group("events", [&](auto& parts) { reportEvents(*comparison.events, parts); });
    else
        sink.none("events");
}

} // namespace pacini
