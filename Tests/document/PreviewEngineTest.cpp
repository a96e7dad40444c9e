#include "document/PreviewEngine.h"

#include "actuator/Witness.h"
#include "document/PreviewWorker.h"
#include "support/ActuatorOf.h"
#include "support/Catch.h"
#include "support/HeapGuard.h"
#include "support/ShippedProfile.h"

#include <pacini/actuator/Strength.h>
#include <pacini/clip/edits/RangeEdits.h>
#include <pacini/synthesis/CompilePlan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

using namespace pacini;

namespace
{
constexpr double fs = 48000.0;

std::shared_ptr<const Clip> tone(double duration, double level, double frequency = 150.0)
{
    Clip clip;
    clip.duration = duration;
    clip.bands = {{100.0, frequency, 220.0, 0, {{0.0, level}, {duration, level}}, {}}};
    return std::make_shared<const Clip>(clip);
}

Playback playbackOf(std::shared_ptr<const Clip> clip)
{
    Playback playback;
    playback.a = std::move(clip);
    return playback;
}

std::vector<float> run(PreviewEngine& engine, std::size_t frames, std::size_t block = 128)
{
    std::vector<float> out(frames);
    for (std::size_t i = 0; i < frames; i += block)
    {
        const std::span<float> part = std::span(out).subspan(i, std::min(block, frames - i));
        engine.process(std::span(&part, 1), {});
    }
    return out;
}

PreviewRow rowOf(std::shared_ptr<const Profile> profile, double strength = standardStrength)
{
    PreviewRow row;
    row.profiles = {std::move(profile)};
    row.strength = strength;
    return row;
}

float largest(std::span<const float> samples)
{
    float most = 0.0f;
    for (float s : samples)
        most = std::max(most, std::abs(s));
    return most;
}

/// The first frames of a clip in an engine, from the start.
std::vector<float> playedBy(PreviewEngine& engine, const std::shared_ptr<const Clip>& clip)
{
    engine.set(playbackOf(clip));
    engine.play(0.0);
    REQUIRE(engine.service());
    return run(engine, 40000);
}

/// The same frames as they are rendered.
std::vector<float> renderedFrames(const Clip& clip, const Profile* profile = nullptr, const CompileParams& params = {})
{
    Scene scene;
    scene.clips = {clip};
    scene.plays.emplace_back();
    ScenePlayer player(compilePlan(scene, profile, params).value());
    std::vector<float> frames(40000);
    std::span<float> out(frames);
    player.process(std::span(&out, 1));
    return frames;
}

/// The largest second difference: a click is a jump of value or slope.
float roughness(std::span<const float> samples)
{
    float most = 0.0f;
    for (std::size_t i = 2; i < samples.size(); ++i)
        most = std::max(most, std::abs(samples[i] - 2.0f * samples[i - 1] + samples[i - 2]));
    return most;
}
} // namespace

TEST_CASE("A preview from the start is what is rendered, bit for bit")
{
    const auto clip = tone(1.0, 0.5);
    PreviewEngine engine(fs);
    const auto heard = playedBy(engine, clip);
    const auto rendered = renderedFrames(*clip);
    CHECK(largest(rendered) > 0.4f);
    CHECK(std::equal(heard.begin(), heard.end(), rendered.begin()));
}

