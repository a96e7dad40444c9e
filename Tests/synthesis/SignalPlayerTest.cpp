// Felt signals do not depend on how they are asked for.

#include "support/Catch.h"
#include "support/Render.h"

#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/SignalPlayer.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
/// All frames of a scene of two actuators, asked for in blocks of that many frames.
std::vector<std::vector<float>> felt(const Scene& scene, const Profile& profile, std::size_t blockFrames)
{
    auto plan = compilePlan(scene, &profile, {});
    REQUIRE(plan);
    const auto model = feltModelParams(profile);
    REQUIRE(model);
    SignalPlayer player(std::move(*plan), {}, FeltSettings{*model, 0, profile.drive.overdrive, 100.0});
    return test::renderChannels(player, 2, blockFrames);
}
} // namespace

TEST_CASE("a felt signal does not depend on blocks", "[felt]")
{
    Clip clip;
    clip.duration = 0.1;
    clip.bands.push_back({80.0, 100.0, 125.0, 0, {{0.0, 0.5}, {0.1, 0.2}}, {}});
    Scene scene;
    scene.clips.push_back(clip);
    scene.actuators = 2;
    scene.plays.push_back({});
    scene.plays[0].pan = 0.3;
    scene.plays.push_back({});
    scene.plays[1].start = 0.05;
    Profile profile;
    profile.body = BodyParams{};
    for (const Technology technology : {Technology::vca, Technology::erm})
    {
        profile.technology = technology;
        profile.polyphony = technology == Technology::erm ? 0 : Profile::unlimitedPolyphony;
        const auto whole = felt(scene, profile, 4096);
        CHECK(*std::max_element(whole[0].begin(), whole[0].end()) > 0.0f);
        CHECK(whole[0] != whole[1]);
        for (const std::size_t blockFrames : {std::size_t{1}, std::size_t{7}, std::size_t{1000}})
            CHECK(felt(scene, profile, blockFrames) == whole);
    }
}
