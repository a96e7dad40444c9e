// A texture as a play has it, and as a drive signal: against the player that they are made of.

#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/synthesis/RenderScene.h>
#include <pacini/synthesis/RenderTexture.h>
#include <pacini/synthesis/TextureVoice.h>
#include <pacini/synthesis/VariationSeed.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
constexpr double fs = 8000.0;

std::shared_ptr<const TextureTable> voicedTable()
{
    Texture texture;
    texture.nodes.push_back({0.5, 0.1, {-0.6, 0.8}});
    texture.tones.push_back({200.0, 0.0, {0.05}});
    return std::make_shared<const TextureTable>(texture, fs);
}

/// What a player gives whose speed and force are those of the curves when their frame is heard, from frame `first` on.
std::vector<float> playerAlone(const Curve& speed, const Curve& force, std::int64_t first, std::size_t frames,
                               double noise = 1.0, double tones = 1.0)
{
    TexturePlayer player(voicedTable(), 7);
    std::vector<float> out(player.latencyFrames() + frames);
    for (std::size_t n = 0; n < out.size();)
    {
        const double time = static_cast<double>(first + static_cast<std::int64_t>(n)) / fs;
        player.setSpeed(valueAt(speed, time));
        player.setForce(valueAt(force, time));
        player.setRoles(noise, tones);
        const std::size_t count = std::min(player.hopLength(), out.size() - n);
        player.process(std::span(out).subspan(n, count));
        n += count;
    }
    out.erase(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(player.latencyFrames()));
    return out;
}

/// A play of `frames` from frame `first` of the scene on.
std::vector<float> voicePlays(TextureVoice& voice, std::int64_t first, std::size_t frames, std::size_t block,
                              const RoleGains& gains = {})
{
    std::vector<float> out(frames, 0.0f);
    for (std::size_t n = 0; n < frames; n += block)
    {
        const std::size_t count = std::min(block, frames - n);
        voice.add(std::span(out).subspan(n, count), first + static_cast<std::int64_t>(n), static_cast<std::int64_t>(n),
                  static_cast<std::int64_t>(frames), gains);
    }
    return out;
}

float largestDifference(std::span<const float> a, std::span<const float> b)
{
    float most = 0.0f;
    for (std::size_t n = 0; n < a.size(); ++n)
        most = std::max(most, std::abs(a[n] - b[n]));
    return most;
}
} // namespace

TEST_CASE("The voice of a texture is its player, without its delay, with fades of 5 ms", "[synthesis][texture]")
{
    const Curve speed{{0.2, 0.1}, {0.3, 0.9}, {0.4, 0.9}, {0.4, 0.3}}, force{{0.25, 1.0}, {0.45, 0.2}};
    constexpr std::int64_t first = 1603; // of the scene
    constexpr std::size_t frames = 2400;
    auto wanted = playerAlone(speed, force, first, frames);
    REQUIRE(test::rms(wanted) > 0.01);
    for (std::size_t n = 0; n < frames; ++n)
    {
        // 40 frames: the first has a fortieth, the last nothing.
        const double in = static_cast<double>(n + 1), left = static_cast<double>(frames - 1 - n);
        wanted[n] = static_cast<float>(std::min({in / 40.0, left / 40.0, 1.0}) * static_cast<double>(wanted[n]));
    }
    for (const std::size_t block : {std::size_t(1), std::size_t(7), std::size_t(64), std::size_t(1000)})
    {
        CAPTURE(block);
        TextureVoice voice(voicedTable(), 7, speed, force, block);
        CHECK(largestDifference(voicePlays(voice, first, frames, block), wanted) < 1e-6f);
        // Begun again it is the same.
        voice.reset();
        CHECK(largestDifference(voicePlays(voice, first, frames, block), wanted) < 1e-6f);
    }
    // It adds to what is there.
    TextureVoice voice(voicedTable(), 7, speed, force, frames);
    std::vector<float> mixed(frames, 2.0f);
    voice.add(mixed, first, 0, static_cast<std::int64_t>(frames), {});
    CHECK(std::abs(mixed[1000] - 2.0f - wanted[1000]) < 1e-6f);
    // Another seed is other noise.
    TextureVoice other(voicedTable(), 8, speed, force, frames);
    CHECK(largestDifference(voicePlays(other, first, frames, frames), wanted) > 0.01f);
}

