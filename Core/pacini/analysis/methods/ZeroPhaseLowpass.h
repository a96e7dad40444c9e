#pragma once

// The translation "lowpass": the part of the sound that skin can feel, unchanged.

#include <pacini/filters/Butterworth.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

/// Parameters of "lowpass".
struct ZeroPhaseLowpassParams
{
    Hertz frequency{1000.0}; ///< -6 dB, clamped to 1 Hz to 0.4999 of the sample rate
    int order = 4;           ///< of the filter that runs twice, clamped to 1-16
    bool operator==(const ZeroPhaseLowpassParams&) const = default;
};

/// The signal through a Butterworth low-pass once forward and once backward: its squared magnitude as gain, no phase
/// (F. Gustafsson, "Determining the initial states in forward-backward filtering", IEEE TSP 44 (1996), has the
/// history). Outside its length the signal counts as silence: what rings out at the end comes back with the second
/// pass, so the result does not depend on the direction. As long as the input; fs in Hz; NaN and infinities count as 0.
[[nodiscard]] inline std::vector<float> zeroPhaseLowpass(std::span<const float> mono, double fs,
                                                         const ZeroPhaseLowpassParams& params = {})
{
    if (mono.empty())
        return {};
    const int order = clampTo(params.order, 1, maxButterworthOrder);
    const double frequency = clampTo(params.frequency.value, 1.0, 0.4999 * fs);
    // The slowest pole pair decays with exp(-2 pi f sin(pi / (2 order)) t); to 1e-10, and a little for rates so low
    // that the bilinear transform has moved the poles.
    const double slowest = 2.0 * std::numbers::pi * frequency * std::sin(std::numbers::pi / (2.0 * order));
    const auto tail = static_cast<std::size_t>(std::ceil(std::log(1e10) / slowest * fs)) + 64;

    std::vector<float> signal(mono.size() + tail, 0.0f);
    std::copy(mono.begin(), mono.end(), signal.begin());
    Butterworth filter;
    filter.setParams({ButterworthType::lowpass, order, Hertz(frequency), {}});
    for (int pass = 0; pass < 2; ++pass)
    {
        filter.prepare({fs, signal.size()});
        filter.process(signal, signal);
        std::reverse(signal.begin(), signal.end());
    }
    signal.resize(mono.size());
    return signal;
}

} // namespace pacini
