#pragma once

// Sliding segment errors: squared errors of all segments that end at one sample, for a window of starts that slides
// along the curve.

#include <pacini/simplify/DenseSamples.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pacini
{

/// Weighted squared vertical error of the segment from any recent start to the newest sample, O(1) each, eight at once.
///
/// With u = x_j - x and y = v - v_j taken from the segment's end j, the line to start i is y = s u, s = y_i / u_i, and
///     error(i, j) = sum w (y - s u)^2 = Syy - s (2 Suy - s Suu),   sums over i < m <= j,
/// and the sums are differences of prefix sums, shifted to j's origin (the usual "sum of squares by prefix sums" form,
/// e.g. Bellman, "On the approximation of curves by line segments using dynamic programming", 1961, in O(1) per cost).
/// Prefix sums over a whole recording would cancel: here they start anew, relative to a nearby sample, whenever
/// the window has moved by its own length. So no sum is ever longer than two windows, however long the curve is.
///
/// Evenly spaced samples without weights (`Even`) have closed forms for the sums of u, and 1/u from a table.
/// Loops have a fixed length of `block` and no branches, so that compilers vectorise them.
template <bool Even, Samples S = DenseSamples>
class SegmentCost
{
public:
    static constexpr std::size_t block = 8;
    static constexpr double unreachable = 1e300; ///< cost of a start that does not exist

    /// Allocates for segments of at least `longest` samples (1 or more).
    explicit SegmentCost(std::size_t longest)
    {
        window = (longest + block - 1) / block * block;
        history = window + block;
        capacity = history + std::max<std::size_t>(window, 128);
        for (auto* column : {&value, &sumY2, &sumXY2, &sumYY, &cost})
            column->resize(capacity);
        if constexpr (!Even)
            for (auto* column : {&position, &sumW, &sumWX, &sumWXX})
                column->resize(capacity);
        lowest.resize(capacity / block);
        blockLowest.resize(capacity / block);
        if constexpr (Even)
            makeLagTables();
    }

    /// Starts on a new curve; the first advance() moves to its first sample. `samples` must outlive the use.
    void begin(const S& samples) noexcept
    {
        curve = samples;
        const std::size_t n = curve.size();
        const double duration = n > 0 ? curve.time(n - 1) - curve.time(0) : 0.0;
        scale = duration > 0.0 ? static_cast<double>(n - 1) / duration : 1.0;
        std::fill(cost.begin(), cost.end(), unreachable);
        std::fill(blockLowest.begin(), blockLowest.end(), unreachable);
        count = 0;
        local = capacity;
    }

    /// Moves on to the next sample.
    void advance() noexcept
    {
        if (local + 1 >= capacity)
            startAnew();
        else
            ++local;
        append(local, count);
        ++count;
    }

    /// Sets the cost of reaching the newest sample, for segments that start there later.
    void setCost(double costOfNewest) noexcept
    {
        cost[local] = costOfNewest;
        if (local % block == block - 1)
            updateLowest();
    }

    /// The cost set for the start that is `lag` samples before the newest, lag <= span().
    [[nodiscard]] double costAt(std::size_t lag) const noexcept { return cost[local - lag]; }

    /// Segments of up to this many samples can be asked for.
    [[nodiscard]] std::size_t span() const noexcept { return window; }

    /// to[k] = cost of start + error(start, newest) for the `block` starts from newest - lag on, start = newest - lag +
    /// k, block < lag <= span() + block. `to` has `block` elements. Starts before the first sample give `unreachable`.
    void costsVia(std::size_t lag, double* __restrict to) const noexcept
    {
        const std::size_t first = local - lag;
        const double v = value[local];
        const double* const y = &value[first];
        const double* const y2 = &sumY2[first];
        const double* const xy2 = &sumXY2[first];
        const double* const yy = &sumYY[first];
        const double* const before = &cost[first];
        if constexpr (Even)
        {
            const double x = place(local);
            const double yyEnd = sumYY[local] - v * sumY2[local];
            const double uyEnd = x * sumY2[local] - sumXY2[local];
            const double vv = v * v;
            const std::size_t row = longestLag - lag;
            const double* const u = &lagValue[row];
            const double* const uInverse = &lagInverse[row];
            const double* const u2 = &lagSum2[row];
            const double* const uu = &lagSquares[row];
            for (std::size_t k = 0; k < block; ++k)
            {
                const double syy = yyEnd - (yy[k] - v * y2[k]) + vv * u[k];
                const double suy2 = uyEnd - (x * y2[k] - xy2[k]) - v * u2[k];
                const double s = (y[k] - v) * uInverse[k];
                to[k] = before[k] + (syy - s * (suy2 - s * uu[k]));
            }
        }
        else
        {
            const double x = position[local];
            const double w = sumW[local];
            const double wx = sumWX[local];
            const double wxx = sumWXX[local];
            const double yEnd2 = sumY2[local];
            const double xyEnd2 = sumXY2[local];
            const double yyEnd = sumYY[local];
            const double* const px = &position[first];
            const double* const pw = &sumW[first];
            const double* const pwx = &sumWX[first];
            const double* const pwxx = &sumWXX[first];
            for (std::size_t k = 0; k < block; ++k)
            {
                const double dw = w - pw[k];
                const double dwx = wx - pwx[k];
                const double dy2 = yEnd2 - y2[k];
                const double syy = (yyEnd - yy[k]) - v * (dy2 - v * dw);
                const double suy2 = x * dy2 - (xyEnd2 - xy2[k]) - 2.0 * v * (x * dw - dwx);
                const double suu = x * (x * dw - 2.0 * dwx) + (wxx - pwxx[k]);
                const double u = x - px[k];
                const double s = (y[k] - v) / (u > tiny ? u : unreachable);
                to[k] = before[k] + (syy - s * (suy2 - s * suu));
            }
        }
    }

    /// A lower bound of cost + error over all starts in the window that are more than `lag` samples old, lag as above:
    /// every such line passes through the newest sample, so its error over the last `lag` samples is at least that of
    /// the best line through it, Syy - Suy^2 / Suu; and it costs at least the lowest cost among those starts.
    [[nodiscard]] double lowerBound(std::size_t lag) const noexcept
    {
        const std::size_t start = local - lag;
        if (start == 0)
            return unreachable;
        const double v = value[local];
        const double x = place(local);
        const double dy2 = sumY2[local] - sumY2[start];
        double dw = 0.0;
        double du = 0.0;
        double suuInverse = 0.0;
        if constexpr (Even)
        {
            dw = static_cast<double>(lag);
            du = 0.5 * lagSum2[longestLag - lag];
            suuInverse = lagSquaresInverse[longestLag - lag];
        }
        else
        {
            dw = sumW[local] - sumW[start];
            du = x * dw - (sumWX[local] - sumWX[start]);
            const double suu = x * (2.0 * du - x * dw) + (sumWXX[local] - sumWXX[start]);
            if (suu <= tiny * dw)
                return lowest[(start - 1) / block];
            suuInverse = 1.0 / suu;
        }
        const double syy = (sumYY[local] - sumYY[start]) - v * (dy2 - v * dw);
        const double suy = 0.5 * (x * dy2 - (sumXY2[local] - sumXY2[start])) - v * du;
        const double residual = syy - suy * suy * suuInverse;
        return lowest[(start - 1) / block] + std::max(0.0, residual);
    }

private:
    static constexpr double tiny = 1e-9; ///< of the mean spacing: closer samples are one vertical step

    [[nodiscard]] double place(std::size_t at) const noexcept
    {
        if constexpr (Even)
            return static_cast<double>(at) - static_cast<double>(history);
        else
            return position[at];
    }

    void makeLagTables()
    {
        // Stored by falling lag, so that starts and tables run the same way.
        longestLag = history;
        for (auto* table : {&lagValue, &lagInverse, &lagSum2, &lagSquares, &lagSquaresInverse})
            table->resize(longestLag);
        for (std::size_t lag = 1; lag <= longestLag; ++lag)
        {
            const auto d = static_cast<double>(lag);
            const std::size_t row = longestLag - lag;
            lagValue[row] = d;
            lagInverse[row] = 1.0 / d;
            lagSum2[row] = d * (d - 1.0);                            // 2 (0 + 1 + ... + d-1)
            lagSquares[row] = (d - 1.0) * d * (2.0 * d - 1.0) / 6.0; // 0 + 1 + 4 + ... + (d-1)^2
            lagSquaresInverse[row] = lag > 1 ? 1.0 / lagSquares[row] : 0.0;
        }
    }

    /// Moves the last `history` starts to the front and recomputes the sums around the last sample.
    void startAnew() noexcept
    {
        const std::size_t moved = capacity - history;
        std::copy(cost.begin() + static_cast<std::ptrdiff_t>(moved), cost.end(), cost.begin());
        std::copy(blockLowest.begin() + static_cast<std::ptrdiff_t>(moved / block), blockLowest.end(),
                  blockLowest.begin());
        originValue = curve.value(count > 0 ? count - 1 : 0);
        originTime = curve.time(count > 0 ? count - 1 : 0);
        for (std::size_t k = 0; k < history; ++k)
        {
            if (count + k >= history)
                append(k, count + k - history);
            else
                clear(k);
        }
        local = history - 1;
        updateLowest();
        ++local;
    }

    void clear(std::size_t at) noexcept
    {
        for (auto* column : {&value, &sumY2, &sumXY2, &sumYY})
            (*column)[at] = 0.0;
        if constexpr (!Even)
            for (auto* column : {&position, &sumW, &sumWX, &sumWXX})
                (*column)[at] = 0.0;
    }

    void append(std::size_t at, std::size_t sample) noexcept
    {
        const double y = curve.value(sample) - originValue;
        const auto before = [at](const std::vector<double>& sums)
        {
            return at > 0 ? sums[at - 1] : 0.0;
        };
        value[at] = y;
        double w = 1.0;
        double x = 0.0;
        if constexpr (Even)
        {
            x = place(at);
        }
        else
        {
            w = curve.weight(sample);
            x = (curve.time(sample) - originTime) * scale;
            position[at] = x;
            sumW[at] = before(sumW) + w;
            sumWX[at] = before(sumWX) + w * x;
            sumWXX[at] = before(sumWXX) + w * x * x;
        }
        sumY2[at] = before(sumY2) + 2.0 * w * y;
        sumXY2[at] = before(sumXY2) + 2.0 * w * x * y;
        sumYY[at] = before(sumYY) + w * y * y;
    }

    /// lowest[b] = the lowest cost among the window's starts up to the end of block b.
    void updateLowest() noexcept
    {
        const std::size_t end = local / block + 1;
        const std::size_t begin = local >= history ? (local - history) / block : 0;
        blockLowest[end - 1] = *std::min_element(&cost[local + 1 - block], &cost[local] + 1);
        double least = unreachable;
        for (std::size_t b = begin; b < end; ++b)
        {
            least = std::min(least, blockLowest[b]);
            lowest[b] = least;
        }
    }

    S curve;
    std::size_t window = 0;   ///< longest segment, a multiple of the block
    std::size_t history = 0;  ///< starts kept when sums are recomputed
    std::size_t capacity = 0; ///< length of the columns
    std::size_t local = 0;    ///< column of the newest sample
    std::size_t count = 0;    ///< samples seen
    std::size_t longestLag = 0;
    double originValue = 0.0;
    double originTime = 0.0;
    double scale = 1.0; ///< times to units of the mean spacing
    std::vector<double> value, position, cost;
    std::vector<double> sumY2, sumXY2, sumYY; ///< 2 sum w y, 2 sum w x y, sum w y^2
    std::vector<double> sumW, sumWX, sumWXX;
    std::vector<double> lagValue, lagInverse, lagSum2, lagSquares, lagSquaresInverse;
    std::vector<double> blockLowest; ///< lowest cost in each block
    std::vector<double> lowest;      ///< and in all blocks of the window up to it
};

} // namespace pacini
