#include "cli/bench/Bench.h"
#include "cli/bench/FirFit.h"
#include "cli/bench/Timed.h"
#include "cli/bench/YuleWalker.h"

#include <pacini/foundation/Random.h>
#include <pacini/linearize/EqualizerFit.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pacini::cli
{

namespace
{
constexpr double lowest = 30.0;    // Hz
constexpr double highest = 1000.0; // Hz
constexpr int points = 256;

using Gain = std::function<std::complex<double>(double)>; ///< at f Hz

/// A response, with and without measurement noise.
struct Measured
{
    FrequencyResponse response;
    std::vector<double> truth; ///< dB
};

/// Acceleration of a mass on a spring driven by a force.
Gain massOnSpring(double frequency, double q)
{
    return [=](double f)
    {
        const std::complex<double> s(0.0, f / frequency);
        return s * s / (s * s + s / q + 1.0);
    };
}

/// A part of the way that resonates or, with a gain below 0 dB, absorbs.
Gain joint(double frequency, double gain, double q)
{
    return [=](double f)
    {
        const double a = std::pow(10.0, gain / 40.0);
        const std::complex<double> s(0.0, f / frequency);
        return (s * s + s * a / q + 1.0) / (s * s + s / (a * q) + 1.0);
    };
}

/// Skin and padding above `frequency`.
Gain softCover(double frequency)
{
    return [=](double f)
    {
        const std::complex<double> s(0.0, f / frequency);
        return 1.0 / (s * s + std::numbers::sqrt2 * s + 1.0);
    };
}

Measured measured(const std::vector<Gain>& parts, double noise = 0.0)
{
    Random random(29);
    Measured result;
    for (int i = 0; i < points; ++i)
    {
        const double f = lowest * std::pow(highest / lowest, static_cast<double>(i) / (points - 1));
        double level = 0.0;
        for (const Gain& part : parts)
            level += Decibels::fromGain(std::abs(part(f))).value;
        double sum = -6.0; // twelve uniform numbers make nearly a normal one
        for (int k = 0; k < 12; ++k)
            sum += random.uniform();
        result.response.frequency.push_back(f);
        result.truth.push_back(level);
        result.response.level.push_back(level + noise * sum);
    }
    return result;
}

std::vector<Measured> responses()
{
    const Gain coil = massOnSpring(67.0, 4.0);
    return {measured({coil}),
            measured({massOnSpring(175.0, 20.0)}),
            measured({coil, joint(260.0, 8.0, 4.0)}),
            measured({coil, joint(150.0, -10.0, 5.0), joint(480.0, -8.0, 6.0)}),
            measured({coil, softCover(400.0)}),
            measured({coil, joint(260.0, 8.0, 4.0)}, 1.0)};
}

/// An equalizer as it runs.
struct Fitted
{
    Gain gain;
    double latency = 0.0;    ///< s, where it is the same at all frequencies
    double multiplies = 0.0; ///< per frame
    double size = 0.0;       ///< sections, taps or order
};

struct EqualizerMethod
{
    std::string name, setting;
    std::function<Fitted(const FrequencyResponse&, const EqualizerFitParams&)> fit;
};

EqualizerMethod sectionsMethod(std::optional<int> count)
{
    return {"sections", count ? fmt::format("{}", *count) : "auto",
            [count](const FrequencyResponse& response, const EqualizerFitParams& given)
            {
                EqualizerFitParams params = given;
                params.sections = count;
                const auto sections = fitEqualizer(response, params).value().sections;
                const auto filter = designEqualizer(sections, params.sampleRate);
                const auto used = static_cast<double>(sections.size());
                constexpr double perSection = 8.0; // see StateVariableState::tick()
                return Fitted{[filter, fs = params.sampleRate](double f) { return filter.response(Hertz(f), fs); }, 0.0,
                              perSection * used, used};
            }};
}

Gain polynomial(std::vector<double> taps, double fs)
{
    return [taps = std::move(taps), fs](double f)
    {
        const auto z = std::polar(1.0, -2.0 * std::numbers::pi * f / fs);
        std::complex<double> sum = 0.0;
        for (std::size_t n = taps.size(); n-- > 0;)
            sum = sum * z + taps[n];
        return sum;
    };
}

EqualizerMethod firMethod(int taps, FirPhase phase)
{
    return {phase == FirPhase::linear ? "FIR, linear phase" : "FIR, minimum phase", fmt::format("{}", taps),
            [=](const FrequencyResponse& response, const EqualizerFitParams& params)
            {
                const FirFit fit = fitFir(response, taps, params, phase).value();
                const auto used = static_cast<double>(fit.taps.size());
                return Fitted{polynomial(fit.taps, params.sampleRate), fit.latency, used, used};
            }};
}

EqualizerMethod yuleWalkerMethod(int order)
{
    return {"Yule-Walker", fmt::format("{}", order),
            [order](const FrequencyResponse& response, const EqualizerFitParams& params)
            {
                const YuleWalkerFit fit = fitYuleWalker(response, order, params).value();
                const Gain above = polynomial(fit.numerator, params.sampleRate);
                const Gain below = polynomial(fit.denominator, params.sampleRate);
                return Fitted{[above, below](double f) { return above(f) / below(f); }, 0.0, 2.0 * order + 1.0,
                              static_cast<double>(order)};
            }};
}

std::vector<EqualizerMethod> methodsAt(int rate)
{
    std::vector<EqualizerMethod> methods;
    for (int count = 1; count <= 8; ++count)
        methods.push_back(sectionsMethod(count));
    methods.push_back(sectionsMethod(std::nullopt));
    const int maxTaps = rate > 8000 ? 4096 : 1024; // the same time
    for (const FirPhase phase : {FirPhase::linear, FirPhase::minimum})
        for (int taps = 32; taps <= maxTaps; taps *= 2)
            methods.push_back(firMethod(taps, phase));
    for (int order = 4; order <= 128; order *= 2)
        methods.push_back(yuleWalkerMethod(order));
    return methods;
}

struct Error
{
    double rms = 0.0, max = 0.0; ///< dB
    double delay = 0.0;          ///< s, the largest group delay
};

Error errorOf(const Measured& measurement, const Fitted& fitted)
{
    const auto& frequency = measurement.response.frequency;
    const auto n = static_cast<double>(points);
    std::vector<double> levels;
    Error error;
    double mean = 0.0;
    std::complex<double> before;
    error.delay = -1.0;
    for (std::size_t i = 0; i < frequency.size(); ++i)
    {
        // without the part that is the same everywhere, whose phase would wrap between two points
        const auto gain =
            fitted.gain(frequency[i]) * std::polar(1.0, 2.0 * std::numbers::pi * frequency[i] * fitted.latency);
        levels.push_back(measurement.truth[i] + Decibels::fromGain(std::abs(gain)).value);
        mean += levels.back() / n;
        if (i > 0)
            error.delay = std::max(error.delay, -std::arg(gain / before) /
                                                    (2.0 * std::numbers::pi * (frequency[i] - frequency[i - 1])));
        before = gain;
    }
    error.delay += fitted.latency;
    for (const double level : levels)
    {
        error.rms += (level - mean) * (level - mean) / n;
        error.max = std::max(error.max, std::abs(level - mean));
    }
    error.rms = std::sqrt(error.rms);
    return error;
}

void measureEqualizers(const BenchSound&, const BenchSettings& settings, BenchTable& rows)
{
    const std::vector<Measured> all = responses();
    const auto count = static_cast<double>(all.size());
    for (const int rate : {48000, 8000})
        for (const EqualizerMethod& method : methodsAt(rate))
        {
            EqualizerFitParams params;
            params.sampleRate = rate;
            double seconds = 0.0, rms = 0.0, worst = 0.0, max = 0.0, delay = 0.0, multiplies = 0.0, size = 0.0;
            for (const Measured& measurement : all)
            {
                const auto fitted = timed(settings.repeats, [&] { return method.fit(measurement.response, params); });
                const Error error = errorOf(measurement, fitted.result);
                seconds += fitted.seconds;
                rms += error.rms / count;
                worst = std::max(worst, error.rms);
                max = std::max(max, error.max);
                delay += 1e3 * error.delay / count;
                multiplies += fitted.result.multiplies / count;
                size += fitted.result.size / count;
            }
            rows.add({"six responses", fmt::format("{} kHz", rate / 1000), method.name, method.setting, size, count,
                      seconds, rms, worst, max, delay, multiplies});
        }
}
} // namespace

Bench equalizersBench()
{
    const auto figure = [](const char* name, const char* rate)
    {
        return BenchFigure{name,     fmt::format("Equalisers that flatten an actuator, {}", rate),
                           "method", "time",
                           "error",  "setting",
                           "rate",   rate};
    };
    return {
        "equalizers",
        "Equalisers that flatten an actuator",
        "Six responses at 256 frequencies from 30 to 1000 Hz: a voice coil with its resonance at 67 Hz, a linear "
        "resonant actuator at 175 Hz with a q of 20, the coil with a second resonance, with two notches, under a "
        "soft cover, and with the second resonance and 1 dB of measurement noise. The boost may be 12 dB. The setting "
        "is the number of sections, taps, or the order; size is what was really used. The error is the RMS deviation "
        "from flat of the noiseless response with the equaliser, level removed, worst the largest of the six, max the "
        "largest deviation anywhere. Delay is the largest group delay in the range, in the mean of the responses.",
        columnsOf({"rate", "method", "setting"}, {{"size", ""},
                                                  summed("fits"),
                                                  summed("seconds", "s"),
                                                  {"error", "dB"},
                                                  {"worst", "dB"},
                                                  {"max", "dB"},
                                                  {"delay", "ms"},
                                                  {"multiplies", "1/frame"},
                                                  {"time", "ms", Reduction::ratio, "seconds", "fits", 1e3},
                                                  {"relativeTime", "", Reduction::relative, "time", "rate"}}),
        {figure("48", "48 kHz"), figure("8", "8 kHz")},
        {},
        measureEqualizers,
        false};
}

} // namespace pacini::cli
