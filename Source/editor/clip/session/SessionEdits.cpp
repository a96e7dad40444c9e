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
    return mayEdit(gesture) &&
           change([&](Document& document) { return document.edit(active, name, std::move(operation), gesture); });
}

bool Session::setClip(const char* name, Clip edited, Gesture gesture)
{
    return setEdited(name, {std::move(edited), selectionNow}, gesture);
}

bool Session::setEdited(const char* name, EditedClip edited, Gesture gesture)
{
    const bool done = mayEdit(gesture) && take(open->setClip(active, name, std::move(edited.clip), gesture));
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
    const bool all = showsAll();
    setComparing(false);
    if (!(open.get()->*through)())
        return;
    if (before != profileName())
        player.setProfile(profile());
    follow();
    loadSound();
    keepView(all);
    changed(project | content | selection | playback | sound);
}

bool Session::change(const std::function<Result<void>(Document&)>& step)
{
    const bool all = showsAll();
    if (!take(step(*open)))
        return false;
    follow();
    keepView(all);
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
        clipboard = copyOf(*now, scope());
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

void Session::paste(const std::optional<Lane>& into)
{
    const auto now = clip();
    if (!now || !clipboard)
        return;
    auto pasted = pasteInto(*now, *clipboard, playhead(), into);
    if (!pasted)
        return report("Not pasted", pasted.error());
    if (rangeNow)
        pasted->selection = {}; // what follows is for the time range
    const auto leftOut = static_cast<int>(pasted->leftOut);
    if (setEdited("Paste", {std::move(pasted->clip), std::move(pasted->selection)}) && leftOut > 0 && onError)
        onError("Pasted with gaps",
                "This clip has no band near " + juce::String(leftOut) + " of the lanes that were copied.");
}

bool Session::canSplit() const
{
    const auto now = clip();
    return now && playhead() > 0.0 && playhead() < now->duration;
}

void Session::split()
{
    const auto right = open->splitClipAt(active, playhead(), "Split");
    if (!right)
        return report("Not split", right.error());
    player.stop();
    show(active);
}

int Session::nextClipId() const
{
    const auto& items = open->project().clips;
    for (std::size_t i = 0; i + 1 < items.size(); ++i)
        if (items[i]->id == active)
            return items[i + 1]->id;
    return 0;
}

void Session::joinNext()
{
    const bool all = showsAll();
    if (!mayEdit(0) || !take(open->joinClip(active, nextClipId(), "Join")))
        return;
    follow();
    keepView(all);
    changed(project | content | selection);
}

} // namespace pacini::editor
