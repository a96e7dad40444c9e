// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Question whether existing files may be replaced.

#include "document/FilesInTheWay.h"
#include "editor/clip/sheets/Sheet.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace pacini::editor
{

/// Asks whether these files may be replaced, of which there is one at least; Return keeps them.
[[nodiscard]] std::unique_ptr<Sheet> overwriteQuestion(const std::vector<StandingFile>& standing,
                                                       std::function<void()> replace);

/// Writes at once where nothing is lost; else shows the question, or says why it must not be. Of few files, which are
/// looked at now. [message]
void writeAfterAsking(const std::vector<std::filesystem::path>& files, const ProjectFileSet& needed,
                      std::function<void()> write, const std::function<void(std::unique_ptr<Sheet>)>& show,
                      const std::function<void(const Error&)>& refused);

} // namespace pacini::editor
