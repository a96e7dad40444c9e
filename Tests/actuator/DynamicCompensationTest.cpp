// Dynamic compensation: what it follows, how well, how fast, and that nothing makes it unstable.

#include "support/BlockContract.h"
#include "support/Catch.h"

#include <pacini/actuator/DynamicCompensation.h>
#include <pacini/actuator/TighteningStrap.h>
#include <pacini/foundation/Gaussian.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <deque>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
constexpr std::size_t blockFrames = 16;

/// A compensator with an actuator behind it that gives its acceleration back after `delay` s, a block later at the
/// earliest.
class Loop
{
public:
    using Actuator = std::function<void(std::span<const float>, std::span<float>)>;

    Loop(const DynamicCompensationParams& params, double rate, double delay, Actuator actuatorToUse)
        : fs(rate),
          actuator(std::move(actuatorToUse)),
          x(blockFrames),
          y(blockFrames),
          a(blockFrames),
          back(blockFrames)
    {
        compensation.setParams(params);
        compensation.prepare({rate, blockFrames});
        line.assign(static_cast<std::size_t>(std::max(0.0, std::round(delay * rate) - double(blockFrames))), 0.0f);
    }

    /// Plays noise for `seconds`; checks that everything is finite and gains stay within their limit.
    void play(double seconds, double limit = 12.0)
    {
        const auto blocks = static_cast<std::size_t>(seconds * fs / double(blockFrames));
        for (std::size_t b = 0; b < blocks; ++b)
        {
            for (float& v : x)
                v = level * static_cast<float>(noise.next());
            compensation.process(x, back, y);
            actuator(y, a);
            for (std::size_t i = 0; i < blockFrames; ++i)
            {
                line.push_back(a[i]);
                back[i] = line.front();
                line.pop_front();
                largest = std::max(largest, std::abs(y[i]));
            }
        }
        for (std::size_t k = 0; k < compensation.frequencies().size(); ++k)
            CHECK(std::abs(compensation.gain(k)) <= limit + 1e-9);
        double most = 0.0;
        for (double f = 5.0; f < 0.49 * fs; f *= 1.01)
            most = std::max(most, Decibels::fromGain(std::abs(compensation.response(Hertz(f)))).value);
        CHECK(most <= 1.03 * limit + 0.5);
        CHECK(std::isfinite(largest));
    }

    [[nodiscard]] std::vector<double> gains() const
    {
        std::vector<double> all;
        for (std::size_t k = 0; k < compensation.frequencies().size(); ++k)
            all.push_back(compensation.gain(k));
        return all;
    }

    DynamicCompensation compensation;
    float level = 0.1f;
    float largest = 0.0f;

private:
    double fs;
    Actuator actuator;
    Gaussian noise{1};
    std::vector<float> x, y, a, back;
    std::deque<float> line;
};

TighteningStrapParams wristband()
{
    TighteningStrapParams params;
    params.loose = {1.342, 0.012, 0.04, 40000.0, 5.0, 0.01, 800.0, 2.5};
    params.tight = tightened(params.loose, 3.5);
    params.resonance = {67.0, 3.97};
    params.tightResonance = {74.0, 2.8};
    params.start = 15.0;
    params.length = 5.0;
    return params;
}

/// RMS of what the strap and the compensation changed, dB, from 40 to 640 Hz.
double changeOf(const TighteningStrapParams& strap, const DynamicCompensation* compensation)
{
    double sum = 0.0;
    constexpr int points = 60;
    for (int i = 0; i < points; ++i)
    {
        const double f = 40.0 * std::pow(16.0, (i + 0.5) / points);
        double change = strapLevel(strap, f, true) - strapLevel(strap, f, false);
        if (compensation)
            change += 20.0 * std::log10(std::abs(compensation->response(Hertz(f))));
        sum += change * change / points;
    }
    return std::sqrt(sum);
}

double followedTo(const TighteningStrapParams& params, int bands, double rate, double delay)
{
    TighteningStrap strap;
    strap.setParams(params);
    strap.prepare({rate, blockFrames});
    DynamicCompensationParams wanted;
    wanted.bands = bands;
    wanted.delay = Seconds(delay);
    Loop loop(wanted, rate, delay, [&](auto in, auto out) { strap.process(in, out); });
    loop.play(60.0);
    return changeOf(params, &loop.compensation);
}
} // namespace

TEST_CASE("Dynamic compensation keeps the contract of a block", "[actuator]")
{
    test::checkBlockContract<DynamicCompensation>({});
    DynamicCompensationParams params;
    params.bands = 1;
    params.target = Decibels(20.0);
    test::checkBlockContract<DynamicCompensation>(params);
}

TEST_CASE("A tightening strap keeps the contract of a block", "[actuator]")
{
    test::checkBlockContract<TighteningStrap>(wristband());
}

