#include "support/Catch.h"

#include <pacini/synthesis/PulseLevel.h>
#include <pacini/synthesis/PulseTrain.h>
#include <pacini/synthesis/TransientPulse.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
double pulseHertz(const Pulse& pulse, double fs)
{
    return pulse.cyclesPerFrame * fs;
}

std::vector<float> wholePulse(const Pulse& pulse, std::size_t extra, std::size_t block, double gain = 1.0)
{
    std::vector<float> y(pulse.frames + extra, 0.0f);
    PulseVoice voice(pulse);
    for (std::size_t i = 0; i < y.size(); i += block)
        voice.addTo(std::span(y).subspan(i, std::min(block, y.size() - i)), gain);
    return y;
}
} // namespace

TEST_CASE("A pulse is adaptive, of one cycle at 67 Hz and of any frequency unless told otherwise", "[synthesis]")
{
    const PulseParams params;
    CHECK(params.shape == TransientShape::adaptive);
    CHECK(params.frequency == 67.0);
    CHECK(params.cycles == 1.0);
    CHECK(params.lowest == 1.0);
    CHECK(params.highest == 20e3);
    const Pulse pulse;
    CHECK(pulse.shape == TransientShape::square);
    CHECK(pulse.cyclesPerFrame == 0.0);
    CHECK(pulse.frames == 0);
    CHECK(PulseVoice().finished());
}

TEST_CASE("Square and sine pulses last a rounded number of frames for their cycles", "[synthesis]")
{
    for (const TransientShape shape : {TransientShape::square, TransientShape::sine})
    {
        const Pulse pulse = makePulse({shape, 80.0, 1.5, 200.0, 300.0}, 0.7, 0.01, 48000.0, 1.0);
        CHECK(pulse.shape == shape);
        CHECK(pulseHertz(pulse, 48000.0) == Approx(80.0));
        CHECK(pulse.frames == 900);
        // Half a frame rounds up, less down.
        CHECK(makePulse({shape, 400.0, 1.0}, 0.0, 1.0, 1000.0, 1.0).frames == 3);
        CHECK(makePulse({shape, 410.0, 1.0}, 0.0, 1.0, 1000.0, 1.0).frames == 2);
        // Transposed, they keep their cycles; frequencies end at 1 Hz and 0.45 of the rate.
        const Pulse higher = makePulse({shape, 80.0, 1.5}, 0.7, 0.01, 48000.0, 2.0);
        CHECK(pulseHertz(higher, 48000.0) == Approx(160.0));
        CHECK(higher.frames == 450);
        const Pulse slow = makePulse({shape, 80.0, 0.5}, 0.7, 0.01, 2000.0, 0.001);
        CHECK(pulseHertz(slow, 2000.0) == Approx(1.0));
        CHECK(slow.frames == 1000);
        const Pulse fast = makePulse({shape, 400.0, 9.0}, 0.7, 0.01, 2000.0, 4.0);
        CHECK(pulseHertz(fast, 2000.0) == Approx(900.0));
        CHECK(fast.frames == 20);
    }
}

