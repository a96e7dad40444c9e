#include "cli/CompareReport.h"

#include "cli/Console.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

/// How a figure of one pair is shown; `heading` is empty for what only the JSON has.
struct Column
{
    const char* heading;
    int decimals;
};

/// In the order of comparisonFigures.
constexpr std::array<Column, comparisonFigures.size()> columns{{
    {"match", 1},
    {"", 1},
    {"HTS", 1},
    {"of REF", 1},
    {"HTS-F", 1},
    {"LSD dB", 2},
    {"wide SNR dB", 2},
    {"band SNR dB", 2},
    {"", 2},
    {"centroid error %", 1},
    {"", 1},
    {"F1", 3},
    {"", 3},
}};

std::optional<double> mean(const std::vector<CompareTask>& tasks, const ComparisonFigure& figure)
{
    double sum = 0.0;
    std::size_t count = 0;
    for (const CompareTask& task : tasks)
        if (task.result)
            if (const auto value = figure.value(*task.result))
            {
                sum += *value;
                ++count;
            }
    return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

/// Counts over all files, with the F-measure of the counts.
std::optional<EventScore> pooledEvents(const std::vector<CompareTask>& tasks)
{
    std::optional<EventScore> pooled;
    for (const CompareTask& task : tasks)
        if (task.result && task.result->events)
        {
            if (!pooled)
                pooled.emplace();
            pooled->truePositives += task.result->events->truePositives;
            pooled->falsePositives += task.result->events->falsePositives;
            pooled->falseNegatives += task.result->events->falseNegatives;
        }
    if (pooled)
    {
        const auto twice = static_cast<double>(2 * pooled->truePositives);
        const auto wrong = static_cast<double>(pooled->falsePositives + pooled->falseNegatives);
        pooled->f = twice + wrong > 0.0 ? twice / (twice + wrong) : 1.0;
    }
    return pooled;
}

template <typename Value>
Json orNull(const std::optional<Value>& value)
{
    return value ? Json(*value) : Json(nullptr);
}

Json toJson(const EventScore& score)
{
    return {{"f1", score.f},
            {"hits", score.truePositives},
            {"spurious", score.falsePositives},
            {"missed", score.falseNegatives}};
}

Json toJson(const HtsScore& score)
{
    return {{"wide", score.wide}, {"band", score.band}, {"spectrum", score.spectrum}, {"event", score.event}};
}

Json toJson(const MatchParts& parts)
{
    return {{"attacks", parts.attacks},       {"envelope", parts.envelope}, {"roughness", parts.roughness},
            {"brightness", parts.brightness}, {"movement", parts.movement}, {"silence", parts.silence}};
}

Json toJson(const FeltFigures& figures)
{
    const FeltImpression impression = feltImpression(figures);
    return {{"strength", impression.strength},
            {"tempo", impression.tempo},
            {"roughness", impression.roughness},
            {"parts",
             {{"level", figures.level},
              {"meanLevel", figures.meanLevel},
              {"octave", figures.octave},
              {"pulses", figures.pulses},
              {"fluctuation", figures.fluctuation}}}};
}

/// Sums over what was done.
struct Totals
{
    std::size_t done = 0;
    double duration = 0.0;
    double seconds = 0.0;

    explicit Totals(const std::vector<CompareTask>& tasks)
    {
        for (const CompareTask& task : tasks)
            if (task.result)
            {
                ++done;
                duration += task.result->duration;
                seconds += task.result->seconds;
            }
    }
    [[nodiscard]] double timesRealTime() const { return seconds > 0.0 ? duration / seconds : 0.0; }
};

/// Characters, not bytes: what counts for columns.
std::size_t widthOf(const std::string& text)
{
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
}

/// Rows of cells as lines; the first column flush left, the others flush right.
std::string aligned(const std::vector<std::vector<std::string>>& rows)
{
    std::vector<std::size_t> widths(rows.front().size());
    for (const auto& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], widthOf(row[i]));
    std::string lines;
    for (const auto& row : rows)
    {
        lines += lines.empty() ? "" : "\n";
        for (std::size_t i = 0; i < row.size(); ++i)
        {
            const std::string gap(widths[i] - widthOf(row[i]), ' ');
            lines += i == 0 ? row[i] + gap : "  " + gap + row[i];
        }
    }
    return lines;
}
} // namespace

