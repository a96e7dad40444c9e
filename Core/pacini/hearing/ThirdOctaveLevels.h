#pragma once

// Levels of 28 third-octave bands over time, the input of the loudness model of ISO 532-1.

#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>
#include <pacini/hearing/ThirdOctaveTables.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pacini
{

/// Sound pressure levels of the 28 bands at one time, dB re 20 uPa. Silence is -26 dB: the model adds 1e-12 Pa^2.
using BandLevels = std::array<double, thirdOctaveBands>;

/// Third-octave filters of sixth order, squared and smoothed by three equal one-pole filters (ISO 532-1:2017, 6.2 and
/// 6.3), for a sound at 48 kHz, piece by piece. The bands lie side by side in memory, so that one step of all of them
/// becomes vector code.
class ThirdOctaveLevels
{
public:
    static constexpr double sampleRate = 48000.0; ///< Hz; the tables of the standard are those of this rate

    /// `samples` lie from one set of levels to the next.
    explicit ThirdOctaveLevels(std::size_t samples) : hop(samples) {}

    /// Appends the levels at samples 0, hop, 2 hop and so on of the sound, of which `pressure` in Pa is the next piece,
    /// of any length. What is not finite counts as 0.
    void process(std::span<const float> pressure, std::vector<BandLevels>& levels)
    {
        for (const float p : pressure)
        {
            tick(finiteOrZero(p));
            if (count % hop == 0)
                levels.push_back(current());
            if (count % flushInterval == 0)
                flush();
            ++count;
        }
    }

private:
    static constexpr std::size_t bands = thirdOctaveBands;
    using Values = std::array<double, bands>;

    void tick(double x) noexcept
    {
        // Transposed direct form II. The zeros of the three sections are (z+1)^2, (z+1)(z-1) and (z-1)^2: b = 1 b1 b2.
        static constexpr std::array<double, 3> b1{2.0, 0.0, -2.0};
        static constexpr std::array<double, 3> b2{1.0, -1.0, 1.0};
        Values y;
        for (std::size_t k = 0; k < bands; ++k)
            y[k] = x * design.gain[k];
        for (std::size_t s = 0; s < 3; ++s)
            for (std::size_t k = 0; k < bands; ++k)
            {
                const double in = y[k];
                const double out = in + first[s][k];
                first[s][k] = b1[s] * in - design.a1[s][k] * out + second[s][k];
                second[s][k] = b2[s] * in - design.a2[s][k] * out;
                y[k] = out;
            }
        for (std::size_t k = 0; k < bands; ++k)
        {
            double power = y[k] * y[k];
            for (auto& stage : smooth)
                power = stage[k] += design.smoothing[k] * (power - stage[k]);
        }
    }

    [[nodiscard]] BandLevels current() const noexcept
    {
        BandLevels levels;
        for (std::size_t k = 0; k < bands; ++k)
            levels[k] = Decibels::fromPower((smooth[2][k] + 1e-12) / 4e-10).value;
        return levels;
    }

    void flush() noexcept
    {
        for (auto* states : {&first, &second, &smooth})
            for (auto& section : *states)
                for (double& state : section)
                    flushTiny(state);
    }

    struct Design
    {
        std::array<Values, 3> a1;
        std::array<Values, 3> a2;
        Values gain;
        Values smoothing;

        Design() noexcept
        {
            for (std::size_t k = 0; k < bands; ++k)
            {
                const auto& row = thirdOctaveTable[k];
                for (std::size_t s = 0; s < 3; ++s)
                {
                    a1[s][k] = -2.0 - row.sections[s][0];
                    a2[s][k] = 1.0 - row.sections[s][1];
                }
                gain[k] = row.gain;
                // Time constant of 2/3 of a period, from 1 kHz on that of 1 kHz.
                const double centre = 1000.0 * std::pow(10.0, (static_cast<double>(k) - 16.0) / 10.0);
                smoothing[k] = -std::expm1(-1.5 * std::min(centre, 1000.0) / sampleRate);
            }
        }
    };

    std::size_t hop;
    Design design;
    std::uint64_t count = 0; // of samples
    std::array<Values, 3> first{};
    std::array<Values, 3> second{};
    std::array<Values, 3> smooth{};
};

} // namespace pacini
