#pragma once

// Spelling suggestion: the known name nearest to an unknown one.

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini
{

/// Returns the number of characters to insert, delete, replace or swap with their neighbour to turn `a` into `b`,
/// ignoring case: the optimal string alignment distance (Damerau, Communications of the ACM 7(3), 1964).
[[nodiscard]] inline std::size_t typingDistance(std::string_view a, std::string_view b)
{
    const auto at = [](std::string_view text, std::size_t i)
    {
        return std::tolower(static_cast<unsigned char>(text[i]));
    };
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j)
        last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
    {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j)
        {
            const bool same = at(a, i - 1) == at(b, j - 1);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0u : 1u)});
            if (i > 1 && j > 1 && at(a, i - 1) == at(b, j - 2) && at(a, i - 2) == at(b, j - 1))
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        std::swap(before, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

/// The one of `names` that is nearest to `name`, the first of equals, and its distance; an empty name when none is
/// nearer than `tooFar`.
template <typename Names>
[[nodiscard]] std::pair<std::string_view, std::size_t> nearestOf(std::string_view name, const Names& names,
                                                                 std::size_t tooFar)
{
    std::pair<std::string_view, std::size_t> nearest("", tooFar);
    for (const std::string_view known : names)
        if (const std::size_t distance = typingDistance(name, known); distance < nearest.second)
            nearest = {known, distance};
    return nearest;
}

/// "; did you mean NAME?" when one of `names` is near, else nothing: more than a third of the letters, and more than
/// one, are no slip of the fingers. Dashes in front of an option are no letters.
[[nodiscard]] inline std::string meantText(std::string_view name, const std::vector<std::string>& names)
{
    const std::size_t letters = name.size() - std::min(name.find_first_not_of('-'), name.size());
    const auto nearest = nearestOf(name, names, std::max<std::size_t>(1, letters / 3) + 1).first;
    return nearest.empty() ? std::string() : fmt::format("; did you mean {}?", nearest);
}

} // namespace pacini
