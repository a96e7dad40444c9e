#include "support/Catch.h"
#include "support/HeapGuard.h"
#include "support/Measure.h"
#include "texture/Strokes.h"

#include <pacini/foundation/Gaussian.h>
#include <pacini/texture/TextureAnalysis.h>
#include <pacini/texture/TexturePlayer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
constexpr double tonesRate = 8000.0;

/// Orders 1, 2 and 4 of 120 Hz at full speed, with levels of their own, over noise that stays where it is.
struct MadeEngine
{
    double noise = 0.01;
    double level(int order, double speed) const { return 0.1 * speed / order; }

    [[nodiscard]] std::vector<float> recording(const Curve& speed, double seconds, std::uint64_t seed = 1) const
    {
        Gaussian random(seed);
        std::vector<float> samples(static_cast<std::size_t>(seconds * tonesRate));
        double way = 0.0;
        for (std::size_t n = 0; n < samples.size(); ++n)
        {
            const double v = valueAt(speed, static_cast<double>(n) / tonesRate);
            double x = noise * random.next();
            for (const int order : {1, 2, 4})
                x += std::numbers::sqrt2 * level(order, v) *
                     std::sin(2.0 * std::numbers::pi * (120.0 * order * way + 0.1 * order));
            samples[n] = static_cast<float>(x);
            way += v / tonesRate;
        }
        return samples;
    }
};

const Curve sweep = {{0.0, 0.25}, {15.0, 1.0}, {30.0, 0.25}};

TextureFit fitOf(const std::vector<float>& samples, const Curve& speed, const TextureParams& params = {})
{
    auto fit = analyseTexture(samples, static_cast<int>(tonesRate), {speed, {}}, params);
    REQUIRE(fit.ok());
    return *fit;
}

std::vector<float> heardAt(const Texture& texture, double speed, double seconds, double force = 1.0)
{
    TexturePlayer player(std::make_shared<const TextureTable>(texture, tonesRate));
    player.setSpeed(speed);
    player.setForce(force);
    std::vector<float> out(static_cast<std::size_t>((seconds + 0.5) * tonesRate));
    player.process(out);
    out.erase(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(0.5 * tonesRate));
    return out;
}

/// RMS of the part at f.
double partAt(const std::vector<float>& x, double f)
{
    return std::abs(test::spectrumAt(std::span(x), f, tonesRate)) * std::numbers::sqrt2 / static_cast<double>(x.size());
}

/// A texture of one tone without audible noise.
Texture oneTone(double frequency, double level = 0.2)
{
    Texture texture;
    texture.nodes.push_back({0.5, 1e-6, {0.0}});
    texture.tones.push_back({frequency, 0.0, {level}});
    return texture;
}
} // namespace

TEST_CASE("Orders of an engine are found with their frequencies and levels, and come out of the noise",
          "[texture][tones]")
{
    const MadeEngine engine;
    const Texture texture = fitOf(engine.recording(sweep, 30.0), sweep).texture;
    REQUIRE(texture.tones.size() == 3);
    const int orders[] = {1, 2, 4};
    for (std::size_t k = 0; k < 3; ++k)
    {
        const TextureTone& tone = texture.tones[k];
        INFO("order " << orders[k]);
        CHECK(tone.frequency == Approx(120.0 * orders[k]).epsilon(1e-3));
        for (std::size_t n = 0; n < texture.nodes.size(); ++n)
        {
            const double speed = texture.nodes[n].speed;
            CHECK(20.0 * std::log10(tone.levels[n] / engine.level(orders[k], speed)) == Approx(0.0).margin(0.7));
        }
    }
    // What is left is the noise of the recording: 0.01 over 4000 Hz, of which 980 are counted.
    for (const TextureNode& node : texture.nodes)
        CHECK(20.0 * std::log10(node.level / (0.01 * std::sqrt(980.0 / 4000.0))) == Approx(0.0).margin(1.5));
    // Harmonics keep their phases: order k is at 0.1 k when the first is at 0.1.
    const double first = texture.tones[0].phase, second = texture.tones[1].phase;
    const double apart = second - 2.0 * first;
    CHECK(std::abs(apart - std::round(apart)) < 0.03);
}

