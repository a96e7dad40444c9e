#pragma once

// Player of a texture by speed and force, for as long as wanted.

#include <pacini/filters/PolyphaseInterpolator.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Portable.h>
#include <pacini/foundation/Powers.h>
#include <pacini/texture/AutoRegression.h>
#include <pacini/texture/TextureTable.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Noise of a texture's spectrum and level, with its tones. It never repeats: the random numbers come back after 2^64
/// frames. The same table, seed and course of speed and force give the same output, however that is cut into calls.
///
/// Noise is made at 2400 Hz or a little more and interpolated. Speed and force are read at every fourth of its frames
/// (1.7 ms); the level glides on until the next, the spectrum changes at once, which a lattice bears. A change is heard
/// within that time and latencyFrames(). Tones keep their phases to each other: each follows the way, which is the
/// integral of the speed.
class TexturePlayer
{
public:
    /// `shared` is not null. Allocates.
    explicit TexturePlayer(std::shared_ptr<const TextureTable> shared, std::uint64_t seed = 1)
        : table(std::move(shared)),
          noise(seed),
          interpolator(table->ratio(), table->highest() / table->innerRate()),
          toneLevels(table->allTones().size(), 0.0),
          hop(hopFrames * table->ratio())
    {
        reset();
    }

    /// Begins again at speed 0, with force 1. [audio]
    void reset() noexcept
    {
        speed = 0.0;
        setForce(1.0);
        level = 0.0;
        place = {};
        way = 0.0;
        setRoles(1.0, 1.0);
        std::fill(toneLevels.begin(), toneLevels.end(), 0.0);
        noise.reset();
        readReflections();
        interpolator.reset();
        taken = hop.size();
    }

    /// 0 to 1, from the next frames on; others are limited to this, NaN is 0. At speed 0 there is silence. [audio]
    void setSpeed(double wanted) noexcept { speed = clampTo(wanted, 0.0, 1.0); }

    /// The same of the force, 1 unless it is set.
    void setForce(double wanted) noexcept
    {
        std::array<double, 1> gain{clampTo(wanted, 0.0, 1.0)};
        if (gain[0] > 0.0)
            raiseAll(gain, table->levelByForce());
        forceGain = gain[0];
    }

    /// Linear levels of noise and tones, 0 or more, 1 unless they are set. [audio]
    void setRoles(double ofNoise, double ofTones) noexcept
    {
        noiseGain = ofNoise;
        toneGain = ofTones;
    }

    /// Frames that are made already, in which nothing that is set is heard yet; at 0 the next call reads it. [audio]
    [[nodiscard]] std::size_t framesMade() const noexcept { return hop.size() - taken; }

    /// Frames that are made at a time.
    [[nodiscard]] std::size_t hopLength() const noexcept { return hop.size(); }

    /// Delay of the interpolator.
    [[nodiscard]] std::size_t latencyFrames() const noexcept { return interpolator.latencyFrames(); }

    /// Writes the next frames: 1 is full drive; beyond that nothing is limited here. [audio]
    void process(std::span<float> out) noexcept
    {
        while (!out.empty())
        {
            if (taken == hop.size())
                makeHop();
            const std::size_t count = std::min(out.size(), hop.size() - taken);
            std::copy_n(hop.begin() + static_cast<std::ptrdiff_t>(taken), count, out.begin());
            taken += count;
            out = out.subspan(count);
        }
    }

private:
    static constexpr std::size_t hopFrames = 4; ///< of noise

    void readReflections() noexcept
    {
        std::array<double, limits::textureOrder> reflection{};
        noise.setReflections(table->reflectionsAt(place, reflection));
    }

    void makeHop() noexcept
    {
        if (const auto wanted = TextureTable::placeOf(speed); wanted != place)
        {
            place = wanted;
            readReflections();
        }
        const double goal = table->level(place) * forceGain * noiseGain;
        std::array<float, hopFrames> inner{};
        if (level > 0.0 || goal > 0.0)
            for (std::size_t n = 0; n < hopFrames; ++n)
            {
                const double share = static_cast<double>(n + 1) / static_cast<double>(hopFrames);
                inner[n] = toSample((level + (goal - level) * share) * noise.next());
            }
        level = goal;
        addTones(inner);
        interpolator.process(inner, hop);
        taken = 0;
    }

    /// Adds this hop of the tones; their levels glide like that of the noise.
    void addTones(std::span<float> inner) noexcept
    {
        const auto tones = table->allTones();
        if (tones.empty())
            return;
        const double step = speed / table->innerRate();
        for (std::size_t k = 0; k < tones.size(); ++k)
        {
            const double wanted = std::numbers::sqrt2 * table->toneLevel(k, place) * forceGain * toneGain;
            const double before = std::exchange(toneLevels[k], wanted);
            if (!(before > 0.0 || wanted > 0.0))
                continue;
            const double cycles = tones[k].frequency * way + tones[k].phase;
            auto now = portable::turnBy(cycles);
            const auto next = portable::turnBy(tones[k].frequency * step);
            for (std::size_t n = 0; n < inner.size(); ++n)
            {
                const double share = static_cast<double>(n + 1) / static_cast<double>(inner.size());
                inner[n] += toSample((before + (wanted - before) * share) * now.imag());
                now = {now.real() * next.real() - now.imag() * next.imag(),
                       now.real() * next.imag() + now.imag() * next.real()};
            }
        }
        way += step * static_cast<double>(inner.size());
    }

    std::shared_ptr<const TextureTable> table;
    LatticeNoise noise;
    PolyphaseInterpolator interpolator;
    std::vector<double> toneLevels; ///< amplitudes at the end of the last hop
    double speed = 0.0, forceGain = 1.0, noiseGain = 1.0, toneGain = 1.0;
    double way = 0.0;   ///< integral of the speed, s
    double level = 0.0; ///< at the end of the last hop
    TextureTable::Place place;
    std::vector<float> hop; ///< output of the last one
    std::size_t taken = 0;
};

} // namespace pacini
