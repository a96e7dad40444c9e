#include "live/LiveDrive.h"

#include "live/LiveRumble.h"
#include "live/TrackedDrive.h"
#include "support/Catch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <variant>
#include <vector>

using namespace pacini;
using namespace pacini::live;

namespace
{
constexpr devices::ControllerModel pad{devices::ControllerHaptics::dualSense, devices::Transport::usb};

std::vector<float> tone(double frequency, double fs, std::size_t frames)
{
    std::vector<float> samples(frames);
    for (std::size_t i = 0; i < frames; ++i)
        samples[i] =
            static_cast<float>(0.5 * std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(i) / fs));
    return samples;
}

/// A tone that is pushed by a clock and read by another, block by block, in simulated time.
struct TwoClocks
{
    static constexpr double fs = 8000.0;
    static constexpr double frequency = 100.0;
    static constexpr std::size_t comes = 40, goes = 64;

    TwoClocks(double sourcePpm, std::size_t wanted)
        : sourceFs(fs * (1.0 + 1e-6 * sourcePpm)), tracked(drive, fs, fs, wanted)
    {
    }

    /// Reads for so long, and hands every block to `visit`.
    template <typename Visit>
    void run(double seconds, Visit visit)
    {
        std::vector<float> in(comes), out(goes);
        for (const double end = time + seconds; time < end; time += static_cast<double>(goes) / fs)
        {
            while (static_cast<double>(pushed + comes) <= time * sourceFs)
            {
                for (float& sample : in)
                    sample = static_cast<float>(
                        0.5 * std::sin(2.0 * std::numbers::pi * frequency * static_cast<double>(pushed++) / fs));
                drive.push(in);
            }
            tracked.read(out);
            visit(std::span<const float>(out));
        }
    }

    double sourceFs;
    LiveDrive drive{8000};
    TrackedDrive tracked;
    double time = 0.0;
    std::uint64_t pushed = 0;
};
} // namespace

TEST_CASE("Live: what was pushed while nobody listened is not played")
{
    LiveDrive drive(100);
    std::vector<float> frames(10, 1.0f);
    drive.push(frames);
    drive.listen(false);
    drive.push(frames);
    CHECK(drive.waiting() == 0);
    drive.listen(true);
    frames.assign(10, 2.0f);
    drive.push(frames);
    std::vector<float> got(100);
    REQUIRE(drive.take(got) == 10);
    CHECK(got[0] == 2.0f);
}

TEST_CASE("Live: in an hour with clocks 200 ppm apart nothing drifts and no sample is lost")
{
    for (const double ppm : {200.0, -200.0, 0.0})
    {
        const std::size_t wanted = 160;
        TwoClocks clocks(ppm, wanted);
        clocks.run(60.0, [](auto) {});
        double least = 1e9, most = 0.0, corrections = 0.0, reads = 0.0, widest = 0.0;
        clocks.run(3540.0,
                   [&](auto)
                   {
                       const auto waiting = static_cast<double>(clocks.drive.waiting());
                       least = std::min(least, waiting);
                       most = std::max(most, waiting);
                       corrections += clocks.tracked.correction() - 1.0;
                       widest = std::max(widest, std::abs(clocks.tracked.correction() - 1.0));
                       reads += 1.0;
                   });
        CAPTURE(ppm, least, most, widest);
        CHECK(clocks.tracked.standstills() == 0);
        CHECK(least > 0.0);
        // After a read, `goes` of what was wanted are gone; blocks come and go at any phase.
        CHECK(most < static_cast<double>(wanted + TwoClocks::comes));
        CHECK(std::abs(corrections / reads - 1e-6 * ppm) < 1e-6);
        CHECK(widest < 0.001); // no ear, let alone skin, tells a pitch by less than that
        CHECK(clocks.drive.lost() == 0);
    }
}

TEST_CASE("Live: a tracked tone stays a tone")
{
    TwoClocks clocks(200.0, 160);
    clocks.run(60.0, [](auto) {});
    std::vector<double> read;
    clocks.run(2.0,
               [&](std::span<const float> out)
               {
                   for (const float sample : out)
                       read.push_back(static_cast<double>(sample));
               });
    // What is left of it without the sinusoid of its own frequency, that of the source's clock.
    const double w = 2.0 * std::numbers::pi * TwoClocks::frequency * (1.0 + 200e-6) / TwoClocks::fs;
    double worst = 0.0;
    for (std::size_t i = 1; i + 1 < read.size(); ++i)
        worst = std::max(worst, std::abs(read[i - 1] + read[i + 1] - 2.0 * std::cos(w) * read[i]));
    CHECK(worst < 2e-4);
}

