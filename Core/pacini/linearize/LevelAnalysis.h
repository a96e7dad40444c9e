#pragma once

// Analysis of one level step: its averaged responses and distortion.

#include <pacini/foundation/SplitRealFft.h>
#include <pacini/foundation/Units.h>
#include <pacini/foundation/Windows.h>
#include <pacini/linearize/Deconvolution.h>
#include <pacini/linearize/LagWindow.h>
#include <pacini/linearize/MeasurementParams.h>
#include <pacini/linearize/RecordedChannels.h>
#include <pacini/linearize/ResponseSmoothing.h>
#include <pacini/linearize/SweepMeasurement.h>
#include <pacini/linearize/SweepTiming.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// The power of a channel's noise at each frequency as E|FFT|^2 of n samples, divided by n.
class NoiseSpectrum
{
public:
    /// From the quiet times `spans` (begin and end in s of the recording) of channel `c`: P. Welch, "The use of fast
    /// Fourier transform for the estimation of power spectra", 1967, Hann windows that overlap by half; up to
    /// half of a second long, not longer than the longest span. All 0 without a span of 16 frames.
    NoiseSpectrum(const RecordedChannels& recording, std::size_t c, std::span<const std::pair<double, double>> spans)
        : rate(recording.rate)
    {
        double longest = 0.0;
        for (const auto& [begin, end] : spans)
            longest = std::max(longest, end - begin);
        const auto wanted = static_cast<std::size_t>(std::min(0.5, longest) * rate);
        if (wanted < 16)
            return;
        const std::size_t n = std::bit_floor(wanted);
        SplitRealFft<double> fft(n);
        const auto window = hannPeriodic(n);
        double energy = 0.0;
        for (const double w : window)
            energy += w * w;
        power.assign(fft.bins(), 0.0);
        std::vector<double> re(fft.bins());
        std::vector<double> im(fft.bins());
        std::size_t pieces = 0;
        for (const auto& [begin, end] : spans)
            for (auto first = static_cast<std::ptrdiff_t>(std::ceil(begin * rate));
                 first + static_cast<std::ptrdiff_t>(n) <= static_cast<std::ptrdiff_t>(end * rate);
                 first += static_cast<std::ptrdiff_t>(n / 2))
            {
                auto samples = recording.part(c, first, n);
                for (std::size_t i = 0; i < n; ++i)
                    samples[i] *= window[i];
                fft.forward(samples.data(), re.data(), im.data());
                for (std::size_t k = 0; k < power.size(); ++k)
                    power[k] += (re[k] * re[k] + im[k] * im[k]) / energy;
                ++pieces;
            }
        for (double& p : power)
            p /= static_cast<double>(std::max<std::size_t>(1, pieces));
    }

    /// The power at f Hz. The lowest two bins contain the rest of the mean, so they count as the third.
    [[nodiscard]] double at(double f) const noexcept
    {
        if (power.size() < 4)
            return 0.0;
        const double bin = f / rate * static_cast<double>(2 * (power.size() - 1));
        const double position = std::clamp(bin, 2.0, static_cast<double>(power.size() - 2));
        const auto k = static_cast<std::size_t>(position);
        return power[k] + (power[k + 1] - power[k]) * (position - static_cast<double>(k));
    }

private:
    double rate;
    std::vector<double> power;
};

/// 1 / X of an exponential sweep of amplitude 1 that never ends, at f Hz and `rate` Hz:
/// X(f) = rate / 2 sqrt(L / f) exp(i (2 pi L (f - f1) - 2 pi f L ln(f / f1) - pi / 4)) by stationary phase (A. Novak,
/// P. Lotton, L. Simon, "Synchronized swept-sine: theory, application, and implementation", JAES 63, 2015, eq. 33-42).
/// The order N of a sweep is the same sweep L ln N earlier, up to N f2: dividing by the played sweep's own spectrum, as
/// eq. 3.1 does, would leave out all of it above f2. `start` is the sweep's start in s after sample 0.
[[nodiscard]] inline std::complex<double> endlessSweepInverse(double f, const ExponentialSweep& sweep, double rate,
                                                              double start) noexcept
{
    const double growth = sweep.growthTime();
    const double f1 = sweep.lowFrequency();
    const double turns = growth * (f - f1) - f * growth * std::log(f / f1) - f * start;
    const double angle = 2.0 * std::numbers::pi * (turns - std::floor(turns)) - std::numbers::pi / 4.0;
    return std::polar(2.0 / rate * std::sqrt(f / growth), -angle);
}

