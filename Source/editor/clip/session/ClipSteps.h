// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Steps of the clip that is shown: edits, and the list of clips around it. What fails is told and changes nothing.

#include "editor/clip/session/EditorModel.h"

#include <memory>
#include <string>
#include <vector>

namespace pacini::editor
{

/// The clip that edits of a gesture start from; null: none is shown.
[[nodiscard]] std::shared_ptr<const Clip> gestureStart(const EditorModel& model, Gesture gesture);

/// See withEdit() and withClip().
bool editClip(EditorModel& model, std::string name, EditOperation operation, Gesture gesture = 0);
bool setClip(EditorModel& model, std::string name, Clip edited, Gesture gesture = 0);
bool setClip(EditorModel& model, std::string name, EditOperation first, Clip edited);

/// The clip becomes the kept version, with the settings of its analysis.
void takeVersion(EditorModel& model);

void duplicateShown(EditorModel& model);
/// Where the shown clip is among them, the first that is left is shown.
void removeClips(EditorModel& model, const std::vector<int>& ids);
/// Two clips of one.
bool splitShown(EditorModel& model, double time);
/// The next clip of the project is put behind this one.
void joinNext(EditorModel& model);
[[nodiscard]] int nextClipId(const EditorModel& model); ///< 0: none

} // namespace pacini::editor
