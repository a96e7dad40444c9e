#pragma once

// Questionnaires that come with Pacini: questions of its own, free for any use.

#include "study/Study.h"

#include <pacini/foundation/Result.h>

#include <span>
#include <string_view>

namespace pacini::study
{

struct Questionnaire
{
    std::string_view name;
    std::string_view purpose; ///< one line
};

/// Returns all: demographics, music.
[[nodiscard]] std::span<const Questionnaire> questionnaires() noexcept;

/// Puts the block of a questionnaire before the first block that presents something. Errors: invalidArgument for
/// another name, or if the study has a block of that name.
[[nodiscard]] Result<void> addQuestionnaire(Study& study, std::string_view name);

} // namespace pacini::study
