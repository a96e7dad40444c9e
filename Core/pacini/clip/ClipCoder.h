#pragma once

// Codec of packed clips: their contents, written and read by one description.

#include <pacini/clip/BandPriority.h>
#include <pacini/clip/BandTiling.h>
#include <pacini/clip/Clip.h>
#include <pacini/clip/ClipGrids.h>
#include <pacini/clip/ClipText.h>
#include <pacini/clip/PackedCurves.h>
#include <pacini/clip/PackedText.h>
#include <pacini/clip/Quantiser.h>
#include <pacini/foundation/SizeInMemory.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cfloat>
#include <climits>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

// Reader and writer start from the same odds, and clips have the same bytes on every machine, only where a double is
// computed as one.
static_assert(FLT_EVAL_METHOD != 1 && FLT_EVAL_METHOD != 2,
              "the compiler keeps more digits than a double has: on 32-bit x86 add -msse2 -mfpmath=sse");

namespace detail
{

/// Codes a whole clip both ways: with a RangeWriter it writes the given clip and frees its curves on the way, since
/// long clips are large; with a RangeReader it fills a clip.
template <typename Coder>
class ClipCoder
{
public:
    /// `inputBytes` limits the sizes that a reader accepts; see leastBytes().
    ClipCoder(Coder& coderToUse, const PackParams& packParams, std::size_t inputBytes = limits::points / pointsPerByte)
        : coder(coderToUse),
          params(packParams),
          grids(params),
          maxPoints(std::min(limits::points, sizeInMemory(std::uint64_t{pointsPerByte} * (inputBytes + 8))))
    {
    }

    /// The least size of a payload with as many points as were coded. Real clips take one to two bytes per point; only
    /// curves that repeat themselves for thousands of points need to be filled up, so that a few damaged bytes cannot
    /// claim a clip that fills the memory.
    [[nodiscard]] std::size_t leastBytes() const noexcept { return points / pointsPerByte; }

    /// Returns false when the input is damaged beyond use.
    bool code(Clip& clip)
    {
        codeDuration(clip);
        if (failed)
            return false;
        codeCurves(clip);
        codeTransients(clip);
        codeNoise(clip);
        codeTexts(clip);
        return !failed;
    }

    /// What version 2 has behind the contents of version 1.
    void codePhases(Clip& clip)
    {
        for (Band& band : clip.bands)
            band.phase = ClipGrids::phaseOf(raw(ClipGrids::phaseCode(band.phase), ClipGrids::phaseBits));
    }

private:
    static constexpr std::size_t pointsPerByte = 64;
    static constexpr bool reading = Coder::reading;

    // ---- numbers

    std::uint64_t number(std::uint64_t value, double typical)
    {
        AdaptiveNumber model(typical);
        return model.code(coder, value);
    }

    std::uint64_t raw(std::uint64_t value, int bits)
    {
        std::uint64_t result = 0;
        for (int i = bits - 1; i >= 0; --i)
            result = (result << 1) | static_cast<std::uint64_t>(coder.bit(((value >> i) & 1u) != 0));
        return result;
    }

    /// A double as a small whole number where it is one, else bit for bit.
    double exact(double value)
    {
        const bool isSmall = value >= 0.0 && value < 1048576.0 && value == std::floor(value) && !std::signbit(value);
        if (coder.bit(isSmall, wholeModel))
            return static_cast<double>(number(isSmall ? static_cast<std::uint64_t>(value) : 0, 1000.0));
        return std::bit_cast<double>(raw(std::bit_cast<std::uint64_t>(value), 64));
    }

    // ---- time

    void codeDuration(Clip& clip)
    {
        clip.source.sampleRate = codeSampleRate(clip.source.sampleRate);
        clip.source.channels = static_cast<int>(std::min<std::uint64_t>(
            number(static_cast<std::uint64_t>(std::max(clip.source.channels, 0)), 1.0), 1u << 30));
        // A whole number of frames of the source, or any number.
        const double fs = clip.source.sampleRate;
        const double frames = std::round(clip.duration * fs);
        const bool whole = fs > 0.0 && frames < 1e12 && frames / fs == clip.duration;
        if (coder.bit(whole, wholeDurationModel))
            clip.duration = static_cast<double>(number(whole ? static_cast<std::uint64_t>(frames) : 0, 100000.0)) / fs;
        else
            clip.duration = std::bit_cast<double>(raw(std::bit_cast<std::uint64_t>(clip.duration), 64));
        if (!std::isfinite(clip.duration) || clip.duration < 0.0 || clip.duration > limits::duration)
        {
            failed = true;
            return;
        }
        grids.setDuration(clip.duration);
    }

