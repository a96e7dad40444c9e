// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Selected part of the project's scene, and edits of the scene.

#include "document/ProjectEdits.h"
#include "document/ProjectScene.h"
#include "editor/clip/session/EditorModel.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

namespace pacini::editor
{

/// [message]
class SceneSelection
{
public:
    explicit SceneSelection(EditorModel& project) : model(project) {}

    Signal changed; ///< which part is selected

    [[nodiscard]] const ProjectScene& scene() const { return model.document().project().scene; }
    /// Index of the part; none where there is none, or no longer.
    [[nodiscard]] std::optional<std::size_t> selected() const
    {
        return now && *now < scene().parts.size() ? now : std::nullopt;
    }
    [[nodiscard]] const ScenePart* part() const
    {
        const auto index = selected();
        return index ? &scene().parts[*index] : nullptr;
    }
    void select(std::optional<std::size_t> wanted)
    {
        now = wanted;
        changed.emit();
    }

    /// Lets `change` alter a copy of the scene; one step, or one with all others of the gesture.
    template <typename Change>
    bool edit(const std::string& name, Change change, Gesture gesture = 0)
    {
        ProjectScene wanted = scene();
        change(wanted);
        if (wanted == scene())
            return true;
        return model.commit(name, withScene(model.document().gestureStart(gesture), std::move(wanted)), gesture);
    }
    /// Of the selected part, if there is one.
    template <typename Change>
    bool editPart(const std::string& name, Change change, Gesture gesture = 0)
    {
        const auto index = selected();
        return index && edit(
                            name, [&](ProjectScene& wanted) { change(wanted.parts[*index]); }, gesture);
    }
    [[nodiscard]] Gesture beginGesture() { return model.beginGesture(); }

    /// Puts a clip at a time on the first track that is free there, and selects it.
    void add(int clip, double start)
    {
        const Project& project = model.document().project();
        const auto item = project.find(clip);
        if (!item)
            return;
        ScenePart added;
        added.clip = clip;
        added.play.start = std::max(0.0, start);
        const auto overlaps = [&](const ScenePart& one)
        {
            return one.track == added.track && one.play.start < added.play.start + item->clip->duration &&
                   added.play.start < one.play.start + lengthOf(project, one);
        };
        while (std::any_of(project.scene.parts.begin(), project.scene.parts.end(), overlaps))
            ++added.track;
        if (edit("Add to scene", [&](ProjectScene& wanted) { wanted.parts.push_back(added); }))
            select(scene().parts.size() - 1);
    }
    void removeSelected()
    {
        const auto index = selected();
        if (!index)
            return;
        edit("Remove from scene", [&](ProjectScene& wanted)
             { wanted.parts.erase(wanted.parts.begin() + static_cast<std::ptrdiff_t>(*index)); });
        select(std::nullopt);
    }

private:
    EditorModel& model;
    std::optional<std::size_t> now;
};

} // namespace pacini::editor
