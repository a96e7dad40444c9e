#include "io/MotionFile.h"

#include "io/InputFile.h"
#include "io/JsonText.h"
#include "io/NumberTable.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

namespace pacini
{

Result<TextureMotion> readMotionTable(std::string_view bytes)
{
    constexpr std::array<std::string_view, 3> columns{"time", "speed", "force"};
    NumberTableForm form;
    form.columns = columns;
    form.needed = 2;
    form.needs = "each line needs a time in s and a speed, and all or none a force";
    form.mostRows = mostMotionRows;
    form.tooMany = "is beyond 1000000 lines; thin the table first";
    const auto rows = readNumberTable(bytes, form);
    if (!rows)
        return rows.error();
    if (rows->empty())
        return Error{ErrorCode::invalidData, "", "has no line with a time and a speed"};
    TextureMotion motion;
    double last = -1.0;
    for (const NumberRow& row : *rows)
    {
        const auto at = [&row, columns](std::size_t column, ErrorCode code, std::string message)
        {
            return Error{code, fmt::format("line {}: {}", row.line, columns[column]), std::move(message)};
        };
        for (std::size_t i = 0; i < row.values.size(); ++i)
            if (!std::isfinite(row.values[i]) || row.values[i] < 0.0)
                return at(i, ErrorCode::invalidData, "must be a finite number from 0 on");
        if (row.values.size() != rows->front().values.size())
            return at(2, ErrorCode::invalidData,
                      fmt::format("is {}; {}", row.values.size() < 3 ? "missing" : "new", form.needs));
        if (!(row.values[0] > last))
            return at(0, ErrorCode::invalidData, "must be later than that of the line before");
        last = row.values[0];
        motion.speed.push_back({row.values[0], row.values[1]});
        if (row.values.size() > 2)
            motion.force.push_back({row.values[0], row.values[2]});
    }
    return motion;
}

Result<TextureMotion> readMotion(const std::filesystem::path& path)
{
    const auto text = readWholeFile(path, largestMotionText);
    return text ? readMotionTable(*text) : text.error();
}

Result<Curve> curveOfText(std::string_view text)
{
    constexpr std::string_view between = " ,\t\r\n";
    const auto refused = [](std::string_view word, const char* rule)
    {
        return Error{ErrorCode::invalidArgument, "", fmt::format("'{}' {}", shownText(word), rule)};
    };
    Curve curve;
    for (std::string_view rest = text; rest.find_first_not_of(between) != std::string_view::npos;)
    {
        rest.remove_prefix(rest.find_first_not_of(between));
        const std::string_view word = rest.substr(0, rest.find_first_of(between));
        rest.remove_prefix(word.size());
        const auto colon = word.find(':');
        const bool isPoint = colon != std::string_view::npos;
        const auto time = isPoint ? parseNumber(word.substr(0, colon)) : std::optional(0.0);
        const auto value = parseNumber(isPoint ? word.substr(colon + 1) : word);
        if (!time || !value || !std::isfinite(*time) || *time < 0.0 || (!isPoint && word.size() != text.size()))
            return refused(word, "is not a point, such as 0.5:1 for 1 after half a second");
        if (!(*value >= 0.0 && *value <= 1.0))
            return refused(word, "must have a value from 0 to 1");
        if (!curve.empty() && *time < curve.back().time)
            return refused(word, "is earlier than the point before it");
        curve.push_back({*time, *value});
    }
    if (curve.empty())
        return refused(text, "has no point, such as 0.5:1 for 1 after half a second");
    return curve;
}

} // namespace pacini
