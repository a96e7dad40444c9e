#include "support/Catch.h"

#include <pacini/evaluate/match/FeltImpression.h>
#include <pacini/evaluate/match/MatchLag.h>
#include <pacini/evaluate/match/MatchParts.h>
#include <pacini/foundation/Gaussian.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

using namespace pacini;

namespace
{
constexpr double seconds = 3.0;

std::vector<float> signal(int rate, const std::function<double(double)>& of)
{
    std::vector<float> x(static_cast<std::size_t>(seconds * rate));
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = static_cast<float>(of(static_cast<double>(i) / rate));
    return x;
}

double tone(double hertz, double t)
{
    return std::sin(2.0 * std::numbers::pi * hertz * t);
}

/// Five blows a second that fade within 50 ms; the first at .1 s.
double blows(double t)
{
    return t < 0.1 ? 0.0 : std::exp(-std::fmod(t - 0.1, 0.2) / 0.015);
}

MatchParts partsOf(const std::vector<float>& sound, const std::vector<float>& vibration)
{
    TouchAnalyzer touch;
    return matchParts(heardTrack(sound, 44100).value(), touchTrack(touch, vibration, 8000).value());
}

const auto clicks = signal(44100, [](double t) { return 0.5 * blows(t) * tone(3000.0, t); });
const auto pulses = signal(8000, [](double t) { return blows(t) * tone(150.0, t); });
} // namespace

TEST_CASE("Blows that are felt as they are heard match, a steady hum does not", "[match]")
{
    const auto together = partsOf(clicks, pulses);
    CHECK(together.attacks > 0.9);
    CHECK(together.envelope > 0.6);
    const auto hum = partsOf(clicks, signal(8000, [](double t) { return 0.5 * tone(150.0, t); }));
    CHECK(hum.attacks < 0.15);
    CHECK(hum.envelope < 0.3);
    CHECK(predictedMatch(together) > predictedMatch(hum) + 25.0);
}

TEST_CASE("Blows that come late match less, the later the less", "[match]")
{
    const auto late = [](double delay)
    {
        return partsOf(clicks, signal(8000, [delay](double t) { return blows(t - delay) * tone(150.0, t); })).attacks;
    };
    CHECK(late(0.0) > late(0.015));
    CHECK(late(0.015) > late(0.03) + 0.1);
    CHECK(late(0.06) < 0.3);
}

TEST_CASE("The lag of a vibration is found within 5 ms, and without it the match is what it was, or better", "[match]")
{
    TouchAnalyzer touch;
    // Unevenly spaced: nothing but the lag itself brings them together.
    const std::vector<double> times{0.2, 0.31, 0.6, 1.05, 1.28, 1.9, 2.3, 2.38};
    const auto hits = [&](double t)
    {
        double sum = 0.0;
        for (const double at : times)
            sum += t < at ? 0.0 : std::exp(-(t - at) / 0.015);
        return sum;
    };
    const auto heard =
        heardTrack(signal(44100, [&](double t) { return 0.3 * hits(t) * tone(3000.0, t); }), 44100).value();
    const auto feltAt = [&](double delay)
    {
        return touchTrack(touch, signal(8000, [&](double t) { return hits(t - delay) * tone(150.0, t); }), 8000)
            .value();
    };
    const auto together = matchParts(heard, feltAt(0.0));
    CHECK(std::abs(matchLag(heard, feltAt(0.0))) <= 1);
    for (const double delay : {-0.09, -0.03, 0.02, 0.05, 0.095})
    {
        CAPTURE(delay);
        const auto felt = feltAt(delay);
        const int late = matchLag(heard, felt);
        CHECK(std::abs(late / TouchTrack::rate - delay) <= 0.0051);
        const auto parts = matchParts(heard, earlier(felt, late));
        CHECK(parts.attacks > together.attacks - 0.02);
        CHECK(parts.envelope == Approx(together.envelope).margin(0.03));
        CHECK(parts.movement == Approx(together.movement).margin(0.05));
    }
    // Farther away than 100 ms nothing is said, nor of what does not move, is too short or is not there.
    CHECK(std::abs(matchLag(heard, feltAt(0.25))) <= 50);
    const auto hum = touchTrack(touch, signal(8000, [](double t) { return tone(150.0, t); }), 8000).value();
    CHECK(matchLag(heard, hum) == 0);
    CHECK(matchLag(heard, TouchTrack{}) == 0);
    CHECK(matchLag(HeardTrack{}, hum) == 0);
    CHECK(matchLag(HeardTrack{std::vector<float>(90, 1.0f), std::vector<float>(90, 1.0f)}, hum) == 0);
}

