#include "cli/bench/Bench.h"
#include "cli/bench/BenchSpectrum.h"
#include "cli/bench/BodyIntegration.h"
#include "cli/bench/Timed.h"

#include <pacini/actuator/BodyModel.h>
#include <pacini/filters/Resampler.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>

namespace pacini::cli
{

namespace
{
constexpr double bodyExcerpt = 2.0; // s of each sound
constexpr double silence = 1.0;     // s after it, in which everything has died away
constexpr std::array rates = {48000, 16000, 8000};
constexpr std::array stiffnesses = {4e4, 1e6, 1e8, 1e11}; // N/m
constexpr double dampingRatio = 0.02;                     // of the joint
constexpr double lightDampingRatio = 0.001;               // of the joint where an integrator may break
constexpr Resonance resonance{65.93, 3.969};              // the L5 voice coil, as measured in the thesis

BodyParams bodyWith(double jointStiffness, double jointDampingRatio = dampingRatio)
{
    BodyParams body;
    body.jointStiffness = jointStiffness;
    const double reducedMass = body.deviceMass * body.skinMass / (body.deviceMass + body.skinMass);
    body.jointDamping = 2.0 * jointDampingRatio * std::sqrt(jointStiffness * reducedMass);
    return body;
}

/// One way to compute the skin's acceleration, for one chain and rate.
struct Candidate
{
    std::function<void(std::span<const float>, std::span<float>)> process;
    std::function<void()> reset;
    std::function<std::complex<double>(double)> response; ///< at f Hz, latency taken away
    double spectralRadius = 1.0;
    std::size_t latency = 0;
};

Candidate filterCandidate(const BodyModelCoefficients& coefficients, double fs)
{
    BodyFilter filter;
    filter.setCoefficients(coefficients);
    const auto shared = std::make_shared<BodyFilter>(filter);
    return {[shared](std::span<const float> in, std::span<float> out) { shared->process(in, out); },
            [shared] { shared->reset(); },
            [shared, fs](double f)
            {
                const double delay = static_cast<double>(BodyModelCoefficients::latency) / fs;
                return shared->coefficients().response(Hertz(f), fs) *
                       std::polar(1.0, 2.0 * std::numbers::pi * f * delay);
            },
            1.0, BodyModelCoefficients::latency};
}

Candidate integratorCandidate(BodyIntegrator integrator, const BodyChain& chain, double fs)
{
    const auto shared = std::make_shared<BodyIntegration>(integrator, chain, fs);
    return {[shared](std::span<const float> in, std::span<float> out) { shared->process(in, out); },
            [shared] { shared->reset(); }, [shared](double f) { return shared->response(Hertz(f)); },
            shared->spectralRadius(), 0};
}

struct Variant
{
    const char* name;
    Candidate (*make)(const BodyParams& body, double fs);
};

template <BodyIntegrator integrator>
Candidate integrated(const BodyParams& body, double fs)
{
    return integratorCandidate(integrator, makeBodyChain(body, resonance), fs);
}

template <BodyHold hold>
Candidate modes(const BodyParams& body, double fs)
{
    return filterCandidate(designBodyModel(makeBodyChain(body, resonance), BodyPoint::skin, fs, hold), fs);
}

Candidate bodyModel(const BodyParams& body, double fs)
{
    return filterCandidate(designBodyModel(planBody(body, resonance).chain, BodyPoint::skin, fs), fs);
}

constexpr std::array variants = {
    Variant{"body model", bodyModel},
    Variant{"modes and taps", modes<BodyHold::corrected>},
    Variant{"modes, first-order hold", modes<BodyHold::linear>},
    Variant{"matrix exponential", integrated<BodyIntegrator::matrixExponential>},
    Variant{"trapezoidal", integrated<BodyIntegrator::trapezoidal>},
    Variant{"Runge-Kutta 4", integrated<BodyIntegrator::rungeKutta4>},
    Variant{"semi-implicit Euler", integrated<BodyIntegrator::semiImplicitEuler>},
};

/// Unstable, or a relative error above 1 somewhere in 30-1000 Hz, on a grid or where the joint's resonance has its
/// image.
bool breaks(const Variant& variant, double stiffness, double fs)
{
    constexpr int points = 24;
    const BodyParams body = bodyWith(stiffness, lightDampingRatio);
    const Candidate candidate = variant.make(body, fs);
    if (!(candidate.spectralRadius <= 1.0 + 1e-9))
        return true;
    const auto wrong = [&](double f)
    {
        const auto wanted = bodyFrequencyResponse(body, resonance, Hertz(f));
        return !(std::abs(candidate.response(f) - wanted) <= std::abs(wanted));
    };
    const double joint = makeBodyChain(body, resonance).jointFrequency().value;
    const double image = std::abs(joint - fs * std::round(joint / fs));
    if (image >= BodyBand::lowest && image <= BodyBand::highest && wrong(image))
        return true;
    for (int i = 0; i < points; ++i)
        if (wrong(BodyBand::lowest *
                  std::pow(BodyBand::highest / BodyBand::lowest, static_cast<double>(i) / (points - 1))))
            return true;
    return false;
}

/// The least joint stiffness (N/m) from 1e4 to 1e13 at which a variant breaks, to 1 %, if any.
std::optional<double> breakingStiffness(const Variant& variant, double fs)
{
    constexpr double step = 0.01; // decades: the image of a joint crosses the band within 0.036 at 48 kHz
    for (double exponent = 4.0; exponent <= 13.0; exponent += step)
    {
        if (!breaks(variant, std::pow(10.0, exponent), fs))
            continue;
        double low = exponent - step, high = exponent;
        for (int i = 0; i < 4; ++i)
        {
            const double middle = 0.5 * (low + high);
            (breaks(variant, std::pow(10.0, middle), fs) ? high : low) = middle;
        }
        return std::pow(10.0, high);
    }
    return std::nullopt;
}

/// The RMS difference from the continuous response to the input, 30-1000 Hz, in % of the latter's RMS.
double errorShareOf(const Spectrum& input, const Spectrum& output, const BodyParams& body, double fs,
                    std::size_t latency)
{
    double energy = 0.0, difference = 0.0;
    const double binWidth = 0.5 * fs / static_cast<double>(input.size() - 1);
    for (std::size_t b = 0; b < input.size(); ++b)
        if (const double f = binWidth * static_cast<double>(b); f >= BodyBand::lowest && f <= BodyBand::highest)
        {
            const auto wanted = input[b] * bodyFrequencyResponse(body, resonance, Hertz(f));
            const auto found =
                output[b] * std::polar(1.0, 2.0 * std::numbers::pi * f / fs * static_cast<double>(latency));
            energy += std::norm(wanted);
            difference += std::norm(found - wanted);
        }
    return 100.0 * std::sqrt(difference / energy);
}

void measureBody(const BenchSound& sound, const BenchSettings& settings, BenchTable& rows)
{
    const auto mono = sound.beginning(bodyExcerpt);
    for (const int rate : rates)
    {
        const double fs = rate;
        const Resampler<float> resampler(sound.sampleRate, rate);
        std::vector<float> drive(resampler.outputFrames(mono.size()));
        resampler.process(mono, 0, 0, drive);
        drive.resize(nextFastFftSize(drive.size() + static_cast<std::size_t>(silence * fs)));
        const Spectrum input = spectrumOf(drive, drive.size());
        if (std::all_of(drive.begin(), drive.end(), [](float v) { return v == 0.0f; }))
            return;
        for (const Variant& variant : variants)
        {
            const auto breaking = breakingStiffness(variant, fs);
            for (const double stiffness : stiffnesses)
            {
                const BodyParams body = bodyWith(stiffness);
                const Candidate candidate = variant.make(body, fs);
                std::vector<float> felt(drive.size());
                const auto run = timed(settings.repeats,
                                       [&]
                                       {
                                           candidate.reset();
                                           candidate.process(drive, felt);
                                           return felt.back();
                                       });
                const double error = errorShareOf(input, spectrumOf(felt, felt.size()), body, fs, candidate.latency);
                BenchCell shownError, shownBreaking;
                if (error < 1e4) // what is unstable has no error
                    shownError = error;
                if (breaking)
                    shownBreaking = *breaking;
                const double frames = static_cast<double>(drive.size());
                rows.add({sound.name, fmt::format("{} kHz", rate / 1000), fmt::format("{:.0e}", stiffness),
                          variant.name, frames, frames / fs, run.seconds, shownError, shownBreaking});
            }
        }
    }
}
} // namespace

Bench bodyBench()
{
    const auto figure = [](int kilohertz)
    {
        return figureAtRate("Integrators of the body", "integrator", "stiffness", kilohertz);
    };
    return {
        "body",
        "Integrators of the body",
        "Felt acceleration of the L5 voice coil in a wristband (moving mass, device, joint, skin) for each sound as "
        "the drive (first 2 s, resampled), at several stiffnesses of the joint in N/m, its damping ratio 0.02. The "
        "error is the RMS difference from the continuous response over 30-1000 Hz; empty means that the output "
        "has no bounds. breaksAt is the least stiffness from 1e4 to 1e13 N/m at which the integrator is unstable "
        "or its relative error exceeds 1 at some frequency of that range, with a damping ratio of 0.001. The body "
        "model is the modes and taps "
        "with the joint merged where that costs less than -60 dB.",
        columnsOf({"rate", "stiffness", "integrator"},
                  {summed("frames"),
                   summed("duration", "s"),
                   summed("seconds", "s"),
                   {"error", "%"},
                   {"breaksAt", "N/m"},
                   {"time", "ns/frame", Reduction::ratio, "seconds", "frames", 1e9},
                   {"timesRealTime", "", Reduction::ratio, "duration", "seconds"},
                   {"relativeTime", "", Reduction::relative, "time", "rate"}}),
        {figure(8), figure(16), figure(48)},
        {},
        measureBody};
}

} // namespace pacini::cli
