#pragma once

// Predictive entropy coding of the curves of a clip.

#include <pacini/clip/AdaptiveNumber.h>
#include <pacini/clip/GridCurve.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace pacini
{

/// Coding context of a curve: curves already coded that help to predict it; either may be missing.
struct CurveHints
{
    const GridCurve* neighbour = nullptr; ///< the same kind of curve of the band below
    const GridCurve* total = nullptr;     ///< the clip's envelope
};

/// Codes curves of one kind one after another and learns from each for the next.
///
/// Times: whether a point stands at a tick is one decision per tick, whose odds depend on how long ago the last point
/// was and on whether the curves of the hints have a point there (attacks hit all bands at once). Values: a value is
/// coded as its difference from a prediction, which moves with the neighbour and the envelope and returns to the usual
/// distance from them (weights by least squares over envelopes of recorded sounds); the spread to expect follows the
/// differences so far. Everything is computed in whole numbers.
class CurveCoder
{
public:
    /// `pointEvery` is the number of ticks between points, `step` the difference of values to expect at first.
    CurveCoder(double pointEvery, double step)
        : strideModel(8.0),
          firstTickModel(1.0),
          countModel(8.0),
          farModel(32.0),
          firstModel(6.0 * step),
          spread(static_cast<std::int64_t>(step * unit))
    {
        for (std::size_t age = 0; age < ages; ++age)
            for (std::size_t neighbour = 0; neighbour < 3; ++neighbour)
                for (std::size_t total = 0; total < 3; ++total)
                {
                    const double pull = (neighbour == 2   ? 3.5
                                         : neighbour == 1 ? 1.3
                                                          : 0.6) *
                                        (total == 2   ? 1.6
                                         : total == 1 ? 1.0
                                                      : 0.7);
                    const double young = age == 0 ? 0.6 : 1.0;
                    here[age][neighbour][total] = AdaptiveBit(std::min(0.9, pull * young / pointEvery), 5);
                }
        // Each power of 1.5 is exact, as no library's std::pow need be: reader and writer must agree to the last bit.
        double power = 1.0;
        for (AdaptiveSignedNumber& model : differences)
        {
            model = AdaptiveSignedNumber(0.85 * power);
            power *= 1.5;
        }
    }

    /// Writes `curve`, or ignores it and reads it; ticks are not decreasing and lie in 0..lastTick. When reading, a
    /// damaged input can give nonsense but never a tick outside the range, nor more than `most` points.
    template <typename Coder>
    GridCurve code(Coder& coder, const GridCurve& curve, std::int64_t lastTick, const CurveHints& hints,
                   std::size_t most)
    {
        GridCurve result;
        if (coder.bit(curve.empty(), emptyModel) || most == 0)
            return result;
        if (coder.bit(curve.size() == 1 && curve.front().tick == 0, singleModel))
        {
            const std::int64_t wanted = curve.empty() ? 0 : curve.front().code;
            result.push_back({0, inRange(lastFirst + firstModel.code(coder, wanted - lastFirst))});
            lastFirst = result.front().code;
            return result;
        }

        const std::int64_t stride = codeStride(coder, curve, lastTick);
        const std::int64_t end = lastTick / stride * stride;
        const bool regular = coder.bit(isRegular(curve, end), regularModel);
        const std::uint64_t count = regular ? 0 : std::max<std::uint64_t>(1, countModel.code(coder, curve.size()));

        Hints readers(hints);
        lastResidual = 0;
        result.reserve(curve.size()); // 0 when reading: a count is not believed
        for (std::size_t i = 0; result.size() < most && (regular ? i == 0 || result.back().tick < end : i < count); ++i)
        {
            const GridPoint wanted = Coder::reading ? GridPoint{} : curve[i];
            if (i == 0)
            {
                const auto tick =
                    regular
                        ? 0
                        : std::min(end,
                                   toTick(firstTickModel.code(coder, static_cast<std::uint64_t>(wanted.tick / stride)),
                                          stride));
                const std::int64_t expected =
                    hints.total != nullptr && !hints.total->empty() ? hints.total->front().code : lastFirst;
                result.push_back({tick, inRange(expected + firstModel.code(coder, wanted.code - expected))});
                continue;
            }
            const GridPoint before = result.back();
            const std::int64_t tick =
                regular ? codeTick(coder, wanted.tick, before.tick, stride, end, readers)
                        : std::min(end,
                                   before.tick + toTick(farModel.code(coder, static_cast<std::uint64_t>(
                                                                                 (wanted.tick - before.tick) / stride)),
                                                        stride));
            result.push_back({tick, codeValue(coder, wanted.code, before, tick, i == 1, readers)});
        }
        lastFirst = result.front().code;
        return result;
    }

private:
    static constexpr std::size_t ages = 10;
    static constexpr std::size_t spreads = 12;
    static constexpr std::int64_t farSteps = 64; // longer gaps are coded as a number
    static constexpr std::int64_t unit = 256;    // of `spread`

    /// Times and values are read at different moments, so each needs its own place in the curves.
    struct Hints
    {
        explicit Hints(const CurveHints& hints)
            : neighbour(hints.neighbour), total(hints.total), neighbourTicks(hints.neighbour), totalTicks(hints.total)
        {
        }
        GridCurveReader neighbour, total, neighbourTicks, totalTicks;
    };

    /// Codes beyond any grid come only from damaged input: kept small, so that no sum can overflow.
    static std::int64_t inRange(std::int64_t code) { return std::clamp<std::int64_t>(code, -(1 << 24), 1 << 24); }

    static std::int64_t toTick(std::uint64_t steps, std::int64_t stride)
    {
        constexpr std::uint64_t most = std::uint64_t{1} << 38;
        return static_cast<std::int64_t>(std::min(steps, most / static_cast<std::uint64_t>(stride))) * stride;
    }

    /// A curve that starts at tick 0, rises strictly and ends on the last grid tick needs no count.
    static bool isRegular(const GridCurve& curve, std::int64_t end)
    {
        const auto notRising = [](const GridPoint& a, const GridPoint& b)
        {
            return b.tick <= a.tick;
        };
        return curve.size() >= 2 && curve.front().tick == 0 && curve.back().tick == end &&
               std::adjacent_find(curve.begin(), curve.end(), notRising) == curve.end();
    }

    template <typename Coder>
    std::int64_t codeStride(Coder& coder, const GridCurve& curve, std::int64_t lastTick)
    {
        const std::int64_t stride = tickStride(curve);
        if (lastStride > 0 && coder.bit(stride % lastStride == 0, sameStrideModel))
            return lastStride;
        const auto coded = toTick(strideModel.code(coder, static_cast<std::uint64_t>(stride)), 1);
        lastStride = std::clamp<std::int64_t>(coded, 1, std::max<std::int64_t>(lastTick, 1));
        return lastStride;
    }

    template <typename Coder>
    std::int64_t codeTick(Coder& coder, std::int64_t wanted, std::int64_t before, std::int64_t stride, std::int64_t end,
                          Hints& hints)
    {
        std::int64_t tick = before + stride;
        for (std::int64_t waited = 1; tick < end; ++waited, tick += stride)
        {
            if (waited > farSteps)
                return std::min(
                    end,
                    tick + toTick(farModel.code(coder, static_cast<std::uint64_t>((wanted - tick) / stride)), stride));
            auto& model = here[ageOf(waited)][hints.neighbourTicks.nearness(tick, stride)]
                              [hints.totalTicks.nearness(tick, stride / 2)];
            if (coder.bit(tick == wanted, model))
                return tick;
        }
        return end; // nothing is left to decide
    }

    static std::size_t ageOf(std::int64_t waited)
    {
        constexpr std::array<std::int64_t, ages - 1> upTo = {1, 2, 3, 4, 6, 9, 13, 20, 32};
        return static_cast<std::size_t>(std::lower_bound(upTo.begin(), upTo.end(), waited) - upTo.begin());
    }

    template <typename Coder>
    std::int64_t codeValue(Coder& coder, std::int64_t wanted, const GridPoint& before, std::int64_t tick, bool first,
                           Hints& hints)
    {
        // Both readers move forward: the earlier tick comes first. Distances in sixteenths of a code.
        const std::int64_t neighbourThen = hints.neighbour.at(before.tick, before.code);
        const std::int64_t totalThen = hints.total.at(before.tick, before.code);
        const std::int64_t neighbourRise = 16 * (hints.neighbour.at(tick, neighbourThen) - neighbourThen);
        const std::int64_t totalRise = 16 * (hints.total.at(tick, totalThen) - totalThen);
        const std::int64_t overNeighbour = 16 * (before.code - neighbourThen);
        const std::int64_t overTotal = 16 * (before.code - totalThen);
        usualOverNeighbour = first ? overNeighbour : usualOverNeighbour + (overNeighbour - usualOverNeighbour) * 3 / 16;
        usualOverTotal = first ? overTotal : usualOverTotal + (overTotal - usualOverTotal) * 3 / 16;
        const std::int64_t expected =
            before.code + (8 * neighbourRise + 6 * totalRise + 8 * (usualOverNeighbour - overNeighbour) +
                           3 * (usualOverTotal - overTotal)) /
                              256;

        auto& sign = negative[lastResidual < 0 ? 0 : lastResidual == 0 ? 1 : 2];
        lastResidual = differences[spreadClass()].code(coder, wanted - expected, sign);
        spread += (std::min<std::int64_t>(std::abs(lastResidual), 1 << 24) * unit - spread) / 8;
        return inRange(expected + lastResidual);
    }

    /// Each class expects differences half as large again as the one before.
    [[nodiscard]] std::size_t spreadClass() const
    {
        std::size_t k = 0;
        for (std::int64_t v = spread; v > unit && k + 1 < spreads; v = v * 2 / 3)
            ++k;
        return k;
    }

    AdaptiveBit emptyModel{0.1, 2};
    AdaptiveBit singleModel{0.2, 2};
    AdaptiveBit regularModel{0.95, 4};
    AdaptiveBit sameStrideModel{0.9, 4};
    AdaptiveNumber strideModel, firstTickModel, countModel, farModel;
    AdaptiveSignedNumber firstModel;
    std::array<std::array<std::array<AdaptiveBit, 3>, 3>, ages> here;
    std::array<AdaptiveSignedNumber, spreads> differences;
    std::array<AdaptiveBit, 3> negative{AdaptiveBit(0.7, 4), AdaptiveBit(0.5, 4), AdaptiveBit(0.3, 4)};
    std::int64_t spread;
    std::int64_t usualOverNeighbour = 0;
    std::int64_t usualOverTotal = 0;
    std::int64_t lastStride = 0;
    std::int64_t lastFirst = 0;
    std::int64_t lastResidual = 0;
};

} // namespace pacini
