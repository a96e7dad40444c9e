#pragma once

// Texts with a time in each line: labels of audio editors, tables of onsets.

#include <pacini/foundation/Result.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace pacini
{

/// A line with a time.
struct TimeLine
{
    double time = 0.0;         ///< s
    std::optional<double> end; ///< s, where the line has one that is not before it
    std::string label;         ///< may be empty
};

/// Hands `visit` each line of `text`. Without a heading, the time comes first: what follows it after a blank, a tab, a
/// comma or a semicolon is the end, if it is a time, and the label. With one, as REAPER and Audition export them, the
/// columns Start, Time or Onset, End, and Name, Label or Description count, however they are parted and quoted. Times
/// are seconds, or minutes or hours with a colon (`0:01.500`). Empty lines and lines that begin with # or, as the
/// frequencies of Audacity's labels do, with a backslash are passed over. A comma between digits is a decimal one in
/// lines with tabs or semicolons, and in texts without any point. Errors: invalidData with the line for other content
/// and for times below 0.
[[nodiscard]] Result<void> forEachTimeLine(std::string_view text, const std::function<void(const TimeLine&)>& visit);

} // namespace pacini
