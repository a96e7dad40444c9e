#include "cli/CompareReport.h"

#include "cli/Console.h"

#include <pacini/evaluate/ComparisonReport.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

/// Format of a figure of one pair; `heading` is empty for figures that only the JSON contains.
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
    {"low kept", 2},
    {"beat kept", 2},
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

/// Sink of a report that fills an object.
struct JsonSink
{
    Json& json;

    template <typename Value>
    void value(std::string_view key, const Value& value)
    {
        json[std::string(key)] = value;
    }
    template <typename Value>
    void value(std::string_view key, const std::optional<Value>& value)
    {
        json[std::string(key)] = orNull(value);
    }
    void none(std::string_view key) { json[std::string(key)] = nullptr; }
    void group(std::string_view key, auto&& fill)
    {
        JsonSink inner{json[std::string(key)]};
        fill(inner);
    }
};

/// The key of the figure that the sound itself reaches; empty where that is trivial.
std::string_view ofSound(std::string_view key)
{
    return key == "match" ? "matchOfSound" : key == "hts" ? "ceiling" : "";
}

/// Sums over all completed pairs.
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
    const auto meanOf = [&](const ComparisonFigure& figure)
    {
        return mean(tasks, figure);
    };
    addRow("mean", meanOf);
    addRow("sound itself",
           [&](const ComparisonFigure& figure)
           {
               const auto* itself = std::find_if(comparisonFigures.begin(), comparisonFigures.end(),
                                                 [&](const auto& other) { return other.key == ofSound(figure.key); });
               return itself != comparisonFigures.end() ? meanOf(*itself) : std::nullopt;
           });
    addRow("silence", [](const ComparisonFigure& figure)
           { return figure.key == "match" ? std::optional(matchOfSilence) : std::nullopt; });
    return aligned(rows);
}

nlohmann::ordered_json pairJson(const CompareTask& task)
{
    const CompareResult& r = *task.result;
    Json json{{"reference", task.pair.reference.string()}, {"candidate", task.pair.candidate.string()}};
    JsonSink sink{json};
    reportComparison(r, sink);
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
    JsonSink sink{report};
    if (const auto events = pooledEvents(tasks))
        sink.group("events", [&](auto& counts) { reportEvents(*events, counts); });
    else
        sink.none("events");
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
