#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/analysis/CurveFitter.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace pacini;

namespace
{

constexpr double step = 0.02;
constexpr double quiet = 0.005; ///< floor of amplitudes

/// The values of the polygon through `vertices` at n samples, one every `step`.
std::vector<double> sampled(const Curve& vertices, std::size_t n)
{
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i)
        values.push_back(valueAt(vertices, step * static_cast<double>(i)));
    return values;
}

std::vector<float> floats(const std::vector<double>& values)
{
    return {values.begin(), values.end()};
}

/// The error that CurveFitter minimises for amplitudes, in dB^2.
double errorOf(const Curve& curve, const std::vector<float>& track)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < track.size(); ++i)
    {
        const auto a = static_cast<double>(track[i]);
        const double error = (valueAt(curve, step * static_cast<double>(i)) - a) * 8.685889638065035;
        sum += error * error / (a * a + quiet * quiet);
    }
    return sum;
}

std::vector<float> wanderingTrack(std::size_t n, std::uint64_t seed)
{
    Random random(seed);
    std::vector<float> track(n);
    double level = 0.3;
    for (float& v : track)
    {
        level = std::clamp(level * std::exp(random.uniform(-0.3, 0.3)), 0.01, 1.0);
        v = static_cast<float>(level);
    }
    return track;
}

} // namespace

TEST_CASE("A track of straight lines becomes their corners", "[analysis]")
{
    const Curve corners{{0.0, 0.1}, {0.4, 0.8}, {1.0, 0.3}, {1.2, 0.9}, {2.0, 0.2}};
    CurveFitter fitter;
    const Curve curve = fitter.fitAmplitude(floats(sampled(corners, 101)), step, 1.0, quiet, 1.0);
    REQUIRE(curve.size() == corners.size());
    for (std::size_t i = 0; i < curve.size(); ++i)
    {
        CHECK(curve[i].time == Approx(corners[i].time).margin(1e-9));
        CHECK(curve[i].value == Approx(corners[i].value).epsilon(1e-4));
    }
}

TEST_CASE("Every point of a fitted curve is worth its price", "[analysis]")
{
    CurveFitter fitter;
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
    {
        const auto track = wanderingTrack(200, seed);
        std::size_t before = track.size();
        double errorBefore = -1.0;
        for (const double price : {0.1, 1.0, 10.0, 100.0, 1000.0, 1e7})
        {
            const Curve curve = fitter.fitAmplitude(track, step, 1.0, quiet, price);
            const double error = errorOf(curve, track);
            CAPTURE(seed, price, curve.size(), error);
            CHECK(curve.size() <= before);
            CHECK(error >= errorBefore * 0.999);
            before = curve.size();
            errorBefore = error;
            // Neither with all samples nor without a point is it better.
            const double cost = error + price * static_cast<double>(curve.size());
            CHECK(cost <= price * static_cast<double>(track.size()) + 1e-6);
            for (std::size_t i = 1; i + 1 < curve.size(); ++i)
            {
                Curve fewer = curve;
                fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
                // Values that were fitted again may make up for half a point.
                REQUIRE(errorOf(fewer, track) + price * static_cast<double>(fewer.size()) >= cost - 0.5 * price);
            }
        }
        CHECK(before == 2);
    }
}

TEST_CASE("Amplitudes are scaled by the gain, and what nobody feels becomes nothing", "[analysis]")
{
    CurveFitter fitter;
    const auto track = wanderingTrack(100, 3);
    auto doubled = track;
    for (float& v : doubled)
        v *= 2.0f;
    CHECK((fitter.fitAmplitude(track, step, 2.0, quiet, 5.0) == fitter.fitAmplitude(doubled, step, 1.0, quiet, 5.0)));
    CHECK(fitter.fitAmplitude(std::vector<float>(100, 0.0f), step, 1.0, quiet, 5.0).empty());
    CHECK(fitter.fitAmplitude(std::vector<float>(100, 0.00124f), step, 1.0, quiet, 5.0).empty());
    CHECK(!fitter.fitAmplitude(std::vector<float>(100, 0.00126f), step, 1.0, quiet, 5.0).empty());
    CHECK(fitter.fitAmplitude({}, step, 1.0, quiet, 5.0).empty());
    CHECK(fitter.fitAmplitude(std::vector<float>(1, 0.5f), step, 1.0, quiet, 5.0) == Curve{{0.0, 0.5}});
    // A tail below the floor ends at 0.
    std::vector<float> tail(100, 0.0005f);
    std::fill(tail.begin(), tail.begin() + 20, 0.5f);
    CHECK(fitter.fitAmplitude(tail, step, 1.0, quiet, 5.0).back().value == 0.0);
}

