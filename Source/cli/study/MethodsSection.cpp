#include "cli/study/MethodsSection.h"

#include "cli/Counted.h"
#include "study/Plan.h"
#include "study/StudyFields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
using namespace study;

/// As CITATION.cff has it.
constexpr const char* citation =
    "The Pacini developers. Pacini: sound to touch, version " PACINI_VERSION " (MIT licence).";

/// "A, B and C".
std::string listed(const std::vector<std::string>& names)
{
    if (names.size() < 2)
        return names.empty() ? "" : names.front();
    const std::vector<std::string> first(names.begin(), names.end() - 1);
    return fmt::format("{} and {}", fmt::join(first, ", "), names.back());
}

std::string scaleText(const RatingScale& scale)
{
    const auto end = [](double value, const Text& label)
    {
        return label.empty() ? fmt::format("{}", value) : fmt::format("{} ({})", value, inLanguage(label, "en"));
    };
    return fmt::format("a scale from {} to {}{}", end(scale.low, scale.lowLabel), end(scale.high, scale.highLabel),
                       scale.step > 0.0 ? fmt::format(" in steps of {}", scale.step) : "");
}

std::string presentationText(const Block& block)
{
    switch (block.presentation)
    {
    case Presentation::sound:
        return "heard alone";
    case Presentation::touch:
        return "felt alone";
    case Presentation::consecutive:
        return fmt::format("heard, then felt after a pause of {} s", block.pause);
    case Presentation::simultaneous:
        break;
    }
    return block.delay == 0.0 ? std::string("heard and felt at once")
                              : fmt::format("heard and felt, the touch {} s {} the sound", std::abs(block.delay),
                                            block.delay > 0.0 ? "after" : "before");
}

std::string orderText(const Block& block)
{
    switch (block.order)
    {
    case Order::latinSquare:
        return "in orders balanced for carry-over (Williams 1949)";
    case Order::fixed:
        return "in the same order for everybody";
    case Order::random:
        break;
    }
    return "in a random order for each person";
}

std::string staircaseText(const Block& block, const std::string& stimuli)
{
    constexpr std::array variables{
        "the level",           "the difference of level",   "the difference of frequency", "the delay of the touch",
        "the number of bands", "the number of breakpoints", "the number of bits"};
    static_assert(variables.size() == fields::variables.size());
    const Adaptive& adaptive = block.adaptive;
    return fmt::format(
        "the threshold of {} by {} alternatives ({}, {} trials at most for each of {})",
        variables[static_cast<std::size_t>(adaptive.variable)], block.intervals,
        adaptive.procedure == Procedure::questPlus
            ? std::string("QUEST+, Watson 2017")
            : fmt::format("transformed up-down, {} down, {} reversals, Levitt 1971", adaptive.down, adaptive.reversals),
        adaptive.trials, stimuli);
}

/// What was done with the stimuli, as "rated ...".
std::string taskText(const Study& study, const Block& block)
{
    const std::string stimuli = counted(stimuliOf(study, block).size(), "stimulus", "stimuli");
    switch (block.task)
    {
    case Task::rating:
        return fmt::format("rated {} on {}", stimuli, scaleText(block.scale));
    case Task::words:
        return fmt::format("described {} in their own words", stimuli);
    case Task::abx:
        return fmt::format("told {} from a reference (ABX)", stimuli);
    case Task::forcedChoice:
        return fmt::format("told {} from a reference by the choice of one of {} intervals", stimuli, block.intervals);
    case Task::staircase:
        return "found " + staircaseText(block, stimuli);
    case Task::multiStimulus:
        return fmt::format("rated {} beside each other with a hidden reference{} on {} (MUSHRA)", stimuli,
                           block.anchors.empty() ? "" : " and " + counted(block.anchors.size(), "anchor", "anchors"),
                           scaleText(block.scale));
    case Task::ranking:
        return fmt::format("put {} in order", stimuli);
    case Task::similarity:
        return fmt::format("rated how unlike the pairs of {} are, on {}", stimuli, scaleText(block.scale));
    case Task::sorting:
        return fmt::format("sorted {} into as many heaps as they saw fit", stimuli);
    case Task::questionnaire:
        return fmt::format("answered {}", counted(block.items.size(), "question", "questions"));
    case Task::place:
        return fmt::format("told where they felt {}, on {}", stimuli, scaleText(block.scale));
    case Task::side:
        return fmt::format("told on which side of the middle they felt {}", stimuli);
    case Task::count:
        return fmt::format("told how many events {} were", stimuli);
    case Task::which:
        break;
    }
    return fmt::format("told which events {} were", stimuli);
}

/// A slot of a member of the group; its trials are those of the others in another order.
std::size_t slotOf(const Study& study, const std::string& group)
{
    std::size_t slot = 0;
    while (study.groups[groupOfSlot(study, slot)].name != group)
        ++slot;
    return slot;
}