TEST_CASE("Levels of roles are those of the noise and the tones of a texture", "[synthesis][texture]")
{
    const Curve half{{0.0, 0.5}}, full{{0.0, 1.0}};
    const std::array noise{0.25}, tones{3.0};
    RoleGains gains;
    gains[Role::noise] = RoleGain(noise);
    gains[Role::tones] = RoleGain(tones);
    TextureVoice voice(voicedTable(), 7, half, full, 512);
    const auto found = voicePlays(voice, 0, 2000, 512, gains);
    const auto wanted = playerAlone(half, full, 0, 2000, 0.25, 3.0);
    CHECK(largestDifference(std::span(found).subspan(100, 1800), std::span(wanted).subspan(100, 1800)) < 1e-6f);
}

TEST_CASE("Without curves a texture rests with its full force; live values count instead of curves",
          "[synthesis][texture]")
{
    constexpr std::size_t frames = 1600;
    const auto heard = [](TextureVoice& voice, std::int64_t first = 0)
    {
        return voicePlays(voice, first, frames, frames);
    };
    TextureVoice resting(voicedTable(), 7, {}, {}, frames);
    CHECK(test::rms(heard(resting)) == 0.0);
    TextureVoice live(voicedTable(), 7, {}, {}, frames);
    live.setSpeed(0.5, 0);
    TextureVoice curved(voicedTable(), 7, {{0.0, 0.5}}, {{0.0, 1.0}}, frames);
    const auto moving = heard(curved);
    CHECK(test::rms(moving) > 0.05);
    CHECK(heard(live) == moving);

    // Live values stay, whatever the curves do.
    const Curve steps{{0.0, 0.5}, {0.1, 0.5}, {0.1, 0.0}};
    TextureVoice held(voicedTable(), 7, steps, steps, frames);
    held.setSpeed(0.5, 0);
    held.setForce(1.0, 0);
    CHECK(heard(held) == moving);
    TextureVoice pressed(voicedTable(), 7, {{0.0, 0.5}}, {{0.0, 1.0}}, frames);
    pressed.setForce(0.0, 0);
    CHECK(test::rms(heard(pressed)) == 0.0);

    // A glide that is passed at once is at its end; half of it is half way.
    TextureVoice passed(voicedTable(), 7, {{0.0, 0.0}}, {}, frames), there(voicedTable(), 7, {}, {}, frames);
    passed.setSpeed(1.0, 800);
    passed.setForce(0.5, 800);
    passed.jump(800);
    there.setSpeed(1.0, 0);
    there.setForce(0.5, 0);
    CHECK(heard(passed) == heard(there));
    TextureVoice halfWay(voicedTable(), 7, {{0.0, 0.0}}, {}, frames), from(voicedTable(), 7, {}, {}, frames);
    halfWay.setSpeed(1.0, 800);
    halfWay.setForce(0.5, 800);
    halfWay.jump(400);
    from.setSpeed(0.5, 0);
    from.setSpeed(1.0, 400);
    from.setForce(0.75, 0);
    from.setForce(0.5, 400);
    CHECK(largestDifference(heard(halfWay), heard(from)) < 1e-5f);

    // One that takes over has the other's values, not its own curves; what was not live comes from the curve still.
    TextureVoice follower(voicedTable(), 7, {{0.0, 0.5}}, {{0.0, 1.0}}, frames);
    TextureVoice model(voicedTable(), 7, {}, {}, frames);
    model.setSpeed(0.0, 0);
    follower.follow(model);
    CHECK(test::rms(heard(follower)) == 0.0);
    TextureVoice lifted(voicedTable(), 7, {{0.0, 0.5}}, {{0.0, 1.0}}, frames);
    TextureVoice hand(voicedTable(), 7, {}, {}, frames);
    hand.setForce(0.0, 0);
    lifted.follow(hand);
    CHECK(test::rms(heard(lifted)) == 0.0);
    TextureVoice same(voicedTable(), 7, {{0.0, 0.5}}, {{0.0, 1.0}}, frames);
    same.follow(resting);
    CHECK(heard(same) == moving);
}

