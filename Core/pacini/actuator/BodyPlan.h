#pragma once

// Model reduction of a body: drops parts without a perceptible effect and states the error.

#include <pacini/actuator/BodyChain.h>
#include <pacini/actuator/PoleGroups.h>
#include <pacini/foundation/FixedVector.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string_view>

namespace pacini
{

/// Report of a reduction: one part that was left out.
struct BodyOmission
{
    std::string_view part;       ///< "joint" (device and skin move as one) or "skin" (and the joint to it)
    double predictedError = 0.0; ///< largest relative error of the observed response, 30-1000 Hz
};

/// The reduced chain and the parts that it omits.
struct BodyPlan
{
    BodyChain chain;
    FixedVector<BodyOmission, 1> omissions;
};

/// The frequencies at which two chains are compared: a logarithmic grid over 30-1000 Hz, and the resonances of both,
/// which may be narrower than the grid. Hz.
[[nodiscard]] inline auto comparedFrequencies(const BodyChain& chain, const BodyChain& simpler) noexcept
{
    constexpr int points = 48;
    FixedVector<double, points + 2 * RealPolynomial::maxDegree> frequencies;
    for (int i = 0; i < points; ++i)
        frequencies.pushBack(BodyBand::lowest *
                             std::pow(BodyBand::highest / BodyBand::lowest, static_cast<double>(i) / (points - 1)));
    for (const BodyChain* one : {&chain, &simpler})
        for (const PoleGroup& group : findPoleGroups(one->denominator(RealPolynomial::identity())))
        {
            const double f = std::sqrt(std::max(-group.spread, 0.0)) / (2.0 * std::numbers::pi);
            if (f > BodyBand::lowest && f < BodyBand::highest)
                frequencies.pushBack(f);
        }
    return frequencies;
}

/// The relative difference of two chains' responses at `point` and f Hz.
[[nodiscard]] inline double relativeDifference(const BodyChain& chain, const BodyChain& simpler, BodyPoint point,
                                               double f) noexcept
{
    const auto wanted = chain.response(point, Hertz(f));
    return std::abs(simpler.response(point, Hertz(f)) - wanted) / std::max(std::abs(wanted), 1e-300);
}

/// Returns the body without the parts whose absence changes the response of `point` by less than `tolerance`.
///
/// The joint becomes rigid when (1000 Hz / its frequency)^2 is below the tolerance: that far below its resonance, a
/// mass on a spring moves more than its base by that ratio. Beside a sharp resonance the joint may matter more than
/// this rule says for its frequency; then it is kept. The skin is left out only when its whole effect is below the
/// tolerance.
[[nodiscard]] inline BodyPlan planBody(const BodyParams& body, const Resonance& resonance,
                                       Decibels tolerance = Decibels(-60.0), BodyPoint point = BodyPoint::skin,
                                       BodyForce driven = BodyForce::coil) noexcept
{
    const double allowed = tolerance.gain();
    const BodyPlan whole{makeBodyChain(body, resonance, driven), {}};

    BodyPlan skinless = whole;
    skinless.chain.shape = BodyShape::skinless;
    double largest = 0.0;
    for (const double f : comparedFrequencies(whole.chain, skinless.chain))
        largest = std::max(largest, relativeDifference(whole.chain, skinless.chain, point, f));
    if (largest < allowed)
    {
        skinless.omissions.pushBack({"skin", largest});
        return skinless;
    }

    const auto rule = [&](double f)
    {
        const double ratio = f / whole.chain.jointFrequency().value;
        return ratio * ratio;
    };
    if (!(rule(BodyBand::highest) < allowed))
        return whole;
    BodyPlan rigid = whole;
    rigid.chain.shape = BodyShape::rigid;
    largest = rule(BodyBand::highest);
    for (const double f : comparedFrequencies(whole.chain, rigid.chain))
    {
        const double difference = relativeDifference(whole.chain, rigid.chain, point, f);
        if (difference > 1.05 * rule(f) + 1e-6) // 1e-6 counts nowhere
            return whole;
        largest = std::max(largest, difference);
    }
    if (!(largest < allowed))
        return whole;
    rigid.omissions.pushBack({"joint", largest});
    return rigid;
}

} // namespace pacini
