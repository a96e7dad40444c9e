#pragma once

// Samples -> Clip: Pacini's own translation, "a2vt".

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/CurveFitter.h>
#include <pacini/analysis/EventTransients.h>
#include <pacini/analysis/OnsetDetector.h>
#include <pacini/analysis/OnsetFeatures.h>
#include <pacini/clip/BandPriority.h>
#include <pacini/clip/PackedClip.h>
#include <pacini/filters/RationalDecimator.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

struct EncoderParams
{
    int bands = 12;                ///< 1 to 32
    double lowFrequency = 30.0;    ///< Hz
    double highFrequency = 1000.0; ///< Hz
    BandSpacing spacing = BandSpacing::logarithmic;
    double breakpoints = 20.0; ///< at most this many per second of sound and band, all curves together
    int quantise = 6;          ///< bits of the grids, 4 to 16; see PackParams
    bool normalise = true;     ///< scale to full drive; otherwise full scale is full drive, and sounds more than 54 dB
                               ///< above it are scaled down to that
    OnsetParams onsets;        ///< what counts as an event; see Onset
    bool operator==(const EncoderParams&) const = default;
};

/// Checks the ranges of EncoderParams.
[[nodiscard]] inline Result<void> validate(const EncoderParams& params)
{
    const auto wrong = [](std::string where, std::string message) -> Result<void>
    {
        return Error{ErrorCode::invalidArgument, std::move(where), std::move(message)};
    };
    if (params.bands < 1 || params.bands > 32)
        return wrong("bands", "must be 1 to 32");
    if (!(params.lowFrequency >= 1.0 && params.highFrequency <= 1800.0 && params.lowFrequency < params.highFrequency))
        return wrong("frequency range", "must lie within 1 to 1800 Hz, the low end below the high end");
    if (!(params.breakpoints >= 0.5 && params.breakpoints <= 1000.0))
        return wrong("breakpoints", "must be 0.5 to 1000 per second and band");
    if (params.quantise < 4 || params.quantise > 16)
        return wrong("quantise", "must be 4 to 16 bits");
    if (!(params.onsets.sensitivity >= 0.25 && params.onsets.sensitivity <= 4.0))
        return wrong("sensitivity", "must be 0.25 to 4");
    return {};
}

/// The parameters as a clip keeps them; the gain, which depends on the sound, comes on top.
[[nodiscard]] inline std::vector<EncoderParameter> encoderRecord(const EncoderParams& params)
{
    std::vector<EncoderParameter> record = {{"method", std::string("a2vt")},
                                            {"bands", static_cast<double>(params.bands)},
                                            {"breakpoints", params.breakpoints},
                                            {"quantise", static_cast<double>(params.quantise)}};
    const EncoderParams usual;
    if (params.lowFrequency != usual.lowFrequency)
        record.push_back({"low", params.lowFrequency});
    if (params.highFrequency != usual.highFrequency)
        record.push_back({"high", params.highFrequency});
    if (params.spacing != usual.spacing)
        record.push_back({"spacing", std::string("linear")});
    if (params.onsets.sensitivity != usual.onsets.sensitivity)
        record.push_back({"sensitivity", params.onsets.sensitivity});
    if (params.normalise != usual.normalise)
        record.push_back({"normalise", params.normalise});
    return record;
}

/// Encodes one sound after another; keeps its transforms and filters between them. Use: start, push any number of
/// times, finish. Nothing is kept of the sound but what the analysis found, 20 MB an hour for 12 bands: which of it is
/// worth a point depends on the loudest moment, which may be the last. One thread at a time, never the audio thread.
class Encoder
{
public:
    /// `params` must be valid.
    explicit Encoder(const EncoderParams& params)
        : settings(params),
          analysis({tiledBands(static_cast<std::size_t>(params.bands), params.lowFrequency, params.highFrequency,
                               params.spacing)}),
          edges(tiledBands(static_cast<std::size_t>(params.bands), params.lowFrequency, params.highFrequency,
                           params.spacing))
    {
    }

