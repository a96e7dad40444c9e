#include "cli/study/TaskSections.h"

#include "study/StudyFields.h"
#include "study/statistics/Correlation.h"
#include "study/statistics/Proportion.h"
#include "study/statistics/TwoSamples.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>

namespace pacini::cli
{

namespace
{
using namespace study;
using TaskJson = nlohmann::ordered_json;

/// The last answer of each person: who continues after a stop answers once.
std::map<Person, std::string> lastAnswers(const StudyResults& results, const std::string& block,
                                          const std::string& item)
{
    std::map<Person, std::string> answers;
    for (const ItemAnswer& one : results.items)
        if (one.block == block && one.item == item)
            answers[{one.group, one.participant}] = one.answer;
    return answers;
}

bool isNumeric(const Item& item)
{
    return item.kind == QuestionKind::number || item.kind == QuestionKind::likert;
}

std::map<Person, double> numbersOf(const std::map<Person, std::string>& answers)
{
    std::map<Person, double> numbers;
    for (const auto& [person, answer] : answers)
        if (const auto number = parseNumber<double>(answer))
            numbers[person] = *number;
    return numbers;
}

/// Of one group, or of everybody for none.
template <typename Value>
std::vector<Value> valuesOf(const std::map<Person, Value>& values, const std::optional<std::string>& group)
{
    std::vector<Value> own;
    for (const auto& [person, value] : values)
        if (!group || person.first == *group)
            own.push_back(value);
    return own;
}

/// The groups of a study and, if there are several, everybody.
std::vector<std::optional<std::string>> columnsOf(const Study& study)
{
    std::vector<std::optional<std::string>> columns;
    for (const Group& group : study.groups)
        columns.emplace_back(group.name);
    if (columns.size() > 1)
        columns.emplace_back();
    return columns;
}

std::string questionOf(const Item& item)
{
    return fmt::format("{}: {}", item.name, inLanguage(item.question, "en"));
}

std::string choiceText(const ItemChoice& choice)
{
    return choice.text.empty() ? choice.name : std::string(inLanguage(choice.text, "en"));
}

void writeQuestionnaire(ReportWriter& writer, TaskJson& json, const StudyResults& results, const Block& block)
{
    const auto columns = columnsOf(results.study);
    PageTable numbers{"Numbers: one answer of each person", {"Question"}, {}};
    PageTable choices{"Choices: people, and their share of those who answered", {"Question", "Answer"}, {}};
    PageTable texts{"Free answers", {"Question", "People", "Answers"}, {}};
    for (const auto& group : columns)
    {
        const std::string title = group ? groupTitle(*group) : "All";
        numbers.columns.insert(numbers.columns.end(), {title + " n", "Mean", "SD", "Range"});
        choices.columns.insert(choices.columns.end(), {title + " n", "%"});
    }
    for (const Item& item : block.items)
    {
        const auto answers = lastAnswers(results, block.name, item.name);
        TaskJson& entry = json[item.name];
        entry["n"] = answers.size();
        if (isNumeric(item))
        {
            std::vector<std::string> row{questionOf(item)};
            const auto values = numbersOf(answers);
            for (const auto& group : columns)
            {
                const SampleSummary sample = summaryOf(valuesOf(values, group));
                row.push_back(fmt::to_string(sample.count));
                if (sample.count == 0)
                    row.insert(row.end(), {"", "", ""});
                else
                    row.insert(row.end(), {decimalText(sample.mean, 2), sdText(sample, 2),
                                           fmt::format("{} to {}", sample.lowest, sample.highest)});
                if (group)
                    entry["groups"][*group] = summaryJson(sample);
            }
            entry.update(summaryJson(summaryOf(valuesOf(values, std::nullopt))));
            numbers.rows.push_back(std::move(row));
        }
        else if (item.kind == QuestionKind::choice)
            for (const ItemChoice& choice : item.choices)
            {
                std::vector<std::string> row{questionOf(item), choiceText(choice)};
                for (const auto& group : columns)
                {
                    const auto own = valuesOf(answers, group);
                    const auto count = std::count(own.begin(), own.end(), choice.name);
                    row.push_back(fmt::to_string(count));
                    row.push_back(
                        own.empty()
                            ? ""
                            : decimalText(100.0 * static_cast<double>(count) / static_cast<double>(own.size()), 1));
                    if (group)
                        entry["groups"][*group][choice.name] = count;
                    if (!group || columns.size() == 1)
                        entry["counts"][choice.name] = count;
                }
                choices.rows.push_back(std::move(row));
            }
        else
        {
            constexpr std::size_t mostShown = 30;
            std::map<std::string, std::size_t> counts;
            for (const auto& [person, answer] : answers)
                ++counts[answer];
            std::vector<std::string> shown;
            for (const auto& [answer, count] : counts)
                if (shown.size() < mostShown)
                    shown.push_back(count == 1 ? answer : fmt::format("{} ({})", answer, count));
            entry["answers"] = counts;
            texts.rows.push_back(
                {questionOf(item), fmt::to_string(answers.size()),
                 fmt::format("{}{}", fmt::join(shown, ", "), counts.size() > mostShown ? " ..." : "")});
        }
    }
    writer.table(std::move(numbers));
    writer.table(std::move(choices));
    writer.table(std::move(texts));
}
} // namespace

void writeQuestionnaires(ReportWriter& writer, nlohmann::ordered_json& json, const StudyResults& results)
{
    for (const Block& block : results.study.blocks)
        if (block.task == Task::questionnaire)
        {
            writer.heading(2, block.name);
            writeQuestionnaire(writer, json["questionnaires"][block.name], results, block);
        }
}

std::vector<PersonalMeasure> measuresOf(const StudyResults& results)
{
    std::vector<PersonalMeasure> measures;
    for (const Block& block : results.study.blocks)
    {
        std::map<Person, std::vector<double>> values;
        std::string kind;
        for (const PersonalThreshold& one : results.thresholds)
            if (one.block == block.name)
            {
                values[{one.group, one.participant}].push_back(one.estimate.strength);
                kind = "threshold, dB";
            }
        for (const PlaceAnswer& one : results.places)
            if (one.block == block.name)
            {
                values[{one.group, one.participant}].push_back(std::abs(one.felt - one.place));
                kind = "absolute error";
            }
        for (const PersonalChoices& one : results.choices)
            if (one.block == block.name)
                for (std::size_t i = 0; i < one.trials; ++i)
                {
                    values[{one.group, one.participant}].push_back(i < one.right ? 1.0 : 0.0);
                    kind = "share right";
                }
        if (values.empty())
            continue;
        PersonalMeasure measure{fmt::format("{}, {}", block.name, kind), {}};
        for (const auto& [person, own] : values)
            measure.values[person] = meanOf(own);
        measures.push_back(std::move(measure));
    }
    return measures;
}

PersonalMeasure meanRatings(const std::string& title, const std::vector<Rating>& ratings)
{
    std::map<Person, std::vector<double>> values;
    for (const Rating& one : ratings)
        values[{one.group, one.participant}].push_back(one.value);
    PersonalMeasure measure{title + ", mean rating", {}};
    for (const auto& [person, own] : values)
        measure.values[person] = meanOf(own);
    return measure;
}

void writeCovariates(ReportWriter& writer, nlohmann::ordered_json& json, const StudyResults& results,
                     const std::vector<PersonalMeasure>& measures)
{
    constexpr std::size_t fewest = 4; // people: of fewer there is no interval
    struct Row
    {
        std::string question, measure;
        Correlation found;
    };
    std::vector<Row> rows;
    for (const Block& block : results.study.blocks)
        for (const Item& item : block.items)
        {
            if (!isNumeric(item))
                continue;
            const auto numbers = numbersOf(lastAnswers(results, block.name, item.name));
            for (const PersonalMeasure& measure : measures)
            {
                std::vector<double> answers, values;
                for (const auto& [person, number] : numbers)
                    if (const auto other = measure.values.find(person); other != measure.values.end())
                    {
                        answers.push_back(number);
                        values.push_back(other->second);
                    }
                if (answers.size() >= fewest)
                    rows.push_back({item.name, measure.name, correlationOf(answers, values)});
            }
        }
    if (rows.empty())
        return;
    std::vector<double> ps;
    for (const Row& row : rows)
        ps.push_back(row.found.p);
    const std::vector<double> corrected = holm(ps);
    PageTable table{"Pearson's correlation over people, with Fisher's interval; Holm over all lines of this table",
                    {"Question", "Result", "People", "r", "95 %", "p", "p, Holm"},
                    {}};
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        const Correlation& found = rows[i].found;
        table.rows.push_back({rows[i].question, rows[i].measure, fmt::to_string(found.n), signedText(found.r, 2),
                              intervalText(found.r95, 2), pText(found.p), pText(corrected[i])});
        json["covariates"].push_back({{"question", rows[i].question},
                                      {"result", rows[i].measure},
                                      {"n", found.n},
                                      {"r", found.r},
                                      {"r95", {found.r95.low, found.r95.high}},
                                      {"slope", found.slope},
                                      {"p", found.p},
                                      {"holm", corrected[i]}});
    }
    writer.method(
        "Numbers in questionnaires were correlated with results over people (Pearson, with Fisher's interval), "
        "with Holm's correction over all correlations.");
    writer.heading(2, "Questionnaires and results");
    writer.table(std::move(table));
}

