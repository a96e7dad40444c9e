#pragma once

// Harmonic-percussive separation: splits a sound into steady tones, short events and a residual.

#include <pacini/analysis/PowerSpectra.h>
#include <pacini/analysis/SortedWindow.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/SplitRealFft.h>
#include <pacini/foundation/Units.h>
#include <pacini/foundation/Windows.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Parameters of the separation. The frames are Fitzgerald's (4096 and 1024 samples at 44.1 kHz), spans and margin
/// those that Driedger, Müller and Disch recommend. A hop is at most half the window.
struct SeparationParams
{
    FrameParams frames{Seconds(0.0929), Seconds(0.0232)};
    Seconds harmonicSpan{0.2};   ///< of the median along time, clamped to 0-10 s, to the next odd number of frames
    Hertz percussiveSpan{500.0}; ///< of the median along frequency, to the next odd number of bins
    double margin = 2.0;         ///< ratio by which one part must exceed the other, 1 (no residual) to 1000
    bool operator==(const SeparationParams&) const = default;
};

namespace detail
{

/// The share of a bin that goes to a part: Wiener's mask from the medians of power of that part and the other. Where
/// both are 0, a margin of 1 divides evenly and a larger one gives neither.
inline double separationMask(double own, double other, double margin) noexcept
{
    const double reference = other * margin * margin;
    if (!(own + reference > 0.0))
        return margin > 1.0 ? 0.0 : 0.5;
    return own / (own + reference);
}

/// Separates one sound, frame by frame, and hands on the parts as they become complete.
class HarmonicPercussiveSeparator
{
public:
    HarmonicPercussiveSeparator(std::span<const float> soundToSeparate, double fs, const SeparationParams& params)
        : sound(soundToSeparate),
          grid(params.frames, fs),
          hop(std::min(grid.hop, grid.window / 2)),
          margin(clampTo(params.margin, 1.0, 1000.0)),
          window(hannPeriodic(grid.window)),
          overlap(hop, 0.0),
          fft(grid.window),
          timeReach(reachOf(clampTo(params.harmonicSpan.value, 0.0, 10.0) * fs / static_cast<double>(hop))),
          binReach(reachOf(clampTo(params.percussiveSpan.value, 0.0, fs) / grid.frequency(1.0))),
          frameCount(sound.empty() ? 0 : (sound.size() - 1 + lead()) / hop + 1),
          ring(std::min(frameCount, 2 * timeReach + 2), Spectrum(fft.bins())),
          alongTime(fft.bins() * (2 * timeReach + 1)),
          alongFrequency(2 * binReach + 1),
          harmonic(fft.bins(), grid.window),
          percussive(fft.bins(), grid.window),
          masked(fft.bins()),
          frame(grid.window)
    {
        for (std::size_t i = 0; i < window.size(); ++i)
            overlap[i % hop] += window[i] * window[i];
    }

    template <typename Visit>
    void separate(Visit&& visit)
    {
        for (std::size_t m = 0; m < frameCount; ++m)
        {
            for (; transformed < std::min(frameCount, m + timeReach + 1); ++transformed)
                transform(transformed);
            slideAlongTime(m);
            slideAlongFrequency(m);
            add(at(m).values, harmonic, percussive);
            add(at(m).values, percussive, harmonic);
            // What starts before the next frame is complete; with the last frame that is all there is.
            const std::size_t done = std::min(m * hop, sound.size() + lead());
            const std::size_t end = m + 1 < frameCount ? done + hop : sound.size() + lead();
            const std::size_t skipped = std::min(end, std::max(done, lead()));
            const auto complete = [&](Part& part)
            {
                return std::span<const float>(part.samples).subspan(skipped - done, end - skipped);
            };
            if (skipped < end)
                visit(complete(harmonic), complete(percussive));
            harmonic.advance(hop);
            percussive.advance(hop);
        }
    }

private:
    struct Spectrum
    {
        explicit Spectrum(std::size_t bins) : values(bins), power(bins) {}
        SplitArray<double> values;
        std::vector<float> power;
    };

    struct Part
    {
        Part(std::size_t bins, std::size_t frames) : power(bins), samples(frames) {}

        void advance(std::size_t count)
        {
            std::copy(samples.begin() + static_cast<std::ptrdiff_t>(count), samples.end(), samples.begin());
            std::fill(samples.end() - static_cast<std::ptrdiff_t>(count), samples.end(), 0.0f);
        }

        std::vector<float> power;   // medians of the frame
        std::vector<float> samples; // from the start of the frame on
    };

    /// Half of the smallest odd number that is at least `count`, rounded down.
    static std::size_t reachOf(double count)
    {
        return count > 1.0 ? static_cast<std::size_t>(std::ceil(0.5 * (count - 1.0) - 1e-9)) : 0;
    }

    [[nodiscard]] Spectrum& at(std::size_t m) noexcept { return ring[m % ring.size()]; }

    /// Samples between the start of the first frame and that of the sound, so that all samples lie in the same number
    /// of frames.
    [[nodiscard]] std::size_t lead() const noexcept { return grid.window - hop; }

