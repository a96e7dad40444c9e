#pragma once

// Carrier synthesis of the translator: bands played as sinusoids, as many at a time as the actuator has voices.

#include <pacini/realtime/CarrierVoice.h>
#include <pacini/realtime/TranslatorDesign.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>

namespace pacini
{

/// Carrier synthesis of all bands. Turns bands into sinusoids at their pitch, transposed and moved into the actuator's
/// range. Bands that nobody wants cost nothing.
///
/// - Neighbours of one pitch (within 15 %: a tone between two centres) become one sinusoid, the stronger one, of the
///   sum of both amplitudes, since the slopes of two bands meet in phase.
/// - Bands that the actuator's range brings to one frequency (within 15 %) become one sinusoid too, of the sum of their
///   powers: they are strangers to each other, and two sinusoids of one frequency would be as loud as their phases
///   happen to be.
/// - A band that hears what lies in the range that is played directly leaves it to that: its sinusoid would add to the
///   tone itself, as strongly as their phases happen to agree.
/// - A band that plays its own signal in part keeps its sinusoid in step with that: the two are one tone.
/// - Without a voice of its own a band lends its power to the nearest that has one. Voices go to those that were the
///   strongest over the last 20 ms.
/// - A sinusoid that becomes another band's goes on: it changes its pitch, but neither its phase nor its level.
/// - Beside the direct path an event begins sinusoids again: those that were moved meet other tones of the range, and
///   how loud both are together would depend on where playback began.
class CarrierSection
{
public:
    /// Takes a design, which must outlive this. Silence follows.
    void adopt(const TranslatorDesign& wanted) noexcept
    {
        design = &wanted;
        listeners = wanted.listeners;
        wide = wanted.wide;
        standingShare = hopShare(0.020, wanted.innerRate);
        const auto tangentOf = [&wanted](double hertz)
        {
            return std::tan(std::numbers::pi * clampedFrequency(Hertz(hertz), wanted.innerRate) / wanted.innerRate);
        };
        for (std::size_t k = 0; k < wanted.bands.size(); ++k)
            edges[k] = {tangentOf(wanted.bands[k].low.value), tangentOf(wanted.bands[k].high.value)};
        directEdges = {tangentOf(wanted.directLow), tangentOf(wanted.directHigh)};
        reset();
    }

    void reset() noexcept
    {
        standingPowers = {};
        for (CarrierOscillator& oscillator : oscillators)
            oscillator.reset();
        listening = {}; // whoever listens next is reset by aim()
        any = levelling = false;
    }

    /// At the start of a hop: `gains` for each band, the ratio of transposition, the shares of the way that amplitudes
    /// go up and down in a hop, and how far (0 to 1) all are brought to the strength of the whole range, and the share
    /// of the direct path.
    void aim(std::span<const double> gains, double transposition, double attack, double release, double level,
             double direct = 0.0) noexcept
    {
        const std::size_t bands = design->bands.size();
        any = false;
        bool anyWanted = false;
        for (std::size_t k = 0; k < bands; ++k)
            anyWanted = anyWanted || gains[k] > 0.0;
        const bool levelled = std::exchange(levelling, level > 0.0 && anyWanted);
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
            if (!design->bands[k].shown)
                amplitudes[k] *= 1.0 - direct * partInDirect(heard.frequency * design->innerRate);
            pitches[k] = heard.frequency;
            masters[k] = k;
            inStep[k] = design->bands[k].shown && direct > 0.0 && direct < 1.0 && transposition == 1.0;
            if (inStep[k])
                phases[k] = std::atan2(heard.sine, heard.cosine) + phaseFromBand(k, heard.frequency);
            if (!oscillators[k].silent())
                continue;
            if (inStep[k])
                oscillators[k].begin(std::sin(phases[k]), std::cos(phases[k]));
            else
                oscillators[k].begin(heard.sine, heard.cosine);
        }
        mergeNeighbours(bands);
        if (levelling)
            levelToWhole(bands, level);
        for (std::size_t k = 0; k < bands; ++k)
            frequencies[k] = played(pitches[k], transposition);
        if (design->frequencies)
        {
            mergePlayed(bands, transposition);
            shareVoices(bands);
            handOver(bands);
        }
        for (std::size_t k = 0; k < bands; ++k)
        {
            if (!listening[k])
                continue;
            const std::size_t master = masters[k];
            if (master != k && oscillators[k].silent())
                oscillators[k].follow(oscillators[master]);
            const double wanted = amplitudes[k] > 1e-7 ? amplitudes[k] : 0.0;
            double frequency = frequencies[master];
            if (master == k && inStep[k])
                frequency += std::clamp(pull * oscillators[k].behind(phases[k]) / (2.0 * std::numbers::pi * hopFrames),
                                        -0.05 * frequency, 0.05 * frequency);
            oscillators[k].aim(wanted, wanted > oscillators[k].level() ? attack : release, frequency);
        }
    }