TEST_CASE("A preview with a strength is what is rendered with it, and another one is heard while it plays")
{
    const auto clip = tone(1.0, 0.5, 100.0);
    const auto profile = std::make_shared<const Profile>(test::shippedProfile("lra-175"));
    std::vector<float> flattest;
    for (const double strength : {0.0, standardStrength, 0.7, 1.0})
    {
        CAPTURE(strength);
        PreviewEngine engine(fs);
        engine.setRow(rowOf(profile, strength));
        const auto heard = playedBy(engine, clip);
        CompileParams params;
        params.adaptation.strength = strength; // as `pacini render --strength` has it
        const auto rendered = renderedFrames(*clip, profile.get(), params);
        REQUIRE(largest(rendered) > 0.05f);
        CHECK(std::equal(heard.begin(), heard.end(), rendered.begin()));
        if (flattest.empty())
            flattest = heard;
        else
            CHECK(heard != flattest);
    }
    PreviewEngine engine(fs);
    engine.setRow(rowOf(profile, 1.0));
    engine.set(playbackOf(clip));
    engine.play(0.0);
    REQUIRE(engine.service());
    (void)run(engine, 9600);
    engine.setRow(rowOf(profile, 0.0));
    REQUIRE(engine.wantsService());
    REQUIRE(engine.service());
    (void)run(engine, 2400);
    const auto heard = run(engine, 9600);
    for (std::size_t i = 0; i < heard.size(); ++i)
        REQUIRE(heard[i] == Approx(flattest[12000 + i]).margin(1e-5));
}

TEST_CASE("Jumping about takes an actuator that rings and is warm no farther than its limits")
{
    Profile profile = test::actuatorOf(Technology::lra, {175.0, 50.0}, {20.0, 1000.0, 60.0});
    profile.drive = {8.0, 2.0, 0.1, 1.0, 1e-3, 1e-4, 2.0}; // ohm, V, W, s, m, m
    EqualizerSection louder;
    louder.frequency = 175.0;
    louder.gain = 12.0;
    profile.equalizer.pushBack(louder);
    PreviewEngine engine(fs);
    engine.setRow(rowOf(std::make_shared<const Profile>(profile)));
    engine.set(playbackOf(tone(10.0, 1.0, 175.0)));
    test::Witness<test::SimulatedResonator> witness(profile, fs);
    for (int i = 0; i < 60; ++i)
    {
        engine.play(0.0371 * i);
        REQUIRE(engine.service());
        witness.hold(run(engine, i == 0 ? 24000 : 2400));
    }
    CHECK(witness.strain().travel > 0.9);
    CHECK(witness.strain().travel <= 1.001);
    CHECK(witness.strain().heat > 0.9);
    CHECK(witness.strain().heat <= 1.001);
}

TEST_CASE("An edit is heard from the block after next on, without a click")
{
    PreviewEngine engine(fs);
    engine.set(playbackOf(tone(10.0, 0.6)));
    engine.play(0.0);
    REQUIRE(engine.service());
    for (const double seconds : {1.0, 7.0})
    {
        engine.set(playbackOf(tone(10.0, 0.6)));
        engine.play(0.0);
        REQUIRE(engine.service());
        (void)run(engine, 1000);
        (void)run(engine, static_cast<std::size_t>(seconds * fs));
        const auto before = run(engine, 9600);
        engine.set(playbackOf(tone(10.0, 0.2)));
        REQUIRE(engine.wantsService());
        REQUIRE(engine.service());
        (void)run(engine, 0);
        const auto after = run(engine, 9600);
        std::vector<float> both = before;
        both.insert(both.end(), after.begin(), after.end());
        CHECK(largest(std::span(both).subspan(9600 + 1920, 4800)) == Approx(0.2f).margin(0.01));
        // 0.6 sin at 150 Hz bends by at most 0.6 (2 pi 150 / fs)^2 = 0.00023 from sample to sample, and where the
        // engine's fade of 10 ms begins or ends by (0.6 - 0.2) / 480 = 0.00083 more.
        CHECK(roughness(both) < 0.0011f);
        CHECK(engine.position() == Approx(seconds + 19200.0 / fs + 1000.0 / fs).margin(0.01));
    }
}

