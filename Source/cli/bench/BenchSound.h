#pragma once

// Sound to measure on, with its annotated onsets where they are known.

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pacini::cli
{

/// Annotated onsets of a sound, s.
struct KnownEvents
{
    std::vector<double> onsets;
    std::vector<double> ambiguous; ///< may be found or not
};

struct BenchSound
{
    std::filesystem::path path;
    std::string name; ///< of the file
    int sampleRate = 0;
    int channels = 0;
    std::vector<float> interleaved;
    std::vector<float> mono; ///< mean of the channels
    std::optional<KnownEvents> events;

    [[nodiscard]] double duration() const { return static_cast<double>(mono.size()) / sampleRate; }

    /// The first `seconds` of the mono signal, or all of it.
    [[nodiscard]] std::span<const float> beginning(double seconds) const;
};

/// Reads a sound and its entries in `onsets.json` and `onsets_ambiguous.json` of its folder: objects whose keys are
/// file names and whose values are lists of seconds. Errors: those of readAudio; invalidData for a sound without frames
/// and for an onsets.json that is not such an object.
[[nodiscard]] Result<BenchSound> readBenchSound(const std::filesystem::path& path);

} // namespace pacini::cli
