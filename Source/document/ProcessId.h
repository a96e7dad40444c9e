#pragma once

// Process ids: this process's, and whether another process still runs.

#include <cstdint>

namespace pacini
{

/// The id of this process.
[[nodiscard]] std::int64_t processId() noexcept;

/// Whether a process of that id runs on this machine.
[[nodiscard]] bool isRunning(std::int64_t process) noexcept;

} // namespace pacini
