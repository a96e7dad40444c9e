#include "cli/bench/BenchReport.h"

#include "cli/plot/WorkPrecisionFigure.h"
#include "io/AtomicFile.h"
#include "io/InputFile.h"
#include "io/JsonTree.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

namespace pacini::cli
{

namespace
{
std::string titleOf(const BenchTable& table, const std::string& name)
{
    for (const BenchColumn& column : table.header())
        if (column.name == name)
            return column.unit.empty() ? name : fmt::format("{} ({})", name, column.unit);
    return name;
}

plot::WorkPrecisionFigure makeFigure(const BenchReport& report, const BenchFigure& wanted)
{
    const BenchTable table = wanted.filter.empty() ? report.means : report.means.where(wanted.filter, wanted.value);
    plot::WorkPrecisionFigure figure;
    figure.title = wanted.title;
    figure.subtitle = fmt::format("pacini bench {}, {}", report.bench.name, overText(report));
    figure.workTitle = titleOf(table, wanted.x);
    figure.errorTitle = titleOf(table, wanted.y);
    for (std::size_t r = 0; r < table.rows(); ++r)
    {
        const std::string name = table.text(r, wanted.series);
        auto series = std::find_if(figure.series.begin(), figure.series.end(),
                                   [&name](const auto& other) { return other.name == name; });
        if (series == figure.series.end())
            series = figure.series.insert(series, {name, {}, wanted.joined});
        series->points.push_back({table.number(r, wanted.x), table.number(r, wanted.y),
                                  wanted.label.empty() ? "" : table.text(r, wanted.label)});
    }
    return figure;
}

std::string figureName(const BenchReport& report, const BenchFigure& figure, const std::string& format)
{
    return report.bench.name + (figure.name.empty() ? "" : "-" + figure.name) + "." + format;
}

/// Whether a file is the JSON of an earlier report of this bench.
bool isReport(const std::filesystem::path& path, const std::string& bench)
{
    constexpr std::size_t largest = std::size_t(256) << 20;
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(path, unknown))
        return false;
    const auto text = readWholeFile(path, largest);
    const auto tree = text ? readJsonTree(*text, largest) : Result<nlohmann::json>(text.error());
    return tree && tree->is_object() && tree->contains("rows") && tree->value("bench", nlohmann::json()) == bench;
}
} // namespace

std::string overText(const BenchReport& report)
{
    if (!report.bench.usesSounds)
        return "made signals";
    return report.sounds == 1 ? "one sound" : fmt::format("means over {} sounds", report.sounds);
}

nlohmann::ordered_json toJson(const BenchReport& report)
{
    nlohmann::ordered_json units = nlohmann::ordered_json::object();
    for (const BenchColumn& column : report.rows.header())
        if (!column.unit.empty())
            units[column.name] = column.unit;
    return {{"bench", report.bench.name},
            {"title", report.bench.title},
            {"note", report.bench.note},
            {"sounds", report.sounds},
            {"units", units},
            {"means", report.means.json()},
            {"rows", report.rows.json()}};
}

std::string toMarkdown(const BenchReport& report)
{
    const Bench& bench = report.bench;
    std::string text = fmt::format("## {}\n\n{}\n\n{}", bench.title, bench.note, report.means.markdown());
    if (bench.perSound.empty() || report.rows.rows() == 0)
        return text;
    BenchTable chosen = report.rows;
    std::string choice;
    for (const std::string& key : bench.perSound)
    {
        const std::string value = report.rows.text(0, key);
        chosen = chosen.where(key, value);
        choice += (choice.empty() ? "" : ", ") + value;
    }
    return text + fmt::format("\nEach sound, {}:\n\n{}", choice, chosen.markdown());
}

Result<std::vector<std::filesystem::path>> writeReport(const BenchReport& report, const std::filesystem::path& folder,
                                                       const std::string& format, Replaceable replaceable)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        return Error{ErrorCode::io, "", "cannot make the folder: " + error.message()};
    const std::string& name = report.bench.name;
    std::vector<std::string> names = {name + ".csv", name + ".json"};
    for (const BenchFigure& figure : report.bench.figures)
        names.push_back(figureName(report, figure, format));
    if (replaceable != Replaceable::any && !isReport(folder / (name + ".json"), name))
        for (const std::string& file : names)
            if (isOccupied(folder / file))
                return notReplaced(folder / file, "exists without a report of this bench; name another folder");
    std::vector<std::filesystem::path> written;
    const auto write = [&](const std::string& file, const std::string& text) -> Result<void>
    {
        written.push_back(folder / file);
        if (const auto bytes = writeFileAtomically(written.back(), text); !bytes)
            return bytes.error();
        return {};
    };
    if (const auto done = write(name + ".csv", report.rows.csv()); !done)
        return done.error();
    if (const auto done =
            write(name + ".json", toJson(report).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
        !done)
        return done.error();
    for (const BenchFigure& figure : report.bench.figures)
    {
        written.push_back(folder / figureName(report, figure, format));
        if (const auto done = plot::writeWorkPrecision(written.back(), makeFigure(report, figure)); !done)
            return done.error();
    }
    return written;
}

} // namespace pacini::cli
