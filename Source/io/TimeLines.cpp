#include "io/TimeLines.h"

#include "io/JsonText.h"
#include "io/TextLines.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace pacini
{

namespace
{
/// Seconds, `1:02.5` or `1:00:02.5`.
std::optional<double> timeOf(std::string_view text)
{
    double time = 0.0;
    for (int colons = 0;; ++colons)
    {
        const auto colon = text.find(':');
        std::string_view part = text.substr(0, colon);
        part.remove_prefix(colons == 0 && part.starts_with('+') ? 1 : 0);
        const auto number = parseNumber(part);
        if (!number || !std::isfinite(*number) || *number < 0.0 || colons > 2 || (colons > 0 && *number >= 60.0))
            return std::nullopt;
        time = 60.0 * time + *number;
        if (colon == std::string_view::npos)
            return time;
        text.remove_prefix(colon + 1);
    }
}

/// The first field of a line of times. A comma in it stands for the decimal point where digits are on both sides and
/// fields end otherwise: in lines with tabs or semicolons, and in texts whose times have no points.
std::string firstField(std::string_view line, bool timesHavePoints)
{
    const auto isNumber = [](std::string_view part)
    {
        return !part.empty() && part.find_first_not_of("0123456789") == std::string_view::npos;
    };
    std::string field(line.substr(0, line.find_first_of(" \t\r;")));
    const auto comma = field.find(',');
    std::string_view whole = std::string_view(field).substr(0, comma);
    whole.remove_prefix(whole.starts_with('+') || whole.starts_with('-') ? 1 : 0);
    if (comma == std::string::npos)
        return field;
    const std::string_view rest = std::string_view(field).substr(comma + 1);
    const bool otherEnds = line.find_first_of("\t;") != std::string_view::npos;
    if (!isNumber(whole) || !isNumber(rest.substr(0, rest.find(','))) || (timesHavePoints && !otherEnds))
        field.resize(comma);
    else if (isNumber(rest))
        field[comma] = '.';
    return field; // `0,5,1,25` may be two times or four, and is no number
}

bool hasPoint(std::string_view line)
{
    return line.substr(0, line.find_first_of(" \t\r,;")).find('.') != std::string_view::npos;
}

/// The cells of a row, without quotes around them.
std::vector<std::string> cellsOf(std::string_view row, char separator)
{
    std::vector<std::string> cells(1);
    bool isQuoted = false;
    for (std::size_t i = 0; i < row.size(); ++i)
        if (isQuoted && row.substr(i).starts_with("\"\""))
            cells.back() += row[i++];
        else if (row[i] == '"')
            isQuoted = !isQuoted;
        else if (row[i] == separator && !isQuoted)
            cells.emplace_back();
        else
            cells.back() += row[i];
    for (std::string& cell : cells)
        cell = withoutBlanks(cell);
    return cells;
}

/// The columns that a heading names.
struct Columns
{
    char separator = ',';
    std::optional<std::size_t> time, end, label;
};

/// None for a line that is no heading.
std::optional<Columns> columnsOf(std::string_view heading)
{
    constexpr std::array<std::string_view, 6> times{"start", "time", "onset", "begin", "position", "seconds"};
    constexpr std::array<std::string_view, 3> ends{"end", "stop", "offset"};
    constexpr std::array<std::string_view, 5> labels{"name", "label", "description", "text", "event"};
    Columns columns;
    for (const char separator : {'\t', ';', ','})
        if (heading.find(separator) != std::string_view::npos)
        {
            columns.separator = separator;
            break;
        }
    const std::vector<std::string> cells = cellsOf(heading, columns.separator);
    const auto find = [&](const auto& names) -> std::optional<std::size_t>
    {
        for (const std::string_view name : names)
            for (std::size_t i = 0; i < cells.size(); ++i)
            {
                std::string cell = cells[i].substr(0, cells[i].find_first_of(" (_[")); // `time (s)`, `onset_time`
                std::transform(cell.begin(), cell.end(), cell.begin(),
                               [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
                if (cell == name)
                    return i;
            }
        return std::nullopt;
    };
    columns.time = find(times);
    columns.end = find(ends);
    columns.label = find(labels);
    return columns.time ? std::optional(columns) : std::nullopt;
}

Error noTime(std::size_t line, std::string_view text)
{
    return {ErrorCode::invalidData, fmt::format("line {}", line),
            fmt::format("\"{}\" is not a time in seconds, 0 or more", shownText(text))};
}

Result<TimeLine> lineOfTable(const Columns& columns, std::string_view row, std::size_t number)
{
    const std::vector<std::string> cells = cellsOf(row, columns.separator);
    const auto cell = [&](std::optional<std::size_t> column)
    {
        return column && *column < cells.size() ? cells[*column] : std::string();
    };
    const auto time = [&](std::optional<std::size_t> column)
    {
        std::string text = cell(column);
        if (columns.separator != ',')
            std::replace(text.begin(), text.end(), ',', '.');
        else if (text.find('.') == std::string::npos && std::count(text.begin(), text.end(), ',') == 1)
            text[text.find(',')] = '.'; // it was in quotes
        return timeOf(text);
    };
    const auto start = time(columns.time);
    if (!start)
        return noTime(number, cell(columns.time));
    TimeLine line{*start, time(columns.end), cell(columns.label)};
    if (line.end && *line.end < line.time)
        line.end.reset();
    return line;
}

Result<TimeLine> lineOfLabels(std::string_view text, bool timesHavePoints, std::size_t number)
{
    const auto takeTime = [&](std::string_view& rest) -> std::pair<std::optional<double>, std::string>
    {
        std::string field = firstField(rest, timesHavePoints);
        const auto time = timeOf(field);
        if (time)
        {
            rest.remove_prefix(std::min(field.size(), rest.size()));
            rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r,;"), rest.size()));
        }
        return {time, std::move(field)};
    };
    std::string_view rest = text;
    const auto [time, field] = takeTime(rest);
    if (!time)
        return noTime(number, field);
    TimeLine line{*time, std::nullopt, {}};
    const std::string_view behind = rest;
    if (const auto end = takeTime(rest).first; end && *end >= *time)
        line.end = end;
    else
        rest = behind;
    line.label = withoutBlanks(rest);
    return line;
}
} // namespace

Result<void> forEachTimeLine(std::string_view text, const std::function<void(const TimeLine&)>& visit)
{
    std::vector<std::pair<std::size_t, std::string_view>> lines; // with their numbers
    bool timesHavePoints = false;
    for (std::size_t number = takeSeparatorLine(text) ? 2 : 1; !text.empty(); ++number)
    {
        const std::string_view line = withoutBlanks(takeLine(text));
        // A line that begins with a backslash holds the frequencies of Audacity's label before it.
        const bool isHeading = lines.empty() && line.starts_with("#,"); // as REAPER calls its first column
        if (line.empty() || line.starts_with('\\') || (line.starts_with('#') && !isHeading))
            continue;
        timesHavePoints = timesHavePoints || hasPoint(line);
        lines.emplace_back(number, line);
    }
    std::optional<Columns> columns;
    if (!lines.empty() && !timeOf(firstField(lines.front().second, timesHavePoints)))
        columns = columnsOf(lines.front().second);
    for (std::size_t i = columns ? 1 : 0; i < lines.size(); ++i)
    {
        const auto [number, line] = lines[i];
        const auto read = columns ? lineOfTable(*columns, line, number) : lineOfLabels(line, timesHavePoints, number);
        if (!read)
            return read.error();
        visit(*read);
    }
    return {};
}

} // namespace pacini
