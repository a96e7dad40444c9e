#pragma once

// Curve fitting for clips: dense analysis -> the curves of a clip, section after section.

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/CurveFitter.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace pacini
{

/// Fits the curves of clips. A section is fitted by itself, with a price per point that keeps its own number of points
/// below the cap, and joined to what the clip has already: so a long sound needs no more memory than its clip.
class ClipFitter
{
public:
    /// Fits at most `breakpoints` points per second of sound and band, noise bands included.
    explicit ClipFitter(double breakpoints) : pointsPerSecond(breakpoints) {}

    /// Prepares for a clip of about that length, 0 if that is not known.
    void expect(double seconds) noexcept { expected = seconds; }

    /// Adds the curves of `found`, which begins `start` s after the clip, a multiple of 0.06 s, at the last frame of
    /// the section before. The clip has its bands, noise bands too; its curves end at `start`, or are empty.
    void add(Clip& clip, const BandAnalysisResult& found, double gain, double start)
    {
        Clip section;
        for (const Band& band : clip.bands)
            section.bands.push_back({band.lowFrequency, band.centreFrequency, band.highFrequency, 0, {}, {}});
        for (const NoiseBand& band : clip.noise)
            section.noise.push_back({band.lowFrequency, band.highFrequency, {}});
        const auto bands = static_cast<double>(clip.bands.size() + clip.noise.size());
        double price = std::pow(20.0 / pointsPerSecond, priceExponent);
        fit(section, found, gain, price);
        const double most = pointsPerSecond * bands * std::max(activeSeconds(found, gain), 0.1);
        while (static_cast<double>(breakpointCount(section)) > most + 2.0 * (bands + 2.0) && price < 1e6)
        {
            price *= 1.6;
            fit(section, found, gain, price);
        }
        for (std::size_t k = 0; k < clip.bands.size(); ++k)
        {
            joinLevel(clip.bands[k].amplitude, std::move(section.bands[k].amplitude), start);
            joinPitch(clip.bands[k].pitch, section.bands[k].pitch, start);
        }
        for (std::size_t k = 0; k < clip.noise.size(); ++k)
            joinLevel(clip.noise[k].amplitude, std::move(section.noise[k].amplitude), start);
        joinLevel(clip.envelope, std::move(section.envelope), start);
        joinPitch(clip.centroid, section.centroid, start);
    }

private:
    void fit(Clip& clip, const BandAnalysisResult& found, double gain, double price)
    {
        clip.envelope = curves.fitAmplitude(found.envelope, BandAnalysisResult::envelopeStep, gain, floor,
                                            envelopePrice * price, found.heardShare);
        const std::size_t n = found.tracks.front().amplitude.size();
        std::vector<double> total(n, 1e-20);
        for (const auto& track : found.tracks)
            for (std::size_t i = 0; i < n; ++i)
                total[i] += static_cast<double>(track.amplitude[i]) * static_cast<double>(track.amplitude[i]);
        const auto noisePower = [&found](std::size_t k, std::size_t i) // of the sine that is as strong
        {
            return 2.0 * static_cast<double>(found.noise[k][i]) * static_cast<double>(found.noise[k][i]);
        };
        for (std::size_t k = 0; k < clip.noise.size(); ++k)
            for (std::size_t i = 0; i < n; ++i)
                total[i] += noisePower(k, i);
        std::vector<double> level(n);
        for (std::size_t i = 0; i < n; ++i)
            level[i] = std::max(0.0, 1.0 - Decibels::fromPower(total[i] * gain * gain).value / floorDecibels);
        PitchTrack centroid(n);
        for (std::size_t k = 0; k < clip.bands.size(); ++k)
        {
            const auto& track = found.tracks[k];
            Band& band = clip.bands[k];
            band.amplitude =
                curves.fitAmplitude(track.amplitude, BandAnalysisResult::bandStep, gain, floor, bandPrice * price);
            PitchTrack pitch(n);
            for (std::size_t i = 0; i < n; ++i)
            {
                const double power = static_cast<double>(track.amplitude[i]) * static_cast<double>(track.amplitude[i]);
                const double share = power / total[i];
                const double f =
                    track.frequency[i] > 0.0f ? static_cast<double>(track.frequency[i]) : band.centreFrequency;
                pitch.add(i, std::clamp(f, 0.8 * band.lowFrequency, 1.25 * band.highFrequency),
                          std::sqrt(share) * level[i]);
                centroid.add(i, f, share * level[i]);
            }
            band.pitch = band.amplitude.empty() ? Curve{} : pitch.fit(curves, band.centreFrequency, pitchPrice * price);
        }
        for (std::size_t k = 0; k < clip.noise.size(); ++k)
        {
            NoiseBand& band = clip.noise[k];
            band.amplitude =
                curves.fitAmplitude(found.noise[k], BandAnalysisResult::bandStep, gain, floor, bandPrice * price);
            for (std::size_t i = 0; i < n; ++i)
                centroid.add(i, 0.5 * (band.lowFrequency + band.highFrequency), noisePower(k, i) / total[i] * level[i]);
        }
        const double middle = 0.5 * (clip.bands.front().lowFrequency + clip.bands.back().highFrequency);
        clip.centroid = centroid.fit(curves, middle, centroidPrice * price);
    }

    /// Frequencies averaged over three frames of the analysis by their importance (60 ms: pitch on the skin is slower
    /// than level), before they are fitted.
    class PitchTrack
    {
    public:
        explicit PitchTrack(std::size_t frames) : sums((frames + 2) / 3, 0.0), importance(sums.size(), 0.0) {}

        void add(std::size_t frame, double frequency, double weight)
        {
            const std::size_t i = std::min((frame + 1) / 3, sums.size() - 1);
            sums[i] += weight * frequency;
            importance[i] += weight;
        }

        Curve fit(CurveFitter& fitter, double otherwise, double price)
        {
            for (std::size_t i = 0; i < sums.size(); ++i)
                sums[i] = importance[i] > 1e-9 ? sums[i] / importance[i] : i > 0 ? sums[i - 1] : otherwise;
            return fitter.fitPitch(sums, importance, 3.0 * BandAnalysisResult::bandStep, price);
        }

    private:
        std::vector<double> sums;
        std::vector<double> importance;
    };

    /// Returns the active time, in which the envelope is above -75 dB of full drive (Weber 2020, section 4.3).
    [[nodiscard]] static double activeSeconds(const BandAnalysisResult& found, double gain)
    {
        std::size_t active = 0;
        for (float e : found.envelope)
            active += gain * static_cast<double>(e) > 1.778e-4 ? 1 : 0;
        return static_cast<double>(active) * BandAnalysisResult::envelopeStep;
    }

    /// Continues a curve of levels at `start`, where the sections share a frame. An empty curve is silence.
    void joinLevel(Curve& curve, Curve next, double start) const
    {
        const bool sounds = reaches(curve, start);
        if (start == 0.0)
            curve = std::move(next);
        else if (next.empty() && sounds)
            curve.back().value = 0.0;
        else if (!next.empty())
        {
            if (!sounds)
                next.front().value = 0.0;
            append(curve, next, start);
        }
    }

    /// Continues a curve of frequencies at `start`. A single point applies to its whole section. An empty section takes
    /// the frequency before or after it.
    void joinPitch(Curve& curve, const Curve& next, double start) const
    {
        constexpr double step = 3.0 * BandAnalysisResult::bandStep;
        if (next.empty())
            return;
        if (!curve.empty() && !reaches(curve, start))
            curve.push_back({start - step, curve.back().value});
        append(curve, next, start);
    }

    [[nodiscard]] static bool reaches(const Curve& curve, double time)
    {
        return !curve.empty() && curve.back().time > time - 0.5 * BandAnalysisResult::envelopeStep;
    }

    /// Appends a curve. If both have a point at `start`, they meet half-way.
    void append(Curve& curve, const Curve& next, double start) const
    {
        double first = next.front().value;
        if (reaches(curve, start))
        {
            first = 0.5 * (first + curve.back().value);
            curve.pop_back();
        }
        reserve(curve, curve.size() + next.size(), start);
        curve.push_back({start, first});
        for (std::size_t i = 1; i < next.size(); ++i)
            curve.push_back({start + next[i].time, next[i].value});
    }

    /// Room for `size` points, and at once for as many as the whole clip may get: curves of hours that are moved again
    /// and again leave memory in pieces.
    void reserve(Curve& curve, std::size_t size, double start) const
    {
        if (size <= curve.capacity())
            return;
        constexpr double margin = 1.2;
        constexpr double most = 8.0; // times what is there: lengths that files claim are not to be trusted
        const double growth = start > 0.0 ? std::clamp(margin * expected / start, 1.0, most) : 1.0;
        curve.reserve(std::max(size, static_cast<std::size_t>(growth * static_cast<double>(curve.size()))));
    }

    static constexpr double floorDecibels = -45.0; // below full drive: the range of touch
    static constexpr double floor = 0.005623413251903491;
    static constexpr double envelopePrice = 5.0;  // dB^2 frames
    static constexpr double bandPrice = 25.0;     // dB^2 frames
    static constexpr double pitchPrice = 20.0;    // semitones^2 frames
    static constexpr double centroidPrice = 60.0; // semitones^2 frames

    /// By which the price per point falls as the points per second grow; a price of 1 belongs to 20. The error of
    /// straight lines falls with their number n like n^-4 for smooth curves and n^-1 for random walks, what one more
    /// point gains like n^-5 and n^-2. 1.56 is not derived but found by trial: from 10 to 20 points per second the
    /// curves of the demo sounds together get 1.99 times the points, from 5 to 10 1.80, from 20 to 40 1.56.
    static constexpr double priceExponent = 1.56;

    double pointsPerSecond;
    double expected = 0.0; // s
    CurveFitter curves;
};

} // namespace pacini
