#pragma once

// Delay estimation over time: how the delay of a recording develops from sweep to sweep.

#include <pacini/foundation/Fft.h>
#include <pacini/foundation/SplitFft.h>
#include <pacini/linearize/Deconvolution.h>
#include <pacini/linearize/LagWindow.h>
#include <pacini/linearize/RecordedChannels.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

namespace pacini
{

/// The delay of one frequency band in one sweep, relative to the same band in a reference sweep.
struct DelayPoint
{
    double time = 0.0;      ///< s of the playback at which the sweep passes the band
    double sinceThen = 0.0; ///< s of the playback since the reference passed it
    double delay = 0.0;     ///< difference of the time that has passed in the recording, s
    double deviation = 0.0; ///< s, expected standard deviation of the delay
};

/// The impulse responses of all channels around one sweep's arrival.
struct ArrivedSweep
{
    double playTime = 0.0;             ///< s of the playback at which it started
    double arrival = 0.0;              ///< s of the recording at which its response is strongest
    std::vector<ResponseCut> channels; ///< lag 0 is the arrival; all of one length
};

/// Deconvolves the sweep (as the recorder sees it) that was played at `playTime` and is expected at `expected` s of the
/// recording, finds its strongest moment within `tolerance` s around and cuts `before` to `after` s around that.
[[nodiscard]] inline ArrivedSweep arrivedSweep(const RecordedChannels& recording, const ExponentialSweep& sweep,
                                               double playTime, double expected, double tolerance, double before,
                                               double after)
{
    const double rate = recording.rate;
    const auto margin = static_cast<std::ptrdiff_t>(std::ceil((tolerance + before) * rate));
    const auto first = static_cast<std::ptrdiff_t>(std::floor(expected * rate)) - margin;
    const auto played = delayedSweep(sweep, rate, static_cast<double>(margin));
    const auto tail = static_cast<std::size_t>(std::ceil((tolerance + after) * rate));
    const std::size_t size = nextFastFftSize(played.size() + tail + static_cast<std::size_t>(margin));
    Deconvolver deconvolver(played, size);
    std::vector<std::vector<double>> responses;
    const auto lags = static_cast<std::ptrdiff_t>(std::ceil(tolerance * rate));
    std::vector<double> power(static_cast<std::size_t>(2 * lags + 1), 0.0);
    for (std::size_t c = 0; c < recording.channels.size(); ++c)
    {
        responses.push_back(deconvolver.signal(
            deconvolver.response(deconvolver.spectrum(recording.part(c, first, played.size() + tail)))));
        for (std::ptrdiff_t lag = -lags; lag <= lags; ++lag)
        {
            const double v =
                responses[c][static_cast<std::size_t>(lag < 0 ? lag + static_cast<std::ptrdiff_t>(size) : lag)];
            power[static_cast<std::size_t>(lag + lags)] += v * v;
        }
    }
    const double peak = static_cast<double>(std::max_element(power.begin(), power.end()) - power.begin() - lags) / rate;
    ArrivedSweep arrived{playTime, static_cast<double>(first + margin) / rate + peak, {}};
    const LagWindow window = LagWindow::withSides(peak - before, peak + after, 0.1);
    for (const auto& response : responses)
    {
        arrived.channels.push_back(cutResponse(response, rate, window));
        arrived.channels.back().firstLag -= std::lround(peak * rate);
    }
    return arrived;
}

/// Compares sweeps with a reference sweep band by band. The system between player and recorder is the same for both and
/// leaves no trace in their cross spectrum, whose phase then is that of a pure delay: its envelope finds the cycle, its
/// carrier the fraction. Bands of 2/3 octave, 12 per octave.
class DelayTrack
{
public:
    /// `reference` as it arrived; sweeps compared later are at most `longest` samples long at `rate` Hz.
    DelayTrack(const ArrivedSweep& reference, double rate, std::size_t longest)
        : fs(rate),
          origin(reference),
          size(nextFastFftSize(reference.channels.front().samples.size() + longest)),
          transform(size),
          spectra(spectraOf(reference))
    {
    }

