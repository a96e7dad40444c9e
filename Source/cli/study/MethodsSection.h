#pragma once

// Methods section of a study's report, in the past tense and to be cited: people, stimuli, tasks and tests.

#include "cli/study/ReportWriter.h"
#include "study/StudyResults.h"

namespace pacini::cli
{

/// Of a study: who took part, what was presented in which order, what was asked, and by which tests (those that were
/// written with ReportWriter::method()) the answers were held against each other. Also as `methods` in the JSON.
void writeMethods(ReportWriter& writer, StudyReport& report, const study::StudyResults& results);

/// Of a table of ratings, about whose making nothing is known.
void writeMethods(ReportWriter& writer, StudyReport& report, const RatedTable& table);

} // namespace pacini::cli
