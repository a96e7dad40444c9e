#pragma once

// The temporaries of files being written, so that a program that is asked to end leaves none behind.

#include <atomic>
#include <filesystem>

namespace pacini
{

/// Keeps one temporary on the list of what removeTemporariesOnSignals() removes, as long as it lives.
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

/// From now on SIGINT, SIGTERM and SIGHUP first remove the listed files, then end the program as they would have. A
/// signal that the program was started to ignore stays ignored. Does nothing on Windows, where an open file cannot be
/// removed. Call once, from the main function.
void removeTemporariesOnSignals() noexcept;

} // namespace pacini
