#include "study/StudyExport.h"

#include "io/TableText.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace pacini::study
{

namespace
{
std::string joined(const std::vector<std::string>& texts)
{
    return fmt::format("{}", fmt::join(texts, "|"));
}

std::string numberText(const std::optional<double>& value)
{
    return value ? fmt::to_string(*value) : std::string();
}

/// The columns of an answer, after who gave it.
constexpr std::array answerColumns{"trial",       "task",        "stimuli",  "training", "level",   "value",
                                   "values",      "choice",      "correct",  "words",    "seconds", "replays",
                                   "sound_onset", "touch_onset", "dropouts", "time"};

std::vector<std::string> cellsOf(const Record& record)
{
    const Answer& answer = record.answer;
    return {fmt::to_string(record.trial),
            record.task,
            joined(record.stimuli),
            record.training ? "1" : "0",
            numberText(record.level),
            numberText(answer.value),
            fmt::format("{}", fmt::join(answer.values, "|")),
            answer.choice ? fmt::to_string(*answer.choice) : std::string(),
            record.correct ? std::string(*record.correct ? "1" : "0") : std::string(),
            answer.words,
            fmt::format("{:.3f}", answer.seconds),
            fmt::to_string(answer.replays),
            numberText(answer.soundOnset),
            numberText(answer.touchOnset),
            fmt::to_string(answer.dropouts),
            record.time};
}

/// A cell of a table whose fields end with tabs: BIDS has no quotes.
std::string tabbed(std::string text)
{
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
    return text.empty() ? "n/a" : text;
}

/// Letters and digits alone, as labels of BIDS are.
std::string label(std::string_view text)
{
    std::string made;
    bool upper = false;
    for (const char c : text)
    {
        const bool isLetter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (isLetter)
            made += upper && c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
        upper = !isLetter;
    }
    return made.empty() ? "task" : made;
}

template <typename Cells, typename Change>
std::string lineOf(const Cells& cells, char separator, Change change)
{
    std::string line;
    for (const auto& cell : cells)
    {
        if (!line.empty() || &cell != &*cells.begin())
            line += separator;
        line += change(cell);
    }
    return line + '\n';
}
} // namespace

std::vector<std::pair<std::string, std::string>> exportedFiles(const StudyResults& results)
{
    std::string answers = "participant,group,block";
    for (const char* column : answerColumns)
        answers += std::string(",") + column;
    answers += '\n';
    std::map<std::string, std::string> bids;
    std::string participants = "participant_id\tgroup\tlanguage\tstarted\n";
    for (const LoggedSession& session : results.sessions)
    {
        const SessionHead& head = session.head;
        const std::string subject = "sub-" + label(head.participant);
        participants +=
            fmt::format("{}\t{}\t{}\t{}\n", subject, tabbed(head.group), tabbed(head.language), tabbed(head.started));
        for (const Record& record : session.records)
        {
            const std::vector<std::string> cells = cellsOf(record);
            answers +=
                fmt::format("{},{},{},", csvField(head.participant), csvField(head.group), csvField(record.block));
            answers += lineOf(cells, ',', [](const std::string& cell) { return csvField(cell); });
            std::string& table = bids[fmt::format("bids/{0}/beh/{0}_task-{1}_beh.tsv", subject, label(record.block))];
            if (table.empty())
                table = lineOf(answerColumns, '\t', [](const char* column) { return std::string(column); });
            table += lineOf(cells, '\t', tabbed);
        }
    }
    std::string thresholds = "participant,group,block,stimulus,value,strength_db,sd_db,low_db,high_db,trials\n";
    for (const PersonalThreshold& one : results.thresholds)
        thresholds +=
            fmt::format("{},{},{},{},{},{},{},{},{},{}\n", csvField(one.participant), csvField(one.group),
                        csvField(one.block), csvField(one.stimulus), one.value, one.estimate.strength, one.estimate.sd,
                        one.estimate.strength95.low, one.estimate.strength95.high, one.trials);
    std::vector<std::pair<std::string, std::string>> files{{"answers.csv", std::move(answers)},
                                                           {"ratings.csv", ratingsCsv(results.ratings)}};
    if (!results.thresholds.empty())
        files.emplace_back("thresholds.csv", std::move(thresholds));
    const nlohmann::ordered_json description{{"Name", results.study.name},
                                             {"BIDSVersion", "1.9.0"},
                                             {"DatasetType", "raw"},
                                             {"GeneratedBy", {{{"Name", "Pacini"}}}}};
    files.emplace_back("bids/dataset_description.json", description.dump(2) + "\n");
    files.emplace_back("bids/participants.tsv", std::move(participants));
    for (auto& [name, text] : bids)
        files.emplace_back(name, std::move(text));
    return files;
}

} // namespace pacini::study
