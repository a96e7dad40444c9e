#pragma once

// Field list of described parameters, for the readers and writers of documents that store their structs.

#include "io/Fields.h"

#include <pacini/foundation/Description.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace pacini
{

/// Visits the fields of `params` that `table` describes, by the names of their members.
template <typename Table, typename Params, typename Visitor>
void visitParameters(const Table& table, Params& params, Visitor& visitor)
{
    for (const auto& parameter : table)
    {
        const char* name = parameter.member.data(); // of a literal
        double value = parameter.get(params);
        if (parameter.kind == ParameterKind::number)
            visitor.number(name, value, Need::usual);
        else if (parameter.kind == ParameterKind::whole)
        {
            int whole = static_cast<int>(value);
            visitor.integer(name, whole, "must be a whole number");
            value = whole;
        }
        else if (parameter.kind == ParameterKind::truth)
        {
            bool truth = (value != 0.0) != parameter.negated;
            visitor.truth(name, truth);
            value = truth != parameter.negated ? 1.0 : 0.0;
        }
        else
        {
            std::vector<Choice<std::size_t>> choices;
            for (const std::string_view choice :
                 parameter.memberChoices.empty() ? parameter.choices : parameter.memberChoices)
                choices.push_back({choice, choices.size()});
            auto index = static_cast<std::size_t>(value);
            visitor.choice(name, index, choices, Need::usual);
            value = static_cast<double>(index);
        }
        if constexpr (isReader<Visitor>)
            parameter.set(params, value);
    }
}

} // namespace pacini