std::string compareTable(const std::vector<CompareTask>& tasks)
{
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < columns.size(); ++i)
        if (*columns[i].heading != '\0' && (comparisonFigures[i].key != "f1" || mean(tasks, comparisonFigures[i])))
            shown.push_back(i);
    std::vector<std::vector<std::string>> rows(1, {"file"});
    for (const std::size_t i : shown)
        rows.front().emplace_back(columns[i].heading);
    const auto addRow = [&](const std::string& name, auto&& valueOf)
    {
        rows.push_back({name});
        for (const std::size_t i : shown)
        {
            const std::optional<double> value = valueOf(comparisonFigures[i]);
            rows.back().push_back(value ? fmt::format("{:.{}f}", *value, columns[i].decimals) : "-");
        }
    };
    for (const CompareTask& task : tasks)
        if (task.result)
            addRow(task.pair.name.string(), [&](const ComparisonFigure& figure) { return figure.value(*task.result); });
    addRow("mean", [&](const ComparisonFigure& figure) { return mean(tasks, figure); });
    return aligned(rows);
}

nlohmann::ordered_json pairJson(const CompareTask& task)
{
    const CompareResult& r = *task.result;
    Json json{{"reference", task.pair.reference.string()},
              {"candidate", task.pair.candidate.string()},
              {"duration", r.duration},
              {"candidateDuration", r.candidateDuration}};
    for (const ComparisonFigure& figure : comparisonFigures)
        json[std::string(figure.key)] = orNull(figure.value(r));
    json["matchLag"] = r.match ? Json(r.matchLag) : Json(nullptr);
    json["matchAligned"] = r.aligned;
    json["matchParts"] = r.match ? toJson(*r.match) : Json(nullptr);
    json["impression"] = toJson(r.impression);
    json["htsParts"] = toJson(r.hts);
    json["htsFParts"] = toJson(r.htsFidelity);
    json["lag"] = orNull(r.measures.lag);
    json["gain"] = orNull(r.measures.gain);
    json["outOfBand"] = orNull(r.measures.outOfBand);
    json["notFinite"] = r.notFinite;
    json["silentReference"] = r.measures.silentReference;
    json["events"] = r.events ? toJson(*r.events) : Json(nullptr);
    json["seconds"] = r.seconds;
    json["timesRealTime"] = r.seconds > 0.0 ? r.duration / r.seconds : 0.0;
    return json;
}

nlohmann::ordered_json compareJson(const std::vector<CompareTask>& tasks)
{
    const Totals totals(tasks);
    Json report{{"files", Json::array()}, {"mean", Json::object()}};
    for (const ComparisonFigure& figure : comparisonFigures)
        report["mean"][std::string(figure.key)] = orNull(mean(tasks, figure));
    const auto events = pooledEvents(tasks);
    report["events"] = events ? toJson(*events) : Json(nullptr);
    report["duration"] = totals.duration;
    report["seconds"] = totals.seconds;
    report["timesRealTime"] = totals.timesRealTime();
    for (const CompareTask& task : tasks)
        if (task.result)
            report["files"].push_back(pairJson(task));
    return report;
}

std::string compareSummary(const std::vector<CompareTask>& tasks, std::size_t failures)
{
    const Totals totals(tasks);
    std::string text = fmt::format("{} compared", totals.done);
    if (const auto failed = tasks.size() - totals.done + failures; failed > 0)
        text += fmt::format(", {} failed", failed);
    if (totals.seconds > 0.0)
        text += fmt::format(": {}, {:.0f} times real time", durationText(totals.duration), totals.timesRealTime());
    if (const auto events = pooledEvents(tasks))
        text += fmt::format("; F1 of all events {:.3f} ({} hits, {} spurious, {} missed)", events->f,
                            events->truePositives, events->falsePositives, events->falseNegatives);
    return text;
}

} // namespace pacini::cli
