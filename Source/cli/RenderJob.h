#pragma once

// Rendering job: one clip or scene into one sound file.

#include "cli/Felt.h"
#include "cli/Overwrite.h"
#include "io/AudioWriter.h"
#include "io/ClipFile.h"

#include <pacini/actuator/Profile.h>
#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/DecoderParams.h>
#include <pacini/synthesis/SceneAdjustment.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pacini::cli
{

/// Settings of a rendering.
struct RenderSettings
{
    SceneAdjustment adjustment;
    double from = 0.0;        ///< s of what comes of it: where the output starts
    std::optional<double> to; ///< s, where it ends; nothing: at the end

    CompileParams compile;
    std::optional<Profile> profile;
    std::optional<FeltSettings> felt; ///< write what is felt instead of the drive signal
    bool protect = true;              ///< keep within full drive and the limits of the profile
    ClipReadParams reading;
    SampleEncoding encoding = SampleEncoding::float32;
    std::string record;    ///< all that the output depends on besides the input
    bool resume = true;    ///< do nothing where an output that was not named is up to date
    bool describe = false; ///< find out what each decoder plays
    bool dryRun = false;   ///< only read, write nothing
    bool measure = false;  ///< also play everything, to measure what leaving out costs
};

/// One play as it was rendered.
struct PlayReport
{
    std::size_t play = 0; ///< index in the scene
    std::string name;
    double start = 0.0;    ///< s
    double duration = 0.0; ///< s
    DecoderReport decoder;
};

struct RenderResult
{
    std::uint64_t bytes = 0;
    double duration = 0.0;  ///< s of the output
    double seconds = 0.0;   ///< s of work, without access to files
    double peak = 0.0;      ///< largest magnitude of a sample
    double reduction = 0.0; ///< dB, the most that was taken to keep within full drive and the limits of the profile
    std::uint64_t clippedSamples = 0;
    bool upToDate = false; ///< nothing was done; only bytes and duration are known
    bool isScene = false;
    std::vector<std::string> warnings; ///< of reading
    std::size_t actuators = 1;
    std::size_t givenPlays = 0;
    std::size_t keptPlays = 0;
    std::size_t maxSounding = 0;    ///< decoders at a time
    double predictedError = 0.0;    ///< dB, of all that is left out; -infinity: nothing is lost
    std::optional<double> measured; ///< dB, the error that leaving out really cost
    std::vector<Adaptation> adaptations;
    std::string protection;        ///< what becomes of the profile's limits; empty: no profile
    std::vector<LeftOut> leftOut;  ///< in order of what it costs
    std::vector<PlayReport> plays; ///< when they were to be described; in order of start
};

/// Errors: those of readClipOrScene, compilePlan and AudioWriter, without the file's name; io when what is at `output`
/// is not to be replaced.
[[nodiscard]] Result<RenderResult> render(const std::filesystem::path& input, const std::filesystem::path& output,
                                          Replaceable replaceable, const RenderSettings& settings,
                                          const std::function<void(double)>& progress);

} // namespace pacini::cli
