#pragma once

// Tables of all answers, for other programs.

#include "study/StudyResults.h"

#include <string>
#include <utility>
#include <vector>

namespace pacini::study
{

/// Names (with folders) and contents: answers.csv with a line for each answer, ratings.csv, thresholds.csv, and below
/// `bids` a folder for each participant as the Brain Imaging Data Structure (Gorgolewski et al. 2016) has behaviour.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> exportedFiles(const StudyResults& results);

} // namespace pacini::study