TEST_CASE("A played texture has its tones at the speed, also at speeds that were not recorded", "[texture][tones]")
{
    const MadeEngine engine;
    const Curve steps = {{0.0, 0.25}, {8.0, 0.25}, {8.0, 0.5}, {16.0, 0.5}, {16.0, 1.0}, {24.0, 1.0}};
    const Texture texture = fitOf(engine.recording(steps, 24.0), steps).texture;
    for (const double speed : {0.3, 0.4, 0.7, 0.9})
    {
        const auto played = heardAt(texture, speed, 4.0);
        for (const int order : {1, 2, 4})
        {
            const double f = texture.tones[static_cast<std::size_t>(order / 2)].frequency * speed;
            INFO("order " << order << " at " << speed);
            CHECK(20.0 * std::log10(partAt(played, f) / engine.level(order, speed)) == Approx(0.0).margin(1.0));
        }
    }
}

TEST_CASE("Noise, a river and one steady hum without a table of speeds: what is no tone is none", "[texture][tones]")
{
    Gaussian random(5);
    std::vector<float> noise(240000);
    for (float& x : noise)
        x = static_cast<float>(0.1 * random.next());
    CHECK(fitOf(noise, {}).texture.tones.empty());
    CHECK(fitOf(noise, sweep).texture.tones.empty());
    CHECK(fitOf(test::river(sweep, 30.0, tonesRate, 3), sweep).texture.tones.empty());
    // A mains hum does not follow the speed.
    auto hum = noise;
    for (std::size_t n = 0; n < hum.size(); ++n)
        hum[n] +=
            static_cast<float>(0.05 * std::sin(2.0 * std::numbers::pi * 100.0 * static_cast<double>(n) / tonesRate));
    CHECK(fitOf(hum, sweep).texture.tones.empty());
    // At one speed it cannot be told from a tone.
    CHECK(fitOf(hum, {}).texture.tones.size() == 1);
    TextureParams none;
    none.tones = 0;
    CHECK(fitOf(hum, {}, none).texture.tones.empty());
}

TEST_CASE("Tones alone make a texture whose noise is far below them", "[texture][tones]")
{
    MadeEngine engine;
    engine.noise = 0.0;
    const Texture texture = fitOf(engine.recording(sweep, 30.0), sweep).texture;
    REQUIRE(texture.tones.size() == 3);
    for (const TextureNode& node : texture.nodes)
        CHECK(node.level < 0.1 * engine.level(1, node.speed));
}

TEST_CASE("Recordings with garbage give a texture or an error, never numbers that are none", "[texture][tones]")
{
    const MadeEngine engine;
    auto samples = engine.recording(sweep, 30.0);
    std::fill(samples.begin() + 40000, samples.begin() + 120000, 0.0f);
    CHECK(validate(fitOf(samples, sweep).texture).ok());
    for (float& x : samples)
        x = x > 0.0f ? 1.0f : -1.0f;
    CHECK(validate(fitOf(samples, sweep).texture).ok());
    for (const Curve& speed : {Curve{{0.0, 0.0}, {30.0, 1.0}}, Curve{{0.0, 1.0}, {10.0, 0.0}, {20.0, 0.0}},
                               Curve{{0.0, 1e-12}, {30.0, 1e12}}})
        if (const auto fit = analyseTexture(samples, 8000, {speed, {}}, {}))
            CHECK(validate(fit->texture).ok());
}

TEST_CASE("A tone beyond 1000 Hz is silent, and comes back without a step", "[texture][tones]")
{
    const Texture texture = oneTone(2000.0);
    CHECK(test::rms(heardAt(texture, 0.4, 1.0)) == Approx(0.16).epsilon(0.05));
    CHECK(test::rms(heardAt(texture, 0.6, 1.0)) < 1e-4);
    TexturePlayer player(std::make_shared<const TextureTable>(texture, 48000.0));
    std::vector<float> out(96000);
    for (std::size_t n = 0; n < out.size(); n += 48)
    {
        player.setSpeed(0.4 + 0.2 * static_cast<double>(n) / 96000.0);
        player.process(std::span(out).subspan(n, 48));
    }
    double step = 0.0;
    for (std::size_t n = 4801; n < out.size(); ++n)
        step = std::max(step, std::abs(static_cast<double>(out[n]) - static_cast<double>(out[n - 1])));
    CHECK(step < 0.2 * 1.1 * std::numbers::sqrt2 * 2.0 * std::numbers::pi * 1100.0 / 48000.0);
}

