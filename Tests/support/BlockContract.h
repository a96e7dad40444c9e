#pragma once

// What every DspBlock promises, checked once for all of them.

#include "Catch.h"
#include "HeapGuard.h"

#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Random.h>

#include <cmath>
#include <limits>
#include <vector>

namespace pacini::test
{

struct ContractOptions
{
    bool linear = true; ///< silence in gives silence out
    double bound = 1e6; ///< no output sample of unit noise is larger
    std::size_t frames = 6000;
};

inline std::vector<float> noise(std::size_t frames, std::uint64_t seed)
{
    Random random(seed);
    std::vector<float> x(frames);
    for (float& v : x)
        v = static_cast<float>(random.uniform(-1.0, 1.0));
    return x;
}

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
/// place, no heap traffic in process, silence to silence, and all of it from 8 to 768 kHz.
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

        if (options.linear)
        {
            auto block = fresh();
            for (float v : runInBlocks(block, std::vector<float>(2000, 0.0f), 512))
                REQUIRE(v == 0.0f);
        }
    }
}

} // namespace pacini::test
