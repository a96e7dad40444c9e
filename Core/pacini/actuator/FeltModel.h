#pragma once

// Model of a profile's actuator on the body: drive signal -> acceleration that is felt.

#include <pacini/actuator/BodyModel.h>
#include <pacini/actuator/SpinningMotor.h>

#include <cstddef>
#include <optional>
#include <span>

namespace pacini
{

/// Parameters of the felt acceleration: the mover and the body.
struct FeltModelParams
{
    Technology technology = Technology::vca;
    ActuatorResponse response; ///< counts for spinning motors only; a resonance has its own
    BodyModelParams body;      ///< `driven` follows from the technology
    bool operator==(const FeltModelParams&) const = default;
};

/// The parameters of a profile's felt acceleration, or nothing when it has no body.
[[nodiscard]] inline std::optional<FeltModelParams> feltModelParams(const Profile& profile,
                                                                    BodyPoint point = BodyPoint::skin,
                                                                    Decibels tolerance = Decibels(-60.0)) noexcept
{
    if (!profile.body)
        return std::nullopt;
    const bool spins = profile.technology == Technology::erm;
    return FeltModelParams{
        profile.technology,
        profile.response,
        {*profile.body, profile.resonance, point, spins ? BodyForce::device : BodyForce::coil, tolerance}};
}

/// Drive in, felt acceleration in m/s^2 out: a spinning motor on the device or a moving mass in it, and the body. Two
/// frames late.
class FeltModel
{
public:
    using Params = FeltModelParams;

    void prepare(const ProcessSpec& spec) noexcept
    {
        motor.prepare(spec);
        body.prepare(spec);
    }
    void setParams(const Params& params) noexcept
    {
        spins = params.technology == Technology::erm;
        motor.setParams({Hertz(params.body.resonance.frequency), params.response});
        BodyModelParams driven = params.body;
        driven.driven = spins ? BodyForce::device : BodyForce::coil;
        body.setParams(driven);
    }
    void reset() noexcept
    {
        motor.reset();
        body.reset();
    }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        if (spins)
        {
            motor.process(in, out);
            in = out;
        }
        body.process(in, out);
    }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return body.latencyFrames(); }
    [[nodiscard]] const BodyPlan& plan() const noexcept { return body.plan(); }

private:
    bool spins = false;
    SpinningMotor motor;
    BodyModel body;
};

static_assert(DspBlock<FeltModel>);

} // namespace pacini
