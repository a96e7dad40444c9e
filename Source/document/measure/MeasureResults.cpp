#include "document/measure/MeasureResults.h"

#include "document/measure/MeasureWords.h"

#include <pacini/linearize/EqualizedSweep.h>
#include <pacini/linearize/EqualizerFit.h>
#include <pacini/linearize/MeasuredProfile.h>
#include <pacini/linearize/SweepAnalysis.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace pacini
{

namespace
{
std::vector<FrequencyResponse> responsesOf(const Placements& placements)
{
    std::vector<FrequencyResponse> responses;
    for (const auto& placement : placements)
        responses.push_back(placement->measurement.response());
    return responses;
}

/// Outliers by name, and each note once.
std::vector<std::string> notesOf(const Placements& placements, const PlacementAverage& average)
{
    std::vector<std::string> notes;
    for (const PlacementOutlier& outlier : average.outliers)
        notes.push_back(
            fmt::format("'{}' differs from the others and was left out: {:+.1f} dB, shape off by {:.1f} dB.",
                        placements[outlier.index]->name, outlier.offset, outlier.shape));
    for (const auto& placement : placements)
        for (const std::string& note : placement->notes)
            if (std::find(notes.begin(), notes.end(), note) == notes.end())
                notes.push_back(note);
    return notes;
}

Error plain(const Error& error)
{
    return {error.code, {}, explain(error, {})};
}

/// Why there is no result. Noise that was taken for a sweep shows itself by a drift that one clock cannot have, and an
/// overload can hide a sweep.
std::string whyNothing(Error error, const RecordedSweep& recorded)
{
    if (recorded.oneClock && error.where == "clock")
        error.where = "channels";
    std::vector<MeasurementWarning> seen;
    if (checkRecording(recorded.channels))
        warnOfChannels(recorded.channels, recorded.sampleRate, seen);
    for (const MeasurementWarning& warning : seen)
        if (warning.code == MeasurementDefect::clipping)
            return explain(warning, recorded.inputs);
    return explain(error, recorded.inputs);
}

/// Whether the warning says that the channel shows no movement.
bool showsNothing(const MeasurementWarning& warning)
{
    return warning.code == MeasurementDefect::loopback || warning.code == MeasurementDefect::noiseChannel ||
           warning.code == MeasurementDefect::silentChannel;
}
} // namespace

Result<Placement> analysePlacement(const std::string& name, const RecordedSweep& recorded,
                                   const MeasureSettings& settings)
{
    MeasurementParams params = analysisOf(settings);
    params.equalized = recorded.equalized;
    auto measured = analyseSweeps(recorded.channels, recorded.sampleRate, recorded.sweep, params);
    if (!measured)
        return Error{measured.error().code, {}, whyNothing(measured.error(), recorded)};
    Placement placement{name, std::move(measured).value(), recorded.sweep.levels.front(), {}, false};
    takeOut(placement.measurement, recorded.gain);
    std::set<std::string> useless;
    for (const MeasurementWarning& warning : placement.measurement.warnings)
    {
        placement.notes.push_back(explain(warning, recorded.inputs));
        if (showsNothing(warning))
            useless.insert(warning.where);
        placement.spoiled = placement.spoiled || warning.code == MeasurementDefect::clipping ||
                            warning.code == MeasurementDefect::droppedFrames;
    }
    if (useless.size() >= recorded.channels.size())
        return Error{ErrorCode::invalidData, {}, placement.notes.front()};
    return placement;
}

Result<MeasuredResponse> summarisePlacements(const Placements& placements)
{
    const auto responses = responsesOf(placements);
    auto average = averagePlacements(responses);
    if (!average)
        return plain(average.error());
    std::vector<const SweepMeasurement*> measured;
    for (const auto& placement : placements)
        measured.push_back(&placement->measurement);
    constexpr double distortionLimit = 10.0; // %
    auto findings = findingsOf(measured, *average, MeasurementParams{}.smoothing, distortionLimit);
    if (!findings)
        return plain(findings.error());
    auto notes = notesOf(placements, *average);
    return MeasuredResponse{std::move(average).value(), std::move(findings).value(), std::move(notes)};
}

Result<FittedEqualizer> fitFor(const MeasuredResponse& response, const EqualizerRequest& request, const Profile& base,
                               double rate)
{
    const FrequencyResponse& measured = response.average.response;
    const FrequencyRange& felt = response.findings.features.felt;
    FittedEqualizer fitted;
    fitted.lowFrequency = request.lowFrequency > 0.0 ? request.lowFrequency : felt.low;
    fitted.highFrequency = request.highFrequency > 0.0 ? request.highFrequency : felt.high;
    EqualizerFitParams params;
    params.sampleRate = rate;
    params.sections = request.sections;
    params.maxBoost = request.maxBoost;
    params.lowFrequency = fitted.lowFrequency;
    params.highFrequency = fitted.highFrequency;
    params.goalMax = 0.75; // dB: with what a second measurement adds it stays within 1
    params.goalRms = 0.25;
    auto fit = fitEqualizer(measured, params);
    if (!fit)
        return plain(fit.error());
    fitted.fit = std::move(fit).value();
    fitted.predicted = measured;
    const auto filter = designEqualizer(fitted.fit.sections, rate);
    for (std::size_t i = 0; i < measured.size(); ++i)
        fitted.predicted.level[i] +=
            Decibels::fromGain(std::abs(filter.response(Hertz(measured.frequency[i]), rate))).value;
    const auto linearity = judgeLinearity(fitted.predicted, {fitted.lowFrequency, fitted.highFrequency, 1.0});
    if (!linearity)
        return plain(linearity.error());
    fitted.predictedLinearity = *linearity;
    Profile actuator = base;
    setMeasurement(actuator, measured, response.findings, 1, 0.0, false);
    fitted.cost = equalizerCost(actuator, fitted.fit.sections, rate);
    return fitted;
}

Result<VerifiedResponse> verifyResponse(const Placements& swept, const MeasuredResponse& response,
                                        const FittedEqualizer& equalizer, double tolerance)
{
    const auto responses = responsesOf(swept);
    auto average = averagePlacements(responses);
    if (!average)
        return plain(average.error());
    const LinearityParams params{equalizer.lowFrequency, equalizer.highFrequency, tolerance};
    const auto after = judgeLinearity(average->response, params);
    if (!after)
        return plain(after.error());
    const auto before = judgeLinearity(response.average.response, params);
    if (!before)
        return plain(before.error());
    auto notes = notesOf(swept, *average);
    return VerifiedResponse{std::move(average->response), *after, *before, std::move(notes)};
}

Result<VerifyingSweep> verifyingSweep(const MeasureSettings& settings, const EqualizerSections& sections,
                                      double sampleRate, bool raised)
{
    auto made = makeEqualizedSweep(sweepOf(settings, sampleRate), sections, raised);
    if (!made)
        return plain(made.error());
    return VerifyingSweep{std::move(made->signal), std::move(made->sweep), made->gain};
}

} // namespace pacini
