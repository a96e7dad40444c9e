#pragma once

// Renders one clip into one sound file.

#include "io/AudioWriter.h"

#include <pacini/actuator/Profile.h>
#include <pacini/clip/Clip.h>
#include <pacini/synthesis/Decoder.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace pacini::cli
{

/// How to render; what is not set follows from the clip's method.
struct RenderSettings
{
    DecoderParams decoder; ///< the fields below win over its carriers, followEnvelope, pulses
    std::optional<CarrierMode> carriers;
    std::optional<bool> followEnvelope;
    std::optional<PulseShape> pulseShape;
    std::optional<double> pulseFrequency;
    double pulseCycles = 1.0;
    std::optional<Profile> profile;
    SampleEncoding encoding = SampleEncoding::float32;
};

struct RenderResult
{
    std::uint64_t bytes = 0;
    double duration = 0.0; ///< s of the output
    double seconds = 0.0;  ///< s of work, without access to files
    double peak = 0.0;     ///< largest magnitude, 1 = full drive
    std::uint64_t clippedSamples = 0;
    DecoderReport report;
};

/// The decoder's parameters for a clip: those of the thesis for its clips, else Pacini's own, changed by what is set.
[[nodiscard]] DecoderParams decoderParamsFor(const Clip& clip, const RenderSettings& settings);

/// Errors: those of readClip and AudioWriter, without the file's name.
[[nodiscard]] Result<RenderResult> render(const std::filesystem::path& input, const std::filesystem::path& output,
                                          const RenderSettings& settings, const std::function<void(double)>& progress);

} // namespace pacini::cli
