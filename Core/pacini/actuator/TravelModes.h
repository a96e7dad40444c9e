#pragma once

// Modal decomposition of the travel of a moving mass, for an actuator as worn.

#include <pacini/actuator/BodyChain.h>
#include <pacini/actuator/HeldStep.h>
#include <pacini/actuator/MovingMass.h>
#include <pacini/actuator/PoleGroups.h>
#include <pacini/foundation/FixedVector.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace pacini
{

/// One mode of the travel. One share x of the travel, in metres at a drive u:
///
///     x' = w v + toX u,  v' = -w x - (w / q) v + toV u,   or of a single real pole   x' = -w x + toX u.
///
/// Without drive sqrt(x^2 + v^2) never grows, d/dt (x^2 + v^2) = -2 (w / q) v^2, and |x| is never above it. So the sum
/// of these amplitudes over all modes bounds the travel now and, if the drive ends, for ever.
struct TravelMode
{
    double w = 1.0; ///< rad/s
    double q = 1.0; ///< of a pair; of any damping
    double toX = 0.0;
    double toV = 0.0;
    bool single = false;

    /// Returns the rest position of x and v under a drive of 1.
    [[nodiscard]] ResonatorState rest() const noexcept
    {
        return single ? ResonatorState{toX / w, 0.0} : ResonatorState{(toX / q + toV) / w, -toX / w};
    }
    /// Returns the largest growth of the amplitude, per second at a drive of 1.
    [[nodiscard]] double push() const noexcept { return std::hypot(toX, toV); }

    /// The largest |x| in metres that a drive within +-1 can cause: the integral of the size of the impulse response.
    /// That is the way which the response to a step goes, from one turn to the next; of a swing each is smaller than
    /// the one before by the same factor. Where nothing swings it turns once at most: a bound, not the value.
    [[nodiscard]] double worst() const noexcept
    {
        const ResonatorState z = rest();
        if (single)
            return std::abs(z.displacement);
        const double half = 0.5 / q;
        const double turning = std::sqrt(std::max((1.0 - half) * (1.0 + half), 0.0)); // over w
        if (turning < 1e-3)
            return std::abs(z.displacement) + 2.0 * std::sqrt(z.energy());
        // x' = exp(-half w t) (toX cos(a) + k sin(a)) with a = turning w t, 0 for the first time at `first`
        const double k = (toV + half * toX) / turning;
        double first = std::atan2(-toX, k);
        if (first <= 0.0)
            first += std::numbers::pi;
        const double away =
            -std::exp(-half / turning * first) *
            (z.displacement * std::cos(first) + (z.velocity + half * z.displacement) / turning * std::sin(first));
        return std::abs(z.displacement + away) + std::abs(away) / std::tanh(0.5 * std::numbers::pi * half / turning);
    }

    /// The exact step of `duration` s under a drive that is held.
    [[nodiscard]] HeldStep step(double duration) const noexcept
    {
        HeldStep result;
        if (single)
            result.xx = std::expm1(-w * duration);
        else
            result = designHeldStep(w / (2.0 * std::numbers::pi), q, 0.0, duration);
        const ResonatorState z = rest();
        result.driveToX = -(result.xx * z.displacement + result.xv * z.velocity);
        result.driveToV = -(result.vx * z.displacement + result.vv * z.velocity);
        return result;
    }
};

using TravelModeList = FixedVector<TravelMode, RealPolynomial::maxDegree>;

namespace detail
{
/// Puts a mode behind all that are slower.
inline void insertBySpeed(TravelModeList& modes, const TravelMode& mode) noexcept
{
    modes.pushBack(mode);
    for (std::size_t i = modes.size() - 1; i > 0 && modes[i].w < modes[i - 1].w; --i)
        std::swap(modes[i], modes[i - 1]);
}

/// The mode b s + a over s^2 + (w / q) s + w^2.
[[nodiscard]] inline TravelMode pairMode(double a, double b, double sum, double product) noexcept
{
    TravelMode mode;
    mode.w = std::sqrt(product);
    mode.q = mode.w / sum;
    mode.toX = b;
    mode.toV = (a - b * sum) / mode.w;
    return mode;
}
} // namespace detail

/// The modes of the travel of `chain` (BodyPoint::excursion), by partial fractions over its groups of poles, the
/// slowest first.
///
/// Force and travel belong to the same point of the chain: without damping all fractions are positive (Foster's
/// reactance theorem) and their amplitudes can meet, so that the sum of amplitudes is the least bound that looks at no
/// phases. The energy in all springs and masses would be another; it counts what skin and device do together, too.
/// Two single poles of opposite signs, such as those of an overdamped suspension, cancel in part: they are one mode
/// where that tells less of a constant drive.
[[nodiscard]] inline TravelModeList travelModes(const BodyChain& chain) noexcept
{
    constexpr double slowest = 1e-9; // 1/s: nothing rests there within years, and nothing divides by 0
    const RealPolynomial denominator = chain.denominator(RealPolynomial::identity());
    const PoleGroupList groups = findPoleGroups(denominator);
    const double leading = denominator.c[denominator.degree()];

    TravelModeList modes;
    TravelModeList singles;
    for (std::size_t k = 0; k < groups.size(); ++k)
    {
        const PoleGroup& group = groups[k];
        const PoleNumber fraction =
            chain.force * (chain.numerator(BodyPoint::excursion, valueAt(group)) / (leading * otherFactors(groups, k)));
        if (group.single)
        {
            TravelMode mode;
            mode.single = true;
            mode.w = std::max(-group.centre, slowest);
            mode.toX = fraction.a;
            detail::insertBySpeed(singles, mode);
            continue;
        }
        const double centre = std::min(group.centre, -1e-12 * group.slowest());
        detail::insertBySpeed(modes, detail::pairMode(fraction.a - fraction.b * centre, fraction.b, -2.0 * centre,
                                                      std::max(centre * centre - group.spread, slowest * slowest)));
    }
    for (std::size_t i = 0; i < singles.size(); ++i)
    {
        const TravelMode& one = singles[i];
        if (i + 1 < singles.size())
        {
            const TravelMode& two = singles[i + 1];
            const TravelMode both =
                detail::pairMode(one.toX * two.w + two.toX * one.w, one.toX + two.toX, one.w + two.w, one.w * two.w);
            if (std::sqrt(both.rest().energy()) < one.worst() + two.worst())
            {
                detail::insertBySpeed(modes, both);
                ++i;
                continue;
            }
        }
        detail::insertBySpeed(modes, one);
    }
    return modes;
}

/// No drive within +-1 makes the travel of `chain` larger than this, m. Reached as far as the modes can be driven
/// together.
[[nodiscard]] inline double worstTravel(const BodyChain& chain) noexcept
{
    double sum = 0.0;
    for (const TravelMode& mode : travelModes(chain))
        sum += mode.worst();
    return sum;
}

} // namespace pacini