namespace
{
std::string_view lawName(PanLaw law)
{
    constexpr std::array names{"level", "delay", "both"};
    return names[static_cast<std::size_t>(law)];
}

/// Answers of one person to touches that are placed in one way.
struct LawAnswers
{
    std::vector<double> places, felt, errors;
};

void writeLaws(ReportWriter& writer, TaskJson& json, const std::map<PanLaw, std::map<Person, LawAnswers>>& laws)
{
    PageTable table{"Ways of placing, by one mean for each person. The slope of the felt on the real place is 1 where "
                    "all of the row is felt and 0 where one place is like the other",
                    {"By", "People", "Absolute error", "95 %", "SD", "Slope", "95 %", "SD"},
                    {}};
    std::map<PanLaw, std::map<Person, double>> errors;
    for (const auto& [law, people] : laws)
    {
        std::vector<double> means, slopes;
        for (const auto& [person, answers] : people)
        {
            means.push_back(meanOf(answers.errors));
            errors[law][person] = means.back();
            slopes.push_back(correlationOf(answers.places, answers.felt).slope);
        }
        const SampleSummary error = summaryOf(means), slope = summaryOf(slopes);
        table.rows.push_back({std::string(lawName(law)), fmt::to_string(error.count), decimalText(error.mean, 2),
                              meanIntervalText(error, 2), sdText(error, 2), decimalText(slope.mean, 2),
                              meanIntervalText(slope, 2), sdText(slope, 2)});
        json["ways"][std::string(lawName(law))] = {{"absoluteError", summaryJson(error)},
                                                   {"slope", summaryJson(slope)}};
    }
    writer.table(std::move(table));
    PageTable compared{"Ways of placing compared by the absolute errors of each person (paired t-test, Wilcoxon); Holm "
                       "over all lines of this table",
                       {"By", "Difference", "95 %", "t", "df", "p", "p, Holm", "p, Wilcoxon"},
                       {}};
    std::vector<std::pair<std::string, TTest>> tests;
    std::vector<double> ps, ranks;
    for (auto first = errors.begin(); first != errors.end(); ++first)
        for (auto second = std::next(first); second != errors.end(); ++second)
        {
            std::vector<double> a, b;
            for (const auto& [person, error] : first->second)
                if (const auto other = second->second.find(person); other != second->second.end())
                {
                    a.push_back(error);
                    b.push_back(other->second);
                }
            if (a.size() < 2)
                continue;
            tests.emplace_back(fmt::format("{} - {}", lawName(first->first), lawName(second->first)),
                               pairedTTest(a, b));
            ps.push_back(tests.back().second.p);
            ranks.push_back(signedRanks(a, b).p);
        }
    const std::vector<double> corrected = holm(ps);
    for (std::size_t i = 0; i < tests.size(); ++i)
    {
        const TTest& test = tests[i].second;
        compared.rows.push_back({tests[i].first, signedText(test.difference, 2), intervalText(test.difference95, 2),
                                 decimalText(test.t, 2), decimalText(test.degrees, 0), pText(test.p),
                                 pText(corrected[i]), pText(ranks[i])});
        json["comparisons"].push_back({{"ways", tests[i].first},
                                       {"difference", test.difference},
                                       {"t", test.t},
                                       {"degrees", test.degrees},
                                       {"p", test.p},
                                       {"holm", corrected[i]},
                                       {"wilcoxonP", ranks[i]}});
    }
    if (!tests.empty())
        writer.method("Ways of placing were compared by the mean absolute error of each person (paired t-test; also "
                      "Wilcoxon's signed ranks), with Holm's correction over all pairs of them.");
    writer.table(std::move(compared));
}
} // namespace