    /// Begins a sound of 1-64 channels at 8000 to 768000 Hz. Where its length is known, `expectedFrames` saves memory.
    void start(int sampleRate, int channels, std::uint64_t expectedFrames = 0)
    {
        fs = sampleRate;
        channelCount = static_cast<std::size_t>(channels);
        frames = 0;
        if (decimators.empty() || decimators.front().inputRate() != sampleRate)
            decimators.assign(channelCount, RationalDecimator(sampleRate, analysisRate));
        decimators.resize(channelCount, decimators.front());
        for (RationalDecimator& decimator : decimators)
            decimator.reset();
        analysis.reset(channelCount,
                       static_cast<std::size_t>(static_cast<double>(expectedFrames) * analysisRate / sampleRate));
        features.emplace(fs, channelCount);
        detector.emplace(settings.onsets);
    }

    /// Takes interleaved samples, whole frames. Those beyond +-1e12 are limited to it, those that are not finite count
    /// as 0: the squares of all others can be computed.
    void push(std::span<const float> interleaved)
    {
        const auto isSound = [](float x)
        {
            return std::abs(x) <= limits::sample;
        };
        if (!std::all_of(interleaved.begin(), interleaved.end(), isSound))
        {
            limited.resize(interleaved.size());
            std::transform(interleaved.begin(), interleaved.end(), limited.begin(),
                           [](float x)
                           { return std::isfinite(x) ? clampTo(x, -limits::sample, limits::sample) : 0.0f; });
            interleaved = limited;
        }
        const std::size_t count = interleaved.size() / channelCount;
        frames += count;
        features->push(interleaved);
        detectOnsets();
        for (std::size_t c = 0; c < channelCount; ++c)
        {
            decimated.resize(channelCount);
            decimated[c].clear();
            if (channelCount == 1)
                decimators[c].push(interleaved, decimated[c]);
            else
            {
                channel.resize(count);
                for (std::size_t i = 0; i < count; ++i)
                    channel[i] = interleaved[i * channelCount + c];
                decimators[c].push(channel, decimated[c]);
            }
        }
        pushDecimated();
    }

    /// Completes the clip. Packing rounds its values to the grids of `quantise` bits.
    [[nodiscard]] Clip finish()
    {
        for (std::size_t c = 0; c < channelCount; ++c)
        {
            decimated.resize(channelCount);
            decimated[c].clear();
            decimators[c].finish(decimated[c]);
        }
        pushDecimated();
        features->finish();
        detectOnsets();
        return makeClip(analysis.finish(), detector->finish());
    }

private:
    void detectOnsets()
    {
        detector->push(features->frames());
        features->drop(features->frames().size());
    }

    void pushDecimated()
    {
        views.assign(decimated.begin(), decimated.end());
        analysis.push(views);
    }

    [[nodiscard]] Clip makeClip(BandAnalysisResult found, const std::vector<Onset>& onsets)
    {
        Clip clip;
        clip.duration = static_cast<double>(frames) / fs;
        clip.source.sampleRate = fs;
        clip.source.channels = static_cast<int>(channelCount);
        const double loudest = settings.normalise ? 1.0 : 0.5 * limits::amplitude;
        const double gain = found.peak > (settings.normalise ? silence : loudest) ? loudest / found.peak : 1.0;
        clip.encoder = encoderRecord(settings);
        clip.encoder.push_back({"gain", roundedToDigits(gain, 3)});
        for (const BandEdges& edge : edges)
            clip.bands.push_back({edge.low, edge.centre, edge.high, 0, {}, {}});
        if (found.peak <= silence)
            return clip;

        clip.transients = transientsFrom(onsets, gain);
        holdDownBetween(onsets, 0.045, BandAnalysisResult::envelopeStep, found.envelope);
        double price = std::pow(20.0 / settings.breakpoints, 1.56);
        fitCurves(clip, found, gain, price);
        const double most = settings.breakpoints * settings.bands * std::max(activeSeconds(found, gain), 0.1);
        while (static_cast<double>(breakpointCount(clip)) > most + 2.0 * (settings.bands + 2.0) && price < 1e6)
        {
            price *= 1.6;
            fitCurves(clip, found, gain, price);
        }
        // The last frame of the analysis can end after the sound.
        for (Band& band : clip.bands)
        {
            cutAfter(band.amplitude, clip.duration);
            cutAfter(band.pitch, clip.duration);
        }
        cutAfter(clip.envelope, clip.duration);
        cutAfter(clip.centroid, clip.duration);
        std::vector<double> energies;
        for (const Band& band : clip.bands)
            energies.push_back(curveEnergy(band.amplitude, clip.duration));
        const auto priorities = prioritiesByEnergy(energies);
        for (std::size_t k = 0; k < clip.bands.size(); ++k)
            clip.bands[k].priority = priorities[k];
        return clip;
    }

