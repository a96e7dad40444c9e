#pragma once

// Parameters of exports, and the formats in which each has an effect.

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

/// Descriptions of the user settings of ExportParams, except for the profile.
inline constexpr std::array exportParameters{
    ExportParameter{
        described<&ExportParams::amplitudePoints>(
            {.name = "points",
             .text = "Maximum number of amplitude points; by default a clip with one voice keeps its points",
             .unit = "per second",
             .range = {0.5, 10000},
             .usualText = "the format's own",
             .group = "Other formats"}),
        &ExportChoices::amplitudePoints},
    ExportParameter{described<&ExportParams::frequencyPoints>({.name = "frequencyPoints",
                                                               .text = "Maximum number of frequency points",
                                                               .unit = "per second",
                                                               .range = {0.5, 10000},
                                                               .usualText = "three quarters of the amplitude points",
                                                               .group = "Other formats"}),
                    &ExportChoices::frequencyPoints},
    ExportParameter{
        described<&ExportParams::split>({.name = "split",
                                         .text = "Write several files, in formats that allow one or several",
                                         .group = "Other formats"}),
        &ExportChoices::split},
    ExportParameter{
        described<&ExportParams::quick>(
            {.name = "quick",
             .text =
                 "Skip the search for the best file (hjif, hmpg): much faster, usually a little less like the sound",
             .group = "Other formats"}),
        &ExportChoices::quick},
    ExportParameter{
        described<&ExportParams::events>(
            {.name = "events",
             .text = "How events are written (haptic, ahap, hjif, hmpg, pulsar): as transients, with the voice ducked "
                     "around them, or merged into the voice where it is as strong",
             .choices = eventExportNames,
             .usualText = "transients; merged in hjif and hmpg",
             .group = "Other formats"}),
        nullptr},
    ExportParameter{described<&ExportParams::envelope, &EnvelopeLimits::points>(
                        {.name = "maxPoints",
                         .text = "Maximum number of control points in an Android envelope, at any cost in detail",
                         .range = {2, 1000},
                         .usualText = "any number",
                         .group = "Other formats"}),
                    &ExportChoices::envelope},
    ExportParameter{described<&ExportParams::envelope, &EnvelopeLimits::shortest>(
                        {.name = "minSegment",
                         .text = "Minimum time between control points; all devices support 20",
                         .unit = "ms",
                         .range = {1, 10000},
                         .usualText = "1",
                         .group = "Other formats"}),
                    &ExportChoices::envelope},
    ExportParameter{described<&ExportParams::envelope, &EnvelopeLimits::longest>(
                        {.name = "maxSegment",
                         .text = "Maximum time between control points; all devices support 1000",
                         .unit = "ms",
                         .range = {2, 100000},
                         .usualText = "1000",
                         .group = "Other formats"}),
                    &ExportChoices::envelope},
    ExportParameter{described<&ExportParams::sampleRate>({.name = "sampleRate",
                                                          .text = "Sample rate, in formats that contain samples",
                                                          .unit = "Hz",
                                                          .range = {2000, 48000},
                                                          .usualText = "the format's own",
                                                          .group = "Other formats"}),
                    &ExportChoices::drive},
    ExportParameter{described<&ExportParams::strength>(
                        {.name = "strength",
                         .text = "Balance of fidelity and felt level on resonant actuators, in formats that contain "
                                 "samples: 0 plays as flat as possible, 1 plays everything on the resonance",
                         .range = {0, 1},
                         .group = "Other formats"}),
                    &ExportChoices::drive},
};

/// Sentence of `profile`, which is a file or a name.
inline constexpr std::string_view exportProfileText =
    "Actuator profile: a file or a shipped profile; sets the frequency range in formats that state none";

/// Returns all of exportParameters.
[[nodiscard]] std::span<const ParameterInfo* const> exportParameterInfos();

/// Their descriptions and that of `profile`, each with its formats.
[[nodiscard]] nlohmann::ordered_json exportDescriptionsJson();

/// The parameters that were given for `format`. Errors: invalidArgument at the name of a parameter that changes nothing
/// in it, `profile` among them, or without a profile, or whose value is not allowed.
[[nodiscard]] Result<ExportParams> exportParamsOf(const ClipFormat& format, const GivenParameters& given,
                                                  std::optional<Profile> profile = {});

} // namespace pacini
