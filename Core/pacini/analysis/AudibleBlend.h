#pragma once

// The way of what is heard above the range of touch into the bands of the skin.

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/EvenTrains.h>
#include <pacini/analysis/HeardLevel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

/// Lets what is heard above the range of touch be felt. Where most of a sound as it is heard (A-weighted power, over
/// some seconds) lies above 900 Hz, the level follows the course of the loudness: the bands keep at most a quarter of
/// their own amplitude, and a tone of 150 to 290 Hz, the brighter the higher, brings what they lack, as if the sound
/// had it. Where little does, nothing changes, nor in `trains`, whose hits a level would blur. `heard` has a value for
/// each one of `found.envelope`; `audible` 0 to 1 is how far that goes, and `found.heardShare` tells where it went. The
/// peak follows. The limits of the blend, what the bands keep and the range of the tone are choices by trial, not
/// derived.
class AudibleBlend
{
public:
    AudibleBlend(std::span<const BandEdges> edges, double audible)
        : fades(edges, BandAnalysisParams{}.overlap), bands(edges.begin(), edges.end()), most(audible)
    {
    }

    void apply(BandAnalysisResult& found, std::span<const HeardFrame> heard, std::span<const TrainSpan> trains)
    {
        heard = heard.first(std::min(found.envelope.size(), heard.size()));
        double loudest = 0.0;
        double strongest = 0.0;
        for (const HeardFrame& frame : heard)
        {
            loudest = std::max(loudest, static_cast<double>(frame.loudness));
            strongest = std::max(strongest, static_cast<double>(frame.power));
        }
        if (!(loudest > 0.0))
            return;
        findShares(heard, strongest, found.heardShare);
        leaveTrains(trains, found.heardShare);
        found.heardShare.resize(found.envelope.size(), 0.0f);
        double peak = found.peak;
        for (std::size_t i = 0; i < heard.size(); ++i)
            peak = std::max(peak, static_cast<double>(found.heardShare[i]) *
                                      std::sqrt(2.0 * static_cast<double>(heard[i].power)));
        level.resize(heard.size());
        for (std::size_t i = 0; i < heard.size(); ++i)
        {
            const auto share = static_cast<double>(found.heardShare[i]);
            level[i] = loudestLevel * peak * felt(static_cast<double>(heard[i].loudness) / loudest);
            found.envelope[i] =
                static_cast<float>((1.0 - share) * static_cast<double>(found.envelope[i]) + share * level[i]);
        }
        for (std::size_t j = 0; j < found.tracks.front().amplitude.size(); ++j)
            addTone(found, heard, j);
        found.peak = peak;
    }

private:
    /// Of the loudest, from a share of it in loudness. What is hardly heard beside it, as hiss in pauses, is not felt.
    [[nodiscard]] static double felt(double loudness) noexcept
    {
        return std::max(0.0, loudness - unheard) / (1.0 - unheard);
    }

    /// How far the loudness takes over at each moment, by where the power lies before and after it.
    void findShares(std::span<const HeardFrame> heard, double strongest, std::vector<float>& share) const
    {
        constexpr double none = 0.2;
        constexpr double all = 0.45;
        constexpr double seconds = 1.0; // in which what was counts e times less
        const double rate = -std::expm1(-BandAnalysisResult::envelopeStep / seconds);
        const double silence = 1e-10 * strongest;
        double total = 0.0;
        double high = 0.0;
        std::vector<double> totals, highs;
        totals.reserve(heard.size());
        highs.reserve(heard.size());
        for (const HeardFrame& frame : heard)
        {
            totals.push_back(total += rate * (static_cast<double>(frame.power) - total));
            highs.push_back(high += rate * (static_cast<double>(frame.highPower) - high));
        }
        share.resize(heard.size());
        for (std::size_t i = heard.size(); i-- > 0;)
        {
            total += rate * (totals[i] - total);
            high += rate * (highs[i] - high);
            const double u = std::clamp((high / (total + silence) - none) / (all - none), 0.0, 1.0);
            share[i] = static_cast<float>(most * u * u * (3.0 - 2.0 * u));
        }
    }

