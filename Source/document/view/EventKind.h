#pragma once

// Kinds of events, by how sharp they feel: thuds, knocks and clicks.

#include "document/SelectionEdits.h"

#include <pacini/clip/Clip.h>

#include <cstddef>

namespace pacini
{

enum class EventKind
{
    thud, ///< dull
    knock,
    click ///< crisp
};

[[nodiscard]] inline EventKind kindOf(const Transient& event) noexcept
{
    return event.sharpness < 1.0 / 3.0   ? EventKind::thud
           : event.sharpness < 2.0 / 3.0 ? EventKind::knock
                                         : EventKind::click;
}

/// All events of the kinds that are among those selected.
[[nodiscard]] inline Selection selectKinds(const Clip& clip, const Selection& selected)
{
    bool wanted[3] = {};
    for (const std::size_t i : selected.transients)
        if (i < clip.transients.size())
            wanted[static_cast<std::size_t>(kindOf(clip.transients[i]))] = true;
    Selection all;
    for (std::size_t i = 0; i < clip.transients.size(); ++i)
        if (wanted[static_cast<std::size_t>(kindOf(clip.transients[i]))])
            all.transients.push_back(i);
    return all;
}

} // namespace pacini
