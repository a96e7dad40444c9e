#pragma once

// Loudness over time: forward masking, and the slow rise of the loudness of short sounds (ISO 532-1, 6.4 and 6.5).

#include <pacini/hearing/SpecificLoudness.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>

namespace pacini
{

namespace detail
{
inline constexpr int loudnessSubsteps = 24; ///< between two sets, which are joined by straight lines
} // namespace detail

/// A one-pole low-pass of `tau` seconds for straight lines between values, exactly as 24 steps between two values would
/// give it, started at rest. `rate` (Hz) is that of the values.
class LoudnessSmoothing
{
public:
    LoudnessSmoothing(double tau, double rate) noexcept
    {
        // With u(m) = u + m d, m = 1..n: y(n) = a^n y + (1 - a) sum a^(n - m) u(m).
        constexpr int n = detail::loudnessSubsteps;
        const double a = std::exp(-1.0 / (rate * n * tau));
        share = 1.0 - a;
        for (int m = n; m >= 1; --m)
        {
            first += share * kept;
            second += share * kept * m / n;
            kept *= a;
        }
    }

    /// The output at the time of `value`.
    double next(double value) noexcept
    {
        y = started ? kept * y + first * last + second * (value - last) : share * value;
        last = value;
        started = true;
        return y;
    }

private:
    double share = 0.0, kept = 1.0;
    double first = 0.0, second = 0.0, y = 0.0, last = 0.0;
    bool started = false;
};

/// Total loudness over time as it is heard: a fast and a slow memory (ISO 532-1, 6.5).
class LoudnessMemory
{
public:
    /// `rate` (Hz) is that of the values.
    explicit LoudnessMemory(double rate) noexcept : fast(0.0035, rate), slow(0.070, rate) {}

    double next(double total) noexcept { return 0.47 * fast.next(total) + 0.53 * slow.next(total); }

private:
    LoudnessSmoothing fast;
    LoudnessSmoothing slow;
};

/// Core loudness that follows rises at once and falls as two coupled capacitors do, the slower the longer the sound
/// was (ISO 532-1:2017, 6.4; time constants 5, 15 and 75 ms).
class LoudnessDecay
{
public:
    /// `rate` (Hz) is that of the sets of powers; the standard has 2000, and 24 steps between two of them. At lower
    /// rates twelve steps change the loudness by .02 % (root mean square).
    explicit LoudnessDecay(double rate) noexcept
        : substeps(rate < 2000.0 ? 12 : detail::loudnessSubsteps),
          substep(1.0 / (rate * substeps)),
          one(substep),
          others((substeps - 1) * substep)
    {
        for (int k = 0; k < substeps - 1; ++k)
        {
            // Of m <- filling (value + k rise) - fillingByMemory m
            fillingKept *= -one.fillingByMemory;
            filled = one.filling - one.fillingByMemory * filled;
            filledByRise = one.filling * k - one.fillingByMemory * filledByRise;
        }
    }

    /// Returns the remainder of earlier sets at the time of `input`, one step after the set before and before `next`.
    CoreLoudness step(const CoreLoudness& input, const CoreLoudness& next) noexcept
    {
        CoreLoudness result{};
        for (std::size_t band = 0; band < states.size(); ++band)
        {
            State& state = states[band];
            const double value = input[band];
            const double rise = (next[band] - value) / substeps;
            tick(state, value);
            result[band] = state.output;
            if (value == 0.0 && next[band] == 0.0 && state.output == 0.0)
                continue; // silence after silence: the memory alone falls, and no output shows it before a rise
            if (fallsFreely(state, std::max(value, next[band])))
                continue;
            if (rise < 0.0)
            {
                if (!followsDown(state, value, rise))
                    fall(state, value, rise);
            }
            else if (state.output == value)
                follow(state, value, rise);
            else
                for (int m = 1; m < substeps; ++m)
                    tick(state, value + m * rise);
        }
        return result;
    }

private:
    struct State
    {
        double output = 0.0;
        double memory = 0.0;
    };

    /// What two coupled capacitors do exactly within some time when nothing charges them.
    struct Discharge
    {
        double falling, fallingByMemory; // output
        double filling, fillingByMemory; // memory, while it is below the output
        double together;                 // both, once they are equal

