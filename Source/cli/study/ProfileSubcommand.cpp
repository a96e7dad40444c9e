#include "cli/Command.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/ProfileInput.h"
#include "cli/study/OpenStudy.h"
#include "io/ProfileFile.h"
#include "study/PersonalProfile.h"

#include <fmt/format.h>

namespace pacini::cli
{

namespace
{
/// `study profile`: an actuator for one person.
struct ProfileSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        auto* command = app.add_subcommand("profile", "Write an actuator profile with the thresholds of a participant");
        addOption(*command, "study", named, "Folder or file of a study with thresholds", "STUDY")->required();
        addOption(*command, "participant", participant, "Pseudonym, such as P007", "NAME")->required();
        addOption(*command, "--profile", profile,
                  "Actuator profile of the study: a file or a shipped profile [that of the study]", "PROFILE");
        addOption(*command, "-o,--output", output, "Profile to write", "OUT")->required();
        overwriting.declare(*command);
        return command->footer(
            "The dynamic range of the profile becomes that of the person: from full drive down to the mean of "
            "the\nthresholds. Render, plugin and editor then raise weak parts of clips to the level that this person "
            "feels.\nUse a study made by 'study new --template threshold' and run with the same profile.\n\nExample:\n"
            "  pacini study profile thresholds P007 --profile l5-wristband -o mine.json");
    }

    Exit run(Console& console) override
    {
        const auto results = openResults(console, named);
        if (!results)
            return Exit::failed;
        const std::string actuator = actuatorOf(results->study, study::studyFileOf(named).parent_path(), profile);
        if (actuator.empty())
            return console.fail("",
                                {ErrorCode::invalidArgument, "--profile",
                                 "is missing, and the study names no actuator; choose one with --profile"},
                                Exit::usage);
        const auto base = openProfile(console, actuator);
        if (!base)
            return Exit::failed;
        const auto personal = study::personalProfile(*base, *results, participant);
        if (!personal)
            return console.fail(named, personal.error());
        if (overwriting.keeps(console, {output}))
            return Exit::ok;
        const auto written = writeProfile(output, *personal);
        if (!written)
            return console.fail(output, written.error());
        console.addToReport({{"output", output}, {"dynamicRange", personal->range.dynamicRange}});
        console.wrote(output,
                      fmt::format("dynamic range {} dB instead of {} dB", decimalText(personal->range.dynamicRange, 1),
                                  decimalText(base->range.dynamicRange, 1)));
        return Exit::ok;
    }

    std::string named, participant, profile, output;
    OverwriteOptions overwriting;
};
} // namespace

std::unique_ptr<Command> profileStudySubcommand()
{
    return std::make_unique<ProfileSubcommand>();
}

} // namespace pacini::cli
