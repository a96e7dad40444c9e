// Dynamic compensation with a sensor that may lie: it holds what it has.

#include "support/Catch.h"
#include "support/HeapGuard.h"

#include <pacini/actuator/DynamicCompensation.h>
#include <pacini/foundation/Gaussian.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
/// A wearer whose strap takes `loss` dB, with a sensor that what() may replace.
struct WornLoop
{
    explicit WornLoop(double time = 2.0, double toldDelay = 0.02, double rate = 4000.0) : fs(rate)
    {
        DynamicCompensationParams params;
        params.bands = 6;
        params.time = Seconds(time);
        params.delay = Seconds(toldDelay);
        params.needsEvidence = true;
        compensation.setParams(params);
        compensation.prepare({fs, block});
        line.assign(static_cast<std::size_t>(0.02 * fs), 0.0f);
    }

    using Sensor = std::function<float(float felt, std::size_t frame)>;

    void play(double seconds, double loss, const Sensor& sensor = {})
    {
        const auto factor = static_cast<float>(0.5 * std::pow(10.0, -loss / 20.0));
        std::vector<float> x(block), y(block), back(block);
        for (std::size_t b = 0; b < static_cast<std::size_t>(seconds * fs / double(block)); ++b)
        {
            for (float& v : x)
            {
                // Sounds like steps: loud for a quarter of a second, soft for another.
                const double level = frame / static_cast<std::size_t>(0.25 * fs) % 2 == 0 ? 0.1 : 0.01;
                v = static_cast<float>(level * noise.next());
                ++frame;
            }
            compensation.process(x, y);
            for (std::size_t i = 0; i < block; ++i)
            {
                const float felt = line[place] + static_cast<float>(1e-4 * own.next());
                line[place] = factor * y[i];
                place = (place + 1) % line.size();
                back[i] = sensor ? sensor(felt, frame + i) : felt;
            }
            compensation.learn(y, back);
        }
    }

    [[nodiscard]] std::vector<double> gains() const
    {
        std::vector<double> all;
        for (std::size_t k = 0; k < compensation.frequencies().size(); ++k)
            all.push_back(compensation.gain(k));
        return all;
    }

    [[nodiscard]] double mean() const
    {
        double sum = 0.0;
        for (const double gain : gains())
            sum += gain / static_cast<double>(gains().size());
        return sum;
    }

    static constexpr std::size_t block = 20;
    double fs;
    DynamicCompensation compensation;
    Gaussian noise{3}, own{4};
    std::vector<float> line;
    std::size_t place = 0, frame = 0;
};
} // namespace

TEST_CASE("With evidence a tightened strap is followed as without", "[actuator][sensor]")
{
    WornLoop loop;
    loop.play(12.0, 0.0);
    CHECK(loop.mean() == Approx(0.0).margin(0.5));
    CHECK(loop.compensation.sensor() == SensorState::good);
    loop.play(20.0, 6.0);
    CHECK(loop.mean() == Approx(6.0).margin(0.6));
    loop.play(20.0, -3.0);
    CHECK(loop.mean() == Approx(-3.0).margin(0.6));
}