    double codeSampleRate(double rate)
    {
        constexpr std::array<double, 8> usual = {0.0, 44100.0, 48000.0, 96000.0, 22050.0, 32000.0, 8000.0, 192000.0};
        const auto found = std::find(usual.begin(), usual.end(), rate);
        if (coder.bit(found != usual.end(), usualRateModel))
            return usual[static_cast<std::size_t>(
                raw(static_cast<std::uint64_t>(found == usual.end() ? 0 : found - usual.begin()), 3))];
        return exact(rate);
    }

    // ---- curves

    template <typename Quantiser>
    GridCurve toGrid(const Curve& curve, const Quantiser& quantiser) const
    {
        GridCurve grid;
        grid.reserve(curve.size());
        for (const Breakpoint& point : curve)
            grid.push_back({grids.tickOf(point.time), quantiser.code(point.value)});
        return grid;
    }

    template <typename Quantiser>
    Curve toCurve(const GridCurve& grid, const Quantiser& quantiser) const
    {
        Curve curve;
        curve.reserve(grid.size());
        for (const GridPoint& point : grid)
            curve.push_back({grids.timeOf(point.tick), quantiser.value(point.code)});
        return curve;
    }

    template <typename Quantiser>
    GridCurve codeCurve(Curve& curve, CurveCoder& kind, const Quantiser& quantiser, const CurveHints& hints)
    {
        const GridCurve wanted = reading ? GridCurve{} : toGrid(curve, quantiser);
        if (failed)
            return {};
        GridCurve grid = kind.code(coder, wanted, grids.lastTick(), hints, maxPoints - points);
        points += grid.size();
        if constexpr (reading)
        {
            if (points >= maxPoints)
                failed = true;
            curve = toCurve(grid, quantiser);
        }
        else
            curve = Curve();
        return grid;
    }

    void codeCurves(Clip& clip)
    {
        const double levelStep = 3.0 / (LevelQuantiser::range / static_cast<double>((1 << params.bits) - 2));
        const double pitchStep = 3.0 * static_cast<double>(1 << params.bits) / 64.0;
        CurveCoder envelopeCoder(3.5, 2.0 * levelStep);
        CurveCoder bandCoder(11.0, 1.3 * levelStep);
        CurveCoder pitchCoder(20.0, pitchStep);
        CurveCoder centroidCoder(20.0, pitchStep);

        codeBandFrequencies(clip.bands);
        if (failed)
            return;
        const FlooredLevels levels{grids.levels, codeFloor(clip)};
        const GridCurve envelope = codeCurve(clip.envelope, envelopeCoder, levels, {});
        GridCurve below;
        std::vector<double> energies;
        for (Band& band : clip.bands)
        {
            below = codeCurve(band.amplitude, bandCoder, levels, {&below, &envelope});
            energies.push_back(curveEnergy(toCurve(below, levels), clip.duration));
        }
        GridCurve pitchBelow;
        for (Band& band : clip.bands)
            pitchBelow = codePitch(band, pitchCoder, pitchBelow);
        codePriorities(clip.bands, prioritiesByEnergy(energies));
        codeCurve(clip.centroid, centroidCoder, grids.pitches, {});
    }

    /// Returns the code of silence: one below the lowest level in the clip's envelope and bands.
    std::int64_t codeFloor(const Clip& clip)
    {
        const std::int64_t lowest = reading ? 1 : grids.lowestLevel(clip);
        return static_cast<std::int64_t>(
            std::min<std::uint64_t>(number(static_cast<std::uint64_t>(lowest - 1), 32.0), 1u << 24));
    }

    /// A band's pitch is coded as its distance from the centre, which the bands have in common more than the pitch
    /// itself.
    GridCurve codePitch(Band& band, CurveCoder& kind, const GridCurve& below)
    {
        struct FromCentre
        {
            const PitchQuantiser& pitches;
            std::int64_t centre;
            [[nodiscard]] std::int64_t code(double hertz) const { return pitches.code(hertz) - centre; }
            [[nodiscard]] double value(std::int64_t code) const { return pitches.value(code + centre); }
        };
        return codeCurve(band.pitch, kind, FromCentre{grids.pitches, grids.pitches.code(band.centreFrequency)},
                         {&below, nullptr});
    }

