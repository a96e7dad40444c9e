#include "study/StudyResults.h"

#include "study/AnswerCheck.h"
#include "study/Session.h"
#include "study/StudyFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

namespace pacini::study
{

namespace
{
const Block* blockNamed(const Study& study, const std::string& name)
{
    for (const Block& block : study.blocks)
        if (block.name == name)
            return &block;
    return nullptr;
}

void addPairs(std::vector<PairRating>& pairs, const SessionHead& head, const Record& record)
{
    for (std::size_t i = 0; i < record.stimuli.size(); ++i)
        for (std::size_t k = i + 1; k < record.stimuli.size(); ++k)
            pairs.push_back({head.group, head.participant, record.block, record.stimuli[i], record.stimuli[k],
                             record.answer.values[i] == record.answer.values[k] ? 0.0 : 1.0});
}

/// The stimulus that was held against the reference.
std::string testedOf(const Block& block, const Record& record)
{
    if (block.task == Task::abx)
        return record.stimuli[0] == block.reference ? record.stimuli[1] : record.stimuli[0];
    for (const std::string& name : record.stimuli)
        if (name != block.reference)
            return name;
    return record.stimuli.front();
}

/// Sorts one session's answers.
class Sorting
{
public:
    Sorting(StudyResults& toFill, const SessionHead& who) : results(toFill), head(who) {}

    void add(const Record& record)
    {
        const Block* block = blockNamed(results.study, record.block);
        if (block == nullptr)
        {
            leaveOut(record, fmt::format("the study has no block '{}'", record.block));
            return;
        }
        if (record.training)
            return;
        if (record.answer.dropouts > 0)
        {
            ++results.dropouts;
            return;
        }
        const Answer& answer = record.answer;
        if (auto fault = faultOf(results.study, *block, record))
        {
            leaveOut(record, *fault);
            return;
        }
        switch (block->task)
        {
        case Task::rating:
            results.ratings.push_back(rating(record, 0, *answer.value));
            break;
        case Task::words:
            results.descriptions.push_back({head.group, head.participant, record.stimuli.front(), answer.words});
            break;
        case Task::similarity:
            results.pairs.push_back(
                {head.group, head.participant, record.block, record.stimuli[0], record.stimuli[1], *answer.value});
            break;
        case Task::multiStimulus:
        case Task::ranking:
            for (std::size_t i = 0; i < record.stimuli.size(); ++i)
                (block->task == Task::ranking ? results.ranks : results.ratings)
                    .push_back(rating(record, i, answer.values[i]));
            break;
        case Task::sorting:
            addPairs(results.together, head, record);
            break;
        case Task::staircase:
            staircases[{block, testedOf(*block, record)}].push_back(record);
            break;
        case Task::questionnaire:
            addItems(*block, record);
            break;
        case Task::place:
            addPlace(*block, record);
            break;
        case Task::count:
        case Task::which:
            results.events.push_back(
                {head.group, head.participant, record.block, record.stimuli.front(), *answer.choice});
            [[fallthrough]];
        case Task::side:
        case Task::abx:
        case Task::forcedChoice:
            if (record.correct)
            {
                auto& [right, trials] = choices[{block, testedOf(*block, record)}];
                right += *record.correct ? 1u : 0u;
                ++trials;
            }
            break;
        }
    }

    void finish()
    {
        for (const auto& [key, records] : staircases)
        {
            for (const Record& record : records)
                if (record.correct && record.level)
                    results.staircaseAnswers.push_back({key.first->name, key.second,
                                                        strengthOf(key.first->adaptive.variable, *record.level),
                                                        *record.correct});
            if (const auto found = thresholdOf(*key.first, records))
                results.thresholds.push_back({head.group, head.participant, key.first->name, key.second, *found,
                                              valueOf(key.first->adaptive.variable, found->strength), records.size()});
        }
        for (const auto& [key, counts] : choices)
            results.choices.push_back(
                {head.group, head.participant, key.first->name, key.second, counts.first, counts.second});
        if (leftOut > 0)
            results.warnings.push_back(fmt::format("{}: {}{}", head.participant, firstLeftOut,
                                                   leftOut == 1 ? "; the answer is left out"
                                                                : fmt::format("; {} answers are left out", leftOut)));
    }

private:
    /// A session tells its first answer that does not count, and how many there are.
    void leaveOut(const Record& record, const std::string& fault)
    {
        if (leftOut++ == 0)
            firstLeftOut = fmt::format("trial {} of {}: {}", record.trial, record.block, fault);
    }

