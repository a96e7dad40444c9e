#pragma once

// Carrier synthesis of the translator: bands played as sinusoids, as many at a time as the actuator has voices.

#include <pacini/realtime/CarrierVoice.h>
#include <pacini/realtime/TranslatorDesign.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace pacini
{

/// Carrier synthesis of all bands. Turns bands into sinusoids at their pitch, transposed and moved into the actuator's
/// range. Bands that nobody wants cost nothing.
///
/// - Neighbours of one pitch (within 15 %: a tone between two centres) become one sinusoid, the stronger one, of the
///   sum of both amplitudes, since the slopes of two bands meet in phase.
/// - Without a voice of its own a band lends its power to the nearest that has one. Voices go to the strongest bands;
///   who sounds keeps its voice until another is 3 dB stronger.
class CarrierSection
{
public:
    /// Of a design, which stays where it is. Silence follows.
    void adopt(const TranslatorDesign& wanted) noexcept
    {
        design = &wanted;
        listeners = wanted.listeners;
        wide = wanted.wide;
        reset();
    }

    void reset() noexcept
    {
        for (CarrierOscillator& oscillator : oscillators)
            oscillator.reset();
        listening = {}; // whoever listens next is reset by aim()
        any = levelling = false;
    }

    /// At the start of a hop: `gains` for each band, the ratio of transposition and the shares of the way that
    /// amplitudes go up and down in a hop.
    void aim(std::span<const double> gains, double transposition, double attack, double release, bool level) noexcept
    {
        const std::size_t bands = design->bands.size();
        any = false;
        bool anyWanted = false;
        for (std::size_t k = 0; k < bands; ++k)
            anyWanted = anyWanted || gains[k] > 0.0;
        const bool levelled = std::exchange(levelling, level && anyWanted);
        if (levelling && !levelled)
            wide.reset();
        for (std::size_t k = 0; k < bands; ++k)
        {
            const bool wanted = gains[k] > 0.0 || levelling;
            if (wanted && !listening[k])
                listeners[k].reset();
            listening[k] = wanted || !oscillators[k].silent();
            any = any || listening[k];
        }
        if (!any)
            return;
        for (std::size_t k = 0; k < bands; ++k)
        {
            amplitudes[k] = plain[k] = 0.0;
            if (!listening[k])
                continue;
            const auto heard = listeners[k].hear();
            plain[k] = std::sqrt(std::max(heard.power, 0.0));
            amplitudes[k] = gains[k] * plain[k];
            pitches[k] = heard.frequency;
            masters[k] = k;
            if (oscillators[k].silent())
                oscillators[k].begin(heard.sine, heard.cosine);
        }
        mergeNeighbours(bands);
        if (levelling)
            levelToWhole(bands);
        shareVoices(bands);
        for (std::size_t k = 0; k < bands; ++k)
        {
            if (!listening[k])
                continue;
            const std::size_t master = masters[k];
            if (master != k && oscillators[k].silent())
                oscillators[k].follow(oscillators[master]);
            const double wanted = amplitudes[k] > 1e-7 ? amplitudes[k] : 0.0;
            oscillators[k].aim(wanted, wanted > oscillators[k].level() ? attack : release,
                               played(pitches[master], transposition));
        }
    }

    /// Frames `at` and on of the hop: listens to `in`, adds to `out`.
    void process(std::span<const double> in, std::span<double> out, std::size_t at) noexcept
    {
        if (!any)
            return;
        if (levelling)
            wide.process(in);
        for (std::size_t k = 0; k < design->bands.size(); ++k)
            if (listening[k])
            {
                listeners[k].process(in);
                if (!oscillators[k].silent())
                    oscillators[k].addTo(out, at);
            }
    }

    void flush() noexcept
    {
        for (std::size_t k = 0; k < listeners.size(); ++k)
            if (listening[k])
                listeners[k].flush();
    }

private:
    static constexpr double samePitch = 0.15;
    static constexpr double keep = 1.41; // in amplitude
    static constexpr double largestScale = 8.0;

    /// The louder of two, where the one that sounds counts for more.
    [[nodiscard]] double claim(std::size_t k) const noexcept
    {
        return amplitudes[k] * (oscillators[k].level() > 0.0 ? keep : 1.0);
    }

    void mergeNeighbours(std::size_t bands) noexcept
    {
        std::size_t below = bands; // the last band that is its own master
        for (std::size_t k = 0; k < bands; ++k)
        {
            if (!(amplitudes[k] > 0.0))
                continue;
            if (below < bands && std::abs(pitches[k] - pitches[below]) < samePitch * pitches[below])
            {
                const double sum = amplitudes[k] + amplitudes[below];
                const bool upper = claim(k) > claim(below);
                const std::size_t master = upper ? k : below;
                const std::size_t slave = upper ? below : k;
                amplitudes[slave] = 0.0;
                amplitudes[master] = sum;
                plain[master] += std::exchange(plain[slave], 0.0);
                for (std::size_t j = 0; j <= k; ++j)
                    if (masters[j] == slave)
                        masters[j] = master;
                below = master;
            }
            else
                below = k;
        }
    }

    /// Narrow bands answer late, each at its own time, and overlap. Their sum is brought to the strength of the whole
    /// range, which answers at once.
    void levelToWhole(std::size_t bands) noexcept
    {
        const double whole = std::sqrt(std::max(wide.hear().power, 0.0));
        double sum = 0.0;
        for (std::size_t k = 0; k < bands; ++k)
            sum += plain[k] * plain[k];
        const double scale = sum > 0.0 ? std::min(whole / std::sqrt(sum), largestScale) : 1.0;
        for (std::size_t k = 0; k < bands; ++k)
            amplitudes[k] *= scale;
    }

    void shareVoices(std::size_t bands) noexcept
    {
        std::array<bool, maxTranslatorBands> chosen{};
        std::size_t sounding = 0;
        for (std::size_t k = 0; k < bands; ++k)
            sounding += amplitudes[k] > 0.0 ? 1u : 0u;
        if (sounding <= design->voices)
            return;
        for (std::size_t voice = 0; voice < design->voices; ++voice)
        {
            std::size_t best = bands;
            for (std::size_t k = 0; k < bands; ++k)
                if (amplitudes[k] > 0.0 && !chosen[k] && (best == bands || claim(k) > claim(best)))
                    best = k;
            chosen[best] = true;
        }
        for (std::size_t k = 0; k < bands; ++k)
        {
            if (chosen[k] || !(amplitudes[k] > 0.0))
                continue;
            std::size_t nearest = bands;
            const auto distance = [&](std::size_t j)
            {
                return std::max(pitches[j] / pitches[k], pitches[k] / pitches[j]);
            };
            for (std::size_t j = 0; j < bands; ++j)
                if (chosen[j] && (nearest == bands || distance(j) < distance(nearest)))
                    nearest = j;
            amplitudes[nearest] = std::hypot(amplitudes[nearest], amplitudes[k]);
            amplitudes[k] = 0.0;
        }
    }

    /// The frequency at which a pitch is played, both cycles per frame.
    [[nodiscard]] double played(double pitch, double transposition) const noexcept
    {
        double hertz = pitch * transposition * design->innerRate;
        if (design->frequencies)
            hertz = (*design->frequencies)(hertz);
        return std::clamp(hertz, design->lowest, design->highest) / design->innerRate;
    }

    const TranslatorDesign* design = nullptr;
    std::array<BandListener, maxTranslatorBands> listeners;
    std::array<CarrierOscillator, maxTranslatorBands> oscillators;
    std::array<bool, maxTranslatorBands> listening{};
    BandListener wide;
    bool levelling = false;
    std::array<double, maxTranslatorBands> amplitudes{};
    std::array<double, maxTranslatorBands> plain{}; // without the gains of the roles
    std::array<double, maxTranslatorBands> pitches{};
    std::array<std::size_t, maxTranslatorBands> masters{};
    bool any = false;
};

} // namespace pacini
