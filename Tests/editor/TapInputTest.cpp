// Taps by pads and game controllers, from a joystick that a pipe stands for; scrubbing.

#include "app/editor/TapInput.h"

#include "editor/Bench.h"
#include "editor/Pump.h"
#include "support/TempFolder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>

#if JUCE_LINUX
#include <sys/stat.h>
#endif

using namespace pacini;
using namespace pacini::test;

namespace
{
/// Plays blocks as a device would, so that the playhead moves.
void playOn(editor::Session& session, int blocks)
{
    for (int i = 0; i < blocks; ++i)
    {
        std::array<float, 256> haptic{};
        const std::span<float> drive(haptic);
        session.player.process(std::span(&drive, 1), {});
    }
}
} // namespace

TEST_CASE("Pads tap events while the clip plays, with their velocity, as one step")
{
    EditorBench bench({shipped("lra-175")});
    bench.openDemo("impact_boom");
    app::TapInput taps(bench.session.tapping, bench.session.transport, "/nowhere");
    taps.inBackground = true;
    const std::size_t before = bench.session.model.clip()->transients.size();
    const std::size_t steps = bench.session.model.document().steps().size();
    // Nothing plays: nothing is tapped.
    taps.tap(0.5);
    pumpFor(0.1);
    CHECK(bench.session.model.clip()->transients.size() == before);
    bench.session.transport.play();
    REQUIRE(pumpUntil(
        [&]
        {
            playOn(bench.session, 1);
            return bench.session.transport.playhead() > 0.05;
        }));
    taps.tap(0.25);
    REQUIRE(pumpUntil([&] { return bench.session.model.clip()->transients.size() == before + 1; }));
    playOn(bench.session, 20);
    taps.tap(0.9);
    REQUIRE(pumpUntil([&] { return bench.session.model.clip()->transients.size() == before + 2; }));
    CHECK(bench.session.model.document().steps().size() == steps + 1);
    std::vector<double> levels;
    for (const Transient& event : bench.session.model.clip()->transients)
        levels.push_back(event.amplitude);
    CHECK(std::count(levels.begin(), levels.end(), 0.25) == 1);
    CHECK(std::count(levels.begin(), levels.end(), 0.9) == 1);
}

#if JUCE_LINUX
TEST_CASE("Buttons of a joystick tap events, and one that is unplugged and comes again does so again")
{
    EditorBench bench({shipped("lra-175")});
    bench.openDemo("impact_boom");
    const TempFolder folder;
    REQUIRE(mkfifo((folder / "js0").c_str(), 0600) == 0);
    app::TapInput taps(bench.session.tapping, bench.session.transport, folder.path());
    taps.inBackground = true;
    bench.session.transport.play();
    const std::size_t before = bench.session.model.clip()->transients.size();
    for (std::size_t plugged = 1; plugged <= 2; ++plugged)
    {
        std::ofstream joystick(folder / "js0", std::ios::binary);
        const auto send = [&](std::uint8_t type, std::int16_t value)
        {
            std::array<char, 8> event{};
            event[4] = static_cast<char>(value & 0xFF);
            event[5] = static_cast<char>(value >> 8);
            event[6] = static_cast<char>(type);
            joystick.write(event.data(), event.size());
            joystick.flush();
        };
        send(0x81, 1); // how it stands
        send(1, 1);
        send(1, 0); // let go
        send(2, 1); // an axis
        const bool tapped = pumpUntil(
            [&]
            {
                playOn(bench.session, 1);
                return bench.session.model.clip()->transients.size() == before + plugged;
            },
            20.0);
        REQUIRE(tapped);
        pumpFor(0.3);
        CHECK(bench.session.model.clip()->transients.size() == before + plugged);
        if (!bench.session.transport.isPlaying())
            bench.session.transport.play();
    }
}
#endif

TEST_CASE("Scrubbing plays a moment of what is there, and is no playing")
{
    EditorBench bench({shipped("lra-175")});
    bench.openDemo("impact_boom");
    auto& transport = bench.session.transport;
    transport.scrub(0.2);
    CHECK(bench.session.player.isPlaying());
    CHECK_FALSE(transport.isPlaying());
    CHECK(transport.playhead() == 0.2);
    float most = 0.0f;
    const auto hear = [&]
    {
        std::array<float, 256> haptic{};
        const std::span<float> drive(haptic);
        bench.session.player.process(std::span(&drive, 1), {});
        for (const float sample : haptic)
            most = std::max(most, std::abs(sample));
        return !bench.session.player.isPlaying();
    };
    CHECK(pumpUntil(hear, 5.0)); // ends by itself
    CHECK(most > 0.001f);
    CHECK(transport.playhead() == 0.2);
    transport.scrub(0.3);
    transport.play();
    CHECK(transport.isPlaying());
    pumpFor(0.2);
    CHECK(transport.isPlaying()); // a moment that was heard does not end it
}
