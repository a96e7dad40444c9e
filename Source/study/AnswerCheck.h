#pragma once

// Check of the answers in a session's log: what no session of the study can have stored does not count.

#include "study/SessionLog.h"
#include "study/Study.h"

#include <optional>
#include <string>
#include <vector>

namespace pacini::study
{

/// What is wrong with an answer of the study's `block`, such as "its value 150 is outside of the scale from 0 to 100";
/// none for a valid one. Questions of a questionnaire are checked one by one (see problemOf()), not here.
[[nodiscard]] std::optional<std::string> faultOf(const Study& study, const Block& block, const Record& record);

/// Sentences about answers that are missing in a session: numbers of trials that are left out between others, and
/// trials of a block that a finished session does not have.
[[nodiscard]] std::vector<std::string> missingAnswers(const Study& study, const LoggedSession& session);

} // namespace pacini::study
