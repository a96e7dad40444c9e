#pragma once

// Parameters and report of a rendering, without its algorithms.

#include <pacini/synthesis/CompileParams.h>
#include <pacini/synthesis/RenderPlan.h>
#include <pacini/synthesis/SceneAdjustment.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pacini
{

/// Who feels a rendering, and in which unit.
struct FeltParams
{
    unsigned wearer = 0;      ///< see bodyOn
    double fullScale = 100.0; ///< m/s^2 at a sample of 1
};

/// How a scene is rendered.
struct RenderParams
{
    CompileParams compile; ///< with the sample rate of the output
    SceneAdjustment adjustment;
    double from = 0.0;              ///< s of what comes of it: where the output starts
    std::optional<double> to;       ///< s, where it ends; none: at the end
    bool protect = true;            ///< keep within full drive and the limits of the profile
    std::optional<FeltParams> felt; ///< render what is felt instead of the drive signal
    bool measure = false;           ///< also play everything, to measure what leaving out costs
    bool describe = false;          ///< report what each decoder plays
    std::size_t blockFrames = 4096; ///< the most that a sink gets at a time
};

/// What a rendering was made of.
struct RenderReport
{
    std::size_t actuators = 1;
    std::uint64_t frames = 0;    ///< of the output
    std::size_t givenPlays = 0;  ///< of the scene
    std::size_t keptPlays = 0;   ///< of the plan
    std::size_t maxSounding = 0; ///< decoders at a time
    double reduction = 0.0;      ///< dB, the most that was taken to keep within full drive and the profile's limits
    double predictedError = 0.0; ///< dB, of all that is left out; -infinity: nothing is lost
    std::optional<double> measuredError; ///< dB, what leaving out really cost; where it was to be measured
    std::vector<Adaptation> adaptations;
    std::vector<LeftOut> leftOut;       ///< in order of what it costs
    std::vector<DecodedPlay> decoded;   ///< in order of start; where they were to be described
    std::vector<std::string> playNames; ///< of all plays of the scene then, or of their clips
};

} // namespace pacini