TEST_CASE("An edit elsewhere does not change what is heard near the start of a play, bit for bit")
{
    const auto clip = tone(4.0, 0.5);
    Clip edited = *clip;
    edited.transients = {{3.5, 0.9, 0.5}};
    const auto heard = [&](bool edit)
    {
        PreviewEngine engine(fs);
        engine.set(playbackOf(clip));
        engine.play(0.0);
        REQUIRE(engine.service());
        auto out = run(engine, 48000);
        if (edit)
        {
            engine.set(playbackOf(std::make_shared<const Clip>(edited)));
            REQUIRE(engine.service());
        }
        const auto more = run(engine, 24000);
        out.insert(out.end(), more.begin(), more.end());
        return out;
    };
    const auto plain = heard(false);
    const auto swapped = heard(true);
    double worst = 0.0;
    for (std::size_t i = 0; i < plain.size(); ++i)
        worst = std::max(worst, std::abs(static_cast<double>(plain[i]) - static_cast<double>(swapped[i])));
    CHECK(worst < 1e-6);
}

TEST_CASE("Playing makes no heap traffic, whatever is swapped")
{
    PreviewEngine engine(fs);
    engine.set(playbackOf(tone(10.0, 0.6)));
    engine.play(0.0);
    REQUIRE(engine.service());
    std::vector<float> out(4096);
    for (int i = 0; i < 5; ++i)
    {
        engine.set(playbackOf(tone(10.0, 0.1 * i)));
        REQUIRE(engine.service());
        std::size_t traffic = 0;
        {
            test::HeapGuard guard;
            for (std::size_t k = 0; k < 8; ++k)
            {
                const std::span<float> part = std::span(out).subspan(k * 512, 512);
                engine.process(std::span(&part, 1), {});
            }
            traffic = guard.traffic();
        }
        CHECK(traffic == 0);
    }
}

TEST_CASE("A clip plays to its end and stops; a stop is silent after 5 ms; a new play starts where it is told")
{
    PreviewEngine engine(fs);
    engine.set(playbackOf(tone(0.5, 0.5)));
    CHECK_FALSE(engine.isPlaying());
    CHECK(largest(run(engine, 1000)) == 0.0f);
    engine.play(0.25);
    CHECK(engine.isPlaying());
    REQUIRE(engine.service());
    (void)run(engine, 24000);
    CHECK_FALSE(engine.isPlaying());
    CHECK(largest(run(engine, 1000)) == 0.0f);
    CHECK(engine.position() == Approx(0.5).margin(0.03));
    engine.play(0.1);
    CHECK(largest(run(engine, 1000)) == 0.0f); // not built yet: the old one does not go on
    REQUIRE(engine.service());
    (void)run(engine, 4800);
    CHECK(engine.position() == Approx(0.2).margin(0.0011)); // a running engine begins when its look-ahead is over
    CHECK(engine.isPlaying());
    engine.stop();
    const auto tail = run(engine, 4800);
    CHECK(largest(std::span(tail).subspan(256)) == 0.0f);
    CHECK(roughness(tail) < 0.01f);
}

TEST_CASE("What was built for a start before is not heard at the next one")
{
    PreviewEngine engine(fs);
    engine.set(playbackOf(tone(4.0, 0.5)));
    engine.play(0.0);
    REQUIRE(engine.service());
    run(engine, 9600);
    // An edit is built while it plays, and handed over after the stop has been heard.
    engine.set(playbackOf(tone(4.0, 0.8)));
    REQUIRE(engine.service());
    engine.stop();
    run(engine, 256);
    run(engine, 9600);
    Clip later = *tone(4.0, 0.3);
    later.bands[0].amplitude = {{0.0, 0.0}, {2.0, 0.0}, {2.1, 0.3}, {4.0, 0.3}};
    engine.set(playbackOf(std::make_shared<const Clip>(later)));
    engine.play(1.0);
    CHECK(largest(run(engine, 4800)) == 0.0f); // nothing is built yet
    REQUIRE(engine.service());
    CHECK(largest(run(engine, 24000)) < 1e-3f); // silent there
    CHECK(largest(run(engine, 48000)) == Approx(0.3).epsilon(0.05));
}

