#include "devices/DriveRumble.h"

#include "devices/DecodeRumble.h"
#include "devices/WaveformDevice.h"
#include "support/Catch.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <variant>
#include <vector>

using namespace pacini;
using namespace pacini::devices;

namespace
{
constexpr ControllerModel pad{ControllerHaptics::dualSense, Transport::usb};
constexpr ControllerModel joyCons{ControllerHaptics::hdRumble, Transport::bluetooth};

// A drive signal by channel and second.
using Drive = std::function<double(std::size_t, double)>;

// Renders a drive signal and counts the frames.
struct Rendered
{
    DriveRenderer renderer()
    {
        return [this](std::span<const std::span<float>> out)
        {
            REQUIRE(out[0].size() <= DriveRumble::blockFrames);
            for (std::size_t c = 0; c < out.size(); ++c)
                for (std::size_t i = 0; i < out[c].size(); ++i)
                    out[c][i] = static_cast<float>(drive(c, static_cast<double>(frames + i) / fs));
            frames += out[0].size();
        };
    }
    Drive drive;
    double fs;
    std::size_t frames = 0;
};

double sineOf(double frequency, double seconds)
{
    return std::sin(2.0 * std::numbers::pi * frequency * seconds);
}

template <typename State>
std::vector<State> statesOf(const Drive& drive, std::size_t channels, const ControllerModel& model, int packets,
                            double fs = 48000.0)
{
    Rendered rendered{drive, fs};
    DriveRumble rumble(rendered.renderer(), channels, fs, model);
    std::vector<State> states;
    for (int packet = 0; packet < packets; ++packet)
        states.push_back(std::get<State>(*rumble.at(packet)));
    return states;
}
} // namespace

TEST_CASE("A tone is felt on the motor that it is nearest to, as strong as it is, at any rate", "[devices]")
{
    for (const double fs : {8000.0, 44100.0, 192000.0})
        for (const double frequency : {60.0, 100.0, 180.0, 300.0, 500.0})
        {
            CAPTURE(fs, frequency);
            const auto levels = statesOf<MotorLevels>([&](std::size_t, double t) { return 0.5 * sineOf(frequency, t); },
                                                      1, pad, 60, fs);
            const bool high = frequency > carrierBorder.value;
            for (std::size_t n = 20; n < levels.size(); ++n) // after the event at its start
            {
                CAPTURE(n);
                CHECK((high ? levels[n].weak : levels[n].strong) == Approx(0.5).epsilon(0.25));
                CHECK((high ? levels[n].strong : levels[n].weak) < 0.05);
            }
        }
}

TEST_CASE("Two actuators play on the two sides of HD rumble, each at its pitch", "[devices]")
{
    const auto sides = statesOf<SidesRumble>([](std::size_t channel, double t)
                                             { return channel == 0 ? 0.4 * sineOf(130.0, t) : 0.6 * sineOf(300.0, t); },
                                             2, joyCons, 40);
    const RumbleTones left = decodeRumble(sides.back().left).value();
    const RumbleTones right = decodeRumble(sides.back().right).value();
    CHECK(left.low.frequency.value == Approx(130.0).epsilon(0.05));
    CHECK(left.low.amplitude == Approx(0.4).epsilon(0.1));
    CHECK(left.high.amplitude < 0.03);
    CHECK(right.high.frequency.value == Approx(300.0).epsilon(0.05));
    CHECK(right.high.amplitude == Approx(0.6).epsilon(0.1));
    CHECK(right.low.amplitude < 0.03);
}

TEST_CASE("One actuator plays on both sides, and two on motors that have none", "[devices]")
{
    const auto sides =
        statesOf<SidesRumble>([](std::size_t, double t) { return 0.4 * sineOf(160.0, t); }, 1, joyCons, 20);
    CHECK(sides.back().left == sides.back().right);
    const auto levels = statesOf<MotorLevels>(
        [](std::size_t channel, double t) { return channel == 0 ? 0.3 * sineOf(100.0, t) : 0.4 * sineOf(300.0, t); }, 2,
        pad, 40);
    CHECK(levels.back().strong == Approx(0.3).epsilon(0.15));
    CHECK(levels.back().weak == Approx(0.4).epsilon(0.15));
}

