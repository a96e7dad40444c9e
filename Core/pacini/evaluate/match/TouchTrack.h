#pragma once

// Felt strength and frequency of a vibration over time.

#include <pacini/evaluate/FeltSpectrum.h>
#include <pacini/evaluate/HannSmoothing.h>
#include <pacini/evaluate/HtsFeatures.h>
#include <pacini/evaluate/PeakScale.h>
#include <pacini/evaluate/SectionCascade.h>
#include <pacini/evaluate/SourcePreparation.h>
#include <pacini/filters/Butterworth.h>
#include <pacini/foundation/Result.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// A vibration as felt. Strengths are amplitudes (root mean square) in the unit of the signal, power in an arbitrary
/// one.
struct TouchTrack
{
    static constexpr double rate = 500.0;         ///< Hz, of `strength`
    static constexpr double frameSeconds = 0.064; ///< from one value of the others to the next
    std::vector<float> strength;
    std::vector<double> octave; ///< felt frequency in octaves above 1 Hz, of frames of 128 ms; 0 in silence
    std::vector<double> power;  ///< of these frames
};

/// Computes TouchTracks. Above threshold the contours of equal sensation flatten: they are nearly level over frequency
/// for acceleration (R. Verrillo, A. Fraioli and R. Smith, "Sensation magnitude of vibrotactile stimuli", 1969), so the
/// strength is the amplitude between 30 and 500 Hz. Weighting by the threshold of the Pacinian channel instead
/// (S. Bolanowski et al., 1988) agrees less with people (`quality.md`).
class TouchAnalyzer
{
public:
    /// `x` at 4 kHz, mono and finite.
    [[nodiscard]] TouchTrack analyze(std::span<const float> x)
    {
        TouchTrack track;
        const double scale = peakScale(x);
        std::vector<float> y(x.size());
        std::transform(x.begin(), x.end(), y.begin(),
                       [scale](float v) { return static_cast<float>(static_cast<double>(v) / scale); });
        const auto frames = spectra.analyze(y);
        filter(y);
        for (float& v : y)
            v *= v;
        constexpr std::size_t spacing = 8;
        for (std::size_t i = 0; i < y.size(); i += spacing)
            track.strength.push_back(
                static_cast<float>(scale * std::sqrt(std::max(0.0, static_cast<double>(smoothing.at(y, i))))));
        for (const auto& frame : frames)
            addFrame(frame, track);
        return track;
    }

private:
    static void filter(std::span<float> y)
    {
        constexpr ButterworthParams felt{ButterworthType::bandpass, 2, Hertz(30.0), Hertz(500.0)};
        const auto design = designButterworth(felt, HtsFeatures::sampleRate);
        SectionCascade<2>({design.sections[0].directForm(), design.sections[1].directForm()}).process(y);
    }

    static void addFrame(const FeltSpectrumAnalyzer::Frame& frame, TouchTrack& track)
    {
        constexpr double jnd = 1.2; // distance of the bands
        double power = 0.0;
        double weighted = 0.0;
        for (std::size_t b = 0; b < frame.size(); ++b)
        {
            const double p = static_cast<double>(frame[b]) * static_cast<double>(frame[b]);
            power += p;
            weighted += p * (static_cast<double>(b) + 0.5);
        }
        track.power.push_back(power);
        track.octave.push_back(power > 0.0 ? std::log2(25.0) + weighted / power * std::log2(jnd) : 0.0);
    }

    /// As long as a Gaussian of 4 ms: ripple at twice the lowest frequencies is 20 dB down.
    HannKernel smoothing = HannKernel(0.011 * HtsFeatures::sampleRate);
    FeltSpectrumAnalyzer spectra;
};

/// What is felt of a mono drive signal or acceleration at `sampleRate` Hz. Samples that are not finite count as 0.
/// ErrorCode::invalidArgument for rates that resample() does not take.
[[nodiscard]] inline Result<TouchTrack> touchTrack(TouchAnalyzer& analyzer, std::span<const float> samples,
                                                   int sampleRate)
{
    const auto x = resampleFinite(samples, sampleRate, HtsFeatures::sampleRate);
    if (!x)
        return x.error();
    return analyzer.analyze(*x);
}

} // namespace pacini
