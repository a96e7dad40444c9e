#pragma once

// Figures of a measured actuator by which standards, guides and data sheets compare actuators.

#include <pacini/linearize/MeasurementFindings.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// Frequencies around the strongest one that are less than a limit below it. An end that was not measured is open.
struct Bandwidth
{
    FrequencyRange range;
    bool lowOpen = false;
    bool highOpen = false;
};

/// The bandwidth `below` dB (above 0) under the strongest level of a valid response; its ends lie on straight lines
/// over the logarithm of frequency between the measured points.
[[nodiscard]] inline Bandwidth bandwidthOf(const FrequencyResponse& response, double below)
{
    const auto& f = response.frequency;
    const auto& level = response.level;
    const auto strongest = static_cast<std::size_t>(std::max_element(level.begin(), level.end()) - level.begin());
    const double limit = level[strongest] - below;
    const auto crossing = [&](std::size_t inside, std::size_t outside)
    {
        const double part = (level[inside] - limit) / (level[inside] - level[outside]);
        return f[inside] * std::pow(f[outside] / f[inside], part);
    };
    std::size_t low = strongest;
    while (low > 0 && level[low - 1] >= limit)
        --low;
    std::size_t high = strongest;
    while (high + 1 < response.size() && level[high + 1] >= limit)
        ++high;
    Bandwidth width;
    width.lowOpen = low == 0;
    width.highOpen = high + 1 == response.size();
    width.range.low = width.lowOpen ? f.front() : crossing(low, low - 1);
    width.range.high = width.highOpen ? f.back() : crossing(high, high + 1);
    return width;
}

/// Edges of a burst as data sheets have them.
struct BurstEdges
{
    double rise = 0.0; ///< s from 10 to 90 % of the final strength
    double fall = 0.0; ///< s from 90 to 10 % of it
};

/// The edges of a burst at `frequency` Hz, see burstTimes() for the envelope and for the errors. A resonator of one
/// degree of freedom, driven where it resonates, has q ln(9) / (pi f) for both.
[[nodiscard]] inline Result<BurstEdges> burstEdges(const ImpulseResponse& response, double frequency)
{
    if (const auto times = burstTimes(response, frequency); !times)
        return times.error();
    const double w = 2.0 * std::numbers::pi * frequency / response.sampleRate;
    std::vector<std::complex<double>> sum(response.samples.size());
    std::complex<double> running = 0.0;
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] = running += response.samples[i] * std::polar(1.0, -w * static_cast<double>(i));
    const double final = std::abs(running);
    // The first passage upwards and the last one downwards, by a straight line between two samples.
    const auto place = [](double before, double after, double limit, std::size_t i)
    {
        return static_cast<double>(i) - (after - limit) / (after - before);
    };
    const auto risesTo = [&](double share)
    {
        std::size_t i = 0;
        while (std::abs(sum[i]) < share * final)
            ++i;
        return i == 0 ? 0.0 : place(std::abs(sum[i - 1]), std::abs(sum[i]), share * final, i);
    };
    const auto fallsTo = [&](double share)
    {
        std::size_t i = sum.size() - 1;
        while (i > 0 && std::abs(running - sum[i - 1]) < share * final)
            --i;
        return i == 0 ? 0.0 : place(std::abs(running - sum[i - 1]), std::abs(running - sum[i]), share * final, i);
    };
    return BurstEdges{std::max(0.0, risesTo(0.9) - risesTo(0.1)) / response.sampleRate,
                      std::max(0.0, fallsTo(0.1) - fallsTo(0.9)) / response.sampleRate};
}

/// What an actuator loses with a mass on it, or on a person.
struct WornDrop
{
    ResonanceModel resonance; ///< with it
    double atResonance = 0.0; ///< dB below the free response at the free resonance; negative for a gain
    double atStrongest = 0.0; ///< dB between the strongest levels of both
    double mean = 0.0;        ///< dB, mean over the free bandwidth of 10 dB, even over the logarithm of frequency
};