    void fitCurves(Clip& clip, const BandAnalysisResult& found, double gain, double price)
    {
        clip.envelope =
            fitter.fitAmplitude(found.envelope, BandAnalysisResult::envelopeStep, gain, floor, envelopePrice * price);
        const std::size_t n = found.tracks.front().amplitude.size();
        std::vector<double> total(n, 1e-20);
        for (const auto& track : found.tracks)
            for (std::size_t i = 0; i < n; ++i)
                total[i] += static_cast<double>(track.amplitude[i]) * static_cast<double>(track.amplitude[i]);
        std::vector<double> level(n);
        for (std::size_t i = 0; i < n; ++i)
            level[i] = std::max(0.0, 1.0 - 10.0 * std::log10(total[i] * gain * gain) / floorDecibels);
        PitchTrack centroid(n);
        for (std::size_t k = 0; k < clip.bands.size(); ++k)
        {
            const auto& track = found.tracks[k];
            Band& band = clip.bands[k];
            band.amplitude =
                fitter.fitAmplitude(track.amplitude, BandAnalysisResult::bandStep, gain, floor, bandPrice * price);
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
            band.pitch = band.amplitude.empty() ? Curve{} : pitch.fit(fitter, band.centreFrequency, pitchPrice * price);
        }
        clip.centroid =
            centroid.fit(fitter, 0.5 * (settings.lowFrequency + settings.highFrequency), centroidPrice * price);
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

        Curve fit(CurveFitter& curves, double otherwise, double price)
        {
            for (std::size_t i = 0; i < sums.size(); ++i)
                sums[i] = importance[i] > 1e-9 ? sums[i] / importance[i] : i > 0 ? sums[i - 1] : otherwise;
            return curves.fitPitch(sums, importance, 3.0 * BandAnalysisResult::bandStep, price);
        }

    private:
        std::vector<double> sums;
        std::vector<double> importance;
    };

    /// Time in which the envelope is above -75 dB of full drive (Weber 2020, section 4.3).
    [[nodiscard]] static double activeSeconds(const BandAnalysisResult& found, double gain)
    {
        std::size_t active = 0;
        for (float e : found.envelope)
            active += gain * static_cast<double>(e) > 1.778e-4 ? 1 : 0;
        return static_cast<double>(active) * BandAnalysisResult::envelopeStep;
    }

    static constexpr double silence = 1e-6;        // -120 dB: dither and rounding noise
    static constexpr double floorDecibels = -45.0; // below full drive: the range of touch
    static constexpr double floor = 0.005623413251903491;
    static constexpr double envelopePrice = 5.0;  // dB^2 frames
    static constexpr double bandPrice = 25.0;     // dB^2 frames
    static constexpr double pitchPrice = 20.0;    // semitones^2 frames
    static constexpr double centroidPrice = 60.0; // semitones^2 frames

    EncoderParams settings;
    BandAnalysis analysis;
    std::vector<BandEdges> edges;
    CurveFitter fitter;
    std::optional<OnsetFeatures> features;
    std::optional<OnsetDetector> detector;
    int fs = 0;
    std::size_t channelCount = 1;
    std::size_t frames = 0;
    std::vector<RationalDecimator> decimators;
    std::vector<std::vector<float>> decimated;
    std::vector<std::span<const float>> views;
    std::vector<float> channel;
    std::vector<float> limited;
};

} // namespace pacini
