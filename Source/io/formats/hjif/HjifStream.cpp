#include "io/formats/hjif/HjifStream.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace pacini
{

namespace
{
/// Kind of a bit in the stream; each kind has its own statistics.
enum class BitKind
{
    header,
    sign,
    coefficient, ///< of the list of insignificant coefficients
    descendants,
    child,
    grandchildren,
    refinement
};

std::optional<unsigned> sixBits(char c)
{
    const auto from = [c](char first, char last, unsigned value) -> std::optional<unsigned>
    {
        return c >= first && c <= last ? std::optional(static_cast<unsigned>(c - first) + value) : std::nullopt;
    };
    for (const auto bits :
         {from('A', 'Z', 0), from('a', 'z', 26), from('0', '9', 52), from('+', '+', 62), from('/', '/', 63)})
        if (bits)
            return bits;
    return {};
}

class ArithmeticDecoder
{
public:
    explicit ArithmeticDecoder(std::string_view textToRead) : text(textToRead)
    {
        for (int i = 0; i < 10; ++i)
            value = 2 * value + nextBit();
    }

    [[nodiscard]] bool bit(BitKind kind)
    {
        Statistics& seen = statistics[static_cast<std::size_t>(kind)];
        const std::int64_t range = high - low;
        const std::int64_t chance = (2 * whole * seen.zeros + seen.total) / (2 * seen.total); // rounded
        const std::int64_t middle = std::clamp<std::int64_t>(range * chance / whole, 1, range - 1);
        const bool one = value - low >= middle;
        (one ? low : high) = low + middle;
        while (true)
        {
            std::int64_t offset = 0;
            if (low >= whole / 2)
                offset = whole / 2;
            else if (high > whole / 2)
            {
                if (low < whole / 4 || high > 3 * whole / 4)
                    break;
                offset = whole / 4;
            }
            low = 2 * (low - offset);
            high = 2 * (high - offset);
            value = 2 * (value - offset) + nextBit();
        }
        seen.zeros += one ? 0 : 1;
        ++seen.total;
        return one;
    }

    /// A number of `count` bits, the least significant first.
    [[nodiscard]] int number(int count)
    {
        int result = 0;
        for (int i = 0; i < count; ++i)
            result |= bit(BitKind::header) ? 1 << i : 0;
        return result;
    }

private:
    static constexpr std::int64_t whole = 1024;

    struct Statistics
    {
        std::int64_t zeros = 8, total = 16;
    };

    [[nodiscard]] int nextBit()
    {
        const std::size_t place = read / 6;
        const auto shift = static_cast<unsigned>(5 - read % 6);
        ++read;
        return place < text.size() ? static_cast<int>(*sixBits(text[place]) >> shift & 1u) : 0;
    }

    std::string_view text; ///< checked
    std::size_t read = 0;  ///< bits
    std::int64_t low = 0, high = whole, value = 0;
    std::array<Statistics, 7> statistics;
};

/// The coefficients of one block, from the highest bit plane down.
class TreeDecoder
{
public:
    TreeDecoder(ArithmeticDecoder& bitsToRead, std::size_t size) : bits(bitsToRead), coefficients(size)
    {
        for (std::size_t i = 0; i < 8; ++i)
            insignificant.push_back(i);
        for (std::size_t i = 4; i < 8; ++i)
            sets.push_back({i, BitKind::descendants});
    }

    [[nodiscard]] std::vector<int> decode(int highestPlane)
    {
        for (int plane = highestPlane; plane >= 0; --plane)
        {
            threshold = 1 << plane;
            const std::size_t known = significant.size();
            testCoefficients();
            testSets();
            for (std::size_t i = 0; i < known; ++i)
                if (bits.bit(BitKind::refinement))
                    coefficients[significant[i]] += coefficients[significant[i]] > 0 ? threshold : -threshold;
        }
        return std::move(coefficients);
    }

private:
    /// All descendants of a coefficient, or all but its children.
    struct Set
    {
        std::size_t root;
        BitKind kind;
    };

    void addSignificant(std::size_t i)
    {
        coefficients[i] = bits.bit(BitKind::sign) ? threshold : -threshold;
        significant.push_back(i);
    }

    void testCoefficients()
    {
        std::size_t kept = 0;
        for (const std::size_t i : insignificant)
        {
            if (bits.bit(BitKind::coefficient))
                addSignificant(i);
            else
                insignificant[kept++] = i;
        }
        insignificant.resize(kept);
    }

    void testSets()
    {
        std::vector<Set> kept;
        for (std::size_t n = 0; n < sets.size(); ++n) // which grows
        {
            const Set set = sets[n];
            if (!bits.bit(set.kind))
                kept.push_back(set);
            else if (set.kind == BitKind::descendants)
                splitFamily(set.root);
            else
                for (const std::size_t child : {2 * set.root, 2 * set.root + 1})
                    sets.push_back({child, BitKind::descendants});
        }
        sets = std::move(kept);
    }

    void splitFamily(std::size_t root)
    {
        for (const std::size_t child : {2 * root, 2 * root + 1})
        {
            if (bits.bit(BitKind::child))
                addSignificant(child);
            else
                insignificant.push_back(child);
        }
        if (4 * root + 3 < coefficients.size())
            sets.push_back({root, BitKind::grandchildren});
    }

    ArithmeticDecoder& bits;
    std::vector<int> coefficients;
    std::vector<std::size_t> insignificant, significant;
    std::vector<Set> sets;
    int threshold = 0;
};
} // namespace

std::optional<HjifBlock> decodeHjifStream(std::string_view text, std::size_t size)
{
    while (!text.empty() && text.back() == '=')
        text.remove_suffix(1);
    if (!std::all_of(text.begin(), text.end(), [](char c) { return sixBits(c).has_value(); }))
        return {};
    HjifBlock block;
    block.coefficients.resize(size);
    if (text.empty())
        return block;
    ArithmeticDecoder bits(text);
    const int highestPlane = bits.number(4);
    const bool aboveOne = bits.number(1) == 1;
    const double level = bits.number(7);
    block.step = std::ldexp(aboveOne ? 1.0 + level / 8.0 : level / 128.0, -highestPlane);
    if (block.step > 0.0)
        block.coefficients = TreeDecoder(bits, size).decode(highestPlane);
    return block;
}

} // namespace pacini