TEST_CASE("A sensor that is dead, saturated, unplugged or no number holds the last good gains", "[actuator][sensor]")
{
    Gaussian hiss(9);
    const auto sine = [](double f, double level)
    {
        return [f, level](float, std::size_t n)
        {
            return static_cast<float>(level * std::sin(2.0 * std::numbers::pi * f * static_cast<double>(n) / 4000.0));
        };
    };
    const std::pair<const char*, WornLoop::Sensor> sensors[] = {{"dead",
                                                                 [](float, std::size_t)
                                                                 {
                                                                     return 0.0f;
                                                                 }},
                                                                {"stuck",
                                                                 [](float, std::size_t)
                                                                 {
                                                                     return 0.3f;
                                                                 }},
                                                                {"saturated",
                                                                 [](float felt, std::size_t)
                                                                 {
                                                                     return felt > 0.0f ? 1.0f : -1.0f;
                                                                 }},
                                                                {"not a number",
                                                                 [](float, std::size_t)
                                                                 {
                                                                     return std::numeric_limits<float>::quiet_NaN();
                                                                 }},
                                                                {"sometimes no number",
                                                                 [](float felt, std::size_t n)
                                                                 {
                                                                     return n % 997 == 0
                                                                                ? std::numeric_limits<float>::infinity()
                                                                                : felt * 0.1f;
                                                                 }},
                                                                {"unplugged, soft noise",
                                                                 [&](float, std::size_t)
                                                                 {
                                                                     return static_cast<float>(1e-4 * hiss.next());
                                                                 }},
                                                                {"unplugged, loud noise",
                                                                 [&](float, std::size_t)
                                                                 {
                                                                     return static_cast<float>(0.05 * hiss.next());
                                                                 }},
                                                                {"unplugged, soft hum", sine(50.0, 1e-3)},
                                                                {"unplugged, loud hum", sine(150.0, 0.5)}};
    for (const auto& [what, sensor] : sensors)
    {
        INFO(what);
        WornLoop loop;
        loop.play(12.0, 0.0);
        loop.play(15.0, 4.0);
        const auto before = loop.gains();
        CHECK(loop.mean() == Approx(4.0).margin(0.8));
        loop.play(60.0, 4.0, sensor);
        CHECK(loop.compensation.sensor() != SensorState::good);
        const auto after = loop.gains();
        for (std::size_t k = 0; k < before.size(); ++k)
            CHECK(after[k] == Approx(before[k]).margin(1.0)); // what is moved until it is noticed
        // And it goes on when it is plugged in again.
        loop.play(25.0, 0.0);
        CHECK(loop.compensation.sensor() == SensorState::good);
        CHECK(loop.mean() == Approx(0.0).margin(0.7));
    }
}

TEST_CASE("A band that is held glides back: neither its gain nor the drive steps", "[actuator][sensor]")
{
    constexpr double fs = 8000.0;
    DynamicCompensationParams params;
    params.bands = 6;
    params.time = Seconds(2.0);
    params.target = Decibels(0.0);
    params.needsEvidence = true;
    DynamicCompensation compensation;
    compensation.setParams(params);
    compensation.prepare({fs, 80});
    Gaussian hiss(9);
    std::vector<float> x(80), y(80), back(80);
    std::array<double, 4> differences{}; // of the drive: of a slow tone next to nothing is left, of a step all
    double usualStep = 0.0, laterStep = 0.0, usualClick = 0.0, laterClick = 0.0, returned = 0.0;
    std::vector<double> gains(compensation.frequencies().size()), good, misled;
    std::size_t frame = 0;
    constexpr int unplugged = 3000, fading = 3050; // hops; until then evidence is left, and gains follow a lie
    for (int hop = 0; hop < 5000; ++hop)
    {
        for (float& v : x)
        {
            const double t = static_cast<double>(frame++) / fs;
            v = static_cast<float>(0.3 * std::sin(2.0 * std::numbers::pi * 150.0 * t) *
                                   (0.55 + 0.45 * std::sin(2.0 * std::numbers::pi * 0.7 * t)));
        }
        compensation.process(x, y);
        double click = 0.0;
        for (std::size_t i = 0; i < y.size(); ++i)
        {
            back[i] = hop < unplugged ? 0.5f * y[i] : static_cast<float>(0.2 * hiss.next());
            double newest = static_cast<double>(y[i]);
            for (double& before : differences)
                newest -= std::exchange(before, newest);
            click = std::max(click, std::abs(newest));
        }
        if (hop < 10)
            continue; // the differences begin
        compensation.learn(y, back);
        double step = 0.0;
        for (std::size_t k = 0; k < gains.size(); ++k)
            step = std::max(step, std::abs(compensation.gain(k) - std::exchange(gains[k], compensation.gain(k))));
        if (hop == unplugged)
            good = gains;
        if (hop == fading + 50)
            misled = gains;
        double& largest = hop < fading ? usualStep : laterStep;
        largest = std::max(largest, step);
        double& loudest = hop < fading ? usualClick : laterClick;
        loudest = std::max(loudest, click);
    }
    for (std::size_t k = 0; k < gains.size(); ++k)
    {
        returned = std::max(returned, std::abs(gains[k] - misled[k]));
        CHECK(gains[k] == Approx(good[k]).margin(1.0));
    }
    CAPTURE(usualStep, laterStep, usualClick, laterClick);
    CHECK(returned > 1.0); // there was something to glide back
    CHECK(laterStep <= 2.0 * usualStep);
    CHECK(laterClick <= 2.0 * usualClick);
}

