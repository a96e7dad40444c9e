// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/Session.h"

#include <pacini/clip/edits/TimeEdits.h>

namespace pacini::editor
{

std::shared_ptr<const Clip> Session::gestureStart(Gesture gesture) const
{
    return open->gestureStart(active, gesture);
}

bool Session::edit(const char* name, EditOperation operation, Gesture gesture)
{
    return change([&](Document& document) { return document.edit(active, name, std::move(operation), gesture); });
}

bool Session::setClip(const char* name, Clip edited, Gesture gesture)
{
    return setEdited(name, {std::move(edited), selectionNow}, gesture);
}

bool Session::setEdited(const char* name, EditedClip edited, Gesture gesture)
{
    const bool done = take(open->setClip(active, name, std::move(edited.clip), gesture));
    if (done)
    {
        selectionNow = std::move(edited.selection);
        follow();
        changed(project | content | selection);
    }
    return done;
}

void Session::undo()
{
    step(&Document::undo);
}

void Session::redo()
{
    step(&Document::redo);
}

void Session::step(bool (Document::*through)())
{
    const auto before = profileName();
    if (!(open.get()->*through)())
        return;
    if (before != profileName())
        player.setProfile(profile());
    follow();
    loadSound();
    setAxis(axisNow);
    changed(project | content | selection | playback | sound);
}

bool Session::change(const std::function<Result<void>(Document&)>& step)
{
    if (!take(step(*open)))
        return false;
    follow();
    setAxis(axisNow);
    changed(project | content | selection);
    return true;
}

void Session::duplicate()
{
    const auto id = open->duplicateClip(active, "Duplicate clip");
    if (!id)
        return report("Not duplicated", id.error());
    show(*id);
}

void Session::removeClip()
{
    if (!take(open->removeClip(active, "Remove clip")))
        return;
    active = 0;
    show(isEmpty() ? 0 : open->project().clips.front()->id);
}

void Session::deleteSelection()
{
    if (const auto now = clip(); now && !pacini::isEmpty(selectionNow))
        setEdited("Delete points", {deleteSelected(*now, selectionNow), {}});
}

EditScope Session::scope() const
{
    const auto now = clip();
    return now ? scopeOf(selectionNow, *now, rangeNow) : EditScope{};
}

void Session::copy()
{
    if (const auto now = clip())
        clipboard = copyFragment(*now, scope());
    changed(selection); // paste may have become possible
}

void Session::cut()
{
    copy();
    if (!pacini::isEmpty(selectionNow))
        deleteSelection();
    else if (rangeNow)
    {
        const auto cutRange = *rangeNow;
        rangeNow.reset();
        edit("Cut", CutEdit{cutRange});
        changed(range);
    }
}

void Session::paste()
{
    const auto now = clip();
    if (!now || !clipboard)
        return;
    auto pasted = pasteFragment(*now, *clipboard, playhead());
    if (!pasted)
        return report("Not pasted", pasted.error());
    setEdited("Paste", {std::move(pasted).value(), {}});
}

} // namespace pacini::editor
