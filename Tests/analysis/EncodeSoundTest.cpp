#include "support/Catch.h"

#include <pacini/analysis/EncodeSound.h>

#include <cmath>
#include <cstddef>
#include <vector>

using namespace pacini;

namespace
{
/// Two channels of a tone that comes and goes.
std::vector<float> sound(std::size_t frames)
{
    std::vector<float> samples;
    for (std::size_t n = 0; n < frames; ++n)
    {
        const double t = static_cast<double>(n) / 16000.0;
        const double x = 0.5 * (1.0 - std::cos(8.0 * t)) * std::sin(900.0 * t);
        samples.insert(samples.end(), {static_cast<float>(x), static_cast<float>(0.5 * x)});
    }
    return samples;
}
} // namespace

TEST_CASE("A sound in parts becomes the clip of the whole sound, on the grids that files hold", "[analysis]")
{
    const auto samples = sound(80000); // more than two parts
    Encoder encoder({});
    const auto clip = encodeSound(encoder, {16000, 2}, SoundParts(samples, 2));
    REQUIRE(clip.ok());
    encoder.start(16000, 2);
    encoder.push(samples);
    const Clip whole = encoder.finish();
    CHECK(encodePrecisely(encoder, {16000, 2}, SoundParts(samples, 2)).value() == whole);
    CHECK(*clip == unpackClip(packClip(whole, packParamsFor(whole))).value());
    CHECK(onGrids(*clip) == *clip);
}

TEST_CASE("What is wrong with a part is what is wrong with the encoding", "[analysis]")
{
    const auto samples = sound(2000);
    Encoder encoder({});
    std::size_t parts = 0;
    const auto clip = encodeSound(encoder, {16000, 2},
                                  [&]() -> SoundPart
                                  {
                                      if (++parts == 3)
                                          return Error{ErrorCode::truncated, "", "ends too early"};
                                      return std::span<const float>(samples);
                                  });
    REQUIRE_FALSE(clip.ok());
    CHECK(clip.error().code == ErrorCode::truncated);
    CHECK(parts == 3);
}

TEST_CASE("A sound of more than 24 hours is refused as it comes", "[analysis]")
{
    const std::vector<float> hour(3600 * 8000);
    for (const int hours : {24, 25})
    {
        int given = 0, visited = 0;
        auto next = [&]() -> SoundPart
        {
            return given++ < hours ? std::span<const float>(hour) : std::span<const float>();
        };
        const auto read = forEachPart({8000, 1}, next, [&](std::span<const float>) { ++visited; });
        CHECK(visited == 24);
        CHECK(read.ok() == (hours == 24));
        if (!read)
            CHECK(read.error().code == ErrorCode::tooLarge);
    }
}