TEST_CASE("An event alone gets two periods of 100 Hz when it is dull to 280 Hz when it is crisp", "[synthesis]")
{
    for (const double gap : {0.06, 1.0, std::numeric_limits<double>::infinity()})
        for (const auto& [sharpness, hertz] :
             {std::pair{0.0, 100.0}, {0.5, 100.0 * std::sqrt(2.8)}, {1.0, 280.0}, {-1.0, 100.0}, {2.0, 280.0}})
        {
            CAPTURE(gap, sharpness);
            const Pulse pulse = makePulse({}, sharpness, gap, 48000.0, 1.0);
            CHECK(pulse.shape == TransientShape::adaptive);
            CHECK(pulseHertz(pulse, 48000.0) == Approx(hertz));
            CHECK(pulse.frames == static_cast<std::size_t>(std::lround(2.0 * 48000.0 / hertz)));
        }
    // Within what the actuator shows, with as many periods.
    const Pulse low = makePulse({TransientShape::adaptive, 67.0, 1.0, 1.0, 150.0}, 1.0, 1.0, 48000.0, 1.0);
    CHECK(pulseHertz(low, 48000.0) == Approx(150.0));
    CHECK(low.frames == 640);
    const Pulse high = makePulse({TransientShape::adaptive, 67.0, 1.0, 200.0, 300.0}, 0.0, 1.0, 48000.0, 1.0);
    CHECK(pulseHertz(high, 48000.0) == Approx(200.0));
    CHECK(high.frames == 480);
    // What is transposed leaves that range.
    CHECK(pulseHertz(makePulse({TransientShape::adaptive, 67.0, 1.0, 200.0, 300.0}, 0.0, 1.0, 48000.0, 2.0), 48000.0) ==
          Approx(400.0));
}

TEST_CASE("An event of a train lasts half of its gap, 6 to 15 ms, for three periods or more of 200 to 400 Hz",
          "[synthesis]")
{
    const auto wanted = [](double sharpness, double length)
    {
        const double least = 3.0 / length; // Hz
        return std::clamp(150.0 * std::pow(2500.0 / 150.0, sharpness), least, std::max(least, 400.0));
    };
    for (const auto& [gap, length] : {std::pair{0.0599, 0.015},
                                      {0.0305, 0.015},
                                      {0.0288, 0.0144},
                                      {0.02, 0.010},
                                      {0.015, 0.0075},
                                      {0.012, 0.006},
                                      {0.0095, 0.006},
                                      {0.0, 0.006}})
        for (const double sharpness : {0.0, 0.1, 0.2, 0.3, 0.35, 0.4, 1.0})
        {
            CAPTURE(gap, sharpness);
            const Pulse pulse = makePulse({}, sharpness, gap, 48000.0, 1.0);
            CHECK(pulseHertz(pulse, 48000.0) == Approx(wanted(sharpness, length)));
            CHECK(pulse.frames == static_cast<std::size_t>(std::lround(length * 48000.0)));
        }
    // An actuator's range comes after that, and the number of periods stays.
    const Pulse narrow = makePulse({TransientShape::adaptive, 67.0, 1.0, 1.0, 125.0}, 0.0, 0.02, 48000.0, 1.0);
    CHECK(pulseHertz(narrow, 48000.0) == Approx(125.0));
    CHECK(narrow.frames == 1152); // three periods of 300 Hz, 2.4 times as long
}

TEST_CASE("Square and sine pulses are their closed forms, however they are cut", "[synthesis]")
{
    const double fs = 48000.0;
    for (const TransientShape shape : {TransientShape::square, TransientShape::sine, TransientShape::adaptive})
    {
        const Pulse pulse = makePulse({shape, 333.0, 2.3}, 0.2, 1.0, fs, 1.0);
        const auto whole = wholePulse(pulse, 9, 10000);
        for (std::size_t n = 0; n < whole.size(); ++n)
        {
            CAPTURE(n);
            const double cycle = static_cast<double>(n) * pulse.cyclesPerFrame;
            const double middle = (static_cast<double>(n) + 0.5);
            const double wanted =
                n >= pulse.frames                 ? 0.0
                : shape == TransientShape::square ? (cycle - std::floor(cycle) < 0.5 ? 1.0 : -1.0)
                : shape == TransientShape::sine
                    ? std::sin(2.0 * std::numbers::pi * cycle)
                    : std::pow(std::sin(std::numbers::pi * middle / static_cast<double>(pulse.frames)), 2.0) *
                          std::sin(2.0 * std::numbers::pi * pulse.cyclesPerFrame * middle);
            REQUIRE(static_cast<double>(whole[n]) == Approx(wanted).margin(1e-7));
        }
        for (const std::size_t block : {std::size_t(1), std::size_t(3), std::size_t(4), std::size_t(7)})
            CHECK(wholePulse(pulse, 9, block) == whole);
        auto louder = whole;
        for (float& v : louder)
            v *= 4.0f;
        CHECK(wholePulse(pulse, 9, 5, 4.0) == louder);
    }
    // A square of two frames a period steps at the half itself.
    const Pulse pulse{TransientShape::square, 0.25, 8};
    CHECK(wholePulse(pulse, 0, 8) == std::vector<float>{1.0f, 1.0f, -1.0f, -1.0f, 1.0f, 1.0f, -1.0f, -1.0f});
}

