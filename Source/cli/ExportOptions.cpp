#include "cli/ExportOptions.h"

#include "cli/Options.h"
#include "cli/ProfileInput.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace pacini::cli
{

void ExportOptions::declare(CLI::App& command)
{
    described.declare(command, exportParameterInfos());
    auto* actuator = addOption(command, "--profile", profile, std::string(exportProfileText), "PROFILE");
    command.get_option("--strength")->needs(actuator);
}

GivenParameters ExportOptions::given() const
{
    GivenParameters all;
    described.addGiven(all);
    return all;
}

std::optional<ExportParams> ExportOptions::params(Console& console, const ClipFormat& format,
                                                  const GivenParameters& settings) const
{
    GivenParameters wanted;
    for (const auto& [parameter, value] : settings)
        if (parameterNamed(exportParameters, parameter->name).isIn(format) &&
            (parameter->name != "strength" || !profile.empty()))
            wanted.set(*parameter, value);
    described.addGiven(wanted);
    std::optional<Profile> actuator;
    if (!profile.empty())
    {
        actuator = openProfile(console, profile);
        if (!actuator)
            return std::nullopt;
    }
    auto params = exportParamsOf(format, wanted, std::move(actuator));
    if (params)
        return std::move(*params);
    console.error("", params.error());
    return std::nullopt;
}

Result<void> ExportOptions::checkFor(const ClipFormat& format) const
{
    const auto params = exportParamsOf(format, given(), profile.empty() ? std::nullopt : std::optional(Profile()));
    if (params)
        return {};
    return Error{params.error().code, optionOf(params.error().where), params.error().message};
}

std::string ExportOptions::firstGiven() const
{
    for (const auto& [parameter, value] : given())
        return optionName(*parameter);
    return profile.empty() ? "" : "--profile";
}

std::string ExportOptions::record() const
{
    const GivenParameters options = given();
    const auto number = [&](std::string_view name)
    {
        const double value = options.find(name);
        return std::isnan(value) ? 0.0 : value;
    };
    ExportParams params;
    for (const auto& [parameter, value] : options)
        parameterNamed(exportParameters, parameter->name).set(params, value);
    const EnvelopeLimits envelope = params.envelope.value_or(EnvelopeLimits());
    // What was asked for alone: records of before stay what they were.
    const auto asked = [&](std::string_view name, const std::string& text)
    {
        return std::isnan(options.find(name)) ? "" : text;
    };
    const std::string limits =
        envelope != EnvelopeLimits()
            ? fmt::format(", envelope {} points {} to {} ms", envelope.points, envelope.shortest, envelope.longest)
            : "";
    return fmt::format(
        "points {}, frequency points {}, sample rate {}{}{}{}{}{}{}", number("points"), number("frequencyPoints"),
        number("sampleRate"), limits, asked("split", ", split"), asked("quick", ", quick"),
        asked("events", params.events == EventExport::merged ? ", events merged" : ", events transients"),
        profile.empty() ? "" : ", profile " + profile,
        asked("strength", fmt::format(", strength {}", params.strength)));
}

} // namespace pacini::cli