Result<void> writePlaces(ReportWriter& writer, nlohmann::ordered_json& json, const StudyResults& results)
{
    for (const Block& block : results.study.blocks)
    {
        if (block.task != Task::place)
            continue;
        PageTable table{
            "Where touches were felt, in the units of the scale. People are the sample: several answers of "
            "one count as their mean. SD of one: of the answers of one person, the mean of all",
            {"Stimulus", "By", "Place", "People", "Felt", "95 %", "SD", "SD of one", "Error", "Absolute error"},
            {}};
        std::vector<NamedInterval> shown;
        std::map<PanLaw, std::map<Person, LawAnswers>> laws;
        TaskJson ofBlock;
        for (const std::size_t index : stimuliOf(results.study, block))
        {
            const Stimulus& stimulus = results.study.stimuli[index];
            std::map<Person, std::vector<double>> felt;
            double place = 0.0;
            for (const PlaceAnswer& one : results.places)
                if (one.block == block.name && one.stimulus == stimulus.name && stimulus.place)
                {
                    const Person person{one.group, one.participant};
                    place = one.place;
                    felt[person].push_back(one.felt);
                    LawAnswers& answers = laws[stimulus.place->by][person];
                    answers.places.push_back(one.place);
                    answers.felt.push_back(one.felt);
                    answers.errors.push_back(std::abs(one.felt - one.place));
                }
            if (felt.empty())
                continue;
            std::vector<double> means, spreads, errors;
            for (const auto& [person, own] : felt)
            {
                means.push_back(meanOf(own));
                if (own.size() > 1)
                    spreads.push_back(sdOf(own));
                double sum = 0.0;
                for (const double one : own)
                    sum += std::abs(one - place);
                errors.push_back(sum / static_cast<double>(own.size()));
            }
            const SampleSummary sample = summaryOf(means);
            shown.push_back({stimulus.name, sample.mean, sample.mean95});
            table.rows.push_back({stimulus.name, std::string(lawName(stimulus.place->by)), decimalText(place, 1),
                                  fmt::to_string(sample.count), decimalText(sample.mean, 1),
                                  meanIntervalText(sample, 1), sdText(sample, 2),
                                  spreads.empty() ? "" : decimalText(meanOf(spreads), 2),
                                  signedText(sample.mean - place, 1), decimalText(meanOf(errors), 2)});
            TaskJson entry{{"by", lawName(stimulus.place->by)}, {"place", place}};
            entry.update(summaryJson(sample));
            entry["error"] = sample.mean - place;
            entry["absoluteError"] = meanOf(errors);
            if (!spreads.empty())
                entry["sdOfOne"] = meanOf(spreads);
            ofBlock["stimuli"][stimulus.name] = std::move(entry);
        }
        if (shown.empty())
            continue;
        writer.heading(2, block.name);
        if (auto drawn = writer.picture(fileNameOf(block.name) + "-places.svg", "Felt places of " + block.name,
                                        intervalPlot(shown, block.name, "Felt place", pictureStyle));
            !drawn)
            return drawn;
        writer.table(std::move(table));
        writeLaws(writer, ofBlock, laws);
        json[block.name] = std::move(ofBlock);
    }
    return {};
}

