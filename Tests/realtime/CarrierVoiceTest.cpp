#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/foundation/Random.h>
#include <pacini/realtime/CarrierVoice.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
constexpr double listenerRate = 6000.0;

/// Gain of the Linkwitz-Riley slopes of fourth order at both edges.
double listenerGain(double f, double low, double high)
{
    const auto warp = [](double g)
    {
        return std::tan(std::numbers::pi * g / listenerRate);
    };
    const double a = std::pow(warp(f) / warp(low), 4.0);
    const double b = std::pow(warp(f) / warp(high), 4.0);
    return a / (1.0 + a) / (1.0 + b);
}

std::vector<BandListener::Heard> heardOf(BandListener& listener, double f, double amplitude, std::size_t hops,
                                         std::size_t begin = 0)
{
    std::vector<BandListener::Heard> heard;
    for (std::size_t h = begin; h < begin + hops; ++h)
    {
        std::vector<double> in(controlHop);
        for (std::size_t i = 0; i < controlHop; ++i)
            in[i] = amplitude *
                    std::sin(2.0 * std::numbers::pi * f * static_cast<double>(h * controlHop + i) / listenerRate);
        listener.process(in);
        heard.push_back(listener.hear());
        listener.flush();
    }
    return heard;
}

std::vector<double> numbersOf(const std::vector<BandListener::Heard>& heard)
{
    std::vector<double> values;
    for (const auto& [power, frequency, sine, cosine] : heard)
        values.insert(values.end(), {power, frequency, sine, cosine});
    return values;
}
} // namespace

TEST_CASE("a band listener hears strength, pitch and phase of a tone wherever it lies in its band", "[realtime]")
{
    for (const double f : {45.0, 60.0, 90.0, 115.0})
    {
        CAPTURE(f);
        BandListener listener;
        listener.design(Hertz(50.0), Hertz(110.0), listenerRate);
        const auto heard = heardOf(listener, f, 0.5, 600);
        const double size = 0.5 * listenerGain(f, 50.0, 110.0);
        for (std::size_t n = 500; n < heard.size(); ++n)
        {
            CHECK(heard[n].frequency == Approx(f / listenerRate).epsilon(0.02));
            CHECK(heard[n].power == Approx(size * size).epsilon(0.05));
            CHECK(std::hypot(heard[n].sine, heard[n].cosine) == Approx(size).epsilon(0.04));
        }
        // From hop to hop the phase turns by the pitch.
        for (std::size_t n = 500; n + 1 < heard.size(); ++n)
        {
            const std::complex<double> a(heard[n].cosine, heard[n].sine), b(heard[n + 1].cosine, heard[n + 1].sine);
            const double turned = std::arg(b / a);
            const double expected = 2.0 * std::numbers::pi * f * static_cast<double>(controlHop) / listenerRate;
            CHECK(std::remainder(turned - expected, 2.0 * std::numbers::pi) == Approx(0.0).margin(0.03));
        }
    }
}

TEST_CASE("a band listener names no pitch far outside its band, and its centre of silence", "[realtime]")
{
    BandListener listener;
    listener.design(Hertz(100.0), Hertz(225.0), listenerRate);
    CHECK(listener.hear().frequency == Approx(150.0 / listenerRate).epsilon(1e-12));
    CHECK(listener.hear().power == 0.0);
    CHECK(heardOf(listener, 20.0, 0.9, 900).back().frequency ==
          Approx(std::atan(std::tan(std::numbers::pi * 60.0 / listenerRate)) / std::numbers::pi).epsilon(1e-9));
    listener.reset();
    CHECK(heardOf(listener, 1500.0, 0.9, 900).back().frequency == Approx(360.0 / listenerRate).epsilon(1e-9));
    // The pitch stays when the sound has gone; a reset forgets it.
    for (int i = 0; i < 900; ++i)
    {
        listener.process(std::vector<double>(controlHop, 0.0));
        (void)listener.hear();
    }
    CHECK(listener.hear().power < 1e-15);
    listener.reset();
    CHECK(listener.hear().frequency == Approx(150.0 / listenerRate).epsilon(1e-12));
    // At the upper end of the inner rate the tangents stay finite: 1.4 and 1.5 radians of half a turn.
    BandListener high;
    high.design(Hertz(2900.0), Hertz(2990.0), listenerRate);
    CHECK(heardOf(high, 20.0, 0.9, 900).back().frequency >= 1.39 / std::numbers::pi * 0.5);
    BandListener top;
    top.design(Hertz(4900.0), Hertz(5200.0), listenerRate);
    CHECK(heardOf(top, 2990.0, 0.9, 900).back().frequency == Approx(1.5 / std::numbers::pi).epsilon(1e-3));
}

