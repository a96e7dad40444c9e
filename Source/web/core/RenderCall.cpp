// The call `render`: renders clips and scenes as drive signals, or as the acceleration of the skin.

#include "io/GivenParameters.h"
#include "io/SceneJson.h"
#include "web/core/Call.h"

#include <pacini/synthesis/RenderScene.h>

#include <cstddef>
#include <cstdlib>
#include <optional>
#include <utility>

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
            return Error{ErrorCode::invalidData, "", "is not one of the clips"};
        return clipOf(call, firstClip + index);
    };
    return readSceneJson(call.text(0), loader);
}
} // namespace

Result<void> renderClipOrScene(Call& call)
{
    const bool isScene = call.truth("scene", false);
    const bool withProfile = call.truth("withProfile", false);
    RenderParams params;
    CompileParams& compiling = params.compile;
    compiling.leaveOut = call.truth("leaveOut", compiling.leaveOut);
    compiling.adapt = call.truth("adapt", compiling.adapt);
    GivenParameters given, givenFelt;
    readParameters(call.reader, infosOf(renderParameters), given);
    readParameters(call.reader, infosOf(feltParameters), givenFelt);
    for (const auto& [parameter, value] : given)
        parameterNamed(renderParameters, parameter->name).set(params, value);
    FeltParams felt;
    for (const auto& [parameter, value] : givenFelt)
        parameterNamed(feltParameters, parameter->name).set(felt, value);
    const bool isFelt = call.truth("felt", false);
    if (isFelt)
        params.felt = felt;
    params.protect = call.truth("protect", params.protect);
    if (auto known = call.finishOptions(); !known)
        return known;
    if (auto part = checkPart(params); !part)
        return part;
    for (const auto& [parameter, value] : given)
        if (auto used = checkEffect(parameterNamed(renderParameters, parameter->name), params, withProfile); !used)
            return used;
    for (const auto& [parameter, value] : givenFelt)
        if (!isFelt)
            return Error{ErrorCode::invalidArgument, std::string(parameter->name),
                         "is for the felt acceleration; leave it out, or choose felt"};
    const std::size_t firstClip = withProfile ? 2 : 1;
    std::optional<Profile> profile;
    if (withProfile)
    {
        auto read = profileOf(call, 1);
        if (!read)
            return read.error();
        profile = std::move(*read);
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
    auto rendered = renderScene(std::move(scene), profile ? &*profile : nullptr, params);
    if (!rendered)
        return rendered.error();
    const RenderReport& report = rendered->report;
    Json leftOut = Json::array(), adaptations = Json::array();
    for (const LeftOut& item : report.leftOut)
        leftOut.push_back(
            {{"where", item.where}, {"reason", item.reason}, {"error", item.error}, {"unplayable", item.unplayable}});
    for (const Adaptation& item : report.adaptations)
        adaptations.push_back({{"where", item.where}, {"what", item.what}});
    call.value = {{"actuators", report.actuators}, {"predictedError", report.predictedError},
                  {"leftOut", std::move(leftOut)}, {"adaptations", std::move(adaptations)},
                  {"frames", report.frames},       {"reduction", report.reduction}};
    for (std::size_t a = 0; a < report.actuators; ++a)
        call.put(rendered->channel(a));
    return {};
}

} // namespace pacini::web