TEST_CASE("Live: a queue that ran empty is silent until it is filled, and one that is too full is shortened")
{
    LiveDrive drive(8000);
    TrackedDrive tracked(drive, 8000.0, 8000.0, 80);
    std::vector<float> in(80, 0.5f), out(80, 1.0f);
    tracked.read(out);
    CHECK(std::all_of(out.begin(), out.end(), [](float v) { return v == 0.0f; }));
    drive.push(in);
    drive.push(in);
    tracked.read(out);
    CHECK(out.back() == Approx(0.5f));
    tracked.read(out);
    tracked.read(out);
    CHECK(tracked.standstills() == 1);
    for (int i = 0; i < 20; ++i)
        drive.push(in);
    tracked.read(out);
    CHECK(tracked.standstills() == 2);
    CHECK(drive.waiting() <= 80);
}

TEST_CASE("Live: the end of a drive is played, however short it is")
{
    for (const std::size_t frames : {10u, 79u, 200u})
    {
        LiveDrive drive(8000);
        TrackedDrive tracked(drive, 8000.0, 8000.0, 80);
        const std::vector<float> in(frames, 0.5f);
        drive.push(in);
        drive.end();
        std::vector<float> out(64);
        double sum = 0.0;
        for (int i = 0; i < 8; ++i)
        {
            tracked.read(out);
            for (const float sample : out)
                sum += static_cast<double>(sample);
        }
        CHECK(tracked.isOver());
        CHECK(tracked.standstills() == 0);
        CHECK(sum == Approx(0.5 * static_cast<double>(frames)).margin(2.0)); // without its last three frames
    }
}

TEST_CASE("Live: a controller's packets take all that has come, and nothing drifts in an hour")
{
    LiveDrive drive(4800);
    LiveRumble rumble(drive, 8000.0, pad);
    const auto silence = devices::silentState(pad);
    std::vector<float> block(21, 0.0f);
    std::uint64_t pushed = 0;
    std::size_t wrong = 0;
    const std::int64_t packets = 360000; // of 10 ms
    for (std::int64_t packet = 0; packet < packets; ++packet)
    {
        // The source's clock is 200 ppm faster. In the last packets before the end something sounds.
        const double now = 0.010 * static_cast<double>(packet + 1);
        const bool sounds = packet >= packets - 2;
        std::fill(block.begin(), block.end(), sounds ? 0.5f : 0.0f);
        while (static_cast<double>(pushed + block.size()) <= now * 8000.0 * 1.0002)
        {
            drive.push(block);
            pushed += block.size();
        }
        const auto state = rumble.at(packet);
        wrong += !state || (*state == silence) == sounds ? 1u : 0u;
        wrong += drive.waiting() > 0 ? 1u : 0u;
    }
    CHECK(wrong == 0);
    CHECK(drive.lost() == 0);
    drive.end();
    CHECK_FALSE(rumble.at(packets));
}

TEST_CASE("Live: a packet without news holds the last, and lets go when nothing comes any more")
{
    LiveDrive drive(4800);
    LiveRumble rumble(drive, 8000.0, pad);
    const auto sound = tone(100.0, 8000.0, 800);
    drive.push(sound);
    static_cast<void>(rumble.at(0));
    drive.push(sound);
    const auto playing = std::get<devices::MotorLevels>(*rumble.at(1));
    CHECK(playing.strong > 0.1);
    CHECK(std::get<devices::MotorLevels>(*rumble.at(3)).strong > 0.1);
    CHECK(*rumble.at(20) == devices::silentState(pad));
}

TEST_CASE("Live: what plays samples is sent the drive at its own pace")
{
    constexpr devices::ControllerModel steam{devices::ControllerHaptics::steamController, devices::Transport::usb};
    LiveDrive drive(48000);
    LiveRumble rumble(drive, 48000.0, steam);
    const auto sound = tone(100.0, 48000.0, 90); // 1.875 ms
    drive.push(tone(100.0, 48000.0, 960));
    double loudest = 0.0;
    for (std::int64_t packet = 0; packet < 200; ++packet)
    {
        drive.push(sound);
        const auto block = std::get<devices::PcmBlock>(*rumble.at(packet));
        loudest = std::max(loudest, std::abs(static_cast<double>(block.left[0])));
        CHECK(block.left == block.right);
    }
    CHECK(loudest > 8000.0);
    drive.end();
    std::int64_t packet = 200;
    while (packet < 400 && rumble.at(packet))
        ++packet;
    CHECK(packet < 300);
}
