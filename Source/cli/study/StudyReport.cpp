#include "cli/study/StudyReport.h"

#include "cli/Console.h"
#include "cli/Counted.h"
#include "cli/study/MethodsSection.h"
#include "cli/study/MixedModel.h"
#include "cli/study/ReportWriter.h"
#include "cli/study/StudyFigures.h"
#include "cli/study/TaskSections.h"
#include "study/Exposure.h"
#include "study/StudyFields.h"
#include "study/statistics/Proportion.h"
#include "study/statistics/Scaling.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace pacini::cli
{

namespace
{
using namespace study;
using Json = nlohmann::ordered_json;

/// The part of a summary that says something of places in an order.
Json jsonOfPlaces(const SampleSummary& sample)
{
    return {{"n", sample.count},
            {"mean", sample.mean},
            {"median", sample.median},
            {"quartiles", {sample.lowerQuartile, sample.upperQuartile}},
            {"range", {sample.lowest, sample.highest}}};
}

/// A t beyond all numbers, of samples without variance, is null.
Json jsonOf(const TTest& test)
{
    return {{"difference", test.difference},
            {"t", test.t},
            {"degrees", test.degrees},
            {"sd", test.sd},
            {"p", test.p},
            {"difference95", {test.difference95.low, test.difference95.high}}};
}

/// The groups that tables show side by side: those of the study, and all together.
std::vector<const GroupRatings*> shownGroups(const RatingAnalysis& analysis)
{
    std::vector<const GroupRatings*> groups;
    for (std::size_t i = 0; i < analysis.plainGroups; ++i)
        groups.push_back(&analysis.groups[i]);
    if (analysis.plainGroups > 1)
        groups.push_back(&analysis.everybody);
    return groups;
}

std::string columnTitle(const RatingAnalysis& analysis, const GroupRatings& group)
{
    return &group == &analysis.everybody ? "All" : groupTitle(group.name);
}

PageTable meansTable(const RatingAnalysis& analysis)
{
    PageTable table{"Mean, standard deviation and 95 % interval of the mean. People are the sample: several answers of "
                    "one count as their mean. Last line: all answers, which are no sample of people",
                    {"Stimulus"},
                    {}};
    const auto groups = shownGroups(analysis);
    for (const GroupRatings* group : groups)
        table.columns.insert(table.columns.end(), {columnTitle(analysis, *group) + " mean", "SD", "95 %"});
    const auto row = [&](const std::string& name, bool withInterval, auto valuesOf)
    {
        std::vector<std::string> cells{name};
        for (const GroupRatings* group : groups)
        {
            const SampleSummary sample = summaryOf(valuesOf(*group));
            if (sample.count == 0)
                cells.insert(cells.end(), {"", "", ""});
            else
                cells.insert(cells.end(), {decimalText(sample.mean, 2), sdText(sample, 2),
                                           withInterval ? meanIntervalText(sample, 2) : ""});
        }
        table.rows.push_back(std::move(cells));
    };
    for (std::size_t i = 0; i < analysis.stimuli.size(); ++i)
        row(analysis.stimuli[i], true, [i](const GroupRatings& group) { return group.byStimulus[i]; });
    row("Mean of each person", true, [](const GroupRatings& group) { return group.participantMeans; });
    row("All answers", false, [](const GroupRatings& group) { return group.all; });
    return table;
}

PageTable placesTable(const RatingAnalysis& analysis)
{
    PageTable table{"Places: median, quartiles and mean of what each person gave", {"Stimulus"}, {}};
    const auto groups = shownGroups(analysis);
    for (const GroupRatings* group : groups)
        table.columns.insert(table.columns.end(), {columnTitle(analysis, *group) + " median", "Quartiles", "Mean"});
    for (std::size_t i = 0; i < analysis.stimuli.size(); ++i)
    {
        std::vector<std::string> cells{analysis.stimuli[i]};
        for (const GroupRatings* group : groups)
        {
            const SampleSummary sample = summaryOf(group->byStimulus[i]);
            if (sample.count == 0)
                cells.insert(cells.end(), {"", "", ""});
            else
                cells.insert(cells.end(), {decimalText(sample.median, 1),
                                           intervalText({sample.lowerQuartile, sample.upperQuartile}, 2),
                                           decimalText(sample.mean, 2)});
        }
        table.rows.push_back(std::move(cells));
    }
    return table;
}

PageTable participantsTable(const RatingAnalysis& analysis)
{
    PageTable table{
        "Groups compared by a mean for each participant: people are the sample",
        {"Groups", "Difference", "95 %", "t", "df", "p", "p, Holm", "p, Welch", "p, Mann-Whitney", "Hedges' g"},
        {}};
    for (const GroupComparison& one : analysis.comparisons)
        if (one.byParticipant)
            table.rows.push_back({one.first + " - " + one.second, signedText(one.byParticipant->difference, 2),
                                  intervalText(one.byParticipant->difference95, 2),
                                  decimalText(one.byParticipant->t, 2), decimalText(one.byParticipant->degrees, 0),
                                  pText(one.byParticipant->p), pText(one.holm), pText(one.byParticipantWelch->p),
                                  pText(one.byParticipantRanks->p), signedText(one.effect, 2)});
    return table;
}

PageTable stimulusMeansTable(const RatingAnalysis& analysis)
{
    PageTable table{
        "Groups compared by a mean for each stimulus: says something about more stimuli of this kind, not about "
        "more people",
        {"Groups", "Stimuli", "t", "df", "SD", "p", "p, equal variances"},
        {}};
    for (const GroupComparison& one : analysis.comparisons)
        if (one.byStimulus)
            table.rows.push_back({one.first + " - " + one.second, one.stimuliArePaired ? "in pairs" : "independent",
                                  decimalText(one.byStimulus->t, 2), decimalText(one.byStimulus->degrees, 0),
                                  decimalText(one.byStimulus->sd, 2), pText(one.byStimulus->p),
                                  one.stimuliArePaired ? "" : pText(one.byStimulusEqualVarianceP)});
    return table;
}

PageTable eachStimulusTable(const RatingAnalysis& analysis)
{
    PageTable table{"Groups compared for each stimulus, two-sided; corrected over all lines of this table",
                    {"Groups", "Stimulus", "t", "df", "SD", "p", "p, Holm", "p, Bonferroni", "p, Welch",
                     "p, Mann-Whitney", "Hedges' g"},
                    {}};
    for (const GroupComparison& one : analysis.comparisons)
        for (const auto& test : one.stimuli)
            table.rows.push_back({one.first + " - " + one.second, analysis.stimuli[test.stimulus],
                                  decimalText(test.pooled.t, 3), decimalText(test.pooled.degrees, 0),
                                  decimalText(test.pooled.sd, 3), pText(test.pooled.p), pText(test.holm),
                                  pText(test.bonferroni), pText(test.welch.p), pText(test.ranks.p),
                                  signedText(test.effect, 2)});
    return table;
}

/// Places are compared by their ranks alone.
PageTable eachStimulusPlacesTable(const RatingAnalysis& analysis)
{
    PageTable table{
        "Groups compared for each stimulus (Mann-Whitney), two-sided; corrected over all lines of this table",
        {"Groups", "Stimulus", "U", "p", "p, Holm", "p, Bonferroni"},
        {}};
    for (const GroupComparison& one : analysis.comparisons)
        for (const auto& test : one.stimuli)
            table.rows.push_back({one.first + " - " + one.second, analysis.stimuli[test.stimulus],
                                  decimalText(test.ranks.u, 1), pText(test.ranks.p), pText(test.holm),
                                  pText(test.bonferroni)});
    return table;
}

constexpr double level = 0.05;

/// Only what differs: of many stimuli all pairs would be no table that anybody reads. They are in the JSON.
PageTable pairsTable(const RatingAnalysis& analysis)
{
    const bool places = analysis.kind == AnswerKind::places;
    PageTable table{
        fmt::format("Stimuli that differ at 5 % after Holm's correction over all pairs, by the participants "
                    "who answered for both ({})",
                    places ? "Wilcoxon's signed ranks" : "paired t-tests; Wilcoxon's signed ranks"),
        {"Stimuli", "Difference"},
        {}};
    const auto more = places ? std::vector<std::string>{"Participants", "W", "p", "p, Holm"}
                             : std::vector<std::string>{"95 %", "t", "df", "p", "p, Holm", "p, Wilcoxon"};
    table.columns.insert(table.columns.end(), more.begin(), more.end());
    for (const StimulusComparison& one : analysis.pairs)
    {
        if (one.holm > level)
            continue;
        auto& row = table.rows.emplace_back();
        row = {analysis.stimuli[one.first] + " - " + analysis.stimuli[one.second],
               signedText(one.paired.difference, 2)};
        const auto cells =
            places ? std::vector<std::string>{decimalText(one.paired.degrees + 1.0, 0), decimalText(one.ranks.w, 1),
                                              pText(one.ranks.p), pText(one.holm)}
                   : std::vector<std::string>{intervalText(one.paired.difference95, 2),
                                              decimalText(one.paired.t, 2),
                                              decimalText(one.paired.degrees, 0),
                                              pText(one.paired.p),
                                              pText(one.holm),
                                              pText(one.ranks.p)};
        row.insert(row.end(), cells.begin(), cells.end());
    }
    return table;
}

/// What the tests amount to, in sentences.
void writeFindings(ReportWriter& writer, const RatingAnalysis& analysis)
{
    std::string text;
    for (const GroupComparison& one : analysis.comparisons)
        if (!one.combined && one.byParticipant)
            text += fmt::format("{} and {} {} ({}, after Holm {}). ", one.first, one.second,
                                one.holm <= level ? "differ" : "do not differ beyond chance",
                                pSaid(one.byParticipant->p), pText(one.holm));
    std::size_t tests = 0, below = 0, left = 0;
    for (const GroupComparison& one : analysis.comparisons)
        for (const auto& test : one.stimuli)
        {
            ++tests;
            below += (analysis.kind == AnswerKind::places ? test.ranks.p : test.pooled.p) <= level ? 1u : 0u;
            left += test.holm <= level ? 1u : 0u;
        }
    if (tests > 0)
        text += fmt::format(
            "Of {} tests of single stimuli {} are at or below .05 by themselves, {} after Holm's correction; "
            "{:.0f} would be by chance alone. ",
            tests, below, left, static_cast<double>(tests) * level);
    if (!analysis.pairs.empty())
        text += fmt::format("Of {} pairs of stimuli {} differ after Holm's correction.", analysis.pairs.size(),
                            std::count_if(analysis.pairs.begin(), analysis.pairs.end(),
                                          [](const StimulusComparison& one) { return one.holm <= level; }));
    if (text.ends_with(' '))
        text.pop_back();
    if (!text.empty())
        writer.paragraph(text);
    for (const std::string& doubt : analysis.doubts)
        writer.paragraph("Note: " + doubt + ".");
}

Json jsonOf(const GroupComparison& one, const RatingAnalysis& analysis)
{
    const bool places = analysis.kind == AnswerKind::places;
    Json entry{{"first", one.first}, {"second", one.second}};
    if (one.byParticipant)
        entry["byParticipant"] = {{"pooled", jsonOf(*one.byParticipant)},
                                  {"welch", jsonOf(*one.byParticipantWelch)},
                                  {"mannWhitneyP", one.byParticipantRanks->p},
                                  {"hedgesG", one.effect},
                                  {"holm", one.holm}};
    if (one.byStimulus)
    {
        entry["byStimulus"] = jsonOf(*one.byStimulus);
        entry["byStimulus"]["paired"] = one.stimuliArePaired;
        if (!one.stimuliArePaired)
            entry["byStimulus"]["equalVarianceP"] = one.byStimulusEqualVarianceP;
    }
    Json stimuli = Json::object();
    for (const auto& test : one.stimuli)
    {
        Json ofStimulus = places ? Json{{"u", test.ranks.u}} : jsonOf(test.pooled);
        if (!places)
        {
            ofStimulus["welchP"] = test.welch.p;
            ofStimulus["hedgesG"] = test.effect;
        }
        ofStimulus["mannWhitneyP"] = test.ranks.p;
        ofStimulus["holm"] = test.holm;
        ofStimulus["bonferroni"] = test.bonferroni;
        stimuli[analysis.stimuli[test.stimulus]] = std::move(ofStimulus);
    }
    entry["stimuli"] = std::move(stimuli);
    return entry;
}

Json jsonOf(const RatingAnalysis& analysis)
{
    const bool places = analysis.kind == AnswerKind::places;
    Json groups = Json::array();
    const auto groupJson = [&](const GroupRatings& group)
    {
        Json stimuli = Json::object();
        for (std::size_t i = 0; i < analysis.stimuli.size(); ++i)
            if (!group.byStimulus[i].empty())
                stimuli[analysis.stimuli[i]] =
                    places ? jsonOfPlaces(summaryOf(group.byStimulus[i])) : summaryJson(summaryOf(group.byStimulus[i]));
        Json entry{{"group", group.name}, {"participants", group.participants.size()}};
        if (!places)
        {
            entry["total"] = summaryJson(summaryOf(group.participantMeans));
            const Json answers = summaryJson(summaryOf(group.all));
            entry["answers"] = {{"n", answers["n"]}, {"mean", answers["mean"]}, {"sd", answers["sd"]}};
        }
        entry["stimuli"] = std::move(stimuli);
        return entry;
    };
    for (const GroupRatings& group : analysis.groups)
        groups.push_back(groupJson(group));
    Json comparisons = Json::array();
    for (const GroupComparison& one : analysis.comparisons)
        comparisons.push_back(jsonOf(one, analysis));
    Json pairs = Json::array();
    for (const StimulusComparison& one : analysis.pairs)
    {
        Json entry{{"first", analysis.stimuli[one.first]}, {"second", analysis.stimuli[one.second]}};
        if (places)
            entry.update({{"n", one.paired.degrees + 1.0}, {"difference", one.paired.difference}});
        else
            entry.update(jsonOf(one.paired));
        entry.update({{"wilcoxonW", one.ranks.w}, {"wilcoxonP", one.ranks.p}, {"holm", one.holm}});
        pairs.push_back(std::move(entry));
    }
    Json json{{"groups", std::move(groups)},
              {"everybody", groupJson(analysis.everybody)},
              {"comparisons", std::move(comparisons)},
              {"pairs", std::move(pairs)}};
    if (!places)
        json["icc"] = {{"single", analysis.agreement.single},
                       {"mean", analysis.agreement.mean},
                       {"single95", {analysis.agreement.single95.low, analysis.agreement.single95.high}}};
    json["friedman"] = {{"chiSquared", analysis.order.chiSquared},
                        {"degrees", analysis.order.degrees},
                        {"p", analysis.order.p},
                        {"kendallsW", analysis.order.kendallsW}};
    json["notes"] = analysis.doubts;
    return json;
}

Result<void> writeMixedModel(ReportWriter& writer, Json& json, const std::vector<Rating>& ratings)
{
    const auto model = fitMixedModel(ratings);
    if (!model)
        return model.error();
    const auto table = [&](const char* caption, const std::vector<FixedEffect>& effects, bool stimuli)
    {
        PageTable made{caption, {stimuli ? "Stimulus" : "Group", "Estimate", "SE", "95 %", "p"}, {}};
        Json entries = Json::object();
        for (std::size_t i = 0; i < effects.size(); ++i)
        {
            const FixedEffect& one = effects[i];
            const std::string name = stimuli ? one.name : groupTitle(one.name);
            made.rows.push_back(
                {i == 0 ? name + ", mean" : name + " - " + made.rows[0][0].substr(0, made.rows[0][0].size() - 6),
                 i == 0 ? decimalText(one.estimate, 2) : signedText(one.estimate, 2), decimalText(one.error, 2),
                 intervalText({one.low, one.high}, 2), i == 0 ? "" : pText(one.p)});
            entries[name] = {{"estimate", one.estimate}, {"error", one.error}, {"p", one.p}};
        }
        writer.table(std::move(made));
        return entries;
    };
    json["groups"] =
        table("Mixed model: groups, over participants and stimuli (both random, crossed)", model->groups, false);
    json["stimuli"] = table("Mixed model: stimuli, over participants (random)", model->stimuli, true);
    json["participantVariance"] = model->participantVariance;
    json["stimulusVariance"] = model->stimulusVariance;
    json["residualVariance"] = model->residualVariance;
    json["converged"] = model->converged;
    json["program"] = model->program;
    writer.paragraph(fmt::format("Variance of participants {}, of stimuli {}, of what is left {}; restricted maximum "
                                 "likelihood, Wald tests, by {}.{}",
                                 decimalText(model->participantVariance, 2), decimalText(model->stimulusVariance, 2),
                                 decimalText(model->residualVariance, 2), model->program,
                                 model->converged ? "" : " It did NOT converge: trust none of it."));
    writer.method(fmt::format("Mixed models (restricted maximum likelihood, Wald tests) were fitted by {}: groups over "
                              "people and stimuli, both random and crossed, and stimuli over people.",
                              model->program));
    return {};
}

std::string agreementText(const RatingAnalysis& analysis)
{
    std::string text =
        "Agreement of the " + counted(analysis.everybody.complete.size(), "participant", "participants") + " who ";
    if (analysis.kind == AnswerKind::places)
        text += "ordered everything: ";
    else
        text += fmt::format("rated everything: ICC(2,1) {} (95 %: {}), of their mean ICC(2,k) {}; ",
                            decimalText(analysis.agreement.single, 2), intervalText(analysis.agreement.single95, 2),
                            decimalText(analysis.agreement.mean, 2));
    return text + fmt::format("Kendall's W {}, Friedman's chi-squared({}) = {}, {}.",
                              decimalText(analysis.order.kendallsW, 2), decimalText(analysis.order.degrees, 0),
                              decimalText(analysis.order.chiSquared, 2), pSaid(analysis.order.p));
}

/// How the answers of a block were held against each other, as far as they were.
void tellMethods(ReportWriter& writer, const RatingAnalysis& analysis)
{
    const bool places = analysis.kind == AnswerKind::places;
    const auto any = [&](auto has)
    {
        return std::any_of(analysis.comparisons.begin(), analysis.comparisons.end(), has);
    };
    writer.method("People were the sample: several answers of one person to one stimulus counted as their mean. Tests "
                  "were two-sided.");
    if (!places)
        writer.method("Intervals of means were Student's, at 95 %.");
    if (any([](const GroupComparison& one) { return one.byParticipant.has_value(); }))
        writer.method("Groups were compared by a mean for each person (Student's t-test with pooled variance; also "
                      "Welch's t-test and the Mann-Whitney test; Hedges' g), with Holm's correction over all "
                      "comparisons of a question.");
    if (any([](const GroupComparison& one) { return one.byStimulus && one.stimuliArePaired; }))
        writer.method("Groups were also compared by a mean for each stimulus, in pairs of the same stimulus (paired "
                      "t-test).");
    if (any([](const GroupComparison& one) { return one.byStimulus && !one.stimuliArePaired; }))
        writer.method("Groups were also compared by a mean for each stimulus as independent samples (Student's t-test "
                      "with pooled variance).");
    if (any([](const GroupComparison& one) { return !one.stimuli.empty(); }))
        writer.method(fmt::format("Groups were compared for each stimulus ({}), with Holm's and Bonferroni's "
                                  "corrections over all of these tests of a question.",
                                  places ? "Mann-Whitney test"
                                         : "Student's t-test with pooled variance; also Welch's t-test, the "
                                           "Mann-Whitney test and Hedges' g"));
    if (!analysis.pairs.empty())
        writer.method(fmt::format("Stimuli were compared in pairs over the people who answered for both ({}), with "
                                  "Holm's correction over all pairs of a question.",
                                  places ? "Wilcoxon's signed ranks" : "paired t-test; also Wilcoxon's signed ranks"));
    if (analysis.everybody.complete.size() > 1 && analysis.stimuli.size() > 1)
        writer.method(fmt::format("Agreement of the people who answered for every stimulus was measured by {}Kendall's "
                                  "W, and tested by Friedman's test.",
                                  places ? "" : "ICC(2,1) and ICC(2,k) (Shrout and Fleiss 1979) and "));
}

/// All about the answers of one block.
Result<void> writeRatings(ReportWriter& writer, Json& json, const std::vector<Rating>& ratings,
                          const std::string& title, AnswerKind kind, const StudyReportParams& params)
{
    const RatingAnalysis analysis = analyseRatings(ratings, {params.unions, kind, params.pairStimuli});
    writer.heading(2, title);
    writeFindings(writer, analysis);
    tellMethods(writer, analysis);
    for (const std::string& doubt : analysis.doubts)
        writer.warning(title + ": " + doubt);
    if (auto drawn = writer.picture(fileNameOf(title) + ".svg", "Box plots of " + title,
                                    boxPlots(analysis, title, pictureStyle));
        !drawn)
        return drawn;
    if (kind == AnswerKind::places)
    {
        writer.table(placesTable(analysis));
        writer.table(eachStimulusPlacesTable(analysis));
    }
    else
    {
        writer.table(meansTable(analysis));
        writer.table(participantsTable(analysis));
        writer.table(stimulusMeansTable(analysis));
        writer.table(eachStimulusTable(analysis));
    }
    writer.table(pairsTable(analysis));
    if (analysis.everybody.complete.size() > 1 && analysis.stimuli.size() > 1)
        writer.paragraph(agreementText(analysis));
    json[title] = jsonOf(analysis);
    const bool fits = params.mixed && kind == AnswerKind::ratings;
    return fits ? writeMixedModel(writer, json[title]["mixedModel"], ratings) : Result<void>();
}

/// Blocks in the order of their first rating.
std::vector<std::pair<std::string, std::vector<Rating>>> byBlock(const std::vector<Rating>& ratings)
{
    std::vector<std::pair<std::string, std::vector<Rating>>> blocks;
    for (const Rating& one : ratings)
    {
        auto found =
            std::find_if(blocks.begin(), blocks.end(), [&](const auto& block) { return block.first == one.block; });
        if (found == blocks.end())
            found = blocks.insert(blocks.end(), {one.block, {}});
        found->second.push_back(one);
    }
    return blocks;
}

/// Rating blocks that different groups do in place of each other, such as the unimodal and the bimodal one, are one
/// question.
std::vector<std::pair<std::string, std::vector<Rating>>> questionsOf(const StudyResults& results)
{
    auto blocks = byBlock(results.ratings);
    std::vector<std::pair<std::string, std::vector<Rating>>> questions;
    std::vector<std::set<std::string>> groups;
    for (auto& [name, ratings] : blocks)
    {
        std::set<std::string> own;
        std::set<std::string> stimuli;
        for (const Rating& one : ratings)
        {
            own.insert(one.group);
            stimuli.insert(one.stimulus);
        }
        bool joined = false;
        for (std::size_t i = 0; i < questions.size() && !joined; ++i)
        {
            const bool othersOnly =
                std::none_of(own.begin(), own.end(), [&](const auto& group) { return groups[i].contains(group); });
            const bool sameStimuli = std::all_of(questions[i].second.begin(), questions[i].second.end(),
                                                 [&](const Rating& one) { return stimuli.contains(one.stimulus); });
            if (othersOnly && sameStimuli)
            {
                questions[i].first += " / " + name;
                questions[i].second.insert(questions[i].second.end(), ratings.begin(), ratings.end());
                groups[i].insert(own.begin(), own.end());
                joined = true;
            }
        }
        if (!joined)
        {
            questions.emplace_back(name, std::move(ratings));
            groups.push_back(std::move(own));
        }
    }
    return questions;
}

/// How far two coders' tables sort the words of all descriptions alike.
void writeCoders(ReportWriter& writer, Json& json, const std::set<std::string>& words, const StudyReportParams& params)
{
    constexpr std::size_t mostShown = 40;
    std::map<std::string, std::size_t> numbers;
    const auto numberOf = [&](const std::string& category)
    {
        return numbers.emplace(category, numbers.size()).first->second;
    };
    std::vector<std::pair<std::size_t, std::size_t>> codes;
    PageTable unlike{"Words that the coders sort differently", {"Word", "First", "Second"}, {}};
    json["coders"]["differences"] = Json::array();
    for (const std::string& word : words)
    {
        const std::string first = params.categories->categoryOf(word),
                          second = params.otherCategories->categoryOf(word);
        if (first.empty() && second.empty())
            continue; // sorted by neither
        codes.emplace_back(numberOf(first), numberOf(second));
        if (first == second)
            continue;
        json["coders"]["differences"].push_back({{"word", word}, {"first", first}, {"second", second}});
        if (unlike.rows.size() < mostShown)
            unlike.rows.push_back({word, first.empty() ? "(none)" : first, second.empty() ? "(none)" : second});
    }
    const CohensKappa found = cohensKappa(codes);
    writer.method(
        "Agreement of the two coders was measured by Cohen's kappa (1960) with its 95 % interval (Fleiss, Cohen "
        "and Everitt 1969).");
    json["coders"]["words"] = codes.size();
    json["coders"]["agreement"] = found.agreement;
    json["coders"]["kappa"] = found.kappa;
    json["coders"]["interval"] = {found.kappa95.low, found.kappa95.high};
    writer.table({"Agreement of the two coders",
                  {"Words sorted", "The same, %", "Cohen's kappa", "95 %"},
                  {{fmt::to_string(codes.size()), decimalText(100.0 * found.agreement, 1), decimalText(found.kappa, 2),
                    fmt::format("{} to {}", decimalText(found.kappa95.low, 2), decimalText(found.kappa95.high, 2))}}});
    if (!unlike.rows.empty())
        writer.table(std::move(unlike));
}

void writeWords(ReportWriter& writer, Json& json, const StudyResults& results, const StudyReportParams& params)
{
    if (results.descriptions.empty())
        return;
    writer.heading(2, "Words");
    std::set<std::string> groups;
    for (const Description& one : results.descriptions)
        groups.insert(one.group);
    PageTable words{"The most frequent words", {"Group", "Descriptions", "Words", "Different", "Most frequent"}, {}};
    PageTable categories{"Share of the words that have a category, by group", {"Category"}, {}};
    std::map<std::string, std::map<std::string, std::size_t>> counts;
    std::map<std::string, std::size_t> sums;
    std::set<std::string> different;
    for (const std::string& group : groups)
    {
        const WordCounts found = countWords(results.descriptions, group);
        std::size_t all = 0;
        std::string most;
        Json ofGroup = Json::object();
        for (std::size_t i = 0; i < found.size(); ++i)
        {
            all += found[i].second;
            if (i < 12)
                most += fmt::format("{}{} ({})", i == 0 ? "" : ", ", found[i].first, found[i].second);
            ofGroup[found[i].first] = found[i].second;
            different.insert(found[i].first);
            if (params.categories)
            {
                const std::string category = params.categories->categoryOf(found[i].first);
                counts[category][group] += found[i].second;
                sums[group] += category.empty() ? 0 : found[i].second;
            }
        }
        const auto descriptions = std::count_if(results.descriptions.begin(), results.descriptions.end(),
                                                [&](const auto& one) { return one.group == group; });
        words.rows.push_back(
            {groupTitle(group), fmt::to_string(descriptions), fmt::to_string(all), fmt::to_string(found.size()), most});
        json["words"][group] = std::move(ofGroup);
        categories.columns.push_back(groupTitle(group));
        categories.columns.emplace_back("%");
    }
    writer.table(std::move(words));
    if (!params.categories)
        return;
    const auto addRow = [&](const std::string& title, const std::string& category)
    {
        std::vector<std::string> row{title};
        for (const std::string& group : groups)
        {
            const std::size_t count = counts[category][group];
            row.push_back(fmt::to_string(count));
            row.push_back(category.empty() || sums[group] == 0
                              ? ""
                              : decimalText(100.0 * static_cast<double>(count) / static_cast<double>(sums[group]), 1));
            json["categories"][group][category] = count;
        }
        categories.rows.push_back(std::move(row));
    };
    for (const std::string& category : params.categories->names())
        addRow(category, category);
    addRow("(none)", "");
    writer.table(std::move(categories));
    if (params.otherCategories)
        writeCoders(writer, json, different, params);
}

std::string unitOf(Variable variable)
{
    constexpr std::array units{"dB re full drive", "dB", "%", "ms", "bands", "breakpoints per second", "bits"};
    static_assert(units.size() == study::fields::variables.size());
    return units[static_cast<std::size_t>(variable)];
}

/// Answers of all participants to one stimulus of an adaptive block, and the function that fits them.
PsychometricCurve curveOf(const StudyResults& results, const Block& block, const std::string& stimulus)
{
    PsychometricCurve curve;
    curve.name = stimulus;
    PsychometricPosterior posterior(priorOf(block.adaptive, block.intervals));
    std::map<double, std::pair<std::size_t, std::size_t>> seen; // right and all, by whole dB
    for (const StaircaseAnswer& one : results.staircaseAnswers)
        if (one.block == block.name && one.stimulus == stimulus)
        {
            posterior.update(one.strength, one.right);
            auto& [right, trials] = seen[std::round(one.strength)];
            right += one.right ? 1u : 0u;
            ++trials;
        }
    if (seen.empty())
        return curve;
    const Variable variable = block.adaptive.variable;
    for (const auto& [strength, counts] : seen)
        curve.answers.push_back({valueOf(variable, strength), counts.first, counts.second});
    const Psychometric mean = posterior.mean();
    constexpr double around = 3.0; // dB
    constexpr int points = 80;
    const double low = seen.begin()->first - around, high = seen.rbegin()->first + around;
    for (int i = 0; i <= points; ++i)
    {
        const double strength = low + (high - low) * i / points;
        curve.fitted.push_back({valueOf(variable, strength), mean(strength), posterior.share95(strength)});
    }
    return curve;
}

Result<void> writeThresholds(ReportWriter& writer, Json& json, const StudyResults& results)
{
    for (const Block& block : results.study.blocks)
    {
        if (block.task != Task::staircase)
            continue;
        PageTable table{"", {"Stimulus", "Participants", "Threshold", "95 % of the mean", "SD, dB", "Trials"}, {}};
        std::vector<NamedInterval> shown;
        std::vector<PsychometricCurve> curves;
        Json ofBlock = Json::object();
        for (const std::size_t stimulus : stimuliOf(results.study, block))
        {
            const std::string& name = results.study.stimuli[stimulus].name;
            std::map<Person, std::vector<double>> ofPeople; // one for each session
            std::size_t trials = 0;
            for (const PersonalThreshold& one : results.thresholds)
                if (one.block == block.name && one.stimulus == name)
                {
                    ofPeople[{one.group, one.participant}].push_back(one.estimate.strength);
                    trials += one.trials;
                }
            std::vector<double> strengths;
            for (const auto& [person, own] : ofPeople)
                strengths.push_back(meanOf(own));
            if (strengths.empty())
                continue;
            const SampleSummary sample = summaryOf(strengths);
            const auto value = [&](double strength)
            {
                return valueOf(block.adaptive.variable, strength);
            };
            const double a = value(sample.mean95.low), b = value(sample.mean95.high);
            shown.push_back({name, value(sample.mean), {std::min(a, b), std::max(a, b)}});
            table.rows.push_back({name, fmt::to_string(sample.count), decimalText(shown.back().value, 1),
                                  strengths.size() < 2 ? "" : intervalText(shown.back().interval, 1), sdText(sample, 2),
                                  fmt::to_string(trials)});
            ofBlock[name] = summaryJson(sample);
            ofBlock[name]["value"] = shown.back().value;
            curves.push_back(curveOf(results, block, name));
        }
        if (table.rows.empty())
            continue;
        writer.heading(2, block.name);
        table.caption = fmt::format("Thresholds in {}, over participants", unitOf(block.adaptive.variable));
        if (auto drawn = writer.picture(fileNameOf(block.name) + ".svg", "Thresholds of " + block.name,
                                        intervalPlot(shown, block.name, unitOf(block.adaptive.variable), pictureStyle));
            !drawn)
            return drawn;
        const auto scale = block.adaptive.variable == Variable::level ? plot::Scale::linear : plot::Scale::logarithmic;
        if (auto drawn = writer.picture(
                fileNameOf(block.name) + "-functions.svg", "Psychometric functions of " + block.name,
                psychometricPlot(curves, block.name, unitOf(block.adaptive.variable), scale, pictureStyle));
            !drawn)
            return drawn;
        writer.table(std::move(table));
        writer.method(block.adaptive.procedure == Procedure::questPlus
                          ? "A person's threshold was the mean of the posterior of QUEST+ (Watson 2017)."
                          : "A person's threshold was the mean of all reversals but the first two (Levitt 1971).");
        writer.method("Thresholds were averaged over people in dB, with Student's interval at 95 %; psychometric "
                      "functions were fitted to the answers of all.");
        json[block.name] = std::move(ofBlock);
    }
    return {};
}

void writeChoices(ReportWriter& writer, Json& json, const StudyResults& results)
{
    std::map<std::pair<std::string, std::string>, std::map<Person, CountedAnswers>> answers;
    for (const PersonalChoices& one : results.choices)
    {
        CountedAnswers& own = answers[{one.block, one.stimulus}][{one.group, one.participant}];
        own.right += one.right;
        own.all += one.trials;
    }
    PageTable table{"Right choices. People are the sample: Wilson's (1927) interval of the effective number of answers "
                    "(Korn and Graubard 1998); of one person it holds for that person alone",
                    {"Block", "Stimulus", "People", "Right", "Of", "%", "95 %", "By guessing, %", "Beyond chance"},
                    {}};
    for (const auto& [key, byPerson] : answers)
    {
        std::vector<CountedAnswers> people;
        for (const auto& [person, own] : byPerson)
            people.push_back(own);
        const Proportion found = proportionOf(people);
        const auto block = std::find_if(results.study.blocks.begin(), results.study.blocks.end(),
                                        [&name = key.first](const Block& one) { return one.name == name; });
        const double guess = guessOf(results.study, *block);
        table.rows.push_back({key.first, key.second, fmt::to_string(people.size()), fmt::to_string(found.right),
                              fmt::to_string(found.all), decimalText(100.0 * found.share, 1),
                              intervalText({100.0 * found.share95.low, 100.0 * found.share95.high}, 1),
                              decimalText(100.0 * guess, 1), found.share95.low > guess ? "yes" : "no"});
        json["choices"][key.first][key.second] = {{"people", people.size()},
                                                  {"right", found.right},
                                                  {"trials", found.all},
                                                  {"share", found.share},
                                                  {"share95", {found.share95.low, found.share95.high}},
                                                  {"guessing", guess}};
    }
    if (table.rows.empty())
        return;
    writer.method("Shares of right answers had Wilson's (1927) interval for the effective number of answers (Korn and "
                  "Graubard 1998), at 95 %.");
    writer.heading(2, "Choices");
    writer.table(std::move(table));
}

Result<void> writeMap(ReportWriter& writer, Json& json, const std::vector<PairRating>& pairs, const std::string& title)
{
    std::vector<std::string> names;
    for (const PairRating& one : pairs)
        for (const std::string& name : {one.first, one.second})
            if (std::find(names.begin(), names.end(), name) == names.end())
                names.push_back(name);
    if (names.size() < 3)
        return {};
    std::sort(names.begin(), names.end());
    const auto index = [&](const std::string& name)
    {
        return static_cast<std::size_t>(std::lower_bound(names.begin(), names.end(), name) - names.begin());
    };
    std::vector<std::vector<double>> sums(names.size(), std::vector<double>(names.size(), 0.0)), counts = sums;
    for (const PairRating& one : pairs)
        for (const auto& [i, k] :
             {std::pair(index(one.first), index(one.second)), std::pair(index(one.second), index(one.first))})
        {
            sums[i][k] += one.value;
            counts[i][k] += 1.0;
        }
    for (std::size_t i = 0; i < names.size(); ++i)
        for (std::size_t k = 0; k < names.size(); ++k)
            sums[i][k] = counts[i][k] > 0.0 ? sums[i][k] / counts[i][k] : 0.0;
    writer.method(
        "Maps of similarity were made from mean dissimilarities by multidimensional scaling in two dimensions "
        "(SMACOF from classical scaling; Kruskal's stress-1).");
    const Scaling scaling = scaleDissimilarities(sums);
    writer.heading(2, title);
    writer.paragraph(fmt::format(
        "Places whose distances are the mean dissimilarities as nearly as two dimensions allow; stress-1 {}{}.",
        decimalText(scaling.stress, 3), scaling.stress > 0.2 ? ", too much to be trusted" : ""));
    PageTable table{"Mean dissimilarity", {"Stimulus"}, {}};
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        table.columns.push_back(names[i]);
        std::vector<std::string> row{names[i]};
        for (std::size_t k = 0; k < names.size(); ++k)
            row.push_back(i == k ? "" : decimalText(sums[i][k], 2));
        table.rows.push_back(std::move(row));
        json[title][names[i]] = scaling.places[i];
    }
    if (auto drawn =
            writer.picture(fileNameOf(title) + ".svg", "Map of " + title, mapPlot(scaling, names, title, pictureStyle));
        !drawn)
        return drawn;
    writer.table(std::move(table));
    return {};
}

/// Who rated the hidden reference too low, and whether that leaves them out.
void writeScreening(ReportWriter& writer, Json& json, std::vector<std::string>& said, const Screening& screening)
{
    const auto row = [](const ScreenedListener& one)
    {
        return Json{{"group", one.group},
                    {"participant", one.participant},
                    {"trials", one.trials},
                    {"below90", one.below},
                    {"share", one.share()}};
    };
    json = {{"rule", "ITU-R BS.1534-3"},
            {"hiddenReferences", screening.references},
            {"listeners", Json::array()},
            {"failed", Json::array()},
            {"leftOut", screening.kept ? std::size_t(0) : screening.failed.size()}};
    for (const ScreenedListener& one : screening.everyone)
        json["listeners"].push_back(row(one));
    PageTable table{"Listeners who rated the hidden reference below 90 in more than 15 % of the trials",
                    {"Listener", "Group", "Trials", "Below 90", "%"},
                    {}};
    std::vector<std::string> names;
    for (const ScreenedListener& one : screening.failed)
    {
        json["failed"].push_back(row(one));
        table.rows.push_back({one.participant, groupTitle(one.group), fmt::to_string(one.trials),
                              fmt::to_string(one.below), decimalText(100.0 * one.share(), 0)});
        const std::string name =
            one.group.empty() ? one.participant : fmt::format("{} of {}", one.participant, one.group);
        names.push_back(fmt::format("{} ({} of {} trials)", name, one.below, one.trials));
    }
    writer.heading(2, "Screening of listeners");
    std::string text = fmt::format("Hidden reference: {}. Of {} {} rated it below 90 in more than 15 % of the trials",
                                   fmt::join(screening.references, ", "),
                                   counted(screening.everyone.size(), "listener", "listeners"), names.size());
    if (screening.nobodyPassed)
        text += ". As nobody would remain, all count: is the hidden reference the right one?";
    else if (names.empty())
        text += ": all count.";
    else
        text += screening.kept      ? ". All count, as was requested."
                : names.size() == 1 ? " and is left out (ITU-R BS.1534-3)."
                                    : " and are left out (ITU-R BS.1534-3).";
    writer.paragraph(text);
    writer.table(std::move(table));
    if (!names.empty())
        said.push_back(fmt::format("By the hidden reference {} of {} did not pass (ITU-R BS.1534-3) and {}: {}",
                                   names.size(), counted(screening.everyone.size(), "listener", "listeners"),
                                   screening.nobodyPassed ? "all count, as nobody would remain"
                                   : screening.kept       ? "all count, as was requested"
                                   : names.size() == 1    ? "is left out"
                                                          : "are left out",
                                   fmt::join(names, ", ")));
}

/// All that does not count, and what was taken for granted: what was said when the answers were read, then the doubts
/// about the sample. Nothing is said, too.
void writeLeftOut(ReportWriter& writer, StudyReport& report, const std::vector<std::string>& said)
{
    std::vector<std::string> all = said;
    all.insert(all.end(), report.warnings.begin(), report.warnings.end());
    writer.heading(2, "What was left out or assumed");
    for (const std::string& one : all)
        writer.paragraph(one + ".");
    if (all.empty())
        writer.paragraph("Nothing.");
    report.json["leftOut"] = std::move(all);
}
} // namespace