    [[nodiscard]] Rating rating(const Record& record, std::size_t i, double value) const
    {
        return {head.group, head.participant, record.block, record.stimuli[i], value};
    }

    void addItems(const Block& block, const Record& record)
    {
        for (const Item& item : block.items)
            for (const auto& [name, answer] : record.answer.items)
                if (name == item.name && !answer.empty())
                {
                    if (const auto problem = problemOf(item, answer))
                        results.warnings.push_back(
                            fmt::format("{}: {} {}; it is left out", head.participant, item.name, *problem));
                    else
                        results.items.push_back({head.group, head.participant, record.block, item.name, answer});
                }
    }

    void addPlace(const Block& block, const Record& record)
    {
        const std::size_t stimulus = stimulusNamed(results.study, record.stimuli.front());
        if (!results.study.stimuli[stimulus].place)
            return;
        const double position = results.study.stimuli[stimulus].place->position;
        results.places.push_back({head.group, head.participant, record.block, record.stimuli.front(),
                                  block.scale.low + position * (block.scale.high - block.scale.low),
                                  *record.answer.value});
    }

    StudyResults& results;
    const SessionHead& head;
    std::size_t leftOut = 0;
    std::string firstLeftOut;
    std::map<std::pair<const Block*, std::string>, std::vector<Record>> staircases;
    std::map<std::pair<const Block*, std::string>, std::pair<std::size_t, std::size_t>> choices;
};

/// Of several logs of one session the one with the most answers stays. Two sessions of one participant are told.
void leaveOutCopies(StudyResults& results, std::vector<std::string>& names)
{
    std::map<std::string, std::size_t> placeOf; // of a participant's session
    std::vector<LoggedSession> kept;
    std::vector<std::string> keptNames;
    for (std::size_t i = 0; i < names.size(); ++i)
    {
        LoggedSession& session = results.sessions[i];
        const auto [before, isNew] = placeOf.try_emplace(session.head.participant, kept.size());
        LoggedSession* const other = isNew ? nullptr : &kept[before->second];
        if (other != nullptr && other->head.started == session.head.started && other->head.group == session.head.group)
        {
            const bool longer = session.records.size() > other->records.size();
            results.warnings.push_back(fmt::format("{}: is a copy of {} and left out",
                                                   longer ? keptNames[before->second] : names[i],
                                                   longer ? names[i] : keptNames[before->second]));
            if (longer)
            {
                *other = std::move(session);
                keptNames[before->second] = names[i];
            }
            continue;
        }
        if (other != nullptr)
            results.warnings.push_back(fmt::format("{}: is another session of {}, as {} is; both count", names[i],
                                                   session.head.participant, keptNames[before->second]));
        kept.push_back(std::move(session));
        keptNames.push_back(names[i]);
    }
    results.sessions = std::move(kept);
    names = std::move(keptNames);
}
} // namespace

std::optional<ThresholdEstimate> thresholdOf(const Block& block, const std::vector<Record>& records)
{
    if (block.adaptive.procedure == Procedure::levitt)
    {
        LevittStaircase staircase(block.adaptive);
        for (const Record& record : records)
            if (record.correct)
                staircase.answer(*record.correct);
        return staircase.threshold();
    }
    PsychometricPosterior posterior(priorOf(block.adaptive, block.intervals));
    std::size_t count = 0;
    for (const Record& record : records)
        if (record.correct && record.level)
        {
            posterior.update(strengthOf(block.adaptive.variable, *record.level), *record.correct);
            ++count;
        }
    if (count == 0)
        return std::nullopt;
    const Psychometric mean = posterior.mean();
    return ThresholdEstimate{mean.threshold, posterior.thresholdSd(), posterior.threshold95(), mean(mean.threshold)};
}

std::filesystem::path studyFileOf(const std::filesystem::path& named)
{
    std::error_code unknown;
    return std::filesystem::is_directory(named, unknown) ? named / studyFileName : named;
}

bool keepClass(StudyResults& results, std::string_view name)
{
    const auto isOther = [&](const std::string& stimulus)
    {
        const std::size_t index = stimulusNamed(results.study, stimulus);
        return index == noStimulus || !belongsTo(results.study.stimuli[index], name);
    };
    const auto ofOther = [&](const auto& one)
    {
        return isOther(one.stimulus);
    };
    const auto pairWithOther = [&](const PairRating& one)
    {
        return isOther(one.first) || isOther(one.second);
    };
    std::erase_if(results.ratings, ofOther);
    std::erase_if(results.ranks, ofOther);
    std::erase_if(results.descriptions, ofOther);
    std::erase_if(results.thresholds, ofOther);
    std::erase_if(results.staircaseAnswers, ofOther);
    std::erase_if(results.choices, ofOther);
    std::erase_if(results.places, ofOther);
    std::erase_if(results.events, ofOther);
    std::erase_if(results.pairs, pairWithOther);
    std::erase_if(results.together, pairWithOther);
    return std::any_of(results.study.stimuli.begin(), results.study.stimuli.end(),
                       [&](const Stimulus& one) { return belongsTo(one, name); });
}

Study relocated(Study study, const std::filesystem::path& from, const std::filesystem::path& to)
{
    namespace fs = std::filesystem;
    const auto move = [&](std::string& file)
    {
        if (file.empty())
            return;
        std::error_code failed;
        const fs::path whole = fs::absolute(from / file, failed);
        const fs::path moved = fs::relative(whole, fs::absolute(to.empty() ? "." : to, failed), failed);
        file = (failed || moved.empty() ? whole : moved).generic_string();
    };
    for (Stimulus& stimulus : study.stimuli)
        for (std::string* file : {&stimulus.sound, &stimulus.clip, &stimulus.drive})
            move(*file);
    // A shipped profile is named, not found.
    std::error_code unknown;
    if (!study.profile.empty() && std::filesystem::is_regular_file(from / study.profile, unknown))
        move(study.profile);
    return study;
}

Result<StudyResults> readResults(const std::filesystem::path& named)
{
    StudyResults results;
    const std::filesystem::path file = studyFileOf(named), folder = file.parent_path();
    auto study = readStudy(file);
    if (!study)
        return study.error();
    results.study = std::move(*study);
    const std::string hash = hashOf(results.study);
    std::vector<std::string> names; // of the sessions' files
    for (const std::filesystem::path& path : sessionLogs(folder))
    {
        auto session = readSession(path);
        const std::string name = path.filename().string();
        if (!session)
        {
            results.warnings.push_back(fmt::format("{}: {}", name, session.error().text()));
            continue;
        }
        if (session->head.studySha256 != hash)
        {
            results.warnings.push_back(fmt::format("{}: is of another version of the study and left out", name));
            continue;
        }
        if (!session->finished)
            results.warnings.push_back(fmt::format("{}: is not finished; its answers count", name));
        results.sessions.push_back(std::move(*session));
        names.push_back(name);
    }
    leaveOutCopies(results, names);
    if (results.sessions.empty())
        return Error{ErrorCode::io, "sessions", "has no session that could be read"};
    for (const LoggedSession& session : results.sessions)
    {
        for (const std::string& missing : missingAnswers(results.study, session))
            results.warnings.push_back(fmt::format("{}: {}", session.head.participant, missing));
        Sorting sorting(results, session.head);
        for (const Record& record : session.records)
            sorting.add(record);
        sorting.finish();
    }
    return results;
}

} // namespace pacini::study
