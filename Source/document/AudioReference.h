#pragma once

// References to the sounds that a project is made from: recognised when they have moved, embedded on request.

#include "io/StoredAudio.h"

#include <pacini/foundation/Result.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

/// A sound file. In memory its path is absolute; a project file writes it relative to itself where it can.
struct AudioReference
{
    int id = 0; ///< of this sound in its project, from 1
    std::filesystem::path path;
    std::uint64_t bytes = 0;
    double duration = 0.0;   ///< s
    double sampleRate = 0.0; ///< Hz
    int channels = 0;
    /// Of the file: 16 hexadecimal digits of FNV-1a with 64 bits (Fowler, Noll, Vo, 1991). Tells files apart that are
    /// not made to collide, which is enough to find a sound again.
    std::string hash;
    std::shared_ptr<const std::string> embedded; ///< the whole file, or null

    /// Same file and same content; of an embedded copy only whether there is one.
    bool operator==(const AudioReference& other) const
    {
        return id == other.id && path == other.path && bytes == other.bytes && duration == other.duration &&
               sampleRate == other.sampleRate && channels == other.channels && hash == other.hash &&
               (embedded != nullptr) == (other.embedded != nullptr);
    }
};

/// Whether `path` is the file of a sound: in its place, or elsewhere with its content.
[[nodiscard]] bool isFileOf(const AudioReference& reference, const std::filesystem::path& path);

/// Reads a sound once; returns its description together with the samples. Errors: those of readAudio().
struct DescribedAudio
{
    AudioReference reference;
    StoredAudio audio;
};
[[nodiscard]] Result<DescribedAudio> describeAudio(const std::filesystem::path& path, bool embed = false);

/// Current place of a sound.
struct LocatedAudio
{
    std::filesystem::path path;
    bool moved = false;   ///< found elsewhere, by its name and content
    bool changed = false; ///< still in its place, but with another content: analyse it anew
};

/// Looks for a sound: in its place, else under its name in `folders` (the project's own first) and the folders directly
/// inside them, where size and hash must agree. Error io when it is nowhere; its message names the file.
[[nodiscard]] Result<LocatedAudio> locateAudio(const AudioReference& reference,
                                               std::span<const std::filesystem::path> folders);

/// Those of `missing` that `chosen` is, or that lie under their own name in its folder or directly inside: by their
/// content, with their new place. [worker]
[[nodiscard]] std::vector<AudioReference> foundBy(const std::filesystem::path& chosen,
                                                  std::span<const AudioReference> missing);

/// The samples of a sound: the embedded copy where there is one, else the file as locateAudio() finds it. An embedded
/// copy passes through a temporary file in `temporaryFolder`.
[[nodiscard]] Result<StoredAudio> loadAudio(const AudioReference& reference,
                                            std::span<const std::filesystem::path> folders,
                                            const std::filesystem::path& temporaryFolder);

} // namespace pacini
