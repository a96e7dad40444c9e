#pragma once

// Workflow of an actuator's measurement: its steps, from the set-up to the profile.

#include "document/measure/MeasureResults.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace pacini
{

enum class MeasureStep
{
    setUp,
    sweep,
    response,
    equalizer,
    verify,
    save
};
inline constexpr std::size_t measureSteps = 6;

enum class MeasureStepState
{
    locked, ///< something before it is missing, see whyLocked()
    open,
    working, ///< its result is not there yet
    done,
    failed ///< see problem(), or what it stands on is spoiled
};

/// State of a measurement: measured data, and derived results. A change of a step discards all later steps. due() names
/// the results to compute again. They are computed elsewhere and returned with the ticket of that moment; results that
/// are outdated meanwhile are rejected.
class ActuatorMeasurement
{
public:
    // Set up.

    [[nodiscard]] const MeasureSettings& settings() const noexcept { return chosen; }
    /// Range and calibration stay as they are while there are placements: these must go together.
    void setSettings(const MeasureSettings& settings);
    [[nodiscard]] bool rangeLocked() const noexcept { return !taken.empty() || !verifying.empty(); }
    /// Where drive limits and what else is not measured come from; null: nothing is known.
    void setBase(std::shared_ptr<const Profile> profile);
    [[nodiscard]] const Profile& base() const noexcept { return *known; }

    // Placements.

    [[nodiscard]] const Placements& placements() const noexcept { return taken; }
    void addPlacement(Placement placement);
    void dropPlacement(std::size_t index);

    // What follows.

    [[nodiscard]] const MeasuredResponse* response() const noexcept { return average.get(); }
    [[nodiscard]] const EqualizerRequest& request() const noexcept { return wanted; }
    void setRequest(const EqualizerRequest& request);
    [[nodiscard]] const FittedEqualizer* equalizer() const noexcept { return equalizing.get(); }
    /// Hz at which the equaliser will run.
    void setRate(double hertz);
    [[nodiscard]] double rate() const noexcept { return runningRate; }

    [[nodiscard]] const Placements& verifications() const noexcept { return verifying; }
    void addVerification(Placement swept);
    void dropVerifications();
    [[nodiscard]] double tolerance() const noexcept { return allowed; } ///< dB
    void setTolerance(double decibels);
    [[nodiscard]] const VerifiedResponse* verified() const noexcept { return proof.get(); }

    // Work.

    using Ticket = unsigned;
    using Outcome = std::variant<Result<MeasuredResponse>, Result<FittedEqualizer>, Result<VerifiedResponse>>;
    struct Due
    {
        Ticket ticket = 0;
        std::function<Outcome()> work; ///< may run on any thread
    };
    /// What is to be computed next; the same until it has been brought.
    [[nodiscard]] std::optional<Due> due() const;
    void bring(Ticket ticket, Outcome outcome);

    // The steps.

    [[nodiscard]] MeasureStepState state(MeasureStep step) const;
    [[nodiscard]] std::string whyLocked(MeasureStep step) const;
    /// What went wrong in a step; empty: nothing.
    [[nodiscard]] std::string problem(MeasureStep step) const { return problems[static_cast<std::size_t>(step)]; }

    // Save.

    /// The profile of all that is there. There is an equaliser.
    [[nodiscard]] Profile profile(const std::string& name) const;
    void setSaved(std::string file) { savedTo = std::move(file); }
    [[nodiscard]] const std::string& saved() const noexcept { return savedTo; } ///< empty: not since the last change

private:
    [[nodiscard]] static bool anySpoiled(const Placements& placements);

    /// Forgets what `step` and all later ones have come to.
    void forgetFrom(MeasureStep step);

    MeasureSettings chosen;
    std::shared_ptr<const Profile> known = std::make_shared<const Profile>(unknownActuator());
    Placements taken;
    std::shared_ptr<const MeasuredResponse> average;
    EqualizerRequest wanted;
    double runningRate = 48000.0;
    std::shared_ptr<const FittedEqualizer> equalizing;
    Placements verifying;
    double allowed = 4.0;
    std::shared_ptr<const VerifiedResponse> proof;
    std::string savedTo;
    std::array<std::string, measureSteps> problems;
    Ticket current = 1;

    [[nodiscard]] static Profile unknownActuator();
};

} // namespace pacini