    void codeBandFrequencies(std::vector<Band>& bands)
    {
        const std::size_t count = sizeInMemory(number(bands.size(), 12.0));
        if (count > limits::bands)
        {
            failed = true;
            return;
        }
        if constexpr (reading)
            bands.resize(count);
        if (bands.empty())
            return;
        for (const BandSpacing spacing : {BandSpacing::logarithmic, BandSpacing::linear})
            if (coder.bit(!reading && isTiled(bands, spacing), tiledModel))
            {
                const double low = exact(bands.front().lowFrequency);
                const double high = exact(bands.back().highFrequency);
                if (!canTile(low, high))
                    failed = true;
                else if (reading)
                    setFrequencies(bands, tiledBands(bands.size(), low, high, spacing));
                return;
            }
        for (Band& band : bands)
        {
            band.lowFrequency = exact(band.lowFrequency);
            band.centreFrequency = exact(band.centreFrequency);
            band.highFrequency = exact(band.highFrequency);
        }
    }

    /// Priorities that rank the bands by energy cost one bit.
    void codePriorities(std::vector<Band>& bands, const std::vector<int>& expected)
    {
        if (bands.empty())
            return;
        bool same = true;
        for (std::size_t k = 0; k < bands.size(); ++k)
            same = same && bands[k].priority == expected[k];
        same = coder.bit(same, rankedModel);
        AdaptiveSignedNumber model(4.0);
        for (std::size_t k = 0; k < bands.size(); ++k)
            bands[k].priority = same ? expected[k]
                                     : static_cast<int>(std::clamp<std::int64_t>(model.code(coder, bands[k].priority),
                                                                                 INT_MIN, INT_MAX));
    }

    // ---- events

    void codeTransients(Clip& clip)
    {
        const std::size_t count = std::min(sizeInMemory(number(clip.transients.size(), 4.0)), maxPoints - points);
        AdaptiveNumber gaps(300.0);
        AdaptiveSignedNumber amplitudes(4.0), sharps(4.0);
        std::int64_t tick = 0, level = 0, sharp = 0;
        for (std::size_t i = 0; i < count && !failed; ++i)
        {
            const Transient wanted = reading ? Transient{} : clip.transients[i];
            tick = std::min(grids.lastTick(),
                            tick + static_cast<std::int64_t>(
                                       gaps.code(coder, static_cast<std::uint64_t>(grids.tickOf(wanted.time) - tick))));
            level = code(amplitudes, level, grids.levels.code(wanted.amplitude), std::int64_t{1} << 24);
            sharp = code(sharps, sharp, grids.sharpnesses.code(wanted.sharpness), (std::int64_t{1} << params.bits) - 1);
            if constexpr (reading)
                clip.transients.push_back(
                    {grids.timeOf(tick), grids.levels.value(level), grids.sharpnesses.value(sharp)});
        }
        points += count;
    }

    std::int64_t code(AdaptiveSignedNumber& model, std::int64_t before, std::int64_t wanted, std::int64_t top)
    {
        return std::clamp<std::int64_t>(before + model.code(coder, wanted - before), 0, top);
    }

    void codeNoise(Clip& clip)
    {
        const std::size_t count = sizeInMemory(number(clip.noise.size(), 0.1));
        if (count > limits::bands)
            failed = true;
        if (failed)
            return;
        if constexpr (reading)
            clip.noise.resize(count);
        CurveCoder kind(20.0, 4.0);
        GridCurve below;
        for (NoiseBand& band : clip.noise)
        {
            band.lowFrequency = exact(band.lowFrequency);
            band.highFrequency = exact(band.highFrequency);
            below = codeCurve(band.amplitude, kind, grids.levels, {&below, nullptr});
        }
    }

    // ---- texts

    void codeTexts(Clip& clip)
    {
        ClipTexts<Coder> texts(coder);
        texts.codeClip(clip);
        const std::size_t count = std::min(sizeInMemory(number(clip.markers.size(), 0.1)), maxPoints - points);
        AdaptiveNumber gaps(300.0);
        std::int64_t tick = 0;
        for (std::size_t i = 0; i < count; ++i)
        {
            const Marker wanted = reading ? Marker{} : clip.markers[i];
            tick = std::min(grids.lastTick(),
                            tick + static_cast<std::int64_t>(
                                       gaps.code(coder, static_cast<std::uint64_t>(grids.tickOf(wanted.time) - tick))));
            Marker marker{grids.timeOf(tick), texts.code(wanted.name)};
            if constexpr (reading)
                clip.markers.push_back(std::move(marker));
        }
        points += count;
    }

    Coder& coder;
    PackParams params;
    ClipGrids grids;
    std::size_t maxPoints;
    std::size_t points = 0;
    bool failed = false;
    AdaptiveBit wholeModel{0.8, 2}, wholeDurationModel{0.9, 2}, usualRateModel{0.9, 2}, tiledModel{0.9, 2},
        rankedModel{0.9, 2};
};

} // namespace detail

} // namespace pacini
