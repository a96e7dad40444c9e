#pragma once

// Excursion limiter for an actuator as worn: keeps the moving mass within its travel, for any drive.

#include <pacini/actuator/FrameGroup.h>
#include <pacini/actuator/HeldStep.h>
#include <pacini/actuator/MovingMass.h>
#include <pacini/actuator/TravelModes.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/FixedVector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace pacini
{

/// Precomputed modes and limits of the worn mass.
struct WornCoefficients
{
    static constexpr std::size_t maxSubsteps = 32;
    static constexpr std::size_t maxModes = TravelModeList::capacity();

    using Steps = FixedVector<HeldStep, maxModes>;

    FixedVector<Steps, maxSubsteps> steps; ///< of all modes to points in the hold, the last ones to the next sample
    FixedVector<GroupStep, maxModes> groups;
    double limit = 0.0; ///< m, of the sum of all modes' amplitudes at every point
    double driveLimit = 0.0;
    double groupReach = 0.0; ///< m by which that sum grows at most within a group, at a drive of 1
};

/// The set of states whose modes have amplitudes with a sum of at most `limit`, which is so far below `travel` (m) that
/// the travel is kept between the points, too. With h between two points, a drive d and a_i the amplitudes there, what
/// may be missed is below each of
///
///     |d| h sum push_i                                             (an amplitude grows only by the drive),
///     h^2 / 8 (sum |x_i''|),  |x_i''| <= w_i (w_i (1 + 1 / q_i) a_i + |toV_i d|)    (a chord and its curve),
///
/// of which the second is the smaller one for slow modes. Points are added until w h <= 0.05 for the fastest mode (at
/// most 32); drives by which 5 % of the travel might be missed are not admitted.
/// Modes that add up to less than 0.25 % of the worst travel (0.02 dB), such as those of stiff joints, are not
/// followed: their worst is taken from the limit.
[[nodiscard]] inline WornCoefficients designWornGuard(const BodyChain& chain, double travel, double fs) noexcept
{
    TravelModeList all = travelModes(chain);
    double worst = 0.0;
    for (const TravelMode& mode : all)
        worst += mode.worst();
    double left = 0.0;
    TravelModeList modes;
    for (const TravelMode& mode : all)
        if (left + mode.worst() <= 0.0025 * worst)
            left += mode.worst();
        else
            modes.pushBack(mode);

    double fastest = 0.0, curve = 0.0, push = 0.0, pushedCurve = 0.0;
    for (const TravelMode& mode : modes)
    {
        const double stiff = mode.single ? mode.w : mode.w * (1.0 + 1.0 / mode.q); // |x''| / w of an amplitude of 1
        fastest = std::max(fastest, mode.w);
        curve = std::max(curve, mode.w * stiff);
        push += mode.push();
        pushedCurve += mode.w * (mode.single ? std::abs(mode.toX) : std::abs(mode.toV));
    }
    WornCoefficients guard;
    const double most = static_cast<double>(WornCoefficients::maxSubsteps);
    const double count = clampTo(std::ceil(fastest / (0.05 * fs)), 1.0, most);
    const double h = 1.0 / (fs * count);
    while (static_cast<double>(guard.steps.size()) < count)
    {
        WornCoefficients::Steps steps;
        for (std::size_t i = 0; i < modes.size(); ++i)
        {
            const HeldStep step = modes[i].step(h);
            steps.pushBack(guard.steps.empty() ? step : guard.steps.back()[i].then(step));
        }
        guard.steps.pushBack(steps);
    }
    for (const HeldStep& step : guard.steps.back())
        guard.groups.pushBack(designGroupStep(step));
    guard.groupReach = static_cast<double>(groupFrames) * push / fs;

    const double room = std::max(travel - left, 0.0);
    const double share = 0.125 * h * h;
    const auto missed = [&](double drive)
    {
        return std::min(drive * h * push, share * (curve * room + drive * pushedCurve));
    };
    const double byPush = 0.05 * room / std::max(h * push, 1e-300);
    const double byCurve = (0.05 - share * curve) * room / std::max(share * pushedCurve, 1e-300);
    guard.driveLimit = clampTo(std::max(byPush, byCurve), 0.0, 1.0);
    guard.limit = (room - missed(guard.driveLimit)) * (1.0 - 1e-9); // and rounding
    return guard;
}

/// Excursion limiter (safety filter) on the modes. Admits of every wanted drive as much as keeps the sum of the modes'
/// amplitudes within its limit to the end of the sample. A drive of 0 never raises it, as with the one mode of a mass
/// on a base held still (see ExcursionGuard). Where nothing else is said, the same holds as there.
class WornGuard
{
public:
    /// Starts from the current modes, if their number is equal: after a small change they are nearly the same.
    void design(const BodyChain& chain, double travel, double fs) noexcept
    {
        const std::size_t before = guard.groups.size();
        guard = designWornGuard(chain, travel, fs);
        if (guard.groups.size() != before)
            reset();
        perWantedLimit = 1.0 / std::max(0.99 * guard.limit * guard.limit, 1e-300);
        moved.beginGroup();
        asWanted.beginGroup();
    }
    void reset() noexcept
    {
        moved = {};
        asWanted = {};
    }

    /// The square of the sum of the amplitudes that the wanted drive would cause, over that of the limit, less 1 %.
    double measure(double wanted) noexcept
    {
        asWanted.follow(wanted, guard);
        double sum = 0.0;
        for (std::size_t i = 0; i < guard.groups.size(); ++i)
            sum += std::sqrt(asWanted.now[i].energy());
        return sum * sum * perWantedLimit;
    }

    [[nodiscard]] double admit(double wanted) const noexcept
    {
        double drive = clampTo(wanted, -guard.driveLimit, guard.driveLimit);
        for (const auto& steps : guard.steps)
            drive = admitTo(steps, drive);
        return drive;
    }

    void advance(double drive) noexcept { moved.follow(drive, guard); }

    /// The modes under the wanted drives and under the played ones, while they follow whole groups, and their highest
    /// energies so far. All go side by side: each of them waits for its own last state.
    struct TwoFollowing
    {
        struct Mode
        {
            TwoStates state{Pair(), Pair()};
            Pair most;
        };
        std::array<Mode, WornCoefficients::maxModes> modes;
        std::size_t count = 0;
    };

    /// What follow() begins with, of no modes unless `all`.
    [[nodiscard]] TwoFollowing followTwo(bool all) const noexcept
    {
        TwoFollowing two;
        two.count = all ? guard.groups.size() : 0;
        for (std::size_t i = 0; i < two.count; ++i)
        {
            two.modes[i].state = TwoStates(asWanted.now[i], moved.now[i]);
            two.modes[i].most = two.modes[i].state.energy();
        }
        return two;
    }

    /// A whole group; the drives are those wanted and those played.
    void follow(TwoFollowing& two, const std::array<Pair, groupFrames>& drives) const noexcept
    {
        for (std::size_t i = 0; i < two.count; ++i)
        {
            auto& [state, most] = two.modes[i];
            state = guard.groups[i].next(state, drives);
            most = larger(state.energy(), most);
        }
    }

    /// Moves the modes there if it is certain that no measure has exceeded `maxMeasure` and that all that was played
    /// would be admitted. The peaks are those of the drives.
    bool moveFreely(const TwoFollowing& two, double wantedPeak, double playedPeak, double maxMeasure) noexcept
    {
        double wantedSum = 0.0, playedSum = 0.0;
        for (std::size_t i = 0; i < two.count; ++i)
        {
            wantedSum += std::sqrt(two.modes[i].most.first());
            playedSum += std::sqrt(two.modes[i].most.second());
        }
        if (two.count > 0 && !(stays(wantedSum, wantedPeak, std::sqrt(maxMeasure / perWantedLimit)) &&
                               stays(playedSum, playedPeak, guard.limit)))
            return false;
        for (std::size_t i = 0; i < two.count; ++i)
        {
            asWanted.now[i] = asWanted.start[i] = two.modes[i].state.first();
            moved.now[i] = moved.start[i] = two.modes[i].state.second();
        }
        return true;
    }

    double measure(std::span<const double> wanted, double peak, double maxMeasure, std::span<double> levels) noexcept
    {
        if (followFreely(asWanted, wanted, peak, std::sqrt(maxMeasure / perWantedLimit)))
            return 0.0;
        double largest = 0.0;
        for (std::size_t i = 0; i < wanted.size(); ++i)
        {
            const double level = measure(wanted[i]);
            levels[i] = std::max(levels[i], level);
            largest = std::max(largest, level);
        }
        return largest;
    }

    bool advanceFreely(std::span<const double> played, double peak) noexcept
    {
        return peak <= guard.driveLimit && followFreely(moved, played, peak, guard.limit);
    }

    void flush() noexcept
    {
        moved.flush(guard.groups.size());
        asWanted.flush(guard.groups.size());
    }

    [[nodiscard]] const WornCoefficients& coefficients() const noexcept { return guard; }

private:
    /// As many of MovingMass, which all have the same drives.
    struct Modes
    {
        std::array<ResonatorState, WornCoefficients::maxModes> now{};
        std::array<ResonatorState, WornCoefficients::maxModes> start{};
        FrameGroup drives{};
        std::size_t position = 0;

        void follow(double drive, const WornCoefficients& coefficients) noexcept
        {
            const WornCoefficients::Steps& steps = coefficients.steps.back();
            drives[position] = drive;
            if (++position < groupFrames)
            {
                for (std::size_t i = 0; i < steps.size(); ++i)
                    now[i] = steps[i].next(now[i], drive);
                return;
            }
            position = 0;
            for (std::size_t i = 0; i < steps.size(); ++i)
                now[i] = start[i] = coefficients.groups[i].next(start[i], drives);
        }
        void beginGroup() noexcept
        {
            start = now;
            position = 0;
        }
        void flush(std::size_t count) noexcept
        {
            for (std::size_t i = 0; i < count; ++i)
                for (ResonatorState* state : {&now[i], &start[i]})
                {
                    flushTiny(state->displacement);
                    flushTiny(state->velocity);
                }
        }
    };

    /// Modes that follow whole groups, and their highest energies so far.
    struct Following
    {
        std::array<ResonatorState, WornCoefficients::maxModes> states;
        std::array<double, WornCoefficients::maxModes> most{};

        Following(const Modes& modes, const WornCoefficients& coefficients) noexcept : states(modes.now)
        {
            for (std::size_t i = 0; i < coefficients.groups.size(); ++i)
                most[i] = states[i].energy();
        }
        void follow(const FrameGroup& drives, const WornCoefficients& coefficients) noexcept
        {
            for (std::size_t i = 0; i < coefficients.groups.size(); ++i)
            {
                states[i] = coefficients.groups[i].next(states[i], drives);
                most[i] = std::max(most[i], states[i].energy());
            }
        }
        void moveTo(Modes& modes, const WornCoefficients& coefficients) const noexcept
        {
            for (std::size_t i = 0; i < coefficients.groups.size(); ++i)
                modes.now[i] = modes.start[i] = states[i];
        }
    };

    /// Whether the sum of the amplitudes, `sum` of the highest ones at the groups' ends, has certainly been within
    /// `limit`, between these, too.
    [[nodiscard]] bool stays(double sum, double peak, double limit) const noexcept
    {
        constexpr double safely = 1.0 - 1e-6; // far more than rounding
        return sum + guard.groupReach * peak <= safely * limit;
    }

    /// Lets modes follow whole groups if the sum of their amplitudes is then certain to stay within `limit`.
    bool followFreely(Modes& modes, std::span<const double> drive, double peak, double limit) const noexcept
    {
        Following following(modes, guard);
        for (std::size_t n = 0; n < drive.size(); n += groupFrames)
            following.follow(groupAt(drive, n), guard);
        double sum = 0.0;
        for (std::size_t i = 0; i < guard.groups.size(); ++i)
            sum += std::sqrt(following.most[i]);
        if (!stays(sum, peak, limit))
            return false;
        following.moveTo(modes, guard);
        return true;
    }

    /// The largest part of `drive` after which the sum of amplitudes is within its limit.
    ///
    /// That sum is a convex function of the drive. Its chord from 0 gives a first drive that is admissible. From one
    /// with the amplitudes a_i and their sum S, (sum of any amplitudes b_i)^2 <= S sum b_i^2 / a_i by Cauchy and
    /// Schwarz, with equality at b = a: where this quadratic meets the limit is a drive that is not smaller and still
    /// admissible (D. R. Hunter and K. Lange, "A tutorial on MM algorithms", The American Statistician 2004). With one
    /// mode the first step is exact.
    [[nodiscard]] double admitTo(const WornCoefficients::Steps& steps, double drive) const noexcept
    {
        constexpr int rounds = 4; // what is still missed then is below 1 % of the drive as a rule, and safe
        std::array<ResonatorState, WornCoefficients::maxModes> free;
        double atRest = 0.0;
        double wanted = 0.0;
        for (std::size_t i = 0; i < steps.size(); ++i)
        {
            free[i] = steps[i].free(moved.now[i]);
            atRest += std::sqrt(free[i].energy());
            wanted += std::sqrt(after(steps[i], free[i], drive).energy());
        }
        if (wanted <= guard.limit)
            return drive;
        if (!(atRest <= guard.limit))
            return 0.0; // only when the limits were just narrowed
        const double sign = drive < 0.0 ? -1.0 : 1.0;
        double most = std::abs(drive) * (guard.limit - atRest) / (wanted - atRest);
        for (int round = 0; round < rounds; ++round)
        {
            double sum = 0.0;
            std::array<double, WornCoefficients::maxModes> amplitude{};
            for (std::size_t i = 0; i < steps.size(); ++i)
            {
                amplitude[i] = std::max(std::sqrt(after(steps[i], free[i], sign * most).energy()), 1e-9 * guard.limit);
                sum += amplitude[i];
            }
            // a drive^2 + 2 b drive = room
            double a = 0.0;
            double b = 0.0;
            double room = guard.limit * guard.limit / sum;
            for (std::size_t i = 0; i < steps.size(); ++i)
            {
                const HeldStep& step = steps[i];
                const double weight = 1.0 / amplitude[i];
                a += weight * (step.driveToX * step.driveToX + step.driveToV * step.driveToV);
                b += weight * sign * (free[i].displacement * step.driveToX + free[i].velocity * step.driveToV);
                room -= weight * free[i].energy();
            }
            const double square = b * b + a * room;
            if (!(square >= 0.0 && a > 0.0))
                break;
            const double root = std::sqrt(square);
            const double next = b > 0.0 ? room / (b + root) : (root - b) / a;
            if (!(next > most))
                break;
            most = std::min(next, std::abs(drive));
        }
        return sign * most;
    }

    [[nodiscard]] static ResonatorState after(const HeldStep& step, const ResonatorState& free, double drive) noexcept
    {
        return {free.displacement + step.driveToX * drive, free.velocity + step.driveToV * drive};
    }

    WornCoefficients guard;
    double perWantedLimit = 1.0; // 1/m^2
    Modes moved;
    Modes asWanted;
};

} // namespace pacini
