#pragma once

// What of a body need not be computed.

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

/// One part that was left out.
struct BodyOmission
{
    std::string_view part;       ///< "joint" (device and skin move as one) or "skin" (and the joint to it)
    double predictedError = 0.0; ///< largest relative error of the observed response, 30-1000 Hz
};

/// The chain that is computed and what it lacks.
struct BodyPlan
{
    BodyChain chain;
    FixedVector<BodyOmission, 1> omissions;
};

/// The largest relative difference of two chains' responses at `point`, 30-1000 Hz: on a logarithmic grid and at the
/// resonances of both, which may be narrower than the grid.
[[nodiscard]] inline double largestDifference(const BodyChain& chain, const BodyChain& simpler,
                                              BodyPoint point) noexcept
{
    constexpr int points = 48;
    double largest = 0.0;
    const auto look = [&](double f)
    {
        const auto wanted = chain.response(point, Hertz(f));
        const auto found = simpler.response(point, Hertz(f));
        largest = std::max(largest, std::abs(found - wanted) / std::max(std::abs(wanted), 1e-300));
    };
    for (int i = 0; i < points; ++i)
        look(BodyBand::lowest * std::pow(BodyBand::highest / BodyBand::lowest, static_cast<double>(i) / (points - 1)));
    for (const BodyChain* one : {&chain, &simpler})
        for (const PoleGroup& pair : findPoleGroups(one->denominator(RealPolynomial::identity())))
        {
            const double f = std::sqrt(std::max(-pair.spread, 0.0)) / (2.0 * std::numbers::pi);
            if (f > BodyBand::lowest && f < BodyBand::highest)
                look(f);
        }
    return largest;
}

/// The body with all parts left out whose absence changes the response of `point` by less than `tolerance`.
///
/// The joint is rigid when (1000 Hz / its frequency)^2 is below the tolerance: so much does a mass on a spring move
/// beyond its base that far below its resonance. Where a sharp resonance of the actuator is shifted by more than that,
/// the difference found there counts. The skin is left out only when the whole difference is below the tolerance.
[[nodiscard]] inline BodyPlan planBody(const BodyParams& body, const Resonance& resonance,
                                       Decibels tolerance = Decibels(-60.0), BodyPoint point = BodyPoint::skin,
                                       BodyForce driven = BodyForce::coil) noexcept
{
    const double allowed = tolerance.gain();
    BodyPlan plan{makeBodyChain(body, resonance, driven), {}};
    BodyChain simpler = plan.chain;
    simpler.shape = BodyShape::skinless;
    const double withoutSkin = largestDifference(plan.chain, simpler, point);
    if (withoutSkin < allowed)
        return {simpler, {{"skin", withoutSkin}}};

    const double ratio = BodyBand::highest / plan.chain.jointFrequency().value;
    if (ratio * ratio < allowed)
    {
        simpler.shape = BodyShape::rigid;
        const double whenRigid = std::max(ratio * ratio, largestDifference(plan.chain, simpler, point));
        if (whenRigid < allowed)
            return {simpler, {{"joint", whenRigid}}};
    }
    return plan;
}

} // namespace pacini
