#pragma once

// What every DspBlock promises, checked once for all of them.

#include "Catch.h"
#include "HeapGuard.h"
#include "Measure.h"

#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>
#include <vector>

namespace pacini::test
{

/// How a block's delay shows in its response to a single 1.
enum class MeasuredDelay
{
    notMeasured,
    firstFrame,   ///< the first frame that is not 0 (recursive filters, pure delays)
    largestFrame, ///< the frame of the largest magnitude (linear phase)
};

struct ContractOptions
{
    bool linear = true; ///< silence in gives silence out
    double bound = 1e6; ///< no output sample of unit noise is larger
    std::size_t frames = 6000;
    MeasuredDelay delay = MeasuredDelay::notMeasured;
};

template <typename B>
std::vector<float> runInBlocks(B& block, const std::vector<float>& in, std::size_t blockFrames)
{
    std::vector<float> out(in.size());
    for (std::size_t i = 0; i < in.size(); i += blockFrames)
    {
        const auto n = std::min(blockFrames, in.size() - i);
        block.process(std::span(in).subspan(i, n), std::span(out).subspan(i, n));
    }
    return out;
}

inline bool allFinite(const std::vector<float>& x)
{
    for (float v : x)
        if (!std::isfinite(v))
            return false;
    return true;
}

/// Checks block B with `params`: finite on any input, reset = fresh, independent of the block size, in place = out of
/// place, no heap traffic in process, silence to silence, the reported delay, and all of it from 8 to 768 kHz.
template <DspBlock B>
void checkBlockContract(const typename B::Params& params, ContractOptions options = {})
{
    for (double fs : {8000.0, 44100.0, 48000.0, 192000.0, 768000.0})
    {
        CAPTURE(fs);
        const ProcessSpec spec{fs, 4096};
        const auto fresh = [&]
        {
            B block;
            block.setParams(params);
            block.prepare(spec);
            block.setParams(params);
            block.reset();
            return block;
        };

        const auto x = noise(options.frames, 7);
        auto reference = fresh();
        const auto expected = runInBlocks(reference, x, spec.maxBlockFrames);
        REQUIRE(allFinite(expected));
        for (float v : expected)
            REQUIRE(std::abs(static_cast<double>(v)) <= options.bound);

        for (std::size_t size : {std::size_t(1), std::size_t(7), std::size_t(64), std::size_t(511)})
        {
            CAPTURE(size);
            auto block = fresh();
            REQUIRE(runInBlocks(block, x, size) == expected);
        }

        reference.reset();
        REQUIRE(runInBlocks(reference, x, 512) == expected);

        {
            auto block = fresh();
            block.process(std::span<const float>(), std::span<float>());
            REQUIRE(runInBlocks(block, x, 512) == expected);
        }

        {
            auto block = fresh();
            auto inPlace = x;
            for (std::size_t i = 0; i < x.size(); i += 512)
            {
                const auto n = std::min<std::size_t>(512, x.size() - i);
                const auto part = std::span(inPlace).subspan(i, n);
                block.process(part, part);
            }
            REQUIRE(inPlace == expected);
        }

        {
            auto block = fresh();
            std::vector<float> out(x.size());
            const HeapGuard guard;
            block.process(std::span(x).first(4096), std::span(out).first(4096));
            block.setParams(params);
            block.reset();
            REQUIRE(guard.traffic() == 0);
        }

        {
            auto block = fresh();
            auto bad = x;
            bad[100] = std::numeric_limits<float>::quiet_NaN();
            bad[2000] = std::numeric_limits<float>::infinity();
            bad[2001] = -std::numeric_limits<float>::infinity();
            bad[3000] = std::numeric_limits<float>::max();
            bad[3500] = std::numeric_limits<float>::denorm_min();
            REQUIRE(allFinite(runInBlocks(block, bad, 512)));
        }

        {
            // One bad sample is gone, it does not live on in a feedback loop.
            auto block = fresh();
            auto silenced = fresh();
            auto bad = x;
            bad[100] = std::numeric_limits<float>::quiet_NaN();
            bad[101] = std::numeric_limits<float>::infinity();
            auto zero = x;
            zero[100] = zero[101] = 0.0f;
            REQUIRE(runInBlocks(block, bad, 512) == runInBlocks(silenced, zero, 512));
        }

        if (options.linear)
        {
            auto block = fresh();
            for (float v : runInBlocks(block, std::vector<float>(2000, 0.0f), 512))
                REQUIRE(v == 0.0f);
        }

        if (options.delay != MeasuredDelay::notMeasured)
        {
            auto block = fresh();
            std::vector<float> impulse(options.frames, 0.0f);
            impulse[0] = 1.0f;
            const auto response = runInBlocks(block, impulse, 512);
            const auto found = options.delay == MeasuredDelay::firstFrame
                                   ? std::find_if(response.begin(), response.end(), [](float v) { return v != 0.0f; })
                                   : std::max_element(response.begin(), response.end(),
                                                      [](float a, float b) { return std::abs(a) < std::abs(b); });
            REQUIRE(static_cast<std::size_t>(found - response.begin()) == block.latencyFrames());
        }
    }
}

/// Checks that block B stays finite and below `bound` on unit noise while its parameters jump between all of `params`,
/// in random order, with every sample.
template <DspBlock B>
void checkModulation(const std::vector<typename B::Params>& params, double bound, std::size_t frames = 20000)
{
    for (double fs : {8000.0, 48000.0, 768000.0})
    {
        CAPTURE(fs);
        B block;
        block.prepare({fs, 1});
        Random random(11);
        const auto x = noise(frames, 5);
        double largest = 0.0;
        for (std::size_t i = 0; i < frames; ++i)
        {
            block.setParams(params[random.next() % params.size()]);
            float y = 0.0f;
            block.process(std::span(x).subspan(i, 1), std::span(&y, 1));
            REQUIRE(std::isfinite(y));
            largest = std::max(largest, std::abs(static_cast<double>(y)));
        }
        CHECK(largest <= bound);
        CHECK(largest > 0.0);
    }
}

/// Checks that block B does not compute with denormal numbers, which are slow, in the last of the calls of `callFrames`
/// that make up the minute after a sound. Only a slowly decaying block passes when that minute is one call.
template <DspBlock B>
void checkSilenceIsCheap(const typename B::Params& params, std::size_t callFrames = 512)
{
    const double fs = 8000.0;
    const std::size_t minute = 480000;
    B block;
    block.setParams(params);
    block.prepare({fs, callFrames});
    auto x = noise(512, 3);
    block.process(x, x);
    const std::vector<float> silence(callFrames, 0.0f);
    std::vector<float> y(callFrames, 1.0f);
    for (std::size_t done = callFrames; done < minute; done += callFrames)
        block.process(silence, y);
    std::feclearexcept(FE_UNDERFLOW);
    block.process(silence, y);
    CHECK(std::fetestexcept(FE_UNDERFLOW) == 0);
    CHECK(y.back() == 0.0f);
}

/// Checks a source: what plays without an input. `make(fs)` returns a fresh one (in a pointer) with totalFrames() and
/// process(out), and reset() if it can start again. It is finite, never denormal and within `bound`, sounds, does not
/// depend on the block size, makes no heap traffic, and after its end it is silent, unless filters behind it `ring`;
/// all of it from 8 to 768 kHz.
template <typename Make>
void checkSourceContract(Make&& make, double bound, bool ring = false)
{
    for (double fs : {8000.0, 44100.0, 48000.0, 192000.0, 768000.0})
    {
        CAPTURE(fs);
        const auto play = [](auto& source, std::size_t frames, std::size_t blockFrames)
        {
            std::vector<float> out(frames, 1.0f);
            for (std::size_t i = 0; i < frames; i += blockFrames)
                source.process(std::span(out).subspan(i, std::min(blockFrames, frames - i)));
            return out;
        };
        auto reference = make(fs);
        const auto sounding = static_cast<std::size_t>(reference->totalFrames());
        const std::size_t frames = sounding + 500;
        const auto expected = play(*reference, frames, 4096);
        REQUIRE(std::all_of(expected.begin(), expected.end(), [](float v) { return v == 0.0f || std::isnormal(v); }));
        double largest = 0.0;
        for (float v : expected)
            largest = std::max(largest, std::abs(static_cast<double>(v)));
        REQUIRE(largest <= bound);
        REQUIRE(largest > 0.0);
        const auto end = expected.begin() + static_cast<std::ptrdiff_t>(sounding);
        if (!ring)
            REQUIRE(std::count(end, expected.end(), 0.0f) == 500);

        for (std::size_t size : {std::size_t(1), std::size_t(7), std::size_t(64), std::size_t(511), frames})
        {
            CAPTURE(size);
            auto source = make(fs);
            source->process(std::span<float>());
            REQUIRE(play(*source, frames, size) == expected);
        }

        if constexpr (requires { reference->reset(); })
        {
            reference->reset();
            REQUIRE(play(*reference, frames, 512) == expected);
            reference->reset();
            (void)play(*reference, sounding / 3, 512);
            reference->reset();
            REQUIRE(play(*reference, frames, 512) == expected);
        }

        {
            auto source = make(fs);
            std::vector<float> out(4096);
            const HeapGuard guard;
            for (std::size_t i = 0; i < frames; i += out.size())
                source->process(out);
            if constexpr (requires { source->reset(); })
                source->reset();
            REQUIRE(guard.traffic() == 0);
        }
    }
}

/// Numbers that no setter may stumble over: not finite, enormous, tiny, of the wrong sign, ordinary.
inline constexpr double anyNumber[] = {std::numeric_limits<double>::quiet_NaN(),
                                       std::numeric_limits<double>::infinity(),
                                       -std::numeric_limits<double>::infinity(),
                                       1e308,
                                       -1e308,
                                       1e30,
                                       -1e30,
                                       5e-324,
                                       -5e-324,
                                       0.0,
                                       -1.0,
                                       0.5,
                                       1.0,
                                       12.0};

/// One output of a DspBank as a block, so that the contract of blocks can be checked on banks too.
template <DspBank Bank>
class OutputOf
{
public:
    struct Params
    {
        typename Bank::Params bank;
        std::size_t output = 0;
    };

    void prepare(const ProcessSpec& spec)
    {
        bank.prepare(spec);
        memory.assign(bank.bands(), std::vector<float>(spec.maxBlockFrames));
        views.resize(bank.bands());
    }
    void setParams(const Params& params) noexcept
    {
        bank.setParams(params.bank);
        output = params.output;
    }
    void reset() noexcept { bank.reset(); }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        for (std::size_t k = 0; k < views.size(); ++k)
            views[k] = k == output ? out : std::span(memory[k]).first(in.size());
        bank.process(in, views);
    }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return bank.latencyFrames(); }

private:
    Bank bank;
    std::size_t output = 0;
    std::vector<std::vector<float>> memory;
    std::vector<std::span<float>> views;
};

} // namespace pacini::test