namespace
{
std::string percentText(std::size_t count, std::size_t all)
{
    return all == 0 ? "" : decimalText(100.0 * static_cast<double>(count) / static_cast<double>(all), 1);
}

/// Share of right answers for each number of events.
void writeByNumber(ReportWriter& writer, TaskJson& json, const StudyResults& results, const Block& block)
{
    std::map<int, std::map<Person, CountedAnswers>> byNumber;
    for (const EventAnswer& one : results.events)
        if (const std::size_t index = stimulusNamed(results.study, one.stimulus);
            one.block == block.name && index != noStimulus)
        {
            CountedAnswers& own = byNumber[eventsIn(results.study.stimuli[index])][{one.group, one.participant}];
            own.right += one.choice == rightAnswer(results.study, block, index) ? 1u : 0u;
            ++own.all;
        }
    const double guess = guessOf(results.study, block);
    PageTable table{"Right answers by the number of events at once; people are the sample (Korn and Graubard 1998)",
                    {"Events", "People", "Right", "Of", "%", "95 %", "By guessing, %", "Beyond chance"},
                    {}};
    for (const auto& [number, byPerson] : byNumber)
    {
        std::vector<CountedAnswers> people;
        for (const auto& [person, own] : byPerson)
            people.push_back(own);
        const Proportion found = proportionOf(people);
        table.rows.push_back({fmt::to_string(number), fmt::to_string(people.size()), fmt::to_string(found.right),
                              fmt::to_string(found.all), decimalText(100.0 * found.share, 1),
                              intervalText({100.0 * found.share95.low, 100.0 * found.share95.high}, 1),
                              decimalText(100.0 * guess, 1), found.share95.low > guess ? "yes" : "no"});
        json["byNumber"][fmt::to_string(number)] = {{"people", people.size()},
                                                    {"right", found.right},
                                                    {"trials", found.all},
                                                    {"share", found.share},
                                                    {"share95", {found.share95.low, found.share95.high}},
                                                    {"guessing", guess}};
    }
    writer.table(std::move(table));
}

void writeCounts(ReportWriter& writer, TaskJson& json, const StudyResults& results, const Block& block)
{
    const std::vector<int> offered = countsOf(results.study, block);
    std::map<int, std::map<int, std::size_t>> confusions; // of the number of events with the answer
    std::map<int, std::size_t> sums;
    for (const EventAnswer& one : results.events)
        if (const std::size_t index = stimulusNamed(results.study, one.stimulus);
            one.block == block.name && index != noStimulus)
        {
            const int number = eventsIn(results.study.stimuli[index]);
            ++confusions[number][one.choice];
            ++sums[number];
        }
    PageTable table{"Confusions: share of the answers (columns) to each number of events (lines), %", {"Events"}, {}};
    for (const int answer : offered)
        table.columns.push_back(fmt::format("\"{}\"", answer));
    for (const auto& [number, answers] : confusions)
    {
        std::vector<std::string> row{fmt::to_string(number)};
        for (const int answer : offered)
        {
            const auto found = answers.find(answer);
            const std::size_t count = found == answers.end() ? 0 : found->second;
            row.push_back(percentText(count, sums[number]));
            json["confusions"][fmt::to_string(number)][fmt::to_string(answer)] = count;
        }
        table.rows.push_back(std::move(row));
    }
    writer.table(std::move(table));
}

void writeWhich(ReportWriter& writer, TaskJson& json, const StudyResults& results, const Block& block)
{
    const std::vector<std::size_t> events = eventsOf(results.study, block);
    PageTable confusions{"How often each event (columns) was named when a stimulus (lines) was felt, %; what was there "
                         "is marked with *",
                         {"Stimulus", "Answers"},
                         {}};
    PageTable table{"Each event: how often it was named where it was there, by the number of events at once, and where "
                    "it was not (false alarms), %",
                    {"Event"},
                    {}};
    std::set<int> numbers;
    struct Named
    {
        std::size_t named = 0, all = 0;
    };
    std::vector<std::map<int, Named>> hits(events.size());
    std::vector<Named> falseAlarms(events.size());
    for (const std::size_t event : events)
        confusions.columns.push_back(results.study.stimuli[event].name);
    for (const std::size_t index : stimuliOf(results.study, block))
    {
        const Stimulus& stimulus = results.study.stimuli[index];
        const int there = rightAnswer(results.study, block, index), number = eventsIn(stimulus);
        std::vector<std::size_t> counts(events.size(), 0);
        std::size_t all = 0;
        for (const EventAnswer& one : results.events)
        {
            if (one.block != block.name || one.stimulus != stimulus.name)
                continue;
            ++all;
            for (std::size_t i = 0; i < events.size(); ++i)
            {
                const std::size_t named = (one.choice >> i & 1) != 0 ? 1u : 0u;
                counts[i] += named;
                Named& sum = (there >> i & 1) != 0 ? hits[i][number] : falseAlarms[i];
                sum.named += named;
                ++sum.all;
            }
        }
        if (all == 0)
            continue;
        if (number > 0)
            numbers.insert(number);
        std::vector<std::string> row{stimulus.name, fmt::to_string(all)};
        for (std::size_t i = 0; i < events.size(); ++i)
        {
            row.push_back(percentText(counts[i], all) + ((there >> i & 1) != 0 ? " *" : ""));
            json["confusions"][stimulus.name][results.study.stimuli[events[i]].name] = counts[i];
        }
        json["confusions"][stimulus.name]["answers"] = all;
        confusions.rows.push_back(std::move(row));
    }
    for (const int number : numbers)
        table.columns.push_back(number == 1 ? std::string("alone") : fmt::format("of {}", number));
    table.columns.emplace_back("false alarms");
    for (std::size_t i = 0; i < events.size(); ++i)
    {
        const std::string& name = results.study.stimuli[events[i]].name;
        std::vector<std::string> row{name};
        for (const int number : numbers)
        {
            row.push_back(percentText(hits[i][number].named, hits[i][number].all));
            json["named"][name][fmt::to_string(number)] = {hits[i][number].named, hits[i][number].all};
        }
        row.push_back(percentText(falseAlarms[i].named, falseAlarms[i].all));
        json["named"][name]["falseAlarms"] = {falseAlarms[i].named, falseAlarms[i].all};
        table.rows.push_back(std::move(row));
    }
    if (confusions.rows.empty())
        return;
    writer.table(std::move(table));
    writer.table(std::move(confusions));
}
} // namespace

