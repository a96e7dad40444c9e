#pragma once

// Multi-resolution spectrogram of a sound, filled tile by tile.

#include "document/view/SpectrumAnalyzer.h"
#include "document/view/TimeAxis.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Filled piece by piece by the caller: first a column for every 20 ms of the whole sound, from which the coarser
/// levels are made, then finer columns of the visible part, only some of which are kept. Missing columns are replaced
/// by the next coarser level, else by silence. Not for two threads at once.
class Spectrogram
{
public:
    static constexpr double baseHop = 0.02;         ///< s between columns
    static constexpr int finest = 4;                ///< every finer level halves that: 1.25 ms
    static constexpr std::size_t tileColumns = 128; ///< computed at a time
    static constexpr std::size_t maxFineTiles = 192;

    /// 128 columns from time index * 128 * hop on; `level` 0 to `finest`.
    struct Tile
    {
        int level = 0;
        std::int64_t index = 0;
        auto operator<=>(const Tile&) const = default; // NOLINT(modernize-use-nullptr): its 0 is not a pointer

        [[nodiscard]] double hop() const noexcept { return std::ldexp(baseHop, -level); }
        [[nodiscard]] TimeRange range() const noexcept
        {
            const double length = hop() * static_cast<double>(tileColumns);
            return {length * static_cast<double>(index), length * static_cast<double>(index + 1)};
        }
    };

    Spectrogram(double duration, const SpectrumRows& wanted) : rows(wanted.count)
    {
        const auto columns = static_cast<std::size_t>(std::max(1.0, std::ceil(duration / baseHop)));
        baseTiles.assign((columns + tileColumns - 1) / tileColumns, false);
        for (std::size_t n = columns;; n = (n + 1) / 2)
        {
            levels.emplace_back(n * rows, std::uint8_t(0));
            if (n == 1)
                break;
        }
    }

    /// The columns of a tile, one after another. [worker]
    [[nodiscard]] static std::vector<std::uint8_t> compute(SpectrumAnalyzer& analyser, const Tile& tile,
                                                           std::size_t rows)
    {
        std::vector<std::uint8_t> result(tileColumns * rows);
        for (std::size_t i = 0; i < tileColumns; ++i)
            analyser.column(tile.range().from + tile.hop() * (static_cast<double>(i) + 0.5),
                            std::span(result).subspan(i * rows, rows));
        return result;
    }

    void put(const Tile& tile, std::vector<std::uint8_t> columns)
    {
        if (tile.level > 0)
        {
            if (fine.insert_or_assign(tile, std::move(columns)).second)
                order.push_back(tile);
            if (order.size() > maxFineTiles)
            {
                fine.erase(order.front());
                order.pop_front();
            }
            return;
        }
        const auto index = static_cast<std::size_t>(tile.index);
        if (tile.index < 0 || index >= baseTiles.size())
            return;
        baseTiles[index] = true;
        std::size_t from = index * tileColumns;
        std::size_t to = std::min(from + tileColumns, count(0));
        std::copy_n(columns.begin(), (to - from) * rows, levels[0].begin() + static_cast<std::ptrdiff_t>(from * rows));
        for (std::size_t level = 1; level < levels.size(); ++level)
        {
            from /= 2;
            to = (to + 1) / 2;
            for (std::size_t i = from; i < to; ++i)
                for (std::size_t k = 0; k < rows; ++k)
                {
                    const std::uint8_t a = levels[level - 1][2 * i * rows + k];
                    const bool two = 2 * i + 1 < count(level - 1);
                    const std::uint8_t b = two ? levels[level - 1][(2 * i + 1) * rows + k] : a;
                    levels[level][i * rows + k] = std::max(a, b);
                }
        }
    }

    /// What a view needs most, if anything is missing: the base of what is visible, then fine tiles of it, then the
    /// base of all the rest.
    [[nodiscard]] std::optional<Tile> nextMissing(const TimeAxis& axis, double width) const
    {
        const TimeRange shown = axis.visible(width);
        const int level = levelFor(axis.secondsPerPixel);
        for (const int wanted : {0, level})
        {
            const double length = Tile{wanted, 0}.range().to;
            const auto last = static_cast<std::int64_t>(std::floor(std::min(shown.to, duration()) / length));
            for (auto i = static_cast<std::int64_t>(std::floor(std::max(0.0, shown.from) / length)); i <= last; ++i)
                if (!has({wanted, i}) && static_cast<double>(i) * length < duration())
                    return Tile{wanted, i};
        }
        const auto found = std::find(baseTiles.begin(), baseTiles.end(), false);
        if (found == baseTiles.end())
            return std::nullopt;
        return Tile{0, found - baseTiles.begin()};
    }

