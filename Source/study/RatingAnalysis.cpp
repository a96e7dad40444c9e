#include "study/RatingAnalysis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>

namespace pacini::study
{

namespace
{
/// Whether `a` comes before `b` to a reader: numbers by their value, so 2 before 10.
bool isBefore(const std::string& a, const std::string& b)
{
    const auto digits = [](const std::string& text)
    {
        return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
    };
    if (digits(a) && digits(b) && a.size() != b.size())
        return a.size() < b.size();
    return a < b;
}

std::vector<std::string> inOrder(std::vector<std::string> names)
{
    std::sort(names.begin(), names.end(), isBefore);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    return names;
}

/// The mean rating of each stimulus by each participant.
using Means = std::map<std::tuple<std::string, std::string, std::string>, std::pair<double, std::size_t>>;

GroupRatings groupOf(std::string name, const GroupUnion& members, const Means& means,
                     const std::vector<std::string>& stimuli)
{
    GroupRatings group;
    group.name = std::move(name);
    group.byStimulus.resize(stimuli.size());
    std::vector<std::pair<std::string, std::string>> people;
    for (const auto& [key, sum] : means)
        if (std::find(members.begin(), members.end(), std::get<0>(key)) != members.end())
            people.emplace_back(std::get<0>(key), std::get<1>(key));
    std::sort(people.begin(), people.end(),
              [](const auto& a, const auto& b)
              { return a.first != b.first ? isBefore(a.first, b.first) : isBefore(a.second, b.second); });
    people.erase(std::unique(people.begin(), people.end()), people.end());
    for (const auto& [ofGroup, participant] : people)
    {
        std::vector<double> row;
        auto& withGaps = group.rows.emplace_back(stimuli.size());
        for (std::size_t i = 0; i < stimuli.size(); ++i)
            if (const auto found = means.find({ofGroup, participant, stimuli[i]}); found != means.end())
            {
                row.push_back(found->second.first / static_cast<double>(found->second.second));
                withGaps[i] = row.back();
                group.byStimulus[i].push_back(row.back());
            }
        group.participants.push_back(participant);
        group.participantMeans.push_back(meanOf(row));
        group.all.insert(group.all.end(), row.begin(), row.end());
        if (row.size() == stimuli.size())
            group.complete.push_back(std::move(row));
    }
    for (const auto& values : group.byStimulus)
        if (!values.empty())
            group.stimulusMeans.push_back(meanOf(values));
    return group;
}

bool canBeTested(const std::vector<double>& first, const std::vector<double>& second)
{
    return first.size() > 1 && second.size() > 1;
}

bool haveRatedTheSame(const GroupRatings& first, const GroupRatings& second)
{
    return std::equal(first.byStimulus.begin(), first.byStimulus.end(), second.byStimulus.begin(),
                      [](const auto& a, const auto& b) { return a.empty() == b.empty(); });
}

/// Means of participants and of stimuli; those of places say nothing.
void compareMeans(GroupComparison& made, const GroupRatings& first, const GroupRatings& second, bool pairStimuli)
{
    if (canBeTested(first.participantMeans, second.participantMeans))
    {
        made.byParticipant = pooledTTest(first.participantMeans, second.participantMeans);
        made.byParticipantWelch = welchTTest(first.participantMeans, second.participantMeans);
        made.byParticipantRanks = mannWhitney(first.participantMeans, second.participantMeans);
        made.effect = hedgesG(first.participantMeans, second.participantMeans);
    }
    if (!canBeTested(first.stimulusMeans, second.stimulusMeans))
        return;
    made.stimuliArePaired = pairStimuli && haveRatedTheSame(first, second);
    made.byStimulus = made.stimuliArePaired ? pairedTTest(first.stimulusMeans, second.stimulusMeans)
                                            : pooledTTest(first.stimulusMeans, second.stimulusMeans);
    made.byStimulusEqualVarianceP = equalVarianceP(first.stimulusMeans, second.stimulusMeans);
}

GroupComparison compared(const GroupRatings& first, const GroupRatings& second, const RatingAnalysisParams& params)
{
    GroupComparison made;
    made.first = first.name;
    made.second = second.name;
    if (params.kind == AnswerKind::ratings)
        compareMeans(made, first, second, params.pairStimuli);
    for (std::size_t i = 0; i < first.byStimulus.size(); ++i)
    {
        const auto &a = first.byStimulus[i], &b = second.byStimulus[i];
        if (canBeTested(a, b))
            made.stimuli.push_back({i, pooledTTest(a, b), welchTTest(a, b), mannWhitney(a, b), hedgesG(a, b)});
    }
    return made;
}

bool holds(const GroupUnion& members, const std::string& name)
{
    return std::find(members.begin(), members.end(), name) != members.end();
}

std::vector<StimulusComparison> comparedStimuli(const GroupRatings& everybody, AnswerKind kind)
{
    std::vector<StimulusComparison> pairs;
    const std::size_t n = everybody.byStimulus.size();
    if (n > mostPairedStimuli)
        return pairs;
    std::vector<double> p;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = i + 1; k < n; ++k)
        {
            std::vector<double> first, second;
            for (const auto& row : everybody.rows)
                if (row[i] && row[k])
                {
                    first.push_back(*row[i]);
                    second.push_back(*row[k]);
                }
            if (first.size() < 2)
                continue;
            pairs.push_back({i, k, pairedTTest(first, second), signedRanks(first, second)});
            p.push_back(kind == AnswerKind::places ? pairs.back().ranks.p : pairs.back().paired.p);
        }
    const std::vector<double> corrected = holm(p);
    for (std::size_t i = 0; i < pairs.size(); ++i)
        pairs[i].holm = corrected[i];
    return pairs;
}

/// Corrects the comparisons of groups for how many there are.
void correct(std::vector<GroupComparison>& comparisons, AnswerKind kind)
{
    std::vector<double> p, ofStimuli;
    for (const GroupComparison& one : comparisons)
    {
        p.push_back(one.byParticipant ? one.byParticipant->p : 1.0);
        std::transform(one.stimuli.begin(), one.stimuli.end(), std::back_inserter(ofStimuli),
                       [&](const auto& test) { return kind == AnswerKind::places ? test.ranks.p : test.pooled.p; });
    }
    const auto corrected = holm(p), stepDown = holm(ofStimuli), plain = bonferroni(ofStimuli);
    std::size_t next = 0;
    for (std::size_t i = 0; i < comparisons.size(); ++i)
    {
        comparisons[i].holm = corrected[i];
        for (auto& test : comparisons[i].stimuli)
        {
            test.holm = stepDown[next];
            test.bonferroni = plain[next++];
        }
    }
}

std::string nameOf(const GroupRatings& group, std::size_t person)
{
    return group.name.empty() ? group.participants[person] : group.participants[person] + " of " + group.name;
}

/// What follows the first of several cases.
std::string andMore(std::size_t count)
{
    return count > 1 ? fmt::format(" (and {} more)", count - 1) : std::string();
}

/// People with the same answers as another, if there are any.
std::optional<std::string> copiesIn(std::span<const GroupRatings> groups)
{
    std::map<std::vector<std::optional<double>>, std::string> seen;
    std::string first;
    std::size_t count = 0;
    for (const GroupRatings& group : groups)
        for (std::size_t i = 0; i < group.participants.size(); ++i)
        {
            // Fewer answers, or always the same, are alike by chance.
            constexpr std::size_t manyAnswers = 8, differentAnswers = 3;
            const auto& row = group.rows[i];
            if (row.size() < manyAnswers || std::set(row.begin(), row.end()).size() < differentAnswers)
                continue;
            const auto [other, isNew] = seen.try_emplace(row, nameOf(group, i));
            if (!isNew && count++ == 0)
                first = fmt::format("{} has the same answers as {}", nameOf(group, i), other->second);
        }
    if (count == 0)
        return std::nullopt;
    return first + andMore(count) + "; all count: leave out what is a copy";
}

/// What makes a sample other than it seems.
std::vector<std::string> doubtsOf(const RatingAnalysis& analysis)
{
    std::vector<std::string> doubts;
    const std::span groups(analysis.groups.data(), analysis.plainGroups);
    std::map<std::string, std::vector<std::string>> groupsOf; // of a participant
    std::size_t people = 0;
    for (const GroupRatings& group : groups)
        for (const std::string& participant : group.participants)
        {
            ++people;
            groupsOf[participant].push_back(group.name);
        }
    if (auto copies = copiesIn(groups))
        doubts.push_back(std::move(*copies));
    const bool unnamed = groupsOf.erase("") > 0;
    if (unnamed)
        doubts.emplace_back("there are no participants: all answers of a group count as those of one person");
    std::erase_if(groupsOf, [](const auto& one) { return one.second.size() < 2; });
    if (!groupsOf.empty())
        doubts.push_back(fmt::format("{} is in several groups ({}){}: as another person in each, so that tests between "
                                     "groups hold only if they are different people",
                                     groupsOf.begin()->first, fmt::join(groupsOf.begin()->second, ", "),
                                     andMore(groupsOf.size())));
    if (const std::size_t whole = analysis.everybody.complete.size(); whole < people && !unnamed)
        doubts.push_back(fmt::format("{} of {} participants have not answered for every stimulus: their means are of "
                                     "what they answered, and agreement is of the {} others",
                                     people - whole, people, whole));
    if (analysis.stimuli.size() > mostPairedStimuli)
        doubts.push_back(fmt::format("{} stimuli are too many to be compared in pairs; up to {} are",
                                     analysis.stimuli.size(), mostPairedStimuli));
    return doubts;
}
} // namespace

