#pragma once

// Excursion limiter: keeps the moving mass of an actuator within its travel, for any drive.

#include <pacini/actuator/BodyChain.h>
#include <pacini/actuator/FrameGroup.h>
#include <pacini/actuator/HeldStep.h>
#include <pacini/actuator/MovingMass.h>
#include <pacini/actuator/TravelModes.h>
#include <pacini/actuator/WornGuard.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/FixedVector.h>
#include <pacini/foundation/Pair.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>

namespace pacini
{

/// Parameters of the excursion limiter: the moving mass as a second-order resonator on a fixed base, and its travel.
/// Clamped to the ranges of a valid profile. If the base is known, the limiter also guards the mass as worn: the base
/// then moves, and the mass resonates at a higher frequency against it.
struct ExcursionParams
{
    Hertz frequency{67.0};           ///< 1 to 20000 Hz
    double q = 1.0;                  ///< 0.01 to 1000
    double excursion = 1e-3;         ///< m at a drive of 1 far below resonance, 1e-9 to 10 (with overdrive)
    double maxExcursion = 1e-3;      ///< m from rest, 1e-7 to 0.1
    std::optional<BodyChain> worn{}; ///< its force is that at a drive of 1 (with overdrive); none: only held still
    bool operator==(const ExcursionParams&) const = default;
};

/// The largest displacement in metres that any drive within +-1 can cause with the base held still: that of a drive
/// which changes its sign with the velocity. Each half swing then overshoots by exp(-pi zeta / sqrt(1 - zeta^2)), a
/// geometric series; the overdamped mass never overshoots.
[[nodiscard]] inline double worstExcursion(const ExcursionParams& params) noexcept
{
    const double zeta = 0.5 / params.q;
    if (zeta >= 1.0)
        return params.excursion;
    return params.excursion / std::tanh(0.5 * std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta));
}

/// Precomputed steps and limits of the guarded mass.
struct ExcursionCoefficients
{
    static constexpr std::size_t maxSubsteps = 64;

    FixedVector<HeldStep, maxSubsteps> steps; ///< to points in the hold, the last one to the next sample
    GroupStep group;                          ///< the last of them for all frames of a group
    double energyLimit = 0.0;                 ///< m^2
    double driveLimit = 0.0;
    double groupReach = 0.0; ///< m by which the amplitude grows at most within a group, at a drive of 1
};

/// The set of states {energy <= r^2} with r a little below the travel. The displacement between the points of a hold
/// exceeds that at the next point by at most d^2/2 (travel + static displacement), d = w0 times their distance: from a
/// turning point the damped mass moves away no faster than the undamped one. r leaves that much room, and points are
/// added until d <= 0.05 (at most 64, for resonances above 0.5 of the sample rate). Drives whose static displacement is
/// so many times the travel that r would fall below 95 % of it are not admitted.
[[nodiscard]] inline ExcursionCoefficients designExcursionGuard(const ExcursionParams& params, double fs) noexcept
{
    const double frequency = clampTo(params.frequency.value, 1.0, 20000.0);
    const double q = clampTo(params.q, 0.01, 1000.0);
    const double excursion = clampTo(params.excursion, 1e-9, 10.0);
    const double travel = clampTo(params.maxExcursion, 1e-7, 0.1);

    const double angle = 2.0 * std::numbers::pi * frequency / fs;
    const double count = clampTo(std::ceil(angle / 0.05), 1.0, static_cast<double>(ExcursionCoefficients::maxSubsteps));
    ExcursionCoefficients guard;
    const HeldStep substep = designHeldStep(frequency, q, excursion, 1.0 / (fs * count));
    guard.steps.pushBack(substep);
    while (static_cast<double>(guard.steps.size()) < count)
        guard.steps.pushBack(guard.steps.back().then(substep));

    guard.group = designGroupStep(guard.steps.back());
    // d/dt sqrt(x^2 + v^2) <= w0 excursion |drive|
    guard.groupReach = static_cast<double>(groupFrames) * angle * excursion;

    const double rise = 0.5 * (angle / count) * (angle / count);
    const double largestRatio = std::max(0.0, 0.05 / rise - 1.0);
    const double ratio = std::min(excursion / travel, largestRatio);
    guard.driveLimit = std::min(1.0, ratio * travel / excursion);
    const double radius = travel * std::max(0.0, 1.0 - rise * (1.0 + ratio)) * (1.0 - 1e-9); // and rounding
    guard.energyLimit = radius * radius;
    return guard;
}

