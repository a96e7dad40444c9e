#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/HeapGuard.h"
#include "support/Measure.h"
#include "support/Pinned.h"

#include <pacini/foundation/Units.h>
#include <pacini/texture/TexturePlayer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
/// Noise around `frequency` at speed 1/2 with poles at `radius` of the unit circle.
Texture hump(double frequency, double radius, double pitch = 1.0)
{
    Texture texture;
    texture.pitch = pitch;
    const double c = std::cos(2.0 * std::numbers::pi * frequency / textureRate);
    const double k2 = radius * radius;
    texture.nodes.push_back({0.5, 0.2, {-2.0 * radius * c / (1.0 + k2), k2}});
    return texture;
}

std::vector<float> playAt(const Texture& texture, double speed, double seconds, double force = 1.0, double fs = 8000.0,
                          std::uint64_t seed = 1)
{
    TexturePlayer player(std::make_shared<const TextureTable>(texture, fs), seed);
    player.setSpeed(speed);
    player.setForce(force);
    std::vector<float> out(static_cast<std::size_t>(seconds * fs));
    player.process(out);
    return out;
}

/// Frequency of the strongest part between 20 and 1000 Hz, on pieces of 1/4 s.
double strongest(const std::vector<float>& x, double fs)
{
    const auto piece = static_cast<std::size_t>(fs / 4.0);
    double best = 0.0, most = 0.0;
    for (double f = 20.0; f <= 1000.0; f *= 1.03)
    {
        double power = 0.0;
        for (std::size_t i = 0; i + piece <= x.size(); i += piece)
            power += std::norm(test::spectrumAt(std::span(x).subspan(i, piece), f, fs));
        if (power > most)
        {
            most = power;
            best = f;
        }
    }
    return best;
}

/// A player at a constant speed, as a source.
struct Source
{
    TexturePlayer player;
    explicit Source(double fs) : player(std::make_shared<const TextureTable>(hump(150.0, 0.95), fs)) { reset(); }
    void reset() noexcept
    {
        player.reset();
        player.setSpeed(0.7);
    }
    [[nodiscard]] static std::int64_t totalFrames() { return 20000; }
    void process(std::span<float> out) noexcept { player.process(out); }
};
} // namespace

TEST_CASE("A texture's player keeps the contract of sources", "[texture]")
{
    test::checkSourceContract([](double fs) { return std::make_unique<Source>(fs); }, 3.0, true);
}

TEST_CASE("Lattice noise has a variance of 1 while its coefficients jump with every frame", "[texture][stability]")
{
    for (const std::size_t order : {std::size_t(1), std::size_t(2), std::size_t(16), std::size_t(64)})
        for (const double most : {0.5, 0.99, 1.0 - 1e-9})
        {
            CAPTURE(order, most);
            LatticeNoise noise(3);
            Random random(5);
            std::vector<double> reflection(order);
            double sum = 0.0, peak = 0.0;
            constexpr int frames = 400000;
            for (int n = 0; n < frames; ++n)
            {
                for (double& k : reflection)
                    k = random.uniform(-most, most);
                if (n % 3 == 0) // and extremes in between
                    reflection[random.next() % order] = random.next() % 2 == 0 ? most : -most;
                noise.setReflections(reflection);
                const double x = noise.next();
                sum += x * x;
                peak = std::max(peak, std::abs(x));
            }
            CHECK(sum / frames == Approx(1.0).epsilon(0.02));
            CHECK(peak < 8.0); // as of Gaussian noise
        }
}

TEST_CASE("A texture is finite, bounded and soon silent at speed 0, whatever it is and however it is moved",
          "[texture][stability]")
{
    const auto order64 = [](double k)
    {
        Texture texture;
        for (int i = 1; i <= 32; ++i)
            texture.nodes.push_back({i / 32.0, 1.0, std::vector<double>(64, i % 2 == 0 ? k : -k)});
        return texture;
    };
    std::vector<Texture> textures = {
        hump(20.0, 1.0 - 1e-9), hump(1000.0, 1.0 - 1e-9), hump(150.0, 0.999999, 0.0), order64(1.0 - 1e-12),
        order64(0.3),           order64(1e-300)};
    textures.front().levelBySpeed = 0.1;
    textures.back().nodes.front().speed = 5e-324;
    for (const double fs : {2000.0, 2399.0, 8000.0, 44100.0, 768000.0})
        for (std::size_t t = 0; t < textures.size(); ++t)
        {
            CAPTURE(fs, t);
            REQUIRE(validate(textures[t]).ok());
            TexturePlayer player(std::make_shared<const TextureTable>(textures[t], fs), 9);
            Random random(t);
            double peak = 0.0;
            for (int n = 0; n < 30000; ++n)
            {
                player.setSpeed(random.next() % 2 == 0 ? random.uniform()
                                                       : test::anyNumber[random.next() % std::size(test::anyNumber)]);
                player.setForce(random.next() % 2 == 0 ? random.uniform()
                                                       : test::anyNumber[random.next() % std::size(test::anyNumber)]);
                float y = 0.0f;
                player.process(std::span(&y, 1));
                REQUIRE(std::isfinite(y));
                peak = std::max(peak, std::abs(static_cast<double>(y)));
            }
            CHECK(peak < 100.0); // ten times the level in a tenth of the power, peaks of six standard deviations
            player.setSpeed(0.0);
            std::vector<float> rest(2 * player.latencyFrames() + static_cast<std::size_t>(0.01 * fs) + 8);
            player.process(rest);
            player.process(rest);
            CHECK(test::peakOf(rest) == 0.0);
        }
}