void writeEvents(ReportWriter& writer, nlohmann::ordered_json& json, const StudyResults& results)
{
    for (const Block& block : results.study.blocks)
    {
        const bool any = std::any_of(results.events.begin(), results.events.end(),
                                     [&](const EventAnswer& one) { return one.block == block.name; });
        if (!any)
            continue;
        writer.heading(2, block.name);
        TaskJson& entry = json[block.name];
        writer.method(
            "Shares of right answers had Wilson's (1927) interval for the effective number of answers (Korn and "
            "Graubard 1998), at 95 %.");
        writeByNumber(writer, entry, results, block);
        if (block.task == Task::count)
            writeCounts(writer, entry, results, block);
        else
            writeWhich(writer, entry, results, block);
    }
}

void writeClasses(ReportWriter& writer, nlohmann::ordered_json& json, const Study& study,
                  const std::vector<Rating>& ratings, const std::string& title)
{
    // Classes in the order of Schaeffer's table, then masses, factures and tags.
    std::map<std::pair<int, std::string>, std::set<std::string>> classes; // names of stimuli
    for (const Stimulus& one : study.stimuli)
        for (const auto& [order, name] : classesOf(one))
            classes[{order, name}].insert(one.name);
    PageTable table{"By class of stimuli: the mean of each person over the stimuli of a class",
                    {"Class", "Stimuli", "People", "Mean", "95 %", "SD"},
                    {}};
    for (const auto& [key, names] : classes)
    {
        std::map<Person, std::vector<double>> values;
        std::set<std::string> rated;
        for (const Rating& one : ratings)
            if (names.contains(one.stimulus))
            {
                values[{one.group, one.participant}].push_back(one.value);
                rated.insert(one.stimulus);
            }
        if (values.empty())
            continue;
        std::vector<double> means;
        for (const auto& [person, own] : values)
            means.push_back(meanOf(own));
        const SampleSummary sample = summaryOf(means);
        table.rows.push_back({key.second, fmt::to_string(rated.size()), fmt::to_string(sample.count),
                              decimalText(sample.mean, 2), meanIntervalText(sample, 2), sdText(sample, 2)});
        json[title][key.second] = summaryJson(sample);
        json[title][key.second]["stimuli"] = rated.size();
    }
    writer.table(std::move(table));
}

} // namespace pacini::cli