    /// The points of `arrived` from `low` to `high` Hz. `sweep` and `referenceSweep` as they were played; both have
    /// been deconvolved as seen by a clock that drifts by `drift`, which therefore is missing in their responses and
    /// put back here. Bands that do not resemble the reference are left out.
    [[nodiscard]] std::vector<DelayPoint> compare(const ArrivedSweep& arrived, const ExponentialSweep& sweep,
                                                  const ExponentialSweep& referenceSweep, double drift, double low,
                                                  double high)
    {
        const auto cross = crossSpectrum(arrived);
        const double coarse = coarseDelay(arrived);
        const double seconds = static_cast<double>(arrived.channels.front().samples.size()) / fs;
        std::vector<DelayPoint> points;
        for (double f = low; f <= high; f *= std::exp2(1.0 / 12.0))
        {
            const double time = arrived.playTime + sweep.timeOf(f);
            const double referenceTime = origin.playTime + referenceSweep.timeOf(f);
            const double removed = drift * (sweep.timeOf(f) - referenceSweep.timeOf(f));
            const auto fine = bandDelay(cross, f, seconds);
            if (fine.deviation > 0.0)
                points.push_back({time, time - referenceTime, coarse + removed + fine.seconds, fine.deviation});
        }
        return points;
    }

    /// The time of the playback, from `from` to `to` s, from which on the frequencies of `arrived` are late by
    /// before + step instead of `before` s (beside the drift): where the phases that each of both leaves change from
    /// agreeing with the one to agreeing with the other. Finer than the bands of compare(), once the delays are known.
    [[nodiscard]] double stepTime(const ArrivedSweep& arrived, const ExponentialSweep& sweep, double drift,
                                  double before, double step, double from, double to)
    {
        const auto cross = crossSpectrum(arrived);
        const double perBin = fs / static_cast<double>(size);
        const double coarse = coarseDelay(arrived);
        const double sinceStart = arrived.playTime - origin.playTime;
        double agreement = 0.0;
        double best = 0.0;
        double bestTime = from;
        for (std::size_t k = 1; k < cross.re.size(); ++k)
        {
            const double f = static_cast<double>(k) * perBin;
            const double time = arrived.playTime + sweep.timeOf(f);
            if (time < from || time > to)
                continue;
            const double magnitude = std::hypot(cross.re[k], cross.im[k]);
            if (!(magnitude > 0.0))
                continue;
            // The drift between the two sweeps' parts has been taken out by their deconvolution.
            const double turn = 2.0 * std::numbers::pi * f;
            const double late = before + drift * sinceStart - coarse;
            const std::complex<double> phase(cross.re[k] / magnitude, cross.im[k] / magnitude);
            const double earlier = (phase * std::polar(1.0, turn * late)).real();
            const double later = (phase * std::polar(1.0, turn * (late + step))).real();
            agreement += earlier - later;
            if (agreement > best)
            {
                best = agreement;
                bestTime = time;
            }
        }
        return bestTime;
    }

private:
    /// s by which the strongest moment of a sweep comes later after that of the reference than it was played.
    [[nodiscard]] double coarseDelay(const ArrivedSweep& arrived) const noexcept
    {
        return (arrived.arrival - arrived.playTime) - (origin.arrival - origin.playTime);
    }

    /// S R* summed over the channels, both with their arrival at time 0.
    [[nodiscard]] SplitArray<double> crossSpectrum(const ArrivedSweep& arrived)
    {
        const auto other = spectraOf(arrived);
        SplitArray<double> cross(size / 2 + 1);
        for (std::size_t c = 0; c < other.size(); ++c)
            for (std::size_t k = 0; k < cross.re.size(); ++k)
            {
                const auto product = other[c][k] * std::conj(spectra[c][k]);
                cross.re[k] += product.real();
                cross.im[k] += product.imag();
            }
        return cross;
    }

    struct BandDelay
    {
        double seconds = 0.0;
        double deviation = 0.0; // 0: not found
    };

