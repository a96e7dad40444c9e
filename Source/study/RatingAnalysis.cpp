#include "study/RatingAnalysis.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <tuple>

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
        for (std::size_t i = 0; i < stimuli.size(); ++i)
            if (const auto found = means.find({ofGroup, participant, stimuli[i]}); found != means.end())
            {
                row.push_back(found->second.first / static_cast<double>(found->second.second));
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

GroupComparison compared(const GroupRatings& first, const GroupRatings& second)
{
    GroupComparison made;
    made.first = first.name;
    made.second = second.name;
    if (canBeTested(first.participantMeans, second.participantMeans))
    {
        made.byParticipant = pooledTTest(first.participantMeans, second.participantMeans);
        made.byParticipantWelch = welchTTest(first.participantMeans, second.participantMeans);
        made.byParticipantRanks = mannWhitney(first.participantMeans, second.participantMeans);
        made.effect = hedgesG(first.participantMeans, second.participantMeans);
    }
    if (canBeTested(first.stimulusMeans, second.stimulusMeans))
    {
        made.byStimulus = pooledTTest(first.stimulusMeans, second.stimulusMeans);
        made.byStimulusEqualVarianceP = equalVarianceP(first.stimulusMeans, second.stimulusMeans);
    }
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

std::vector<StimulusComparison> comparedStimuli(const GroupRatings& everybody)
{
    std::vector<StimulusComparison> pairs;
    const std::size_t n = everybody.byStimulus.size();
    constexpr std::size_t mostPairs = 45; // of ten stimuli; more is no table that anybody reads
    if (everybody.complete.size() < 2 || n < 2 || n * (n - 1) / 2 > mostPairs)
        return pairs;
    const auto column = [&](std::size_t i)
    {
        std::vector<double> values;
        for (const auto& row : everybody.complete)
            values.push_back(row[i]);
        return values;
    };
    std::vector<double> p;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = i + 1; k < n; ++k)
        {
            pairs.push_back({i, k, pairedTTest(column(i), column(k))});
            p.push_back(pairs.back().paired.p);
        }
    const std::vector<double> corrected = holm(p);
    for (std::size_t i = 0; i < pairs.size(); ++i)
        pairs[i].holm = corrected[i];
    return pairs;
}
} // namespace

RatingAnalysis analyseRatings(const std::vector<Rating>& ratings, const std::vector<GroupUnion>& unions)
{
    RatingAnalysis analysis;
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
    for (const GroupUnion& one : unions)
    {
        std::string name;
        for (const std::string& member : one)
            name += (name.empty() ? "{" : "+") + member;
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
            auto& made = analysis.comparisons.emplace_back(combined ? compared(analysis.groups[k], analysis.groups[i])
                                                                    : compared(analysis.groups[i], analysis.groups[k]));
            made.combined = combined;
        }
    std::vector<double> p, ofStimuli;
    for (const GroupComparison& one : analysis.comparisons)
    {
        p.push_back(one.byParticipant ? one.byParticipant->p : 1.0);
        std::transform(one.stimuli.begin(), one.stimuli.end(), std::back_inserter(ofStimuli),
                       [](const auto& test) { return test.pooled.p; });
    }
    const auto corrected = holm(p), stepDown = holm(ofStimuli), plain = bonferroni(ofStimuli);
    std::size_t next = 0;
    for (std::size_t i = 0; i < analysis.comparisons.size(); ++i)
    {
        analysis.comparisons[i].holm = corrected[i];
        for (auto& test : analysis.comparisons[i].stimuli)
        {
            test.holm = stepDown[next];
            test.bonferroni = plain[next++];
        }
    }
    analysis.pairs = comparedStimuli(analysis.everybody);
    analysis.agreement = intraclassCorrelation(analysis.everybody.complete);
    analysis.order = friedman(analysis.everybody.complete);
    return analysis;
}

} // namespace pacini::study