/// Figures of an actuator.
struct ActuatorFigures
{
    ResonanceModel resonance;
    Bandwidth within3;                   ///< dB below the strongest frequency
    Bandwidth within10;                  ///< dB below it
    std::optional<BurstEdges> edges;     ///< medians over the placements; none if the recordings end too early
    double strongestFrequency = 0.0;     ///< Hz
    std::optional<double> strongest;     ///< m/s^2 at full drive; none if the levels are relative
    std::optional<double> perVolt;       ///< m/s^2 at 1 V; peak for peak, RMS for RMS
    double distortion = 0.0;             ///< %, the largest within 10 dB of the strongest frequency
    double distortionAtResonance = 0.0;  ///< %, the median over the placements
    std::vector<HarmonicPeak> harmonics; ///< as in MeasurementFindings
    double drive = 0.0;                  ///< dB re full drive of the sweep that distortion and noise belong to
    double noiseAtResonance = 0.0;       ///< dB below the response, the median over the placements
    double noiseAtWorst = 0.0;           ///< dB below the response, the least within 10 dB of the strongest frequency
    std::optional<WornDrop> worn;
};

/// The difference of two responses, of which `free` has `figures`. Errors: those of fitResonance().
[[nodiscard]] inline Result<WornDrop> wornDrop(const ActuatorFigures& figures, const FrequencyResponse& free,
                                               const FrequencyResponse& worn, double smoothing)
{
    ResponseFeatureParams params;
    params.smoothing = smoothing;
    const auto resonance = fitResonance(worn, params.lowFrequency, params.highFrequency, smoothing);
    if (!resonance)
        return resonance.error();
    WornDrop drop;
    drop.resonance = *resonance;
    const auto at = [&](double f)
    {
        return levelAt(free, f) - levelAt(worn, f);
    };
    drop.atResonance = at(figures.resonance.frequency);
    drop.atStrongest = *std::max_element(free.level.begin(), free.level.end()) -
                       *std::max_element(worn.level.begin(), worn.level.end());
    constexpr int steps = 64;
    const FrequencyRange& range = figures.within10.range;
    for (int i = 0; i <= steps; ++i)
        drop.mean += at(range.low * std::pow(range.high / range.low, static_cast<double>(i) / steps)) / (steps + 1);
    return drop;
}

/// The figures of `placements`, whose average is `average` and whose summary `findings`. `voltage` is the peak at full
/// drive, V (above 0). Levels are in m/s^2 if the sensor is `calibrated`, else relative.
[[nodiscard]] inline ActuatorFigures actuatorFigures(std::span<const SweepMeasurement* const> placements,
                                                     const PlacementAverage& average,
                                                     const MeasurementFindings& findings, std::optional<double> voltage,
                                                     bool calibrated)
{
    const FrequencyResponse& response = average.response;
    ActuatorFigures figures;
    figures.resonance = findings.features.resonance;
    figures.within3 = bandwidthOf(response, 3.0);
    figures.within10 = bandwidthOf(response, 10.0);
    const auto strongest = std::max_element(response.level.begin(), response.level.end());
    figures.strongestFrequency = response.frequency[static_cast<std::size_t>(strongest - response.level.begin())];
    if (calibrated)
        figures.strongest = Decibels(*strongest).gain();
    if (calibrated && voltage)
        figures.perVolt = *figures.strongest / *voltage;
    figures.harmonics = findings.harmonics;

    const FrequencyRange& range = figures.within10.range;
    const double f0 = figures.resonance.frequency;
    std::vector<double> rises, falls, distortions, noises;
    std::optional<double> worst;
    for (std::size_t i = 0; i < placements.size(); ++i)
    {
        if (findings.outliers.contains(i))
            continue;
        const SweepMeasurement& measured = *placements[i];
        const LevelMeasurement& level = measured.levels[measured.main];
        figures.drive = level.level;
        if (const auto edges = burstEdges(measured.impulseResponse, f0))
        {
            rises.push_back(edges->rise);
            falls.push_back(edges->fall);
        }
        figures.distortion = std::max(figures.distortion, largestDistortion(level, range.low, range.high));
        if (!level.distortion.empty())
            distortions.push_back(valueAt(level.response.frequency, level.distortion, f0));
        noises.push_back(levelAt(level.snr, f0));
        for (std::size_t k = 0; k < level.snr.size(); ++k)
            if (level.snr.frequency[k] >= range.low && level.snr.frequency[k] <= range.high)
                worst = std::min(worst.value_or(level.snr.level[k]), level.snr.level[k]);
    }
    if (!rises.empty())
        figures.edges = BurstEdges{detail::medianOf(std::move(rises)), detail::medianOf(std::move(falls))};
    if (!distortions.empty())
        figures.distortionAtResonance = detail::medianOf(std::move(distortions));
    if (!noises.empty())
        figures.noiseAtResonance = detail::medianOf(std::move(noises));
    figures.noiseAtWorst = worst.value_or(figures.noiseAtResonance);
    return figures;
}

} // namespace pacini
