// The way from a scene to samples is the same for all who ask for them.

#include "support/Catch.h"
#include "support/Render.h"

#include <pacini/synthesis/RenderScene.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

using namespace pacini;

namespace
{
Clip tone(double frequency, double level, double duration)
{
    Clip clip;
    clip.duration = duration;
    clip.bands.push_back(
        {0.8 * frequency, frequency, 1.25 * frequency, 0, {{0.0, level}, {duration, 0.5 * level}}, {}});
    return clip;
}

/// Two plays on two actuators; `soft` is the level of the second.
Scene twoPlays(double soft = 0.5)
{
    Scene scene;
    scene.clips = {tone(100.0, 0.5, 0.2), tone(230.0, soft, 0.2)};
    scene.actuators = 2;
    scene.plays.resize(2);
    scene.plays[0].pan = 0.3;
    scene.plays[1].clip = 1;
    scene.plays[1].start = 0.1;
    return scene;
}

/// What a rendering tells a sink, which fails at block `failAt`.
class Recorder : public RenderSink
{
public:
    explicit Recorder(std::size_t failAt = std::numeric_limits<std::size_t>::max()) : fails(failAt) {}

    Result<void> begin(const RenderPlan& plan, std::uint64_t count) override
    {
        actuators = plan.actuators;
        frames = count;
        return {};
    }
    Result<void> take(const RenderBlock& block) override
    {
        CHECK(block.channels.size() == actuators);
        CHECK(block.meter != nullptr);
        if (blocks.size() == fails)
            return wasCancelled();
        blocks.push_back(block.frames());
        return {};
    }
    Result<void> progress(double share) override
    {
        shares.push_back(share);
        return {};
    }

    std::size_t actuators = 0;
    std::uint64_t frames = 0;
    std::vector<std::size_t> blocks;
    std::vector<double> shares;

private:
    std::size_t fails;
};

std::string failing(const Scene& scene, const Profile* profile, const RenderParams& params)
{
    const auto rendered = renderScene(scene, profile, params);
    REQUIRE_FALSE(rendered.ok());
    return rendered.error().text();
}
} // namespace

TEST_CASE("A rendered scene is what its player plays, whatever the size of blocks", "[render]")
{
    const Scene scene = twoPlays();
    ScenePlayer player(compilePlan(scene).value());
    const auto played = test::renderChannels(player, 2, 1000);
    for (const std::size_t blockFrames : {std::size_t{1}, std::size_t{80}, std::size_t{4096}})
    {
        RenderParams params;
        params.blockFrames = blockFrames;
        const auto rendered = renderScene(scene, nullptr, params);
        REQUIRE(rendered.ok());
        CHECK(rendered->report.frames == played[0].size());
        CHECK(rendered->report.givenPlays == 2);
        CHECK(rendered->report.keptPlays == 2);
        CHECK(rendered->report.maxSounding == 2);
        CHECK(rendered->report.decoded.empty());
        for (std::size_t a = 0; a < 2; ++a)
        {
            const auto channel = rendered->channel(a);
            CHECK(std::vector<float>(channel.begin(), channel.end()) == played[a]);
        }
    }
}

TEST_CASE("A part of a rendering equals that part of the whole", "[render]")
{
    const Scene scene = twoPlays();
    Profile profile;
    profile.body = BodyParams{};
    for (const bool felt : {false, true})
    {
        RenderParams params;
        if (felt)
            params.felt = FeltParams{};
        const auto whole = renderScene(scene, &profile, params);
        params.from = 0.11;
        params.to = 0.25;
        const auto part = renderScene(scene, &profile, params);
        REQUIRE(whole.ok());
        REQUIRE(part.ok());
        REQUIRE(part->report.frames == 6720);
        for (std::size_t a = 0; a < 2; ++a)
        {
            const auto from = whole->channel(a).subspan(5280, 6720);
            const auto channel = part->channel(a);
            CHECK(std::vector<float>(channel.begin(), channel.end()) == std::vector<float>(from.begin(), from.end()));
        }
    }
}

TEST_CASE("A sink is told how much will come and what is done, and ends a rendering by an error", "[render]")
{
    RenderParams params;
    params.blockFrames = 1000;
    params.from = 0.1;
    Recorder all;
    REQUIRE(renderScene(twoPlays(), nullptr, params, all).ok());
    CHECK(all.actuators == 2);
    CHECK(all.frames == 9600);
    CHECK(all.blocks == std::vector<std::size_t>{1000, 1000, 1000, 1000, 1000, 1000, 1000, 1000, 1000, 600});
    REQUIRE(all.shares.size() == 15); // five of them unheard
    CHECK(all.shares.back() == 1.0);
    Recorder some(2);
    const auto ended = renderScene(twoPlays(), nullptr, params, some);
    REQUIRE_FALSE(ended.ok());
    CHECK(ended.error().code == ErrorCode::cancelled);
    CHECK(some.blocks.size() == 2);
    const auto stopped =
        renderScene(twoPlays(), nullptr, params, [](double) -> Result<void> { return wasCancelled(); });
    REQUIRE_FALSE(stopped.ok());
    CHECK(stopped.error().code == ErrorCode::cancelled);
}

TEST_CASE("What leaving out costs is measured against everything", "[render]")
{
    RenderParams params;
    params.measure = params.describe = true;
    params.compile.tolerance = -20.0;
    const auto rendered = renderScene(twoPlays(0.01), nullptr, params);
    REQUIRE(rendered.ok());
    CHECK(rendered->report.keptPlays == 1);
    CHECK(rendered->report.givenPlays == 2);
    CHECK(rendered->report.decoded.size() == 1);
    REQUIRE(rendered->report.measuredError);
    CHECK(*rendered->report.measuredError < rendered->report.predictedError + 0.1);
    CHECK(*rendered->report.measuredError > -60.0);
    params.compile.leaveOut = false;
    CHECK(*renderScene(twoPlays(0.01), nullptr, params)->report.measuredError ==
          -std::numeric_limits<double>::infinity());
}

TEST_CASE("What cannot be rendered says why", "[render]")
{
    RenderParams params;
    params.from = 9.0;
    CHECK(failing(twoPlays(), nullptr, params) == "has nothing from 9 s on; it lasts 0.300 s");
    params.to = 9.5;
    CHECK(failing(twoPlays(), nullptr, params) == "has nothing from 9 s on to 9.5 s; it lasts 0.300 s");
    params = {};
    params.felt = FeltParams{};
    CHECK(failing(twoPlays(), nullptr, params) == "profile: is needed to predict the acceleration of the skin");
    const Profile bodiless;
    CHECK(failing(twoPlays(), &bodiless, params) ==
          "body: is missing in this profile, so the acceleration of the skin cannot be predicted");
    params = {};
    params.adjustment.stretch = 100.0;
    CHECK(failing(sceneOf(tone(100.0, 0.5, 3600.0)), nullptr, params) ==
          "would last 100.0 hours, at most 24 are written");
    params.adjustment.stretch = 1.0;
    params.adjustment.delay = 86400.0;
    CHECK(failing(sceneOf(tone(100.0, 0.5, 3600.0)), nullptr, params) ==
          "would last 25.0 hours, at most 24 are written");
}