TEST_CASE("A loop goes round and round, clip and sound together")
{
    Clip clip = *tone(2.0, 0.0);
    clip.transients = {{0.6, 0.8, 0.5}, {1.5, 0.8, 0.5}};
    AudioData audio;
    audio.sampleRate = 48000;
    audio.channels = 1;
    audio.samples.resize(96000);
    for (std::size_t i = 0; i < audio.samples.size(); ++i)
        audio.samples[i] = static_cast<float>(i) / 96000.0f;
    PreviewEngine engine(fs);
    Playback playback = playbackOf(std::make_shared<const Clip>(clip));
    playback.loop = TimeRange{0.5, 1.0};
    playback.source = true;
    engine.set(playback);
    engine.setSource(std::make_shared<const StoredAudio>(audio));
    engine.play(0.25);
    REQUIRE(engine.service());
    std::vector<float> haptic(40 * 48000), sound(haptic.size());
    for (std::size_t i = 0; i < haptic.size(); i += 480)
    {
        std::span<float> channel = std::span(sound).subspan(i, 480);
        const std::span<float> part = std::span(haptic).subspan(i, 480);
        engine.process(std::span(&part, 1), std::span(&channel, 1));
        if (engine.wantsService())
            REQUIRE(engine.service());
        CHECK(engine.position() < 1.0);
    }
    CHECK(engine.isPlaying());
    // The event at 0.6 s comes at 0.35 s, and every 0.5 s from then on; never the one behind the loop.
    for (int pass = 0; pass < 78; ++pass)
    {
        const auto event = static_cast<std::size_t>((0.35 + 0.5 * pass) * fs);
        INFO("pass " << pass);
        CHECK(largest(std::span(haptic).subspan(event - 480, 1440)) > 0.5f);
        CHECK(largest(std::span(haptic).subspan(event + 9600, 9600)) < 0.05f);
        CHECK(sound[event] == Approx(0.3).margin(1e-3));
    }
}

TEST_CASE("Source and drive signal are switched without a jump")
{
    AudioData audio;
    audio.sampleRate = 48000;
    audio.channels = 2;
    audio.samples.assign(2 * 96000, 0.5f);
    PreviewEngine engine(fs);
    Playback playback = playbackOf(tone(2.0, 0.5));
    engine.set(playback);
    engine.setSource(std::make_shared<const StoredAudio>(audio));
    engine.play(0.0);
    REQUIRE(engine.service());
    std::vector<float> haptic(9600), left(9600), right(9600);
    const auto play = [&]
    {
        const std::span<float> channels[] = {left, right};
        const std::span<float> drive = haptic;
        engine.process(std::span(&drive, 1), channels);
    };
    play();
    CHECK(largest(left) == 0.0f);
    playback.source = true;
    playback.haptic = false;
    engine.set(playback);
    CHECK_FALSE(engine.wantsService()); // nothing to build
    play();
    CHECK(largest(std::span(haptic).subspan(300)) == 0.0f);
    CHECK(right[9000] == Approx(0.5f));
    for (std::size_t i = 1; i < left.size(); ++i)
        REQUIRE(std::abs(left[i] - left[i - 1]) < 0.005f);
}