        explicit Discharge(double seconds) noexcept
        {
            constexpr double shortTau = 0.005;
            constexpr double longTau = 0.015;
            constexpr double p = (memoryTau + longTau) / (memoryTau * shortTau);
            constexpr double q = 1.0 / (memoryTau * shortTau);
            const double root = std::sqrt(0.25 * p * p - q);
            const double lambda1 = -0.5 * p + root;
            const double lambda2 = -0.5 * p - root;
            const double e1 = std::exp(lambda1 * seconds);
            const double e2 = std::exp(lambda2 * seconds);
            const double den = memoryTau * (lambda1 - lambda2);
            filling = (e1 - e2) / den;
            fillingByMemory = ((memoryTau * lambda2 + 1.0) * e1 - (memoryTau * lambda1 + 1.0) * e2) / den;
            falling = ((memoryTau * lambda1 + 1.0) * e1 - (memoryTau * lambda2 + 1.0) * e2) / den;
            fallingByMemory = (memoryTau * lambda1 + 1.0) * (memoryTau * lambda2 + 1.0) * (e1 - e2) / den;
            together = std::exp(-seconds / longTau);
        }

        [[nodiscard]] double output(const State& from) const noexcept
        {
            return from.output * falling - from.memory * fallingByMemory;
        }
        [[nodiscard]] double memory(const State& from) const noexcept
        {
            return from.output * filling - from.memory * fillingByMemory;
        }
    };

    /// The memory is never above the output.
    void tick(State& state, double input) const noexcept
    {
        if (input < state.output)
            return tickDown(state, input);
        state.output = input;
        state.memory = (state.memory - input) * rising + input;
    }

    /// For an input below the last output.
    void tickDown(State& state, double input) const noexcept
    {
        const State last = state;
        if (last.output > last.memory)
        {
            state.output = std::max(input, one.output(last));
            state.memory = std::min(state.output, one.memory(last));
        }
        else
        {
            state.output = std::max(input, last.output * one.together);
            state.memory = state.output;
        }
    }

    /// All substeps but the first at once, and true, if neither an input, which are at most `highest`, nor the memory
    /// reaches the output in them. Until then both are sums of two exponentials, and so is their difference, which has
    /// at most one zero: if the memory is below the output behind the last step, it was so all the time.
    [[nodiscard]] bool fallsFreely(State& state, double highest) const noexcept
    {
        if (!(state.output > highest))
            return false;
        const bool apart = state.output > state.memory;
        const double output = apart ? others.output(state) : state.output * others.together;
        const double memory = apart ? others.memory(state) : output;
        if (!(output > highest && memory <= output))
            return false;
        state = {output, memory};
        return true;
    }

    /// All substeps but the first of a falling input: none of them reaches the output before it.
    void fall(State& state, double value, double rise) const noexcept
    {
        State s = state;
        for (int m = 1; m < substeps; ++m)
            tickDown(s, value + m * rise);
        state = s;
    }

    /// All substeps but the first at once, and true, for an input that falls so slowly that the output follows it in
    /// each of them, while the memory stays below both: it is then a one-pole filter of a straight line.
    [[nodiscard]] bool followsDown(State& state, double value, double rise) const noexcept
    {
        const int n = substeps - 1;
        const double end = value + n * rise;
        const double before = end - rise;
        // The output could fall least, relative to the input, in the last step and with the largest memory. This gains
        // less than the filling from `value` in each step.
        const double largest = state.memory + n * one.filling * value;
        if (!(state.output == value && largest < end && one.falling * before - one.fallingByMemory * largest <= end))
            return false;
        state = {end, fillingKept * state.memory + filled * value + filledByRise * rise};
        return true;
    }

    /// All substeps but the first of an input that does not fall, from where the output follows it: the memory is then
    /// a one-pole filter of a straight line.
    void follow(State& state, double value, double rise) const noexcept
    {
        state.output = value + (substeps - 1) * rise;
        state.memory = (state.memory - value) * memoryKept + value + memoryRisen * rise;
    }

    std::array<State, std::tuple_size_v<CoreLoudness> - 1> states{};

    static constexpr double memoryTau = 0.075; // s

    int substeps;     // from one set to the next
    double substep;   // s
    Discharge one;    // substep
    Discharge others; // substeps of a set, but the first
    const double rising = std::exp(-substep / memoryTau);
    // Of n = substeps - 1 steps: rising^n, and the sum of (1 - rising) rising^(n - m) m over the steps m.
    const double memoryKept = std::pow(rising, substeps - 1);
    const double memoryRisen = substeps - 1 - rising * (1.0 - memoryKept) / (1.0 - rising);
    // Of the memory below an output that follows a falling line: its share, that of the value, and that of the rise.
    double fillingKept = 1.0;
    double filled = 0.0;
    double filledByRise = 0.0;
};

} // namespace pacini
