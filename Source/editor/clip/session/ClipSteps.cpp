// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/ClipSteps.h"

#include "document/ProjectEdits.h"

#include <utility>

namespace pacini::editor
{

std::shared_ptr<const Clip> gestureStart(const EditorModel& model, Gesture gesture)
{
    const auto item = model.document().gestureStart(gesture).find(model.activeId());
    return item ? item->clip : nullptr;
}

bool editClip(EditorModel& model, std::string name, EditOperation operation, Gesture gesture)
{
    return model.mayEdit(gesture) &&
           model.commit(std::move(name),
                        withEdit(model.document().gestureStart(gesture), model.activeId(), std::move(operation)),
                        gesture);
}

bool setClip(EditorModel& model, std::string name, Clip edited, Gesture gesture)
{
    return model.mayEdit(gesture) &&
           model.commit(std::move(name),
                        withClip(model.document().gestureStart(gesture), model.activeId(), std::move(edited)), gesture);
}

bool setClip(EditorModel& model, std::string name, EditOperation first, Clip edited)
{
    return model.mayEdit() && model.commit(std::move(name), withClip(model.document().project(), model.activeId(),
                                                                     std::move(edited), std::move(first)));
}

void takeVersion(EditorModel& model)
{
    const auto kept = model.keptVersion();
    if (!kept)
        return;
    model.setComparing(false);
    model.commit("Revert to version A", withRestored(model.document().project(), *kept));
}

void duplicateShown(EditorModel& model)
{
    const int added = model.document().steps().newIds().clip;
    auto next = withDuplicate(model.document().project(), model.activeId(), added);
    if (!next)
        return model.report("Not duplicated", next.error());
    model.commit("Duplicate clip", std::move(next));
    model.show(added);
}

void removeClips(EditorModel& model, const std::vector<int>& ids)
{
    model.commit(ids.size() > 1 ? "Remove clips" : "Remove clip", withoutClips(model.document().project(), ids));
}

bool splitShown(EditorModel& model, double time)
{
    const int added = model.document().steps().newIds().clip;
    auto next = withSplit(model.document().project(), model.activeId(), time, added);
    if (!next)
    {
        model.report("Not split", next.error());
        return false;
    }
    return model.commit("Split", std::move(next));
}

int nextClipId(const EditorModel& model)
{
    const auto& items = model.document().project().clips;
    for (std::size_t i = 0; i + 1 < items.size(); ++i)
        if (items[i]->id == model.activeId())
            return items[i + 1]->id;
    return 0;
}

void joinNext(EditorModel& model)
{
    if (model.mayEdit())
        model.commit("Join", withJoined(model.document().project(), model.activeId(), nextClipId(model)));
}

} // namespace pacini::editor
