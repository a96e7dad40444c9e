#pragma once

// The trials of one participant: group, order of stimuli, place of the right answer. They follow from the study and the
// participant's slot, so a session can continue without stored state.

#include "study/Study.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pacini::study
{

/// One presentation with its question.
struct Trial
{
    std::size_t block = 0;
    /// Indices of stimuli, in the order of presentation: none of a
    /// questionnaire; one; both of a pair; A, B and X; the intervals; all of a page.
    std::vector<std::size_t> stimuli;
    int right = -1;        ///< the right choice: an index, or see rightAnswer(); -1 where there is none
    bool training = false; ///< does not count
    bool adaptive = false; ///< the interval `right` has the value that the staircase of its stimulus requests
    bool afterBreak = false;
};

/// Returns the group of the participant in a slot from 0 on. Each run of as many slots as the study has participants
/// fills all groups, in a random order.
[[nodiscard]] std::size_t groupOfSlot(const Study& study, std::size_t slot);

/// Returns the row of the Latin square for a slot: its number within its group.
[[nodiscard]] std::size_t rowOfSlot(const Study& study, std::size_t slot);

/// Returns row `row` of a square of `count` elements. Each element comes once at each place and, over 2 * count rows
/// (count rows if it is even), equally often after each other (E. J. Williams, "Experimental designs balanced for the
/// estimation of residual effects of treatments", 1949).
[[nodiscard]] std::vector<std::size_t> williamsRow(std::size_t count, std::size_t row);

/// Returns the trials of a block for the participant in `slot`. A staircase has its maximum number of trials, its
/// stimuli by turns; the caller leaves out those of a finished stimulus.
[[nodiscard]] std::vector<Trial> trialsOf(const Study& study, std::size_t block, std::size_t slot);

/// A seed that differs for each participant, block and purpose.
[[nodiscard]] std::uint64_t seedOf(const Study& study, std::size_t slot, std::size_t purpose) noexcept;

} // namespace pacini::study
