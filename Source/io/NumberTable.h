#pragma once

// Tables of numbers as text: CSV and exports of measurement programs.

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// What a table of numbers has to have.
struct NumberTableForm
{
    std::span<const std::string_view> columns; ///< their names in errors
    std::size_t needed = 1;                    ///< of them; a row without the others leaves them empty
    std::string_view needs;                    ///< said of a cell that is missing: "each line needs a ..."
    std::size_t mostRows = 1;
    std::string_view tooMany; ///< said of a row beyond them
};

/// A line of numbers.
struct NumberRow
{
    std::size_t line = 0; ///< of the text, counted from 1
    std::vector<double> values;
};

/// The rows of a text. Columns are parted by commas, semicolons (then a comma may stand for the decimal point), tabs or
/// spaces; what follows the last does not count. Lines that start with #, *, ; or // are comments, and one heading may
/// come first. Errors name the line and the column, such as `line 7: frequency`; otherwise as in utf8Text().
[[nodiscard]] Result<std::vector<NumberRow>> readNumberTable(std::string_view bytes, const NumberTableForm& form);

} // namespace pacini