TEST_CASE("Blocks of feedback may be cut anywhere, and a reset is a new start", "[actuator]")
{
    std::vector<float> x(30000), back(x.size());
    Gaussian noise(3);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        x[i] = 0.1f * static_cast<float>(noise.next());
        back[i] = 0.3f * static_cast<float>(noise.next());
    }
    DynamicCompensationParams params;
    params.target = Decibels(0.0);
    std::vector<std::vector<float>> outputs;
    DynamicCompensation compensation;
    compensation.setParams(params);
    compensation.prepare({8000.0, x.size()});
    for (const std::size_t n : {std::size_t{1}, std::size_t{7}, std::size_t{511}, x.size()})
    {
        compensation.reset();
        std::vector<float> out(x.size());
        for (std::size_t i = 0; i < x.size(); i += n)
        {
            const std::size_t m = std::min(n, x.size() - i);
            compensation.process(std::span(x).subspan(i, m), std::span(back).subspan(i, m),
                                 std::span(out).subspan(i, m));
        }
        outputs.push_back(std::move(out));
        CHECK(std::abs(compensation.gain(3)) > 1.0);
    }
    for (const auto& out : outputs)
        CHECK(out == outputs.front());
}

TEST_CASE("Dynamic compensation gives back most of what a tightened strap takes", "[actuator]")
{
    const TighteningStrapParams strap = wristband();
    const double before = changeOf(strap, nullptr);
    CHECK(before > 3.0);
    const double six = followedTo(strap, 6, 8000.0, 0.02);
    const double twelve = followedTo(strap, 12, 8000.0, 0.02);
    const double most = followedTo(strap, 24, 8000.0, 0.02);
    CAPTURE(before, six, twelve, most);
    CHECK(six < 0.85 * before);
    CHECK(twelve < 0.45 * before);
    CHECK(most < 0.35 * before);
    CHECK(most < twelve);
    CHECK(twelve < six);
    CHECK(followedTo(strap, 12, 48000.0, 0.02) == Approx(twelve).margin(0.25));
}

TEST_CASE("A change of level is followed by 63 % within the time", "[actuator]")
{
    for (const double time : {2.0, 5.0})
    {
        DynamicCompensationParams params;
        params.bands = 3;
        params.time = Seconds(time);
        params.target = Decibels(6.0); // of an actuator of 0 dB
        Loop loop(params, 4000.0, 0.0, [](auto in, auto out) { std::copy(in.begin(), in.end(), out.begin()); });
        loop.play(time);
        for (const double gain : loop.gains())
            CHECK(gain == Approx(6.0 * (1.0 - std::exp(-1.0))).epsilon(0.12)); // the band has to be heard first
        loop.play(8.0 * time);
        for (const double gain : loop.gains())
            CHECK(gain == Approx(6.0).margin(0.1));
    }
}

TEST_CASE("The filter has the gains of its bands at their centres", "[actuator]")
{
    DynamicCompensationParams params;
    params.bands = 12;
    params.target = Decibels(4.0);
    Loop loop(params, 8000.0, 0.0, [](auto in, auto out) { std::copy(in.begin(), in.end(), out.begin()); });
    loop.play(40.0);
    for (const double f : loop.compensation.frequencies())
        CHECK(Decibels::fromGain(std::abs(loop.compensation.response(Hertz(f)))).value == Approx(4.0).margin(0.4));
}

TEST_CASE("Every delay, told right or wrong, and every time leave the loop stable", "[actuator][stability]")
{
    // The actuator is 5 dB too weak: gains must come to rest there, whatever the delays are.
    for (const double time : {0.0, 2.0, 7.0})
        for (const double delay : {0.0, 0.1, 0.5, 1.0})
            for (const double told : {0.0, 0.5, 1.0, 1e9, -1.0})
            {
                CAPTURE(time, delay, told);
                DynamicCompensationParams params;
                params.bands = 2;
                params.highFrequency = Hertz(300.0);
                params.time = Seconds(time);
                params.delay = Seconds(told);
                params.target = Decibels(0.0);
                const auto weak = [](auto in, auto out)
                {
                    std::transform(in.begin(), in.end(), out.begin(), [](float v) { return 0.56234f * v; });
                };
                Loop loop(params, 2000.0, delay, weak);
                loop.play(10.0 * std::max(time, 2.0));
                for (int i = 0; i < 4; ++i)
                {
                    loop.play(3.0);
                    for (const double gain : loop.gains())
                        CHECK(gain == Approx(5.0).margin(0.35));
                }
            }
}

TEST_CASE("What is learned is right though the delay was told wrong", "[actuator]")
{
    for (const double delay : {0.0, 1.0})
        for (const double told : {0.0, 1.0})
        {
            CAPTURE(delay, told);
            DynamicCompensationParams params;
            params.bands = 3;
            params.time = Seconds(2.0);
            params.delay = Seconds(told);
            Loop loop(params, 4000.0, delay, [](auto in, auto out) { std::copy(in.begin(), in.end(), out.begin()); });
            loop.play(12.0);
            for (std::size_t k = 0; k < 3; ++k)
                CHECK(loop.compensation.reference(k).value() == Approx(0.0).margin(0.5));
            for (const double gain : loop.gains())
                CHECK(gain == Approx(0.0).margin(1.0));
        }
}

