#include "study/StudyRun.h"

#include "study/Exposure.h"
#include "study/SoundLevel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace pacini::study
{

StudyRun::StudyRun(const Study& study, std::unique_ptr<Session> session, const StimulusParams& params,
                   TrialPlayer& trialPlayer)
    : maker(study, params), running(std::move(session)), player(trialPlayer)
{
    beginTrial();
}

const Block& StudyRun::block() const
{
    assert(trial() != nullptr);
    return study().blocks[trial()->block];
}

bool StudyRun::isPage() const
{
    const Task task = block().task;
    return task == Task::multiStimulus || task == Task::ranking || task == Task::sorting;
}

void StudyRun::beginTrial()
{
    startedPart.reset();
    played.clear();
    plays.assign(trial() == nullptr || !hasStimuli(block()) ? 0 : isPage() ? trial()->stimuli.size() : 1, 0);
    last = {};
    dropouts = 0;
    ended = std::chrono::steady_clock::now();
}

std::optional<int> StudyRun::playsLeft(std::size_t part) const
{
    if (block().replays < 0)
        return std::nullopt;
    return std::max(0, 1 + block().replays - plays[part]);
}

PlayRefusal StudyRun::start(Result<TrialSound> sound, std::size_t part)
{
    if (!sound)
    {
        error = sound.error();
        return PlayRefusal::failed;
    }
    if (trim != 0.0)
    {
        const auto lower = [&](std::vector<float>& drive)
        {
            for (float& sample : drive)
                sample = static_cast<float>(static_cast<double>(sample) * Decibels(trim).gain());
        };
        lower(sound->touch);
        for (std::vector<float>& drive : sound->more)
            lower(drive);
    }
    const StimulusParams& params = maker.params();
    if (study().calibration)
        for (const FrameRange& range : sound->parts)
            if (const auto heard = std::span(sound->sound).subspan(range.begin, range.end - range.begin);
                heardLevel(*study().calibration, weightedLevel(heard, params.sampleRate)) >
                study().limits.soundLevel.value_or(usualSoundLevel))
                return PlayRefusal::soundLevel;
    const double doseOfPlay =
        largestDose(sound->touch, sound->more, params.profile, params.sampleRate, study().limits.part);
    if (dailyExposure(running->exposure() + doseOfPlay) > study().limits.daily)
        return PlayRefusal::exposure;
    // All of it counts from its start, and is on the disk before it is felt: what is cut off may have been felt, and a
    // session that goes on after a kill knows of it.
    if (doseOfPlay > 0.0)
        if (const auto kept = running->note("play", doseOfPlay); !kept)
        {
            error = kept.error();
            return PlayRefusal::failed;
        }
    parts = sound->parts;
    startedPart = part;
    player.play(std::move(*sound));
    return PlayRefusal::none;
}

PlayRefusal StudyRun::checkDevice()
{
    if (player.sampleRate() <= 0)
        player.recover();
    const int rate = player.sampleRate();
    if (rate <= 0)
        return PlayRefusal::noDevice;
    if (rate == maker.params().sampleRate)
        return PlayRefusal::none;
    error = Error{ErrorCode::invalidArgument, "",
                  fmt::format("The device has changed from {} to {} Hz; close the session and continue it",
                              maker.params().sampleRate, rate)};
    return PlayRefusal::failed;
}

PlayRefusal StudyRun::play(std::size_t part)
{
    if (const PlayRefusal refusal = checkDevice(); refusal != PlayRefusal::none)
        return refusal;
    if (part >= plays.size())
        return PlayRefusal::noReplayLeft; // a questionnaire plays nothing
    if (playsLeft(part) == 0)
        return PlayRefusal::noReplayLeft;
    const std::uint64_t noise = seedOf(study(), running->head().slot, 3'000'000 + running->answered());
    const auto refusal = start(isPage() ? makePart(maker, block(), trial()->stimuli[part], noise)
                                        : makeTrial(maker, *trial(), running->level(), noise),
                               part);
    if (refusal == PlayRefusal::none)
        ++plays[part];
    return refusal;
}

PlayRefusal StudyRun::tryOut(std::size_t stimulus)
{
    if (const PlayRefusal refusal = checkDevice(); refusal != PlayRefusal::none)
        return refusal;
    Block both;
    const auto refusal = start(makePart(maker, both, stimulus, 0), 0);
    startedPart.reset(); // no part of the trial
    return refusal;
}

StudyRun::Playing StudyRun::poll()
{
    const PlaybackReport report = player.report();
    Playing playing;
    playing.now = report.playing;
    if (report.playing)
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (report.frame >= parts[i].begin && report.frame < parts[i].end)
                playing.part = isPage() ? startedPart : std::optional(i);
    if (!report.playing && startedPart)
    {
        dropouts += report.dropouts;
        if (report.complete)
        {
            if (played.empty())
                last = report;
            played.insert(*startedPart);
        }
        startedPart.reset();
        ended = std::chrono::steady_clock::now();
    }
    return playing;
}

bool StudyRun::canAnswer() const
{
    return trial() != nullptr && !startedPart && played.size() == plays.size();
}

Result<std::optional<bool>> StudyRun::answer(Answer answer)
{
    answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - ended).count();
    for (const int count : plays)
        answer.replays += std::max(0, count - 1);
    answer.soundOnset = last.soundOnset;
    answer.touchOnset = last.touchOnset;
    answer.dropouts = dropouts;
    auto kept = running->answer(answer);
    if (kept)
        beginTrial();
    return kept;
}

double StudyRun::exposure() const
{
    return dailyExposure(running->exposure());
}

void StudyRun::lowerTouch(double decibels)
{
    trim = std::clamp(trim - std::abs(decibels), -60.0, 0.0);
}

} // namespace pacini::study
