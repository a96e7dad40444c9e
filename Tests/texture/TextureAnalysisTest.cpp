#include "support/Catch.h"
#include "support/Measure.h"
#include "texture/Strokes.h"

#include <pacini/texture/TextureAnalysis.h>
#include <pacini/texture/TexturePlayer.h>

#include <cmath>
#include <limits>
#include <memory>
#include <vector>

using namespace pacini;

namespace
{
/// Four speeds, one after the other.
const Curve steps = {{0.0, 0.125}, {6.0, 0.125}, {6.0, 0.25}, {12.0, 0.25}, {12.0, 0.5}, {18.0, 0.5}, {18.0, 1.0}};

TextureFit analysed(const std::vector<float>& samples, const TextureMotion& motion, const TextureParams& params = {})
{
    auto fit = analyseTexture(samples, 8000, motion, params);
    REQUIRE(fit.ok());
    return *fit;
}

/// dB between the spectra of a texture's player at `speed` and of a recording.
double errorAt(const Texture& texture, double speed, const std::vector<float>& recording)
{
    TexturePlayer player(std::make_shared<const TextureTable>(texture, 8000.0), 4);
    player.setSpeed(speed);
    std::vector<float> played(80000);
    player.process(played);
    const auto mean = [](const std::vector<float>& x)
    {
        PowerSpectrum sum;
        detail::forEachTextureSpectrum(detail::textureBand(x, 8000), 1200,
                                       [&](double, const PowerSpectrum& spectrum)
                                       {
                                           sum.step = spectrum.step;
                                           sum.power.resize(spectrum.power.size(), 0.0);
                                           for (std::size_t k = 0; k < sum.power.size(); ++k)
                                               sum.power[k] += spectrum.power[k];
                                       });
        const double count = static_cast<double>(x.size()) / 4.8e3; // any: both are equally long
        for (double& power : sum.power)
            power /= count;
        return sum;
    };
    return detail::textureDistance(mean(played), mean(recording));
}
} // namespace

TEST_CASE("Reflection coefficients come back from the spectrum of their model", "[texture]")
{
    const std::vector<double> reflection = {-0.9, 0.7, 0.3, -0.2};
    const auto again = reflectionsOf(autocorrelationOf(spectrumOf(reflection, 2000, 2400.0), 4, 2400.0));
    for (std::size_t k = 0; k < reflection.size(); ++k)
        CHECK(again[k] == Approx(reflection[k]).margin(2e-3));
    // By definition: k1 is minus the first autocorrelation, and 1 Hz of a flat spectrum has none.
    CHECK(reflectionsOf(std::vector<double>{2.0, 1.0})[0] == Approx(-0.5).epsilon(1e-5));
    CHECK(reflectionsOf(std::vector<double>{1.0, 0.0, 0.0}) == std::vector<double>{0.0, 0.0});
}

TEST_CASE("A model is stable whatever the autocorrelation is", "[texture][stability]")
{
    Random random(1);
    const double odd[] = {
        std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0, 0.0, 1e308, 5e-324};
    for (int i = 0; i < 20000; ++i)
    {
        std::vector<double> lags(1 + random.next() % 65);
        for (double& lag : lags)
            lag = random.next() % 20 == 0 ? odd[random.next() % std::size(odd)] : random.uniform(-1.0, 1.0);
        if (random.next() % 2 == 0)
            lags.front() = 1.0;
        for (const double k : reflectionsOf(lags))
            REQUIRE(std::abs(k) < 1.0);
    }
}

TEST_CASE("Ridges move with the speed, a river does not, and both laws of level are found", "[texture]")
{
    const TextureMotion motion{steps, {}};
    const auto surface = analysed(test::ridges(steps, 24.0, 8000.0, 1), motion);
    CHECK_FALSE(surface.pitchAssumed);
    CHECK(surface.texture.pitch == Approx(1.0).margin(0.15));
    CHECK(surface.texture.levelBySpeed == Approx(0.5).margin(0.1));
    const auto water = analysed(test::river(steps, 24.0, 8000.0, 1), motion);
    CHECK(water.texture.pitch <= 0.15);
    CHECK(water.texture.levelBySpeed == Approx(1.0).margin(0.1));
    CHECK(water.texture.nodes.size() == 4);
    CHECK(water.texture.nodes[1].speed == Approx(0.25).epsilon(0.03));
}

