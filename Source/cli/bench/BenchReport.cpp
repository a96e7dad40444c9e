#include "cli/bench/BenchReport.h"

#include "io/AtomicFile.h"

#include <fmt/format.h>

#include <system_error>

namespace pacini::cli
{

nlohmann::ordered_json toJson(const BenchReport& report)
{
    nlohmann::ordered_json units = nlohmann::ordered_json::object();
    for (const BenchColumn& column : report.rows.header())
        if (!column.unit.empty())
            units[column.name] = column.unit;
    return {{"bench", report.bench.name}, {"title", report.bench.title},   {"note", report.bench.note},
            {"units", units},             {"means", report.means.json()}, {"rows", report.rows.json()}};
}

std::string toMarkdown(const BenchReport& report)
{
    std::string text = fmt::format("## {}\n\n{}\n\n{}", report.bench.title, report.bench.note, report.means.markdown());
    if (report.bench.perSound.empty())
        return text;
    const BenchTable chosen =
        report.rows.where(report.bench.perSound, report.rows.text(0, report.bench.perSound)).where("variant", report.rows.text(0, "variant"));
    return text + fmt::format("\nEach sound, {}:\n\n{}", chosen.text(0, report.bench.perSound), chosen.markdown());
}

} // namespace pacini::cli
