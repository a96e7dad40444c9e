#pragma once

// Features of a response: resonance, plateau and range, the few numbers that a profile is made of.

#include <pacini/actuator/Profile.h>
#include <pacini/foundation/Result.h>
#include <pacini/linearize/PlacementAverage.h>
#include <pacini/linearize/ResonanceFit.h>
#include <pacini/linearize/SweepMeasurement.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

namespace pacini
{

/// Parameters of feature extraction.
struct ResponseFeatureParams
{
    double lowFrequency = 20.0;    ///< Hz, from where the resonance is looked for
    double highFrequency = 1000.0; ///< Hz, to where, and where the plateau ends
    double smoothing = 1.0 / 12.0; ///< octaves over which the response has been smoothed
    double evenWithin = 3.0;       ///< dB around the plateau
    double feltBelow = 20.0;       ///< dB under the strongest frequency that are still felt, without a threshold
    std::optional<FrequencyResponse> threshold; ///< level that is just felt at full drive, in the response's dB
    bool operator==(const ResponseFeatureParams&) const = default;
};

/// Neighbouring frequencies.
struct FrequencyRange
{
    double low = 0.0;  ///< Hz
    double high = 0.0; ///< Hz; not above low if there is no such frequency
    bool operator==(const FrequencyRange&) const = default;
};

/// Features of a response.
struct ResponseFeatures
{
    ResonanceModel resonance;
    double plateau = 0.0; ///< dB, median above twice the resonance, or of everything when less than an octave is there
    FrequencyRange even;  ///< the widest range within evenWithin of the plateau
    FrequencyRange felt;  ///< around the strongest frequency, above the threshold
};

/// Derives the features of `response`. Errors: those of fitResonance(), and those of the threshold with `threshold.`
/// before their path.
[[nodiscard]] inline Result<ResponseFeatures> responseFeatures(const FrequencyResponse& response,
                                                               const ResponseFeatureParams& params = {})
{
    auto resonance = fitResonance(response, params.lowFrequency, params.highFrequency, params.smoothing);
    if (!resonance)
        return resonance.error();
    if (params.threshold)
        if (auto valid = validate(*params.threshold); !valid)
            return Error{valid.error().code, "threshold." + valid.error().where, valid.error().message};
    ResponseFeatures out;
    out.resonance = resonance.value();

    const auto levelsFrom = [&](double low)
    {
        std::vector<double> levels;
        for (std::size_t i = 0; i < response.size(); ++i)
            if (response.frequency[i] >= low && response.frequency[i] <= params.highFrequency)
                levels.push_back(response.level[i]);
        return levels;
    };
    const double above = 2.0 * out.resonance.frequency;
    auto plateau = levelsFrom(2.0 * above <= params.highFrequency ? above : params.lowFrequency);
    out.plateau = detail::medianOf(plateau.empty() ? response.level : plateau);

    for (std::size_t i = 0; i < response.size();)
    {
        std::size_t end = i;
        while (end < response.size() && std::abs(response.level[end] - out.plateau) <= params.evenWithin)
            ++end;
        if (end > i && (!(out.even.low > 0.0) ||
                        response.frequency[end - 1] / response.frequency[i] > out.even.high / out.even.low))
            out.even = {response.frequency[i], response.frequency[end - 1]};
        i = end + 1;
    }

    const auto margin = [&](std::size_t i)
    {
        return response.level[i] - (params.threshold ? levelAt(*params.threshold, response.frequency[i]) : 0.0);
    };
    std::size_t strongest = 0;
    for (std::size_t i = 1; i < response.size(); ++i)
        if (margin(i) > margin(strongest))
            strongest = i;
    const double least = params.threshold ? 0.0 : margin(strongest) - params.feltBelow;
    if (margin(strongest) >= least)
    {
        std::size_t low = strongest;
        std::size_t high = strongest;
        while (low > 0 && margin(low - 1) >= least)
            --low;
        while (high + 1 < response.size() && margin(high + 1) >= least)
            ++high;
        out.felt = {response.frequency[low], response.frequency[high]};
    }
    return out;
}

/// Rise and fall of a burst at `frequency` Hz, as in a profile: from rest to 90 % of the final strength, from there to
/// 10 %. The response to exp(i w t) from 0 s on is exp(i w t) times the sum of h(u) exp(-i w u) up to u = t: its
/// magnitude is the envelope, without a burst to be played or an envelope to be followed. Times count from the arrival.
/// Errors: truncated at `samples` for an impulse response that has no end by then or none at all; invalidArgument at
/// `frequency` outside 0 Hz to half of the rate.
[[nodiscard]] inline Result<ActuatorResponse> burstTimes(const ImpulseResponse& response, double frequency)
{
    if (!(frequency > 0.0 && frequency < 0.5 * response.sampleRate))
        return Error{ErrorCode::invalidArgument, "frequency", "must be above 0 Hz and below half of the sample rate"};
    const double w = 2.0 * std::numbers::pi * frequency / response.sampleRate;
    std::vector<std::complex<double>> sum(response.samples.size());
    std::complex<double> running = 0.0;
    for (std::size_t i = 0; i < sum.size(); ++i)
        sum[i] = running +=
            response.samples[i] * std::polar(1.0, -w * (static_cast<double>(i) - static_cast<double>(response.origin)));
    const double final = std::abs(running);
    if (!(final > 0.0))
        return Error{ErrorCode::truncated, "samples", "contain no response"};
    const auto seconds = [&](double index)
    {
        return std::max(0.0, (index - static_cast<double>(response.origin)) / response.sampleRate);
    };
    std::size_t rise = 0;
    while (std::abs(sum[rise]) < 0.9 * final)
        ++rise;
    std::size_t fall = sum.size() - 1;
    while (fall > 0 && std::abs(running - sum[fall]) < 0.1 * final)
        --fall;
    // What rings on for three times as long has an end; of what fills the list to the end nobody knows.
    if (fall >= sum.size() || 3 * (fall - std::min(fall, response.origin)) > 2 * (sum.size() - response.origin))
        return Error{ErrorCode::truncated, "samples", "end before the response does; measure with a longer pause"};
    return ActuatorResponse{seconds(static_cast<double>(rise)), seconds(static_cast<double>(fall + 1))};
}

} // namespace pacini