    /// Spectra with the arrival at time 0.
    [[nodiscard]] std::vector<std::vector<std::complex<double>>> spectraOf(const ArrivedSweep& sweep)
    {
        std::vector<std::vector<std::complex<double>>> out;
        SplitArray<double> in(size);
        SplitArray<double> bins(size);
        for (const ResponseCut& cut : sweep.channels)
        {
            std::fill(in.re.begin(), in.re.end(), 0.0);
            for (std::size_t i = 0; i < cut.samples.size(); ++i)
            {
                const auto lag = static_cast<std::ptrdiff_t>(i) + cut.firstLag;
                in.re[static_cast<std::size_t>(lag < 0 ? lag + static_cast<std::ptrdiff_t>(size) : lag)] =
                    cut.samples[i];
            }
            transform.forward(in.re.data(), in.im.data(), bins.re.data(), bins.im.data());
            auto& spectrum = out.emplace_back(size / 2 + 1);
            for (std::size_t k = 0; k < spectrum.size(); ++k)
                spectrum[k] = {bins.re[k], bins.im[k]};
        }
        return out;
    }

    [[nodiscard]] BandDelay bandDelay(const SplitArray<double>& cross, double f, double seconds)
    {
        const double perBin = fs / static_cast<double>(size);
        SplitArray<double> band(size);
        SplitArray<double> correlation(size);
        double total = 0.0;
        double moment = 0.0;
        const auto first = static_cast<std::size_t>(std::ceil(f * std::exp2(-1.0 / 3.0) / perBin));
        const auto last = std::min(static_cast<std::size_t>(f * std::exp2(1.0 / 3.0) / perBin), cross.re.size() - 1);
        for (std::size_t k = first; k <= last; ++k)
        {
            const double frequency = static_cast<double>(k) * perBin;
            const double octaves = std::log2(frequency / f);
            const double weight = 0.5 + 0.5 * std::cos(3.0 * std::numbers::pi * octaves);
            band.re[k] = weight * cross.re[k];
            band.im[k] = weight * cross.im[k];
            const double magnitude = std::hypot(band.re[k], band.im[k]);
            total += magnitude;
            moment += magnitude * frequency;
        }
        if (!(total > 0.0))
            return {};
        const double centre = moment / total;
        transform.inverse(band.re.data(), band.im.data(), correlation.re.data(), correlation.im.data());
        std::size_t best = 0;
        double largest = -1.0;
        for (std::size_t i = 0; i < size; ++i)
        {
            const double power = correlation.re[i] * correlation.re[i] + correlation.im[i] * correlation.im[i];
            if (power > largest)
            {
                largest = power;
                best = i;
            }
        }
        const double coherence = std::sqrt(largest) / total;
        if (coherence < leastCoherence)
            return {};
        const double lag =
            (best > size / 2 ? static_cast<double>(best) - static_cast<double>(size) : static_cast<double>(best)) / fs;
        const double turn = 2.0 * std::numbers::pi * centre;
        // Independent values in the band: its width, about half of its centre, times the length of the response.
        const double values = std::max(1.0, 0.4 * f * seconds);
        const double noise = std::sqrt(std::max(0.0, 1.0 - coherence * coherence) / (2.0 * values)) / coherence;
        // Windows of different lengths turn the phase: that of the reference is short, and a band of f Hz has a
        // forerunner of some 1 / f. Measured without noise, 0.05 rad at 50 Hz; nonlinearities add some at any
        // frequency.
        const double systematic = 0.003 * (1.0 + std::pow(200.0 / f, 2));
        return {lag - std::arg(std::complex<double>(correlation.re[best], correlation.im[best])) / turn,
                std::hypot(noise, systematic) / turn};
    }

    static constexpr double leastCoherence = 0.6;

    double fs;
    ArrivedSweep origin;
    std::size_t size;
    SplitFft<double> transform;
    std::vector<std::vector<std::complex<double>>> spectra;
};

} // namespace pacini
