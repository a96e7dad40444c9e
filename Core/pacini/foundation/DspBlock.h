#pragma once

// The contract that every streaming block keeps (checked in Tests/support/BlockContract.h).

#include <concepts>
#include <cstddef>
#include <span>

namespace pacini
{

/// What a block is prepared for. Rates outside 2-768 kHz and empty blocks are the caller's error.
struct ProcessSpec
{
    double sampleRate = 48000.0;      ///< Hz
    std::size_t maxBlockFrames = 512; ///< no call of process() is longer than this
    bool operator==(const ProcessSpec&) const = default;
};

/// A streaming mono block: prepare() alone may allocate; everything else is real-time safe.
/// After reset() a block equals a freshly prepared one; process() may run in place (in and out the same memory);
/// the output does not depend on how the input is cut into calls.
template <typename B>
concept DspBlock = requires(B block, ProcessSpec spec, typename B::Params params, std::span<const float> in,
                            std::span<float> out)
{
    block.prepare(spec);
    {
        block.setParams(params)
    }
    noexcept;
    {
        block.reset()
    }
    noexcept;
    {
        block.process(in, out)
    }
    noexcept;
    {
        block.latencyFrames()
    }
    noexcept->std::convertible_to<std::size_t>;
};

} // namespace pacini