/// Excursion limiter (safety filter). Passes each wanted drive as far as the energy of the modelled mass stays within
/// its limit to the end of the sample; likewise for the mass as worn (see WornGuard). Both also accept any smaller
/// drive of the same sign, so neither undoes the other.
///
/// A drive of 0 never raises the energy, so an admissible drive always exists, and the limit holds for any input and
/// any time. A limiter that only reduces a gain has no such proof, because a moving resonator continues when the drive
/// falls. At resonance the largest drive that keeps the energy is proportional to the velocity, so a sinusoid held by
/// the guard alone stays nearly a sinusoid. (A safety filter on an invariant set: A. Ames et al., "Control barrier
/// functions: theory and applications", ECC 2019, here for the exact discrete model.)
class ExcursionGuard
{
public:
    void design(const ExcursionParams& params, double fs) noexcept
    {
        guard = designExcursionGuard(params, fs);
        wantedLimit = 0.99 * guard.energyLimit;
        moved.beginGroup();
        asWanted.beginGroup();
        if (params.worn)
            worn.design(*params.worn, clampTo(params.maxExcursion, 1e-7, 0.1), fs);
        if (!params.worn || !isWorn)
            worn.reset();
        isWorn = params.worn.has_value();
    }
    void reset() noexcept
    {
        moved = {};
        asWanted = {};
        worn.reset();
    }

    /// Follows the wanted drive. Returns the energy that it would cause relative to the limit, less 1 %, which the
    /// square of a gain must undo. Due to the 1 %, the guard does not act on a steady tone held by the gain.
    double measure(double wanted) noexcept
    {
        asWanted.follow(wanted, guard.steps.back(), guard.group);
        const double still = asWanted.state().energy() / wantedLimit;
        return isWorn ? std::max(still, worn.measure(wanted)) : still;
    }

    /// The drive nearest to `wanted` that is admissible now; it never changes its sign.
    [[nodiscard]] double admit(double wanted) const noexcept
    {
        double drive = clampTo(wanted, -guard.driveLimit, guard.driveLimit);
        for (const HeldStep& step : guard.steps)
        {
            if (step.next(moved.state(), drive).energy() <= guard.energyLimit)
                continue;
            // a drive^2 + 2 b drive = room, solved for the root on the side of `drive`
            const ResonatorState free = step.free(moved.state());
            const double sign = drive < 0.0 ? -1.0 : 1.0;
            const double a = step.driveToX * step.driveToX + step.driveToV * step.driveToV;
            const double b = sign * (free.displacement * step.driveToX + free.velocity * step.driveToV);
            const double room = guard.energyLimit - free.energy();
            if (!(room > 0.0))
                return 0.0; // only when the limits were just narrowed
            const double root = std::sqrt(b * b + a * room);
            const double most = b > 0.0 ? room / (b + root) : (root - b) / a;
            drive = sign * std::min(std::abs(drive), most);
        }
        return isWorn ? worn.admit(drive) : drive;
    }

    /// Lets the mass move under the drive that is really played.
    void advance(double drive) noexcept
    {
        moved.follow(drive, guard.steps.back(), guard.group);
        if (isWorn)
            worn.advance(drive);
    }

