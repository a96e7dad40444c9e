#pragma once

// Body model as a streaming filter: drive signal -> motion of the skin.

#include <pacini/actuator/BodyFilter.h>
#include <pacini/actuator/BodyPlan.h>
#include <pacini/foundation/DspBlock.h>

#include <cstddef>
#include <span>

namespace pacini
{

/// A profile's body and resonance, and what of it is wanted. Numbers are clamped as in makeBodyChain.
struct BodyModelParams
{
    BodyParams body;
    Resonance resonance;
    BodyPoint point = BodyPoint::skin;
    BodyForce driven = BodyForce::coil; ///< with `device` the input is in units of body.force too
    Decibels tolerance{-60.0};          ///< of what is left out, see planBody; -infinity keeps everything
    bool operator==(const BodyModelParams&) const = default;
};

/// Drive in, acceleration in m/s^2 (or excursion in m) out, two frames late. At most three second-order sections and
/// five taps per frame. Parameters are those of a thing and a person: a change starts from rest.
class BodyModel
{
public:
    using Params = BodyModelParams;

    void prepare(const ProcessSpec& spec) noexcept
    {
        fs = spec.sampleRate;
        design();
    }
    void setParams(const Params& params) noexcept
    {
        if (params == current)
            return;
        current = params;
        design();
    }
    void reset() noexcept { filter.reset(); }

    void process(std::span<const float> in, std::span<float> out) noexcept { filter.process(in, out); }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return BodyModelCoefficients::latency; }
    [[nodiscard]] const BodyModelCoefficients& coefficients() const noexcept { return filter.coefficients(); }
    /// What is computed, and what was left out with which predicted error.
    [[nodiscard]] const BodyPlan& plan() const noexcept { return planned; }

private:
    void design() noexcept
    {
        planned = planBody(current.body, current.resonance, current.tolerance, current.point, current.driven);
        filter.setCoefficients(designBodyModel(planned.chain, current.point, fs));
    }

    double fs = ProcessSpec{}.sampleRate;
    Params current;
    BodyPlan planned;
    BodyFilter filter;
};

static_assert(DspBlock<BodyModel>);

} // namespace pacini