TEST_CASE("Neither level nor polarity of either side changes the match", "[match]")
{
    const auto plain = partsOf(clicks, pulses);
    const auto scaled = [](std::vector<float> x, float gain)
    {
        for (float& v : x)
            v *= gain;
        return x;
    };
    for (const float gain : {1e-3f, -0.25f, 30.0f})
    {
        const auto other = partsOf(scaled(clicks, gain), scaled(pulses, gain));
        CHECK(other.attacks == Approx(plain.attacks).margin(1e-4));
        CHECK(other.envelope == Approx(plain.envelope).margin(1e-4));
        CHECK(other.roughness == Approx(plain.roughness).margin(1e-4));
        CHECK(other.brightness == Approx(plain.brightness).margin(1e-3));
        CHECK(other.movement == Approx(plain.movement).margin(1e-3));
        CHECK(other.silence == Approx(plain.silence).margin(1e-4));
    }
}

TEST_CASE("A felt frequency that rises with the sound has its brightness, a falling one has not", "[match]")
{
    const auto sweep = [](double from, double octavesPerSecond, int rate)
    {
        const double k = octavesPerSecond * std::numbers::ln2;
        return signal(rate,
                      [=](double t) { return 0.5 * std::sin(2.0 * std::numbers::pi * from * std::expm1(k * t) / k); });
    };
    const auto rising = sweep(800.0, 1.0, 44100);
    const auto with = partsOf(rising, sweep(60.0, 0.7, 8000));
    CHECK(with.brightness > 0.9);
    CHECK(with.movement == Approx(0.6).margin(0.15)); // of a uniform course over 2.1 octaves
    CHECK(partsOf(rising, sweep(260.0, -0.7, 8000)).brightness == 0.0);
    const auto still = partsOf(rising, signal(8000, [](double t) { return tone(150.0, t); }));
    CHECK(still.movement < 0.03);
    CHECK(still.brightness < 0.3);
}

TEST_CASE("A rough sound is matched by a rough vibration", "[match]")
{
    const auto rough = [](int rate, double carrier, double hertz, double depth)
    {
        return signal(rate, [=](double t) { return (1.0 + depth * tone(hertz, t)) * 0.4 * tone(carrier, t); });
    };
    const auto sound = rough(44100, 1000.0, 45.0, 1.0);
    const auto matching = partsOf(sound, rough(8000, 180.0, 45.0, 0.6)).roughness;
    CHECK(matching > 0.6);
    CHECK(matching > partsOf(sound, rough(8000, 180.0, 45.0, 0.0)).roughness + 0.3);
}

TEST_CASE("What is felt in silence is told", "[match]")
{
    const auto burst = signal(44100, [](double t) { return t < 1.5 ? 0.5 * tone(500.0, t) : 0.0; });
    CHECK(partsOf(burst, signal(8000, [](double t) { return t < 1.5 ? tone(150.0, t) : 0.0; })).silence > 0.95);
    CHECK(partsOf(burst, signal(8000, [](double t) { return tone(150.0, t); })).silence < 0.1);
    CHECK(partsOf(clicks, {}).silence == 0.0);
}

TEST_CASE("Silence on either side has no parts; the length of the sound counts", "[match]")
{
    const std::vector<float> silence(8000);
    CHECK(partsOf(clicks, silence) == MatchParts{});
    CHECK(partsOf(std::vector<float>(44100), pulses) == MatchParts{});
    CHECK(partsOf({}, {}) == MatchParts{});
    auto half = pulses;
    half.resize(half.size() / 2);
    CHECK(partsOf(clicks, half).attacks < partsOf(clicks, pulses).attacks - 0.2);
    auto longer = pulses;
    longer.insert(longer.end(), pulses.begin(), pulses.end());
    CHECK(partsOf(clicks, longer).attacks == Approx(partsOf(clicks, pulses).attacks).margin(0.01));
}

