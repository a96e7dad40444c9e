#pragma once

// Study templates, one for each common question.

#include "study/Study.h"

#include <pacini/foundation/Result.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::study
{

struct StudyTemplate
{
    std::string_view name;
    std::string_view title;       ///< a few words for a menu
    std::string_view purpose;     ///< one line
    std::size_t fewestSounds = 0; ///< that it needs
};

/// Returns all templates: coherence, words, mushra, abx, jnd, compression, threshold, similarity, ranking, place,
/// events, questionnaire.
[[nodiscard]] std::span<const StudyTemplate> studyTemplates() noexcept;

/// The study of a template with these sounds (paths from the study's folder). It passes validate(). Errors:
/// invalidArgument for another name or too few sounds.
[[nodiscard]] Result<Study> makeStudy(std::string_view name, const std::vector<std::string>& sounds);

/// Replaces the groups of a study by any number of others. A group with a name that the study has keeps its blocks; the
/// others do those of the study's groups by their place, from the first again after the last. Blocks that nobody does
/// go. Errors: invalidArgument for no group.
[[nodiscard]] Result<void> setGroups(Study& study, const std::vector<Group>& groups);

} // namespace pacini::study