    /// The levels of the stretch [from, to) of time, which has the width of a pixel: the most of each row.
    void column(double from, double to, std::span<std::uint8_t> out) const
    {
        const double width = to - from;
        if (width < baseHop)
            return fineColumn(0.5 * (from + to), levelFor(width), out);
        const auto level = std::min(levels.size() - 1, static_cast<std::size_t>(std::log2(width / baseHop)));
        const double hop = std::ldexp(baseHop, static_cast<int>(level));
        const auto most = static_cast<std::int64_t>(count(level));
        const auto first = static_cast<std::int64_t>(std::floor(from / hop));
        const auto last = std::max(first + 1, static_cast<std::int64_t>(std::floor(to / hop)));
        std::fill(out.begin(), out.end(), std::uint8_t(0));
        for (std::int64_t i = std::max<std::int64_t>(first, 0); i < std::min(last, most); ++i)
        {
            const auto* source = levels[level].data() + static_cast<std::size_t>(i) * rows;
            for (std::size_t k = 0; k < rows; ++k)
                out[k] = std::max(out[k], source[k]);
        }
    }

private:
    [[nodiscard]] std::size_t count(std::size_t level) const { return levels[level].size() / rows; }
    [[nodiscard]] double duration() const { return baseHop * static_cast<double>(count(0)); }

    [[nodiscard]] bool has(const Tile& tile) const
    {
        if (tile.level > 0)
            return fine.contains(tile);
        return tile.index < 0 || static_cast<std::size_t>(tile.index) >= baseTiles.size() ||
               baseTiles[static_cast<std::size_t>(tile.index)];
    }

    [[nodiscard]] static int levelFor(double secondsPerPixel)
    {
        return std::clamp(static_cast<int>(std::ceil(std::log2(baseHop / secondsPerPixel))), 0, finest);
    }

    /// Between the two columns that are nearest to a time, of the finest level up to `level` that is there.
    void fineColumn(double time, int level, std::span<std::uint8_t> out) const
    {
        for (int now = level; now >= 0; --now)
        {
            const double place = time / Tile{now, 0}.hop() - 0.5;
            const auto before = static_cast<std::int64_t>(std::floor(place));
            const std::uint8_t* a = columnAt(now, before);
            const std::uint8_t* b = columnAt(now, before + 1);
            if (a == nullptr && b == nullptr)
                continue;
            a = a != nullptr ? a : b;
            b = b != nullptr ? b : a;
            const auto part = static_cast<int>(std::lround(256.0 * (place - static_cast<double>(before))));
            for (std::size_t k = 0; k < rows; ++k)
                out[k] = static_cast<std::uint8_t>((a[k] * (256 - part) + b[k] * part) / 256);
            return;
        }
        std::fill(out.begin(), out.end(), std::uint8_t(0));
    }

    [[nodiscard]] const std::uint8_t* columnAt(int level, std::int64_t index) const
    {
        if (index < 0)
            return nullptr;
        if (level == 0)
            return static_cast<std::size_t>(index) < count(0)
                       ? levels[0].data() + static_cast<std::size_t>(index) * rows
                       : nullptr;
        constexpr auto wide = static_cast<std::int64_t>(tileColumns);
        const auto found = fine.find({level, index / wide});
        return found != fine.end() ? found->second.data() + static_cast<std::size_t>(index % wide) * rows : nullptr;
    }

    std::size_t rows;
    std::vector<std::vector<std::uint8_t>> levels; ///< column after column; each level half as many as the one before
    std::vector<bool> baseTiles;                   ///< which are there
    std::map<Tile, std::vector<std::uint8_t>> fine;
    std::deque<Tile> order; ///< of fine tiles, the oldest first
};

} // namespace pacini