TEST_CASE("The match is a number whatever comes in", "[match]")
{
    Gaussian gaussian(3);
    auto noise = signal(8000, [&](double) { return 0.3 * gaussian.next(); });
    noise[5] = std::numeric_limits<float>::quiet_NaN();
    noise[6000] = -std::numeric_limits<float>::infinity();
    const auto constant = signal(8000, [](double) { return 1.0; });
    for (const auto& vibration : {noise, constant, std::vector<float>{1.0f}, std::vector<float>(9, 1e30f)})
        for (const auto& sound : {clicks, signal(44100, [](double) { return 1.0; }), std::vector<float>{1.0f, 0.0f}})
        {
            const auto parts = partsOf(sound, vibration);
            for (const double part :
                 {parts.attacks, parts.envelope, parts.roughness, parts.brightness, parts.movement, parts.silence})
            {
                CHECK(part >= 0.0);
                CHECK(part <= 1.0 + 1e-9);
            }
        }
    TouchAnalyzer touch;
    CHECK(heardTrack(clicks, 100).error().code == ErrorCode::invalidArgument);
    CHECK(touchTrack(touch, pulses, 100).error().code == ErrorCode::invalidArgument);
    for (const int rate : {8000, 44100, 192000})
        CHECK(heardTrack(clicks, rate).ok());
}

TEST_CASE("A vibration feels stronger when it is, faster with more pulses, rougher when it beats", "[match]")
{
    TouchAnalyzer touch;
    const auto figuresOf = [&](const std::vector<float>& x)
    {
        return feltFigures(touchTrack(touch, x, 8000).value());
    };
    const auto pulsed = [](double perSecond, double level)
    {
        return signal(8000, [=](double t)
                      { return level * std::exp(-std::fmod(t + 0.05, 1.0 / perSecond) / 0.02) * tone(150.0, t); });
    };
    const auto slow = figuresOf(pulsed(2.0, 0.8));
    CHECK(slow.pulses == Approx(2.0).margin(0.4));
    const auto fast = figuresOf(pulsed(6.0, 0.8));
    CHECK(fast.pulses == Approx(6.0).margin(0.4));
    CHECK(feltImpression(fast).tempo > feltImpression(slow).tempo + 0.5);
    const auto weak = figuresOf(pulsed(2.0, 0.2));
    CHECK(slow.level - weak.level == Approx(std::log(4.0)).margin(0.05));
    CHECK(feltImpression(slow).strength > feltImpression(weak).strength + 1.0);
    const auto steady = signal(8000, [](double t) { return 0.5 * tone(150.0, t); });
    const auto beating = signal(8000, [](double t) { return 0.5 * tone(150.0, t) * (1.0 + 0.9 * tone(40.0, t)); });
    CHECK(figuresOf(steady).octave == Approx(std::log2(150.0)).margin(0.1));
    CHECK(feltImpression(figuresOf(beating)).roughness > feltImpression(figuresOf(steady)).roughness + 0.5);
    CHECK(figuresOf(steady).pulses <= 0.4);
}

TEST_CASE("What is not felt makes no impression", "[match]")
{
    TouchAnalyzer touch;
    for (const auto& x : {std::vector<float>{}, std::vector<float>(8000)})
    {
        const auto figures = feltFigures(touchTrack(touch, x, 8000).value());
        CHECK(figures == FeltFigures{});
        CHECK(feltImpression(figures).strength == -3.0);
        CHECK(feltImpression(figures).tempo == -3.0);
        CHECK(feltImpression(figures).roughness == -3.0);
    }
    const auto huge = feltImpression(feltFigures(touchTrack(touch, std::vector<float>(100, 1e30f), 8000).value()));
    CHECK((huge.strength >= -3.0 && huge.strength <= 3.0));
    CHECK((huge.roughness >= -3.0 && huge.roughness <= 3.0));
}
