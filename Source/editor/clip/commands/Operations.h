// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The edits with arguments that menus offer, see OperationSheet. Those of a scope take it as it is when they are made.

#include "editor/clip/sheets/OperationSheet.h"

namespace pacini::editor
{

[[nodiscard]] Operation gainOperation(const Session& session);
[[nodiscard]] Operation quantiseOperation(const Session& session);
[[nodiscard]] Operation humaniseOperation(const Session& session);
[[nodiscard]] Operation thinOperation(const Session& session);
[[nodiscard]] Operation transposeOperation();
[[nodiscard]] Operation stretchOperation(const Session& session);
[[nodiscard]] Operation repeatOperation();

} // namespace pacini::editor
