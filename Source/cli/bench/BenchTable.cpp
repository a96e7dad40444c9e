#include "cli/bench/BenchTable.h"

#include "io/TableText.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace pacini::cli
{

namespace
{
bool isComputed(const BenchColumn& column)
{
    return column.reduction == Reduction::ratio || column.reduction == Reduction::relative ||
           column.reduction == Reduction::spread;
}

/// Three digits that count, or all before the point.
std::string shortNumber(double value)
{
    if (value == 0.0 || !std::isfinite(value))
        return fmt::format("{}", value);
    if (std::abs(value) < 1e-4 || std::abs(value) >= 1e7)
        return fmt::format("{:.2e}", value);
    const int digits = 2 - static_cast<int>(std::floor(std::log10(std::abs(value))));
    return fmt::format("{:.{}f}", value, std::clamp(digits, 0, 8));
}

std::string shortText(const BenchCell& cell)
{
    if (const auto* text = std::get_if<std::string>(&cell))
        return *text;
    const auto* value = std::get_if<double>(&cell);
    return value != nullptr ? shortNumber(*value) : "-";
}

/// Empty when there is nothing to divide by.
BenchCell quotient(double above, const double* below)
{
    BenchCell cell;
    if (below != nullptr && *below != 0.0)
        cell = above / *below;
    return cell;
}

std::string markdownField(const std::string& text)
{
    std::string escaped;
    for (const char c : text)
    {
        if (c == '|')
            escaped += '\\';
        escaped += c;
    }
    return escaped;
}

bool isText(const BenchColumn& column)
{
    return column.reduction == Reduction::sound || column.reduction == Reduction::key;
}

std::string titleOf(const BenchColumn& column)
{
    return column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit);
}
} // namespace

std::size_t BenchTable::indexOf(std::string_view name) const
{
    const auto found =
        std::find_if(columns.begin(), columns.end(), [name](const BenchColumn& column) { return column.name == name; });
    assert(found != columns.end());
    return static_cast<std::size_t>(found - columns.begin());
}

BenchCell BenchTable::computed(std::size_t column, const std::vector<BenchCell>& row) const
{
    const BenchColumn& wanted = columns[column];
    if (wanted.reduction == Reduction::spread)
        return row[column]; // as overSounds() has it
    const auto* above = std::get_if<double>(&row[indexOf(wanted.numerator)]);
    if (above == nullptr)
        return {};
    if (wanted.reduction == Reduction::ratio)
    {
        const auto* below = std::get_if<double>(&row[indexOf(wanted.denominator)]);
        return quotient(wanted.scale * *above, below);
    }
    const std::size_t value = indexOf(wanted.numerator);
    const auto agrees = [&](const std::vector<BenchCell>& other)
    {
        // Before the reduction every sound has its own first row.
        for (std::size_t c = 0; c < columns.size(); ++c)
            if (columns[c].reduction == Reduction::sound && other[c] != row[c])
                return false;
        return wanted.denominator.empty() || other[indexOf(wanted.denominator)] == row[indexOf(wanted.denominator)];
    };
    const auto first = std::find_if(cells.begin(), cells.end(), agrees);
    const auto* base = first != cells.end() ? std::get_if<double>(&(*first)[value]) : above;
    return quotient(*above, base);
}

void BenchTable::compute(std::vector<BenchCell>& row) const
{
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (isComputed(columns[c]))
            row[c] = computed(c, row);
}

void BenchTable::add(std::vector<BenchCell> given)
{
    std::vector<BenchCell> row;
    auto next = given.begin();
    for (const BenchColumn& column : columns)
    {
        if (isComputed(column))
        {
            row.emplace_back();
            continue;
        }
        assert(next != given.end());
        row.push_back(std::move(*next++));
    }
    assert(next == given.end());
    compute(row);
    cells.push_back(std::move(row));
}

BenchTable BenchTable::overSounds() const
{
    std::vector<std::size_t> kept;
    std::vector<BenchColumn> keptColumns;
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (columns[c].reduction != Reduction::sound)
        {
            kept.push_back(c);
            keptColumns.push_back(columns[c]);
        }
    std::vector<std::vector<std::size_t>> groups;
    std::map<std::vector<BenchCell>, std::size_t> groupOf;
    for (std::size_t r = 0; r < cells.size(); ++r)
    {
        std::vector<BenchCell> keys;
        for (std::size_t c = 0; c < columns.size(); ++c)
            if (columns[c].reduction == Reduction::key)
                keys.push_back(cells[r][c]);
        const auto [place, isNew] = groupOf.emplace(std::move(keys), groups.size());
        if (isNew)
            groups.emplace_back();
        groups[place->second].push_back(r);
    }

    BenchTable reduced(std::move(keptColumns));
    for (const auto& group : groups)
    {
        std::vector<BenchCell> row;
        for (const std::size_t c : kept)
        {
            const Reduction reduction = columns[c].reduction;
            if (reduction == Reduction::key)
                row.push_back(cells[group.front()][c]);
            else if (!isComputed(columns[c]))
            {
                double sum = 0.0;
                std::size_t count = 0;
                for (const std::size_t r : group)
                    if (const auto* value = std::get_if<double>(&cells[r][c]))
                    {
                        sum += *value;
                        ++count;
                    }
                const double divisor = reduction == Reduction::mean ? static_cast<double>(count) : 1.0;
                row.emplace_back();
                if (count > 0)
                    row.back() = sum / divisor;
            }
        }
        reduced.add(std::move(row));
        for (std::size_t c = 0; c < kept.size(); ++c)
            if (reduced.columns[c].reduction == Reduction::spread)
                reduced.cells.back()[c] = spreadOf(group, indexOf(reduced.columns[c].numerator));
    }
    return reduced;
}

