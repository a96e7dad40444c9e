#include "io/formats/ExportParameters.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace pacini
{

namespace
{
constexpr double frequencyShare = 0.75; // of the points of amplitude

/// "haptic, ahap, hjif"
template <typename IsIn>
std::string formatsWith(IsIn isIn)
{
    std::string names;
    for (const FormatDescription& format : formatDescriptions())
        if (const ClipFormat* known = clipFormatNamed(format.name);
            known != nullptr && known->isWritten() && isIn(*known))
            names += (names.empty() ? "" : ", ") + std::string(format.name);
    return names;
}

template <typename IsIn>
Result<void> checkUse(std::string_view name, const ClipFormat& format, IsIn isIn)
{
    if (isIn(format))
        return {};
    const std::string others = formatsWith(isIn);
    const std::string advice = others.empty() ? "leave it out" : "leave it out, or write one of " + others;
    return Error{ErrorCode::invalidArgument, std::string(name),
                 format.isOwn() ? fmt::format("is for formats of other programs, but {} keeps the whole clip; {}",
                                              format.name, advice)
                                : fmt::format("has no effect in {}; {}", format.name, advice)};
}
bool hasProfile(const ClipFormat& format)
{
    return format.choices.profile;
}
} // namespace

std::span<const ParameterInfo* const> exportParameterInfos()
{
    static constexpr auto all = []
    {
        std::array<const ParameterInfo*, exportParameters.size()> infos{};
        for (std::size_t i = 0; i < infos.size(); ++i)
            infos[i] = &exportParameters[i];
        return infos;
    }();
    return all;
}

nlohmann::ordered_json exportDescriptionsJson()
{
    auto all = nlohmann::ordered_json::array();
    const auto add = [&all](const nlohmann::ordered_json& one, auto isIn)
    {
        all.push_back(one);
        for (const ClipFormat& format : clipFormats())
            if (format.isWritten() && isIn(format))
                all.back()["formats"].push_back(format.name);
    };
    for (const ExportParameter& parameter : exportParameters)
        add(descriptionJson(parameter), [&](const ClipFormat& format) { return parameter.isIn(format); });
    add({{"name", "profile"},
         {"option", "--profile"},
         {"kind", "profile"},
         {"unit", ""},
         {"text", exportProfileText},
         {"group", "Other formats"},
         {"since", "0.1"}},
        hasProfile);
    return all;
}

Result<ExportParams> exportParamsOf(const ClipFormat& format, const GivenParameters& given,
                                    std::optional<Profile> profile)
{
    ExportParams params;
    for (const auto& [info, value] : given)
    {
        const ExportParameter& parameter = parameterNamed(exportParameters, info->name);
        if (auto used = checkUse(info->name, format, [&](const ClipFormat& one) { return parameter.isIn(one); }); !used)
            return used.error();
        if (auto allowed = checkValue(parameter, value); !allowed)
            return allowed.error();
        parameter.set(params, value);
    }
    if (params.amplitudePoints && !params.frequencyPoints)
        params.frequencyPoints = frequencyShare * *params.amplitudePoints;
    if (params.envelope && params.envelope->longest < 2 * params.envelope->shortest)
        return Error{ErrorCode::invalidArgument, std::isnan(given.find("maxSegment")) ? "minSegment" : "maxSegment",
                     fmt::format("makes segments of {} to {} ms, but the longest must be at least twice the shortest; "
                                 "raise --max-segment or lower --min-segment",
                                 params.envelope->shortest, params.envelope->longest)};
    if (params.envelope == EnvelopeLimits())
        params.envelope.reset();
    if (!std::isnan(given.find("strength")) && !profile)
        return Error{ErrorCode::invalidArgument, "strength", "needs a profile; leave it out, or name one"};
    if (profile)
    {
        const auto used = checkUse("profile", format, hasProfile);
        if (!used)
            return used.error();
        params.profile = std::move(profile);
    }
    return params;
}

} // namespace pacini