TEST_CASE("Takes A and B, soloed bands and a worker thread")
{
    Clip two = *tone(5.0, 0.4);
    two.bands.push_back({300.0, 350.0, 400.0, 1, {{0.0, 0.2}, {5.0, 0.2}}, {}});
    PreviewEngine engine(fs);
    PreviewWorker worker(engine);
    Playback playback = playbackOf(std::make_shared<const Clip>(two));
    playback.b = tone(5.0, 0.1);
    engine.set(playback);
    engine.play(0.0);
    worker.wake();
    const auto level = [&]
    {
        for (int i = 0; i < 500 && engine.wantsService(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        (void)run(engine, 4800);
        return largest(run(engine, 9600));
    };
    CHECK(level() == Approx(0.6).margin(0.05));
    playback.take = Take::b;
    engine.set(playback);
    worker.wake();
    CHECK(level() == Approx(0.1).margin(0.02));
    playback.take = Take::a;
    playback.audition.solo = {1};
    engine.set(playback);
    worker.wake();
    CHECK(level() == Approx(0.2).margin(0.02));
    CHECK_FALSE(worker.lastError());
}

TEST_CASE("The meters of a preview tell the peak of the drive and what protection takes, once")
{
    Profile profile; // a plain signal that is kept within full drive
    PreviewEngine engine(fs);
    engine.set(playbackOf(tone(2.0, 2.0))); // 6 dB above that
    engine.setRow(rowOf(std::make_shared<const Profile>(profile)));
    engine.play(0.0);
    REQUIRE(engine.service());
    run(engine, 20000);
    (void)engine.takeMeters();
    const auto heard = run(engine, 20000);
    const auto meters = engine.takeMeters();
    CHECK(meters.peak == Approx(static_cast<double>(largest(heard))));
    CHECK(meters.gainReduction == Approx(6.02).margin(0.5));
    CHECK(engine.takeMeters().peak == 0.0);
    engine.stop();
    run(engine, 4800);
    (void)engine.takeMeters();
    run(engine, 4800);
    CHECK(engine.takeMeters().peak == 0.0);
    CHECK(engine.takeMeters().gainReduction == 0.0);
}

TEST_CASE("Live controls change what plays, without anything built anew")
{
    PreviewEngine engine(fs);
    engine.set(playbackOf(tone(60.0, 0.4)));
    engine.play(0.0);
    REQUIRE(engine.service());
    const auto level = [&]
    {
        run(engine, 2400);
        return largest(run(engine, 9600));
    };
    const auto crossings = [&]
    {
        const auto y = run(engine, 48000);
        int count = 0;
        for (std::size_t i = 1; i < y.size(); ++i)
            count += y[i - 1] < 0.0f && y[i] >= 0.0f;
        return count;
    };
    CHECK(level() == Approx(0.4).margin(0.01));
    PlayControls controls;
    controls.gain = 0.5;
    engine.setControls(controls);
    REQUIRE(engine.wantsService());
    REQUIRE(engine.service());
    CHECK(level() == Approx(0.2).margin(0.01));
    controls.intensity = 0.5;
    engine.setControls(controls);
    REQUIRE(engine.service());
    CHECK(level() == Approx(0.1).margin(0.01));
    controls = {};
    controls.transposition = 12.0;
    engine.setControls(controls);
    REQUIRE(engine.service());
    run(engine, 4800);
    CHECK(crossings() == Approx(300).margin(2)); // 150 Hz and an octave
    const double before = engine.position();
    controls.speed = 2.0;
    engine.setControls(controls);
    REQUIRE(engine.service());
    run(engine, 48000);
    CHECK(engine.position() - before == Approx(2.0).margin(0.05));
    CHECK(crossings() == Approx(300).margin(2)); // pitches stay
    // An edit, a jump and another actuator keep them.
    engine.set(playbackOf(tone(60.0, 0.2)));
    REQUIRE(engine.service());
    run(engine, 4800);
    CHECK(crossings() == Approx(300).margin(2));
    engine.play(30.0);
    REQUIRE(engine.service());
    run(engine, 48000);
    CHECK(engine.position() == Approx(32.0).margin(0.05));
    CHECK(crossings() == Approx(300).margin(2));
}

TEST_CASE("Several actuators play the same clip, each by its profile; a pan moves it over their places")
{
    const auto lra = std::make_shared<const Profile>(test::shippedProfile("lra-175"));
    PreviewRow row;
    row.profiles = {nullptr, lra, nullptr};
    PreviewEngine engine(fs);
    engine.setRow(row);
    engine.set(playbackOf(tone(60.0, 0.4)));
    engine.play(0.0);
    REQUIRE(engine.service());
    std::vector<std::vector<float>> out(3, std::vector<float>(24000));
    const auto levels = [&]
    {
        std::vector<std::span<float>> spans(out.begin(), out.end());
        engine.process(spans, {});
        engine.process(spans, {});
        return std::array<float, 3>{largest(out[0]), largest(out[1]), largest(out[2])};
    };
    auto heard = levels();
    CHECK(heard[0] == Approx(0.4).margin(0.01)); // without a pan each gets all of it
    CHECK(heard[2] == Approx(0.4).margin(0.01));
    CHECK(heard[1] > 0.05f);
    CHECK(out[0] == out[2]);
    CHECK(out[0] != out[1]);
    (void)engine.takeMeters(2);
    heard = levels();
    CHECK(engine.takeMeters(2).peak == Approx(static_cast<double>(heard[2])));

    row.profiles = {nullptr, nullptr, nullptr};
    row.places = {0.9, 0.0, 0.2};
    row.pan = PanLaw::constantPower;
    engine.setRow(row);
    PlayControls controls;
    controls.pan = 0.2;
    engine.setControls(controls);
    REQUIRE(engine.service());
    heard = levels();
    CHECK(heard[0] == Approx(0.0).margin(1e-3));
    CHECK(heard[1] == Approx(0.0).margin(1e-3));
    CHECK(heard[2] == Approx(0.4).margin(0.01));
    controls.pan = 0.1;
    engine.setControls(controls);
    REQUIRE(engine.service());
    heard = levels();
    CHECK(heard[0] == Approx(0.0).margin(1e-3));
    CHECK(heard[1] == Approx(0.4 / std::sqrt(2.0)).margin(0.01));
    CHECK(heard[2] == Approx(0.4 / std::sqrt(2.0)).margin(0.01));
    controls.pan = 1.0; // beyond the outer one
    engine.setControls(controls);
    REQUIRE(engine.service());
    CHECK(levels()[0] == Approx(0.4).margin(0.01));
}

TEST_CASE("Another actuator is faded to where the clip is, sound and touch together")
{
    AudioData audio;
    audio.sampleRate = 48000;
    audio.channels = 1;
    audio.samples.resize(10 * 48000);
    for (std::size_t i = 0; i < audio.samples.size(); ++i)
        audio.samples[i] = static_cast<float>(i) / 480000.0f;
    Clip clip;
    clip.duration = 10.0;
    clip.transients = {{3.0, 0.9, 0.5}};
    PreviewEngine engine(fs);
    Playback playback = playbackOf(std::make_shared<const Clip>(clip));
    playback.source = true;
    engine.set(playback);
    engine.setSource(std::make_shared<const StoredAudio>(audio));
    engine.play(0.0);
    REQUIRE(engine.service());
    std::vector<float> drive, sound;
    for (int i = 0; i < 1500; ++i)
    {
        std::vector<float> a(128), b(128);
        const std::span<float> haptic(a), channel(b);
        engine.process(std::span(&haptic, 1), std::span(&channel, 1));
        drive.insert(drive.end(), a.begin(), a.end());
        sound.insert(sound.end(), b.begin(), b.end());
        if (i == 750) // 2 s
            engine.setRow(rowOf(std::make_shared<const Profile>(test::shippedProfile("lra-175"))));
        if (i == 800) // built 133 ms later
            REQUIRE(engine.service());
    }
    for (const std::size_t second : {std::size_t(1), std::size_t(3)})
        CHECK(sound[second * 48000] == Approx(static_cast<double>(second) / 10.0).margin(1e-5));
    const auto event = static_cast<std::size_t>(
        std::find_if(drive.begin(), drive.end(), [](float s) { return std::abs(s) > 0.1f; }) - drive.begin());
    CHECK(static_cast<double>(event) / fs == Approx(3.0).margin(0.003));
}

TEST_CASE("A loop that comes after what plays is led into, and goes round from then on")
{
    Clip clip = *tone(40.0, 0.0);
    for (int second = 0; second < 40; ++second)
        clip.transients.push_back({second + 0.5, 0.8, 0.5});
    PreviewEngine engine(fs);
    Playback playback = playbackOf(std::make_shared<const Clip>(clip));
    engine.set(playback);
    engine.play(1.0);
    REQUIRE(engine.service());
    run(engine, 24000);
    playback.loop = TimeRange{4.0, 5.0};
    engine.set(playback);
    REQUIRE(engine.service());
    double last = 0.0;
    int services = 0;
    for (int i = 0; i < 60; ++i)
    {
        for (int k = 0; k < 100; ++k)
        {
            const auto heard = run(engine, 480, 480);
            if (engine.wantsService())
            {
                ++services;
                REQUIRE(engine.service());
            }
            if (engine.position() < last)
                CHECK(last == Approx(5.0).margin(0.02));
            last = engine.position();
        }
    }
    CHECK(engine.isPlaying());
    CHECK(services >= 1);
    CHECK(services < 10);
    CHECK(last >= 4.0);
    CHECK(last < 5.0);
}

TEST_CASE("A scene is what is rendered, from its start and from within, and an edit of it fades in while it plays")
{
    Scene scene;
    scene.clips = {*tone(2.0, 0.5), *tone(1.0, 0.3, 200.0)};
    scene.plays.resize(2);
    scene.plays[0].pan = 0.2;
    scene.plays[1].clip = 1;
    scene.plays[1].start = 0.4;
    scene.plays[1].pan = 1.0;
    scene.changes = {{0.5, 1, SceneParameter::pan, 0.0, 0.3}};
    const auto profile = std::make_shared<const Profile>(test::shippedProfile("lra-175"));
    PreviewRow row;
    row.profiles = {profile, profile};
    const auto rendered = [&](Scene of)
    {
        of.actuators = 2;
        CompileParams params;
        params.sampleRate = fs;
        params.adaptation.strength = row.strength;
        ScenePlayer player(compilePlan(of, profile.get(), params).value());
        std::array<std::vector<float>, 2> out{std::vector<float>(72000), std::vector<float>(72000)};
        const std::array<std::span<float>, 2> spans{out[0], out[1]};
        player.process(spans);
        return out;
    };
    const auto runBoth = [](PreviewEngine& engine, std::size_t frames)
    {
        std::array<std::vector<float>, 2> out{std::vector<float>(frames), std::vector<float>(frames)};
        for (std::size_t i = 0; i < frames; i += 128)
        {
            const std::array<std::span<float>, 2> part{std::span(out[0]).subspan(i, 128),
                                                       std::span(out[1]).subspan(i, 128)};
            engine.process(part, {});
        }
        return out;
    };
    const auto whole = rendered(scene);
    PreviewEngine engine(fs);
    engine.setRow(row);
    engine.set(scenePlayback(std::make_shared<const Scene>(scene), 2.0));
    engine.play(0.0);
    REQUIRE(engine.service());
    auto heard = runBoth(engine, 38400);
    for (std::size_t c = 0; c < 2; ++c)
        CHECK(std::equal(heard[c].begin(), heard[c].end(), whole[c].begin()));
    CHECK(largest(whole[1]) > 0.05f);
    // A softer one, while it plays: engine and frames stay where they are.
    Scene softer = scene;
    softer.plays[0].gain = -12.0;
    engine.set(scenePlayback(std::make_shared<const Scene>(softer), 2.0));
    REQUIRE(engine.service());
    (void)runBoth(engine, 2560);
    heard = runBoth(engine, 10240);
    const auto later = rendered(softer);
    for (std::size_t c = 0; c < 2; ++c)
        for (std::size_t i = 0; i < 10240; ++i)
            REQUIRE(heard[c][i] == Approx(later[c][40960 + i]).margin(1e-5));
    // From within.
    engine.stop();
    (void)runBoth(engine, 4864);
    REQUIRE(engine.service());
    engine.play(0.75);
    REQUIRE(engine.service());
    (void)runBoth(engine, 2560);
    heard = runBoth(engine, 10240);
    for (std::size_t c = 0; c < 2; ++c)
        for (std::size_t i = 0; i < 10240; ++i)
            REQUIRE(heard[c][i] == Approx(later[c][36000 + 2560 + i]).margin(1e-5));
    CHECK(engine.position() == Approx(0.75 + 12800 / fs).margin(0.01));
    // The end.
    (void)runBoth(engine, 64000);
    CHECK_FALSE(engine.isPlaying());
}