    /// Nothing within trains; it comes and goes in 40 ms.
    static void leaveTrains(std::span<const TrainSpan> trains, std::vector<float>& share)
    {
        constexpr double ramp = 0.040; // s
        for (const TrainSpan& train : trains)
        {
            const auto frameOf = [&](double time)
            {
                const double frame = std::max(0.0, std::ceil(time / BandAnalysisResult::envelopeStep));
                return std::min(share.size(), static_cast<std::size_t>(frame));
            };
            for (std::size_t i = frameOf(train.first - ramp); i < frameOf(train.last + ramp); ++i)
            {
                const double time = static_cast<double>(i) * BandAnalysisResult::envelopeStep;
                const double outside = std::max({0.0, train.first - time, time - train.last});
                share[i] *= static_cast<float>(std::min(1.0, outside / ramp));
            }
        }
    }

    /// The tone in frame `j` of the bands, which lasts eight values of the envelope.
    void addTone(BandAnalysisResult& found, std::span<const HeardFrame> heard, std::size_t j)
    {
        constexpr auto ratio =
            static_cast<std::ptrdiff_t>(BandAnalysisResult::bandStep / BandAnalysisResult::envelopeStep + 0.5);
        const auto middle = static_cast<std::ptrdiff_t>(j) * ratio;
        double weights = 0.0;
        double power = 0.0;
        double share = 0.0;
        double high = 0.0;
        double bright = 0.0;
        for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, middle - ratio + 1);
             k < std::min(std::ssize(heard), middle + ratio); ++k)
        {
            const auto i = static_cast<std::size_t>(k);
            const double w = 0.5 + 0.5 * std::cos(std::numbers::pi * static_cast<double>(k - middle) / ratio);
            weights += w;
            power += w * level[i] * level[i];
            share += w * static_cast<double>(found.heardShare[i]);
            high += w * static_cast<double>(heard[i].high);
            bright += w * static_cast<double>(heard[i].bright);
        }
        if (!(weights > 0.0 && share > 0.0 && high > 0.0))
            return;
        share /= weights;
        power /= weights;
        double held = 0.0; // by the bands
        for (const BandAnalysisResult::Track& track : found.tracks)
            held += static_cast<double>(track.amplitude[j]) * static_cast<double>(track.amplitude[j]);
        const double kept = held > 0.0 ? std::min(std::sqrt(power / held), mostKept) : 0.0;
        const double lacking = share * share * (power - kept * kept * held);
        const double scale = 1.0 - share + share * kept;
        const double wanted = lowest * std::pow(highest / lowest, bright / high);
        const double frequency = std::clamp(wanted, bands.front().low, bands.back().high);
        for (std::size_t k = 0; k < found.tracks.size(); ++k)
        {
            auto& track = found.tracks[k];
            const double old = scale * static_cast<double>(track.amplitude[j]);
            const double part = fades.weight(k, k, frequency);
            const double added = part * part * std::max(0.0, lacking);
            const double sum = old * old + added;
            if (sum > 0.0)
                track.frequency[j] =
                    static_cast<float>((old * old * static_cast<double>(track.frequency[j]) + added * frequency) / sum);
            track.amplitude[j] = static_cast<float>(std::sqrt(sum));
        }
    }

    static constexpr double lowest = 150.0;  // Hz
    static constexpr double highest = 290.0; // Hz
    static constexpr double mostKept = 0.25;
    static constexpr double unheard = 0.03; // of the loudest: white noise 70 dB below the peak of knocks
    /// Of full drive: beats of the bands with the tone need the rest, or the limiter would flatten what is loud.
    static constexpr double loudestLevel = 0.8;

    BandFades fades;
    std::vector<BandEdges> bands;
    double most;
    std::vector<double> level; // of the loudness at each value of the envelope
};

} // namespace pacini