TEST_CASE("Stiff bodies and sharp resonances leave the loop stable from 8 to 768 kHz", "[actuator][stability]")
{
    for (const double rate : {8000.0, 48000.0, 768000.0})
        for (const double q : {0.5, 100.0, 1e4})
            for (const double stiffness : {1.0, 1e12})
                for (const double delay : {0.0, 1.0})
                {
                    if (rate > 100000.0 && (delay > 0.0 || q < 1.0))
                        continue; // long to simulate
                    CAPTURE(rate, q, stiffness, delay);
                    TighteningStrapParams params = wristband();
                    params.loose.jointStiffness = stiffness;
                    params.tight = tightened(params.loose, 3.0);
                    params.resonance = {67.0, q};
                    params.tightResonance = {90.0, q};
                    params.start = 1.0;
                    params.length = 0.5;
                    TighteningStrap strap;
                    strap.setParams(params);
                    strap.prepare({rate, blockFrames});
                    DynamicCompensationParams wanted;
                    wanted.bands = rate > 100000.0 ? 3 : 12;
                    wanted.time = Seconds(2.0);
                    wanted.delay = Seconds(1.0 - delay); // as wrong as can be
                    wanted.limit = Decibels(24.0);
                    wanted.target = Decibels(30.0);
                    Loop loop(wanted, rate, delay, [&](auto in, auto out) { strap.process(in, out); });
                    loop.play(rate > 100000.0 ? 4.0 : 12.0, 24.0);
                    // Bands of 24 dB at most, whose sections overlap.
                    CHECK(loop.largest < 0.1f * 6.0f * 100.0f);
                }
}

TEST_CASE("Any feedback leaves gains within their limit", "[actuator][stability]")
{
    using Limits = std::numeric_limits<float>;
    Gaussian noise(5);
    for (const float scale : {0.0f, 1e-30f, 1.0f, 1e12f, Limits::max(), Limits::infinity(), Limits::quiet_NaN()})
    {
        CAPTURE(scale);
        DynamicCompensationParams params;
        params.target = Decibels(0.0);
        Loop loop(params, 8000.0, 0.0,
                  [&](auto, auto out)
                  {
                      for (float& v : out)
                          v = scale * static_cast<float>(noise.next());
                  });
        loop.play(10.0);
        CHECK(loop.largest < 0.1f * 6.0f * 8.0f);
    }
}

TEST_CASE("A sensor that fell off does not make the drive louder", "[actuator]")
{
    DynamicCompensationParams params;
    params.time = Seconds(2.0);
    float gain = 1.0f;
    Loop loop(params, 8000.0, 0.0,
              [&](auto in, auto out)
              { std::transform(in.begin(), in.end(), out.begin(), [&](float v) { return gain * v; }); });
    loop.play(6.0);
    gain = 0.5f;
    loop.play(12.0);
    for (const double band : loop.gains())
        CHECK(band == Approx(6.02).margin(0.3));
    gain = 0.0f;
    loop.play(12.0);
    for (const double band : loop.gains())
        CHECK(std::abs(band) < 0.5);
}

TEST_CASE("In silence gains are held", "[actuator]")
{
    DynamicCompensationParams params;
    params.target = Decibels(6.0);
    Loop loop(params, 8000.0, 0.0, [](auto in, auto out) { std::copy(in.begin(), in.end(), out.begin()); });
    loop.play(10.0);
    loop.level = 1e-5f;
    loop.play(8.0); // what was louder fades from the meters
    const auto held = loop.gains();
    loop.play(20.0);
    CHECK(loop.gains() == held);
}

TEST_CASE("Dynamic compensation: error against run time", "[.bench]")
{
    const TighteningStrapParams strap = wristband();
    std::printf("bands  error dB  ns/frame (without: %.2f dB)\n", changeOf(strap, nullptr));
    for (const int bands : {1, 3, 6, 9, 12, 16, 24})
    {
        DynamicCompensationParams params;
        params.bands = bands;
        DynamicCompensation compensation;
        compensation.setParams(params);
        compensation.prepare({48000.0, 512});
        std::vector<float> x(512), back(512), y(512);
        Gaussian noise(1);
        for (std::size_t i = 0; i < x.size(); ++i)
        {
            x[i] = 0.1f * static_cast<float>(noise.next());
            back[i] = 0.1f * static_cast<float>(noise.next());
        }
        double best = 1e300;
        for (int repeat = 0; repeat < 9; ++repeat)
        {
            const std::clock_t begin = std::clock(); // of this process, whatever else runs
            for (int i = 0; i < 200; ++i)
                compensation.process(x, back, y);
            const double taken = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
            best = std::min(best, taken / (200.0 * 512.0));
        }
        std::printf("%5d  %8.2f  %8.1f\n", bands, followedTo(strap, bands, 8000.0, 0.02), 1e9 * best);
    }
}
