// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/Tapping.h"

#include "editor/clip/session/ClipSteps.h"

#include <pacini/clip/edits/TransientEdits.h>

#include <algorithm>

namespace pacini::editor
{

Tapping::Tapping(EditorModel& project, Transport& playing) : model(project), transport(playing)
{
    subscriptions.on({&transport.changed, &model.shownChanged}, [this] { pass = transport.isPlaying() ? pass : 0; });
}

void Tapping::tap(double amplitude)
{
    if (!model.clip())
        return;
    if (pass == 0 || clip != model.activeId() || !transport.isPlaying())
    {
        pass = model.beginGesture();
        clip = model.activeId();
        tapped.clear();
    }
    const auto start = gestureStart(model, pass);
    if (!start)
        return;
    tapped.push_back({std::clamp(transport.playhead(), 0.0, start->duration), amplitude, usualEvent.sharpness});
    Clip edited = *start;
    for (const Transient& event : tapped)
        edited = addTransient(std::move(edited), event);
    setClip(model, "Tap events", std::move(edited), pass);
}

} // namespace pacini::editor
