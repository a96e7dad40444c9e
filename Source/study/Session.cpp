#include "study/Session.h"

#include "io/Sha256.h"
#include "study/StudyFields.h"
#include "study/StudyFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <system_error>
#include <utility>

namespace pacini::study
{

namespace fs = std::filesystem;

namespace
{
constexpr int mostRepeats = 3;
constexpr std::string_view logExtension = ".jsonl";

std::string participantName(std::size_t slot)
{
    return fmt::format("P{:03}", slot + 1);
}
} // namespace

std::string hashOf(const Study& study)
{
    return sha256(studyJson(study));
}

std::size_t testedStimulus(const Trial& trial)
{
    const auto right = static_cast<std::size_t>(std::max(trial.right, 0));
    return trial.stimuli[right < trial.stimuli.size() ? right : 0];
}

std::vector<fs::path> sessionLogs(const fs::path& folder)
{
    std::vector<fs::path> logs;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder / "sessions", none))
        if (entry.path().extension() == logExtension)
            logs.push_back(entry.path());
    std::sort(logs.begin(), logs.end());
    return logs;
}

Session::Session(const Study& ofStudy, SessionHead head, fs::path path)
    : study(ofStudy), first(std::move(head)), file(std::move(path))
{
    for (std::size_t block = 0; block < study.blocks.size(); ++block)
        if (isFor(study.blocks[block], first.group))
        {
            std::vector<Trial> ofBlock = trialsOf(study, block, first.slot);
            std::move(ofBlock.begin(), ofBlock.end(), std::back_inserter(trials));
        }
}

Result<std::unique_ptr<Session>> Session::begin(const Study& study, const fs::path& folder, const SessionStart& start)
{
    std::error_code failed;
    fs::create_directories(folder / "sessions", failed);
    if (failed)
        return fileError(failed.value());
    SessionHead head;
    head.study = study.name;
    head.studySha256 = hashOf(study);
    head.language = start.language;
    head.consent = start.consent;
    head.program = start.program;
    head.started = utcNow();
    std::vector<std::size_t> taken;
    for (const fs::path& log : sessionLogs(folder))
    {
        const auto other = readSession(log);
        if (!other)
            return Error{other.error().code, log.string(), other.error().text()};
        if (other->head.studySha256 != head.studySha256)
            return Error{ErrorCode::invalidArgument, log.string(),
                         "is of another version of the study; use another folder for this one"};
        taken.push_back(other->head.slot);
    }
    while (std::find(taken.begin(), taken.end(), head.slot) != taken.end())
        ++head.slot;
    head.group = study.groups[groupOfSlot(study, head.slot)].name;
    head.participant = participantName(head.slot);
    const fs::path path = folder / "sessions" / (head.participant + std::string(logExtension));
    auto log = SessionLog::create(path, head);
    if (!log)
        return log.error();
    std::unique_ptr<Session> session(new Session(study, std::move(head), path));
    session->log.emplace(std::move(*log));
    session->skipDone();
    return session;
}

Result<std::unique_ptr<Session>> Session::resume(const Study& study, const fs::path& path)
{
    const auto logged = readSession(path);
    if (!logged)
        return logged.error();
    if (logged->head.studySha256 != hashOf(study))
        return Error{ErrorCode::invalidArgument, "",
                     "is of another version of the study, which cannot go on with this one"};
    auto log = SessionLog::resume(path, logged->goodBytes);
    if (!log)
        return log.error();
    std::unique_ptr<Session> session(new Session(study, logged->head, path));
    session->log.emplace(std::move(*log));
    session->exposed = logged->exposure;
    session->skipDone();
    for (const Record& record : logged->records)
        if (session->trial() != nullptr)
            (void)session->take(record.answer);
    return session;
}

const Trial* Session::trial() const noexcept
{
    return next < trials.size() ? &trials[next] : nullptr;
}

Staircase& Session::staircase(const Trial& trial)
{
    const Block& block = study.blocks[trial.block];
    return staircases
        .try_emplace({trial.block, testedStimulus(trial)}, block.adaptive,
                     block.task == Task::abx ? 2 : block.intervals)
        .first->second;
}

const Staircase* Session::staircaseOf(const Trial& trial) const
{
    const auto found = staircases.find({trial.block, testedStimulus(trial)});
    return found == staircases.end() ? nullptr : &found->second;
}

std::optional<double> Session::level() const
{
    const Trial* now = trial();
    if (now == nullptr || study.blocks[now->block].task != Task::staircase)
        return std::nullopt;
    const Adaptive& adaptive = study.blocks[now->block].adaptive;
    if (!now->adaptive)
        return adaptive.start; // training
    const Staircase* running = staircaseOf(*now);
    return valueOf(adaptive.variable,
                   running != nullptr ? running->strength() : strengthOf(adaptive.variable, adaptive.start));
}

void Session::skipDone()
{
    while (next < trials.size() && trials[next].adaptive && staircase(trials[next]).isDone())
        trials.erase(trials.begin() + static_cast<std::ptrdiff_t>(next));
}

std::optional<bool> Session::take(const Answer& answer)
{
    const Trial& now = trials[next];
    std::optional<bool> right;
    if (now.right >= 0 && answer.choice)
        right = *answer.choice == now.right;
    ++count;
    if (answer.dropouts > 0 && repeats < mostRepeats)
    {
        ++repeats;
        return right;
    }
    repeats = 0;
    if (now.adaptive && right)
        staircase(now).answer(*right);
    ++next;
    skipDone();
    return right;
}

Result<std::optional<bool>> Session::answer(const Answer& answer)
{
    const Trial* now = trial();
    if (now == nullptr)
        return Error{ErrorCode::invalidArgument, "", "has no trial that waits for an answer"};
    const Block& block = study.blocks[now->block];
    for (const Item& item : block.items)
    {
        const auto given = std::find_if(answer.items.begin(), answer.items.end(),
                                        [&](const auto& one) { return one.first == item.name; });
        if (const auto problem = problemOf(item, given == answer.items.end() ? std::string() : given->second))
            return Error{ErrorCode::invalidArgument, item.name, *problem};
    }
    Record record;
    record.trial = count;
    record.block = block.name;
    record.task = std::string(nameOf(block.task, fields::tasks));
    for (const std::size_t stimulus : now->stimuli)
        record.stimuli.push_back(study.stimuli[stimulus].name);
    record.training = now->training;
    record.level = level();
    if (now->right >= 0 && answer.choice)
        record.correct = *answer.choice == now->right;
    record.answer = answer;
    record.time = utcNow();
    if (auto kept = log->add(record); !kept)
        return kept.error();
    const auto right = take(answer);
    if (trial() == nullptr)
        (void)log->finish(); // the answers are what counts; resume() sees that none is missing
    return right;
}

Result<void> Session::note(std::string_view event, double exposure)
{
    if (auto kept = log->addEvent(event, exposure); !kept)
        return kept;
    exposed += exposure;
    return {};
}

double Session::progress() const noexcept
{
    return trials.empty() ? 1.0 : static_cast<double>(next) / static_cast<double>(trials.size());
}

} // namespace pacini::study