TEST_CASE("A pulse is held on motors for 30 ms and triggers one event of waveforms", "[devices]")
{
    const auto pulse = [](std::size_t, double t)
    {
        return t >= 0.2 && t < 0.21 ? 0.8 * sineOf(200.0, t - 0.2) : 0.0;
    };
    const auto levels = statesOf<MotorLevels>(pulse, 1, pad, 60);
    int held = 0;
    for (const MotorLevels& each : levels)
        held += std::hypot(each.strong, each.weak) > 0.7 ? 1 : 0;
    CHECK(held == 3);

    const auto triggered =
        statesOf<WaveformState>(pulse, 1, {ControllerHaptics::waveforms, Transport::usb, standardTrigger()}, 30);
    int events = 0;
    for (const WaveformState& each : triggered)
        events += each.begins && each.waveform == Waveform::event ? 1 : 0;
    CHECK(events == 1);
}

TEST_CASE("When the drive is silent, the controller soon is, to the last bit", "[devices]")
{
    const auto burst = [](std::size_t, double t)
    {
        return t < 0.3 ? 0.9 * sineOf(120.0, t) : 0.0;
    };
    const auto sides = statesOf<SidesRumble>(burst, 2, joyCons, 40);
    CHECK_FALSE(sides[19] == SidesRumble{});
    CHECK(sides[30] == SidesRumble{}); // 150 ms later
    const auto levels = statesOf<MotorLevels>(burst, 2, pad, 60);
    CHECK(levels[40] == MotorLevels{});
}

TEST_CASE("A packet pulls the frames that it lasts, and those that were left out up to a second", "[devices]")
{
    Rendered rendered{[](std::size_t, double) { return 0.0; }, 44100.0};
    DriveRumble rumble(rendered.renderer(), 1, rendered.fs, joyCons); // 661.5 frames
    for (int packet = 0; packet < 100; ++packet)
        static_cast<void>(rumble.at(packet));
    CHECK(rendered.frames == 66150);
    static_cast<void>(rumble.at(109));
    CHECK(rendered.frames == 66150 + 6615);
    static_cast<void>(rumble.at(1000000));
    CHECK(rendered.frames < 66150 + 6615 + 46000);
}

TEST_CASE("Samples of a Steam Controller come from any rate that is not below its own", "[devices]")
{
    const ControllerModel steam{ControllerHaptics::steamController, Transport::receiver};
    CHECK(DriveRumble::takesRate(8000.0, steam));
    CHECK_FALSE(DriveRumble::takesRate(7999.0, steam));
    CHECK_FALSE(DriveRumble::takesRate(44100.5, steam));
    CHECK(DriveRumble::takesRate(2000.0, {ControllerHaptics::steamController, Transport::bluetooth}));
    CHECK(DriveRumble::takesRate(2000.5, pad));
    for (const double fs : {8000.0, 44100.0, 48000.0})
    {
        CAPTURE(fs);
        const auto blocks = statesOf<PcmBlock>([](std::size_t channel, double t)
                                               { return channel == 0 ? 0.5 * sineOf(250.0, t) : 0.25; },
                                               2, steam, 40, fs);
        for (std::size_t n = 10; n < 40; ++n)
            for (std::size_t i = 0; i < 31; ++i)
            {
                const double t = static_cast<double>(31 * n + i) / 8000.0;
                CHECK(blocks[n].left[i] == Approx(16383.0 * sineOf(250.0, t)).margin(150.0));
                CHECK(blocks[n].right[i] == Approx(8192.0).margin(60.0));
            }
    }
}
