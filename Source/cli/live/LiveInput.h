#pragma once

// Sounds that are read piece by piece as they come: WAV or raw samples from a pipe, and sound files.

#include <pacini/foundation/Result.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pacini::cli
{

/// Encoding of raw samples, little-endian.
enum class RawSamples
{
    s16,
    s24,
    s32,
    f32,
};

/// Format of a raw stream, which has no header.
struct RawFormat
{
    RawSamples samples = RawSamples::s16;
    double sampleRate = 48000.0; ///< Hz
    std::size_t channels = 2;
};

class LiveInput
{
public:
    virtual ~LiveInput() = default;

    /// Opens `path`: `-` is standard input. Pipes and devices are read as they come, WAV unless a format is given;
    /// their header is waited for. Files may be of any format. Ends early once `stop` is true. Errors: io,
    /// invalidData, those of AudioReader. [worker]
    [[nodiscard]] static Result<std::unique_ptr<LiveInput>>
    open(const std::string& path, const std::optional<RawFormat>& raw, const std::atomic<bool>& stop);

    [[nodiscard]] virtual double sampleRate() const = 0;
    [[nodiscard]] virtual std::size_t channels() const = 0;

    /// Whether it comes at a pace of its own: a pipe, not a file.
    [[nodiscard]] virtual bool isLive() const = 0;

    /// Waits until there are frames, at most as many as fit; 0 at the end, or once `stop` is true. Errors: io,
    /// those of AudioReader. [worker]
    [[nodiscard]] virtual Result<std::size_t> read(std::span<float> interleaved) = 0;

    /// What was missing or unusable in all that was read, in sentences; empty when it came whole. [worker]
    [[nodiscard]] virtual std::vector<std::string> losses() const { return {}; }
};

} // namespace pacini::cli
