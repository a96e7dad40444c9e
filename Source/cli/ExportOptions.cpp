#include "cli/ExportOptions.h"

#include "cli/Options.h"
#include "cli/ProfileInput.h"

#include <fmt/format.h>

namespace pacini::cli
{

namespace
{
/// An option and the choice of a format that it is.
struct ExportOption
{
    const char* name;
    bool ExportChoices::*choice; ///< null: how events are written

    [[nodiscard]] bool isIn(const ClipFormat& format) const
    {
        return choice != nullptr ? format.choices.*choice : format.events.has_value();
    }
};

constexpr ExportOption exportOptions[] = {
    {"--points", &ExportChoices::amplitudePoints},
    {"--frequency-points", &ExportChoices::frequencyPoints},
    {"--split", &ExportChoices::split},
    {"--quick", &ExportChoices::quick},
    {"--max-points", &ExportChoices::envelope},
    {"--min-segment", &ExportChoices::envelope},
    {"--max-segment", &ExportChoices::envelope},
    {"--events", nullptr},
    {"--sample-rate", &ExportChoices::drive},
    {"--profile", &ExportChoices::profile},
    {"--strength", &ExportChoices::drive},
};

/// "haptic, ahap, hjif"
std::string formatsWith(const ExportOption& option)
{
    std::string names;
    for (const ClipFormat& format : clipFormats())
        if (format.isWritten() && option.isIn(format))
            names += (names.empty() ? "" : ", ") + std::string(format.name);
    return names;
}
} // namespace

void ExportOptions::declare(CLI::App& command)
{
    declaredIn = &command;
    addOption(command, "--points", points,
              "For other formats: at most this many points of amplitude per second; without it a clip of one "
              "voice keeps its points [as usual for the format]",
              numberFrom(0.5, 10000.0));
    addOption(command, "--frequency-points", frequencyPoints,
              "For other formats: at most this many points of frequency per second [three quarters of --points]",
              numberFrom(0.5, 10000.0));
    command.add_flag("--split", split, "For formats that can be one file or several: write several");
    command.add_flag(
        "--quick", quick,
        "Write without a search for the best file (hjif): much faster, mostly a little less like the sound");
    addOption(
        command, "--events", events,
        "Events of other formats: each a transient of its own, with the voice ducked around it, or merged into the "
        "voice where that is as strong (haptic, ahap, hjif) [transients; in hjif merged]",
        oneOf({"transients", "merged"}));
    addOption(command, "--max-points", envelope.points,
              "At most this many control points in an envelope of Android, whatever that costs [any number]",
              wholeNumberFrom(2, 1000));
    addOption(command, "--min-segment", envelope.shortest,
              "At least this many ms from one control point to the next; every device plays 20 [1]",
              wholeNumberFrom(1, 10000), "MS");
    addOption(command, "--max-segment", envelope.longest,
              "At most this many ms from one control point to the next; every device plays 1000 [1000]",
              wholeNumberFrom(2, 100000), "MS");
    addOption(command, "--sample-rate", rate, "Sample rate of formats that hold samples, Hz [the format's own]",
              wholeNumberFrom(100, 384000));
    addOption(command, "--profile", profile,
              "Actuator whose frequency range is used by formats that state none: a file or a shipped profile",
              "PROFILE");
    addStrength(command, strength, ", in formats that hold samples");
}

std::optional<ExportParams> ExportOptions::params(Console& console) const
{
    constexpr double frequencyShare = 0.75;
    ExportParams result;
    if (points > 0.0)
    {
        result.amplitudePoints = points;
        result.frequencyPoints = frequencyShare * points;
    }
    if (frequencyPoints > 0.0)
        result.frequencyPoints = frequencyPoints;
    if (rate > 0)
        result.sampleRate = rate;
    if (envelope != EnvelopeLimits())
        result.envelope = envelope;
    result.split = split;
    result.quick = quick;
    result.strength = strength;
    if (!events.empty())
        result.events = events == "merged" ? EventExport::merged : EventExport::transients;
    if (!profile.empty())
    {
        result.profile = openProfile(console, profile);
        if (!result.profile)
            return std::nullopt;
    }
    return result;
}

Result<void> ExportOptions::checkFor(const ClipFormat& format) const
{
    for (const ExportOption& option : exportOptions)
        if (declaredIn->count(option.name) > 0 && !option.isIn(format))
            return Error{ErrorCode::invalidArgument, option.name,
                         format.isOwn() ? fmt::format("is for formats of other programs, but {} holds all of a clip; "
                                                      "leave it out, or write one of {}",
                                                      format.name, formatsWith(option))
                                        : fmt::format("changes nothing in {}; leave it out, or write one of {}",
                                                      format.name, formatsWith(option))};
    return {};
}

std::string ExportOptions::firstGiven() const
{
    for (const ExportOption& option : exportOptions)
        if (declaredIn->count(option.name) > 0)
            return option.name;
    return {};
}

std::string ExportOptions::record() const
{
    // Strength only where it was asked for: records of before stay what they were.
    const std::string chosenStrength =
        declaredIn->count("--strength") > 0 ? fmt::format(", strength {}", strength) : "";
    const std::string limits =
        envelope != EnvelopeLimits()
            ? fmt::format(", envelope {} points {} to {} ms", envelope.points, envelope.shortest, envelope.longest)
            : "";
    return fmt::format("points {}, frequency points {}, sample rate {}{}{}{}{}{}{}", points, frequencyPoints, rate,
                       limits, split ? ", split" : "", quick ? ", quick" : "",
                       events.empty() ? "" : ", events " + events, profile.empty() ? "" : ", profile " + profile,
                       chosenStrength);
}

} // namespace pacini::cli
