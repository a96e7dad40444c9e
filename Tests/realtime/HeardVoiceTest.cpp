#include "support/Catch.h"

#include <pacini/foundation/Random.h>
#include <pacini/realtime/HeardVoice.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
constexpr double heardRate = 6000.0;

/// A voice that listens at the inner rate.
struct Rig
{
    Rig()
    {
        voice.design(5.0, 2000.0, heardRate);
        voice.jump(1.0);
    }

    /// One hop of `x(t)` and `high(t)`, what lies above the frames.
    template <typename Sound, typename High>
    void hop(Sound&& x, High&& high, double audible = 1.0, double gain = 1.0)
    {
        std::array<double, controlHop> in{}, highs{}, out{};
        for (std::size_t i = 0; i < controlHop; ++i)
        {
            const double t = static_cast<double>(frame++) / heardRate;
            in[i] = x(t);
            highs[i] = high(t);
        }
        voice.aim(audible, gain, 0.2);
        voice.process(in, highs, out, 0);
        voice.flush();
        played.insert(played.end(), out.begin(), out.end());
    }

    template <typename Sound, typename High>
    void play(double seconds, Sound&& x, High&& high, double audible = 1.0, double gain = 1.0)
    {
        for (double t = 0.0; t < seconds; t += static_cast<double>(controlHop) / heardRate)
            hop(x, high, audible, gain);
    }

    /// Of the newest quarter of a second.
    [[nodiscard]] double amplitude() const
    {
        double sum = 0.0;
        for (const double y : std::span(played).last(1500))
            sum += y * y;
        return std::sqrt(2.0 * sum / 1500.0);
    }

    /// Of the newest quarter of a second, Hz, by its zeros.
    [[nodiscard]] double pitch() const
    {
        const auto y = std::span(played).last(1500);
        double zeros = 0.0;
        for (std::size_t i = 1; i < y.size(); ++i)
            zeros += y[i - 1] < 0.0 && y[i] >= 0.0 ? 1.0 : 0.0;
        return zeros * heardRate / 1500.0;
    }

    HeardVoice voice;
    std::size_t frame = 0;
    std::vector<double> played;
};

auto tone(double f, double amplitude)
{
    return [=](double t)
    {
        return amplitude * std::sin(2.0 * std::numbers::pi * f * t);
    };
}
const auto nothing = tone(0.0, 0.0);
} // namespace

TEST_CASE("a sine of 1 kHz at half of full scale brings the voice to .8, ten decibels less to half of it", "[realtime]")
{
    double before = 0.0;
    for (const double amplitude : {0.5, 0.5 * std::sqrt(0.1), 0.05})
    {
        Rig rig;
        rig.play(1.0, tone(1000.0, amplitude), nothing);
        CHECK(rig.voice.share() == 1.0);
        CHECK(rig.voice.bandsGain() == 0.25);
        // Less than .03 of the loudest is not felt.
        if (before > 0.0)
            CHECK(rig.amplitude() + 0.8 * 0.03 / 0.97 == Approx(0.5 * before).epsilon(0.04));
        else
            CHECK(rig.amplitude() == Approx(0.8).epsilon(0.05));
        before = rig.amplitude() + 0.8 * 0.03 / 0.97;
    }
}

TEST_CASE("what lies below 700 Hz is left to the bands, hiss that is hardly heard is not felt", "[realtime]")
{
    for (const double f : {40.0, 120.0, 300.0, 690.0})
    {
        CAPTURE(f);
        Rig rig;
        rig.play(1.0, tone(f, 0.9), nothing);
        CHECK(rig.voice.share() == 0.0);
        CHECK(rig.voice.bandsGain() == 1.0);
        // The edge at which it begins is bright.
        CHECK(std::all_of(rig.played.begin() + 300, rig.played.end(), [](double y) { return y == 0.0; }));
    }
    Rig hiss;
    Random random(2);
    hiss.play(1.0, nothing, [&](double) { return 1e-4 * random.uniform(-1.0, 1.0); });
    CHECK(hiss.voice.share() == 1.0);
    CHECK(hiss.amplitude() == 0.0);
}