TEST_CASE("A pulse adds to what is there and is finished with its last frame", "[synthesis]")
{
    const Pulse pulse{TransientShape::square, 0.25, 6};
    PulseVoice voice(pulse);
    std::vector<float> y(5, 10.0f);
    voice.addTo(y, 0.5);
    CHECK(y == std::vector<float>{10.5f, 10.5f, 9.5f, 9.5f, 10.5f});
    CHECK_FALSE(voice.finished());
    voice.addTo(std::span(y).first(1), 0.5);
    CHECK(voice.finished());
    CHECK(y[0] == 11.0f);
    voice.addTo(y, 0.5);
    CHECK(y == std::vector<float>{11.0f, 10.5f, 9.5f, 9.5f, 10.5f});
    std::vector<float> single(2, 0.0f);
    PulseVoice(Pulse{TransientShape::adaptive, 0.1, 1}).addTo(single, 1.0); // the top of the window
    CHECK(static_cast<double>(single[0]) == Approx(std::sin(0.1 * std::numbers::pi)));
    CHECK(single[1] == 0.0f);
    PulseVoice none(Pulse{TransientShape::adaptive, 0.1, 0});
    CHECK(none.finished());
    none.addTo(y, 1.0);
    CHECK(y == std::vector<float>{11.0f, 10.5f, 9.5f, 9.5f, 10.5f});
}

TEST_CASE("A train begins each pulse on its frame, late ones at once, and starts over after reset", "[synthesis]")
{
    const PulseParams square{TransientShape::square, 250.0, 1.0}; // 8 frames at 2 kHz, 4 up and 4 down
    PulseTrain train(square, 2000.0);
    train.reserve(4);
    for (const double frame : {-3.0, 5.0, 9.0, 40.0})
        train.add({frame, 1.0 + frame, 0.5, 1.0});
    const auto play = [&](std::size_t block)
    {
        train.reset();
        std::vector<float> y(64, 0.0f);
        for (std::size_t i = 0; i < y.size(); i += block)
            train.process(std::span(y).subspan(i, std::min(block, y.size() - i)), static_cast<std::int64_t>(i),
                          [](const PulseEvent& event) {
                              return PulseStart{static_cast<std::int64_t>(event.clipFrame), 1.0, 1.0};
                          });
        return y;
    };
    std::vector<float> wanted(64, 0.0f);
    for (const auto& [at, gain] : {std::pair{0, -2.0f}, {5, 6.0f}, {9, 10.0f}, {40, 41.0f}})
        for (int n = 0; n < 8; ++n)
            wanted[static_cast<std::size_t>(at + n)] += n < 4 ? gain : -gain;
    for (const std::size_t block : {std::size_t(64), std::size_t(1), std::size_t(3), std::size_t(5), std::size_t(8)})
    {
        CAPTURE(block);
        CHECK(play(block) == wanted);
    }
}

