// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Edits with arguments that the menus offer, see OperationSheet. Those of a scope take it as it is when they are made.

#include "editor/clip/session/Actuators.h"
#include "editor/clip/sheets/OperationSheet.h"

namespace pacini::editor
{

[[nodiscard]] Operation gainOperation(const ClipSelection& selection);
[[nodiscard]] Operation quantiseOperation(const ClipSelection& selection);
[[nodiscard]] Operation humaniseOperation(const ClipSelection& selection);
[[nodiscard]] Operation thinOperation(const ClipSelection& selection);
[[nodiscard]] Operation transposeOperation();
[[nodiscard]] Operation stretchOperation(const EditorModel& model);
[[nodiscard]] Operation repeatOperation();
/// Whether alikeOperation() can be made: the actuator of the project and another of the list can be felt alike.
[[nodiscard]] bool hasAlike(const Actuators& actuators);
[[nodiscard]] Operation alikeOperation(const Actuators& actuators);

} // namespace pacini::editor
