#pragma once

// Powers of 28 third-octave bands over time, the input of the loudness model of ISO 532-1.

#include <pacini/foundation/DotProduct.h>
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
/// would lie within the spectrum there. All bands have the same zeros, which are therefore computed once; two bands
/// share a vector register.
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
                two.sections[s].a1 = Pair(one.a1[s], other.a1[s]);
                two.sections[s].a2 = Pair(one.a2[s], other.a2[s]);
            }
            two.gain = Pair(one.gain * one.gain / together, other.gain * other.gain / together);
            two.smoothing = Pair(one.smoothing, other.smoothing);
        }
    }

    /// The next samples, which change to what the zeros leave of them. Writes the powers after the first `ends[i]`
    /// samples to `sets[i]`, ascending.
    void process(std::span<double> x, std::span<const std::size_t> ends, std::span<BandPowers> sets) noexcept
    {
        for (double& v : x)
            for (auto& stage : past)
            {
                // One zero at 0 Hz, and at 48 kHz one at half the rate.
                const double earlier = stage.back();
                stage.back() = stage.front();
                stage.front() = v;
                v -= earlier;
            }
        for (std::size_t k = 0; k < Count; k += 2)
            run(twos[k / 2], x, ends, sets, First + k);
        squared = static_cast<int>((static_cast<std::size_t>(squared) + x.size()) % together);
    }

    void flush() noexcept
    {
        for (Two& two : twos)
        {
            for (Section& section : two.sections)
                for (Pair* state : {&section.first, &section.second})
                    *state = cleared(*state, 1e-100);
            for (Pair& state : two.smooth)
                state = cleared(state, 1e-100);
        }
    }

private:
    static_assert(Count % 2 == 0);

    /// Two poles: y[n] = x[n] - a1 y[n - 1] - a2 y[n - 2].
    struct Section
    {
        Pair a1, a2, first, second;
    };

    /// Two bands, side by side in vector registers.
    struct Two
    {
        std::array<Section, 3> sections;
        std::array<Pair, 3> smooth;
        Pair gain; ///< of the mean power
        Pair smoothing, power;
    };

    void run(Two& two, std::span<const double> x, std::span<const std::size_t> ends, std::span<BandPowers> sets,
             std::size_t band) const noexcept
    {
        Two state = two; // a copy, so that the compiler can keep it in registers
        int summed = squared;
        const auto advance = [&](std::size_t from, std::size_t to)
        {
            for (std::size_t i = from; i < to; ++i)
            {
                Pair y(x[i]);
                for (Section& section : state.sections)
                {
                    y = y - section.a2 * section.second - section.a1 * section.first;
                    section.second = section.first;
                    section.first = y;
                }
                state.power = state.power + y * y;
                if (++summed < together)
                    continue;
                summed = 0;
                Pair power = state.power;
                state.power = Pair();
                for (Pair& stage : state.smooth)
                    power = stage = stage + state.smoothing * (power - stage);
            }
        };
        std::size_t done = 0;
        for (std::size_t i = 0; i < ends.size(); ++i)
        {
            advance(done, ends[i]);
            done = ends[i];
            const Pair power = state.gain * state.smooth[2];
            sets[i][band] = (power.first() + 1e-12) / 4e-10;
            sets[i][band + 1] = (power.second() + 1e-12) / 4e-10;
        }
        advance(done, x.size());
        two = state;
    }

    struct Design
    {
        std::array<double, 3> a1, a2;
        double gain, smoothing;
    };

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
    std::array<std::array<double, Factor == 1 ? 2 : 1>, 3> past{}; // inputs of the three stages of zeros
    int squared = Factor == 1 ? 1 : 0;                             // the third sample is due there, as sets are
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
        output = dotProduct(coefficients.data(), history.data() + at, taps);
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
        for (std::size_t done = 0; done < pressure.size(); done += piece)
            processPiece(pressure.subspan(done, std::min(piece, pressure.size() - done)), powers);
    }

    /// The sets that process() still owes.
    void finish(std::vector<BandPowers>& powers)
    {
        constexpr std::array<float, latency> silence{};
        processPiece(silence, powers);
    }

private:
    // Sets are so much late. Low-pass filters make the lower rates late, their coarser smoothing makes them early
    // (by 1.5 steps of three filters) and so do the zeros that they lack: by these delays all bands meet within 4
    // samples.
    static constexpr std::size_t latency = 38;
    static constexpr std::size_t piece = flushInterval;
    static_assert(latency <= piece);

    /// At most `piece` samples; each group of bands runs through them at its own rate.
    void processPiece(std::span<const float> pressure, std::vector<BandPowers>& powers)
    {
        for (auto* ends : {&highEnds, &middleEnds, &lowEnds})
            ends->clear();
        std::size_t middles = 0;
        std::size_t lows = 0;
        for (std::size_t n = 0; n < pressure.size(); ++n)
        {
            const double x = finiteOrZero(pressure[n]);
            atHigh[n] = highDelay.tick(x);
            double quarter = 0.0;
            if (toMiddle.tick(x, quarter))
            {
                atMiddle[middles++] = middleDelay.tick(quarter);
                double sixteenth = 0.0;
                if (toLow.tick(lowDelay.tick(quarter), sixteenth))
                    atLow[lows++] = sixteenth;
            }
            if (untilSet == 0)
            {
                untilSet = hop;
                highEnds.push_back(n + 1);
                middleEnds.push_back(middles);
                lowEnds.push_back(lows);
            }
            --untilSet;
        }
        powers.resize(powers.size() + highEnds.size());
        const auto sets = std::span(powers).last(highEnds.size());
        high.process(std::span(atHigh).first(pressure.size()), highEnds, sets);
        middle.process(std::span(atMiddle).first(middles), middleEnds, sets);
        low.process(std::span(atLow).first(lows), lowEnds, sets);
        low.flush();
        middle.flush();
        high.flush();
    }

    std::size_t hop;
    std::size_t untilSet = latency; // samples
    detail::FixedDelay<41> highDelay;
    detail::FixedDelay<9> middleDelay;
    detail::FixedDelay<5> lowDelay;
    detail::QuarterRate toMiddle{latency % 4}; // due when sets are
    detail::QuarterRate toLow{latency / 4 % 4};
    detail::ThirdOctaveGroup<0, 12, 16> low;
    detail::ThirdOctaveGroup<12, 8, 4> middle;
    detail::ThirdOctaveGroup<20, 8, 1> high;

    std::array<double, piece> atHigh; // samples of a piece at the rate of each group
    std::array<double, piece / 4 + 1> atMiddle;
    std::array<double, piece / 16 + 1> atLow;
    std::vector<std::size_t> highEnds, middleEnds, lowEnds; // samples before each set
};

} // namespace pacini
