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

/// A response from lines of `frequency, level`, Hz and dB, as in readNumberTable(). Errors also as in
/// validate(FrequencyResponse), at the line.
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
