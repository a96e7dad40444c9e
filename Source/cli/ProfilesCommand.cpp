// Subcommand that lists the shipped actuator profiles.

#include "cli/Command.h"
#include "cli/ProfileReport.h"
#include "cli/ProgramFolder.h"
#include "io/ProfileFields.h"
#include "io/ProfileFile.h"
#include "io/ShippedProfiles.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace pacini::cli
{

namespace
{
/// `pacini profiles`: the actuators that come with Pacini.
struct ProfilesCommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        auto* command = app.add_subcommand("profiles", "List the actuator profiles that come with Pacini");
        return command->footer("'pacini info NAME' shows one of them, 'pacini render --profile NAME' renders for it.\n"
                               "Examples:\n  pacini profiles\n  pacini profiles --json");
    }

    Exit run(Console& console) override
    {
        using Json = nlohmann::ordered_json;
        const auto shipped = shippedProfiles(programFolder());
        if (shipped.empty())
            return console.fail(programFolder().string(),
                                {ErrorCode::io, "", "has no folder 'profiles' in it or above it"});
        std::size_t width = 0;
        for (const ShippedProfile& entry : shipped)
            width = std::max(width, entry.name.size());
        bool failed = false;
        Json list = Json::array();
        std::string lines;
        for (const ShippedProfile& entry : shipped)
        {
            ReadWarnings warnings(console.isStrict());
            const auto profile = readProfile(entry.path, &warnings);
            console.warnings(entry.path.string(), warnings.texts());
            if (!profile)
            {
                console.error(entry.path.string(), profile.error());
                failed = true;
                continue;
            }
            list.push_back({{"name", entry.name},
                            {"title", profile->name},
                            {"technology", nameOf(profile->technology, profileFields::technologies)},
                            {"resonance", profile->resonance.frequency},
                            {"lowFrequency", profile->range.lowFrequency},
                            {"highFrequency", profile->range.highFrequency},
                            {"polyphony", profile->polyphony},
                            {"path", entry.path.string()}});
            lines +=
                fmt::format("{:<{}}  {:<24}  {:>4.0f} Hz in {:>3.0f}-{:<4.0f} Hz  voices: {}\n", printable(entry.name),
                            width, technologyText(profile->technology), profile->resonance.frequency,
                            profile->range.lowFrequency, profile->range.highFrequency, voicesText(profile->polyphony));
        }
        const auto folder = shipped.front().path.parent_path();
        console.addToReport({{"folder", folder.string()}, {"profiles", list}});
        console.print(lines + "They are in " + printable(folder.string()));
        return failed ? Exit::failed : Exit::ok;
    }
};
} // namespace

std::unique_ptr<Command> profilesCommand()
{
    return std::make_unique<ProfilesCommand>();
}

} // namespace pacini::cli
