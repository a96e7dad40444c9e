// Measuring an actuator: sweep, simulated recording, analysis, fit, verification.

#include "io/ProfileFields.h"
#include "io/SweepFile.h"
#include "python/native/Options.h"
#include "python/native/ProfileHandle.h"
#include "python/native/Support.h"

#include <pacini/actuator/Wearer.h>
#include <pacini/linearize/EqualizedSweep.h>
#include <pacini/linearize/EqualizerCost.h>
#include <pacini/linearize/EqualizerFit.h>
#include <pacini/linearize/MeasuredProfile.h>
#include <pacini/linearize/MeasurementFindings.h>
#include <pacini/linearize/PlacementAverage.h>
#include <pacini/linearize/RigSettings.h>
#include <pacini/linearize/SweepAnalysis.h>
#include <pacini/linearize/Verification.h>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
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

/// A sweep: what is played, and its description for the analysis.
std::pair<nb::object, nb::dict> makeSweep(double low, double high, bool lowGiven, double duration, double pause,
                                          int repeats, std::vector<double> levels, double rate,
                                          const ProfileHandle* profile)
{
    SweepFile file;
    SweepParams& params = file.sweep;
    params.lowFrequency = low;
    params.highFrequency = high;
    params.duration = duration;
    params.fadeIn = std::min(params.fadeIn, 0.25 * duration);
    params.pause = pause;
    params.repeats = repeats;
    params.levels = std::move(levels);
    params.sampleRate = rate;
    takeNamed(validate(params));
    EqualizerSections sections;
    if (profile != nullptr)
    {
        const Profile& actuator = profile->profile();
        if (actuator.equalizer.empty())
            raise({ErrorCode::invalidData, "equalizer", "is empty, so there is nothing to verify; fit one"});
        sections = actuator.equalizer;
        if (!lowGiven)
            params.lowFrequency =
                provingLowFrequency(params.lowFrequency, params.highFrequency, actuator.range.lowFrequency);
        file.equalizedFor = actuator.name;
    }
    auto played = take(abandonable([params, sections] { return makeEqualizedSweep(params, sections, true); }));
    params = played.sweep;
    file.gain = played.gain;
    nb::dict about;
    about["json"] = sweepJson(file);
    about["levels"] = params.levels;
    about["lowered"] = played.lowered;
    about["gain"] = played.gain;
    about["equalized_for"] = file.equalizedFor;
    return {toArray(std::move(played.signal)), about};
}

/// Channels one after the other, as an accelerometer on a worn actuator records them.
nb::object simulate(const SoundArray& array, double rate, const ProfileHandle& profile, int wearer, double contact,
                    double latency, double drift, double noise, double distortion, double range, int axes, int bits,
                    std::uint64_t seed)
{
    const Profile& actuator = profile.profile();
    if (!actuator.body || actuator.technology == Technology::erm)
        raise({ErrorCode::invalidData, actuator.body ? "technology" : "body",
               actuator.body ? "is a motor, which plays no sweep" : "is missing, so nothing can move"});
    const SoundView sound = soundOf(array);
    if (sound.channels != 1)
        raise({ErrorCode::invalidArgument, "sound", "must be mono: (frames,)"});
    if (!isPlayableRate(rate))
        raise({ErrorCode::invalidArgument, "sample_rate", "must be 2000 to 768000 Hz"});
    if (axes != 1 && axes != 3)
        raise({ErrorCode::invalidArgument, "axes", "must be 1 or 3"});
    const auto within = [](const char* where, double value, double low, double high)
    {
        if (!(value >= low && value <= high))
            raise({ErrorCode::invalidArgument, where, "must be " + numberText(low) + " to " + numberText(high)});
    };
    within("wearer", wearer, 0.0, simulatedWearers);
    within("contact", contact, -60.0, 20.0);
    within("latency", latency, 0.0, 1.0);
    within("drift", drift, -5000.0, 5000.0);
    within("noise", noise, 0.0, 1e6);
    within("distortion", distortion, -1.0, 1.0);
    within("range", range, 0.1, 10000.0);
    within("bits", bits, 4, 24);
    const RigParams rig = rigOn(static_cast<unsigned>(wearer), actuator,
                                {.contact = contact,
                                 .latency = latency,
                                 .drift = drift,
                                 .noise = noise,
                                 .distortion = distortion,
                                 .range = range,
                                 .axes = axes,
                                 .bits = bits,
                                 .seed = seed},
                                rate);
    std::vector<float> played = monoOf(sound);
    if (const auto wrong = std::find_if(played.begin(), played.end(),
                                        [](float sample) { return !areWithinLimit(std::span(&sample, 1)); });
        wrong != played.end())
        raise({ErrorCode::notFinite, "sound[" + std::to_string(wrong - played.begin()) + "]",
               "is not a number, or is far beyond full scale"});
    auto recorded = abandonable([samples = std::move(played), rig] { return recordOnRig(samples, rig); });
    const std::size_t channels = recorded.size();
    const std::size_t frames = recorded.front().size();
    std::vector<float> all;
    all.reserve(channels * frames);
    for (const std::vector<float>& channel : recorded)
        all.insert(all.end(), channel.begin(), channel.end());
    return toArray(std::move(all), {channels, frames});
}

