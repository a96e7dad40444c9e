#include "cli/SceneFiles.h"

#include "cli/Overwrite.h"
#include "cli/Task.h"
#include "io/AtomicFile.h"
#include "io/ClipFile.h"
#include "io/ClipSeal.h"
#include "io/SceneJson.h"

#include <pacini/clip/PackedClip.h>
#include <pacini/clip/edits/SilenceCuts.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace pacini::cli
{

namespace fs = std::filesystem;

Result<SceneFiles> sceneFiles(const Clip& clip, const fs::path& place, double shortest, const ClipFormat& format,
                              const ExportParams& params)
{
    std::string name = place.filename().string();
    name.resize(name.size() - sceneExtension.size());
    const auto ranges = scenesOf(clip, {.shortestScene = shortest});
    if (ranges.size() > limits::sceneClips)
        return Error{ErrorCode::tooLarge, "",
                     fmt::format("would have more than {} scenes; name a larger --scenes", limits::sceneClips)};
    SceneFiles all;
    all.scenes = ranges.size();
    nlohmann::ordered_json scene{{"format", sceneFormatName},
                                 {"version", sceneFormatVersion},
                                 {"name", clip.name},
                                 {"duration", clip.duration},
                                 {"clips", nlohmann::ordered_json::array()},
                                 {"plays", nlohmann::ordered_json::array()}};
    for (std::size_t i = 0; i < ranges.size(); ++i)
    {
        Clip part = trimClip(clip, ranges[i]);
        part.name = fmt::format("{} {}", clip.name, i + 1);
        part = onGrids(std::move(part));
        if (format.isOwn())
            sealClip(part);
        auto written = format.write(part, params);
        if (!written)
            return written.error();
        const fs::path main =
            place.parent_path() / fs::path(fmt::format("{}-{:04}{}", name, i + 1, std::string(format.extension)));
        for (ExportedFile& file : written->files)
            all.files.emplace_back(file.suffix.empty() ? main : exportPath(main, file.suffix), std::move(file.bytes));
        scene["clips"].push_back(main.filename().string());
        scene["plays"].push_back({{"clip", i}, {"start", ranges[i].from}});
    }
    all.files.emplace_back(place, scene.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    return all;
}

Result<std::size_t> writeSceneFiles(const SceneFiles& files, Replaceable allowed)
{
    std::vector<Existing> ways;
    for (const auto& [path, bytes] : files.files)
    {
        const auto way = mayReplace(path, std::string_view(bytes), allowed);
        if (!way)
            return way.error();
        ways.push_back(*way);
    }
    std::size_t size = 0;
    for (std::size_t i = 0; i < ways.size(); ++i)
    {
        const auto& [path, bytes] = files.files[i];
        if (const auto written = writeFileAtomically(path, bytes, ways[i]); !written)
            return atOutput(path, written.error());
        size += bytes.size();
    }
    return size;
}

} // namespace pacini::cli