TEST_CASE("A train asks where an event begins, how fast the clip runs there and how high it is", "[synthesis]")
{
    // At half the speed a gap is twice as long: 40 ms of the clip are no train any more.
    PulseTrain train({}, 48000.0);
    train.add({100.0, 1.0, 0.0, 0.04});
    const auto lengthOf = [&](const PulseStart& start)
    {
        train.reset();
        std::vector<float> y(4000, 0.0f);
        train.process(y, 0, [&](const PulseEvent&) { return start; });
        const auto first = std::find_if(y.begin(), y.end(), [](float v) { return v != 0.0f; });
        const auto last = std::find_if(y.rbegin(), y.rend(), [](float v) { return v != 0.0f; });
        CHECK(first - y.begin() == start.frame);
        return static_cast<std::size_t>(last.base() - first);
    };
    CHECK(lengthOf({100, 1.0, 1.0}) == 720); // 15 ms
    CHECK(lengthOf({50, 0.5, 1.0}) == 960);  // two periods of 100 Hz
    CHECK(lengthOf({0, 0.5, 2.0}) == 480);   // of 200 Hz
    CHECK(lengthOf({10, 4.0, 1.0}) == 288);  // 10 ms apart: 6 ms
    const PulseStart usual;
    CHECK(usual.frame == 0);
    CHECK(usual.rate == 1.0);
    CHECK(usual.transposition == 1.0);
    const PulseEvent event;
    CHECK(event.clipFrame == 0.0);
    CHECK(event.gain == 0.0);
    CHECK(event.sharpness == 0.0);
    CHECK(event.gap == 0.0);
    // Made without a rate, it plays at 48 kHz.
    PulseTrain plain;
    plain.add({0.0, 1.0, 0.0, 1.0});
    std::vector<float> y(2000, 0.0f);
    plain.process(y, 0, [](const PulseEvent&) { return PulseStart{}; });
    CHECK(y[959] != 0.0f);
    CHECK(y[960] == 0.0f);
    // It was not reset before, and goes on in the next call all the same.
    PulseTrain cut;
    cut.add({0.0, 1.0, 0.0, 1.0});
    std::vector<float> parts(2000, 0.0f);
    cut.process(std::span(parts).first(100), 0, [](const PulseEvent&) { return PulseStart{}; });
    cut.process(std::span(parts).subspan(100), 100, [](const PulseEvent&) { return PulseStart{}; });
    CHECK(parts == y);
}

TEST_CASE("An event that begins with the next block is asked for with that block", "[synthesis]")
{
    PulseTrain train({TransientShape::square, 250.0, 1.0}, 2000.0);
    train.add({8.0, 1.0, 0.0, 1.0});
    std::vector<float> y(24, 0.0f);
    train.process(std::span(y).first(8), 0, [](const PulseEvent&) { return PulseStart{8, 1.0, 1.0}; });
    train.process(std::span(y).subspan(8), 8, [](const PulseEvent&) { return PulseStart{8, 1.0, 2.0}; });
    const auto sounding = std::count_if(y.begin(), y.end(), [](float v) { return v != 0.0f; });
    CHECK(sounding == 4); // twice as high by then
}

TEST_CASE("A pulse tops what bands reach at its time, 5 ms and 10 ms later", "[synthesis]")
{
    const Transient event{0.5, 0.5, 0.5};
    const auto with = [&](double time, double value)
    {
        // A spike of 1 ms on each side.
        return pulseLevel({{time - 0.001, 0.0}, {time, value}, {time + 0.001, 0.0}}, event);
    };
    for (const double after : {0.0, 0.005, 0.010})
    {
        CAPTURE(after);
        CHECK(with(0.5 + after, 0.15) == Approx(0.4)); // sqrt(0.5^2 - 0.3^2)
        CHECK(with(0.5 + after, 0.25) == Approx(0.0).margin(1e-9));
        CHECK(with(0.5 + after, 0.4) == 0.0);
    }
    for (const double after : {-0.005, 0.0025, 0.0075, 0.015})
        CHECK(with(0.5 + after, 0.4) == 0.5);
    CHECK(pulseLevel({}, event) == 0.5);
    CHECK(pulseLevel({{0.0, 0.1}, {1.0, 0.1}}, event) == Approx(std::sqrt(0.21)));
}
