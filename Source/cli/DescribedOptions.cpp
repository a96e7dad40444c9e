#include "cli/DescribedOptions.h"

#include "cli/Options.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace pacini::cli
{

namespace
{
/// NaN for what is no number.
double numberIn(const std::string& text)
{
    double value = 0.0;
    return !text.empty() && CLI::detail::lexical_cast(text, value) ? value : std::numeric_limits<double>::quiet_NaN();
}

/// Words that stand for values: names of a choice, on and off where a truth may be left open, and what leaves it open.
std::vector<std::string> wordsFor(const ParameterInfo& parameter)
{
    std::vector<std::string> words(parameter.choices.begin(), parameter.choices.end());
    if (parameter.kind == ParameterKind::truth)
        words = {"off", "on"};
    if (!parameter.unsetWord.empty())
        words.emplace_back(parameter.unsetWord);
    return words;
}

bool isFlag(const ParameterInfo& parameter)
{
    return parameter.kind == ParameterKind::truth && parameter.unsetWord.empty();
}

bool takesWords(const ParameterInfo& parameter)
{
    return parameter.kind == ParameterKind::choice || parameter.kind == ParameterKind::truth;
}

CLI::Validator allowedFor(const ParameterInfo& parameter)
{
    if (takesWords(parameter))
        return oneOf(wordsFor(parameter));
    const std::string range = allowedText(parameter);
    return CLI::Validator(
        [&parameter, range](std::string& text)
        {
            if (checkValue(parameter, numberIn(text)))
                return std::string();
            return fmt::format("'{}' is not a {} from {}", text,
                               parameter.kind == ParameterKind::whole ? "whole number" : "number", range);
        },
        range);
}

double valueIn(const ParameterInfo& parameter, const std::string& text)
{
    if (!takesWords(parameter))
        return numberIn(text);
    const auto words = wordsFor(parameter);
    return static_cast<double>(std::find(words.begin(), words.end(), text) - words.begin());
}
} // namespace

std::string optionOf(std::string_view parameter)
{
    return "--" + separatedName(parameter, '-');
}

void DescribedOptions::declare(CLI::App& command, std::span<const ParameterInfo* const> parameters)
{
    for (const ParameterInfo* parameter : parameters)
    {
        const std::string name = optionName(*parameter);
        // Const, or CLI11 takes it for a variable to assign to.
        const std::string text = parameter->usualText.empty()
                                     ? std::string(parameter->text)
                                     : fmt::format("{} [{}]", parameter->text, parameter->usualText);
        CLI::Option* option = nullptr;
        if (isFlag(*parameter))
            option = command.add_flag(name, text);
        else
        {
            option = command.add_option(name, text)
                         ->check(allowedFor(*parameter))
                         ->default_str(valueText(*parameter, parameter->usual()));
            option->type_name(takesWords(*parameter) ? "NAME" : parameter->kind == ParameterKind::whole ? "N" : "X");
        }
        if (!parameter->group.empty()) // CLI11 hides the name of what is in the group ""
            option->group(std::string(parameter->group));
        declared.push_back({parameter, option});
    }
}

void DescribedOptions::addGiven(GivenParameters& given) const
{
    for (const auto& [parameter, option] : declared)
        if (option->count() > 0 && option->results().front() != parameter->unsetWord)
            given.set(*parameter, isFlag(*parameter) ? 1.0 : valueIn(*parameter, option->results().front()));
}

} // namespace pacini::cli
