#include "study/Study.h"

#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

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

} // namespace pacini::study