TEST_CASE("a band listener's answer to bursts is what it was before", "[realtime]")
{
    struct Band
    {
        double low, high, fs;
    };
    for (const auto& [low, high, fs] : {Band{20.0, 40.0, 6000.0}, {60.0, 120.0, 7350.0}, {300.0, 1400.0, 6000.0}})
    {
        BandListener listener;
        listener.design(Hertz(low), Hertz(high), fs);
        Random random(3);
        std::vector<double> values;
        for (std::size_t h = 0; h < 200; ++h)
        {
            std::vector<double> in(controlHop, 0.0);
            for (std::size_t i = 0; i < controlHop; ++i)
                in[i] = h < 60    ? 0.7 * std::sin(1.2 * low / fs * 2.0 * std::numbers::pi *
                                                   static_cast<double>(h * controlHop + i))
                        : h < 120 ? 0.3 * random.uniform(-1.0, 1.0)
                                  : 0.0;
            listener.process(in);
            const auto heard = listener.hear();
            values.insert(values.end(), {heard.power, heard.frequency, heard.sine, heard.cosine});
            listener.flush();
        }
        checkPinned("realtime/listener of " + std::to_string(static_cast<int>(low)) + " Hz", values, 1e-6);
    }
}

TEST_CASE("a reset band listener is a new one", "[realtime]")
{
    BandListener used, fresh;
    for (BandListener* listener : {&used, &fresh})
        listener->design(Hertz(50.0), Hertz(110.0), listenerRate);
    (void)heardOf(used, 70.0, 0.8, 33);
    used.process(std::vector<double>(3, 0.4));
    used.reset();
    CHECK(numbersOf(heardOf(used, 100.0, 0.5, 50)) == numbersOf(heardOf(fresh, 100.0, 0.5, 50)));
}

TEST_CASE("an oscillator is a sinusoid whose amplitude moves along a spline from hop to hop", "[realtime]")
{
    CarrierOscillator oscillator;
    oscillator.reset();
    CHECK(oscillator.silent());
    CHECK(oscillator.level() == 0.0);
    const double f = 0.03;
    double phase = 0.0, before = 0.0, from = 0.0;
    for (std::size_t hop = 0; hop < 4000; ++hop)
    {
        const double target = hop % 5 < 3 ? 0.8 : 0.2;
        oscillator.aim(target, 0.5, f);
        const double to = std::abs(target - from) <= 1e-6 ? target : from + 0.5 * (target - from);
        REQUIRE(oscillator.level() == Approx(to));
        CHECK_FALSE(oscillator.silent());
        std::vector<double> out(controlHop, 1.0);
        oscillator.addTo(std::span(out).first(3), 0);
        oscillator.addTo(std::span(out).subspan(3), 3);
        for (std::size_t i = 0; i < controlHop; ++i)
        {
            phase = std::fmod(phase + 2.0 * std::numbers::pi * f, 2.0 * std::numbers::pi);
            // The quadratic B-spline by its three weights.
            const double u = static_cast<double>(i + 1) / static_cast<double>(controlHop);
            const double amplitude = 0.5 * (1.0 - u) * (1.0 - u) * before + (0.5 + u - u * u) * from + 0.5 * u * u * to;
            REQUIRE(out[i] == Approx(1.0 + amplitude * std::sin(phase)).margin(1e-9));
        }
        before = from;
        from = to;
    }
    for (int hop = 0; hop < 2; ++hop)
    {
        oscillator.aim(0.0, 1.0, f);
        CHECK_FALSE(oscillator.silent());
    }
    oscillator.aim(0.0, 1.0, f);
    CHECK(oscillator.silent());
}