TEST_CASE("A pitch is one point unless its movement is worth more", "[analysis]")
{
    CurveFitter fitter;
    const std::vector<double> all(100, 1.0);
    const std::vector<double> constant(100, 80.0);
    const Curve one = fitter.fitPitch(constant, all, step, 20.0);
    REQUIRE(one.size() == 1);
    CHECK(one[0].time == 0.0);
    CHECK(one[0].value == Approx(80.0));

    // An octave up in 2 s: worth it for little, not for much.
    const auto glide = sampled({{0.0, 80.0}, {2.0, 160.0}}, 100);
    const Curve cheap = fitter.fitPitch(glide, all, step, 20.0);
    REQUIRE(cheap.size() >= 2);
    CHECK(cheap.front().value == Approx(80.0).epsilon(0.01));
    CHECK(cheap.back().value == Approx(159.2).epsilon(0.01));
    CHECK(fitter.fitPitch(glide, all, step, 1e5).size() == 1);
}

TEST_CASE("Only what is important has a say in a pitch", "[analysis]")
{
    CurveFitter fitter;
    std::vector<double> track(100, 80.0);
    std::vector<double> importance(100, 1.0);
    for (std::size_t i = 40; i < 60; ++i)
    {
        track[i] = 300.0;
        importance[i] = 0.0;
    }
    const Curve curve = fitter.fitPitch(track, importance, step, 20.0);
    REQUIRE(curve.size() == 1);
    CHECK(curve[0].value == Approx(80.0));
    CHECK(fitter.fitPitch(track, std::vector<double>(100, 0.0), step, 20.0).empty());
    CHECK(fitter.fitPitch({}, {}, step, 20.0).empty());
    // Errors count in semitones: the mean of 50 and 200 Hz lies nearer the lower one.
    std::vector<double> two(100, 50.0);
    std::fill(two.begin() + 50, two.end(), 200.0);
    const Curve mean = fitter.fitPitch(two, std::vector<double>(100, 1.0), step, 1e9);
    REQUIRE(mean.size() == 1);
    CHECK(mean[0].value == Approx((50.0 / 2500.0 + 200.0 / 40000.0) / (1.0 / 2500.0 + 1.0 / 40000.0)));
}

TEST_CASE("A pitch curve keeps its last value where nothing is important", "[analysis]")
{
    std::vector<double> track(200, 150.0), importance(200, 0.0);
    for (std::size_t i = 0; i < 60; ++i)
    {
        track[i] = 600.0 - 7.5 * static_cast<double>(i);
        importance[i] = 1.0;
    }
    CurveFitter fitter;
    const Curve curve = fitter.fitPitch(track, importance, 0.06, 20.0);
    REQUIRE(curve.size() >= 3);
    for (double t = 4.0; t < 12.0; t += 0.5)
        CHECK(valueAt(curve, t) == Approx(150.0).epsilon(0.1));
}

TEST_CASE("Curves fitted at any price are what they were", "[analysis]")
{
    CurveFitter fitter;
    for (const double price : {0.1, 5.0, 25.0, 400.0})
    {
        const std::string name = "analysis/curve at price " + std::to_string(price);
        const auto pin = [&name](const std::string& of, const Curve& curve)
        {
            checkPinnedCurve(name, of, curve, 1e-6);
        };
        pin("amplitudes", fitter.fitAmplitude(wanderingTrack(90, 3), step, 1.0, quiet, price));
        pin("raised amplitudes", fitter.fitAmplitude(wanderingTrack(70, 4), step, 0.05, 0.01, price));
        std::vector<double> track, importance;
        Random random(9);
        for (int i = 0; i < 60; ++i)
        {
            track.push_back(200.0 * std::exp(random.uniform(-0.3, 0.3) + 0.5 * std::sin(0.2 * i)));
            importance.push_back(i > 40 ? 0.0 : random.uniform(0.0, 1.0));
        }
        pin("pitches", fitter.fitPitch(track, importance, 3.0 * step, price));
    }
    // One point where nothing else is worth it: the mean, weighted by importance over squared frequency.
    const std::vector<double> two{100.0, 200.0};
    const auto mean = [&](std::vector<double> importance)
    {
        const Curve curve = fitter.fitPitch(two, importance, step, 1e-9);
        REQUIRE(curve.size() == 1);
        CHECK(curve.front().time == 0.0);
        return curve.front().value;
    };
    CHECK(mean({1.0, 1.0}) == Approx((1.0 / 100.0 + 1.0 / 200.0) / (1e-4 + 0.25e-4)));
    CHECK(mean({0.0, 0.5}) == Approx((1e-4 / 100.0 + 1.0 / 200.0) / (1e-8 + 0.25e-4)));
    CHECK(fitter.fitPitch(two, std::vector<double>{0.0, 0.0}, step, 1.0).empty());
    // A quarter of the floor is the least that is felt.
    CHECK(fitter.fitAmplitude(std::vector<float>(5, 0.24f), step, 1.0, 1.0, 1.0).empty());
    CHECK(fitter.fitAmplitude(std::vector<float>(5, 0.25f), step, 1.0, 1.0, 1.0).size() == 2);
    CHECK(fitter.fitAmplitude(std::vector<float>(5, 0.25f), step, 0.99, 1.0, 1.0).empty());
    CHECK(fitter.fitAmplitude({}, step, 1.0, 1.0, 1.0).empty());
}