/// 1 / X of the endless sweep at all bins of a recording's spectrum, 0 below half of its lowest frequency and above
/// `highest` Hz. Y / X has order N of a nonlinear system at lag -L ln N (A. Farina, "Simultaneous measurement of
/// impulse response and distortion with a swept-sine technique", AES 108th convention, 2000), with the amplitude that
/// it has at N f when a sinusoid of amplitude 1 at f goes in.
[[nodiscard]] inline HalfSpectrum endlessSweepInverse(std::size_t bins, const ExponentialSweep& sweep, double rate,
                                                      double start, double highest)
{
    const double perBin = rate / static_cast<double>(2 * (bins - 1));
    HalfSpectrum inverse(bins);
    for (std::size_t k = 0; k < bins; ++k)
    {
        const double f = static_cast<double>(k) * perBin;
        if (f < 0.5 * sweep.lowFrequency() || f > highest)
            continue;
        const auto value = endlessSweepInverse(f, sweep, rate, start);
        inverse.re[k] = value.real();
        inverse.im[k] = value.imag();
    }
    return inverse;
}

/// Lag window of harmonic order `order` (2 or more): its arrival before the linear one, three tenths of the way to the
/// next order before it and seven tenths of that to the order after it, `reverberation` s at most.
[[nodiscard]] inline LagWindow harmonicWindow(int order, double growthTime, double reverberation) noexcept
{
    const double n = order;
    const double arrival = -growthTime * std::log(n);
    const double before = std::min(0.3 * growthTime * std::log((n + 1.0) / n), reverberation);
    const double after = std::min(0.65 * growthTime * std::log(n / (n - 1.0)), reverberation);
    return {arrival - before, arrival - 0.3 * before, arrival + 0.6 * after, arrival + after};
}

/// Lag window of the linear response: the side before its arrival is kept too, see Deconvolver.
[[nodiscard]] inline LagWindow linearWindow(double growthTime, double reverberation) noexcept
{
    const double before = std::min(0.3 * growthTime * std::numbers::ln2, reverberation);
    return {-before, -0.5 * before, 0.7 * reverberation, reverberation};
}

/// Power over frequency, and its expected noise; two columns of equal length.
struct NoisyPower
{
    std::vector<double> frequency; ///< Hz
    std::vector<double> power;
    std::vector<double> noise;

    /// Adds the columns of another channel at the same frequencies.
    void add(const NoisyPower& other)
    {
        if (frequency.empty())
        {
            *this = other;
            return;
        }
        for (std::size_t k = 0; k < power.size(); ++k)
        {
            power[k] += other.power[k];
            noise[k] += other.noise[k];
        }
    }
};

/// The responses of one level over all its repeats, per channel.
struct LevelResponses
{
    std::vector<NoisyPower> linear;                 ///< (m/s^2)^2 at a drive of 1
    std::vector<std::vector<NoisyPower>> harmonics; ///< [order - 2][channel], (m/s^2)^2 at the drive played
    std::vector<ResponseCut> impulses;              ///< linear, m/s^2 at a drive of 1
};

