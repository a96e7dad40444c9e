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

/// A question, and its column in the table of participants.
struct ItemColumn
{
    const Block* block;
    const Item* item;
    std::string title;
};

/// All questions in the order of the study; two of the same name have that of their block before theirs.
std::vector<ItemColumn> itemColumns(const Study& study)
{
    std::vector<ItemColumn> columns;
    std::map<std::string, int> counts;
    for (const Block& block : study.blocks)
        for (const Item& item : block.items)
        {
            columns.push_back({&block, &item, tabbed(item.name)});
            ++counts[item.name];
        }
    for (ItemColumn& column : columns)
        if (counts[column.item->name] > 1)
            column.title = tabbed(column.block->name) + '.' + column.title;
    return columns;
}

std::string answerOf(const StudyResults& results, const std::string& participant, const ItemColumn& column)
{
    for (const ItemAnswer& one : results.items)
        if (one.participant == participant && one.block == column.block->name && one.item == column.item->name)
            return one.answer;
    return {};
}

std::string questionnairesCsv(const StudyResults& results)
{
    std::string text = "participant,group,block,item,answer\n";
    for (const ItemAnswer& one : results.items)
        text += fmt::format("{},{},{},{},{}\n", csvField(one.participant), csvField(one.group), csvField(one.block),
                            csvField(one.item), csvField(one.answer));
    return text;
}

/// What the columns of the table of participants are, as BIDS describes them.
std::string participantsJson(const std::vector<ItemColumn>& columns)
{
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const ItemColumn& column : columns)
    {
        auto& entry = json[column.title];
        entry["Description"] = inLanguage(column.item->question, "en");
        for (const ItemChoice& choice : column.item->choices)
            entry["Levels"][choice.name] = choice.text.empty() ? choice.name : inLanguage(choice.text, "en");
    }
    return json.dump(2) + "\n";
}
} // namespace

std::vector<std::pair<std::string, std::string>> exportedFiles(const StudyResults& results)
{
    std::string answers = "participant,group,block";
    for (const char* column : answerColumns)
        answers += std::string(",") + column;
    answers += '\n';
    std::map<std::string, std::string> bids;
    const std::vector<ItemColumn> items = itemColumns(results.study);
    std::string participants = "participant_id\tgroup\tlanguage\tstarted";
    for (const ItemColumn& column : items)
        participants += '\t' + column.title;
    participants += '\n';
    for (const LoggedSession& session : results.sessions)
    {
        const SessionHead& head = session.head;
        const std::string subject = "sub-" + label(head.participant);
        participants +=
            fmt::format("{}\t{}\t{}\t{}", subject, tabbed(head.group), tabbed(head.language), tabbed(head.started));
        for (const ItemColumn& column : items)
            participants += '\t' + tabbed(answerOf(results, head.participant, column));
        participants += '\n';
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
    if (!items.empty())
    {
        files.emplace_back("questionnaires.csv", questionnairesCsv(results));
        files.emplace_back("bids/participants.json", participantsJson(items));
    }
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
