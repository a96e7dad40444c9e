// The call `render`: clips and scenes to drive signals, or to what is felt of them.

#include "io/SceneJson.h"
#include "web/core/Call.h"

#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/SceneAdjustment.h>
#include <pacini/synthesis/SignalPlayer.h>

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

namespace pacini::web
{

namespace
{
/// "0" to the first of the clips after the scene, and so on: its text names them so.
Result<Scene> sceneOfInputs(const Call& call, std::size_t firstClip)
{
    const ClipLoader loader = [&](const std::string& file) -> Result<Clip>
    {
        char* end = nullptr;
        const auto index = static_cast<std::size_t>(std::strtoul(file.c_str(), &end, 10));
        if (file.empty() || *end != '\0' || firstClip + index >= call.inputs())
            return Error{ErrorCode::invalidData, "", "is none of the clips"};
        return clipOf(call, firstClip + index);
    };
    return readSceneJson(call.text(0), loader);
}
} // namespace

Result<void> renderClipOrScene(Call& call)
{
    const bool isScene = call.truth("scene", false);
    const bool withProfile = call.truth("withProfile", false);
    CompileParams compiling;
    compiling.sampleRate = call.number("sampleRate", 48000.0, limits::lowestRate, limits::highestRate);
    compiling.leaveOut = call.truth("leaveOut", compiling.leaveOut);
    compiling.adapt = call.truth("adapt", compiling.adapt);
    compiling.adaptation.strength = call.number("strength", compiling.adaptation.strength, 0.0, 1.0);
    SceneAdjustment adjustment;
    adjustment.gain = call.number("gain", adjustment.gain, -1000.0, 60.0);
    adjustment.transposition = call.number("transpose", adjustment.transposition, -96.0, 96.0);
    adjustment.stretch = call.number("stretch", adjustment.stretch, 0.01, 100.0);
    const bool feels = call.truth("felt", false);
    const double fullScale = call.number("fullScale", 100.0, 1e-3, 1e6);
    const auto wearer = static_cast<unsigned>(call.number("wearer", 0.0, 0.0, simulatedWearers));
    ScenePlayerParams playing;
    playing.sampleRate = compiling.sampleRate;
    playing.protect = call.truth("protect", true);
    if (call.reader.error)
        return {};
    const std::size_t firstClip = withProfile ? 2 : 1;
    std::optional<Profile> profile;
    if (withProfile)
    {
        auto read = profileOf(call, 1);
        if (!read)
            return read.error();
        profile = std::move(*read);
    }
    std::optional<FeltSettings> felt;
    if (feels)
    {
        if (!profile)
            return Error{ErrorCode::invalidArgument, "profile", "is needed to know what is felt"};
        felt = feltSettingsOf(*profile, wearer, fullScale);
        if (!felt)
            return Error{ErrorCode::invalidData, "body",
                         "is missing in this profile, so nothing is known of what is felt"};
    }
    Scene scene;
    if (isScene)
    {
        auto read = sceneOfInputs(call, firstClip);
        if (!read)
            return read.error();
        scene = std::move(*read);
    }
    else
    {
        auto clip = clipOf(call, 0);
        if (!clip)
            return clip.error();
        scene = sceneOf(*clip);
    }
    scene = adjusted(std::move(scene), adjustment);
    auto plan = compilePlan(scene, profile ? &*profile : nullptr, compiling);
    if (!plan)
        return plan.error();
    Json leftOut = Json::array(), adaptations = Json::array();
    for (const LeftOut& item : plan->leftOut)
        leftOut.push_back({{"where", item.where}, {"reason", item.reason}, {"error", item.error}});
    for (const Adaptation& item : plan->adaptations)
        adaptations.push_back({{"where", item.where}, {"what", item.what}});
    const std::size_t actuators = plan->actuators;
    call.value = {{"actuators", actuators},
                  {"predictedError", plan->predictedError},
                  {"leftOut", std::move(leftOut)},
                  {"adaptations", std::move(adaptations)}};
    SignalPlayer player(std::move(*plan), playing, felt);
    const auto frames = static_cast<std::size_t>(player.totalFrames());
    std::vector<std::vector<float>> channels(actuators, std::vector<float>(frames));
    constexpr std::size_t blockFrames = 4096;
    std::vector<std::span<float>> block(actuators);
    for (std::size_t done = 0; done < frames;)
    {
        const std::size_t count = std::min(blockFrames, frames - done);
        for (std::size_t a = 0; a < actuators; ++a)
            block[a] = std::span(channels[a]).subspan(done, count);
        player.process(block);
        done += count;
    }
    call.value["frames"] = frames;
    call.value["reduction"] = player.maxReduction();
    for (const auto& channel : channels)
        call.put(std::span<const float>(channel));
    return {};
}

} // namespace pacini::web