TEST_CASE("Live glides of a texture move on with the frames that are heard", "[synthesis][texture]")
{
    // From 0 to full speed in 0.2 s: the player reads it where it makes its frames, one hop after the other.
    constexpr std::size_t frames = 3200, glide = 1600;
    TextureVoice voice(voicedTable(), 7, {}, {}, 160);
    voice.setSpeed(1.0, glide);
    const auto found = voicePlays(voice, 0, frames, 160);
    // The frames before the first do not count: what is made of them has speed 0, and it comes late by their number.
    const double late = static_cast<double>(TexturePlayer(voicedTable()).latencyFrames()) / fs;
    const Curve ramp{{late, 0.0}, {late + 0.2, 1.0}};
    const auto wanted = playerAlone(ramp, {{0.0, 1.0}}, 0, frames);
    const auto middle = [](const std::vector<float>& x)
    {
        return std::span(x).subspan(50, 3000);
    };
    CHECK(test::rms(found) == Approx(test::rms(wanted)).epsilon(0.05));
    CHECK(largestDifference(middle(found), middle(wanted)) < 0.1f * static_cast<float>(test::rms(wanted)));
    // And a hand that is lifted within 0.1 s.
    TextureVoice lifted(voicedTable(), 7, {}, {}, 160);
    lifted.setSpeed(0.5, 0);
    lifted.setForce(0.0, 800);
    const auto fading = voicePlays(lifted, 0, frames, 160);
    CHECK(test::rms(std::span(fading).first(400)) > 0.05);
    CHECK(test::rms(std::span(fading).subspan(1000)) == 0.0);
}

TEST_CASE("A rendered texture is its player with its gain, without delay, as long as it is told",
          "[synthesis][texture]")
{
    Texture texture;
    texture.nodes.push_back({0.5, 0.1, {-0.6, 0.8}});
    TextureRenderParams params;
    params.sampleRate = fs;
    params.gain = Decibels(-6.0);
    std::vector<float> samples;
    double told = -1.0;
    const auto sink = [&](std::span<const float> block, double done) -> Result<void>
    {
        CHECK(done >= told);
        CHECK(done < 1.0);
        told = done;
        samples.insert(samples.end(), block.begin(), block.end());
        return {};
    };
    const TextureCourse course{{{0.0, 0.2}, {0.3, 0.8}, {0.5, 0.8}}, {}};
    auto made = renderTexture(texture, course, params, 7, nullptr, sink);
    REQUIRE(made.ok());
    CHECK(made->frames == 4000); // to the last point
    REQUIRE(samples.size() == 4000);
    double peak = 0.0;
    for (const float v : samples)
        peak = std::max(peak, static_cast<double>(std::abs(v)));
    CHECK(made->peak == peak);
    CHECK(made->rms == Approx(test::rms(samples)).epsilon(1e-9));
    // Against a texture of the same seed that is played at once; the end is fixed to within a hop.
    TexturePlayer player(std::make_shared<const TextureTable>(texture, fs), 7);
    std::vector<float> wanted(player.latencyFrames() + 4000 + 8);
    for (std::size_t n = 0; n < wanted.size(); n += 8)
    {
        player.setSpeed(valueAt(course.speed, static_cast<double>(n) / fs));
        player.process(std::span(wanted).subspan(n, std::min<std::size_t>(8, wanted.size() - n)));
    }
    double difference = 0.0;
    for (std::size_t n = 0; n < 4000; ++n)
        difference = std::max(
            difference, std::abs(static_cast<double>(samples[n]) -
                                 Decibels(-6.0).gain() * static_cast<double>(wanted[n + player.latencyFrames()])));
    CHECK(difference < 1e-6);

    // Longer than the course it holds its last speed; a force of a quarter is half as strong.
    const auto levelOf = [&](TextureCourse moved, std::optional<double> duration)
    {
        samples.clear();
        told = -1.0;
        params.duration = duration;
        const auto report = renderTexture(texture, moved, params, 7, nullptr, sink);
        REQUIRE(report.ok());
        return report->rms;
    };
    const double steady = levelOf({{{0.0, 0.5}}, {}}, 2.0);
    CHECK(samples.size() == 16000);
    CHECK(steady == Approx(0.1 * Decibels(-6.0).gain()).epsilon(0.1));
    CHECK(levelOf({{{0.0, 0.5}}, {{0.0, 0.25}}}, 2.0) == Approx(0.5 * steady).epsilon(1e-3));
    CHECK(levelOf({{{0.0, 0.5}}, {{0.0, 1.0}}}, 2.0) == Approx(steady).epsilon(1e-9));

    // What cannot be: no points, no end, numbers out of range, a motor, a sink that fails.
    const auto whereOf = [&](const TextureCourse& moved, const Profile* profile = nullptr)
    {
        const auto report = renderTexture(texture, moved, params, 7, profile, sink);
        return report ? std::string() : report.error().where;
    };
    params.duration.reset();
    CHECK(whereOf({}) == "speed");
    CHECK(whereOf({{{0.0, 0.5}}, {}}) == "duration");
    params.duration = 1.0;
    Profile motor;
    motor.technology = Technology::erm;
    CHECK(whereOf({{{0.0, 0.5}}, {}}, &motor) == "technology");
    const auto full = [](std::span<const float>, double) -> Result<void>
    {
        return Error{ErrorCode::io, "disk", "is full"};
    };
    const auto failed = renderTexture(texture, {{{0.0, 0.5}}, {}}, params, 7, nullptr, full);
    REQUIRE_FALSE(failed.ok());
    CHECK(failed.error().where == "disk");
}

