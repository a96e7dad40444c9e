#include "actuator/BodyReference.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/actuator/FeltModel.h>

#include <limits>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("The streamed body measures as the continuous response, two frames late", "[actuator][body]")
{
    const Resonance resonance{65.93, 3.969};
    for (const double stiffness : {4e4, 2e6, 1e10})
        for (const BodyPoint point : {BodyPoint::movingMass, BodyPoint::device, BodyPoint::skin, BodyPoint::excursion})
        {
            BodyModelParams params;
            params.body.jointStiffness = stiffness;
            params.body.force = 2.5;
            params.resonance = resonance;
            params.point = point;
            for (const double fs : {8000.0, 48000.0})
            {
                BodyModel model;
                model.setParams(params);
                model.prepare({fs, 512});
                const auto h = runInBlocks(model, impulse(static_cast<std::size_t>(2.0 * fs)), 512);
                for (const double f : {35.0, 66.0, 250.0, 900.0})
                {
                    CAPTURE(stiffness, static_cast<int>(point), fs, f);
                    const auto wanted = bodyFrequencyResponse(params.body, resonance, Hertz(f), point);
                    const double late = static_cast<double>(model.latencyFrames());
                    const auto found =
                        spectrumAt<float>(h, f, fs) * std::polar(1.0, 2.0 * std::numbers::pi * f / fs * late);
                    // The tolerance of what is left out, and what float samples hold.
                    const double allowed = model.plan().omissions.empty() ? 1e-4 : 2e-3;
                    CHECK(std::abs(found - wanted) <= allowed * std::abs(wanted));
                }
            }
        }
}

TEST_CASE("The body keeps the contract of blocks", "[actuator][body][contract]")
{
    const ContractOptions options{.bound = 1e4};
    for (const BodyPoint point : {BodyPoint::movingMass, BodyPoint::device, BodyPoint::skin, BodyPoint::excursion})
        for (const double stiffness : {1e4, 1e7, 1e12})
        {
            BodyModelParams params;
            params.body.jointStiffness = stiffness;
            params.point = point;
            checkBlockContract<BodyModel>(params, options);
            params.driven = BodyForce::device;
            checkBlockContract<BodyModel>(params, options);
        }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    checkBlockContract<BodyModel>({{nan, nan, nan, nan, nan, nan, nan, nan}, {nan, nan}}, {.bound = 1e30});
    BodyModelParams undamped;
    undamped.body.skinStiffness = undamped.body.skinDamping = undamped.body.jointDamping = 0.0;
    checkBlockContract<BodyModel>(undamped, options);
    checkSilenceIsCheap<BodyModel>({});
    checkSilenceIsCheap<BodyModel>({}, 480000);
}

TEST_CASE("The body stays bounded while wearer and actuator change with every frame", "[actuator][body][contract]")
{
    std::vector<BodyModelParams> params(4);
    params[1].body.jointStiffness = 1e12;
    params[2].resonance = {200.0, 50.0};
    params[2].point = BodyPoint::device;
    params[3].driven = BodyForce::device;
    checkModulation<BodyModel>(params, 1e3, 500);
}

TEST_CASE("A heavier wrist feels less", "[actuator][body]")
{
    BodyModelParams light, heavy;
    heavy.body.skinMass = 0.06;
    const auto felt = [](const BodyModelParams& params)
    {
        BodyModel model;
        model.setParams(params);
        model.prepare({8000.0, 8000});
        auto x = sine(8000, 250.0, 8000.0);
        model.process(x, x);
        return rms(std::span<const float>(x).subspan(4000));
    };
    CHECK(felt(heavy) < 0.8 * felt(light));
}

TEST_CASE("The felt model of a profile is its spring chain or its motor, and keeps the contract", "[actuator][body]")
{
    Profile profile;
    CHECK_FALSE(feltModelParams(profile).has_value());
    profile.body = BodyParams{};
    profile.technology = Technology::lra;
    profile.resonance = {175.0, 10.0};
    profile.response = {0.05, 0.08};
    const auto lra = feltModelParams(profile);
    REQUIRE(lra.has_value());
    profile.technology = Technology::erm;
    const auto erm = feltModelParams(profile);
    REQUIRE(erm.has_value());
    checkBlockContract<FeltModel>(*lra, {.bound = 1e4});
    checkBlockContract<FeltModel>(*erm, {.bound = 1e4});

    const double fs = 48000.0;
    const auto x = noise(4800, 2);
    FeltModel felt;
    felt.setParams(*lra);
    felt.prepare({fs, 4800});
    BodyModel chain;
    chain.setParams({*profile.body, profile.resonance});
    chain.prepare({fs, 4800});
    CHECK(runInBlocks(felt, x, 480) == runInBlocks(chain, x, 480));

    // A spun-up motor: a sinusoid of its frequency on the device, force / mass at first.
    felt.setParams(*erm);
    felt.reset();
    const auto y = runInBlocks(felt, std::vector<float>(48000, 1.0f), 480);
    const auto wanted = makeBodyChain(*profile.body, profile.resonance, BodyForce::device)
                            .response(BodyPoint::skin, Hertz(profile.resonance.frequency));
    CHECK(rms(std::span<const float>(y).subspan(24000)) == Approx(std::abs(wanted) / std::sqrt(2.0)).epsilon(1e-3));
}