/// An analysed recording.
struct RecordingHandle
{
    std::shared_ptr<const SweepMeasurement> measurement;
};

RecordingHandle analyse(const SoundArray& array, int rate, const std::string& sweepText, std::vector<double> fullScale,
                        double smoothing, std::size_t points)
{
    const SoundView sound = soundOf(array);
    if (sound.channels > 3)
        raise({ErrorCode::invalidArgument, "sound",
               "must have one to three channels: those of the accelerometer's axes or the microphone"});
    const SweepFile file = take(readSweepJson(sweepText));
    MeasurementParams params;
    params.smoothing = smoothing;
    params.points = points;
    params.equalized = !file.equalizedFor.empty();
    params.fullScale = std::move(fullScale);
    takeNamed(validate(params, sound.channels));
    std::vector<std::vector<float>> channels(sound.channels, std::vector<float>(sound.frames));
    for (std::size_t c = 0; c < sound.channels; ++c)
        for (std::size_t i = 0; i < sound.frames; ++i)
            channels[c][i] = sound.at(c, i);
    auto measured = take(abandonable([channels = std::move(channels), rate, file, params]
                                     { return analyseSweeps(channels, rate, file.sweep, params); }));
    takeOut(measured, file.gain);
    return {std::make_shared<const SweepMeasurement>(std::move(measured))};
}

nb::dict responseOf(const FrequencyResponse& response)
{
    nb::dict result;
    result["frequency"] = toArray(std::vector<double>(response.frequency));
    result["level"] = toArray(std::vector<double>(response.level));
    return result;
}

nb::dict levelOf(const LevelMeasurement& level)
{
    nb::dict result = responseOf(level.response);
    result["drive"] = level.level;
    result["snr"] = toArray(std::vector<double>(level.snr.level));
    result["noise"] = toArray(std::vector<double>(level.noise.level));
    result["distortion"] = toArray(std::vector<double>(level.distortion));
    return result;
}

/// What recordings of one sweep say of an actuator, and `base` with it.
std::pair<nb::dict, ProfileHandle> findings(const std::vector<RecordingHandle>& recordings,
                                            const std::string& sweepText, double smoothing, double distortionLimit,
                                            const ProfileHandle* base, const std::string& name, bool calibrated)
{
    const SweepFile file = take(readSweepJson(sweepText));
    std::vector<FrequencyResponse> responses;
    std::vector<const SweepMeasurement*> placements;
    for (const RecordingHandle& recording : recordings)
    {
        responses.push_back(recording.measurement->response());
        placements.push_back(recording.measurement.get());
    }
    const PlacementAverage average = take(averagePlacements(responses));
    const MeasurementFindings found = take(findingsOf(placements, average, smoothing, distortionLimit));
    Profile profile;
    profile.technology = Technology::vca;
    if (base != nullptr)
        profile = base->profile();
    if (!name.empty())
        renameProfile(profile, name);
    setMeasurement(profile, average.response, found, recordings.size(),
                   *std::max_element(file.sweep.levels.begin(), file.sweep.levels.end()), calibrated);
    nb::dict result = responseOf(average.response);
    result["spread"] = toArray(std::vector<double>(average.spread));
    result["offsets"] = average.offsets;
    std::vector<std::size_t> outliers(found.outliers.begin(), found.outliers.end());
    result["outliers"] = outliers;
    result["resonance"] = std::pair(found.features.resonance.frequency, found.features.resonance.q);
    result["plateau"] = found.features.plateau;
    result["even"] = std::pair(found.features.even.low, found.features.even.high);
    result["felt"] = std::pair(found.features.felt.low, found.features.felt.high);
    result["times"] = found.times ? nb::cast(std::pair(found.times->riseTime, found.times->fallTime)) : nb::none();
    result["distortion"] = found.distortion;
    result["distortion_drive"] = orNone(found.distortionDrive);
    return {result, ProfileHandle(std::move(profile))};
}

FrequencyResponse responseOf(std::vector<double> frequency, std::vector<double> level)
{
    FrequencyResponse response{std::move(frequency), std::move(level)};
    take(validate(response));
    return response;
}

