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
        voice.aim(audible, gain, 0.2, own, low);
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
    double own = 0.0, low = 0.0; ///< of the bands
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

TEST_CASE("A bright sound at half of full scale is felt at a third, and begins at once", "[realtime]")
{
    Rig rig;
    rig.play(0.05, nothing, tone(1234.0, 0.5)); // sampled: what counts is its power
    const double begin = *std::max_element(rig.played.begin(), rig.played.end());
    rig.play(1.0, nothing, tone(1234.0, 0.5));
    CHECK(rig.amplitude() == Approx(0.32).epsilon(0.1));
    CHECK(begin > 0.9 * rig.amplitude());
}

TEST_CASE("A sound of half the level is felt half as strong", "[realtime]")
{
    double before = 0.0;
    for (const double amplitude : {0.4, 0.2, 0.1})
    {
        Rig rig;
        rig.play(1.0, tone(2000.0, amplitude), nothing);
        if (before > 0.0)
            CHECK(rig.amplitude() == Approx(0.5 * before).epsilon(0.16)); // .03 of the loudness are not felt
        before = rig.amplitude();
    }
}

TEST_CASE("What lies below 400 Hz does not bring the voice, nor hiss that is hardly heard", "[realtime]")
{
    for (const double f : {40.0, 120.0, 300.0, 400.0})
    {
        CAPTURE(f);
        Rig rig;
        rig.play(1.0, tone(f, 0.5), nothing);
        CHECK(rig.amplitude() < 1e-3);
    }
    Rig hiss;
    Random random(2);
    hiss.play(1.0, nothing, [&](double) { return 1e-4 * random.uniform(-1.0, 1.0); });
    CHECK(hiss.amplitude() == 0.0);
}

TEST_CASE("The brighter the sound, the higher the voice, within the actuator's range", "[realtime]")
{
    Rig dull, bright;
    dull.play(1.0, tone(2000.0, 0.3), nothing);
    CHECK(dull.pitch() == Approx(280.0).margin(8.0));
    bright.play(1.0, nothing, tone(1234.0, 0.3)); // sampled: what counts is its power
    CHECK(bright.pitch() == Approx(380.0).margin(8.0));
    Rig narrow;
    narrow.voice.design(160.0, 190.0, heardRate);
    narrow.voice.jump(1.0);
    narrow.play(1.0, nothing, tone(1234.0, 0.3));
    CHECK(narrow.pitch() == Approx(190.0).margin(8.0));
}

TEST_CASE("The voice yields to a low part of twice its level, and comes back within 50 ms", "[realtime]")
{
    Rig rig;
    rig.play(1.0, nothing, tone(1000.0, 0.2));
    const double alone = rig.amplitude();
    rig.low = 4.5 * alone * alone;
    rig.play(1.0, nothing, tone(1000.0, 0.2));
    CHECK(rig.amplitude() == 0.0);
    rig.low = 0.0;
    rig.play(0.3, nothing, tone(1000.0, 0.2));
    CHECK(rig.amplitude() == Approx(alone).epsilon(0.02));
    // The bands keep the drive that they need.
    rig.own = 1.0 - 0.5 * alone;
    rig.play(0.5, nothing, tone(1000.0, 0.2));
    CHECK(rig.amplitude() == Approx(0.5 * alone).epsilon(0.02));
}

TEST_CASE("The voice goes as far as is wanted, and is silent where it is not", "[realtime]")
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
    HeardVoice off;
    off.design(5.0, 2000.0, heardRate);
    off.jump(0.0);
    CHECK(off.silent());
}
