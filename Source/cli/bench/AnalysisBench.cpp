#include "cli/bench/Bench.h"
#include "cli/bench/Timed.h"
#include "cli/bench/ZeroPhaseBank.h"

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/methods/MethodCurves.h>
#include <pacini/evaluate/AnalyticBand.h>
#include <pacini/filters/FilterBank.h>
#include <pacini/filters/RationalDecimator.h>
#include <pacini/foundation/Fft.h>
#include <pacini/foundation/Units.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace pacini::cli
{

namespace
{
constexpr double analysisExcerpt = 10.0; // s of each sound
constexpr double lowFrequency = 30;      // Hz
constexpr double highFrequency = 1000;
constexpr double gridStep = 0.005; // s, where envelopes are compared

/// One envelope per band over time, value i at i * step seconds.
struct Envelopes
{
    double step = gridStep;
    std::vector<std::vector<float>> bands;

    /// Straight lines between values, the end values outside.
    [[nodiscard]] double at(std::size_t band, double time) const
    {
        const auto& values = bands[band];
        const double last = static_cast<double>(values.size() - 1);
        const double position = std::clamp(time / step, 0.0, last);
        const auto i = static_cast<std::size_t>(std::min(std::floor(position), std::max(0.0, last - 1.0)));
        const double fraction = position - static_cast<double>(i);
        const auto a = static_cast<double>(values[i]);
        return fraction > 0.0 ? a + fraction * (static_cast<double>(values[i + 1]) - a) : a;
    }
};

/// The yardstick: the bands of the judge (zero-phase Butterworth band-passes of third order, -6 dB at edges in equal
/// ratios, which is the definition of none of the banks here), by one transform of the whole sound at its own rate in
/// double precision; magnitude of the analytic signal at 16 kHz or more, 20 ms Hann. It takes no short cut in time,
/// rate or precision.
Envelopes reference(std::span<const float> mono, double fs, std::size_t bandCount)
{
    const std::size_t size = nextFastFftSize(mono.size() + static_cast<std::size_t>(fs)); // 1 s of silence after it
    std::vector<double> padded(size);
    std::copy(mono.begin(), mono.end(), padded.begin());
    RealFft<double> forward(size);
    std::vector<std::complex<double>> spectrum(forward.bins());
    forward.forward(padded, spectrum);

    const auto shorter = static_cast<std::size_t>(static_cast<double>(size) * std::min(1.0, 16000.0 / fs));
    ComplexFft<double> inverse(std::min(size, nextFastFftSize(shorter)));
    const double rate = fs * static_cast<double>(inverse.size()) / static_cast<double>(size);
    const double binWidth = fs / static_cast<double>(size);
    const double halfWindow = 0.010 * rate;
    const auto frames =
        static_cast<std::size_t>(std::floor(static_cast<double>(mono.size()) / fs / gridStep + 1e-9)) + 1;
    Envelopes envelopes;
    std::vector<std::complex<double>> bins(inverse.size()), analytic(inverse.size());
    for (std::size_t k = 0; k < bandCount; ++k)
    {
        const auto edge = [&](std::size_t e)
        {
            return onScale(BandSpacing::logarithmic, lowFrequency, highFrequency,
                           static_cast<double>(e) / static_cast<double>(bandCount));
        };
        std::fill(bins.begin(), bins.end(), 0.0);
        for (std::size_t b = 1; b < std::min(inverse.size(), size / 2); ++b)
            bins[b] = 2.0 / static_cast<double>(size) * spectrum[b] *
                      zeroPhaseBandpass(static_cast<double>(b) * binWidth, edge(k), edge(k + 1), 3);
        inverse.inverse(bins, analytic);
        auto& values = envelopes.bands.emplace_back(frames);
        for (std::size_t i = 0; i < frames; ++i)
        {
            const double centre = static_cast<double>(i) * gridStep * rate;
            double sum = 0.0, weights = 0.0;
            for (auto j = static_cast<std::ptrdiff_t>(std::ceil(centre - halfWindow));
                 static_cast<double>(j) < centre + halfWindow; ++j)
            {
                const double w =
                    0.5 + 0.5 * std::cos(std::numbers::pi * (static_cast<double>(j) - centre) / halfWindow);
                weights += w;
                if (j >= 0 && j < std::ssize(analytic))
                    sum += w * std::abs(analytic[static_cast<std::size_t>(j)]);
            }
            values[i] = static_cast<float>(sum / weights);
        }
    }
    return envelopes;
}

std::vector<float> decimated(std::span<const float> mono, RationalDecimator& decimator)
{
    std::vector<float> low;
    decimator.reset();
    decimator.push(mono, low);
    decimator.finish(low);
    return low;
}

/// Bands with the same crossovers as the reference's edges: one more band on either side takes what lies outside. Those
/// two are not followed.
BandLayoutParams layoutWithOuterBands(std::size_t bandCount)
{
    const double ratio = std::pow(highFrequency / lowFrequency, 1.0 / static_cast<double>(bandCount));
    BandLayoutParams layout;
    layout.bands = bandCount + 2;
    layout.low = Hertz(lowFrequency / ratio);
    layout.high = Hertz(highFrequency * ratio);
    layout.kind = BandLayoutKind::tiled;
    return layout;
}

/// Follows the inner bands; keeps `rate` values per second.
Envelopes followed(const BandSignals& bands, double fs, double rate)
{
    MethodCurveParams params;
    params.trackRate = Hertz(rate);
    Envelopes envelopes;
    for (std::size_t k = 1; k + 1 < bands.size(); ++k)
    {
        EnvelopeTrack track(params, fs);
        track.push(bands[k]);
        if (track.curve().size() > 1)
            envelopes.step = track.curve()[1].time;
        auto& values = envelopes.bands.emplace_back();
        for (const Breakpoint& point : track.curve())
            values.push_back(static_cast<float>(point.value));
    }
    return envelopes;
}

Envelopes byTree(std::span<const float> signal, double fs, std::size_t bandCount, double rate)
{
    FilterBank bank;
    bank.setParams(layoutWithOuterBands(bandCount));
    bank.prepare({fs, signal.size()});
    BandSignals bands(bank.bands(), std::vector<float>(signal.size()));
    std::vector<std::span<float>> outs(bands.begin(), bands.end());
    bank.process(signal, outs);
    return followed(bands, fs, rate);
}

Envelopes byZeroPhaseBank(std::span<const float> signal, double fs, std::size_t bandCount, double rate,
                          ZeroPhaseMethod method)
{
    return followed(splitZeroPhase(signal, fs, {layoutWithOuterBands(bandCount), method}), fs, rate);
}

Envelopes byBlocks(std::span<const float> low, BandAnalysis& analysis)
{
    analysis.reset(1);
    const std::span<const float> channels[] = {low};
    analysis.push(channels);
    BandAnalysisResult result = analysis.finish();
    Envelopes envelopes;
    envelopes.step = BandAnalysisResult::bandStep;
    for (auto& track : result.tracks)
        envelopes.bands.push_back(std::move(track.amplitude));
    return envelopes;
}

struct EnvelopeAgreement
{
    double snr = 0.0; ///< dB
    double lag = 0.0; ///< s by which the candidate is late, where the agreement is best
    double snrAtLag = 0.0;
};

/// sum R^2 / sum (R - g C)^2 over all bands, g the gain of least squares; at most 60 dB.
double envelopeSnr(const Envelopes& wanted, const Envelopes& found, double lag)
{
    double rr = 0.0, cc = 0.0, rc = 0.0;
    for (std::size_t k = 0; k < wanted.bands.size(); ++k)
        for (std::size_t i = 0; i < wanted.bands[k].size(); ++i)
        {
            const auto r = static_cast<double>(wanted.bands[k][i]);
            const double c = found.at(k, static_cast<double>(i) * wanted.step + lag);
            rr += r * r;
            cc += c * c;
            rc += r * c;
        }
    if (!(rr > 0.0))
        return 0.0;
    const double left = cc > 0.0 ? rr - rc * rc / cc : rr;
    return std::min(60.0, Decibels::fromPower(rr / std::max(left, 1e-300)).value);
}

EnvelopeAgreement agreement(const Envelopes& wanted, const Envelopes& found)
{
    EnvelopeAgreement best{envelopeSnr(wanted, found, 0.0), 0.0, -1.0};
    for (int millisecond = -10; millisecond <= 40; ++millisecond)
    {
        const double lag = 0.001 * millisecond;
        const double snr = envelopeSnr(wanted, found, lag);
        if (snr > best.snrAtLag)
        {
            best.snrAtLag = snr;
            best.lag = lag;
        }
    }
    return best;
}

void measureAnalysis(const BenchSound& sound, const BenchSettings& settings, BenchTable& rows)
{
    const auto mono = sound.beginning(analysisExcerpt);
    const double fs = sound.sampleRate;
    const double duration = static_cast<double>(mono.size()) / fs;
    RationalDecimator decimator(sound.sampleRate, analysisRate);
    for (const std::size_t bandCount : {1u, 3u, 6u, 12u, 24u, 30u})
    {
        const Envelopes wanted = reference(mono, fs, bandCount);
        const auto add = [&](const std::string& variant, auto&& work)
        {
            const auto run = timed(settings.repeats, work);
            const EnvelopeAgreement found = agreement(wanted, run.result);
            rows.add({sound.name, fmt::format("{}", bandCount), variant, duration, run.seconds, found.snr,
                      1000.0 * found.lag, found.snrAtLag, errorShare(found.snrAtLag)});
        };
        for (const double window : {0.040, 0.020})
        {
            BandAnalysisParams params;
            params.bands = tiledBands(bandCount, lowFrequency, highFrequency, BandSpacing::logarithmic);
            params.bandWindow = Seconds(window);
            BandAnalysis analysis(params);
            add(fmt::format("blocks, {:g} ms", 1000.0 * window),
                [&] { return byBlocks(decimated(mono, decimator), analysis); });
        }
        for (const double rate : {50.0, 1000.0})
        {
            const double lowRate = analysisRate;
            add(fmt::format("raised cosines, {:g}/s", rate),
                [&] {
                    return byZeroPhaseBank(decimated(mono, decimator), lowRate, bandCount, rate,
                                           ZeroPhaseMethod::raisedCosine);
                });
            add(fmt::format("forward-backward, {:g}/s", rate),
                [&] {
                    return byZeroPhaseBank(decimated(mono, decimator), lowRate, bandCount, rate,
                                           ZeroPhaseMethod::forwardBackward);
                });
            add(fmt::format("causal tree, {:g}/s", rate),
                [&] { return byTree(decimated(mono, decimator), lowRate, bandCount, rate); });
        }
        add("causal tree at full rate, 1000/s", [&] { return byTree(mono, fs, bandCount, 1000.0); });
    }
}
} // namespace

Bench analysisBench()
{
    return {
        "analysis",
        "Filter banks and envelopes",
        "From a mono signal at its own rate (first 10 s of each sound) to the envelopes of its bands between 30 and "
        "1000 Hz. The reference is one transform of the whole sound at full rate in double precision with the "
        "judge's bands (zero-phase Butterworth, -6 dB at the edges) and a 20 ms Hann window. SNR: of all bands with "
        "one gain, at 200 values per second; snrAtLag after the shift by lag that fits best, the same for all "
        "bands. 'blocks' is what the encoder uses, with its Hann window and 50 values per second; the others follow "
        "their bands with an attack of 2, a hold of 10 "
        "and a release of 30 ms.",
        columnsOf({"bands", "variant"}, {summed("duration", "s"),
                                         summed("seconds", "s"),
                                         {"snr", "dB"},
                                         {"lag", "ms"},
                                         {"snrAtLag", "dB"},
                                         {"errorAtLag", "%"},
                                         {"time", "ms/s", Reduction::ratio, "seconds", "duration", 1000.0},
                                         {"timesRealTime", "", Reduction::ratio, "duration", "seconds"},
                                         {"relativeTime", "", Reduction::relative, "time", "bands"}}),
        {{"", "Filter banks, 6 bands", "variant", "time", "errorAtLag", "variant", "bands", "6"},
         {"bands", "Filter banks, 1 to 30 bands", "variant", "time", "errorAtLag", "bands"}},
        {},
        measureAnalysis};
}

} // namespace pacini::cli