namespace detail
{
/// The spectrum of a cut, at least twice as fine as its length asks for, up to `highest` Hz. noiseAt(f) is the power of
/// noise per squared window.
template <typename NoiseAt>
[[nodiscard]] NoisyPower cutPower(const ResponseCut& cut, double rate, double highest, const NoiseAt& noiseAt)
{
    SplitRealFft<double> fft(nextFastFftSize(2 * cut.samples.size()));
    std::vector<double> padded(fft.size(), 0.0);
    std::copy(cut.samples.begin(), cut.samples.end(), padded.begin());
    HalfSpectrum spectrum(fft.bins());
    fft.forward(padded.data(), spectrum.re.data(), spectrum.im.data());
    const double perBin = rate / static_cast<double>(fft.size());
    const auto last = std::min(fft.bins() - 1, static_cast<std::size_t>(highest / perBin) + 1);
    NoisyPower out;
    for (std::size_t k = 1; k <= last; ++k)
    {
        const double f = static_cast<double>(k) * perBin;
        out.frequency.push_back(f);
        out.power.push_back(spectrum.re[k] * spectrum.re[k] + spectrum.im[k] * spectrum.im[k]);
        out.noise.push_back(cut.windowEnergy * noiseAt(f));
    }
    return out;
}

inline void addTo(HalfSpectrum& sum, const HalfSpectrum& more, double weight)
{
    for (std::size_t k = 0; k < sum.re.size(); ++k)
    {
        sum.re[k] += weight * more.re[k];
        sum.im[k] += weight * more.im[k];
    }
}
} // namespace detail

/// Deconvolves every repeat of level step `levelIndex` by the sweep as the recorder's clock saw it, at its arrival to a
/// fraction of a sample, so that nothing is resampled and the repeats can be averaged with their phases. `highest` Hz
/// is what the recording holds.
[[nodiscard]] inline LevelResponses analyseLevel(const RecordedChannels& recording, const SweepParams& params,
                                                 const SweepSchedule& schedule, const SweepTiming& timing,
                                                 std::span<const NoiseSpectrum> noise, std::size_t levelIndex,
                                                 int highestOrder, double highest)
{
    const double rate = recording.rate;
    const ExponentialSweep played = measuringSweep(params);
    const ExponentialSweep sweep = played.byClock(timing.drift);
    const double growth = sweep.growthTime();
    const double reverberation = std::min(0.9 * params.pause, 2.0);
    const double before = std::min(0.2, 0.5 * params.pause);
    const double seconds = before + sweep.seconds() + reverberation;
    const auto frames = static_cast<std::size_t>(std::ceil(seconds * rate));
    // The orders wrap to the end of the circular response, where nothing else is.
    const double lags = growth * std::log(highestOrder + 1.0) + 2.0 * reverberation;
    const std::size_t size = nextFastFftSize(std::max(frames, static_cast<std::size_t>(std::ceil(lags * rate))));
    const double gain = Decibels(params.levels[levelIndex]).gain();
    const double repeats = params.repeats;
    const std::size_t channels = recording.channels.size();

    std::vector<HalfSpectrum> linear(channels, HalfSpectrum(size / 2 + 1));
    std::vector<HalfSpectrum> endless(channels, HalfSpectrum(size / 2 + 1));
    std::optional<Deconvolver> deconvolver;
    for (const ScheduledSweep& s : schedule.sweeps)
    {
        if (s.levelIndex != levelIndex)
            continue;
        const double playTime = static_cast<double>(s.startFrame) / params.sampleRate;
        const double arrival = timing.arrival(playTime) * rate;
        const auto first = static_cast<std::ptrdiff_t>(std::floor(arrival - before * rate));
        const double delay = arrival - static_cast<double>(first);
        deconvolver.emplace(heardSweep(played, playTime, timing, rate, first, std::min(frames, size)), size);
        const auto endlessInverse =
            highestOrder > 1 ? endlessSweepInverse(size / 2 + 1, sweep, rate, delay / rate, highest) : HalfSpectrum();
        for (std::size_t c = 0; c < channels; ++c)
        {
            const auto recorded = deconvolver->spectrum(recording.part(c, first, std::min(frames, size)));
            detail::addTo(linear[c], deconvolver->response(recorded), 1.0 / (gain * repeats));
            if (highestOrder > 1)
                detail::addTo(endless[c], product(recorded, endlessInverse), 1.0 / repeats);
        }
    }

    LevelResponses responses;
    responses.harmonics.resize(static_cast<std::size_t>(highestOrder - 1));
    for (std::size_t c = 0; c < channels; ++c)
    {
        responses.impulses.push_back(
            cutResponse(deconvolver->signal(linear[c]), rate, linearWindow(growth, reverberation)));
        responses.linear.push_back(detail::cutPower(
            responses.impulses.back(), rate, 1.1 * params.highFrequency,
            [&](double f) { return noise[c].at(f) * deconvolver->noisePower(f / rate) / (gain * gain * repeats); }));
        if (highestOrder == 1)
            continue;
        const auto signal = deconvolver->signal(endless[c]);
        for (int order = 2; order <= highestOrder; ++order)
            responses.harmonics[static_cast<std::size_t>(order - 2)].push_back(detail::cutPower(
                cutResponse(signal, rate, harmonicWindow(order, growth, reverberation)), rate, highest,
                [&](double f)
                { return noise[c].at(f) * std::norm(endlessSweepInverse(f, sweep, rate, 0.0)) / repeats; }));
    }
    return responses;
}

