#pragma once

// A table of measurements: columns with units, rows, and how rows are summed up over several sounds.

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace pacini::cli
{

/// Reduction of a column when the rows of several sounds become one.
enum class Reduction
{
    sound,    ///< the name of the sound: left out
    key,      ///< rows that agree in all keys become one
    mean,     ///< arithmetic mean of the cells that are not empty; empty when all are
    sum,      ///< sum of the cells that are not empty
    ratio,    ///< scale * numerator / denominator, both other columns of this row: computed, before and after
    spread,   ///< SD of the numerator's column over the sounds, of two at least; empty in the rows of single sounds
    relative, ///< numerator over that of the first row, or of the first that agrees in the key `denominator`: computed
};

struct BenchColumn
{
    std::string name; ///< a word in camelCase
    std::string unit; ///< may be empty
    Reduction reduction = Reduction::mean;
    std::string numerator = {};   ///< name of a column before this one, where the reduction needs it
    std::string denominator = {}; ///< likewise
    double scale = 1.0;           ///< of a ratio
    bool printed = true;          ///< false: only in CSV and JSON
};

/// A sum that only CSV and JSON show, as a basis of ratios.
[[nodiscard]] inline BenchColumn summed(std::string name, std::string unit = {})
{
    return {std::move(name), std::move(unit), Reduction::sum, {}, {}, 1.0, false};
}

/// The columns of a bench: the sound's name, `keys` without units, then `measured`.
[[nodiscard]] inline std::vector<BenchColumn> columnsOf(const std::vector<std::string>& keys,
                                                        const std::vector<BenchColumn>& measured)
{
    std::vector<BenchColumn> columns{{"clip", "", Reduction::sound}};
    for (const std::string& key : keys)
        columns.push_back({key, "", Reduction::key});
    columns.insert(columns.end(), measured.begin(), measured.end());
    return columns;
}

/// Empty (not measured, or not computed yet), a text or a number.
using BenchCell = std::variant<std::monostate, std::string, double>;

class BenchTable
{
public:
    explicit BenchTable(std::vector<BenchColumn> columnsToHave) : columns(std::move(columnsToHave)) {}

    /// Appends a row: one cell for each column, but none for ratio and relative columns, which are computed.
    void add(std::vector<BenchCell> given);

    /// One row for each combination of keys, in order of first appearance; the columns without the sounds' names.
    [[nodiscard]] BenchTable overSounds() const;

    /// The same rows, those with the largest numbers in column `name` first and those without one last; the order of
    /// rows that are alike stays.
    [[nodiscard]] BenchTable sortedBy(std::string_view name) const;

    /// The rows whose text in column `name` is `value`.
    [[nodiscard]] BenchTable where(std::string_view name, std::string_view value) const;

    [[nodiscard]] std::size_t rows() const noexcept { return cells.size(); }
    [[nodiscard]] const std::vector<BenchColumn>& header() const noexcept { return columns; }

    /// The cell of a row in the column `name`, which must exist.
    [[nodiscard]] const BenchCell& at(std::size_t row, std::string_view name) const;

    /// The number there; NaN when the cell holds none.
    [[nodiscard]] double number(std::size_t row, std::string_view name) const;

    /// The text there, a number in three digits.
    [[nodiscard]] std::string text(std::size_t row, std::string_view name) const;

    /// RFC 4180 with a header `name [unit]`; numbers in full precision, empty cells empty.
    [[nodiscard]] std::string csv() const;

    /// An array of one object per row, with the names of the columns as keys; empty cells are null.
    [[nodiscard]] nlohmann::ordered_json json() const;

    /// Aligned columns for a terminal, three digits, only what is printed.
    [[nodiscard]] std::string aligned() const;

    /// The same as a Markdown table.
    [[nodiscard]] std::string markdown() const;

private:
    [[nodiscard]] std::size_t indexOf(std::string_view name) const;
    [[nodiscard]] BenchCell computed(std::size_t column, const std::vector<BenchCell>& row) const;
    void compute(std::vector<BenchCell>& row) const;
    [[nodiscard]] BenchCell spreadOf(const std::vector<std::size_t>& group, std::size_t column) const;

    std::vector<BenchColumn> columns;
    std::vector<std::vector<BenchCell>> cells;
};

} // namespace pacini::cli