TEST_CASE("The level of a texture rises with speed and force by its laws, from silence", "[texture]")
{
    Texture texture = hump(150.0, 0.9, 0.5);
    texture.levelBySpeed = 0.8;
    texture.levelByForce = 0.6;
    CHECK(test::peakOf(playAt(texture, 0.0, 1.0)) == 0.0);
    CHECK(test::peakOf(playAt(texture, 0.5, 1.0, 0.0)) == 0.0);
    double last = 0.0;
    for (const double speed : {0.001, 0.01, 0.03, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0})
    {
        CAPTURE(speed);
        const double level = test::rms(playAt(texture, speed, 20.0));
        CHECK(level > last);
        if (speed >= 0.1)
            CHECK(Decibels::fromGain(level / (0.2 * std::pow(speed / 0.5, 0.8))).value == Approx(0.0).margin(0.6));
        last = level;
    }
    last = 0.0;
    for (const double force : {0.01, 0.1, 0.3, 0.6, 1.0})
    {
        CAPTURE(force);
        const double level = test::rms(playAt(texture, 0.5, 20.0, force));
        CHECK(Decibels::fromGain(level / (0.2 * std::pow(force, 0.6))).value == Approx(0.0).margin(0.6));
        CHECK(level > last);
        last = level;
    }
}

TEST_CASE("Frequencies of a texture follow the speed as its pitch says", "[texture]")
{
    for (const double speed : {0.25, 0.5, 1.0})
    {
        CAPTURE(speed);
        CHECK(strongest(playAt(hump(200.0, 0.99, 1.0), speed, 4.0, 1.0, 2400.0), 2400.0) ==
              Approx(400.0 * speed).epsilon(0.05));
        CHECK(strongest(playAt(hump(200.0, 0.99, 0.0), speed, 4.0, 1.0, 2400.0), 2400.0) ==
              Approx(200.0).epsilon(0.05));
        CHECK(strongest(playAt(hump(200.0, 0.99, 0.5), speed, 4.0, 1.0, 2400.0), 2400.0) ==
              Approx(200.0 * std::sqrt(speed / 0.5)).epsilon(0.05));
    }
}

TEST_CASE("A texture does not repeat: its autocorrelation beyond 50 ms stays below 0.06", "[texture]")
{
    const auto x = playAt(hump(200.0, 0.8), 0.5, 20.0, 1.0, 2400.0);
    double energy = 0.0;
    for (const float v : x)
        energy += static_cast<double>(v) * static_cast<double>(v);
    double most = 0.0;
    for (std::size_t lag = 120; lag < 24000; ++lag) // 50 ms to 10 s
    {
        double sum = 0.0;
        for (std::size_t n = 0; n + lag < x.size(); ++n)
            sum += static_cast<double>(x[n] * x[n + lag]);
        most = std::max(most, std::abs(sum) / energy);
    }
    CHECK(most < 0.06);
}

TEST_CASE("A texture is the same for the same seed on every machine, and other noise for another", "[texture]")
{
    const Texture texture = hump(150.0, 0.95);
    const auto x = playAt(texture, 0.6, 0.5);
    CHECK(playAt(texture, 0.6, 0.5) == x);
    CHECK(playAt(texture, 0.6, 0.5, 1.0, 8000.0, 2) != x);
    const std::vector<double> pinned(x.begin(), x.end());
    checkPinnedWithEnds("texture/hump at 150 Hz, speed 0.6", pinned);
}

TEST_CASE("A speed that changes between frames of a block is the same, however the block is cut", "[texture]")
{
    const auto table = std::make_shared<const TextureTable>(hump(150.0, 0.95), 48000.0);
    const auto speedAt = [](std::size_t n)
    {
        return 0.5 + 0.5 * std::sin(1e-4 * static_cast<double>(n));
    };
    TexturePlayer whole(table), cut(table);
    std::vector<float> a(48000), b(48000);
    const test::HeapGuard guard;
    for (std::size_t n = 0; n < a.size(); n += 480)
    {
        whole.setSpeed(speedAt(n));
        whole.process(std::span(a).subspan(n, 480));
        cut.setSpeed(speedAt(n));
        for (std::size_t i = 0; i < 480; i += 7)
            cut.process(std::span(b).subspan(n + i, std::min<std::size_t>(7, 480 - i)));
    }
    CHECK(guard.traffic() == 0);
    CHECK(a == b);
}