TEST_CASE("A texture that is rendered alone is the scene of it, at every level", "[synthesis][texture]")
{
    Profile lra;
    lra.technology = Technology::lra;
    lra.resonance = {150.0, 10.0};
    Profile equalized = lra;
    EqualizerSection section;
    section.type = EqualizerType::peak;
    section.frequency = 140.0;
    section.gain = -12.0;
    equalized.equalizer.pushBack(section);
    const std::array<const Profile*, 3> profiles{nullptr, &lra, &equalized};
    for (const double level : {0.05, 5.0})
    {
        std::vector<float> plain;
        for (const Profile* profile : profiles)
        {
            CAPTURE(profile == &lra, profile == &equalized, level);
            Scene scene;
            scene.textures.emplace_back();
            scene.textures[0].nodes.push_back({0.5, level, {-0.6, 0.8}});
            scene.clips.emplace_back();
            scene.clips[0].duration = 2.0;
            scene.plays.emplace_back();
            scene.plays[0].texture = 0;
            scene.plays[0].variation.seed = 7;
            RenderParams params;
            params.compile.sampleRate = fs;
            const auto whole = renderScene(scene, profile, params);
            REQUIRE(whole.ok());
            TextureRenderParams alone;
            alone.sampleRate = fs;
            alone.duration = 2.0;
            std::vector<float> samples;
            const auto report = renderTexture(scene.textures[0], {{{0.0, 0.5}}, {}}, alone, 7, profile,
                                              [&](std::span<const float> block, double) -> Result<void>
                                              {
                                                  samples.insert(samples.end(), block.begin(), block.end());
                                                  return {};
                                              });
            REQUIRE(report.ok());
            REQUIRE(samples.size() == whole->samples.size());
            const auto middle = [](const std::vector<float>& x)
            {
                return std::span(x).subspan(8000, 7900); // what the fades leave in filters and limiters is over
            };
            // A scene flattens a resonance by its strength.
            if (profile != &lra)
                CHECK(largestDifference(middle(samples), middle(whole->samples)) < 1e-4f);
            else
                CHECK(largestDifference(middle(samples), middle(plain)) > 0.01f);
            if (profile == nullptr)
                plain = samples;
            CHECK(test::rms(middle(samples)) > 0.01);
            CHECK(report->peak <= 1.0 + 1e-6);
        }
    }
}

TEST_CASE("Seeds of plays are those of the hash, the first play keeps its own", "[synthesis]")
{
    // SplitMix64 of seed + play * 0xD1B54A32D192ED03, computed outside.
    STATIC_REQUIRE(seedOfPlay(5, 0) == 5);
    STATIC_REQUIRE(seedOfPlay(0, 1) == 0x2D0F28C7E7E786B2ULL);
    STATIC_REQUIRE(seedOfPlay(5, 3) == 0xDCFA1426C230EF5FULL);
}