Result<StudyReport> reportOfRatings(const RatedTable& rated, const std::string& title, const StudyReportParams& params)
{
    const std::vector<Rating>& ratings = rated.ratings;
    StudyReport report;
    report.page.title = title;
    ReportWriter writer(report);
    writer.heading(1, title);
    writer.paragraph(counted(ratings.size(), "rating.", "ratings."));
    std::vector<std::string> said;
    for (const std::string& one : rated.warnings)
        said.push_back(title + ": " + one);
    if (rated.screening)
        writeScreening(writer, report.json["screening"], said, *rated.screening);
    for (const auto& [block, ofBlock] : byBlock(ratings))
        if (auto written = writeRatings(writer, report.json["ratings"], ofBlock, block.empty() ? "Ratings" : block,
                                        AnswerKind::ratings, params);
            !written)
            return written.error();
    writeLeftOut(writer, report, said);
    writeMethods(writer, report, rated);
    return report;
}

Result<StudyReport> reportOfStudy(const StudyResults& results, const StudyReportParams& params)
{
    StudyReport report;
    report.page.title = results.study.name;
    ReportWriter writer(report);
    writer.heading(1, results.study.name);
    if (!results.study.description.empty())
        writer.paragraph(results.study.description);
    std::map<std::string, std::pair<int, int>> people; // begun and finished
    double largest = 0.0;
    for (const LoggedSession& session : results.sessions)
    {
        ++people[session.head.group].first;
        people[session.head.group].second += session.finished ? 1 : 0;
        largest = std::max(largest, dailyExposure(session.exposure));
    }
    PageTable table{"Participants", {"Group", "Planned", "Begun", "Finished"}, {}};
    for (const Group& group : results.study.groups)
    {
        table.rows.push_back({group.name, fmt::to_string(group.size), fmt::to_string(people[group.name].first),
                              fmt::to_string(people[group.name].second)});
        report.json["participants"][group.name] = {
            {"planned", group.size}, {"begun", people[group.name].first}, {"finished", people[group.name].second}};
    }
    writer.table(std::move(table));
    if (results.dropouts > 0)
        writer.paragraph(fmt::format("{} where sound or touch dropped out; these are left out and were repeated.",
                                     counted(results.dropouts, "trial", "trials")));
    if (largest > 0.0)
        writer.paragraph(fmt::format("Largest exposure of a participant: A(8) = {} m/s2 of {} allowed ({}).",
                                     decimalText(largest, 3), decimalText(results.study.limits.daily, 2),
                                     study::standardOf(results.study.limits.part)));
    report.json["dropouts"] = results.dropouts;
    std::vector<std::string> said = results.warnings;
    if (results.dropouts > 0)
        said.push_back(fmt::format("{} where sound or touch dropped out {} left out and repeated",
                                   counted(results.dropouts, "trial", "trials"), results.dropouts == 1 ? "is" : "are"));
    if (results.screening)
        writeScreening(writer, report.json["screening"], said, *results.screening);
    writeQuestionnaires(writer, report.json, results);
    for (const auto& [title, ratings] : questionsOf(results))
    {
        if (auto written = writeRatings(writer, report.json["ratings"], ratings, title, AnswerKind::ratings, params);
            !written)
            return written.error();
        writeClasses(writer, report.json["classes"], results.study, ratings, title);
    }
    for (const auto& [title, ranks] : byBlock(results.ranks))
        if (auto written = writeRatings(writer, report.json["ranks"], ranks, title + " (places, 1 is first)",
                                        AnswerKind::places, params);
            !written)
            return written.error();
    writeWords(writer, report.json, results, params);
    if (auto written = writeThresholds(writer, report.json["thresholds"], results); !written)
        return written.error();
    writeChoices(writer, report.json, results);
    if (auto written = writePlaces(writer, report.json["places"], results); !written)
        return written.error();
    writeEvents(writer, report.json["events"], results);
    std::vector<PersonalMeasure> measures = measuresOf(results);
    for (const auto& [title, ratings] : questionsOf(results))
        measures.push_back(meanRatings(title, ratings));
    writeCovariates(writer, report.json, results, measures);
    if (auto written = writeMap(writer, report.json["maps"], results.pairs, "Similarity"); !written)
        return written.error();
    if (auto written = writeMap(writer, report.json["maps"], results.together, "Sorting"); !written)
        return written.error();
    writeLeftOut(writer, report, said);
    writeMethods(writer, report, results);
    return report;
}

} // namespace pacini::cli
