#include "io/ResponseTable.h"

#include "io/InputFile.h"
#include "io/NumberTable.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <system_error>

namespace pacini
{

namespace
{
/// `points[3].level` with 3 on line 5 becomes `line 5: level`.
Error atLine(Error error, const std::vector<std::size_t>& lines)
{
    constexpr std::string_view start = "points[";
    if (!error.where.starts_with(start))
        return error;
    std::size_t point = 0;
    const char* end = error.where.data() + error.where.size();
    const auto [stop, failure] = std::from_chars(error.where.data() + start.size(), end, point);
    if (failure == std::errc() && point < lines.size() && end - stop > 2)
        error.where = fmt::format("line {}: {}", lines[point], std::string_view(stop + 2, end));
    return error;
}
} // namespace

Result<FrequencyResponse> readResponseTable(std::string_view bytes)
{
    constexpr std::array<std::string_view, 2> columns{"frequency", "level"};
    NumberTableForm form;
    form.columns = columns;
    form.needed = columns.size();
    form.needs = "each line needs a frequency in Hz and a level in dB";
    form.mostRows = FrequencyResponse::maxPoints;
    form.tooMany = "is beyond 100000 points; thin or smooth the response first";
    const auto rows = readNumberTable(bytes, form);
    if (!rows)
        return rows.error();
    FrequencyResponse response;
    std::vector<std::size_t> lines;
    for (const NumberRow& row : *rows)
    {
        response.frequency.push_back(row.values[0]);
        response.level.push_back(row.values[1]);
        lines.push_back(row.line);
    }
    if (auto valid = validate(response); !valid)
        return atLine(valid.error(), lines);
    return response;
}

Result<FrequencyResponse> readResponse(const std::filesystem::path& path)
{
    const auto text = readWholeFile(path, largestResponseText);
    return text ? readResponseTable(*text) : text.error();
}

std::string tableText(std::span<const TableColumn> columns)
{
    std::string text;
    const auto row = [&](auto&& cell)
    {
        for (std::size_t i = 0; i < columns.size(); ++i)
            fmt::format_to(std::back_inserter(text), "{}{}", i == 0 ? "" : ",", cell(columns[i]));
        text += '\n';
    };
    row([](const TableColumn& column) { return column.name; });
    for (std::size_t i = 0; i < (columns.empty() ? 0 : columns.front().values.size()); ++i)
        row([i](const TableColumn& column)
            { return std::isnan(column.values[i]) ? std::string() : fmt::format("{}", column.values[i]); });
    return text;
}

} // namespace pacini
