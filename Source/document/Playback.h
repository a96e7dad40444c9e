#pragma once

// Playback settings of the preview: what is heard, loop, takes, solo and mute, as plain data.

#include <pacini/clip/edits/Audition.h>

#include <memory>
#include <optional>

namespace pacini
{

/// One of two takes that are compared: the clip before and after a change, two encodings, two clips.
enum class Take
{
    a,
    b
};

struct Playback
{
    bool source = false;           ///< the sound itself
    bool haptic = true;            ///< the drive signal
    std::optional<TimeRange> loop; ///< s of the clip; at least 5 ms, else it is no loop
    Take take = Take::a;
    std::shared_ptr<const Clip> a; ///< the clip that is edited
    std::shared_ptr<const Clip> b; ///< what it is compared with; null: the same
    Audition audition;             ///< bands that are soloed and muted

    [[nodiscard]] const std::shared_ptr<const Clip>& heard() const noexcept { return take == Take::b && b ? b : a; }
};

} // namespace pacini