/// All about a block but its name.
std::string blockText(const Study& study, std::size_t index)
{
    const Block& block = study.blocks[index];
    std::vector<std::string> groups;
    for (const Group& group : study.groups)
        if (isFor(block, group.name))
            groups.push_back(group.name);
    if (groups.empty())
        return "";
    std::string text = groups.size() == study.groups.size() ? std::string("everybody")
                       : groups.size() == 1                 ? "group " + groups.front()
                                                            : "groups " + listed(groups);
    text += " " + taskText(study, block);
    if (!hasStimuli(block))
        return text + ".";
    text += fmt::format(", {}, {}", presentationText(block), orderText(block));
    const auto trials = trialsOf(study, index, slotOf(study, groups.front()));
    const auto training = static_cast<std::size_t>(
        std::count_if(trials.begin(), trials.end(), [](const Trial& one) { return one.training; }));
    text += fmt::format(": {} for each person", counted(trials.size() - training, "trial", "trials"));
    if (block.task == Task::staircase)
        text += " at most";
    if (training > 0)
        text += fmt::format(", after {}", counted(training, "trial of practice", "trials of practice"));
    text += ".";
    if (block.replays != 0)
        text += block.replays < 0 ? std::string(" A presentation could be repeated at will.")
                                  : fmt::format(" A presentation could be repeated {}.",
                                                counted(static_cast<std::size_t>(block.replays), "time", "times"));
    if (block.masking && block.presentation != Presentation::sound)
        text += " Noise on the headphones masked the sound of the actuator.";
    if (block.feedback)
        text += " It was told whether an answer was right.";
    return text;
}

std::string peopleText(const StudyResults& results)
{
    std::map<std::string, std::pair<std::set<std::string>, std::set<std::string>>> people; // begun and finished
    std::size_t begun = 0, finished = 0;
    for (const LoggedSession& session : results.sessions)
    {
        auto& [all, done] = people[session.head.group];
        begun += all.insert(session.head.participant).second ? 1u : 0u;
        if (session.finished)
            finished += done.insert(session.head.participant).second ? 1u : 0u;
    }
    std::vector<std::string> groups;
    for (const Group& group : results.study.groups)
        groups.push_back(fmt::format("{} in group {}", people[group.name].first.size(), group.name));
    std::string text = fmt::format("{} took part", counted(begun, "person", "people"));
    if (groups.size() > 1)
        text += fmt::format(" ({}; assigned at random)", listed(groups));
    return text + fmt::format("; {} finished. {} were planned.", finished, participantsOf(results.study));
}

/// The actuator, the stimuli and how the sessions were run.
std::string settingText(const StudyResults& results)
{
    const Study& study = results.study;
    std::string text = fmt::format("There were {}", counted(study.stimuli.size(), "stimulus", "stimuli"));
    if (!study.profile.empty())
        text += fmt::format(", made for the actuator profile {}", study.profile);
    if (study.row.actuators > 1)
        text += fmt::format(", on a row of {} actuators", study.row.actuators);
    std::set<std::string> programs;
    for (const LoggedSession& session : results.sessions)
        if (!session.head.program.empty())
            programs.insert(session.head.program);
    if (!programs.empty())
        text += fmt::format(". Sessions were run with {}", listed({programs.begin(), programs.end()}));
    return text + fmt::format("; orders followed from the seed {}.", study.seed);
}

/// One paragraph for all blocks, those that differ in their name alone together.
std::string tasksText(const Study& study)
{
    std::vector<std::pair<std::string, std::vector<std::string>>> alike;
    for (std::size_t i = 0; i < study.blocks.size(); ++i)
    {
        const std::string text = blockText(study, i);
        if (text.empty())
            continue;
        auto found = std::find_if(alike.begin(), alike.end(), [&](const auto& one) { return one.first == text; });
        if (found == alike.end())
            found = alike.insert(alike.end(), {text, {}});
        found->second.push_back(fmt::format("\"{}\"", study.blocks[i].name));
    }
    std::string all;
    for (const auto& [text, names] : alike)
        all += fmt::format("{}In {} {}, {}", all.empty() ? "" : " ",
                           names.size() == 1 ? "the part" : "each of the parts", listed(names), text);
    return all;
}

void writeMethods(ReportWriter& writer, StudyReport& report, std::vector<std::string> paragraphs,
                  const std::optional<Screening>& screening)
{
    if (screening && !screening->kept)
        paragraphs.push_back(fmt::format(
            "Listeners who rated the hidden reference below 90 in more than 15 % of the trials were left out (ITU-R "
            "BS.1534-3): {} of {}.",
            screening->failed.size(), screening->everyone.size()));
    if (!report.methods.empty())
        paragraphs.push_back(fmt::format("{}", fmt::join(report.methods, " ")));
    paragraphs.push_back(
        fmt::format("Statistics were computed with Pacini " PACINI_VERSION ". To cite it: {}", citation));
    writer.heading(2, "Methods");
    for (const std::string& one : paragraphs)
        writer.paragraph(one);
    report.json["methods"] = std::move(paragraphs);
}
} // namespace

void writeMethods(ReportWriter& writer, StudyReport& report, const StudyResults& results)
{
    std::vector<std::string> paragraphs{peopleText(results), settingText(results)};
    if (auto tasks = tasksText(results.study); !tasks.empty())
        paragraphs.push_back(std::move(tasks));
    writeMethods(writer, report, std::move(paragraphs), results.screening);
}

void writeMethods(ReportWriter& writer, StudyReport& report, const RatedTable& table)
{
    std::set<Person> people;
    std::set<std::string> stimuli, groups;
    for (const Rating& one : table.ratings)
    {
        people.emplace(one.group, one.participant);
        stimuli.insert(one.stimulus);
        groups.insert(one.group);
    }
    writeMethods(
        writer, report,
        {fmt::format("{} of {} by {}{} were analysed.", counted(table.ratings.size(), "rating", "ratings"),
                     counted(stimuli.size(), "stimulus", "stimuli"), counted(people.size(), "person", "people"),
                     groups.size() > 1 ? fmt::format(" in {} groups", groups.size()) : "")},
        table.screening);
}

} // namespace pacini::cli
