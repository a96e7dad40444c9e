#pragma once

// A drive signal that is written to a file or to standard output while it is made.

#include "io/AtomicFile.h"
#include "io/AudioWriter.h"
#include "live/LiveDrive.h"

#include <pacini/foundation/Result.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <thread>

namespace pacini::cli
{

/// Writes 32-bit floats from a thread of its own, until the drive is over.
class LiveFile
{
public:
    /// Starts `path`, whose folder must be there: .wav, or a WAV without lengths on standard output. The drive
    /// outlives this. Errors: those of AudioWriter::create(). [message]
    [[nodiscard]] static Result<std::unique_ptr<LiveFile>> create(const std::filesystem::path& path, Existing existing,
                                                                  live::LiveDrive& drive, double sampleRate);
    LiveFile(const LiveFile&) = delete;
    LiveFile& operator=(const LiveFile&) = delete;
    ~LiveFile();

    /// Whether nothing more can be written. [any]
    [[nodiscard]] bool hasFailed() const noexcept { return failed.load(std::memory_order_acquire); }

    /// Waits until all is written and returns the frames. Call when the drive has ended. A recording that had to end
    /// before the disk is full is kept, see early(). Errors: io, as in AudioWriter. [message]
    [[nodiscard]] Result<std::uint64_t> finish();

    /// After finish(): why a recording that is kept ended early, if it did. [message]
    [[nodiscard]] const Result<void>& early() const noexcept { return result; }

private:
    explicit LiveFile(live::LiveDrive& drive) : source(drive) {}
    void work();
    [[nodiscard]] Result<void> write(std::span<const float> samples);

    /// Whether the disk has room for these; looks once a megabyte.
    [[nodiscard]] bool hasRoom(std::size_t samples);

    live::LiveDrive& source;
    std::optional<AudioWriter> writer; ///< none: standard output
    std::filesystem::path folder;
    std::size_t sinceLook = 0;
    std::uint64_t frames = 0;
    Result<void> result;
    std::atomic<bool> failed{false};
    std::atomic<bool> dropped{false};
    std::thread thread;
};

} // namespace pacini::cli
