#pragma once

// Powers of 28 third-octave bands over time, the input of the loudness model of ISO 532-1.

#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Pair.h>
#include <pacini/hearing/ThirdOctaveTables.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

/// Powers of the 28 bands at one time, re (20 uPa)^2. Silence is .0025 (-26 dB): the model adds 1e-12 Pa^2.
using BandPowers = std::array<double, thirdOctaveBands>;

namespace detail
{

/// Bands `First` to `First` + `Count` - 1 at 48 kHz / `Factor`: filters of sixth order, squared and smoothed by three
/// equal one-pole filters (ISO 532-1:2017, 6.2 and 6.3). The poles are those of the standard, z^Factor at the lower
/// rate. At 48 kHz the filters have the standard's three zeros at half the rate; lower rates leave these out, as they
/// would lie within the spectrum there. The bands lie side by side in memory, so that one step of all becomes vector
/// code.
template <std::size_t First, std::size_t Count, int Factor>
class ThirdOctaveGroup
{
public:
    static constexpr int together = Factor == 1 ? 4 : 1; ///< samples whose mean power is smoothed as one

    ThirdOctaveGroup()
    {
        for (std::size_t k = 0; k < Count; k += 2)
        {
            const Design one = design(k);
            const Design other = design(k + 1);
            Two& two = twos[k / 2];
            for (std::size_t s = 0; s < 3; ++s)
            {
                two.a1[s] = Pair(one.a1[s], other.a1[s]);
                two.a2[s] = Pair(one.a2[s], other.a2[s]);
            }
            two.gain = Pair(one.gain, other.gain);
            two.smoothing = Pair(one.smoothing, other.smoothing);
        }
    }

    void tick(double x) noexcept
    {
        const bool due = ++squared == together;
        if (due)
            squared = 0;
        for (Two& two : twos)
        {
            Pair y = Pair(x) * two.gain;
            for (std::size_t s = 0; s < 3; ++s)
            {
                // Transposed direct form II.
                const Pair in = y;
                y = in + two.first[s];
                two.first[s] = Pair(b1[s]) * in - two.a1[s] * y + two.second[s];
                two.second[s] = Pair(b2[s]) * in - two.a2[s] * y;
            }
            two.power = two.power + y * y;
            if (!due)
                continue;
            Pair power = two.power * Pair(1.0 / together);
            two.power = Pair();
            for (Pair& stage : two.smooth)
                power = stage = stage + two.smoothing * (power - stage);
        }
    }

    void write(BandPowers& powers) const noexcept
    {
        for (std::size_t k = 0; k < Count; k += 2)
        {
            powers[First + k] = (twos[k / 2].smooth[2].first() + 1e-12) / 4e-10;
            powers[First + k + 1] = (twos[k / 2].smooth[2].second() + 1e-12) / 4e-10;
        }
    }

    void flush() noexcept
    {
        for (Two& two : twos)
            for (auto* states : {&two.first, &two.second, &two.smooth})
                for (Pair& state : *states)
                    state = cleared(state, 1e-100);
    }

private:
    static_assert(Count % 2 == 0);

    /// Two bands, side by side in vector registers.
    struct Two
    {
        std::array<Pair, 3> a1, a2, first, second, smooth;
        Pair gain, smoothing, power;
    };

    struct Design
    {
        std::array<double, 3> a1, a2;
        double gain, smoothing;
    };

    // (z+1)^2, (z+1)(z-1), (z-1)^2, or 1, z-1 and (z-1)^2.
    static constexpr std::array<double, 3> b1 = Factor == 1 ? std::array{2.0, 0.0, -2.0} : std::array{0.0, -1.0, -2.0};
    static constexpr std::array<double, 3> b2 = Factor == 1 ? std::array{1.0, -1.0, 1.0} : std::array{0.0, 0.0, 1.0};

    static Design design(std::size_t k)
    {
        Design made;
        const ThirdOctaveFilter& table = thirdOctaveTable[First + k];
        const double centre = 1000.0 * std::pow(10.0, (static_cast<double>(First + k) - 16.0) / 10.0);
        const double turn = 2.0 * std::numbers::pi * centre / 48000.0;
        made.gain = table.gain;
        for (std::size_t s = 0; s < 3; ++s)
        {
            // With z = 1 + w the section is w^2 - d0 w - (d0 + d1), exact also where z is close to 1.
            const auto [d0, d1] = table.sections[s];
            const std::complex<double> w = 0.5 * (d0 + std::sqrt(std::complex<double>(d0 * d0 + 4.0 * (d0 + d1))));
            const std::complex<double> pole = std::pow(1.0 + w, Factor);
            made.a1[s] = Factor == 1 ? -2.0 - d0 : -2.0 * pole.real();
            made.a2[s] = Factor == 1 ? 1.0 - d1 : std::norm(pole);
            if constexpr (Factor > 1)
            {
                // At the centre as loud as at 48 kHz.
                const auto response = [s](std::complex<double> z, double c1, double c2, bool zerosAtHalf)
                {
                    const auto zero = zerosAtHalf ? z + 1.0 : std::complex<double>(1.0);
                    const auto numerator = s == 0 ? zero * zero : s == 1 ? zero * (z - 1.0) : (z - 1.0) * (z - 1.0);
                    return std::abs(numerator / (z * z + c1 * z + c2));
                };
                made.gain *= response(std::polar(1.0, turn), -2.0 - d0, 1.0 - d1, true) /
                             response(std::polar(1.0, turn * Factor), made.a1[s], made.a2[s], false);
            }
        }
        // Time constant of 2/3 of a period, from 1 kHz on that of 1 kHz.
        made.smoothing = -std::expm1(-1.5 * std::min(centre, 1000.0) * Factor * together / 48000.0);
        return made;
    }