/// The lists of a level: averaged over fractions of an octave at the points' frequencies, without the noise that is
/// expected in them. Where noise is most of a power, a tenth of the power is left: what remains of a difference of two
/// large numbers says nothing.
[[nodiscard]] inline LevelMeasurement summariseLevel(const LevelResponses& responses, double level,
                                                     std::span<const double> frequency, double smoothing,
                                                     double highest)
{
    constexpr double leastPower = 1e-30; // -300 dB: digital silence
    const auto decibels = [=](double power)
    {
        return Decibels::fromPower(std::max(power, leastPower)).value;
    };
    struct Smoothed
    {
        SmoothedPower power;
        SmoothedPower noise;
    };
    const auto smoothed = [](const std::vector<NoisyPower>& channels)
    {
        NoisyPower sum;
        for (const NoisyPower& channel : channels)
            sum.add(channel);
        return Smoothed{SmoothedPower(sum.frequency, sum.power), SmoothedPower(sum.frequency, sum.noise)};
    };
    LevelMeasurement out;
    out.level = level;
    out.response.frequency.assign(frequency.begin(), frequency.end());
    out.noise.frequency = out.snr.frequency = out.response.frequency;
    const auto linear = smoothed(responses.linear);
    std::vector<double> fundamental; // power at the drive played
    const double driven = Decibels(level).power();
    for (const double f : frequency)
    {
        const double power = linear.power.at(f, smoothing);
        const double noise = linear.noise.at(f, smoothing);
        const double signal = std::max(power - noise, 0.1 * power);
        fundamental.push_back(std::max(signal * driven, leastPower));
        out.response.level.push_back(decibels(signal));
        out.noise.level.push_back(decibels(noise));
        out.snr.level.push_back(out.response.level.back() - out.noise.level.back());
    }
    std::vector<double> sum(frequency.size(), 0.0);
    for (std::size_t i = 0; i < responses.harmonics.size(); ++i)
    {
        HarmonicResponse harmonic{static_cast<int>(i + 2), {}};
        const auto order = smoothed(responses.harmonics[i]);
        for (std::size_t k = 0; k < frequency.size() && frequency[k] * harmonic.order <= highest; ++k)
        {
            const double f = frequency[k] * harmonic.order;
            const double power = order.power.at(f, smoothing);
            const double signal = power - order.noise.at(f, smoothing);
            harmonic.response.frequency.push_back(frequency[k]);
            harmonic.response.level.push_back(decibels(std::max(signal, 0.1 * power) / fundamental[k]));
            // Few bins lie in a fraction of an octave, so that noise alone often shows three times its mean.
            constexpr double significant = 4.0;
            if (power > significant * order.noise.at(f, smoothing))
                sum[k] += signal / fundamental[k];
        }
        out.harmonics.push_back(std::move(harmonic));
    }
    for (const double ratio : sum)
        out.distortion.push_back(100.0 * std::sqrt(ratio));
    return out;
}

} // namespace pacini