TEST_CASE("Feedback that was never there raises nothing, from the first second on", "[actuator][sensor]")
{
    Gaussian hiss(9);
    for (const double level : {0.0, 1e-6, 1e-3, 0.3})
    {
        WornLoop loop;
        loop.play(60.0, 0.0, [&](float, std::size_t) { return static_cast<float>(level * hiss.next()); });
        for (const double gain : loop.gains())
            CHECK(std::abs(gain) < 0.8);
    }
    // A target that cannot be reached by noise is not reached for.
    WornLoop loop;
    DynamicCompensationParams params;
    params.bands = 6;
    params.needsEvidence = true;
    params.target = Decibels(20.0);
    loop.compensation.setParams(params);
    loop.compensation.reset();
    loop.play(60.0, 0.0, [&](float, std::size_t) { return static_cast<float>(1e-3 * hiss.next()); });
    for (const double gain : loop.gains())
        CHECK(gain < 1.5);
}

TEST_CASE("A steady tone says nothing after a while, and is held", "[actuator][sensor]")
{
    DynamicCompensationParams params;
    params.needsEvidence = true;
    params.target = Decibels(3.0);
    params.time = Seconds(2.0);
    DynamicCompensation compensation;
    compensation.setParams(params);
    compensation.prepare({4000.0, 40});
    std::vector<float> x(40), y(40), back(40);
    const auto play = [&](int seconds, float factor)
    {
        for (std::size_t n = 0; n < 4000u * static_cast<unsigned>(seconds); n += 40)
        {
            for (std::size_t i = 0; i < 40; ++i)
                x[i] = static_cast<float>(0.3 * std::sin(2.0 * std::numbers::pi * 0.025 * static_cast<double>(n + i)));
            compensation.process(x, y);
            std::transform(y.begin(), y.end(), back.begin(), [factor](float v) { return factor * v; });
            compensation.learn(y, back);
        }
    };
    play(60, 1.0f);
    std::vector<double> gains;
    for (std::size_t k = 0; k < compensation.frequencies().size(); ++k)
        gains.push_back(compensation.gain(k));
    play(60, 0.99f); // a drift
    for (std::size_t k = 0; k < gains.size(); ++k)
        CHECK(compensation.gain(k) == Approx(gains[k]).margin(0.2));
    CHECK(compensation.sensor() == SensorState::apart);
}

TEST_CASE("At every delay and gain, told right or wrong, gains end within their limit", "[actuator][sensor][stability]")
{
    for (const double told : {0.0, 0.02, 0.3, 1.0})
        for (const double loss : {-40.0, -8.0, 0.0, 8.0, 40.0})
            for (const double time : {0.0, 2.0, std::numeric_limits<double>::quiet_NaN()})
            {
                INFO("told " << told << ", loss " << loss << ", time " << time);
                WornLoop loop(time, told);
                loop.play(8.0, 0.0);
                loop.play(30.0, loss);
                const auto settled = loop.gains();
                for (const double gain : settled)
                    CHECK(std::abs(gain) <= 12.0 + 1e-9);
                loop.play(10.0, loss);
                const auto later = loop.gains();
                for (std::size_t k = 0; k < settled.size(); ++k)
                    CHECK(std::abs(later[k] - settled[k]) < 1.5); // no swinging
            }
}

TEST_CASE("Learning takes no memory", "[actuator][sensor]")
{
    WornLoop loop;
    std::vector<float> x(480, 0.1f), y(480);
    const test::HeapGuard guard;
    for (int i = 0; i < 100; ++i)
    {
        loop.compensation.process(x, y);
        loop.compensation.learn(y, x);
    }
    CHECK(guard.traffic() == 0);
}