BenchCell BenchTable::spreadOf(const std::vector<std::size_t>& group, std::size_t column) const
{
    std::vector<double> values;
    for (const std::size_t r : group)
        if (const auto* value = std::get_if<double>(&cells[r][column]))
            values.push_back(*value);
    BenchCell cell;
    if (values.size() < 2)
        return cell;
    const auto n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0.0;
    for (const double value : values)
        squares += (value - mean) * (value - mean);
    cell = std::sqrt(squares / (n - 1.0));
    return cell;
}

BenchTable BenchTable::sortedBy(std::string_view name) const
{
    BenchTable sorted = *this;
    const std::size_t column = indexOf(name);
    const auto numberIn = [column](const std::vector<BenchCell>& row)
    {
        const auto* value = std::get_if<double>(&row[column]);
        return value != nullptr && !std::isnan(*value) ? *value : -std::numeric_limits<double>::infinity();
    };
    std::stable_sort(sorted.cells.begin(), sorted.cells.end(),
                     [&](const auto& a, const auto& b) { return numberIn(a) > numberIn(b); });
    return sorted;
}

BenchTable BenchTable::where(std::string_view name, std::string_view value) const
{
    BenchTable found(columns);
    for (std::size_t r = 0; r < rows(); ++r)
        if (text(r, name) == value)
            found.cells.push_back(cells[r]);
    return found;
}

const BenchCell& BenchTable::at(std::size_t row, std::string_view name) const
{
    return cells[row][indexOf(name)];
}

double BenchTable::number(std::size_t row, std::string_view name) const
{
    const auto* value = std::get_if<double>(&at(row, name));
    return value != nullptr ? *value : std::numeric_limits<double>::quiet_NaN();
}

std::string BenchTable::text(std::size_t row, std::string_view name) const
{
    return shortText(at(row, name));
}

std::string BenchTable::csv() const
{
    std::string text;
    for (std::size_t c = 0; c < columns.size(); ++c)
        text += fmt::format("{}{}", c > 0 ? "," : "", csvField(titleOf(columns[c])));
    text += "\n";
    for (const auto& row : cells)
    {
        for (std::size_t c = 0; c < row.size(); ++c)
        {
            text += c > 0 ? "," : "";
            if (const auto* value = std::get_if<double>(&row[c]))
                text += fmt::format("{}", *value);
            else if (const auto* name = std::get_if<std::string>(&row[c]))
                text += csvField(*name);
        }
        text += "\n";
    }
    return text;
}

nlohmann::ordered_json BenchTable::json() const
{
    auto array = nlohmann::ordered_json::array();
    for (const auto& row : cells)
    {
        nlohmann::ordered_json object;
        for (std::size_t c = 0; c < row.size(); ++c)
        {
            auto& entry = object[columns[c].name];
            if (const auto* value = std::get_if<double>(&row[c]))
                entry = *value; // what is not finite becomes null
            else if (const auto* name = std::get_if<std::string>(&row[c]))
                entry = *name;
        }
        array.push_back(std::move(object));
    }
    return array;
}

std::string BenchTable::aligned() const
{
    std::vector<std::string> lines(rows() + 2);
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
        if (!columns[c].printed)
            continue;
        std::vector<std::string> fields = {columns[c].name, columns[c].unit};
        for (const auto& row : cells)
            fields.push_back(shortText(row[c]));
        std::size_t width = 0;
        for (const std::string& field : fields)
            width = std::max(width, field.size());
        for (std::size_t i = 0; i < fields.size(); ++i)
            lines[i] += isText(columns[c]) ? fmt::format("{:<{}}  ", fields[i], width)
                                           : fmt::format("{:>{}}  ", fields[i], width);
    }
    std::string table;
    for (std::string& line : lines)
    {
        line.erase(line.find_last_not_of(' ') + 1);
        table += line + "\n";
    }
    return table;
}

std::string BenchTable::markdown() const
{
    std::vector<std::string> lines(rows() + 2, "|");
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
        if (!columns[c].printed)
            continue;
        lines[0] += fmt::format(" {} |", titleOf(columns[c]));
        lines[1] += isText(columns[c]) ? "---|" : "---:|";
        for (std::size_t r = 0; r < rows(); ++r)
            lines[r + 2] += fmt::format(" {} |", markdownField(shortText(cells[r][c])));
    }
    std::string table;
    for (const std::string& line : lines)
        table += line + "\n";
    return table;
}

} // namespace pacini::cli
