#include "support/Catch.h"

#include <pacini/foundation/Random.h>
#include <pacini/realtime/BandMeter.h>
#include <pacini/realtime/CarrierVoice.h>
#include <pacini/realtime/DirectPath.h>
#include <pacini/realtime/DriveStage.h>
#include <pacini/realtime/HeardVoice.h>
#include <pacini/realtime/HighBandVoice.h>

#include <array>
#include <cfenv>
#include <cstddef>
#include <span>
#include <vector>

using namespace pacini;

namespace
{
constexpr double quietRate = 6000.0;

/// Whether a part still computes with denormal numbers in the last of the hops of silence that follow a noise: `hop`
/// takes its input.
template <typename Hop>
bool stillDenormal(Hop&& hop)
{
    Random random(6);
    for (std::size_t n = 0; n < 40; ++n)
    {
        std::array<double, controlHop> in{};
        for (double& x : in)
            x = random.uniform(-1.0, 1.0);
        hop(in);
    }
    const std::array<double, controlHop> silence{};
    for (std::size_t n = 0; n < 20000; ++n)
        hop(silence);
    std::feclearexcept(FE_UNDERFLOW);
    hop(silence);
    return std::fetestexcept(FE_UNDERFLOW) != 0;
}
} // namespace

TEST_CASE("in silence no part of the translator computes with denormal numbers", "[realtime]")
{
    BandMeter meter;
    meter.design(designBandLayout({.bands = 5}), quietRate);
    CHECK_FALSE(stillDenormal(
        [&](std::span<const double> in)
        {
            meter.process(in);
            for (std::size_t k = 0; k < 5; ++k)
                (void)meter.takePower(k);
            meter.flush();
        }));

    DirectPath path;
    path.design(Hertz(30.0), Hertz(100.0), Hertz(900.0), quietRate);
    path.jump(1.0, 0.5);
    CHECK_FALSE(stillDenormal(
        [&](std::span<const double> in)
        {
            std::array<double, controlHop> out{};
            path.aim(1.0, 0.5, 0.5);
            path.process(in, out, 0);
            path.flush();
        }));

    BandListener listener;
    listener.design(Hertz(60.0), Hertz(120.0), quietRate);
    CHECK_FALSE(stillDenormal(
        [&](std::span<const double> in)
        {
            listener.process(in);
            (void)listener.hear();
            listener.flush();
        }));

    HighBandVoice voice;
    voice.design(quietRate);
    voice.jump(1.0);
    CHECK_FALSE(stillDenormal(
        [&](std::span<const double> in)
        {
            std::array<double, controlHop> out{};
            voice.aim(1.0, 1.0, 0.03);
            voice.process(in, out, 0);
            voice.flush();
        }));

    HeardVoice heard;
    heard.design(5.0, 2000.0, quietRate);
    heard.jump(1.0);
    CHECK_FALSE(stillDenormal(
        [&](std::span<const double> in)
        {
            std::array<double, controlHop> out{};
            heard.aim(1.0, 1.0, 1.0, 0.0, 0.0);
            heard.process(in, in, out, 0);
            heard.flush();
        }));
}

TEST_CASE("in silence no drive stage computes with denormal numbers", "[realtime]")
{
    for (const bool motor : {false, true})
    {
        CAPTURE(motor);
        TranslatorSetup setup;
        setup.maxBoost = Decibels(0.0);
        Profile& profile = setup.profile.emplace();
        profile.technology = motor ? Technology::erm : Technology::vca;
        profile.polyphony = motor ? 0 : 64;
        profile.range = {50.0, 400.0, 60.0};
        profile.equalizer = {{EqualizerType::peak, 120.0, -9.0, 4.0, 2}, {EqualizerType::peak, 260.0, 6.0, 2.0, 2}};
        const TranslatorDesign design = designTranslator(setup, quietRate);
        CHECK(design.filter.sections.empty() == motor);
        DriveStage stage;
        stage.adopt(design);
        stage.jump(1.0);
        CHECK_FALSE(stillDenormal(
            [&](std::span<const double> in)
            {
                double energy = 0.0;
                std::array<float, controlHop> out{};
                std::array<double, controlHop> gates{};
                gates.fill(1.0);
                for (std::size_t i = 0; i < controlHop; ++i)
                {
                    energy += in[i] * in[i];
                    out[i] = static_cast<float>(in[i]);
                }
                stage.aim(1.0, 0.5, 1.0, energy);
                (void)stage.process(out, gates, 0);
            }));
    }
}
