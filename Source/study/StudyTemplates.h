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
    std::size_t mostSounds = any; ///< that it presents
    std::size_t fewestOwn = 0;    ///< where sounds replace its own tones: fewest that do

    static constexpr std::size_t any = static_cast<std::size_t>(-1);
};

/// How many sounds a template takes: "2 or more", "none", "none, or 2 to 4".
[[nodiscard]] std::string soundsOf(const StudyTemplate& one);

/// Returns all templates: coherence, words, mushra, abx, jnd, compression, threshold, similarity, ranking, place,
/// events, questionnaire.
[[nodiscard]] std::span<const StudyTemplate> studyTemplates() noexcept;

/// The study of a template with these sounds (paths from the study's folder). It passes validate(). Errors:
/// invalidArgument for another name, and for too few or too many sounds: none is left out.
[[nodiscard]] Result<Study> makeStudy(std::string_view name, const std::vector<std::string>& sounds);

/// Replaces the groups of a study by any number of others. A group with a name that the study has keeps its blocks; the
/// others do those of the study's groups by their place, from the first again after the last. Blocks that nobody does
/// go. Errors: invalidArgument for no group.
[[nodiscard]] Result<void> setGroups(Study& study, const std::vector<Group>& groups);

} // namespace pacini::study