    std::array<Two, Count / 2> twos;
    int squared = Factor == 1 ? 1 : 0; // the third sample is due there, as sets are
};

/// Every fourth sample of what a low-pass leaves, `delay` samples late. Flat within .01 dB to a twentieth of its rate,
/// 75 dB down from a fifth of it on: what it folds falls outside of the bands that follow.
class QuarterRate
{
public:
    static constexpr std::size_t delay = 12; ///< samples of the input

    /// `first`: how many samples come before the first one that is due.
    explicit QuarterRate(int first) noexcept : phase((4 - first) % 4)
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < taps; ++i)
        {
            const double t = static_cast<double>(i) - static_cast<double>(delay);
            const double u = t / static_cast<double>(delay + 1);
            const double angle = 0.25 * std::numbers::pi * t;
            // A Blackman window.
            const double window =
                0.42 + 0.5 * std::cos(std::numbers::pi * u) + 0.08 * std::cos(2.0 * std::numbers::pi * u);
            coefficients[i] = window * (i == delay ? 1.0 : std::sin(angle) / angle);
            sum += coefficients[i];
        }
        for (double& coefficient : coefficients)
            coefficient /= sum;
    }

    /// True for every fourth sample, whose output is then in `output`.
    bool tick(double x, double& output) noexcept
    {
        history[at] = history[at + taps] = x;
        at = at + 1 == taps ? 0 : at + 1;
        const bool due = phase == 0;
        phase = (phase + 1) % 4;
        if (!due)
            return false;
        double sum = 0.0;
        for (std::size_t i = 0; i < taps; ++i)
            sum += coefficients[i] * history[at + i];
        output = sum;
        return true;
    }

private:
    static constexpr std::size_t taps = 2 * delay + 1;
    std::array<double, taps> coefficients{};
    std::array<double, 2 * taps> history{};
    std::size_t at = 0;
    int phase;
};

/// A sample `Samples` late.
template <std::size_t Samples>
class FixedDelay
{
public:
    double tick(double x) noexcept
    {
        const double late = ring[at];
        ring[at] = x;
        at = at + 1 == Samples ? 0 : at + 1;
        return late;
    }

private:
    std::array<double, Samples> ring{};
    std::size_t at = 0;
};

} // namespace detail

/// The bands of a sound at 48 kHz, piece by piece: those up to 315 Hz at 3 kHz, those up to 2 kHz at 12 kHz, the others
/// at 48. Steady tones are at most .05 dB off what the filters of the standard, all at 48 kHz, have of them; loudness
/// is .07 % off.
class ThirdOctaveLevels
{
public:
    static constexpr double sampleRate = 48000.0; ///< Hz; the tables of the standard are those of this rate

    /// `samples` lie from one set of powers to the next.
    explicit ThirdOctaveLevels(std::size_t samples) : hop(samples) {}

    /// Appends the powers at samples 0, hop, 2 hop and so on of the sound, of which `pressure` in Pa is the next piece,
    /// of any length. What is not finite counts as 0. The last `latency` samples are heard by finish().
    void process(std::span<const float> pressure, std::vector<BandPowers>& powers)
    {
        for (const float p : pressure)
            tick(finiteOrZero(p), powers);
    }

    /// The sets that process() still owes.
    void finish(std::vector<BandPowers>& powers)
    {
        for (std::size_t n = 0; n < latency; ++n)
            tick(0.0, powers);
    }

private:
    // Sets are so much late. Low-pass filters make the lower rates late, their coarser smoothing makes them early
    // (by 1.5 steps of three filters) and so do the zeros that they lack: by these delays all bands meet within 4
    // samples.
    static constexpr std::size_t latency = 38;

    void tick(double x, std::vector<BandPowers>& powers)
    {
        high.tick(highDelay.tick(x));
        double quarter = 0.0;
        if (toMiddle.tick(x, quarter))
        {
            middle.tick(middleDelay.tick(quarter));
            double sixteenth = 0.0;
            if (toLow.tick(lowDelay.tick(quarter), sixteenth))
                low.tick(sixteenth);
        }
        if (untilSet == 0)
        {
            untilSet = hop;
            powers.emplace_back();
            low.write(powers.back());
            middle.write(powers.back());
            high.write(powers.back());
        }
        --untilSet;
        if (--untilFlush == 0)
        {
            untilFlush = flushInterval;
            low.flush();
            middle.flush();
            high.flush();
        }
    }

    std::size_t hop;
    std::size_t untilSet = latency; // samples
    std::size_t untilFlush = flushInterval;
    detail::FixedDelay<41> highDelay;
    detail::FixedDelay<9> middleDelay;
    detail::FixedDelay<5> lowDelay;
    detail::QuarterRate toMiddle{latency % 4}; // due when sets are
    detail::QuarterRate toLow{latency / 4 % 4};
    detail::ThirdOctaveGroup<0, 12, 16> low;
    detail::ThirdOctaveGroup<12, 8, 4> middle;
    detail::ThirdOctaveGroup<20, 8, 1> high;
};

} // namespace pacini
