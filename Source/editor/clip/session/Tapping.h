// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Events that are tapped while a clip plays: what is tapped in one pass is one step.

#include "editor/clip/session/Transport.h"

#include <pacini/clip/Clip.h>

#include <vector>

namespace pacini::editor
{

/// What an event is that is added by hand.
inline constexpr Transient usualEvent{0.0, 0.7, 0.5};

/// [message]
class Tapping
{
public:
    Tapping(EditorModel& project, Transport& playing);

    /// Adds an event where the clip is heard and felt now, or at the playhead while nothing plays.
    void tap(double amplitude = usualEvent.amplitude);

private:
    EditorModel& model;
    Transport& transport;
    Gesture pass = 0; ///< 0: none
    int clip = 0;     ///< that the pass is of
    std::vector<Transient> tapped;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
