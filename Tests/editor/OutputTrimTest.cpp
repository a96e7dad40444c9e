#include "editor/clip/session/OutputTrim.h"

#include "support/Catch.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

using namespace pacini;
using editor::OutputTrim;

namespace
{
constexpr double fs = 48000.0;

std::vector<float> tone(std::size_t frames)
{
    std::vector<float> x(frames);
    for (std::size_t i = 0; i < frames; ++i)
        x[i] = static_cast<float>(std::sin(2.0 * std::numbers::pi * 100.0 * static_cast<double>(i) / fs));
    return x;
}

void run(OutputTrim& trim, std::vector<float>& x, std::size_t block = 100)
{
    for (std::size_t done = 0; done < x.size(); done += block)
    {
        const std::array<std::span<float>, 1> one{std::span(x).subspan(done, std::min(block, x.size() - done))};
        trim.process(one);
    }
}
} // namespace

TEST_CASE("An output is late by its delay to the frame, and as loud as its level")
{
    OutputTrim trim;
    trim.setDelay(0.0125);
    trim.setLevel(0.5);
    trim.prepare(fs);
    const auto in = tone(4800);
    auto out = in;
    run(trim, out);
    for (std::size_t i = 0; i < out.size(); ++i)
        REQUIRE(out[i] == (i < 600 ? 0.0f : 0.5f * in[i - 600]));
}

TEST_CASE("An output that is neither late nor louder is left as it is")
{
    OutputTrim trim;
    trim.prepare(fs);
    const auto in = tone(4800);
    auto out = in;
    run(trim, out);
    CHECK(out == in);
}

TEST_CASE("Level and delay change without a click, and arrive")
{
    OutputTrim trim;
    trim.prepare(fs);
    const auto in = tone(48000);
    auto out = in;
    const double steepest = 2.0 * std::numbers::pi * 100.0 / fs;
    for (std::size_t block = 0; block < 480; ++block)
    {
        if (block == 100)
            trim.setDelay(0.2);
        if (block == 200)
            trim.setLevel(0.25);
        if (block == 300)
            trim.setDelay(10.0); // to the longest
        const std::array<std::span<float>, 1> one{std::span(out).subspan(block * 100, 100)};
        trim.process(one);
    }
    // Two tones cross within 480 frames: each moves as it did, and the step between them is at most 2 / 480.
    for (std::size_t i = 1; i < out.size(); ++i)
        REQUIRE(static_cast<double>(std::abs(out[i] - out[i - 1])) <= steepest + 2.0 / 480.0 + 1e-6);
    CHECK(out[47000] == Approx(0.25f * in[47000 - 24000]).margin(1e-6));
    CHECK(trim.delayNow() == 0.5);
}