TEST_CASE("an oscillator's size does not drift, and what went wrong with it heals", "[realtime]")
{
    CarrierOscillator oscillator;
    oscillator.reset();
    double largest = 0.0;
    for (std::size_t hop = 0; hop < 100000; ++hop)
    {
        oscillator.aim(1.0, 1.0, 0.25);
        std::array<double, controlHop> out{};
        oscillator.addTo(out, 0);
        if (hop > 90000)
            for (const double y : out)
                largest = std::max(largest, std::abs(y));
    }
    CHECK(largest == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("an oscillator's pitch moves in a straight line within a hop, from silence at once", "[realtime]")
{
    CarrierOscillator oscillator;
    oscillator.reset();
    double phase = 0.0, before = 0.02;
    for (std::size_t hop = 0; hop < 50; ++hop)
    {
        const double f = hop % 3 == 0 ? 0.02 : 0.05;
        oscillator.aim(1.0, 1.0, f);
        std::array<double, controlHop> out{};
        oscillator.addTo(out, 0);
        for (std::size_t i = 0; i < controlHop; ++i)
        {
            const double part = static_cast<double>(i + 1) / static_cast<double>(controlHop);
            phase += 2.0 * std::numbers::pi * (before + part * (f - before));
            if (hop > 2)
                CHECK(out[i] == Approx(std::sin(phase)).margin(1e-9));
        }
        before = f;
    }
}

TEST_CASE("an oscillator begins at the phase that it is given or at another one's", "[realtime]")
{
    const auto first = [](CarrierOscillator& oscillator)
    {
        oscillator.aim(1.0, 1.0, 0.02);
        std::array<double, controlHop> out{};
        oscillator.addTo(out, 0);
        return std::vector<double>(out.begin(), out.end());
    };
    for (const double size : {1e-3, 1.0, 20.0})
        for (const double phase : {0.0, 0.7, 2.0, -2.5})
        {
            CAPTURE(size, phase);
            CarrierOscillator oscillator;
            oscillator.reset();
            oscillator.begin(size * std::sin(phase), size * std::cos(phase));
            CarrierOscillator other;
            other.reset();
            other.follow(oscillator);
            const auto y = first(oscillator);
            for (std::size_t i = 0; i < controlHop; ++i)
            {
                const double t = static_cast<double>(i + 1);
                const double u = t / static_cast<double>(controlHop);
                CHECK(y[i] == Approx(0.5 * u * u * std::sin(phase + 2.0 * std::numbers::pi * 0.02 * t)).margin(1e-12));
            }
            CHECK(first(other) == y);
        }
    // Of nothing it takes no phase.
    CarrierOscillator plain, given, small;
    for (CarrierOscillator* one : {&plain, &given, &small})
        one->reset();
    given.begin(0.9e-12, 0.0);
    small.begin(1.1e-12, 0.0);
    const auto expected = first(plain);
    CHECK(first(given) == expected);
    CHECK(first(small) != expected);
    // While it is silent the pitch is not taken.
    CarrierOscillator silent;
    silent.aim(0.0, 1.0, 0.1);
    std::array<double, controlHop> none{};
    silent.addTo(none, 0);
    CHECK(first(silent) == expected);
}

TEST_CASE("After an event an oscillator has the phase of a sine that began with it, whatever it played before",
          "[realtime]")
{
    constexpr double f = 0.02;
    constexpr double sinceEvent = 5.0;
    for (const double phase : {0.0, 1.0, 2.5, 3.14, -2.0})
    {
        CAPTURE(phase);
        CarrierOscillator oscillator;
        oscillator.begin(std::sin(phase), std::cos(phase));
        std::vector<double> y;
        for (int hop = 0; hop < 80; ++hop)
        {
            if (hop == 10)
                oscillator.noteEvent(sinceEvent);
            oscillator.aim(1.0, 1.0, f);
            std::array<double, controlHop> out{};
            oscillator.addTo(out, 0);
            y.insert(y.end(), out.begin(), out.end());
        }
        for (std::size_t i = 0; i < y.size(); ++i)
        {
            const double frame = static_cast<double>(i) + 1.0;
            const double event = 10.0 * static_cast<double>(controlHop) - sinceEvent;
            if (i >= 3 * controlHop && i < 10 * controlHop)
                REQUIRE(y[i] == Approx(std::sin(phase + 2.0 * std::numbers::pi * f * frame)).margin(1e-9));
            if (i >= 75 * controlHop)
                REQUIRE(y[i] == Approx(std::sin(2.0 * std::numbers::pi * f * (frame - event))).margin(1e-5));
            if (i > 2 * controlHop) // no step: a sine's own is 2 pi f, and the turn adds what it takes off in a hop
                REQUIRE(std::abs(y[i] - y[i - 1]) < 2.0 * std::numbers::pi * f + 0.06);
        }
    }
}

TEST_CASE("An event waits for an oscillator that is silent, for 50 ms", "[realtime]")
{
    for (const int hops : {3, 30, 60})
    {
        CarrierOscillator oscillator;
        oscillator.begin(1.0, 0.0);
        oscillator.noteEvent(4.0);
        for (int hop = 0; hop < hops; ++hop)
            oscillator.aim(0.0, 1.0, 0.02);
        oscillator.aim(1.0, 1.0, 0.02);
        std::array<double, controlHop> out{};
        oscillator.addTo(out, 0);
        const double before =
            hops < 40 ? 2.0 * std::numbers::pi * 0.02 * (4.0 + static_cast<double>(hops * 8)) : 0.5 * std::numbers::pi;
        for (std::size_t i = 0; i < controlHop; ++i)
        {
            const double u = static_cast<double>(i + 1) / static_cast<double>(controlHop);
            const double turn = 2.0 * std::numbers::pi * 0.02 * static_cast<double>(i + 1);
            CHECK(out[i] == Approx(0.5 * u * u * std::sin(before + turn)).margin(1e-9));
        }
    }
}

TEST_CASE("a hop's ramp runs in a straight line and arrives", "[realtime]")
{
    HopRamp ramp;
    CHECK(ramp.silent());
    CHECK(ramp.start() == 0.0);
    CHECK(ramp.end() == 0.0);
    ramp.aim(1.0, 0.25);
    CHECK(ramp.start() == 0.0);
    CHECK(ramp.end() == 0.25);
    CHECK_FALSE(ramp.silent());
    for (std::size_t i = 0; i < controlHop; ++i)
        CHECK(ramp.at(i) == Approx(0.25 * static_cast<double>(i + 1) / static_cast<double>(controlHop)));
    ramp.aim(1.0, 0.5);
    CHECK(ramp.start() == 0.25);
    CHECK(ramp.end() == 0.625);
    CHECK(ramp.at(controlHop - 1) == 0.625);
    ramp.jump(0.0);
    ramp.aim(1e-6, 0.5); // the last millionth
    CHECK(ramp.end() == 1e-6);
    ramp.jump(0.5);
    CHECK(ramp.start() == 0.5);
    CHECK(ramp.end() == 0.5);
    CHECK(ramp.at(3) == 0.5);
    ramp.aim(0.5 - 0.9e-6, 0.5);
    CHECK(ramp.end() == 0.5 - 0.9e-6);
    ramp.jump(0.5);
    ramp.aim(0.5 - 1.1e-6, 0.5);
    CHECK(ramp.end() == Approx(0.5 - 0.55e-6).epsilon(1e-12));
    ramp.jump(0.5);
    ramp.aim(0.0, 1.0);
    CHECK_FALSE(ramp.silent());
    ramp.aim(0.0, 1.0);
    CHECK(ramp.silent());
    ramp.aim(0.5, 1.0);
    CHECK_FALSE(ramp.silent());
}

TEST_CASE("a parameter's glide turns without a corner, passes no target, and arrives", "[realtime]")
{
    HopGlide glide;
    glide.jump(1.0);
    CHECK(glide.end() == 1.0);
    const double share = hopShare(0.005, 6000.0);
    double before = 1.0, slope = 0.0, corner = 0.0;
    std::size_t hops = 0, half = 0;
    for (; hops < 200 && !glide.silent(); ++hops)
    {
        glide.aim(0.0, share);
        CHECK(glide.start() == before);
        CHECK(glide.end() >= 0.0);
        CHECK(glide.end() <= before);
        corner = std::max(corner, std::abs(glide.end() - before - slope));
        slope = glide.end() - before;
        before = glide.end();
        half += before > 0.5 ? 1 : 0;
        CHECK(glide.at(controlHop - 1) == Approx(glide.end()).margin(1e-12));
    }
    CHECK(corner < 0.05); // one one-pole has 0.23
    CHECK(static_cast<double>(half * controlHop) < 0.020 * 6000.0);
    CHECK(hops < 100);
    glide.aim(0.25, 1.0);
    glide.aim(0.25, 1.0);
    glide.aim(0.25, 1.0);
    CHECK(glide.end() == 0.25);
}

TEST_CASE("a hop's share is that of a one-pole of eight frames", "[realtime]")
{
    CHECK(controlHop == 8);
    CHECK(hopShare(0.0, 6000.0) == 1.0);
    CHECK(hopShare(-1.0, 6000.0) == 1.0);
    for (const double seconds : {1e-4, 0.004, 0.03, 2.0})
        for (const double fs : {6000.0, 11025.0})
            CHECK(hopShare(seconds, fs) == Approx(1.0 - std::exp(-8.0 / (seconds * fs))).epsilon(1e-10));
    CHECK(hopShare(1e9, 6000.0) == Approx(8.0 / 6e12).epsilon(1e-9));
}
