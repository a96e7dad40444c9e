#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Pinned.h"

#include <pacini/filters/Resampler.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
std::vector<double> goldenInput(std::size_t frames)
{
    std::vector<double> x(frames);
    for (std::size_t i = 0; i < frames; ++i)
    {
        const auto t = static_cast<double>(i);
        x[i] = std::exp(-t / 200.0) * std::sin(0.3 * t) + 0.3 * std::sin(1.7 * t + 1.0) + (i == frames / 2 ? 0.5 : 0.0);
    }
    return x;
}

std::vector<double> sine(double f, int rate, std::size_t frames)
{
    std::vector<double> x(frames);
    for (std::size_t i = 0; i < frames; ++i)
        x[i] = std::sin(2.0 * std::numbers::pi * f * static_cast<double>(i) / rate);
    return x;
}

template <typename Sample>
std::vector<Sample> resampled(const std::vector<Sample>& x, int from, int to)
{
    return resample(std::span<const Sample>(x), from, to).value();
}
} // namespace

TEST_CASE("Resampling equals SciPy's resample_poly", "[filters]")
{
    const auto file = test::golden("resampler");
    for (const auto& c : file["cases"])
    {
        const int from = c["inputRate"];
        const int to = c["outputRate"];
        CAPTURE(from, to);
        const auto x = goldenInput(c["frames"].get<std::size_t>());
        const auto y = resampled(x, from, to);
        const auto yFloat = resampled(std::vector<float>(x.begin(), x.end()), from, to);
        REQUIRE(y.size() == c["outputFrames"].get<std::size_t>());
        REQUIRE(yFloat.size() == y.size());
        const auto expected = c["samples"].get<std::vector<double>>();
        const auto step = c["step"].get<std::size_t>();
        for (std::size_t i = 0; i < expected.size(); ++i)
        {
            CHECK(std::abs(y[i * step] - expected[i]) < 1e-10);
            CHECK(std::abs(static_cast<double>(yFloat[i * step]) - expected[i]) < 2e-6);
        }
    }
}

TEST_CASE("Resampling keeps a sine in the pass band and its phase, and removes one above the new Nyquist frequency",
          "[filters]")
{
    const auto y = resampled(sine(440.0, 44100, 44100), 44100, 8000);
    const auto expected = sine(440.0, 8000, 8000);
    for (std::size_t i = 200; i < 7800; ++i)
        CHECK(std::abs(y[i] - expected[i]) < 3e-3); // ripple of the Kaiser window of shape 5
    const auto gone = resampled(sine(6000.0, 44100, 44100), 44100, 8000);
    for (std::size_t i = 200; i < 7800; ++i)
        CHECK(std::abs(gone[i]) < 3e-3);
}

TEST_CASE("Resampling in pieces equals resampling at once", "[filters]")
{
    Random random(5);
    std::vector<float> x(5000);
    for (float& v : x)
        v = static_cast<float>(random.uniform(-1.0, 1.0));
    for (const auto& [from, to] : {std::pair(44100, 8000), std::pair(8000, 44100), std::pair(8000, 8000)})
    {
        CAPTURE(from, to);
        const auto whole = resampled(x, from, to);
        const Resampler<float> resampler(from, to);
        std::vector<float> pieces(whole.size());
        for (std::size_t begin = 0; begin < whole.size(); begin += 777)
        {
            const auto out = std::span(pieces).subspan(begin, std::min<std::size_t>(777, whole.size() - begin));
            const auto first = std::max<std::int64_t>(resampler.firstInput(begin), 0);
            const auto last = std::min<std::int64_t>(resampler.lastInput(begin + out.size() - 1), 4999);
            if (first <= last)
                resampler.process(std::span<const float>(x).subspan(static_cast<std::size_t>(first),
                                                                    static_cast<std::size_t>(last - first + 1)),
                                  first, begin, out);
        }
        for (std::size_t i = 0; i < whole.size(); ++i)
            CHECK(pieces[i] == Approx(whole[i]).margin(1e-6));
    }
}

TEST_CASE("Equal rates give a copy, an empty signal an empty one, and every length rounds up", "[filters]")
{
    const std::vector<float> x{1.0f, -2.0f, 3.0f};
    CHECK(resampled(x, 12345, 12345) == x);
    CHECK(resampled(std::vector<float>(), 44100, 8000).empty());
    for (std::size_t n = 1; n < 50; ++n)
        CHECK(resampled(std::vector<float>(n, 1.0f), 44100, 8000).size() == (n * 80 + 440) / 441);
}

TEST_CASE("A number that is not finite spoils only the outputs around it", "[filters]")
{
    auto x = sine(300.0, 44100, 44100);
    x[22050] = std::numeric_limits<double>::quiet_NaN();
    const auto y = resampled(x, 44100, 8000);
    std::size_t spoilt = 0;
    for (std::size_t i = 0; i < y.size(); ++i)
    {
        if (!std::isfinite(y[i]))
            ++spoilt;
        CHECK((std::isfinite(y[i]) || (i > 3985 && i < 4015)));
    }
    CHECK(spoilt > 18);
}