    /// Does measure() and advance() for whole groups of frames, from the start of a group, if it is certain that no
    /// measure exceeds `maxMeasure` and that all of `played` would be admitted. Otherwise nothing changes and it
    /// returns false. The peaks are those of the two spans.
    bool advanceFreely(std::span<const double> wanted, double wantedPeak, std::span<const double> played,
                       double playedPeak, double maxMeasure) noexcept
    {
        if (!(playedPeak <= guard.driveLimit))
            return false;
        TwoStates masses(asWanted.state(), moved.state()); // side by side: each waits for its own last state
        Pair most = masses.energy();
        WornGuard::TwoFollowing modes = worn.followTwo(isWorn);
        for (std::size_t i = 0; i < wanted.size(); i += groupFrames)
        {
            std::array<Pair, groupFrames> drives;
            for (std::size_t k = 0; k < groupFrames; ++k)
                drives[k] = Pair(wanted[i + k], played[i + k]);
            masses = guard.group.next(masses, drives);
            most = larger(masses.energy(), most);
            worn.follow(modes, drives);
        }
        if (!stays(most.first(), wantedPeak, maxMeasure * wantedLimit) ||
            !stays(most.second(), playedPeak, guard.energyLimit) ||
            !worn.moveFreely(modes, wantedPeak, playedPeak, maxMeasure))
            return false;
        asWanted.moveTo(masses.first());
        moved.moveTo(masses.second());
        return true;
    }

    /// Follows whole groups of wanted frames, from the start of a group. Raises each of `levels` to the result of
    /// measure(), but leaves them unchanged if no result can exceed `maxMeasure`. `peak` is the peak of `wanted`.
    /// Returns the largest level, 0 for unchanged levels.
    double measure(std::span<const double> wanted, double peak, double maxMeasure, std::span<double> levels) noexcept
    {
        double largest = 0.0;
        if (!followFreely(asWanted, wanted, peak, maxMeasure * wantedLimit))
            for (std::size_t i = 0; i < wanted.size(); ++i)
            {
                asWanted.follow(wanted[i], guard.steps.back(), guard.group);
                const double level = asWanted.state().energy() / wantedLimit;
                levels[i] = std::max(levels[i], level);
                largest = std::max(largest, level);
            }
        return isWorn ? std::max(largest, worn.measure(wanted, peak, maxMeasure, levels)) : largest;
    }

    /// Does advance() for whole groups of frames, from the start of a group, if it is certain that all of `played`
    /// would be admitted. Otherwise nothing changes and it returns false. `peak` is that of `played`.
    bool advanceFreely(std::span<const double> played, double peak) noexcept
    {
        const MovingMass before = moved;
        if (!(peak <= guard.driveLimit) || !followFreely(moved, played, peak, guard.energyLimit))
            return false;
        if (!isWorn || worn.advanceFreely(played, peak))
            return true;
        moved = before;
        return false;
    }

    void flush() noexcept
    {
        moved.flush();
        asWanted.flush();
        if (isWorn)
            worn.flush();
    }

    [[nodiscard]] const ExcursionCoefficients& coefficients() const noexcept { return guard; }

private:
    /// Lets a mass follow whole groups if its energy is then certain to stay within `limit`.
    bool followFreely(MovingMass& mass, std::span<const double> drive, double peak, double limit) const noexcept
    {
        MovingMass after = mass;
        double most = after.state().energy();
        for (std::size_t i = 0; i < drive.size(); i += groupFrames)
        {
            after.followGroup(groupAt(drive, i), guard.group);
            most = std::max(most, after.state().energy());
        }
        if (!stays(most, peak, limit))
            return false;
        mass = after;
        return true;
    }

    /// Whether an energy of at most `most` at all ends of groups stays within `limit` in between, too.
    [[nodiscard]] bool stays(double most, double peak, double limit) const noexcept
    {
        constexpr double safely = 1.0 - 1e-6; // far more than rounding
        return std::sqrt(most) + guard.groupReach * peak <= safely * std::sqrt(limit);
    }

    ExcursionCoefficients guard = designExcursionGuard({}, ProcessSpec{}.sampleRate);
    double wantedLimit = 0.99 * guard.energyLimit; // m^2
    MovingMass moved;
    MovingMass asWanted;
    bool isWorn = false;
    WornGuard worn;
};

} // namespace pacini
