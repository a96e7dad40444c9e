// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Snapping of a dragged point, transient, marker or edge.

#include "editor/clip/session/Transport.h"
#include "editor/clip/session/ViewState.h"

#include <cstddef>
#include <optional>

namespace pacini::editor
{

inline constexpr double snapReach = 8.0; ///< pixels

/// Targets of snapping during a drag: moving items must not snap to themselves.
struct Snapping
{
    const Clip* clip = nullptr;        ///< where transients and markers are looked for; null: the one that is shown
    const Selection* moving = nullptr; ///< of that clip
    std::optional<std::size_t> marker = {}; ///< that moves
    bool playhead = true;                   ///< whether it counts where it is switched on
};

/// The time that is meant by `time`, by what is switched on in `view`.
[[nodiscard]] double snapTime(const EditorModel& model, const ViewState& view, const Transport& transport, double time,
                              const Snapping& snapping = {});

} // namespace pacini::editor
