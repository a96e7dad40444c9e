#pragma once

// A straightforward encoder of WaveletWave blocks, the decoder's counterpart: forward transform by the analysis
// filters, significance of whole trees by looking at them, an arithmetic coder that holds bits back.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace pacini::test
{

/// Writes bits with probabilities that follow what was written (Witten, Neal and Cleary 1987), as Base64 digits.
class HjifBitWriter
{
public:
    void write(int context, int bit)
    {
        auto& [zeros, total] = counts.try_emplace(context, 8, 16).first->second;
        const int chance = static_cast<int>(std::floor(1024.0 * zeros / total + 0.5));
        const int range = high - low;
        const int split = low + std::max(1, std::min(range * chance / 1024, range - 1));
        (bit == 0 ? high : low) = split;
        zeros += 1 - bit;
        total += 1;
        for (;;)
        {
            if (high <= 512)
                emit(0);
            else if (low >= 512)
            {
                emit(1);
                low -= 512;
                high -= 512;
            }
            else if (low >= 256 && high <= 768)
            {
                ++held;
                low -= 256;
                high -= 256;
            }
            else
                return;
            low *= 2;
            high *= 2;
        }
    }

    /// Enough bits to tell the last interval from others, whatever zeros follow.
    std::string finish()
    {
        ++held;
        emit(low < 256 ? 0 : 1);
        std::string text;
        static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        for (std::size_t i = 0; i < bits.size(); i += 6)
        {
            std::size_t digit = 0;
            for (std::size_t k = 0; k < 6; ++k)
                digit = 2 * digit + (i + k < bits.size() && bits[i + k] ? 1u : 0u);
            text += digits[digit];
        }
        return text;
    }

private:
    void emit(int bit)
    {
        bits.push_back(bit == 1);
        bits.insert(bits.end(), static_cast<std::size_t>(held), bit == 0);
        held = 0;
    }

    std::map<int, std::pair<int, int>> counts;
    std::vector<bool> bits;
    int low = 0, high = 1024, held = 0;
};

/// The stream of integer coefficients below 2^(planes) in magnitude, whose step is `level` / 128 / 2^(planes - 1), or
/// (1 + level / 8) / 2^(planes - 1) where `aboveOne`.
inline std::string hjifStream(const std::vector<int>& coefficients, int planes, bool aboveOne, int level)
{
    HjifBitWriter out;
    const auto header = [&](int value, int count)
    {
        for (; count-- > 0; value /= 2)
            out.write(0, value % 2);
    };
    header(planes - 1, 4);
    header(aboveOne ? 1 : 0, 1);
    header(level, 7);

    const std::size_t size = coefficients.size();
    // The largest magnitude among the descendants of i from `generation` generations below it on.
    std::function<int(std::size_t, int)> largest = [&](std::size_t i, int generation)
    {
        if (2 * i + 1 >= size)
            return 0;
        int most = std::max(largest(2 * i, generation - 1), largest(2 * i + 1, generation - 1));
        if (generation <= 1)
            most = std::max({most, std::abs(coefficients[2 * i]), std::abs(coefficients[2 * i + 1])});
        return most;
    };
    std::vector<std::size_t> quiet{0, 1, 2, 3, 4, 5, 6, 7}, loud;
    std::vector<std::pair<std::size_t, bool>> trees{
        {4, false}, {5, false}, {6, false}, {7, false}}; // true: no children
    for (int threshold = 1 << (planes - 1); threshold > 0; threshold /= 2)
    {
        const std::size_t before = loud.size();
        const auto tell = [&](int context, std::size_t i, std::vector<std::size_t>& otherwise)
        {
            const bool is = std::abs(coefficients[i]) >= threshold;
            out.write(context, is);
            if (is)
                out.write(1, coefficients[i] > 0);
            (is ? loud : otherwise).push_back(i);
        };
        std::vector<std::size_t> stillQuiet;
        for (const std::size_t i : quiet)
            tell(2, i, stillQuiet);
        quiet = stillQuiet;
        std::vector<std::pair<std::size_t, bool>> stillWhole;
        while (!trees.empty())
        {
            const auto [root, grand] = trees.front();
            trees.erase(trees.begin());
            const bool is = largest(root, grand ? 2 : 1) >= threshold;
            out.write(grand ? 5 : 3, is);
            if (!is)
                stillWhole.emplace_back(root, grand);
            else if (grand)
            {
                trees.emplace_back(2 * root, false);
                trees.emplace_back(2 * root + 1, false);
            }
            else
            {
                tell(4, 2 * root, quiet);
                tell(4, 2 * root + 1, quiet);
                if (4 * root + 3 < size)
                    trees.emplace_back(root, true);
            }
        }
        trees = stillWhole;
        for (std::size_t i = 0; i < before; ++i)
            out.write(6, (std::abs(coefficients[loud[i]]) & threshold) != 0);
    }
    return out.finish();
}

/// The wavelet coefficients of samples, down to four of approximation, by the analysis filters of the 9/7 pair.
inline std::vector<double> hjifCoefficients(std::vector<double> x)
{
    const std::vector<double> low{.852698679009404, .377402855612654, -.110624404418423, -.023849465019380,
                                  .037828455506995};
    const std::vector<double> high{-.788485616405665, .418092273222212, .040689417609559, -.064538882628938};
    for (std::size_t length = x.size(); length >= 8; length /= 2)
    {
        const auto around = [&](std::size_t centre, const std::vector<double>& filter)
        {
            const int last = static_cast<int>(length) - 1;
            double sum = 0.0;
            for (int k = 1 - static_cast<int>(filter.size()); k < static_cast<int>(filter.size()); ++k)
            {
                int i = std::abs(static_cast<int>(centre) + k);
                i = i > last ? 2 * last - i : i;
                sum += filter[static_cast<std::size_t>(std::abs(k))] * x[static_cast<std::size_t>(i)];
            }
            return sum;
        };
        std::vector<double> next;
        for (std::size_t i = 0; i < length; i += 2)
            next.push_back(around(i, low));
        for (std::size_t i = 1; i < length; i += 2)
            next.push_back(around(i, high));
        std::copy(next.begin(), next.end(), x.begin());
    }
    return x;
}

/// Samples as the stream of a block: quantised in `planes` bit planes.
inline std::string hjifBlockOf(const std::vector<double>& samples, int planes)
{
    const std::vector<double> coefficients = hjifCoefficients(samples);
    double most = 0.0;
    for (const double c : coefficients)
        most = std::max(most, std::abs(c));
    const bool aboveOne = most >= 127.0 / 128.0;
    const int level = static_cast<int>(aboveOne ? std::ceil(8.0 * (most - 1.0)) + 1 : std::ceil(128.0 * most) + 1);
    const int clamped = std::clamp(level, 1, 127);
    const double step = (aboveOne ? 1.0 + clamped / 8.0 : clamped / 128.0) / (1 << (planes - 1));
    std::vector<int> integers;
    for (const double c : coefficients)
        integers.push_back(static_cast<int>(std::lround(c / step)));
    return hjifStream(integers, planes, aboveOne, clamped);
}

} // namespace pacini::test
