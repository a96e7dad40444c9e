#pragma once

// Simulated measuring rig: actuator on a body, accelerometer, converters with clocks of their own.

#include <pacini/actuator/BodyModel.h>
#include <pacini/foundation/Gaussian.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// Parameters of the simulated rig. Like the thesis' L5 wristband with an ADXL325 on its case.
struct RigParams
{
    std::optional<BodyParams> body = BodyParams{1.342, 0.012, 0.04, 40000.0, 5.0, 0.01, 800.0, 2.5}; // none: 1 m/s^2
    Resonance resonance{67.0, 3.97};
    BodyPoint point = BodyPoint::device;
    double contact = 0.0;                           // dB, a loosely worn device
    std::vector<double> polynomial = {0.0, 1.0};    // of the amplifier, from the power 0 on
    double range = 5.0 * standardGravity;           // m/s^2 at a sample of 1
    double noiseDensity = 250e-6 * standardGravity; // m/s^2 per root of Hz
    int bits = 12;                                  // 0: as fine as float
    std::size_t axes = 3;                           // turned at random
    double latency = 0.0123456;                     // s
    double driftPpm = 50.0;                         // of the recorder: more frames
    double tail = 0.5;                              // s that the recording goes on after the playback
    std::uint64_t seed = 1;
    double sampleRate = 48000.0; // Hz
};

namespace detail
{
/// x at the position of `frame` (may be fractional) of an oversampled signal: 32 taps of a sinc under (1 - u^2)^4.
[[nodiscard]] inline double between(const std::vector<double>& x, double frame)
{
    const auto middle = static_cast<std::ptrdiff_t>(std::floor(frame));
    const double fraction = frame - static_cast<double>(middle);
    constexpr std::ptrdiff_t half = 16;
    if (fraction < 1e-12)
        return middle >= 0 && middle < static_cast<std::ptrdiff_t>(x.size()) ? x[static_cast<std::size_t>(middle)]
                                                                             : 0.0;
    const double sine = std::sin(std::numbers::pi * fraction) / std::numbers::pi;
    double sum = 0.0;
    for (std::ptrdiff_t k = 1 - half; k <= half; ++k)
    {
        const std::ptrdiff_t i = middle + k;
        if (i < 0 || i >= static_cast<std::ptrdiff_t>(x.size()))
            continue;
        const double distance = fraction - static_cast<double>(k);
        const double u = distance / half;
        const double w = 1.0 - u * u;
        sum += x[static_cast<std::size_t>(i)] * (k % 2 == 0 ? sine : -sine) / distance * w * w * w * w;
    }
    return sum;
}

/// A unit vector drawn at random, for the mounting of the sensor.
[[nodiscard]] inline std::array<double, 3> randomDirection(std::uint64_t seed)
{
    Gaussian gaussian(seed);
    std::array<double, 3> v{gaussian.next(), gaussian.next(), gaussian.next()};
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (double& x : v)
        x /= length;
    return v;
}
} // namespace detail

/// Returns the simulated recording of `drive`, both at params.sampleRate, with one channel for each axis.
[[nodiscard]] inline std::vector<std::vector<float>> recordOnRig(std::span<const float> drive, const RigParams& params)
{
    std::vector<float> amplified(drive.size());
    for (std::size_t n = 0; n < drive.size(); ++n)
    {
        double sum = 0.0;
        for (std::size_t k = params.polynomial.size(); k-- > 0;)
            sum = sum * static_cast<double>(drive[n]) + params.polynomial[k];
        amplified[n] = static_cast<float>(sum);
    }
    double delay = params.latency * params.sampleRate;
    if (params.body)
    {
        BodyModel model;
        model.setParams({*params.body, params.resonance, params.point, BodyForce::coil, Decibels(-300.0)});
        model.prepare({params.sampleRate, amplified.size()});
        model.process(amplified, amplified);
        delay -= static_cast<double>(model.latencyFrames());
    }
    const std::vector<double> movement(amplified.begin(), amplified.end());
    const double stretch = 1.0 + params.driftPpm * 1e-6;
    const auto frames = static_cast<std::size_t>(
        (static_cast<double>(drive.size()) + delay + params.tail * params.sampleRate) * stretch);
    std::vector<double> recorded(frames);
    const double contact = Decibels(params.contact).gain();
    for (std::size_t n = 0; n < frames; ++n)
        recorded[n] = contact * detail::between(movement, static_cast<double>(n) / stretch - delay);

    auto direction = detail::randomDirection(params.seed);
    if (params.axes == 1)
        direction = {1.0, 0.0, 0.0};
    const auto down = detail::randomDirection(params.seed + 1000);
    const double deviation = params.noiseDensity * std::sqrt(params.sampleRate / 2.0);
    std::vector<std::vector<float>> channels(params.axes, std::vector<float>(frames));
    Gaussian noise(params.seed + 2000);
    const double steps = std::exp2(params.bits - 1);
    for (std::size_t c = 0; c < params.axes; ++c)
        for (std::size_t n = 0; n < frames; ++n)
        {
            const double a =
                direction[c] * recorded[n] + (params.body ? standardGravity * down[c] : 0.0) + deviation * noise.next();
            const double sample = std::clamp(a / params.range, -1.0, 1.0);
            channels[c][n] = static_cast<float>(params.bits > 0 ? std::round(sample * steps) / steps : sample);
        }
    return channels;
}

/// The level, dB re 1 m/s^2 at a drive of 1, that the rig's body has by its equations of motion.
[[nodiscard]] inline double rigLevel(const RigParams& params, double f)
{
    return params.contact +
           Decibels::fromGain(std::abs(bodyFrequencyResponse(*params.body, params.resonance, Hertz(f), params.point)))
               .value;
}

} // namespace pacini
