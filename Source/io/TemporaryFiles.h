#pragma once

// Clean-up of temporary files: removes those of this program when it is asked to end, and those of killed programs.

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <string>

namespace pacini
{

/// Registers a temporary file for removeTemporariesOnSignals() during its lifetime.
class TemporaryEntry
{
public:
    TemporaryEntry() noexcept = default;

    /// Lists `temporary`. With more than 512 of them at a time the rest stays unlisted.
    explicit TemporaryEntry(const std::filesystem::path& temporary);

    TemporaryEntry(TemporaryEntry&& other) noexcept;
    TemporaryEntry& operator=(TemporaryEntry&&) = delete;
    TemporaryEntry(const TemporaryEntry&) = delete;
    TemporaryEntry& operator=(const TemporaryEntry&) = delete;
    ~TemporaryEntry();

private:
    using Name = std::atomic<const std::filesystem::path::value_type*>;
    Name* place = nullptr;
};

/// Returns the end of temporary names: `.pacini-XXXXXXXX.tmp`, from this computer's name and `number`.
[[nodiscard]] std::string temporaryEnding(unsigned number);

/// Marks an open temporary as in use until it is closed or the process ends, however that happens. False when it has
/// been removed already.
[[nodiscard]] bool keepTemporary(std::FILE* temporary) noexcept;

/// Keeps the mark of a temporary during its lifetime, also between closing the stream and renaming, so that a search
/// for stale temporaries does not take it for one. On Windows, where open files cannot be renamed, it ends the mark.
class TemporaryMark
{
public:
    explicit TemporaryMark(std::FILE* temporary) noexcept;
    TemporaryMark(const TemporaryMark&) = delete;
    TemporaryMark& operator=(const TemporaryMark&) = delete;
    ~TemporaryMark();

private:
    int file = -1; ///< of the same open file
};

/// Removes the temporaries in `folder` (empty: the current one) that no process keeps. One that another computer made,
/// whose marks may not be seen here, must also be a day old. Each folder is looked at once in the life of a process.
void removeStaleTemporaries(const std::filesystem::path& folder);

/// Installs handlers for SIGINT, SIGTERM and SIGHUP that first remove the listed files, then end the program as usual.
/// A signal that the program was started to ignore stays ignored, and further signals wait until all files are removed.
/// Does nothing on Windows, which removes marked files when the program ends. Call once, from the main function.
void removeTemporariesOnSignals() noexcept;

} // namespace pacini
