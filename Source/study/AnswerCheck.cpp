#include "study/AnswerCheck.h"

#include "study/Plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace pacini::study
{

namespace
{
using Fault = std::optional<std::string>;

Fault outOfScale(const RatingScale& scale, double value)
{
    if (std::isfinite(value) && value >= scale.low && value <= scale.high)
        return std::nullopt;
    return fmt::format("its value {} is outside of the scale from {} to {}", value, scale.low, scale.high);
}

Fault valueFault(const Block& block, const Answer& answer)
{
    return answer.value ? outOfScale(block.scale, *answer.value) : Fault("it has no value");
}

Fault pageFault(const Block& block, const Record& record)
{
    const auto& values = record.answer.values;
    if (values.size() != record.stimuli.size())
        return fmt::format("it has {} values for {} stimuli", values.size(), record.stimuli.size());
    if (block.task == Task::multiStimulus)
    {
        for (const double value : values)
            if (auto fault = outOfScale(block.scale, value))
                return fault;
    }
    else if (block.task == Task::ranking)
    {
        auto places = values;
        std::sort(places.begin(), places.end());
        for (std::size_t i = 0; i < places.size(); ++i)
            if (places[i] != static_cast<double>(i + 1))
                return fmt::format("its places are not the numbers from 1 to {}", places.size());
    }
    return std::nullopt;
}

/// The answers that a block offers: the first and the last.
std::pair<int, int> choicesOf(const Study& study, const Block& block)
{
    if (block.task == Task::count)
    {
        const auto counts = countsOf(study, block);
        return counts.empty() ? std::pair(0, 0) : std::pair(counts.front(), counts.back());
    }
    if (block.task == Task::which)
        return {0, (1 << eventsOf(study, block).size()) - 1};
    return {0, block.task == Task::forcedChoice || block.task == Task::staircase ? block.intervals - 1 : 1};
}

Fault choiceFault(const Study& study, const Block& block, const Answer& answer)
{
    if (!answer.choice)
        return "it has no choice";
    const auto [first, last] = choicesOf(study, block);
    if (*answer.choice >= first && *answer.choice <= last)
        return std::nullopt;
    return fmt::format("its choice {} is none of those from {} to {}", *answer.choice, first, last);
}

/// A level that the block's staircase cannot have asked for.
Fault levelFault(const Adaptive& adaptive, const Record& record)
{
    if (!record.level)
        return "it has no level";
    constexpr double rounding = 0.01; // dB
    const double strength = strengthOf(adaptive.variable, *record.level);
    const auto [low, high] =
        std::minmax({strengthOf(adaptive.variable, adaptive.lowest), strengthOf(adaptive.variable, adaptive.highest)});
    if (std::isfinite(strength) && strength >= low - rounding && strength <= high + rounding)
        return std::nullopt;
    return fmt::format("its level {} is outside of the range from {} to {}", *record.level, adaptive.lowest,
                       adaptive.highest);
}

Fault stimuliFault(const Study& study, const Block& block, const Record& record)
{
    if (!hasStimuli(block))
        return record.stimuli.empty() ? Fault() : Fault("it has a stimulus, and the block has none");
    if (record.stimuli.empty())
        return "it has no stimulus";
    for (const std::string& name : record.stimuli)
        if (stimulusNamed(study, name) == noStimulus)
            return fmt::format("the study has no stimulus '{}'", name);
    const std::size_t least = block.task == Task::similarity || block.task == Task::abx ? 2 : 1;
    return record.stimuli.size() < least ? Fault("it has one stimulus in place of two") : Fault();
}
} // namespace

std::optional<std::string> faultOf(const Study& study, const Block& block, const Record& record)
{
    if (!record.unreadable.empty())
        return fmt::format("its \"{}\" cannot be read", record.unreadable.front());
    if (auto fault = stimuliFault(study, block, record))
        return fault;
    switch (block.task)
    {
    case Task::rating:
    case Task::similarity:
    case Task::place:
        return valueFault(block, record.answer);
    case Task::multiStimulus:
    case Task::ranking:
    case Task::sorting:
        return pageFault(block, record);
    case Task::staircase:
        if (auto fault = levelFault(block.adaptive, record))
            return fault;
        [[fallthrough]];
    case Task::abx:
    case Task::forcedChoice:
    case Task::side:
    case Task::count:
    case Task::which:
        return choiceFault(study, block, record.answer);
    case Task::words:
    case Task::questionnaire:
        break;
    }
    return std::nullopt;
}

std::vector<std::string> missingAnswers(const Study& study, const LoggedSession& session)
{
    std::vector<std::string> sentences;
    std::size_t next = 0, lost = 0, first = 0; // numbers of trials
    for (const Record& record : session.records)
    {
        // Numbers that go back are of a session that was written by hand, or twice.
        if (record.trial > next)
        {
            first = lost == 0 ? next : first;
            lost += record.trial - next;
        }
        next = std::max(next, record.trial + 1);
    }
    if (lost > 0)
    {
        sentences.push_back(fmt::format("{} of {} answers {} missing, the first at trial {}", lost,
                                        session.records.size() + lost, lost == 1 ? "is" : "are", first));
        return sentences;
    }
    if (!session.finished)
        return sentences;
    for (std::size_t i = 0; i < study.blocks.size(); ++i)
    {
        const Block& block = study.blocks[i];
        if (!isFor(block, session.head.group) || block.task == Task::staircase)
            continue;
        // A trial whose repetitions dropped out, too, has an answer at last, if not one that counts.
        std::size_t answered = 0, dropouts = 0;
        for (const Record& record : session.records)
            if (record.block == block.name)
            {
                dropouts = record.answer.dropouts > 0 ? dropouts + 1 : 0;
                constexpr std::size_t mostPlayed = 4; // of a trial that drops out each time
                answered += dropouts == 0 || dropouts == mostPlayed ? 1u : 0u;
                dropouts %= mostPlayed;
            }
        if (const std::size_t wanted = trialsOf(study, i, session.head.slot).size(); answered < wanted)
            sentences.push_back(fmt::format("{} of {} answers of {} {} missing, although the session is finished",
                                            wanted - answered, wanted, block.name,
                                            wanted - answered == 1 ? "is" : "are"));
    }
    return sentences;
}

} // namespace pacini::study
