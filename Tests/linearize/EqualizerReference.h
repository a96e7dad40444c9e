#pragma once

// Equalizers by the printed formulas, and responses to flatten.

#include <pacini/actuator/Equalizer.h>
#include <pacini/foundation/Random.h>
#include <pacini/linearize/EqualizerFitParams.h>
#include <pacini/linearize/FrequencyResponse.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace pacini::test
{

/// dB of one section at f for the sample rate fs, from the coefficients printed in R. Bristow-Johnson's cookbook.
inline double cookbookLevel(const EqualizerSection& section, double f, double fs)
{
    using Number = long double;
    const Number pi = std::numbers::pi_v<Number>;
    const Number w = 2.0L * pi * static_cast<Number>(section.frequency) / static_cast<Number>(fs);
    const Number q = static_cast<Number>(section.q);
    const Number a = std::pow(10.0L, static_cast<Number>(section.gain) / 40.0L);
    const Number c = std::cos(w), alpha = std::sin(w) / (2.0L * q), root = 2.0L * std::sqrt(a) * alpha;
    Number b0{}, b1{}, b2{}, a0{}, a1{}, a2{};
    switch (section.type)
    {
    case EqualizerType::peak:
        b0 = 1 + alpha * a, b1 = -2 * c, b2 = 1 - alpha * a;
        a0 = 1 + alpha / a, a1 = -2 * c, a2 = 1 - alpha / a;
        break;
    case EqualizerType::lowShelf:
        b0 = a * ((a + 1) - (a - 1) * c + root), b1 = 2 * a * ((a - 1) - (a + 1) * c);
        b2 = a * ((a + 1) - (a - 1) * c - root);
        a0 = (a + 1) + (a - 1) * c + root, a1 = -2 * ((a - 1) + (a + 1) * c), a2 = (a + 1) + (a - 1) * c - root;
        break;
    case EqualizerType::highShelf:
        b0 = a * ((a + 1) + (a - 1) * c + root), b1 = -2 * a * ((a - 1) + (a + 1) * c);
        b2 = a * ((a + 1) + (a - 1) * c - root);
        a0 = (a + 1) - (a - 1) * c + root, a1 = 2 * ((a - 1) - (a + 1) * c), a2 = (a + 1) - (a - 1) * c - root;
        break;
    case EqualizerType::highpass: // second order at q 1/sqrt(2) only
        b0 = (1 + c) / 2, b1 = -(1 + c), b2 = (1 + c) / 2;
        a0 = 1 + alpha, a1 = -2 * c, a2 = 1 - alpha;
        break;
    }
    const std::complex<Number> z = std::polar(1.0L, -2.0L * pi * static_cast<Number>(f) / static_cast<Number>(fs));
    return static_cast<double>(20.0L * std::log10(std::abs((b0 + z * (b1 + z * b2)) / (a0 + z * (a1 + z * a2)))));
}

inline double cookbookLevel(const EqualizerSections& sections, double f, double fs)
{
    double sum = 0.0;
    for (const EqualizerSection& section : sections)
        sum += cookbookLevel(section, f, fs);
    return sum;
}

struct Deviation
{
    double rms = 0.0, max = 0.0, level = 0.0;
};

/// How far response plus equalizer is from its mean.
inline Deviation deviationOf(const FrequencyResponse& response, const EqualizerSections& sections, double fs)
{
    Deviation deviation;
    std::vector<double> sum;
    for (std::size_t i = 0; i < response.size(); ++i)
        sum.push_back(response.level[i] + cookbookLevel(sections, response.frequency[i], fs));
    for (const double v : sum)
        deviation.level += v / static_cast<double>(sum.size());
    for (const double v : sum)
    {
        deviation.rms += (v - deviation.level) * (v - deviation.level) / static_cast<double>(sum.size());
        deviation.max = std::max(deviation.max, std::abs(v - deviation.level));
    }
    deviation.rms = std::sqrt(deviation.rms);
    return deviation;
}

inline std::vector<double> logFrequencies(std::size_t n, double low, double high)
{
    std::vector<double> f;
    for (std::size_t i = 0; i < n; ++i)
        f.push_back(low * std::pow(high / low, static_cast<double>(i) / static_cast<double>(n - 1)));
    return f;
}

/// Acceleration of a mass on a spring driven by a force, dB.
inline double massOnSpring(double f, double resonance, double q)
{
    const std::complex<double> s(0.0, f / resonance);
    return 20.0 * std::log10(std::abs(s * s / (s * s + s / q + 1.0)));
}

/// Any kind of response that measurements give: resonances, notches, tilts, noise, drop-outs, few or many points.
inline FrequencyResponse randomResponse(std::uint64_t seed)
{
    Random random(seed);
    const auto ratio = [&](double low, double high)
    {
        return low * std::pow(high / low, random.uniform());
    };
    const double low = ratio(5.0, 60.0);
    const double high = low * ratio(4.0, 60.0);
    FrequencyResponse response;
    response.frequency = logFrequencies(static_cast<std::size_t>(ratio(8.0, 400.0)), low, high);
    const double resonance = ratio(low, high), q = ratio(0.6, 40.0);
    const double second = ratio(low, high), height = random.uniform(-15.0, 12.0), width = ratio(0.5, 15.0);
    const double tilt = random.uniform(-6.0, 6.0);
    const double noise = random.uniform() < 0.4 ? random.uniform(0.0, 4.0) : 0.0;
    const double dropouts = random.uniform() < 0.3 ? 0.05 : 0.0;
    for (const double f : response.frequency)
    {
        double level = massOnSpring(f, resonance, q) + tilt * std::log2(f / low);
        level += cookbookLevel({EqualizerType::peak, second, height, width}, f, 1e6);
        level += noise * (random.uniform() + random.uniform() + random.uniform() - 1.5) * 2.0;
        if (random.uniform() < dropouts)
            level -= 40.0;
        response.level.push_back(level);
    }
    return response;
}

/// The usual parameters at another sample rate, Hz.
inline EqualizerFitParams fitParamsAt(double fs)
{
    EqualizerFitParams params;
    params.sampleRate = fs;
    return params;
}

} // namespace pacini::test
