// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/ClipSelection.h"

#include "editor/Translation.h"
#include "editor/clip/session/ClipSteps.h"
#include "editor/clip/session/StepText.h"

#include <utility>

namespace pacini::editor
{

ClipSelection::ClipSelection(EditorModel& project) : model(project)
{
    subscriptions.on({&model.shownChanged}, [this] { reset(); });
    subscriptions.on({&model.contentChanged}, [this] { follow(); });
}

void ClipSelection::put(Selection wanted, std::optional<TimeRange> range)
{
    const bool others = wanted != selectionNow;
    const bool otherRange = range != rangeNow;
    selectionNow = std::move(wanted);
    rangeNow = range;
    if (others)
        changed.emit();
    if (otherRange)
        rangeChanged.emit();
}

void ClipSelection::reset()
{
    beforePreview.reset();
    put({}, {});
}

void ClipSelection::follow()
{
    Selection wanted = edited ? *std::exchange(edited, std::nullopt) : selectionNow;
    if (model.isPreviewing() && !beforePreview)
        beforePreview = wanted;
    else if (beforePreview)
        wanted = *beforePreview;
    if (!model.isPreviewing())
        beforePreview.reset();
    const auto clip = model.clip();
    auto range = rangeNow;
    if (range && clip)
        range = withinClip(*range, clip->duration);
    if (range && range->to <= range->from)
        range.reset();
    put(clip ? withinClip(wanted, *clip) : Selection{}, range);
}

void ClipSelection::select(Selection wanted)
{
    put(std::move(wanted), rangeNow);
}

void ClipSelection::setTimeRange(std::optional<TimeRange> wanted)
{
    if (const auto clip = model.clip(); wanted && clip)
        wanted = withinClip(*wanted, clip->duration);
    if (wanted && wanted->to <= wanted->from)
        wanted.reset();
    put(selectionNow, wanted);
}

EditScope ClipSelection::scope() const
{
    const auto clip = model.clip();
    return clip ? scopeOf(selectionNow, *clip, rangeNow) : EditScope{};
}

bool ClipSelection::setEdited(std::string name, EditedClip wanted, Gesture gesture)
{
    edited = std::move(wanted.selection);
    const bool done = setClip(model, std::move(name), std::move(wanted.clip), gesture);
    edited.reset();
    return done;
}

bool ClipSelection::setEdited(std::string name, EditOperation first, EditedClip wanted)
{
    edited = std::move(wanted.selection);
    const bool done = setClip(model, std::move(name), std::move(first), std::move(wanted.clip));
    edited.reset();
    return done;
}

void ClipSelection::deleteSelection()
{
    if (const auto clip = model.clip(); clip && !isEmpty(selectionNow))
        setEdited(stepName(SelectionStep::remove, selectionNow), {deleteSelected(*clip, selectionNow), {}});
}

void ClipSelection::copy()
{
    if (const auto clip = model.clip())
        clipboard = copyOf(*clip, scope());
    changed.emit(); // paste may have become possible
}

void ClipSelection::cut()
{
    copy();
    if (!isEmpty(selectionNow))
        deleteSelection();
    else if (rangeNow)
    {
        const auto cutRange = *rangeNow;
        setTimeRange(std::nullopt);
        editClip(model, "Cut", CutEdit{cutRange});
    }
}

void ClipSelection::paste(double time, const std::optional<Lane>& into)
{
    const auto clip = model.clip();
    if (!clip || !clipboard)
        return;
    auto pasted = pasteInto(*clip, *clipboard, time, into);
    if (!pasted)
        return model.report("Not pasted", pasted.error());
    if (rangeNow)
        pasted->selection = {}; // what follows is for the time range
    const auto leftOut = static_cast<int>(pasted->leftOut);
    const double longer = pasted->clip.duration - clip->duration;
    EditedClip result{std::move(pasted->clip), std::move(pasted->selection)};
    const bool done = pasted->extension ? setEdited("Paste", *pasted->extension, std::move(result))
                                        : setEdited("Paste", std::move(result));
    if (done && pasted->extension && model.onNotice)
        model.onNotice(tr("Pasted beyond the end: the clip is {0} s longer", {numberText(longer, 2)}));
    if (done && leftOut > 0 && model.onError)
        model.onError("Partly pasted",
                      tr("This clip has no band near {0} of the copied lanes.", {juce::String(leftOut)}));
}

} // namespace pacini::editor
