#include "study/Study.h"

#include "study/StudyFields.h"

#include <pacini/foundation/ParseNumber.h>
#include <pacini/foundation/Units.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

namespace pacini::study
{

std::string_view inLanguage(const Text& text, std::string_view language)
{
    for (const std::string_view wanted : {language, std::string_view("en")})
        for (const auto& [code, said] : text)
            if (code == wanted)
                return said;
    return text.empty() ? std::string_view() : std::string_view(text.front().second);
}

namespace
{
bool easierBelow(Variable variable)
{
    return variable == Variable::bands || variable == Variable::breakpoints || variable == Variable::bits;
}
} // namespace

double strengthOf(Variable variable, double value) noexcept
{
    if (variable == Variable::level)
        return value;
    const double strength = Decibels::fromGain(value).value;
    return easierBelow(variable) ? -strength : strength;
}

double valueOf(Variable variable, double strength) noexcept
{
    if (variable == Variable::level)
        return strength;
    return Decibels((easierBelow(variable) ? -strength : strength)).gain();
}

void setActuator(Study& study, std::string name, const Profile& profile)
{
    study.profile = std::move(name);
    study.limits.part = exposedPartOf(profile).value_or(study.limits.part);
    study.limits.daily = actionValue(study.limits.part);
}

std::size_t stimulusNamed(const Study& study, std::string_view name)
{
    const auto found =
        std::find_if(study.stimuli.begin(), study.stimuli.end(), [&](const Stimulus& one) { return one.name == name; });
    return found == study.stimuli.end() ? noStimulus : static_cast<std::size_t>(found - study.stimuli.begin());
}

std::vector<std::size_t> stimuliOf(const Study& study, const Block& block)
{
    std::vector<std::size_t> indices;
    if (!block.stimuli.empty())
    {
        std::transform(block.stimuli.begin(), block.stimuli.end(), std::back_inserter(indices),
                       [&](const std::string& name) { return stimulusNamed(study, name); });
        return indices;
    }
    for (std::size_t i = 0; i < study.stimuli.size(); ++i)
    {
        const std::string& name = study.stimuli[i].name;
        const auto lists = [&](const std::vector<std::string>& names)
        {
            return std::find(names.begin(), names.end(), name) != names.end();
        };
        // What is only for training, comfort or comparison is no stimulus of its own.
        if (!lists(block.training) && !lists(study.comfort) && !lists(block.anchors) && name != block.reference)
            indices.push_back(i);
    }
    return indices;
}

bool isFor(const Block& block, std::string_view group)
{
    return block.groups.empty() || std::find(block.groups.begin(), block.groups.end(), group) != block.groups.end();
}

int participantsOf(const Study& study)
{
    return std::accumulate(study.groups.begin(), study.groups.end(), 0,
                           [](int sum, const Group& group) { return sum + group.size; });
}

bool needsReference(const Block& block)
{
    if (block.task == Task::staircase) // of a level: whether there is something at all
        return block.adaptive.variable != Variable::level;
    return block.task == Task::abx || block.task == Task::forcedChoice || block.task == Task::multiStimulus;
}

bool hasStimuli(const Block& block) noexcept
{
    return block.task != Task::questionnaire;
}

std::string signOf(const SoundObject& object)
{
    const char* const letters = "NXY";
    const char* const marks[] = {"", "'", "''"};
    return letters[static_cast<std::size_t>(object.mass)] +
           std::string(marks[static_cast<std::size_t>(object.facture)]);
}

std::vector<std::pair<int, std::string>> classesOf(const Stimulus& stimulus)
{
    std::vector<std::pair<int, std::string>> classes;
    if (stimulus.object)
    {
        const int mass = static_cast<int>(stimulus.object->mass), facture = static_cast<int>(stimulus.object->facture);
        classes.emplace_back(3 * mass + facture, signOf(*stimulus.object));
        classes.emplace_back(10 + mass, nameOf(stimulus.object->mass, fields::masses));
        classes.emplace_back(20 + facture, nameOf(stimulus.object->facture, fields::factures));
    }
    for (const std::string& tag : stimulus.tags)
        classes.emplace_back(30, tag);
    return classes;
}

bool belongsTo(const Stimulus& stimulus, std::string_view name)
{
    const auto classes = classesOf(stimulus);
    return std::any_of(classes.begin(), classes.end(), [&](const auto& one) { return one.second == name; });
}

int eventsIn(const Stimulus& stimulus) noexcept
{
    return stimulus.silence ? 0 : stimulus.mix.empty() ? 1 : static_cast<int>(stimulus.mix.size());
}

std::vector<std::size_t> eventsOf(const Study& study, const Block& block)
{
    std::vector<std::size_t> events;
    for (const std::size_t index : stimuliOf(study, block))
    {
        const Stimulus& one = study.stimuli[index];
        if (one.mix.empty() && !one.silence)
            events.push_back(index);
        for (const std::string& part : one.mix)
            events.push_back(stimulusNamed(study, part));
    }
    std::sort(events.begin(), events.end());
    events.erase(std::unique(events.begin(), events.end()), events.end());
    return events;
}

std::vector<int> countsOf(const Study& study, const Block& block)
{
    const auto stimuli = stimuliOf(study, block);
    const bool someSilent = std::any_of(stimuli.begin(), stimuli.end(),
                                        [&](std::size_t i) { return study.stimuli[i].silence.has_value(); });
    std::vector<int> counts(eventsOf(study, block).size() + (someSilent ? 1 : 0));
    std::iota(counts.begin(), counts.end(), someSilent ? 0 : 1);
    return counts;
}

int rightAnswer(const Study& study, const Block& block, std::size_t stimulus)
{
    const Stimulus& one = study.stimuli[stimulus];
    switch (block.task)
    {
    case Task::side:
        return !one.place || one.place->position == 0.5 ? -1 : one.place->position < 0.5 ? 0 : 1;
    case Task::count:
        return eventsIn(one);
    case Task::which:
    {
        const auto events = eventsOf(study, block);
        int sum = 0;
        for (std::size_t i = 0; i < events.size(); ++i)
            if (events[i] == stimulus ||
                std::find(one.mix.begin(), one.mix.end(), study.stimuli[events[i]].name) != one.mix.end())
                sum += 1 << i;
        return sum;
    }
    default:
        return -1;
    }
}

double guessOf(const Study& study, const Block& block)
{
    switch (block.task)
    {
    case Task::forcedChoice:
    case Task::staircase:
        return 1.0 / block.intervals;
    case Task::abx:
    case Task::side:
        return 0.5;
    case Task::count:
        return 1.0 / static_cast<double>(countsOf(study, block).size());
    case Task::which:
        return std::pow(0.5, static_cast<double>(eventsOf(study, block).size()));
    default:
        return 0.0;
    }
}

std::optional<std::string> problemOf(const Item& item, const std::string& answer)
{
    if (answer.empty())
        return item.optional ? std::nullopt : std::optional<std::string>("is not answered");
    if (item.kind == QuestionKind::choice)
        return std::any_of(item.choices.begin(), item.choices.end(),
                           [&](const ItemChoice& one) { return one.name == answer; })
                   ? std::nullopt
                   : std::optional(fmt::format("is '{}', which is not one of the choices", answer));
    if (item.kind == QuestionKind::text)
        return std::nullopt;
    const auto number = parseNumber<double>(answer);
    if (!number || !std::isfinite(*number))
        return fmt::format("is '{}', which is not a number", answer);
    if (*number < item.scale.low || *number > item.scale.high)
        return fmt::format("is {}, but must be {} to {}", answer, item.scale.low, item.scale.high);
    const double steps = item.scale.step > 0.0 ? (*number - item.scale.low) / item.scale.step : 0.0;
    if (std::abs(steps - std::round(steps)) > 1e-6)
        return fmt::format("is {}, but must be {} and so on in steps of {}", answer, item.scale.low, item.scale.step);
    return std::nullopt;
}

} // namespace pacini::study
