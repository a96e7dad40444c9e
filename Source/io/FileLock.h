#pragma once

// Exclusive lock of a file, which ends with the process that holds it.

#include <cstdint>
#include <filesystem>

namespace pacini
{

/// Holds a file until release(), the end of its life, or the end of the process, however that comes: a process that was
/// killed holds nothing, also while its parent has not asked for its exit code. Programs on other computers that share
/// the folder see it where the network file system passes locks on. One thread.
class FileLock
{
public:
    enum class Outcome
    {
        taken,
        heldElsewhere, ///< by another FileLock, of this process or another
        missing,       ///< there is no such file
        unknown        ///< the file system has no locks, or no right to open the file
    };

    enum class IfMissing
    {
        create,
        leave
    };

    FileLock() noexcept = default;
    ~FileLock() { release(); }
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

    /// Tries to lock `file`, without waiting. Releases an earlier lock.
    [[nodiscard]] Outcome take(const std::filesystem::path& file, IfMissing ifMissing);

    void release() noexcept;

    [[nodiscard]] bool isHeld() const noexcept { return handle != none; }

private:
    static constexpr std::intptr_t none = -1;
    std::intptr_t handle = none; ///< a descriptor, on Windows a HANDLE
};

} // namespace pacini
