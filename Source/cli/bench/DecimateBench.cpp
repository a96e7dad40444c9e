#include "cli/bench/Bench.h"
#include "cli/bench/BenchSpectrum.h"
#include "cli/bench/Timed.h"

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/filters/RationalDecimator.h>
#include <pacini/filters/Resampler.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pacini::cli
{

namespace
{
constexpr double decimateExcerpt = 10.0; // s of each sound

/// The spectra of the sound at both rates have bins at the same frequencies.
struct Sizes
{
    std::size_t input = 0;
    std::size_t output = 0;

    /// For transforms of at least `frames` input samples and a second of silence. Both sizes are even.
    Sizes(std::size_t frames, int sampleRate)
    {
        const int divisor = std::gcd(sampleRate, analysisRate);
        const auto step = static_cast<std::size_t>(sampleRate / divisor);
        const std::size_t blocks = nextFastFftSize((frames + static_cast<std::size_t>(sampleRate)) / step + 1);
        input = step * blocks;
        output = static_cast<std::size_t>(analysisRate / divisor) * blocks;
    }
};

/// Energy of the ideal signal over that of the difference between `low` and `high` Hz, dB, at most 150.
double snrBetween(const Spectrum& ideal, const Spectrum& found, std::size_t outputSize, double low, double high)
{
    const double binWidth = static_cast<double>(analysisRate) / static_cast<double>(outputSize);
    double energy = 0.0, difference = 0.0;
    for (std::size_t b = 0; b < found.size(); ++b)
        if (const double f = binWidth * static_cast<double>(b); f >= low && f <= high)
        {
            energy += std::norm(ideal[b]);
            difference += std::norm(ideal[b] - found[b]);
        }
    return energy > 0.0 ? std::min(150.0, Decibels::fromPower(energy / std::max(difference, 1e-300)).value) : 150.0;
}

void measureDecimate(const BenchSound& sound, const BenchSettings& settings, BenchTable& rows)
{
    if (sound.sampleRate / std::gcd(sound.sampleRate, analysisRate) > 1000)
        return; // the reference would need a transform of a huge prime factor
    const auto mono = sound.beginning(decimateExcerpt);
    const double duration = static_cast<double>(mono.size()) / sound.sampleRate;
    const Sizes sizes(mono.size(), sound.sampleRate);
    // An ideal low-pass at half the output rate changes no bin below it; only their scale goes with the length.
    Spectrum ideal = spectrumOf(mono, sizes.input);
    for (auto& bin : ideal)
        bin *= static_cast<double>(sizes.output) / static_cast<double>(sizes.input);
    const auto add = [&](const std::string& variant, auto&& work)
    {
        const auto run = timed(settings.repeats, work);
        const Spectrum found = spectrumOf(run.result, sizes.output);
        const double snr = snrBetween(ideal, found, sizes.output, 20.0, 1000.0);
        rows.add({sound.name, variant, static_cast<double>(mono.size()), duration, run.seconds, snr, errorShare(snr),
                  snrBetween(ideal, found, sizes.output, 1000.0, 1700.0)});
    };
    const auto addDecimator = [&](const std::string& variant, const RationalDecimatorParams& params)
    {
        RationalDecimator decimator(sound.sampleRate, analysisRate, params);
        add(variant,
            [&]
            {
                std::vector<float> low;
                decimator.reset();
                decimator.push(mono, low);
                decimator.finish(low);
                return low;
            });
    };
    addDecimator("decimator, 60 dB", {});
    addDecimator("decimator, 40 dB", {.attenuation = 40_dB});
    addDecimator("decimator, 80 dB", {.attenuation = 80_dB});
    addDecimator("decimator, 100 dB", {.attenuation = 100_dB});
    addDecimator("decimator, 60 dB from 2300 Hz", {.stopFrequency = 2300_Hz});
    const auto addResampler = [&]<typename Sample>(const std::string& variant, Sample)
    {
        const Resampler<Sample> resampler(sound.sampleRate, analysisRate);
        const std::vector<Sample> input(mono.begin(), mono.end());
        std::vector<Sample> low(resampler.outputFrames(input.size()));
        add(variant,
            [&]
            {
                resampler.process(input, 0, 0, low);
                return std::vector<float>(low.begin(), low.end());
            });
    };
    addResampler("resampler, float", 0.0f);
    addResampler("resampler, double", 0.0);
}
} // namespace

Bench decimateBench()
{
    return {
        "decimate",
        "Decimators",
        "From a sound's own rate to the 4 kHz of the analysis (first 10 s). The reference is an ideal low-pass: the "
        "spectrum of the whole sound, cut at 2 kHz. SNR over the range of the bands and over what lies above it, "
        "where aliases come first; the making of the filter is not timed.",
        columnsOf({"variant"}, {summed("frames"),
                                summed("duration", "s"),
                                summed("seconds", "s"),
                                {"snr20to1000Hz", "dB"},
                                {"error20to1000Hz", "%"},
                                {"snr1000to1700Hz", "dB"},
                                {"time", "ns/frame", Reduction::ratio, "seconds", "frames", 1e9},
                                {"timesRealTime", "", Reduction::ratio, "duration", "seconds"},
                                {"relativeTime", "", Reduction::relative, "time"}}),
        {{"", "Decimators", "variant", "time", "error20to1000Hz", "variant"}},
        {},
        measureDecimate};
}

} // namespace pacini::cli
