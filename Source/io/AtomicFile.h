#pragma once

// Atomic writing of a file, completely or not at all: into a temporary beside the target, renamed at the end.

#include "io/FileHandle.h"
#include "io/TemporaryFiles.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace pacini
{

/// Treatment of a file that is at the target already.
enum class Existing
{
    replace,
    keep, ///< even one that appears while ours is written: then commit() fails
};

/// A file being written. Until commit() the target is untouched; an AtomicFile that dies before commit() removes its
/// temporary. A killed program leaves the temporary behind, named `.NAME.pacini-XXXXXXXX.tmp`, unless
/// removeTemporariesOnSignals() was called and the signal can be caught; the next AtomicFile in that folder removes it.
///
/// There is no fsync: after a power cut the target may be empty, but a running system never shows it half-written.
/// A target that exists and is neither file nor folder (/dev/null, a pipe) cannot be replaced: commit() copies into it,
/// and waits for a pipe's reader. So it is with `-` and /dev/stdout, standard output. Links are followed; the
/// permissions of an existing target are kept.
class AtomicFile
{
public:
    /// Creates the temporary for `target`. Errors (code io or diskFull): no such folder, no permission, the target is a
    /// folder or read-only, or it exists and must be kept.
    [[nodiscard]] static Result<AtomicFile> create(const std::filesystem::path& target,
                                                   Existing existing = Existing::replace);

    AtomicFile(AtomicFile&&) noexcept = default;
    AtomicFile& operator=(AtomicFile&&) = delete;
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    /// Appends at the current place. Returns false after the first failure, which commit() reports.
    bool write(std::span<const std::byte> bytes) noexcept;

    /// The first failure so far, if any.
    [[nodiscard]] std::optional<Error> failure() const;

    /// Reads at the current place, after a seek(); how many bytes came.
    std::size_t read(std::span<std::byte> bytes) noexcept;

    /// Seeks, for containers that write their header last; offsets from the start in bytes, -1 if unknown.
    bool seek(std::int64_t offset, int origin) noexcept;
    [[nodiscard]] std::int64_t tell() const noexcept;
    [[nodiscard]] std::int64_t size() noexcept;

    /// Flushes, closes and renames. On any failure since create() the temporary is removed and the first failure
    /// returned (code io or diskFull). Call once.
    [[nodiscard]] Result<void> commit();

private:
    AtomicFile(FileHandle stream, std::filesystem::path temporaryPath, std::filesystem::path targetPath,
               TemporaryEntry entry, Existing existingTarget);
    void removeTemporary() noexcept;
    void putInPlace();
    void copyToTarget();

    FileHandle file;
    std::filesystem::path temporary; ///< empty when the file has no name and is copied to the target
    std::filesystem::path target;
    TemporaryEntry listed;
    Existing existing;
    int firstErrno = 0;
};

/// Writes `bytes` to `path` as AtomicFile does and returns how many. Errors as in AtomicFile.
[[nodiscard]] Result<std::size_t> writeFileAtomically(const std::filesystem::path& path,
                                                      std::span<const std::byte> bytes,
                                                      Existing existing = Existing::replace);
[[nodiscard]] Result<std::size_t> writeFileAtomically(const std::filesystem::path& path, std::string_view text,
                                                      Existing existing = Existing::replace);

/// Whether `path` means standard output: `-` or a name that the system has for it.
[[nodiscard]] bool isStandardOutput(const std::filesystem::path& path);

/// Whether `path` is written as a stream: standard output, a pipe or a device. A stream has no content to lose or to
/// read.
[[nodiscard]] bool isStream(const std::filesystem::path& path);

} // namespace pacini
