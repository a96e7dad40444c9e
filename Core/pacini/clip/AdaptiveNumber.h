#pragma once

// Adaptive Exp-Golomb code: whole numbers as adaptive binary decisions.

#include <pacini/clip/RangeCoder.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace pacini
{

/// An Exp-Golomb code (Teuhola 1978) whose decisions adapt: first how many bits the number has, one by one, then the
/// bits below the leading one; the highest two of those are learnt too. Numbers up to 2^40 - 2: larger ones are the
/// caller's error, and no input can make the reader return one.
class AdaptiveNumber
{
public:
    /// `typical` is the size of number to expect at first.
    explicit AdaptiveNumber(double typical = 1.0)
    {
        // For a geometric distribution of this mean: the chance that a number of at least 2^k - 1 goes beyond 2^(k+1)
        // - 2.
        for (std::size_t k = 0; k < longer.size(); ++k)
        {
            const double further = (typical + 0.05) / (typical + 0.05 + static_cast<double>(std::uint64_t{1} << k));
            longer[k] = AdaptiveBit(std::clamp(further, 0.03, 0.97), 3);
        }
    }

    /// Writes `number`, or ignores it and reads; returns the number either way.
    template <typename Coder>
    std::uint64_t code(Coder& coder, std::uint64_t number)
    {
        const std::uint64_t shifted = number + 1;
        const auto wanted = static_cast<std::size_t>(std::bit_width(shifted)) - 1;
        std::size_t bits = 0;
        while (bits < longer.size() && coder.bit(bits < wanted, longer[bits]))
            ++bits;
        std::uint64_t result = 1;
        for (std::size_t i = bits; i-- > 0;)
        {
            const bool bit = ((shifted >> i) & 1u) != 0;
            const std::size_t depth = bits - 1 - i;
            const bool learnt = depth < 2 && bits < lower.size();
            const std::size_t context = depth * 2 + (static_cast<std::size_t>(result) & depth);
            const bool got = learnt ? coder.bit(bit, lower[bits][context]) : coder.bit(bit);
            result = (result << 1) | static_cast<std::uint64_t>(got);
        }
        return result - 1;
    }

private:
    std::array<AdaptiveBit, 40> longer;
    std::array<std::array<AdaptiveBit, 4>, 12> lower;
};

/// A signed number: zero or not, its sign, its size; each learnt. The sign's odds are the caller's when it knows more.
class AdaptiveSignedNumber
{
public:
    explicit AdaptiveSignedNumber(double typical = 1.0)
        : zero(1.0 / (1.0 + 2.0 * typical), 6), size(typical > 1.3 ? typical - 1.0 : 0.3)
    {
    }

    template <typename Coder>
    std::int64_t code(Coder& coder, std::int64_t number)
    {
        return code(coder, number, negative);
    }

    template <typename Coder>
    std::int64_t code(Coder& coder, std::int64_t number, AdaptiveBit& sign)
    {
        if (coder.bit(number == 0, zero))
            return 0;
        const bool below = coder.bit(number < 0, sign);
        const auto rest = static_cast<std::uint64_t>(number < 0 ? -number - 1 : number - 1);
        const auto magnitude = static_cast<std::int64_t>(size.code(coder, rest)) + 1;
        return below ? -magnitude : magnitude;
    }

private:
    AdaptiveBit zero;
    AdaptiveBit negative;
    AdaptiveNumber size;
};

} // namespace pacini
