#pragma once

// Tables of frequency responses as text: CSV and exports of measurement programs.

#include <pacini/linearize/FrequencyResponse.h>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

inline constexpr std::size_t largestResponseText = 64u << 20; ///< bytes

/// A response from lines of `frequency, level`, Hz and dB. Columns are parted by commas, semicolons (then a comma may
/// stand for the decimal point), tabs or spaces; what follows the second does not count. Lines that start with #, *, ;
/// or // are comments, and one heading may come first. Errors name the line, such as `line 7: frequency`; otherwise as
/// in utf8Text() and validate(FrequencyResponse).
[[nodiscard]] Result<FrequencyResponse> readResponseTable(std::string_view bytes);

/// The same from a file. Errors of reading: io.
[[nodiscard]] Result<FrequencyResponse> readResponse(const std::filesystem::path& path);

/// A column of a table.
struct TableColumn
{
    std::string name;
    std::vector<double> values; ///< NaN leaves the cell empty
};

/// Columns of one length as CSV with a heading; numbers come back exactly.
[[nodiscard]] std::string tableText(std::span<const TableColumn> columns);

} // namespace pacini
