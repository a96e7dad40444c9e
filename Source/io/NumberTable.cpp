#include "io/NumberTable.h"

#include "io/JsonText.h"
#include "io/TextLines.h"
#include "io/TextMark.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace pacini
{

namespace
{
bool isComment(std::string_view line)
{
    return line.empty() || line.front() == '#' || line.front() == '*' || line.front() == ';' || line.starts_with("//");
}

/// Takes the next cell off `line`.
std::string_view takeCell(std::string_view& line, std::string_view separators)
{
    line = withoutBlanks(line);
    const auto end = line.find_first_of(separators);
    const auto cell = line.substr(0, end);
    line = end == std::string_view::npos ? std::string_view() : line.substr(end + 1);
    auto text = withoutBlanks(cell);
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
        text = withoutBlanks(text.substr(1, text.size() - 2));
    return text;
}

std::optional<double> numberIn(std::string_view cell, bool commaIsPoint)
{
    std::string text(cell);
    if (const auto comma = text.find(','); commaIsPoint && comma != std::string::npos)
        text[comma] = '.';
    return parseNumber(std::string_view(text).substr(text.starts_with('+') ? 1 : 0));
}

/// The cells of a line as text and, where they are some, numbers.
struct Cells
{
    std::vector<std::string_view> texts;
    std::vector<std::optional<double>> numbers;
};

Cells splitLine(std::string_view line, std::size_t columns)
{
    const bool commaIsPoint = line.find(';') != std::string_view::npos;
    const std::string_view separators = commaIsPoint                                ? ";"
                                        : line.find(',') != std::string_view::npos  ? ","
                                        : line.find('\t') != std::string_view::npos ? "\t"
                                                                                    : " ";
    Cells cells;
    for (std::size_t i = 0; i < columns; ++i)
    {
        cells.texts.push_back(takeCell(line, separators));
        cells.numbers.push_back(numberIn(cells.texts.back(), commaIsPoint));
    }
    return cells;
}

bool hasNoNumber(const Cells& cells)
{
    for (const auto& number : cells.numbers)
        if (number)
            return false;
    return true;
}
} // namespace

Result<std::vector<NumberRow>> readNumberTable(std::string_view bytes, const NumberTableForm& form)
{
    const auto unmarked = utf8Text(bytes);
    if (!unmarked)
        return unmarked.error();
    std::string_view text = *unmarked;
    std::vector<NumberRow> rows;
    bool headingSeen = false;
    for (std::size_t number = takeSeparatorLine(text) ? 2 : 1; !text.empty(); ++number)
    {
        const auto line = withoutBlanks(takeLine(text));
        if (isComment(line))
            continue;
        const Cells cells = splitLine(line, form.columns.size());
        if (rows.empty() && hasNoNumber(cells) && !std::exchange(headingSeen, true))
            continue;
        NumberRow row{number, {}};
        for (std::size_t i = 0; i < form.columns.size(); ++i)
        {
            const std::string_view cell = cells.texts[i];
            if (!cells.numbers[i] && (i < form.needed || !cell.empty()))
                return Error{ErrorCode::invalidData, fmt::format("line {}: {}", number, form.columns[i]),
                             cell.empty() ? fmt::format("is missing; {}", form.needs)
                                          : fmt::format("'{}' is not a number", shownText(cell))};
            if (!cells.numbers[i])
                break;
            row.values.push_back(*cells.numbers[i]);
        }
        if (rows.size() == form.mostRows)
            return Error{ErrorCode::tooLarge, fmt::format("line {}", number), std::string(form.tooMany)};
        rows.push_back(std::move(row));
    }
    return rows;
}

} // namespace pacini
