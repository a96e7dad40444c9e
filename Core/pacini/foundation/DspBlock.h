#pragma once

// The DspBlock concept: the contract that every streaming block keeps (checked in Tests/support/BlockContract.h).

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace pacini
{

namespace limits
{
inline constexpr double lowestRate = 2000.0;    ///< Hz, of blocks and players
inline constexpr double highestRate = 768000.0; ///< Hz
inline constexpr float sample = 1e12f;          ///< magnitude of sound: 1 is full scale, integers of 32 bits reach 2e9
} // namespace limits

/// Whether signals are made at `fs` Hz: 2 to 768 kHz.
[[nodiscard]] constexpr bool isPlayableRate(double fs) noexcept
{
    return fs >= limits::lowestRate && fs <= limits::highestRate;
}

/// Sample rate and block size for prepare(). Rates outside 2-768 kHz and empty blocks are the caller's
/// error.
struct ProcessSpec
{
    double sampleRate = 48000.0;      ///< Hz
    std::size_t maxBlockFrames = 512; ///< no call of process() is longer than this
    bool operator==(const ProcessSpec&) const = default;
};

/// A streaming mono block: prepare() alone may allocate; everything else is real-time safe.
/// After reset() a block equals a freshly prepared one; process() may run in place (in and out the same memory);
/// the output does not depend on how the input is cut into calls.
/// A sample that is NaN or infinite counts as 0 where it enters a block, so that one bad sample never stays in a
/// feedback loop; what leaves a block is finite and never denormal.
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

/// A streaming block with one input and bands() outputs, under the same contract; outs[k] has as many frames as `in`,
/// and one of the outputs may be the memory of the input.
template <typename B>
concept DspBank = requires(B bank, ProcessSpec spec, typename B::Params params, std::span<const float> in,
                           std::span<const std::span<float>> outs)
{
    bank.prepare(spec);
    {
        bank.setParams(params)
    }
    noexcept;
    {
        bank.reset()
    }
    noexcept;
    {
        bank.process(in, outs)
    }
    noexcept;
    {
        bank.bands()
    }
    noexcept->std::convertible_to<std::size_t>;
    {
        bank.latencyFrames()
    }
    noexcept->std::convertible_to<std::size_t>;
};

/// Whether all of `samples` lie within +-limits::sample; neither NaN nor infinities do. [any]
[[nodiscard]] inline bool areWithinLimit(std::span<const float> samples) noexcept
{
    // Without the sign, floats are ordered as their bits are, infinity and NaN above all: a difference from the limit
    // that is negative remains so in the sum of all bits. One pass without branches, in lanes that compilers make
    // vector code of.
    constexpr auto largest = std::bit_cast<std::int32_t>(limits::sample);
    const auto room = [](float x)
    {
        return largest - (std::bit_cast<std::int32_t>(x) & 0x7FFFFFFF);
    };
    constexpr std::size_t lanes = 8;
    std::array<std::int32_t, lanes> signs{};
    std::size_t i = 0;
    for (; i + lanes <= samples.size(); i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane)
            signs[lane] |= room(samples[i + lane]);
    for (; i < samples.size(); ++i)
        signs[0] |= room(samples[i]);
    return std::all_of(signs.begin(), signs.end(), [](std::int32_t sign) { return sign >= 0; });
}

/// A sample on its way into a block: NaN and infinities become 0.
[[nodiscard]] inline double finiteOrZero(float sample) noexcept
{
    const auto x = static_cast<double>(sample);
    return std::abs(x) <= static_cast<double>(std::numeric_limits<float>::max()) ? x : 0.0;
}

/// A sample on its way out of a block: limited to the finite floats; below -600 dB (far under every converter, far over
/// the denormals, which slow down whatever follows) it is 0.
[[nodiscard]] inline float toSample(double y) noexcept
{
    constexpr double largest = static_cast<double>(std::numeric_limits<float>::max());
    if (!(std::abs(y) >= 1e-30))
        return 0.0f;
    return static_cast<float>(y > largest ? largest : (y < -largest ? -largest : y));
}

/// toSample(finiteOrZero(x)): a sample that a block passes on.
[[nodiscard]] inline float passedSample(float x) noexcept
{
    const float size = std::abs(x);
    const bool passes = (size >= 1e-30f) & (size <= std::numeric_limits<float>::max()); // no branch
    return passes ? x : 0.0f;
}

/// Sets a state variable that has decayed below anything audible to 0, at the end of each process() call and every
/// `flushInterval` frames: in silence a feedback loop would otherwise end in denormal numbers, which cost a hundred
/// times as much. The limit lies so far under that of toSample() that no output depends on where this happens.
inline void flushTiny(double& state) noexcept
{
    if (std::abs(state) < 1e-100)
        state = 0.0;
}

inline constexpr std::size_t flushInterval = 256;

/// out[i] = tick(in[i]) for every frame, with the guards of the contract at the input and the output; flush() calls
/// flushTiny on the state.
template <typename Tick, typename Flush>
void forEachSample(std::span<const float> in, std::span<float> out, Tick&& tick, Flush&& flush) noexcept
{
    for (std::size_t begin = 0; begin < in.size(); begin += flushInterval)
    {
        const std::size_t end = std::min(in.size(), begin + flushInterval);
        for (std::size_t i = begin; i < end; ++i)
            out[i] = toSample(tick(finiteOrZero(in[i])));
        flush();
    }
}

/// Base of blocks without latency whose design needs only the sample rate: `Block` derives from this and adds
/// setParams(), which keeps its argument in `current` and designs for `fs`, reset() and process().
template <typename Block, typename P>
class DesignedBlock
{
public:
    using Params = P;

    void prepare(const ProcessSpec& spec) noexcept
    {
        fs = spec.sampleRate;
        auto& block = static_cast<Block&>(*this);
        block.setParams(current);
        block.reset();
    }
    [[nodiscard]] std::size_t latencyFrames() const noexcept { return 0; }

protected:
    double fs = ProcessSpec{}.sampleRate; ///< Hz
    Params current;
};

} // namespace pacini
