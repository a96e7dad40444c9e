#pragma once

// Rendering job: one clip or scene into one sound file.

#include "cli/Overwrite.h"
#include "io/AudioWriter.h"
#include "io/ClipFile.h"

#include <pacini/actuator/Profile.h>
#include <pacini/synthesis/RenderParams.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pacini::cli
{

/// Settings of a rendering.
struct RenderSettings : RenderParams
{
    std::optional<Profile> profile;
    std::optional<Profile> designedFor; ///< clips shall feel on `profile` as they do there
    ClipReadParams reading;
    SampleEncoding encoding = SampleEncoding::float32;
    std::string record;  ///< everything that affects the output besides the input
    bool resume = true;  ///< do nothing where an output that was not named is up to date
    bool dryRun = false; ///< only read, write nothing
};

struct RenderResult : RenderReport
{
    std::uint64_t bytes = 0;
    double duration = 0.0; ///< s of the output
    double seconds = 0.0;  ///< s of work, without access to files
    double peak = 0.0;     ///< largest magnitude of a sample
    std::uint64_t clippedSamples = 0;
    bool upToDate = false; ///< nothing was done; only bytes and duration are known
    bool isScene = false;
    std::vector<std::string> warnings; ///< of reading
    std::string protection;            ///< protection by the profile's limits; empty without a profile
};

/// Errors: those of readClipOrScene, renderScene and AudioWriter, without the file's name; io if the file at `output`
/// must not be replaced.
[[nodiscard]] Result<RenderResult> render(const std::filesystem::path& input, const std::filesystem::path& output,
                                          Replaceable replaceable, const RenderSettings& settings,
                                          const std::function<void(double)>& progress);

} // namespace pacini::cli