    void transform(std::size_t m)
    {
        for (std::size_t i = 0; i < frame.size(); ++i)
        {
            const std::size_t n = m * hop + i; // `lead` samples after the place in the sound
            const bool inside = n >= lead() && n - lead() < sound.size();
            frame[i] = inside ? window[i] * finiteOrZero(sound[n - lead()]) : 0.0;
        }
        Spectrum& spectrum = at(m);
        const auto& [re, im] = spectrum.values;
        fft.forward(frame.data(), spectrum.values.re.data(), spectrum.values.im.data());
        for (std::size_t k = 0; k < spectrum.power.size(); ++k)
            spectrum.power[k] = toSample(re[k] * re[k] + im[k] * im[k]);
    }

    /// The medians of frame m along time, from those of the frame before.
    void slideAlongTime(std::size_t m)
    {
        const std::size_t length = 2 * timeReach + 1;
        const auto powersAt = [this](std::size_t later, std::size_t earlier) -> const std::vector<float>&
        {
            return at(reflectedIndex(static_cast<std::ptrdiff_t>(later) - static_cast<std::ptrdiff_t>(earlier),
                                     frameCount))
                .power;
        };
        for (std::size_t i = 0; m == 0 && i < length; ++i)
        {
            const std::vector<float>& powers = powersAt(i, timeReach);
            for (std::size_t k = 0; k < powers.size(); ++k)
                alongTime[k * length + i] = powers[k];
        }
        const std::vector<float>& leaving = powersAt(m, timeReach + 1);
        const std::vector<float>& entering = powersAt(m + timeReach, 0);
        for (std::size_t k = 0; k < harmonic.power.size(); ++k)
        {
            const auto sorted = std::span(alongTime).subspan(k * length, length);
            if (m == 0)
                std::sort(sorted.begin(), sorted.end());
            else
                replaceSorted(sorted, leaving[k], entering[k]);
            harmonic.power[k] = medianOfSorted(sorted);
        }
    }

    /// The medians of frame m along frequency.
    void slideAlongFrequency(std::size_t m)
    {
        const std::vector<float>& powers = at(m).power;
        const auto powerAt = [&](std::size_t later, std::size_t earlier)
        {
            return powers[reflectedIndex(static_cast<std::ptrdiff_t>(later) - static_cast<std::ptrdiff_t>(earlier),
                                         powers.size())];
        };
        for (std::size_t i = 0; i < alongFrequency.size(); ++i)
            alongFrequency[i] = powerAt(i, binReach);
        std::sort(alongFrequency.begin(), alongFrequency.end());
        for (std::size_t k = 0; k < powers.size(); ++k)
        {
            if (k > 0)
                replaceSorted(alongFrequency, powerAt(k, binReach + 1), powerAt(k + binReach, 0));
            percussive.power[k] = medianOfSorted(alongFrequency);
        }
    }

    /// Adds what the mask leaves of a frame to a part, by overlap-add of least squares (D. Griffin and J. Lim, "Signal
    /// Estimation from Modified Short-Time Fourier Transform", IEEE Trans. ASSP 32 (1984), Eq. 6).
    void add(const SplitArray<double>& values, Part& part, const Part& other)
    {
        for (std::size_t k = 0; k < part.power.size(); ++k)
        {
            const double mask =
                separationMask(static_cast<double>(part.power[k]), static_cast<double>(other.power[k]), margin);
            masked.re[k] = mask * values.re[k];
            masked.im[k] = mask * values.im[k];
        }
        fft.inverse(masked.re.data(), masked.im.data(), frame.data());
        const double scale = 1.0 / static_cast<double>(grid.window);
        for (std::size_t i = 0; i < frame.size(); ++i)
            part.samples[i] += toSample(frame[i] * window[i] * scale / overlap[i % hop]);
    }

    std::span<const float> sound;
    FrameGrid grid;
    std::size_t hop;
    double margin;
    std::vector<double> window;
    std::vector<double> overlap; // sum of the squared windows at each place of a hop
    SplitRealFft<double> fft;
    std::size_t timeReach, binReach, frameCount;
    std::vector<Spectrum> ring;   // under the window of the median along time
    std::size_t transformed = 0;  // frames so far
    std::vector<float> alongTime; // for each bin in turn, the sorted powers under that window
    std::vector<float> alongFrequency;
    Part harmonic, percussive;
    SplitArray<double> masked;
    std::vector<double> frame;
};

} // namespace detail

/// Harmonic and percussive part of a sound at fs Hz by median filtering of its spectrogram: along time a median keeps
/// tones, along frequency it keeps what is short (D. Fitzgerald, "Harmonic/Percussive Separation Using Median
/// Filtering", DAFx 2010, with Wiener's masks). A part gets what exceeds the other by `margin`; what neither gets,
/// sound - harmonic - percussive, is the residual (J. Driedger, M. Müller and S. Disch, "Extending Harmonic-Percussive
/// Separation of Audio Signals", ISMIR 2014; masks stay soft here): H, P and R of Weber 2020, Eq. 4.2. Beyond the ends
/// the medians see the spectrogram reflected, as librosa.decompose.hpss does, whose masks of power 2 these are. The
/// sound itself lies in silence: where it is cut off, its end is percussive.
///
/// Calls visit(harmonic, percussive) with the next samples of both, spans of one length, until each has the length of
/// the sound. NaN and infinities count as 0; the sound should be near full scale, since powers are kept as floats.
/// Memory: the spectra of `harmonicSpan`, whatever the length. [any]
template <typename Visit>
void separateHarmonicPercussive(std::span<const float> sound, double fs, const SeparationParams& params, Visit&& visit)
{
    detail::HarmonicPercussiveSeparator(sound, fs, params).separate(visit);
}

} // namespace pacini
