#pragma once

// The quantisation grids of a packed clip for times, levels, frequencies and sharpness.

#include <pacini/clip/Clip.h>
#include <pacini/clip/Curve.h>
#include <pacini/clip/Quantiser.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pacini
{

/// Parameters of packing. The grids of a packed clip: LevelQuantiser and PitchQuantiser of `bits`, times on ticks.
struct PackParams
{
    int bits = 12;                       ///< 4 to 16
    std::uint32_t ticksPerSecond = 1000; ///< 1 to 1 000 000
    bool operator==(const PackParams&) const = default;
};

namespace detail
{

/// The grid of levels of one clip. Silence is code 0, far below the faintest real level: moved up to just below that,
/// steps to and from it cost little.
struct FlooredLevels
{
    const LevelQuantiser& levels;
    std::int64_t silence;
    [[nodiscard]] std::int64_t code(double amplitude) const { return std::max(levels.code(amplitude), silence); }
    [[nodiscard]] double value(std::int64_t code) const { return code <= silence ? 0.0 : levels.value(code); }
};

/// Ticks of a clip and the quantisers of its values.
class ClipGrids
{
public:
    explicit ClipGrids(const PackParams& params)
        : levels(params.bits), pitches(params.bits), sharpnesses(params.bits, 0.0, 1.0), ticks(params.ticksPerSecond)
    {
    }

    /// Clips of that many s have no tick beyond lastTick().
    void setDuration(double seconds)
    {
        last = static_cast<std::int64_t>(std::floor(seconds * static_cast<double>(ticks) + 1e-6));
    }
    [[nodiscard]] std::int64_t lastTick() const noexcept { return last; }

    [[nodiscard]] std::int64_t tickOf(double time) const
    {
        return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::llround(time * static_cast<double>(ticks))), 0,
                                        last);
    }
    [[nodiscard]] double timeOf(std::int64_t tick) const
    {
        return static_cast<double>(tick) / static_cast<double>(ticks);
    }

    static constexpr int phaseBits = 12; ///< steps of a tenth of a degree

    /// Returns the code of a phase of 0 to 1 cycles; both ends have code 0.
    [[nodiscard]] static std::uint64_t phaseCode(double cycles) noexcept
    {
        constexpr std::uint64_t steps = std::uint64_t{1} << phaseBits;
        return static_cast<std::uint64_t>(std::llround(cycles * static_cast<double>(steps))) % steps;
    }
    [[nodiscard]] static double phaseOf(std::uint64_t code) noexcept
    {
        return static_cast<double>(code) / static_cast<double>(std::uint64_t{1} << phaseBits);
    }

    /// Returns the lowest level above silence in a clip's envelope and bands; the highest of the grid if there is none.
    [[nodiscard]] std::int64_t lowestLevel(const Clip& clip) const
    {
        std::int64_t lowest = levels.topCode();
        const auto look = [&](const Curve& curve)
        {
            for (const Breakpoint& point : curve)
                if (const auto code = levels.code(point.value); code > 0)
                    lowest = std::min(lowest, code);
        };
        look(clip.envelope);
        for (const Band& band : clip.bands)
            look(band.amplitude);
        return lowest;
    }

    /// Rounds a valid clip in place, as writing and reading it leave it.
    void round(Clip& clip)
    {
        setDuration(clip.duration);
        const FlooredLevels floored{levels, lowestLevel(clip) - 1};
        roundCurve(clip.envelope, floored);
        for (Band& band : clip.bands)
        {
            roundCurve(band.amplitude, floored);
            roundCurve(band.pitch, pitches);
            band.phase = phaseOf(phaseCode(band.phase));
        }
        roundCurve(clip.centroid, pitches);
        for (NoiseBand& band : clip.noise)
            roundCurve(band.amplitude, levels);
        for (Transient& event : clip.transients)
            event = {timeOf(tickOf(event.time)), levels.value(levels.code(event.amplitude)),
                     sharpnesses.value(sharpnesses.code(event.sharpness))};
        for (Marker& marker : clip.markers)
            marker.time = timeOf(tickOf(marker.time));
    }

    LevelQuantiser levels;
    PitchQuantiser pitches;
    UniformQuantiser sharpnesses;

private:
    template <typename Quantiser>
    void roundCurve(Curve& curve, const Quantiser& quantiser) const
    {
        for (Breakpoint& point : curve)
            point = {timeOf(tickOf(point.time)), quantiser.value(quantiser.code(point.value))};
    }

    std::uint32_t ticks; // per second
    std::int64_t last = 0;
};

} // namespace detail

} // namespace pacini
