#pragma once

// The translation "hapticgen": the level of the sound on one sine that rises with it.

#include <pacini/analysis/methods/MethodSound.h>
#include <pacini/foundation/DspBlock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

/// The amplitude of a sine whose mean power is that of the sound over 10 ms, interpolated in straight lines, times 1.2
/// at most where the loudest leaves room for it; its frequency is 200 Hz and rises by 1 Hz for each .01 of amplitude
/// above .3 (Y. Sung, K. John, S. H. Yoon and H. Seifi, "HapticGen: Generative Text-to-Vibration Model for Streamlining
/// Haptic Design", CHI 2025). The sound's peak is scaled to full scale before. As long as the input; fs is 8000 to
/// 768000 Hz; NaN and infinities count as 0.
[[nodiscard]] inline std::vector<float> hapticGen(std::span<const float> mono, double fs)
{
    std::vector<float> sound(mono.begin(), mono.end());
    std::vector<float> out(mono.size(), 0.0f);
    if (!(normalise(sound) > 0.0))
        return out;
    const auto parts = std::max<std::size_t>(1, sound.size() / static_cast<std::size_t>(0.010 * fs));
    std::vector<double> amplitudes;
    double loudest = 0.0;
    for (std::size_t i = 0; i < parts; ++i)
    {
        const std::size_t first = i * sound.size() / parts;
        const std::size_t end = (i + 1) * sound.size() / parts;
        double sum = 0.0;
        for (std::size_t n = first; n < end; ++n)
            sum += static_cast<double>(sound[n]) * static_cast<double>(sound[n]);
        amplitudes.push_back(std::sqrt(2.0 * sum / static_cast<double>(end - first)));
        loudest = std::max(loudest, amplitudes.back());
    }
    const double gain = std::clamp(1.0 / loudest, 1.0, 1.2);
    const double partsPerFrame = static_cast<double>(parts) / static_cast<double>(sound.size());
    double phase = 0.0;
    for (std::size_t n = 0; n < out.size(); ++n)
    {
        const double at = static_cast<double>(n) * partsPerFrame;
        const auto i = std::min(parts - 1, static_cast<std::size_t>(at));
        const double next = amplitudes[std::min(parts - 1, i + 1)];
        const double amplitude = gain * std::lerp(amplitudes[i], next, at - static_cast<double>(i));
        phase = std::fmod(phase + 2.0 * std::numbers::pi * (200.0 + 100.0 * (amplitude - 0.3)) / fs,
                          2.0 * std::numbers::pi);
        out[n] = toSample(amplitude * std::sin(phase));
    }
    return out;
}

} // namespace pacini
