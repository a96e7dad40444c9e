#pragma once

// Encoding job: one sound file into a clip or, by methods that make no clip, a drive signal.

#include "cli/Overwrite.h"
#include "io/AudioReader.h"
#include "io/ClipFile.h"
#include "io/SoundEncoder.h"
#include "io/Stopwatch.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pacini::cli
{

struct EncodeSettings : SoundEncoderParams
{
    const ClipFormat* format = &jsonFormat(); ///< never null
    ExportParams exporting;                   ///< for formats of others
    std::optional<FoundMarkers> markers;      ///< besides those of the sound
    std::optional<double> shortestScene;      ///< s: a file for each scene, none shorter
    bool dryRun = false;                      ///< only look at the sound, write nothing
    bool force = false; ///< encode even what is up to date; signals and formats of others, which have no record of the
                        ///< method, always are
};

/// Result of the encoding of one file.
struct EncodeResult
{
    std::size_t bytes = 0; ///< size of the output file, or files
    double duration = 0.0; ///< s of sound
    double seconds = 0.0;  ///< s of work, without access to files
    std::size_t breakpoints = 0;
    std::size_t transients = 0;
    std::uint64_t replacedSamples = 0; ///< NaN and infinite ones
    std::vector<std::string> warnings; ///< of the sound
    std::filesystem::path stray;       ///< see strayCompanion()
    std::size_t scenes = 0;            ///< files of scenes beside the output
    bool upToDate = false;             ///< nothing was done
};

/// Encodes files one after another with one set of parameters; keeps filters and transforms between them. The output is
/// a clip or, for methods that make signals, a WAV file of 32-bit float samples. a2vt reads a sound piece by piece; the
/// other methods hold all of it. One thread at a time.
class EncodeJob
{
public:
    explicit EncodeJob(const EncodeSettings& settings);

    /// Encodes a file. `progress(share)` is called repeatedly. Errors: those of AudioReader, writeClip and AudioWriter,
    /// without the file's name; tooLarge beyond 24 hours; io if the file at `output` must not be replaced. One of
    /// Pacini's clips that was or may have been edited since its encoding is replaced only if any file may be.
    [[nodiscard]] Result<EncodeResult> run(const std::filesystem::path& input, const std::filesystem::path& output,
                                           Replaceable replaceable, const std::function<void(double)>& progress);

    /// The clip of one file as run() writes it. Only for methods that make clips. Errors: as run().
    [[nodiscard]] Result<Clip> encode(const std::filesystem::path& input, const std::function<void(double)>& progress);

private:
    using Path = std::filesystem::path;
    using Progress = std::function<void(double)>;

    /// Target of the result.
    struct Target
    {
        const Path& output;
        Replaceable replaceable = Replaceable::own;
        Existing existing = Existing::replace;
        FileOrigin origin; ///< of a signal
    };

    /// Returns how the clip may be written, unless the existing one is up to date, which `result` then records.
    [[nodiscard]] Result<Existing> lookAt(const Path& input, const Target& target, EncodeResult& result) const;

    /// Whether a clip was made of `input` by this version in this way.
    [[nodiscard]] bool isMadeSo(const Clip& clip, const Path& input) const;

    /// Returns the encoder record of a new clip of `input`, without the parts that depend on its samples.
    [[nodiscard]] std::vector<EncoderParameter> expectedRecord(const Clip& clip, const Path& input) const;
    [[nodiscard]] std::vector<EncoderParameter> methodRecord(const Clip& clip) const;

    /// Write a clip, or a signal, and return the size of the file or files.
    [[nodiscard]] Result<std::size_t> write(Clip clip, const Target& target, Stopwatch& work,
                                            EncodeResult& result) const;
    [[nodiscard]] Result<std::size_t> write(std::span<const float> signal, int sampleRate, const Target& target,
                                            EncodeResult& result) const;

    EncodeSettings settings;
    SoundEncoder encoder;
};

} // namespace pacini::cli
