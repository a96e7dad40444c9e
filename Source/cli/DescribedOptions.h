#pragma once

// Options of a command from the descriptions of parameters.

#include "io/GivenParameters.h"

#include <pacini/foundation/Description.h>

#include <CLI/CLI.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pacini::cli
{

/// `--minimum-gap` of minimumGap.
[[nodiscard]] std::string optionOf(std::string_view parameter);

/// Options of parameters; declared once per command. Flags stand for true.
class DescribedOptions
{
public:
    /// Descriptions must outlive this.
    void declare(CLI::App& command, std::span<const ParameterInfo* const> parameters);

    /// Adds the values of the options that were given on the command line.
    void addGiven(GivenParameters& given) const;

    /// Sets the given options in a struct described by `table`.
    template <typename Table, typename Params>
    void apply(const Table& table, Params& params) const
    {
        GivenParameters given;
        addGiven(given);
        for (const auto& [parameter, value] : given)
            parameterNamed(table, parameter->name).set(params, value);
    }

private:
    struct Declared
    {
        const ParameterInfo* parameter;
        const CLI::Option* option;
    };
    std::vector<Declared> declared;
};

} // namespace pacini::cli