/// The fit, and `profile` with it.
std::pair<nb::dict, std::optional<ProfileHandle>> fit(std::vector<double> frequency, std::vector<double> level,
                                                      const ProfileHandle* profile, bool measured, double rate,
                                                      std::optional<int> sections, double maxBoost, double goal,
                                                      std::optional<double> low, std::optional<double> high,
                                                      std::optional<double> highpass, bool boostOutside, bool shelves)
{
    FrequencyResponse response = responseOf(std::move(frequency), std::move(level));
    EqualizerFitParams params;
    params.sampleRate = rate;
    params.sections = sections;
    params.maxBoost = maxBoost;
    params.lowFrequency = low.value_or(profile != nullptr ? profile->profile().range.lowFrequency : 0.0);
    params.highFrequency = high.value_or(profile != nullptr ? profile->profile().range.highFrequency : 0.0);
    params.goalMax = goal;
    params.goalRms = 0.25 * goal;
    params.boostOutside = boostOutside;
    params.shelves = shelves;
    if (highpass)
        params.highpass = protectingHighpass(*highpass);
    const EqualizerFit found =
        take(abandonable([response = std::move(response), params] { return fitEqualizer(response, params); }));
    nb::list list;
    for (const EqualizerSection& section : found.sections)
        list.append(nb::make_tuple(std::string(nameOf(section.type, profileFields::equalizerTypes)), section.frequency,
                                   section.gain, section.q, section.order));
    nb::dict result;
    result["sections"] = list;
    result["rms"] = found.rms;
    result["max"] = found.max;
    result["level"] = found.level;
    result["boost"] = found.boost;
    result["points"] = found.points;
    result["dropouts"] = found.dropouts;
    result["reached_goal"] = found.reachedGoal;
    std::optional<ProfileHandle> flattened;
    if (profile != nullptr)
    {
        Profile with = profile->profile();
        setEqualizer(with, found, measured ? "the measurement" : "a response", rate);
        flattened.emplace(std::move(with));
    }
    return {result, flattened};
}

/// The points of a profile's measurement; empty without one.
std::pair<std::vector<double>, std::vector<double>> measuredResponse(const ProfileHandle& profile)
{
    std::pair<std::vector<double>, std::vector<double>> response;
    if (profile.profile().measurement)
        for (const MeasuredPoint& point : profile.profile().measurement->points)
        {
            response.first.push_back(point.frequency);
            response.second.push_back(point.level);
        }
    return response;
}

/// Whether the response is flat, and `profile` with the proof.
std::pair<nb::dict, ProfileHandle> verify(std::vector<double> frequency, std::vector<double> level,
                                          const ProfileHandle& profile, double tolerance, std::optional<double> low,
                                          std::optional<double> high)
{
    const FrequencyResponse after = responseOf(std::move(frequency), std::move(level));
    Profile proven = profile.profile();
    const Linearity linearity = take(judgeLinearity(
        after, {low.value_or(proven.range.lowFrequency), high.value_or(proven.range.highFrequency), tolerance}));
    setVerification(proven, after, linearity);
    nb::dict result;
    result["passed"] = linearity.passed();
    result["low"] = linearity.lowFrequency;
    result["high"] = linearity.highFrequency;
    result["tolerance"] = linearity.tolerance;
    result["level"] = linearity.level;
    result["mean_deviation"] = linearity.meanDeviation;
    result["standard_deviation"] = linearity.standardDeviation;
    result["worst_deviation"] = linearity.worstDeviation;
    result["worst_frequency"] = linearity.worstFrequency;
    return {result, ProfileHandle(std::move(proven))};
}
} // namespace

void bindMeasure(nb::module_& module)
{
    module.def("make_sweep", &makeSweep, "low"_a, "high"_a, "low_given"_a, "duration"_a, "pause"_a, "repeats"_a,
               "levels"_a, "sample_rate"_a, "profile"_a.none());
    module.def("simulate_recording", &simulate, "sound"_a, "sample_rate"_a, "profile"_a, "wearer"_a, "contact"_a,
               "latency"_a, "drift"_a, "noise"_a, "distortion"_a, "range"_a, "axes"_a, "bits"_a, "seed"_a);
    nb::class_<RecordingHandle>(module, "RecordingHandle")
        .def_prop_ro("latency", [](const RecordingHandle& self) { return self.measurement->latency; })
        .def_prop_ro("drift", [](const RecordingHandle& self) { return self.measurement->driftPpm; })
        .def_prop_ro("main", [](const RecordingHandle& self) { return self.measurement->main; })
        .def_prop_ro("levels",
                     [](const RecordingHandle& self)
                     {
                         nb::list list;
                         for (const LevelMeasurement& level : self.measurement->levels)
                             list.append(levelOf(level));
                         return list;
                     })
        .def_prop_ro("warnings",
                     [](const RecordingHandle& self)
                     {
                         std::vector<std::pair<std::string, std::string>> list;
                         for (const MeasurementWarning& warning : self.measurement->warnings)
                             list.emplace_back(warning.where, warning.message);
                         return list;
                     });
    module.def("analyse_recording", &analyse, "sound"_a, "sample_rate"_a, "sweep"_a, "full_scale"_a, "smoothing"_a,
               "points"_a);
    module.def("measurement_findings", &findings, "recordings"_a, "sweep"_a, "smoothing"_a, "distortion_limit"_a,
               "base"_a.none(), "name"_a, "calibrated"_a);
    module.def("fit_equalizer", &fit, "frequency"_a, "level"_a, "profile"_a.none(), "measured"_a, "sample_rate"_a,
               "sections"_a.none(), "max_boost"_a, "goal"_a, "low"_a.none(), "high"_a.none(), "highpass"_a.none(),
               "boost_outside"_a, "shelves"_a);
    module.def("measured_response", &measuredResponse, "profile"_a);
    module.def("verify_response", &verify, "frequency"_a, "level"_a, "profile"_a, "tolerance"_a, "low"_a.none(),
               "high"_a.none());
}

} // namespace pacini::python
