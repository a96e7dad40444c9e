#pragma once

// Table of a texture over speed: levels and reflection coefficients at the rate at which its player makes noise.

#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Portable.h>
#include <pacini/texture/AutoRegression.h>
#include <pacini/texture/Texture.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// The spectrum that a texture has at one speed once has at `ratio` times this speed: moved by ratio^pitch, by four
/// octaves at most.
[[nodiscard]] inline double textureShift(double ratio, double pitch) noexcept
{
    return std::clamp(portable::pow(ratio, pitch), 1.0 / 16.0, 16.0);
}

/// Level and spectrum of a texture at any speed above 0. Between two nodes both are interpolated over the logarithm of
/// the speed, the spectra after they have moved to this speed; beyond them the nearest node moves and its level follows
/// the texture's power law.
class TextureLaw
{
public:
    /// For a valid texture.
    explicit TextureLaw(const Texture& textureToFollow) : texture(textureToFollow)
    {
        for (const TextureNode& node : texture.nodes)
            spectra.push_back(spectrumOf(node.reflection, bins, textureRate));
    }

    /// RMS between 20 and 1000 Hz at force 1.
    [[nodiscard]] double level(double speed) const noexcept
    {
        const Neighbours at = neighbours(speed);
        const double between = portable::pow(texture.nodes[at.lower].level, 1.0 - at.share) *
                               portable::pow(texture.nodes[at.upper].level, at.share);
        if (at.lower != at.upper)
            return between;
        return between * portable::pow(speed / texture.nodes[at.lower].speed, texture.levelBySpeed);
    }

    /// RMS of a tone at force 1, wherever its frequency is. Between two nodes on a straight line over the logarithm of
    /// the speed, as it may be 0 at one of them.
    [[nodiscard]] double toneLevel(std::size_t tone, double speed) const noexcept
    {
        const Neighbours at = neighbours(speed);
        const auto& levels = texture.tones[tone].levels;
        const double between = levels[at.lower] + (levels[at.upper] - levels[at.lower]) * at.share;
        if (at.lower != at.upper)
            return between;
        return between * portable::pow(speed / texture.nodes[at.lower].speed, texture.levelBySpeed);
    }

    /// Relative, up to 1200 Hz.
    [[nodiscard]] PowerSpectrum spectrum(double speed) const
    {
        const Neighbours at = neighbours(speed);
        PowerSpectrum sum{0.5 * textureRate / static_cast<double>(bins), std::vector<double>(bins + 1, 0.0)};
        add(at.lower, speed, 1.0 - at.share, sum);
        add(at.upper, speed, at.share, sum);
        return sum;
    }

private:
    static constexpr std::size_t bins = 600; ///< of 2 Hz

    struct Neighbours
    {
        std::size_t lower = 0, upper = 0; ///< the same one beyond all nodes
        double share = 0.0;               ///< of the upper one
    };

    [[nodiscard]] Neighbours neighbours(double speed) const noexcept
    {
        const auto& nodes = texture.nodes;
        const auto above = std::upper_bound(nodes.begin(), nodes.end(), speed,
                                            [](double s, const TextureNode& node) { return s < node.speed; });
        const auto upper = static_cast<std::size_t>(above - nodes.begin());
        if (upper == 0)
            return {};
        if (upper == nodes.size())
            return {upper - 1, upper - 1, 0.0};
        const double low = nodes[upper - 1].speed;
        return {upper - 1, upper, portable::log(speed / low) / portable::log(nodes[upper].speed / low)};
    }

    /// Adds `share` of the spectrum of a node, moved to `speed`.
    void add(std::size_t node, double speed, double share, PowerSpectrum& sum) const
    {
        if (share == 0.0)
            return;
        const double shift = textureShift(speed / texture.nodes[node].speed, texture.pitch);
        PowerSpectrum moved = sum;
        for (std::size_t bin = 0; bin < moved.power.size(); ++bin)
            moved.power[bin] = spectra[node].at(moved.frequency(bin) / shift);
        const double scale = share / moved.sum(textureLow, textureHigh);
        for (std::size_t bin = 0; bin < moved.power.size(); ++bin)
            sum.power[bin] += scale * moved.power[bin];
    }

    Texture texture;
    std::vector<PowerSpectrum> spectra; ///< of the nodes
};

