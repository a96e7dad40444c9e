#include "document/measure/ActuatorMeasurement.h"

#include <pacini/linearize/MeasuredProfile.h>

#include <algorithm>

namespace pacini
{

Profile ActuatorMeasurement::unknownActuator()
{
    Profile profile;
    profile.technology = Technology::vca;
    return profile;
}

void ActuatorMeasurement::forgetFrom(MeasureStep step)
{
    ++current;
    for (std::size_t i = static_cast<std::size_t>(step); i < measureSteps; ++i)
        problems[i].clear();
    if (step <= MeasureStep::response)
        average.reset();
    if (step <= MeasureStep::equalizer)
    {
        equalizing.reset();
        verifying.clear();
    }
    if (step <= MeasureStep::verify)
        proof.reset();
    savedTo.clear();
}

void ActuatorMeasurement::setSettings(const MeasureSettings& settings)
{
    const MeasureSettings before = chosen;
    chosen = settings;
    if (!rangeLocked())
        return;
    chosen.lowFrequency = before.lowFrequency;
    chosen.highFrequency = before.highFrequency;
    chosen.calibrated = before.calibrated;
    chosen.fullScale = before.fullScale;
}

void ActuatorMeasurement::setBase(std::shared_ptr<const Profile> profile)
{
    auto now = profile ? std::move(profile) : std::make_shared<const Profile>(unknownActuator());
    if (*now == *known)
        return;
    known = std::move(now);
    // Only the cost of the equaliser hangs on it, but that is part of its result.
    if (equalizing)
        equalizing = [this]
        {
            auto fitted = std::make_shared<FittedEqualizer>(*equalizing);
            Profile actuator = *known;
            setMeasurement(actuator, average->average.response, average->findings, taken.size(), chosen.level,
                           chosen.calibrated);
            fitted->cost = equalizerCost(actuator, fitted->fit.sections, runningRate);
            return fitted;
        }();
    savedTo.clear();
}

void ActuatorMeasurement::addPlacement(Placement placement)
{
    taken.push_back(std::make_shared<const Placement>(std::move(placement)));
    forgetFrom(MeasureStep::response);
}

void ActuatorMeasurement::dropPlacement(std::size_t index)
{
    if (index >= taken.size())
        return;
    taken.erase(taken.begin() + static_cast<std::ptrdiff_t>(index));
    forgetFrom(MeasureStep::response);
}

void ActuatorMeasurement::setRequest(const EqualizerRequest& request)
{
    if (request == wanted)
        return;
    wanted = request;
    forgetFrom(MeasureStep::equalizer);
}

void ActuatorMeasurement::setRate(double hertz)
{
    if (hertz == runningRate)
        return;
    runningRate = hertz;
    forgetFrom(MeasureStep::equalizer);
}

void ActuatorMeasurement::addVerification(Placement swept)
{
    verifying.push_back(std::make_shared<const Placement>(std::move(swept)));
    forgetFrom(MeasureStep::verify);
}

void ActuatorMeasurement::dropVerifications()
{
    verifying.clear();
    forgetFrom(MeasureStep::verify);
}

void ActuatorMeasurement::setTolerance(double decibels)
{
    if (decibels == allowed)
        return;
    allowed = decibels;
    forgetFrom(MeasureStep::verify);
}

std::optional<ActuatorMeasurement::Due> ActuatorMeasurement::due() const
{
    if (taken.empty())
        return std::nullopt;
    if (!average)
    {
        if (!problem(MeasureStep::response).empty())
            return std::nullopt;
        return Due{current,
                   [placements = taken]() -> Outcome
                   {
                       return summarisePlacements(placements);
                   }};
    }
    if (!equalizing)
    {
        if (!problem(MeasureStep::equalizer).empty())
            return std::nullopt;
        return Due{current,
                   [measured = average, request = wanted, profile = known, fs = runningRate]() -> Outcome
                   {
                       return fitFor(*measured, request, *profile, fs);
                   }};
    }
    if (!proof && !verifying.empty() && problem(MeasureStep::verify).empty())
        return Due{current,
                   [swept = verifying, measured = average, fitted = equalizing, limit = allowed]() -> Outcome
                   {
                       return verifyResponse(swept, *measured, *fitted, limit);
                   }};
    return std::nullopt;
}

void ActuatorMeasurement::bring(Ticket ticket, Outcome outcome)
{
    if (ticket != current)
        return;
    ++current;
    const auto keep = [this](auto& result, auto& place, MeasureStep step)
    {
        if (result)
            place = std::make_shared<std::remove_cvref_t<decltype(*place)>>(std::move(result).value());
        else
            problems[static_cast<std::size_t>(step)] = result.error().message;
    };
    if (auto* measured = std::get_if<Result<MeasuredResponse>>(&outcome))
        keep(*measured, average, MeasureStep::response);
    else if (auto* fitted = std::get_if<Result<FittedEqualizer>>(&outcome))
        keep(*fitted, equalizing, MeasureStep::equalizer);
    else if (auto* judged = std::get_if<Result<VerifiedResponse>>(&outcome))
        keep(*judged, proof, MeasureStep::verify);
}

MeasureStepState ActuatorMeasurement::state(MeasureStep step) const
{
    using enum MeasureStepState;
    if (!whyLocked(step).empty())
        return locked;
    if (!problem(step).empty())
        return failed;
    // What is made of a recording that was cut off is there, but it is not good.
    const MeasureStepState made = anySpoiled(taken) ? failed : done;
    switch (step)
    {
    case MeasureStep::setUp:
        return taken.empty() ? open : done;
    case MeasureStep::sweep:
        return taken.empty() ? open : made;
    case MeasureStep::response:
        return average ? made : working;
    case MeasureStep::equalizer:
        return equalizing ? made : working;
    case MeasureStep::verify:
        if (verifying.empty())
            return open;
        return !proof ? working : proof->linearity.passed() && !anySpoiled(verifying) ? done : failed;
    case MeasureStep::save:
        return savedTo.empty() ? open : done;
    }
    return open;
}

bool ActuatorMeasurement::anySpoiled(const Placements& placements)
{
    return std::any_of(placements.begin(), placements.end(), [](const auto& one) { return one->spoiled; });
}

std::string ActuatorMeasurement::whyLocked(MeasureStep step) const
{
    if (step <= MeasureStep::sweep)
        return {};
    if (taken.empty())
        return "Sweep the actuator first.";
    if (step >= MeasureStep::equalizer && !average)
        return problem(MeasureStep::response).empty() ? "Computing the response." : "No response.";
    if (step >= MeasureStep::verify && !equalizing)
        return problem(MeasureStep::equalizer).empty() ? "Fitting the equaliser." : "No equaliser.";
    return {};
}

Profile ActuatorMeasurement::profile(const std::string& name) const
{
    Profile profile = *known;
    renameProfile(profile, name);
    double drive = -200.0;
    for (const auto& placement : taken)
        drive = std::max(drive, placement->level);
    setMeasurement(profile, average->average.response, average->findings, taken.size(), drive, chosen.calibrated);
    pacini::setEqualizer(profile, equalizing->fit, "the measurement", runningRate);
    if (proof)
        setVerification(profile, proof->after, proof->linearity);
    return profile;
}

} // namespace pacini
