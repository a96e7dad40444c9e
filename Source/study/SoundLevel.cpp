#include "study/SoundLevel.h"

#include <pacini/foundation/Fft.h>
#include <pacini/foundation/Units.h>

#if PACINI_HAS_EBUR128
#include <ebur128.h>
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numbers>

namespace pacini::study
{

namespace
{
double levelOfPower(double power)
{
    return power > 0.0 ? Decibels::fromPower(power).value : -std::numeric_limits<double>::infinity();
}

#if PACINI_HAS_EBUR128
struct LoudnessDeleter
{
    void operator()(ebur128_state* state) const noexcept { ebur128_destroy(&state); }
};

std::optional<double> loudnessOf(std::span<const float> sound, int sampleRate)
{
    // Both ears get the same: dual mono, which counts twice.
    const std::unique_ptr<ebur128_state, LoudnessDeleter> state(
        ebur128_init(1, static_cast<unsigned long>(sampleRate), EBUR128_MODE_I));
    double loudness = 0.0;
    if (!state || ebur128_set_channel(state.get(), 0, EBUR128_DUAL_MONO) != EBUR128_SUCCESS ||
        ebur128_add_frames_float(state.get(), sound.data(), sound.size()) != EBUR128_SUCCESS ||
        ebur128_loudness_global(state.get(), &loudness) != EBUR128_SUCCESS || !std::isfinite(loudness))
        return std::nullopt;
    return loudness;
}
#else
std::optional<double> loudnessOf(std::span<const float>, int)
{
    return std::nullopt;
}
#endif
} // namespace

bool knowsLoudness() noexcept
{
    return PACINI_HAS_EBUR128 != 0;
}

double weightingA(double frequency) noexcept
{
    // Poles of IEC 61672-1:2013, annex E.
    constexpr double f1 = 20.598997, f2 = 107.65265, f3 = 737.86223, f4 = 12194.217;
    const auto response = [=](double f)
    {
        const double s = f * f;
        return f4 * f4 * s * s / ((s + f1 * f1) * std::sqrt((s + f2 * f2) * (s + f3 * f3)) * (s + f4 * f4));
    };
    const double gain = response(frequency) / response(1000.0);
    return gain * gain;
}

double weightedLevel(std::span<const float> sound, int sampleRate)
{
    if (sound.empty())
        return -std::numeric_limits<double>::infinity();
    const std::size_t size = std::bit_ceil(std::max<std::size_t>(sound.size(), 16));
    std::vector<double> padded(size, 0.0);
    std::copy(sound.begin(), sound.end(), padded.begin());
    RealFft<double> fft(size);
    std::vector<std::complex<double>> spectrum(fft.bins());
    fft.forward(padded, spectrum);
    double sum = 0.0;
    for (std::size_t k = 1; k < spectrum.size(); ++k)
    {
        const double both = k + 1 == spectrum.size() ? 1.0 : 2.0; // its mirror image, except at the Nyquist frequency
        sum +=
            both * std::norm(spectrum[k]) * weightingA(static_cast<double>(k) * sampleRate / static_cast<double>(size));
    }
    return levelOfPower(sum / static_cast<double>(size) / static_cast<double>(sound.size()));
}

SoundLevels levelsOf(std::span<const float> sound, int sampleRate)
{
    SoundLevels levels;
    double power = 0.0;
    for (const float sample : sound)
    {
        const auto x = static_cast<double>(sample);
        power += x * x;
        levels.clipped = levels.clipped || std::abs(x) > 1.0;
    }
    levels.rms = sound.empty() ? levelOfPower(0.0) : levelOfPower(power / static_cast<double>(sound.size()));
    levels.weighted = weightedLevel(sound, sampleRate);
    levels.loudness = loudnessOf(sound, sampleRate);
    return levels;
}

double heardLevel(const SoundCalibration& calibration, double level) noexcept
{
    return calibration.level + level - calibration.tone;
}

std::vector<float> calibrationTone(const SoundCalibration& calibration, double seconds, int sampleRate)
{
    constexpr double frequency = 1000.0, fade = 0.05; // Hz, s
    const double amplitude = Decibels(calibration.tone).gain() * std::numbers::sqrt2;
    std::vector<float> samples(static_cast<std::size_t>(std::llround(seconds * sampleRate)));
    for (std::size_t n = 0; n < samples.size(); ++n)
    {
        const double t = static_cast<double>(n) / sampleRate;
        const double fades = std::min(1.0, std::min(t, seconds - t) / fade);
        samples[n] = static_cast<float>(amplitude * fades * std::sin(2.0 * std::numbers::pi * frequency * t));
    }
    return samples;
}

} // namespace pacini::study
