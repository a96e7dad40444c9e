#include "io/ResponseTable.h"

#include "io/InputFile.h"
#include "io/JsonText.h"
#include "io/TextMark.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(blanks);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

bool isComment(std::string_view line)
{
    return line.empty() || line.front() == '#' || line.front() == '*' || line.front() == ';' || line.starts_with("//");
}

/// Takes the next cell off `line`.
std::string_view takeCell(std::string_view& line, std::string_view separators)
{
    line = trimmed(line);
    const auto end = line.find_first_of(separators);
    const auto cell = line.substr(0, end);
    line = end == std::string_view::npos ? std::string_view() : line.substr(end + 1);
    auto text = trimmed(cell);
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
        text = trimmed(text.substr(1, text.size() - 2));
    return text;
}

std::optional<double> numberIn(std::string_view cell, bool commaIsPoint)
{
    std::string text(cell);
    if (const auto comma = text.find(','); commaIsPoint && comma != std::string::npos)
        text[comma] = '.';
    return parseNumber(std::string_view(text).substr(text.starts_with('+') ? 1 : 0));
}

struct Row
{
    std::string_view frequency;
    std::string_view level;
    bool commaIsPoint = false;
};

Row splitRow(std::string_view line)
{
    Row row;
    row.commaIsPoint = line.find(';') != std::string_view::npos;
    const std::string_view separators = row.commaIsPoint                            ? ";"
                                        : line.find(',') != std::string_view::npos  ? ","
                                        : line.find('\t') != std::string_view::npos ? "\t"
                                                                                    : " ";
    row.frequency = takeCell(line, separators);
    row.level = takeCell(line, separators);
    return row;
}

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
    const auto unmarked = utf8Text(bytes);
    if (!unmarked)
        return unmarked.error();
    std::string_view text = *unmarked;
    FrequencyResponse response;
    std::vector<std::size_t> lines;
    bool headingSeen = false;
    for (std::size_t number = 1; !text.empty(); ++number)
    {
        const auto end = text.find('\n');
        const auto line = trimmed(text.substr(0, end));
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
        if (isComment(line))
            continue;
        const Row row = splitRow(line);
        const auto frequency = numberIn(row.frequency, row.commaIsPoint);
        const auto level = numberIn(row.level, row.commaIsPoint);
        if (!frequency && !level && lines.empty() && !std::exchange(headingSeen, true))
            continue;
        const auto wrong = [&](const char* what, std::string_view cell) -> Error
        {
            return {ErrorCode::invalidData, fmt::format("line {}: {}", number, what),
                    cell.empty() ? std::string("is missing; each line needs a frequency in Hz and a level in dB")
                                 : fmt::format("'{}' is not a number", shownText(cell))};
        };
        if (!frequency)
            return wrong("frequency", row.frequency);
        if (!level)
            return wrong("level", row.level);
        if (response.size() == FrequencyResponse::maxPoints)
            return Error{ErrorCode::tooLarge, fmt::format("line {}", number),
                         "is beyond 100000 points; thin or smooth the response first"};
        response.frequency.push_back(*frequency);
        response.level.push_back(*level);
        lines.push_back(number);
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
