// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/Session.h"

namespace pacini::editor
{

void Session::setPreview(std::shared_ptr<const Clip> wanted)
{
    if (!wanted && !preview)
        return;
    if (!preview)
    {
        setComparing(false);
        beforePreview = selectionNow;
        axisBeforePreview = axisNow;
    }
    const bool all = showsAll();
    preview = std::move(wanted);
    selectionNow = beforePreview;
    if (preview)
    {
        selectionNow = withinClip(selectionNow, *preview);
        keepView(all);
    }
    else
        setAxis(axisBeforePreview);
    sendPlayback();
    changed(content | selection);
}

void Session::keepVersion()
{
    const auto shown = item();
    if (!shown || preview)
        return;
    versions[active] = clip();
    setComparing(false);
    sendPlayback();
    changed(playback);
}

std::shared_ptr<const Clip> Session::keptVersion() const
{
    const auto found = versions.find(active);
    return found != versions.end() ? found->second : nullptr;
}

void Session::setComparing(bool wanted)
{
    if (wanted == comparing || preview || (wanted && !keptVersion()))
        return;
    const bool all = showsAll();
    comparing = wanted;
    selectionNow = withinClip(selectionNow, *clip());
    keepView(all);
    sendPlayback();
    changed(content | selection | playback);
}

void Session::takeKeptVersion()
{
    const auto kept = keptVersion();
    setComparing(false);
    if (kept)
        setEdited("Take version A", {*kept, {}});
}

/// The kept version is only looked at. Of gestures, which come many times a second, nothing is said.
bool Session::mayEdit(Gesture gesture)
{
    if (comparing && gesture == 0 && onError)
        onError("This is version A", "It is kept to compare with. Go back to the clip to edit it, or take version A.");
    return !comparing;
}

} // namespace pacini::editor
