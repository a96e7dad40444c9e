#pragma once

// Body model as a streaming filter: drive signal -> motion of the skin.

#include <pacini/actuator/BodyDesign.h>
#include <pacini/actuator/BodyPlan.h>
#include <pacini/foundation/DspBlock.h>

#include <array>
#include <cstddef>
#include <span>

namespace pacini
{

/// The sections and taps of a body with their memory. [audio]
class BodyFilter
{
public:
    /// Starts from rest.
    void setCoefficients(const BodyModelCoefficients& coefficients) noexcept
    {
        filter = coefficients;
        reset();
    }
    [[nodiscard]] const BodyModelCoefficients& coefficients() const noexcept { return filter; }
    void reset() noexcept { state = {}; }

    /// Spans of equal length, which may be the same memory; how the input is cut into calls does not matter.
    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        switch (filter.sections.size())
        {
        case 0:
            return run<0>(in, out);
        case 1:
            return run<1>(in, out);
        case 2:
            return run<2>(in, out);
        default:
            return run<3>(in, out);
        }
    }

private:
    struct State
    {
        std::array<double, 3> x1{}, x2{};
        std::array<double, BodyModelCoefficients::taps - 1> past{}; ///< inputs, the latest first
    };

    /// The number of sections is known to the compiler, and the state is local: it stays in registers.
    template <std::size_t count>
    void run(std::span<const float> in, std::span<float> out) noexcept
    {
        State s = state;
        std::array<BodySection, count> sections;
        for (std::size_t k = 0; k < count; ++k)
            sections[k] = filter.sections[k];
        const auto tap = filter.tap;
        const auto tick = [&](double x)
        {
            double y = tap[0] * x + tap[1] * s.past[0] + (tap[2] * s.past[1] + tap[3] * s.past[2]) + tap[4] * s.past[3];
            for (std::size_t k = 0; k < count; ++k)
            {
                const BodySection& section = sections[k];
                const double x1 = s.x1[k];
                const double x2 = s.x2[k];
                y += section.out1 * x1 + section.out2 * x2;
                s.x1[k] = section.a * x1 + (section.b * x2 + section.g * s.past[1]);
                s.x2[k] = section.c * x1 + (section.d * x2 + s.past[1]);
            }
            s.past = {x, s.past[0], s.past[1], s.past[2]};
            return y;
        };
        const auto flush = [&s]
        {
            for (std::size_t k = 0; k < count; ++k)
            {
                flushTiny(s.x1[k]);
                flushTiny(s.x2[k]);
            }
        };
        forEachSample(in, out, tick, flush);
        state = s;
    }

    BodyModelCoefficients filter;
    State state;
};

/// Body and resonance of a profile, and the wanted output. Numbers are clamped as in
/// makeBodyChain.
struct BodyModelParams
{
    BodyParams body;
    Resonance resonance;
    BodyPoint point = BodyPoint::skin;
    BodyForce driven = BodyForce::coil; ///< with `device` the input is in units of body.force too
    Decibels tolerance{-60.0};          ///< for parts to leave out, see planBody; -infinity keeps everything
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
    /// The computed parts, and the omitted parts with their predicted error.
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
