#include "cli/ExportOptions.h"

#include "cli/Options.h"
#include "cli/ProfileInput.h"

#include <fmt/format.h>

namespace pacini::cli
{

void ExportOptions::declare(CLI::App& command)
{
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
    addOption(command, "--sample-rate", rate, "Sample rate of formats that hold samples, Hz [the format's own]",
              wholeNumberFrom(100, 384000));
    addOption(command, "--profile", profile,
              "Actuator whose frequency range is used by formats that state none: a file or a shipped profile",
              "PROFILE");
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
    result.split = split;
    result.quick = quick;
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

std::string ExportOptions::record() const
{
    return fmt::format("points {}, frequency points {}, sample rate {}{}{}{}{}", points, frequencyPoints, rate,
                       split ? ", split" : "", quick ? ", quick" : "", events.empty() ? "" : ", events " + events,
                       profile.empty() ? "" : ", profile " + profile);
}

bool ExportOptions::given() const noexcept
{
    return points > 0.0 || frequencyPoints > 0.0 || rate > 0 || split || quick || !events.empty() || !profile.empty();
}

} // namespace pacini::cli