TEST_CASE("the brighter the sound, the higher the voice, within the actuator's range", "[realtime]")
{
    Rig dull, bright;
    dull.play(1.0, tone(2000.0, 0.3), nothing);
    CHECK(dull.pitch() == Approx(150.0).margin(8.0));
    bright.play(1.0, nothing, tone(1234.0, 0.3)); // sampled: what counts is its power
    CHECK(bright.pitch() == Approx(290.0).margin(8.0));
    Rig narrow;
    narrow.voice.design(160.0, 190.0, heardRate);
    narrow.voice.jump(1.0);
    narrow.play(1.0, nothing, tone(1234.0, 0.3));
    CHECK(narrow.pitch() == Approx(190.0).margin(8.0));
}

TEST_CASE("the share follows the power of the last second", "[realtime]")
{
    Rig rig;
    rig.play(3.0, tone(200.0, 0.5), nothing);
    CHECK(rig.voice.share() == 0.0);
    rig.play(0.1, nothing, tone(1000.0, 0.5));
    CHECK(rig.voice.share() > 0.0); // 200 Hz count 10 dB less
    rig.play(3.0, nothing, tone(1000.0, 0.5));
    CHECK(rig.voice.share() == 1.0);
    rig.play(6.0, tone(200.0, 0.5), nothing);
    CHECK(rig.voice.share() == 0.0);
}

TEST_CASE("the voice goes as far as is wanted, and is silent where it is not", "[realtime]")
{
    Rig half;
    half.voice.jump(0.5);
    half.play(1.0, nothing, tone(1000.0, 0.5), 0.5);
    CHECK(half.voice.share() == 0.5);
    Rig all;
    all.play(1.0, nothing, tone(1000.0, 0.5));
    CHECK(half.amplitude() == Approx(0.5 * all.amplitude()));
    Rig louder;
    louder.play(1.0, nothing, tone(1000.0, 0.5), 1.0, 2.0);
    CHECK(louder.amplitude() == Approx(2.0 * all.amplitude()));
    CHECK_FALSE(all.voice.silent());
    all.play(0.2, nothing, tone(1000.0, 0.5), 0.0);
    CHECK(all.voice.silent());
    CHECK(all.voice.share() == 0.0);
    CHECK(all.voice.bandsGain() == 1.0);
    HeardVoice off;
    off.design(5.0, 2000.0, heardRate);
    off.jump(0.0);
    CHECK(off.silent());
}

TEST_CASE("within an even train of five events the voice leaves them to their pulses, in an uneven one it does not",
          "[realtime]")
{
    struct Case
    {
        double second, amplitude; ///< gap of every second event, s; its strength
        bool even;
    };
    for (const Case& c :
         {Case{0.020, 0.5, true}, Case{0.025, 0.6, true}, Case{0.040, 0.5, false}, Case{0.020, 0.3, false}})
    {
        CAPTURE(c.second, c.amplitude);
        Rig rig;
        rig.play(0.5, nothing, tone(1000.0, 0.5));
        for (int event = 0; event < 12; ++event)
        {
            const bool odd = event % 2 == 1;
            const double gap = odd ? c.second : 0.020;
            rig.play(gap, nothing, tone(1000.0, 0.5));
            rig.voice.noteEvent({odd ? c.amplitude : 0.5, gap});
        }
        rig.play(0.005, nothing, tone(1000.0, 0.5));
        CHECK((rig.voice.share() < 0.05) == c.even);
        rig.play(0.5, nothing, tone(1000.0, 0.5));
        CHECK(rig.voice.share() > 0.99);
    }
    // Farther apart than 45 ms is no train.
    Rig slow;
    slow.play(0.5, nothing, tone(1000.0, 0.5));
    for (int event = 0; event < 12; ++event)
    {
        slow.play(0.050, nothing, tone(1000.0, 0.5));
        slow.voice.noteEvent({0.5, 0.050});
    }
    CHECK(slow.voice.share() == 1.0);
}
