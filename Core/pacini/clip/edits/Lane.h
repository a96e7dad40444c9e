#pragma once

// The lanes of a clip: one name for every curve that an editor shows.

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Clamp.h>

#include <cstddef>
#include <vector>

namespace pacini
{

/// Kind of lane.
enum class LaneKind
{
    envelope,
    centroid,
    amplitude, ///< of band `index`
    pitch,     ///< of band `index`
    noise,     ///< amplitude of noise band `index`
};

/// Identifies a curve of a clip.
struct Lane
{
    LaneKind kind = LaneKind::envelope;
    std::size_t index = 0; ///< of the band; 0 for envelope and centroid
    auto operator<=>(const Lane&) const = default;
};

/// A stretch of time in seconds, both ends belong to it.
struct TimeRange
{
    double from = 0.0;
    double to = 0.0;
    bool operator==(const TimeRange&) const = default;
};

/// Lowest and highest value.
struct ValueRange
{
    double low = 0.0;
    double high = 0.0;
    bool operator==(const ValueRange&) const = default;
};

/// Whether a lane's values are Hz; the others are linear amplitudes.
[[nodiscard]] constexpr bool isFrequency(LaneKind kind) noexcept
{
    return kind == LaneKind::centroid || kind == LaneKind::pitch;
}

/// The values that validate(clip) lets a lane have.
[[nodiscard]] constexpr ValueRange laneRange(LaneKind kind) noexcept
{
    if (!isFrequency(kind))
        return {0.0, limits::amplitude};
    return {kind == LaneKind::pitch ? 1e-3 : 0.0, limits::frequency};
}

/// The curve of a lane, or null when the clip has no such band.
[[nodiscard]] inline const Curve* curveOf(const Clip& clip, Lane lane) noexcept
{
    switch (lane.kind)
    {
    case LaneKind::envelope:
        return &clip.envelope;
    case LaneKind::centroid:
        return &clip.centroid;
    case LaneKind::amplitude:
        return lane.index < clip.bands.size() ? &clip.bands[lane.index].amplitude : nullptr;
    case LaneKind::pitch:
        return lane.index < clip.bands.size() ? &clip.bands[lane.index].pitch : nullptr;
    case LaneKind::noise:
        return lane.index < clip.noise.size() ? &clip.noise[lane.index].amplitude : nullptr;
    }
    return nullptr;
}

[[nodiscard]] inline Curve* curveOf(Clip& clip, Lane lane) noexcept
{
    return const_cast<Curve*>(curveOf(static_cast<const Clip&>(clip), lane));
}

/// All lanes of a clip: envelope, centroid, then amplitude and pitch of each band, then the noise bands.
[[nodiscard]] inline std::vector<Lane> lanesOf(const Clip& clip)
{
    std::vector<Lane> lanes = {{LaneKind::envelope, 0}, {LaneKind::centroid, 0}};
    for (std::size_t k = 0; k < clip.bands.size(); ++k)
    {
        lanes.push_back({LaneKind::amplitude, k});
        lanes.push_back({LaneKind::pitch, k});
    }
    for (std::size_t k = 0; k < clip.noise.size(); ++k)
        lanes.push_back({LaneKind::noise, k});
    return lanes;
}

/// `range` put in order and limited to a clip of `duration` seconds; NaN counts as 0.
[[nodiscard]] inline TimeRange withinClip(TimeRange range, double duration) noexcept
{
    const double a = clampTo(range.from, 0.0, duration);
    const double b = clampTo(range.to, 0.0, duration);
    return a <= b ? TimeRange{a, b} : TimeRange{b, a};
}

} // namespace pacini
