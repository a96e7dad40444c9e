#pragma once

// Snapshot of a clip in the undo history, which shares memory with other versions.

#include "document/ChunkedList.h"

#include <pacini/clip/edits/Lane.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace pacini
{

/// A clip in chunks that versions of it share.
class ClipSnapshot
{
public:
    ClipSnapshot() = default;

    /// Keeps `clip`, sharing with `previous` whatever is equal. O(points).
    explicit ClipSnapshot(const Clip& clip, const ClipSnapshot* previous = nullptr)
    {
        Clip bare = headOf(clip);
        head = previous != nullptr && previous->head != nullptr && *previous->head == bare
                   ? previous->head
                   : std::make_shared<const Clip>(std::move(bare));
        const auto lanes = lanesOf(clip);
        for (std::size_t i = 0; i < lanes.size(); ++i)
            curves.push_back(ChunkedList<Breakpoint>::of(
                *curveOf(clip, lanes[i]),
                previous != nullptr && i < previous->curves.size() ? previous->curves[i] : ChunkedList<Breakpoint>{}));
        transients = ChunkedList<Transient>::of(clip.transients,
                                                previous != nullptr ? previous->transients : ChunkedList<Transient>{});
    }

    /// The clip again, bit for bit.
    [[nodiscard]] Clip restore() const
    {
        Clip clip = *head;
        const auto lanes = lanesOf(clip);
        for (std::size_t i = 0; i < lanes.size(); ++i)
            *curveOf(clip, lanes[i]) = curves[i].whole();
        clip.transients = transients.whole();
        return clip;
    }

    /// What keeping this version beside `other` costs, in bytes; names and markers not counted.
    [[nodiscard]] std::size_t bytesBeside(const ClipSnapshot& other) const
    {
        std::size_t bytes = transients.bytesBeside(other.transients);
        for (std::size_t i = 0; i < curves.size(); ++i)
            bytes += curves[i].bytesBeside(i < other.curves.size() ? other.curves[i] : ChunkedList<Breakpoint>{});
        return bytes;
    }

private:
    /// All but the curves and transients.
    static Clip headOf(const Clip& clip)
    {
        Clip bare;
        bare.name = clip.name;
        bare.duration = clip.duration;
        bare.source = clip.source;
        bare.encoder = clip.encoder;
        bare.markers = clip.markers;
        for (const Band& band : clip.bands)
            bare.bands.push_back(
                {band.lowFrequency, band.centreFrequency, band.highFrequency, band.priority, {}, {}, band.phase});
        for (const NoiseBand& band : clip.noise)
            bare.noise.push_back({band.lowFrequency, band.highFrequency, {}});
        return bare;
    }

    std::shared_ptr<const Clip> head;
    std::vector<ChunkedList<Breakpoint>> curves; ///< as lanesOf() names them
    ChunkedList<Transient> transients;
};

} // namespace pacini
