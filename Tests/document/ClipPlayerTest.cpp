#include "document/ClipPlayer.h"

#include "document/Amendments.h"
#include "document/Document.h"
#include "document/HostedProject.h"
#include "document/ProjectJson.h"
#include "support/Catch.h"
#include "support/ShippedProfile.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>

using namespace pacini;

namespace
{
std::shared_ptr<const Clip> tone(double duration)
{
    Clip clip;
    clip.duration = duration;
    clip.bands = {{100.0, 150.0, 220.0, 0, {{0.0, 0.5}, {duration, 0.5}}, {}}};
    return std::make_shared<const Clip>(clip);
}

Playback playbackOf(std::shared_ptr<const Clip> clip)
{
    Playback playback;
    playback.a = std::move(clip);
    playback.source = true;
    return playback;
}

std::shared_ptr<const StoredAudio> constantSound(double duration, float level)
{
    AudioData audio;
    audio.sampleRate = 22050;
    audio.channels = 1;
    audio.samples.assign(static_cast<std::size_t>(22050.0 * duration), level);
    return std::make_shared<const StoredAudio>(audio);
}

struct Heard
{
    float haptic = 0.0f, sound = 0.0f;
};

/// The largest samples of blocks that `process` writes, until `enough` says so or 10 s have passed.
template <typename Process, typename Enough>
Heard listen(Process&& process, Enough&& enough)
{
    Heard heard;
    for (int block = 0; block < 2000 && !enough(heard); ++block)
    {
        std::array<float, 64> haptic{}, sound{};
        const std::span<float> channels[] = {sound};
        process(std::span<float>(haptic), std::span<const std::span<float>>(channels));
        for (std::size_t i = 0; i < haptic.size(); ++i)
        {
            heard.haptic = std::max(heard.haptic, std::abs(haptic[i]));
            heard.sound = std::max(heard.sound, std::abs(sound[i]));
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return heard;
}

bool both(const Heard& heard)
{
    return heard.haptic > 0.3f && heard.sound > 0.245f; // both faded in
}
} // namespace

TEST_CASE("A clip and its sound are heard at every rate of the device, without a message loop")
{
    ClipPlayer player;
    player.set(playbackOf(tone(100.0)));
    player.setSound(constantSound(100.0, 0.25f));
    for (const double rate : {48000.0, 8000.0, 11025.0})
    {
        CAPTURE(rate);
        player.prepare(rate);
        player.play(1.0);
        const auto process = [&](auto haptic, auto sound)
        {
            player.process(std::span(&haptic, 1), sound);
        };
        const Heard heard = listen(process, both);
        CHECK(heard.haptic > 0.3f);
        CHECK(heard.sound == Approx(0.25f).margin(0.01));
    }
}

TEST_CASE("Actuator and strength stay when the device changes its rate")
{
    Clip onResonance = *tone(100.0);
    onResonance.bands = {{200.0, 235.0, 270.0, 0, {{0.0, 0.3}, {100.0, 0.3}}, {}}};
    const auto clip = std::make_shared<const Clip>(onResonance);
    const auto loudest = [&](double strength)
    {
        ClipPlayer player;
        PreviewRow row;
        row.profiles = {std::make_shared<const Profile>(test::shippedProfile("lra-235-narrow"))};
        row.strength = strength;
        player.setRow(row);
        player.set(playbackOf(clip));
        player.prepare(16000.0);
        player.play(0.0);
        int blocks = 0; // that sound
        const auto process = [&](auto haptic, auto sound)
        {
            player.process(std::span(&haptic, 1), sound);
            blocks += haptic[0] != 0.0f ? 1 : 0;
        };
        return listen(process, [&](const Heard&) { return blocks > 40; }).haptic;
    };
    CHECK(loudest(1.0) > 1.5f * loudest(0.0));
}

TEST_CASE("Another sound takes the place of the one that is played")
{
    ClipPlayer player;
    player.set(playbackOf(tone(100.0)));
    for (int i = 0; i < 5; ++i)
        player.setSound(constantSound(60.0, 0.9f));
    player.setSound(constantSound(60.0, 0.25f));
    player.play(1.0);
    const auto process = [&](auto haptic, auto sound)
    {
        player.process(std::span(&haptic, 1), sound);
    };
    CHECK(listen(process, both).sound == Approx(0.25f).margin(0.01));
    player.setSound(nullptr);
    const auto blocks = [](int count)
    {
        return [count](const Heard&) mutable
        {
            return count-- == 0;
        };
    };
    static_cast<void>(listen(process, blocks(100))); // it fades out
    CHECK(listen(process, blocks(20)).sound == 0.0f);
}

TEST_CASE("A project in a plugin is kept for the host though no editor was ever opened")
{
    HostedProject hosted;
    CHECK(hosted.text().empty());
    Project project;
    project.notes = "kept";
    const std::string text = projectJson(project);
    int changes = 0;
    hosted.onChange = [&]
    {
        ++changes;
    };
    REQUIRE(hosted.setText(text));
    CHECK(hosted.text() == text);
    REQUIRE(hosted.setText(text)); // nothing new
    CHECK(changes == 1);
    CHECK_FALSE(hosted.setText("{\"format\": \"something else\"}"));
    CHECK(hosted.text() == text);

    const auto brought = hosted.take();
    REQUIRE(brought);
    CHECK(*brought == project);
    CHECK_FALSE(hosted.take());
    project.notes = "edited";
    hosted.keep(project);
    CHECK(hosted.text() == projectJson(project));
}

TEST_CASE("A plugin hears its editor's player at the host's rate and nobody else")
{
    HostedProject hosted;
    const auto isHeard = [&](float least)
    {
        const auto process = [&](auto haptic, auto sound)
        {
            (void)hosted.process(haptic, sound);
        };
        return listen(process, [&](const Heard& heard) { return heard.haptic > least; }).haptic > least;
    };
    std::array<float, 64> block{};
    CHECK_FALSE(hosted.process(block, {}));

    ClipPlayer player;
    player.set(playbackOf(tone(100.0)));
    hosted.setPlayer(&player);
    hosted.prepare(8000.0);
    player.play(0.0);
    CHECK_FALSE(hosted.process(block, {})); // the player has another rate
    CHECK_FALSE(hosted.take());
    player.play(0.0);
    CHECK(isHeard(0.3f));
    player.stop();
    int blocks = 0;
    while (hosted.process(block, {}) && blocks < 1000)
        ++blocks;
    CHECK(blocks == 8); // in which it fades out
    hosted.setPlayer(nullptr);
    player.play(0.0);
    CHECK_FALSE(hosted.process(block, {}));
}

TEST_CASE("A session that has too much sound to be kept keeps the clips")
{
    Document document;
    AudioReference sound;
    sound.path = "capture 1.wav";
    sound.embedded = std::make_shared<const std::string>(HostedProject::largestText, 'x');
    sound.hash = "0123456789abcdef";
    REQUIRE(addSound(document, sound, {}, *tone(1.0)));
    HostedProject hosted;
    hosted.keep(document.project());
    const auto read = readProjectJson(hosted.text());
    REQUIRE(read);
    REQUIRE(read->project.clips.size() == 1);
    CHECK(*read->project.clips[0]->clip == *tone(1.0));
    REQUIRE(read->project.sources.size() == 1);
    CHECK(read->project.sources[0].embedded == nullptr);
}
