#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/linearize/RecordingChecks.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
/// A slow sinusoid of amplitude 0.5 around `mean`, cut off beyond `limit` from it.
std::vector<float> checkedTone(double limit, double mean = 0.0)
{
    std::vector<float> x;
    for (int n = 0; n < 4000; ++n)
        x.push_back(static_cast<float>(mean + std::clamp(0.5 * std::sin(0.0137 * n), -limit, limit)));
    return x;
}
} // namespace

TEST_CASE("Times and channels are written as messages have them", "[linearize]")
{
    CHECK(secondsText(12.345) == "12.35 s");
    CHECK(secondsText(0.0) == "0.00 s");
    CHECK(secondsText(0.09) == "0.09 s");
    CHECK(secondsText(0.1) == "0.10 s");
    CHECK(secondsText(1.099) == "1.10 s");
    CHECK(secondsText(-3.5) == "-3.50 s");
    CHECK(secondsText(-0.25) == "-0.25 s");
    CHECK(channelPath(0) == "channels[0]");
    CHECK(channelPath(2) == "channels[2]");
}

TEST_CASE("A recording has one to three channels of one length and finite samples", "[linearize]")
{
    const auto textOf = [](const std::vector<std::vector<float>>& channels)
    {
        const auto checked = checkRecording(channels);
        return checked.ok() ? std::string("fine") : checked.error().where + ": " + checked.error().message;
    };
    const std::vector<float> good{0.5f, 0.25f};
    CHECK(textOf({good}) == "fine");
    CHECK(textOf({good, good, good}) == "fine");
    CHECK(textOf({}) == "channels: must be one to three: a microphone or the axes");
    CHECK(textOf({good, good, good, good}) == "channels: must be one to three: a microphone or the axes");
    CHECK(textOf({good, {}}) == "channels[1]: has no samples");
    CHECK(textOf({good, {1.0f}}) ==
          "channels[1]: differs in length from the first channel; record all channels together");
    const std::vector<std::vector<float>> shorter{good, {1.0f}}, longer{good, {1.0f, 1.0f, 1.0f}};
    CHECK(checkRecording(shorter).error().code == ErrorCode::truncated);
    CHECK(checkRecording(longer).error().code == ErrorCode::invalidData);
    CHECK(textOf({good, good, {1.0f, std::numeric_limits<float>::infinity()}}) ==
          "channels[2][1]: must be a finite number");
    const std::vector<std::vector<float>> broken{{std::nanf(""), 0.0f}};
    CHECK(textOf(broken) == "channels[0][0]: must be a finite number");
    CHECK(checkRecording(broken).error().code == ErrorCode::notFinite);
}

TEST_CASE("Clipping is found at either side and any level, with its number and first frame", "[linearize]")
{
    CHECK_FALSE(findClipping(checkedTone(1.0)).has_value());
    CHECK_FALSE(findClipping(checkedTone(1.0, 0.3)).has_value());
    CHECK_FALSE(findClipping({}).has_value());
    CHECK_FALSE(findClipping(std::vector<float>(50, 0.5f)).has_value());
    for (const double mean : {0.0, 0.2, -0.2})
    {
        const auto x = checkedTone(0.47, mean);
        const auto found = findClipping(x);
        REQUIRE(found.has_value());
        std::size_t samples = 0, first = x.size();
        for (std::size_t n = 0; n < x.size(); ++n)
            if (std::abs(static_cast<double>(x[n]) - mean) >= 0.4695)
            {
                ++samples;
                first = std::min(first, n);
            }
        CHECK(found->samples == Approx(static_cast<double>(samples)).margin(2.0));
        CHECK(found->firstFrame == first);
    }
    // one side only, and there the earlier of both
    auto x = checkedTone(1.0);
    for (float& v : x)
        v = std::max(v, -0.4f);
    const auto lower = findClipping(x);
    REQUIRE(lower.has_value());
    CHECK(x[lower->firstFrame] == -0.4f);
    CHECK(x[lower->firstFrame - 1] > -0.4f);
    for (float& v : x)
        v = std::min(v, 0.45f);
    const auto both = findClipping(x);
    REQUIRE(both.has_value());
    CHECK(x[both->firstFrame] == 0.45f);
    CHECK(both->samples > lower->samples);
}

TEST_CASE("Three samples at full scale clip, ten at another limit", "[linearize]")
{
    // a ramp of 1000 steps to `top` and `count` samples at it
    const auto clips = [](double top, int count, int steps, double sign = 1.0)
    {
        std::vector<float> x;
        for (int n = -steps; n < steps; ++n)
            x.push_back(static_cast<float>(sign * top * n / steps));
        x[0] = static_cast<float>(-0.97 * sign * top);
        for (int n = 0; n < count; ++n)
            x.push_back(static_cast<float>(sign * top));
        return findClipping(x).has_value();
    };
    for (const double sign : {1.0, -1.0})
    {
        CHECK_FALSE(clips(1.0, 2, 200, sign));
        CHECK(clips(1.0, 3, 200, sign));
        CHECK_FALSE(clips(0.9, 3, 200, sign));
        CHECK_FALSE(clips(0.9, 9, 200, sign));
        CHECK(clips(0.9, 10, 200, sign));      // seven steps lie in the 3 % below
        CHECK_FALSE(clips(0.9, 30, 50, sign)); // a step of 2 % is too coarse to tell
        CHECK(clips(1.0, 30, 50, sign));
        CHECK_FALSE(clips(0.9, 29, 1000, sign)); // 30 samples lie below
        CHECK(clips(0.9, 36, 1000, sign));
    }
    std::vector<double> values;
    for (int count = 0; count < 60; ++count)
        for (const int steps : {90, 101, 120, 330, 640})
            for (const double top : {0.5, 0.9998, 1.0})
                values.push_back(clips(top, count, steps) ? 1.0 : 0.0);
    checkPinned("linearize/clipping", values);
}

TEST_CASE("Channels that clip or never change are warned of", "[linearize]")
{
    auto clipped = checkedTone(1.0);
    for (float& v : clipped)
        v = std::min(v, 0.4f);
    const std::vector<std::vector<float>> channels{checkedTone(1.0), std::vector<float>(4000, 0.1f), clipped};
    std::vector<MeasurementWarning> warnings;
    warnOfChannels(channels, 100.0, warnings);
    REQUIRE(warnings.size() == 2);
    CHECK(warnings[0] == MeasurementWarning{MeasurementDefect::silentChannel, "channels[1]",
                                            "never changes; check that the axis is connected"});
    const auto found = findClipping(clipped).value();
    CHECK(warnings[1] == MeasurementWarning{MeasurementDefect::clipping, "channels[2]",
                                            std::to_string(found.samples) + " samples at the limit, first at " +
                                                secondsText(static_cast<double>(found.firstFrame) / 100.0) +
                                                "; record or drive at a lower level"});
    CHECK(MeasurementWarning{}.code == MeasurementDefect::lowSnr);
    CHECK(Clipping{}.samples == 0);
    CHECK(Clipping{}.firstFrame == 0);
}