TEST_CASE("Tones follow the force, stay within their level however the speed jumps, and take no memory",
          "[texture][tones]")
{
    const Texture texture = oneTone(300.0);
    CHECK(test::rms(heardAt(texture, 0.5, 1.0, 0.25)) == Approx(0.1).epsilon(0.02)); // the root of the force
    CHECK(test::rms(heardAt(texture, 0.5, 1.0, 0.0)) == 0.0);
    for (const double fs : {2000.0, 8000.0, 48000.0, 768000.0})
    {
        TexturePlayer player(std::make_shared<const TextureTable>(texture, fs));
        std::vector<float> out(64);
        double most = 0.0;
        const test::HeapGuard guard;
        for (int i = 0; i < 4000; ++i)
        {
            player.setSpeed(i % 3 == 0 ? 1.0 : i % 3 == 1 ? 0.0 : std::numeric_limits<double>::quiet_NaN());
            player.setForce(i % 5 == 0 ? -1e300 : 1e300);
            player.process(out);
            for (const float x : out)
                most = std::max(most, std::abs(static_cast<double>(x)));
        }
        CHECK(guard.traffic() == 0);
        CHECK(most < 1.3 * 0.4 * std::numbers::sqrt2);
        CHECK(std::isfinite(most));
    }
}

TEST_CASE("A day of a tone stays in tune", "[texture][tones]")
{
    const Texture texture = oneTone(200.0);
    TexturePlayer player(std::make_shared<const TextureTable>(texture, 2000.0));
    player.setSpeed(1.0);
    std::vector<float> out(20000);
    for (int i = 0; i < 24 * 360; ++i)
        player.process(out);
    CHECK(std::abs(test::spectrumAt(std::span<const float>(out), 200.0, 2000.0)) * std::numbers::sqrt2 / 20000.0 ==
          Approx(0.4).epsilon(0.01));
}

TEST_CASE("A line that falls apart is one tone, at the mean of its frequencies by power", "[texture][tones]")
{
    // A bin is 1.5 Hz: lines up to 4.5 Hz from the one before them are one.
    std::vector<detail::WayLine> lines = {{150.0, 5.0}, {451.0, 3.0}, {447.0, 1.0}, {300.0, 2.5}, {304.5, 2.0}};
    detail::mergeSplitLines(lines, 1.5);
    REQUIRE(lines.size() == 4); // strongest first
    CHECK(lines[0].frequency == 150.0);
    CHECK(lines[1].frequency == Approx(450.0));
    CHECK(lines[1].power == 4.0);
    CHECK(lines[2].frequency == 300.0);
    CHECK(lines[3].frequency == 304.5);
    detail::mergeSplitLines(lines, 1.6);
    REQUIRE(lines.size() == 3);
    CHECK(lines[1].frequency == Approx((2.5 * 300.0 + 2.0 * 304.5) / 4.5));
    lines.clear();
    detail::mergeSplitLines(lines, 1.0);
    CHECK(lines.empty());
}

TEST_CASE("Errors of tones name their place", "[texture][tones]")
{
    const auto wrong = [](auto&& change)
    {
        Texture texture = oneTone(100.0);
        change(texture.tones[0]);
        const auto valid = validate(texture);
        return valid ? std::string() : valid.error().where;
    };
    CHECK(wrong([](TextureTone&) {}).empty());
    CHECK(wrong([](TextureTone& tone) { tone.frequency = 0.0; }) == "tones[0].frequency");
    CHECK(wrong([](TextureTone& tone) { tone.frequency = std::nan(""); }) == "tones[0].frequency");
    CHECK(wrong([](TextureTone& tone) { tone.phase = 1.5; }) == "tones[0].phase");
    CHECK(wrong([](TextureTone& tone) { tone.levels.push_back(0.1); }) == "tones[0].levels");
    CHECK(wrong([](TextureTone& tone) { tone.levels[0] = -0.1; }) == "tones[0].levels[0]");
    Texture many = oneTone(100.0);
    many.tones.resize(65, many.tones[0]);
    CHECK(validate(many).error().where == "tones");
}