RatingAnalysis analyseRatings(const std::vector<Rating>& ratings, const RatingAnalysisParams& params)
{
    RatingAnalysis analysis;
    analysis.kind = params.kind;
    Means means;
    std::vector<std::string> groupNames;
    for (const Rating& one : ratings)
    {
        auto& [sum, count] = means[{one.group, one.participant, one.stimulus}];
        sum += one.value;
        ++count;
        groupNames.push_back(one.group);
        analysis.stimuli.push_back(one.stimulus);
    }
    groupNames = inOrder(std::move(groupNames));
    analysis.stimuli = inOrder(std::move(analysis.stimuli));

    std::vector<GroupUnion> members;
    for (const std::string& name : groupNames)
    {
        members.push_back({name});
        analysis.groups.push_back(groupOf(name, members.back(), means, analysis.stimuli));
    }
    analysis.plainGroups = analysis.groups.size();
    std::vector<std::string> notCombined;
    for (const GroupUnion& one : params.unions)
    {
        std::string name;
        for (const std::string& member : one)
            name += (name.empty() ? "{" : "+") + member;
        const auto missing = std::find_if_not(one.begin(), one.end(),
                                              [&](const std::string& member) { return holds(groupNames, member); });
        if (missing != one.end())
        {
            notCombined.push_back(fmt::format("{}}} is not compared: {} has no answers here", name, *missing));
            continue;
        }
        members.push_back(one);
        analysis.groups.push_back(groupOf(name + "}", one, means, analysis.stimuli));
    }
    analysis.everybody = groupOf("", groupNames, means, analysis.stimuli);

    for (std::size_t i = 0; i < analysis.groups.size(); ++i)
        for (std::size_t k = i + 1; k < analysis.groups.size(); ++k)
        {
            const bool combined = k >= analysis.plainGroups;
            const bool overlap = std::any_of(members[k].begin(), members[k].end(),
                                             [&](const std::string& name) { return holds(members[i], name); });
            if (overlap)
                continue;
            // A union is named first, as the sum that a single group is held against.
            analysis.comparisons.push_back(combined ? compared(analysis.groups[k], analysis.groups[i], params)
                                                    : compared(analysis.groups[i], analysis.groups[k], params));
            analysis.comparisons.back().combined = combined;
        }
    correct(analysis.comparisons, params.kind);
    analysis.pairs = comparedStimuli(analysis.everybody, params.kind);
    analysis.agreement = intraclassCorrelation(analysis.everybody.complete);
    analysis.order = friedman(analysis.everybody.complete);
    analysis.doubts = doubtsOf(analysis);
    analysis.doubts.insert(analysis.doubts.end(), notCombined.begin(), notCombined.end());
    return analysis;
}

} // namespace pacini::study
