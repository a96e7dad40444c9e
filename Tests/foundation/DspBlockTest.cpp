#include "support/Catch.h"

#include <pacini/foundation/DspBlock.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
/// Remembers what its base tells it.
class BlockOfBase : public DesignedBlock<BlockOfBase, int>
{
public:
    void setParams(int value) noexcept
    {
        current = value;
        designedFor = fs;
        designed = value;
    }
    void reset() noexcept { ++resets; }
    void process(std::span<const float>, std::span<float>) noexcept {}
    int designed = -1;
    int resets = 0;
    double designedFor = 0.0;
};
static_assert(DspBlock<BlockOfBase>);
} // namespace

TEST_CASE("Signals are made at 2 to 768 kHz", "[foundation]")
{
    CHECK(isPlayableRate(2000.0));
    CHECK(isPlayableRate(768000.0));
    CHECK(isPlayableRate(48000.0));
    CHECK_FALSE(isPlayableRate(std::nextafter(2000.0, 0.0)));
    CHECK_FALSE(isPlayableRate(std::nextafter(768000.0, 1e9)));
    CHECK_FALSE(isPlayableRate(std::numeric_limits<double>::quiet_NaN()));
    CHECK(limits::lowestRate == 2000.0);
    CHECK(limits::highestRate == 768000.0);
    CHECK(limits::sample == 1e12f);
    CHECK(ProcessSpec{}.sampleRate == 48000.0);
    CHECK(ProcessSpec{}.maxBlockFrames == 512);
}

TEST_CASE("A sample that is not finite counts as 0 on its way in", "[foundation]")
{
    const float inf = std::numeric_limits<float>::infinity();
    const float largest = std::numeric_limits<float>::max();
    CHECK(finiteOrZero(0.25f) == 0.25);
    CHECK(finiteOrZero(-3e30f) == static_cast<double>(-3e30f));
    CHECK(finiteOrZero(largest) == static_cast<double>(largest));
    CHECK(finiteOrZero(-largest) == -static_cast<double>(largest));
    CHECK(finiteOrZero(inf) == 0.0);
    CHECK(finiteOrZero(-inf) == 0.0);
    CHECK(finiteOrZero(std::numeric_limits<float>::quiet_NaN()) == 0.0);
}

TEST_CASE("A sample is finite and far above the denormals on its way out", "[foundation]")
{
    const double inf = std::numeric_limits<double>::infinity();
    const float largest = std::numeric_limits<float>::max();
    CHECK(toSample(0.25) == 0.25f);
    CHECK(toSample(-0.25) == -0.25f);
    CHECK(toSample(1e-30) == 1e-30f);
    CHECK(toSample(-1e-30) == -1e-30f);
    CHECK(toSample(std::nextafter(1e-30, 0.0)) == 0.0f);
    CHECK(toSample(-0.9e-30) == 0.0f);
    CHECK(toSample(1e39) == largest);
    CHECK(toSample(-1e39) == -largest);
    CHECK(toSample(inf) == largest);
    CHECK(toSample(-inf) == -largest);
    CHECK(toSample(std::numeric_limits<double>::quiet_NaN()) == 0.0f);
}

TEST_CASE("A sample that a block passes on is what it would be on its way in and out", "[foundation]")
{
    const float inf = std::numeric_limits<float>::infinity();
    const float largest = std::numeric_limits<float>::max();
    const float smallest = std::numeric_limits<float>::denorm_min();
    for (const float x : {0.0f, 0.25f, 1e-30f, std::nextafter(1e-30f, 0.0f), smallest, 3e30f, largest, inf})
        for (const float sample : {x, -x})
        {
            CAPTURE(sample);
            CHECK(passedSample(sample) == toSample(finiteOrZero(sample)));
        }
    CHECK(passedSample(std::numeric_limits<float>::quiet_NaN()) == 0.0f);
}

TEST_CASE("A state below 1e-100 becomes 0", "[foundation]")
{
    for (const double kept : {1e-100, -1e-100, 1.0, -5e-100})
    {
        double state = kept;
        flushTiny(state);
        CHECK(state == kept);
    }
    for (const double gone : {0.9e-100, -0.9e-100, 5e-324, 0.0})
    {
        double state = gone;
        flushTiny(state);
        CHECK(state == 0.0);
    }
}

TEST_CASE("Every sample is taken once, in order, and the state is flushed every 256 frames and at the end",
          "[foundation]")
{
    CHECK(flushInterval == 256);
    for (const std::size_t frames : {0u, 1u, 255u, 256u, 257u, 512u, 1000u})
    {
        CAPTURE(frames);
        std::vector<float> in(frames), out(frames, 9.0f);
        for (std::size_t i = 0; i < frames; ++i)
            in[i] = static_cast<float>(i + 1);
        std::vector<double> taken;
        std::vector<std::size_t> flushes;
        forEachSample(
            in, out,
            [&](double x)
            {
                taken.push_back(x);
                return 2.0 * x;
            },
            [&] { flushes.push_back(taken.size()); });
        REQUIRE(taken.size() == frames);
        for (std::size_t i = 0; i < frames; ++i)
        {
            CHECK(taken[i] == static_cast<double>(i + 1));
            CHECK(out[i] == 2.0f * static_cast<float>(i + 1));
        }
        std::vector<std::size_t> expected;
        for (std::size_t at = 256; at < frames; at += 256)
            expected.push_back(at);
        if (frames > 0)
            expected.push_back(frames);
        CHECK(flushes == expected);
    }
    std::vector<float> bad{std::numeric_limits<float>::quiet_NaN(), 1.0f}, out(2);
    forEachSample(
        bad, out, [](double x) { return x == 0.0 ? 1e300 : 1e-31; }, [] {});
    CHECK(out == std::vector<float>{std::numeric_limits<float>::max(), 0.0f});
}

TEST_CASE("A designed block is designed for its rate with its parameters, and is reset, when it is prepared",
          "[foundation]")
{
    BlockOfBase block;
    block.setParams(4);
    CHECK(block.designedFor == 48000.0);
    block.designed = 0;
    block.prepare({96000.0, 16});
    CHECK(block.designed == 4);
    CHECK(block.designedFor == 96000.0);
    CHECK(block.resets == 1);
    CHECK(block.latencyFrames() == 0);
}

TEST_CASE("Samples beyond the limit are noticed wherever they are", "[foundation]")
{
    std::vector<float> x(19, -limits::sample);
    CHECK(areWithinLimit(x));
    CHECK(areWithinLimit({}));
    for (const float bad : {std::nextafter(limits::sample, 1e30f), -1.1e12f, std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
        for (std::size_t i = 0; i < x.size(); ++i)
        {
            auto y = x;
            y[i] = bad;
            CHECK_FALSE(areWithinLimit(y));
        }
}