/// What a player reads: 129 speeds, dense enough that it can go on straight lines between them. Immutable: players can
/// share it.
class TextureTable
{
public:
    /// For a valid texture and a playable rate. Allocates, and takes some 15 ms. [worker]
    TextureTable(const Texture& texture, double sampleRate)
        : fs(sampleRate),
          factor(static_cast<std::size_t>(std::max(1.0, std::floor(sampleRate / textureRate)))),
          order(std::max_element(texture.nodes.begin(), texture.nodes.end(),
                                 [](const TextureNode& a, const TextureNode& b)
                                 { return a.reflection.size() < b.reflection.size(); })
                    ->reflection.size()),
          forceExponent(texture.levelByForce)
    {
        assert(validate(texture).ok() && isPlayableRate(sampleRate));
        const TextureLaw law(texture);
        for (const TextureTone& tone : texture.tones)
            tones.push_back({tone.frequency, tone.phase});
        for (std::size_t i = 0; i <= steps; ++i)
        {
            const double root = static_cast<double>(std::max<std::size_t>(i, 1)) / static_cast<double>(steps);
            const PowerSpectrum spectrum = law.spectrum(root * root);
            const auto lags = autocorrelationOf(spectrum, order, innerRate());
            const auto reflection = reflectionsOf(lags);
            reflections.insert(reflections.end(), reflection.begin(), reflection.end());
            // The lattice's whole power is 1, that between 20 and 1000 Hz is to be the level's.
            const double share = spectrum.sum(textureLow, textureHigh) / (spectrum.step * lags[0]);
            levels.push_back(i == 0 ? 0.0 : law.level(root * root) / std::sqrt(std::max(share, 1e-2)));
            for (std::size_t k = 0; k < tones.size(); ++k)
                toneLevels.push_back(
                    i == 0 ? 0.0 : law.toneLevel(k, root * root) * audible(tones[k].frequency * root * root));
        }
    }

    /// Place of a speed in the table.
    struct Place
    {
        std::size_t entry = 0;
        double share = 0.0; ///< of the entry above
        bool operator==(const Place&) const = default;
    };

    /// 0 to 1; NaN is 0. Entries stand at equal distances of the root of the speed, so that they are close together in
    /// octaves at all but the lowest speeds, and a root is the same on every machine. [audio]
    [[nodiscard]] static Place placeOf(double speed) noexcept
    {
        const double place = std::sqrt(clampTo(speed, 0.0, 1.0)) * static_cast<double>(steps);
        const auto entry = std::min(static_cast<std::size_t>(place), steps - 1);
        return {entry, place - static_cast<double>(entry)};
    }

    /// The RMS of noise of variance 1 at force 1; 0 at speed 0. [audio]
    [[nodiscard]] double level(const Place& place) const noexcept
    {
        return levels[place.entry] + (levels[place.entry + 1] - levels[place.entry]) * place.share;
    }

    /// Fills the first coefficients of `reflection` and returns them. Each lies between those of two stable models, so
    /// that it is one of a stable model. [audio]
    std::span<const double> reflectionsAt(const Place& place, std::span<double> reflection) const noexcept
    {
        const double* lower = reflections.data() + place.entry * order;
        for (std::size_t m = 0; m < order; ++m)
            reflection[m] = lower[m] + (lower[m + order] - lower[m]) * place.share;
        return reflection.first(order);
    }

    /// A tone that follows the speed.
    struct Tone
    {
        double frequency = 0.0; ///< Hz at speed 1
        double phase = 0.0;     ///< cycles
    };

    [[nodiscard]] std::span<const Tone> allTones() const noexcept { return tones; }

    /// The RMS of a tone at force 1; 0 where its frequency is beyond 1000 Hz. [audio]
    [[nodiscard]] double toneLevel(std::size_t tone, const Place& place) const noexcept
    {
        const double* lower = toneLevels.data() + place.entry * tones.size() + tone;
        return lower[0] + (lower[tones.size()] - lower[0]) * place.share;
    }

    /// The RMS of all tones together.
    [[nodiscard]] double tonesLevel(const Place& place) const noexcept
    {
        double square = 0.0;
        for (std::size_t k = 0; k < tones.size(); ++k)
            square += toneLevel(k, place) * toneLevel(k, place);
        return std::sqrt(square);
    }

    /// The highest frequency of noise and tones, Hz.
    [[nodiscard]] double highest() const noexcept { return std::min(textureHigh, 0.42 * innerRate()); }

    /// Exponent of the level over force.
    [[nodiscard]] double levelByForce() const noexcept { return forceExponent; }

    [[nodiscard]] double sampleRate() const noexcept { return fs; }

    /// Output frames for each frame of noise.
    [[nodiscard]] std::size_t ratio() const noexcept { return factor; }

    /// Hz of the noise: from 2400 on, below that the output's.
    [[nodiscard]] double innerRate() const noexcept { return fs / static_cast<double>(factor); }

private:
    static constexpr std::size_t steps = 128;

    /// Tones end at the highest frequency within a tenth of it.
    [[nodiscard]] double audible(double frequency) const noexcept
    {
        return std::clamp((1.1 * highest() - frequency) / (0.1 * highest()), 0.0, 1.0);
    }

    double fs;
    std::size_t factor;
    std::size_t order;
    double forceExponent;
    std::vector<double> levels;
    std::vector<double> reflections; ///< [entry][order]
    std::vector<Tone> tones;
    std::vector<double> toneLevels; ///< [entry][tone]
};

} // namespace pacini