TEST_CASE("Rates outside 2 to 768 kHz are refused", "[filters]")
{
    const std::vector<float> x(10);
    for (const auto& [from, to] : {std::pair(0, 8000), std::pair(8000, 0), std::pair(-44100, 8000),
                                   std::pair(1999, 8000), std::pair(8000, 768001)})
    {
        const auto result = resample(std::span<const float>(x), from, to);
        REQUIRE_FALSE(result.ok());
        CHECK(result.error().code == ErrorCode::invalidArgument);
        CHECK(result.error().where == "sampleRate");
    }
    CHECK(resample(std::span<const float>(x), 2000, 768000).ok());
}

TEST_CASE("A resampler knows which inputs an output needs", "[filters]")
{
    const Resampler<double> same(8000, 8000);
    CHECK(same.firstInput(5) == 5);
    CHECK(same.lastInput(5) == 5);
    CHECK(same.outputFrames(7) == 7);
    // Half the rate: 41 taps around every second input, and one of padding before them.
    const Resampler<double> half(8000, 4000);
    CHECK(half.outputFrames(0) == 0);
    CHECK(half.outputFrames(1) == 1);
    CHECK(half.outputFrames(2) == 1);
    CHECK(half.outputFrames(3) == 2);
    std::vector<double> numbers;
    for (const auto& [from, to] :
         {std::pair(44100, 8000), std::pair(8000, 44100), std::pair(48000, 44100), std::pair(2000, 768000)})
    {
        const Resampler<float> resampler(from, to);
        for (const std::size_t n : {0u, 1u, 50u})
        {
            numbers.push_back(static_cast<double>(resampler.firstInput(n)));
            numbers.push_back(static_cast<double>(resampler.lastInput(n)));
        }
        numbers.push_back(static_cast<double>(resampler.outputFrames(1001)));
    }
    checkPinned("filters/resampler, inputs of outputs 1", std::span(numbers).first(14));
    checkPinned("filters/resampler, inputs of outputs 2", std::span(numbers).subspan(14));
}

TEST_CASE("Outside a window a resampler reads zeros, at equal rates too", "[filters]")
{
    const std::vector<double> window{1.0, 2.0, 3.0};
    const Resampler<double> same(4000, 4000);
    std::vector<double> out(6, 9.0);
    same.process(window, 2, 0, out);
    CHECK(out == std::vector<double>{0.0, 0.0, 1.0, 2.0, 3.0, 0.0});
    same.process(window, 2, 3, std::span(out).first(2));
    CHECK(out[0] == 2.0);
    CHECK(out[1] == 3.0);

    const Resampler<double> other(3000, 4000);
    std::vector<double> padded(40, 0.0), expected(50), found(50);
    std::copy(window.begin(), window.end(), padded.begin() + 12);
    other.process(padded, 0, 0, expected);
    other.process(window, 12, 0, found);
    for (std::size_t i = 0; i < found.size(); ++i)
        CHECK(found[i] == Approx(expected[i]).margin(1e-15));
}

TEST_CASE("A rate that cannot be resampled is named with its limits", "[filters]")
{
    CHECK(checkResamplerRate(2000).ok());
    CHECK(checkResamplerRate(768000).ok());
    for (const int rate : {1999, 768001, 0, -48000})
    {
        const auto checked = checkResamplerRate(rate);
        REQUIRE_FALSE(checked.ok());
        CHECK(checked.error().code == ErrorCode::invalidArgument);
        CHECK(checked.error().text() == "sampleRate: is " + std::to_string(rate) + " Hz, outside 2000 to 768000 Hz");
        const std::vector<double> x(10, 1.0);
        CHECK(resample(std::span<const double>(x), rate, 8000).error().text() == checked.error().text());
        CHECK(resample(std::span<const double>(x), 8000, rate).error().text() == checked.error().text());
    }
}

TEST_CASE("Outputs that are made together are those made one by one", "[resampler]")
{
    Random random(7);
    std::vector<float> x(3000);
    for (float& v : x)
        v = static_cast<float>(random.uniform() - 0.5);
    for (const auto& [from, to] : {std::pair(44100, 48000), std::pair(44100, 4000), std::pair(48000, 8000),
                                   std::pair(8000, 48000), std::pair(48000, 48000), std::pair(11025, 8000)})
    {
        const Resampler<float> resampler(from, to);
        std::vector<float> together(resampler.outputFrames(x.size()));
        resampler.process(x, 0, 0, together);
        std::vector<float> single(together.size());
        for (std::size_t i = 0; i < single.size(); ++i)
            resampler.process(x, 0, i, std::span(single).subspan(i, 1));
        CAPTURE(from, to);
        CHECK(together == single);
    }
}
