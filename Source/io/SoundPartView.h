#pragma once

// View of one part of a file, with corrected bytes.

#include "io/FileHandle.h"
#include "io/SoundParts.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>

namespace pacini
{

/// One part of a file for libsndfile. It has no file name, so content alone determines the format, and a failing disk
/// can be distinguished from a damaged file.
struct SoundPartView
{
    std::FILE* file = nullptr;
    const SoundPart* part = nullptr;
    std::uint64_t place = 0;
    bool hidesEnd = false; ///< it cannot be gone to

    [[nodiscard]] std::uint64_t size() const noexcept
    {
        return part->head.size() + part->end - std::min(part->begin, part->end);
    }

    bool goTo(std::uint64_t wanted)
    {
        place = wanted;
        const auto behindHead = place - std::min<std::uint64_t>(place, part->head.size());
        return seekStream(file, static_cast<std::int64_t>(part->begin + behindHead), SEEK_SET);
    }

    std::size_t read(std::span<char> bytes)
    {
        const auto fromHead = std::min<std::uint64_t>(
            part->head.size() - std::min<std::uint64_t>(place, part->head.size()), bytes.size());
        if (fromHead > 0)
        {
            part->head.copy(bytes.data(), static_cast<std::size_t>(fromHead), static_cast<std::size_t>(place));
            place += fromHead;
            return static_cast<std::size_t>(fromHead) + read(bytes.subspan(static_cast<std::size_t>(fromHead)));
        }
        if (bytes.empty())
            return 0;
        const auto left = size() - std::min(place, size());
        const auto from = part->begin + place - part->head.size();
        const auto got =
            std::fread(bytes.data(), 1, static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), left)), file);
        place += got;
        for (const BytePatch& patch : part->patches)
        {
            const auto first = std::max(patch.offset, from),
                       last = std::min(patch.offset + patch.bytes.size(), from + got);
            for (auto at = first; at < last; ++at)
                bytes[static_cast<std::size_t>(at - from)] = patch.bytes[static_cast<std::size_t>(at - patch.offset)];
        }
        return got;
    }
};

} // namespace pacini
