#pragma once

// Loudness along the basilar membrane from third-octave levels, by Zwicker's method (ISO 532-1).

#include <pacini/foundation/Units.h>
#include <pacini/hearing/ThirdOctaveLevels.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pacini
{

/// Loudness that each of the 20 critical bands causes at its own place (core loudness), in sone per Bark, and a zero
/// for the edge at 24 Bark.
using CoreLoudness = std::array<double, 21>;

/// Specific loudness pattern of one moment on the scale of the ear.
struct LoudnessPattern
{
    double total = 0.0;              ///< sone
    double sharpness = 0.0;          ///< acum, 0 in silence
    std::array<double, 24> specific; ///< sone per Bark, mean of each Bark
};

namespace detail
{

/// Reduction of the levels of the 11 bands up to 250 Hz by the equal-loudness contours, dB, for levels up to `limit` dB
/// above it: ISO 532-1:2017, table A.3.
inline constexpr std::size_t lowBands = 11;
struct LowBandCorrection
{
    double limit;
    std::array<double, lowBands> level;
};
inline constexpr std::array<LowBandCorrection, 8> lowBandCorrections{{
    {45.0, {-32, -24, -16, -10, -5, 0, -7, -3, 0, -2, 0}},
    {55.0, {-29, -22, -15, -10, -4, 0, -7, -2, 0, -2, 0}},
    {65.0, {-27, -19, -14, -9, -4, 0, -6, -2, 0, -2, 0}},
    {71.0, {-25, -17, -12, -9, -3, 0, -5, -2, 0, -2, 0}},
    {80.0, {-23, -16, -11, -7, -3, 0, -4, -1, 0, -1, 0}},
    {90.0, {-20, -14, -10, -6, -3, 0, -4, -1, 0, -1, 0}},
    {100.0, {-18, -12, -9, -6, -2, 0, -3, -1, 0, -1, 0}},
    {120.0, {-15, -10, -8, -4, -2, 0, -3, -1, 0, -1, 0}},
}};

/// Of one critical band: tables A.4 (ear's transmission), A.6 (threshold), A.7 (third octave to critical band), A.8
/// (upper limit).
struct CriticalBand
{
    double transmission; ///< dB
    double threshold;    ///< dB
    double adaptation;   ///< dB
    double limit;        ///< Bark
};
inline constexpr std::array<CriticalBand, 20> criticalBands{{
    {0.0, 30.0, -0.25, 0.9}, {0.0, 18.0, -0.6, 1.8}, {0.0, 12.0, -0.8, 2.8}, {0.0, 8.0, -0.8, 3.5},
    {0.0, 7.0, -0.5, 4.4},   {0.0, 6.0, 0.0, 5.4},   {0.0, 5.0, 0.5, 6.6},   {0.0, 4.0, 1.1, 7.9},
    {0.0, 3.0, 1.5, 9.2},    {0.0, 3.0, 1.7, 10.6},  {-0.5, 3.0, 1.8, 12.3}, {-1.6, 3.0, 1.8, 13.8},
    {-3.2, 3.0, 1.7, 15.2},  {-5.4, 3.0, 1.6, 16.7}, {-5.6, 3.0, 1.4, 18.1}, {-4.0, 3.0, 1.2, 19.3},
    {-1.5, 3.0, 0.8, 20.6},  {2.0, 3.0, 0.5, 21.8},  {5.0, 3.0, 0.0, 22.7},  {12.0, 3.0, -0.5, 23.6},
}};

/// The tables above as ratios of powers, so that no level needs a logarithm.
struct EarPowers
{
    std::array<std::array<double, lowBands>, lowBandCorrections.size()> limits;
    std::array<std::array<double, lowBands>, lowBandCorrections.size()> corrections;
    std::array<double, criticalBands.size()> thresholds; ///< least power that is heard
    std::array<double, criticalBands.size()> gains;      ///< to the excitation re the threshold
    std::array<double, criticalBands.size()> heights;    ///< sone per Bark

    EarPowers() noexcept
    {
        const auto power = [](double level)
        {
            return std::pow(10.0, 0.1 * level);
        };
        for (std::size_t row = 0; row < lowBandCorrections.size(); ++row)
            for (std::size_t k = 0; k < lowBands; ++k)
            {
                corrections[row][k] = power(lowBandCorrections[row].level[k]);
                limits[row][k] = power(lowBandCorrections[row].limit - lowBandCorrections[row].level[k]);
            }
        for (std::size_t band = 0; band < criticalBands.size(); ++band)
        {
            const CriticalBand& ear = criticalBands[band];
            thresholds[band] = power(ear.threshold + ear.transmission);
            gains[band] = power(-ear.transmission - ear.adaptation - ear.threshold);
            heights[band] = 0.0635 * std::pow(10.0, 0.025 * ear.threshold);
        }
    }
};

/// Slope of the loudness towards higher bands, by its height and the band below: table A.9.
struct UpperSlope
{
    double above;                ///< sone per Bark: holds for heights above it
    std::array<double, 8> slope; ///< sone per Bark^2; the last holds for all bands from there on
};
inline constexpr std::array<UpperSlope, 18> upperSlopes{{
    {21.5, {13.0, 8.2, 6.3, 5.5, 5.5, 5.5, 5.5, 5.5}},
    {18.0, {9.0, 7.5, 6.0, 5.1, 4.5, 4.5, 4.5, 4.5}},
    {15.1, {7.8, 6.7, 5.6, 4.9, 4.4, 3.9, 3.9, 3.9}},
    {11.5, {6.2, 5.4, 4.6, 4.0, 3.5, 3.2, 3.2, 3.2}},
    {9.0, {4.5, 3.8, 3.6, 3.2, 2.9, 2.7, 2.7, 2.7}},
    {6.1, {3.7, 3.0, 2.8, 2.35, 2.2, 2.2, 2.2, 2.2}},
    {4.4, {2.9, 2.3, 2.1, 1.9, 1.8, 1.7, 1.7, 1.7}},
    {3.1, {2.4, 1.7, 1.5, 1.35, 1.3, 1.3, 1.3, 1.3}},
    {2.13, {1.95, 1.45, 1.3, 1.15, 1.1, 1.1, 1.1, 1.1}},
    {1.36, {1.5, 1.2, 0.94, 0.86, 0.82, 0.82, 0.82, 0.82}},
    {0.82, {0.72, 0.67, 0.64, 0.63, 0.62, 0.62, 0.62, 0.62}},
    {0.42, {0.59, 0.53, 0.51, 0.5, 0.42, 0.42, 0.42, 0.42}},
    {0.3, {0.4, 0.33, 0.26, 0.24, 0.24, 0.22, 0.22, 0.22}},
    {0.22, {0.27, 0.21, 0.2, 0.18, 0.17, 0.17, 0.17, 0.17}},
    {0.15, {0.16, 0.15, 0.14, 0.12, 0.11, 0.11, 0.11, 0.11}},
    {0.1, {0.12, 0.11, 0.1, 0.08, 0.08, 0.08, 0.08, 0.08}},
    {0.035, {0.09, 0.08, 0.07, 0.06, 0.06, 0.06, 0.06, 0.05}},
    {0.0, {0.06, 0.05, 0.03, 0.02, 0.02, 0.02, 0.02, 0.02}},
}};

/// Integrates a falling or level piece of the pattern into the Barks that it crosses.
class PatternSum
{
public:
    void add(double from, double to, double height, double slope) noexcept
    {
        while (from < to)
        {
            const auto bark = std::min<std::size_t>(23, static_cast<std::size_t>(from));
            const double end = bark == 23 ? to : std::min(to, static_cast<double>(bark + 1));
            const double width = end - from;
            const double area = width * (height - 0.5 * slope * width);
            const double middle = 0.5 * (from + end);
            pattern.total += area;
            pattern.specific[bark] += area;
            weighted += area * middle * brightnessWeight(middle);
            height -= slope * width;
            from = end;
        }
    }

    [[nodiscard]] LoudnessPattern result() noexcept
    {
        pattern.sharpness = pattern.total > 0.0 ? 0.11 * weighted / pattern.total : 0.0;
        return pattern;
    }

private:
    /// DIN 45692:2009, equation 2.
    static double brightnessWeight(double bark) noexcept
    {
        return bark <= 15.8 ? 1.0 : 0.15 * std::exp(0.42 * (bark - 15.8)) + 0.85;
    }

    LoudnessPattern pattern{0.0, 0.0, {}};
    double weighted = 0.0;
};

/// The whole area of the pattern.
struct LoudnessSum
{
    double total = 0.0; ///< sone

    void add(double from, double to, double height, double slope) noexcept
    {
        const double width = to - from;
        total += width * (height - 0.5 * slope * width);
    }
};

} // namespace detail

/// The core loudness of `powers` in a free field (ISO 532-1:2017, 5.4 and 5.5). Levels above 120 dB are outside of the
/// method, and are taken like those of 120 dB are.
[[nodiscard]] inline CoreLoudness coreLoudness(const BandPowers& powers) noexcept
{
    static const detail::EarPowers ear;
    // The lowest three critical bands are sums of 6, 3 and 2 bands.
    std::array<double, 3> low{};
    for (std::size_t k = 0; k < detail::lowBands; ++k)
    {
        std::size_t row = 0;
        while (row + 1 < detail::lowBandCorrections.size() && powers[k] > ear.limits[row][k])
            ++row;
        low[k < 6 ? 0 : k < 9 ? 1 : 2] += powers[k] * ear.corrections[row][k];
    }
    CoreLoudness core{};
    for (std::size_t band = 0; band < detail::criticalBands.size(); ++band)
    {
        const double power = band < 3 ? low[band] : powers[band + 8];
        if (!(power > ear.thresholds[band]))
            continue;
        constexpr double s = 0.25;
        const double above = 1.0 - s + s * power * ear.gains[band];
        core[band] = std::max(0.0, ear.heights[band] * (std::sqrt(std::sqrt(above)) - 1.0));
    }
    // The threshold rises within the lowest band.
    if (core[0] > 0.0)
        core[0] *= std::min(1.0, 0.4 + 0.32 * std::pow(core[0], 0.2));
    return core;
}

namespace detail
{
/// Calls sum.add(from, to, height, slope) for each falling or level piece of core loudness with what it masks above
/// itself (ISO 532-1:2017, 5.6 and 5.7).
template <typename Sum>
void addPieces(const CoreLoudness& core, Sum& sum) noexcept
{
    double from = 0.0;
    double height = 0.0;
    std::size_t row = 0;
    for (std::size_t band = 0; band < core.size(); ++band)
    {
        const double limit = band < criticalBands.size() ? criticalBands[band].limit : 24.0;
        const std::size_t column = std::min<std::size_t>(7, band > 0 ? band - 1 : 0);
        while (from < limit)
        {
            if (height <= core[band])
            {
                if (height < core[band])
                    row = static_cast<std::size_t>(std::find_if(upperSlopes.begin(), upperSlopes.end() - 1,
                                                                [&](const UpperSlope& entry)
                                                                { return entry.above < core[band]; }) -
                                                   upperSlopes.begin());
                height = core[band];
                sum.add(from, limit, height, 0.0);
                from = limit;
            }
            else
            {
                const double slope = upperSlopes[row].slope[column];
                const double floor = std::max(upperSlopes[row].above, core[band]);
                const double reach = (height - floor) / slope;
                const double to = std::min(limit, from + reach);
                sum.add(from, to, height, slope);
                height = from + reach <= limit ? floor : height - slope * (limit - from);
                from = to;
            }
            while (row + 1 < upperSlopes.size() && height <= upperSlopes[row].above)
                ++row;
        }
    }
}
} // namespace detail

/// Core loudness with what it masks above itself, summed to loudness, and to sharpness by DIN 45692:2009. The standard
/// rounds the sum to three digits; this does not.
[[nodiscard]] inline LoudnessPattern loudnessPattern(const CoreLoudness& core) noexcept
{
    detail::PatternSum sum;
    detail::addPieces(core, sum);
    return sum.result();
}

/// The total of loudnessPattern() alone, in sone.
[[nodiscard]] inline double totalLoudness(const CoreLoudness& core) noexcept
{
    detail::LoudnessSum sum;
    detail::addPieces(core, sum);
    return sum.total;
}

} // namespace pacini