TEST_CASE("The law of force is found beside that of speed", "[texture]")
{
    Curve speed, force;
    for (int i = 0; i < 25; ++i)
    {
        speed.push_back({1.0 * i, i % 2 == 0 ? 0.2 : 1.0});
        force.push_back({1.0 * i, i % 3 == 0 ? 0.1 : 2.0});
    }
    auto samples = test::river(speed, 24.0, 8000.0, 2);
    for (std::size_t n = 0; n < samples.size(); ++n)
        samples[n] *= static_cast<float>(std::pow(valueAt(force, static_cast<double>(n) / 8000.0) / 2.0, 0.7));
    const auto fit = analysed(samples, {speed, force});
    CHECK_FALSE(fit.forceLawAssumed);
    CHECK(fit.texture.fullForce == 2.0);
    CHECK(fit.texture.levelByForce == Approx(0.7).margin(0.1));
    CHECK(fit.texture.levelBySpeed == Approx(1.0).margin(0.1));
}

TEST_CASE("A texture plays its recording at trained speeds and at speeds between and beyond", "[texture]")
{
    const auto at = [](double speed)
    {
        return Curve{{0.0, speed}};
    };
    const auto surface = analysed(test::ridges(steps, 24.0, 8000.0, 1), {steps, {}}).texture;
    const auto water = analysed(test::river(steps, 24.0, 8000.0, 1), {steps, {}}).texture;
    for (const double speed : {0.125, 0.18, 0.25, 0.35, 0.5, 0.7, 1.0})
    {
        CAPTURE(speed);
        CHECK(errorAt(surface, speed, test::ridges(at(speed), 10.0, 8000.0, 8)) < 5.0);
        CHECK(errorAt(water, speed, test::river(at(speed), 10.0, 8000.0, 8)) < 1.5);
    }
    // One speed alone: the assumed laws are those of a surface.
    TextureParams params;
    params.speed = 0.5;
    const auto one = analysed(test::ridges(at(0.5), 10.0, 8000.0, 1), {}, params);
    CHECK(one.pitchAssumed);
    CHECK(one.texture.pitch == 1.0);
    Texture known = one.texture;
    known.levelBySpeed = 0.5;
    CHECK(errorAt(known, 0.25, test::ridges(at(0.25), 10.0, 8000.0, 8)) < 5.0);
}

TEST_CASE("A recording that is no texture is refused, and says why", "[texture]")
{
    const auto refusal = [](const std::vector<float>& samples, const TextureMotion& motion = {})
    {
        const auto fit = analyseTexture(samples, 48000, motion, {});
        REQUIRE_FALSE(fit.ok());
        return fit.error().text();
    };
    const auto noise = test::noise(48000, 1);
    CHECK(refusal({}).find("too short") != std::string::npos);
    CHECK(refusal(test::noise(4000, 1)).find("too short") != std::string::npos);
    CHECK(refusal(std::vector<float>(96000, 0.0f)).find("silent") != std::string::npos);
    CHECK(refusal(noise, {{{0.0, 0.0}}, {}}).find("at rest") != std::string::npos);
    CHECK(refusal(noise, {{{0.0, -1.0}}, {}}).starts_with("speed: "));
    CHECK(refusal(noise, {{{0.0, 1.0}}, {{0.0, std::nan("")}}}).starts_with("force: "));
    TextureParams params;
    params.order = 65;
    CHECK_FALSE(analyseTexture(noise, 48000, {}, params).ok());
    auto odd = noise;
    for (const float none : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    {
        odd[970] = none;
        CHECK(refusal(odd).find("not finite") != std::string::npos);
    }
    for (float& sample : odd)
        sample = std::numeric_limits<float>::max();
    CHECK_FALSE(analyseTexture(odd, 48000, {}, {}).ok()); // a level beyond any
}
