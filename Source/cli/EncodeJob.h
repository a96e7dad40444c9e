#pragma once

// Encodes one file into another.

#include "io/AudioReader.h"
#include "io/ClipFile.h"

#include <pacini/analysis/Encoder.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace pacini::cli
{

struct EncodeSettings
{
    EncoderParams params;
    ClipFormat format = ClipFormat::json;
    AudioReadOptions reading;
    bool force = false; ///< encode even what is up to date
};

/// What came of one file.
struct EncodeResult
{
    std::size_t bytes = 0; ///< size of the output file
    double duration = 0.0; ///< s of sound
    double seconds = 0.0;  ///< s of work, without access to files
    std::size_t breakpoints = 0;
    std::size_t transients = 0;
    std::uint64_t replacedSamples = 0; ///< NaN and infinite ones
    bool upToDate = false;             ///< nothing was done
};

/// Encodes files one after another with one set of parameters; keeps filters and transforms between them. One thread
/// at a time.
class EncodeJob
{
public:
    explicit EncodeJob(const EncodeSettings& settings);

    /// `progress(share)` is called now and then. Errors: those of AudioReader and writeClip, without the file's name.
    [[nodiscard]] Result<EncodeResult> run(const std::filesystem::path& input, const std::filesystem::path& output,
                                           const std::function<void(double)>& progress);

    /// The clip of one file, as run() would write it. Errors: those of AudioReader.
    [[nodiscard]] Result<Clip> encode(const std::filesystem::path& input, const std::function<void(double)>& progress);

private:
    struct Encoded
    {
        Clip clip;
        std::vector<std::byte> packed;
    };

    [[nodiscard]] Result<Encoded> encode(const std::filesystem::path& input, EncodeResult& result,
                                         const std::function<void(double)>& progress);
    [[nodiscard]] bool isUpToDate(const std::filesystem::path& input, const std::filesystem::path& output,
                                  EncodeResult& result) const;

    EncodeSettings settings;
    Encoder encoder;
};

} // namespace pacini::cli
