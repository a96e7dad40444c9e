#pragma once

// What users can set of exports, and the formats in which each changes anything.

#include "io/GivenParameters.h"
#include "io/formats/ClipFormat.h"

#include <pacini/foundation/Description.h>
#include <pacini/foundation/Result.h>

#include <nlohmann/json.hpp>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace pacini
{

/// Description of a field of ExportParams, and the choice of formats that it is.
struct ExportParameter : Parameter<ExportParams>
{
    bool ExportChoices::*choice = nullptr; ///< null: ClipFormat::events

    [[nodiscard]] bool isIn(const ClipFormat& format) const
    {
        return choice != nullptr ? format.choices.*choice : format.events.has_value();
    }
};

inline constexpr std::array<std::string_view, 2> eventExportNames{"transients", "merged"};

/// What users can set of ExportParams, beside the profile.
inline constexpr std::array exportParameters{
    ExportParameter{described<&ExportParams::amplitudePoints>(
                        {.name = "points",
                         .text = "Most points of amplitude; without it a clip of one voice keeps its points",
                         .unit = "per second",
                         .range = {0.5, 10000},
                         .usualText = "as usual for the format",
                         .group = "Other formats"}),
                    &ExportChoices::amplitudePoints},
    ExportParameter{described<&ExportParams::frequencyPoints>({.name = "frequencyPoints",
                                                               .text = "Most points of frequency",
                                                               .unit = "per second",
                                                               .range = {0.5, 10000},
                                                               .usualText = "three quarters of the points of amplitude",
                                                               .group = "Other formats"}),
                    &ExportChoices::frequencyPoints},
    ExportParameter{
        described<&ExportParams::split>({.name = "split",
                                         .text = "For formats that can be one file or several: write several",
                                         .group = "Other formats"}),
        &ExportChoices::split},
    ExportParameter{described<&ExportParams::quick>(
                        {.name = "quick",
                         .text = "Write without a search for the best file (hjif): much faster, mostly a little less "
                                 "like the sound",
                         .group = "Other formats"}),
                    &ExportChoices::quick},
    ExportParameter{described<&ExportParams::events>(
                        {.name = "events",
                         .text = "Events: each a transient of its own, with the voice ducked around it, or merged into "
                                 "the voice where that is as strong (haptic, ahap, hjif)",
                         .choices = eventExportNames,
                         .usualText = "transients; in hjif merged",
                         .group = "Other formats"}),
                    nullptr},
    ExportParameter{described<&ExportParams::envelope, &EnvelopeLimits::points>(
                        {.name = "maxPoints",
                         .text = "Most control points in an envelope of Android, whatever that costs",
                         .range = {2, 1000},
                         .usualText = "any number",
                         .group = "Other formats"}),
                    &ExportChoices::envelope},
    ExportParameter{described<&ExportParams::envelope, &EnvelopeLimits::shortest>(
                        {.name = "minSegment",
                         .text = "Least time from one control point to the next; every device plays 20",
                         .unit = "ms",
                         .range = {1, 10000},
                         .usualText = "1",
                         .group = "Other formats"}),
                    &ExportChoices::envelope},
    ExportParameter{described<&ExportParams::envelope, &EnvelopeLimits::longest>(
                        {.name = "maxSegment",
                         .text = "Most time from one control point to the next; every device plays 1000",
                         .unit = "ms",
                         .range = {2, 100000},
                         .usualText = "1000",
                         .group = "Other formats"}),
                    &ExportChoices::envelope},
    ExportParameter{described<&ExportParams::sampleRate>({.name = "sampleRate",
                                                          .text = "Sample rate of formats that hold samples",
                                                          .unit = "Hz",
                                                          .range = {2000, 48000},
                                                          .usualText = "the format's own",
                                                          .group = "Other formats"}),
                    &ExportChoices::drive},
    ExportParameter{described<&ExportParams::strength>(
                        {.name = "strength",
                         .text = "Trade of likeness for strength on resonant actuators, in formats that hold samples: "
                                 "0 plays as flat as can be, 1 all of it on the resonance",
                         .range = {0, 1},
                         .group = "Other formats"}),
                    &ExportChoices::drive},
};

/// Sentence of `profile`, which is a file or a name.
inline constexpr std::string_view exportProfileText =
    "Actuator whose frequency range is used by formats that state none: a file or a shipped profile";

/// All of exportParameters.
[[nodiscard]] std::span<const ParameterInfo* const> exportParameterInfos();

/// Their descriptions and that of `profile`, each with its formats.
[[nodiscard]] nlohmann::ordered_json exportDescriptionsJson();

/// The parameters that were given for `format`. Errors: invalidArgument at the name of a parameter that changes nothing
/// in it, `profile` among them, or whose value is not allowed.
[[nodiscard]] Result<ExportParams> exportParamsOf(const ClipFormat& format, const GivenParameters& given,
                                                  std::optional<Profile> profile = {});

} // namespace pacini
