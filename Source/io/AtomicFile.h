#pragma once

// Writes a file that is either complete or not there: into a temporary beside the target, renamed when it is done.

#include "io/FileHandle.h"
#include "io/TemporaryFiles.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace pacini
{

/// A file being written. Until commit() the target is untouched; an AtomicFile that dies before commit() removes its
/// temporary. A killed program leaves the temporary behind, named `.NAME.pacini-XXXX.tmp`, unless
/// removeTemporariesOnSignals() was called and the signal can be caught.
///
/// There is no fsync: after a power cut the target may be empty, but a running system never shows it half-written.
/// A target that exists and is neither file nor folder (/dev/null, a pipe) is written directly, since it cannot be
/// replaced. Links are followed; the permissions of an existing target are kept.
class AtomicFile
{
public:
    /// Creates the temporary for `target`. Errors (code io): no such folder, no right to write, the target is a folder
    /// or is marked read-only.
    [[nodiscard]] static Result<AtomicFile> create(const std::filesystem::path& target);

    AtomicFile(AtomicFile&&) noexcept = default;
    AtomicFile& operator=(AtomicFile&&) = delete;
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    /// Appends at the current place. Returns false after the first failure, which commit() reports.
    bool write(std::span<const std::byte> bytes) noexcept;

    /// The first failure so far, if any.
    [[nodiscard]] std::optional<Error> failure() const;

    /// What a container that writes its header last needs; offsets from the start in bytes, -1 when it cannot be told.
    bool seek(std::int64_t offset, int origin) noexcept;
    [[nodiscard]] std::int64_t tell() const noexcept;
    [[nodiscard]] std::int64_t size() noexcept;

    /// Flushes, closes and renames. On any failure since create() the temporary is removed and the first failure
    /// returned (code io). Call once.
    [[nodiscard]] Result<void> commit();

private:
    AtomicFile(FileHandle stream, std::filesystem::path temporaryPath, std::filesystem::path targetPath,
               TemporaryEntry entry);
    void removeTemporary() noexcept;

    FileHandle file;
    std::filesystem::path temporary; ///< empty when the target is written directly
    std::filesystem::path target;
    TemporaryEntry listed;
    int firstErrno = 0;
};

/// Writes `bytes` to `path` as AtomicFile does and returns how many. Errors as in AtomicFile.
[[nodiscard]] Result<std::size_t> writeFileAtomically(const std::filesystem::path& path,
                                                      std::span<const std::byte> bytes);
[[nodiscard]] Result<std::size_t> writeFileAtomically(const std::filesystem::path& path, std::string_view text);

} // namespace pacini
