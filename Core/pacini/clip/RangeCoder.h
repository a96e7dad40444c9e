#pragma once

// Adaptive binary range coder.

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// The probability of a one in some context, learnt while coding: starts at a guess and moves by 1 / (count + 1.5), as
/// an average does, down to 1 / 64. The first bits of a short clip then cost little more than the last.
class AdaptiveBit
{
public:
    /// `guess` is the probability of a one (0-1), `weight` how many observations it counts for.
    constexpr explicit AdaptiveBit(double guess = 0.5, int weight = 0) noexcept
        : probability(static_cast<std::uint16_t>(clampProbability(static_cast<std::int32_t>(guess * 65536.0)))),
          count(static_cast<std::uint16_t>(weight))
    {
    }

    /// Probability of a one in 1/65536, never 0 or 1.
    [[nodiscard]] constexpr std::uint32_t ones() const noexcept { return probability; }

    constexpr void update(bool bit) noexcept
    {
        const std::int32_t target = bit ? 65535 : 0;
        const std::int32_t moved = probability + (target - probability) * 2 / (2 * count + 3);
        probability = static_cast<std::uint16_t>(clampProbability(moved));
        if (count < slowest)
            ++count;
    }

private:
    static constexpr std::uint16_t slowest = 63;
    static constexpr std::int32_t clampProbability(std::int32_t p) noexcept
    {
        return p < 48 ? 48 : p > 65488 ? 65488 : p;
    }

    std::uint16_t probability;
    std::uint16_t count;
};

/// Binary arithmetic coder with carry propagation (Martin, "Range encoding", 1979, in the byte-wise form with a cached
/// byte that LZMA made common). Writer and reader have the same two functions, so one template codes both ways:
/// bit(b, model) writes b or ignores it and reads; either way it returns the bit.
class RangeWriter
{
public:
    static constexpr bool reading = false;

    bool bit(bool b, AdaptiveBit& model)
    {
        const auto bound = static_cast<std::uint32_t>((static_cast<std::uint64_t>(range) * model.ones()) >> 16);
        encode(b, bound);
        model.update(b);
        return b;
    }

    /// A bit that is as likely 0 as 1.
    bool bit(bool b)
    {
        encode(b, range >> 1);
        return b;
    }

    /// Everything written; trailing zero bytes are left out, since the reader finds zeros after the end. Use once.
    [[nodiscard]] std::vector<std::byte> finish()
    {
        // Any value in [low, low + range) will do: take the one with the most trailing zeros.
        const std::uint64_t high = low + range - 1;
        for (int zeros = 32; zeros >= 0; --zeros)
        {
            const std::uint64_t unit = std::uint64_t{1} << zeros;
            const std::uint64_t candidate = (low + unit - 1) & ~(unit - 1);
            if (candidate <= high)
            {
                low = candidate;
                break;
            }
        }
        for (int i = 0; i < 5; ++i)
            shift();
        while (!bytes.empty() && bytes.back() == std::byte{0})
            bytes.pop_back();
        return std::move(bytes);
    }

private:
    void encode(bool b, std::uint32_t bound)
    {
        if (b)
            range = bound;
        else
        {
            low += bound;
            range -= bound;
        }
        while (range < (1u << 24))
        {
            range <<= 8;
            shift();
        }
    }

    void shift()
    {
        if (low < 0xFF000000ull || low > 0xFFFFFFFFull)
        {
            const auto carry = static_cast<std::uint8_t>(low >> 32);
            if (started)
                bytes.push_back(static_cast<std::byte>(static_cast<std::uint8_t>(cache + carry)));
            for (; pending > 0; --pending)
                bytes.push_back(static_cast<std::byte>(static_cast<std::uint8_t>(0xFF + carry)));
            cache = static_cast<std::uint8_t>(low >> 24);
            started = true;
        }
        else
            ++pending;
        low = (low & 0x00FFFFFFull) << 8;
    }

    std::vector<std::byte> bytes;
    std::uint64_t low = 0;
    std::uint32_t range = 0xFFFFFFFFu;
    std::uint8_t cache = 0;
    bool started = false;
    std::uint64_t pending = 0;
};

/// Arithmetic decoder for the output of RangeWriter.
class RangeReader
{
public:
    static constexpr bool reading = true;

    explicit RangeReader(std::span<const std::byte> data) : input(data)
    {
        for (int i = 0; i < 4; ++i)
            code = (code << 8) | next();
    }

    bool bit(bool, AdaptiveBit& model)
    {
        const auto bound = static_cast<std::uint32_t>((static_cast<std::uint64_t>(range) * model.ones()) >> 16);
        const bool b = decode(bound);
        model.update(b);
        return b;
    }

    bool bit(bool) { return decode(range >> 1); }

private:
    bool decode(std::uint32_t bound)
    {
        const bool b = code < bound;
        if (b)
            range = bound;
        else
        {
            code -= bound;
            range -= bound;
        }
        while (range < (1u << 24))
        {
            range <<= 8;
            code = (code << 8) | next();
        }
        return b;
    }

    /// Zeros follow the last byte: the writer leaves out trailing ones.
    std::uint32_t next() noexcept
    {
        return position < input.size() ? static_cast<std::uint32_t>(input[position++]) : 0u;
    }

    std::span<const std::byte> input;
    std::size_t position = 0;
    std::uint32_t code = 0;
    std::uint32_t range = 0xFFFFFFFFu;
};

} // namespace pacini