    /// Before aim(): see CarrierOscillator. A sinusoid in step with its band's own signal keeps to that.
    void noteEvent(double frames) noexcept
    {
        for (std::size_t k = 0; k < design->bands.size(); ++k)
            if (!inStep[k])
                oscillators[k].noteEvent(frames);
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
    static constexpr double pull = 0.2; // of a phase, in a hop
    static constexpr auto hopFrames = static_cast<double>(controlHop);

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
    void levelToWhole(std::size_t bands, double share) noexcept
    {
        const double whole = std::sqrt(std::max(wide.hear().power, 0.0));
        double sum = 0.0;
        for (std::size_t k = 0; k < bands; ++k)
            sum += plain[k] * plain[k];
        const double scale = sum > 0.0 ? std::min(whole / std::sqrt(sum), largestScale) : 1.0;
        for (std::size_t k = 0; k < bands; ++k)
            amplitudes[k] *= 1.0 + share * (scale - 1.0);
    }

    /// From the phase that a tone of this pitch (cycles per frame) has behind the slopes of band `k`, half a frame
    /// before the newest, to that behind the slopes of the direct path.
    [[nodiscard]] double phaseFromBand(std::size_t k, double pitch) const noexcept
    {
        const double tangent = std::tan(std::numbers::pi * pitch);
        const auto lag =
            [tangent](double edge) // of a Butterworth low-pass of second order; a high-pass leads by pi - lag
        {
            const double x = tangent / edge;
            return std::atan2(std::numbers::sqrt2 * x, 1.0 - x * x);
        };
        return std::numbers::pi * (1.0 + pitch) + 2.0 * (lag(edges[k][0]) + lag(edges[k][1])) - lag(directEdges[0]) -
               lag(directEdges[1]);
    }

    /// Returns the share of a pitch (Hz) that the direct path plays: 1 in its range, 0 from 15 % beyond its ends on.
    [[nodiscard]] double partInDirect(double pitch) const noexcept
    {
        if (!design->anyDirect)
            return 0.0;
        const double beyond = std::max(design->directLow / pitch, pitch / design->directHigh) - 1.0;
        return 1.0 - std::clamp(beyond / samePitch, 0.0, 1.0);
    }

    /// Hands the power of band `k`, and of those that it has taken in, to `other`.
    void lend(std::size_t k, std::size_t other, std::size_t bands) noexcept
    {
        amplitudes[other] = std::hypot(amplitudes[other], std::exchange(amplitudes[k], 0.0));
        standing[other] += standing[k];
        for (std::size_t j = 0; j < bands; ++j)
            if (masters[j] == k)
                masters[j] = other;
    }

    /// Bands that were moved to the frequency of another become one with it.
    void mergePlayed(std::size_t bands, double transposition) noexcept
    {
        std::array<bool, maxTranslatorBands> moved{};
        for (std::size_t k = 0; k < bands; ++k)
        {
            standingPowers[k] += standingShare * (amplitudes[k] * amplitudes[k] - standingPowers[k]);
            flushTiny(standingPowers[k]);
            moved[k] = std::abs(frequencies[k] - pitches[k] * transposition) > 1e-9;
        }
        standing = standingPowers;
        for (std::size_t k = 1; k < bands; ++k)
            for (std::size_t j = 0; j < k && amplitudes[k] > 0.0; ++j)
                if (amplitudes[j] > 0.0 && (moved[j] || moved[k]) &&
                    std::abs(frequencies[k] - frequencies[j]) < samePitch * std::min(frequencies[j], frequencies[k]))
                {
                    const bool upper = standing[k] > standing[j];
                    lend(upper ? j : k, upper ? k : j, bands);
                }
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
                if (amplitudes[k] > 0.0 && !chosen[k] && (best == bands || standing[k] > standing[best]))
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
            lend(k, nearest, bands);
        }
    }

    /// A band that takes over from others continues the loudest of their sinusoids.
    void handOver(std::size_t bands) noexcept
    {
        for (std::size_t k = 0; k < bands; ++k)
        {
            if (masters[k] != k || !(amplitudes[k] > 0.0))
                continue;
            std::size_t loudest = k;
            for (std::size_t j = 0; j < bands; ++j)
                if (masters[j] == k && oscillators[j].level() > oscillators[loudest].level())
                    loudest = j;
            if (loudest != k)
                std::swap(oscillators[k], oscillators[loudest]);
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
    std::array<double, maxTranslatorBands> frequencies{};          // that are played, cycles per frame as the pitches
    std::array<std::array<double, 2>, maxTranslatorBands> edges{}; // tan(w / 2) of low and high
    std::array<double, 2> directEdges{};
    std::array<bool, maxTranslatorBands> inStep{};   // with the direct path
    std::array<double, maxTranslatorBands> phases{}; // that they shall have
    double standingShare = 1.0;
    std::array<double, maxTranslatorBands> standingPowers{}; // over the last 20 ms
    std::array<double, maxTranslatorBands> standing{};       // the same with that of bands taken in
    std::array<std::size_t, maxTranslatorBands> masters{};
    bool any = false;
};

} // namespace pacini
