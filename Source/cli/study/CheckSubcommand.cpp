#include "cli/Command.h"
#include "cli/Options.h"
#include "cli/ProfileInput.h"
#include "cli/study/OpenStudy.h"
#include "study/StudyCheck.h"

#include <fmt/format.h>

#include <utility>

namespace pacini::cli
{

namespace
{
/// `study check`: finds problems of a study.
struct CheckSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        auto* command = addStudyCommand(app, "check", "Check a study for problems before inviting participants", named);
        addOption(*command, "--profile", profile, "Actuator profile: a file or a shipped profile [that of the study]",
                  "PROFILE");
        return command->footer(
            "Finds missing files and texts, uneven groups, sessions that are too long, exposure beyond the limit\n(ISO "
            "5349-1 or 2631-1), and stimuli that can hardly be distinguished. Exits with 1 if the study cannot be run.");
    }

    Exit run(Console& console) override
    {
        auto opened = openStudy(console, named);
        if (!opened)
            return Exit::failed;
        study::StimulusParams params;
        params.folder = opened->folder;
        const std::string actuator = actuatorOf(opened->study, opened->folder, profile);
        if (!actuator.empty())
        {
            params.profile = openProfile(console, actuator);
            if (!params.profile)
                return Exit::failed;
        }
        const auto check = study::checkStudy(opened->study, params,
                                             [&](double share) { console.progress(share, "making the stimuli"); });
        console.endProgress();
        const std::string file = opened->file.string();
        JsonReport::Json findings = JsonReport::Json::array(), groups = JsonReport::Json::array();
        bool spoils = false;
        for (const study::Finding& one : check.findings)
        {
            spoils = spoils || one.spoils;
            findings.push_back({{"spoils", one.spoils}, {"where", one.where}, {"message", one.message}});
            if (one.spoils)
                console.error(file, {ErrorCode::invalidData, one.where, one.message});
            else
                console.warning(file, one.where + ": " + one.message);
        }
        for (const study::GroupLoad& load : check.loads)
        {
            groups.push_back({{"group", load.group},
                              {"trials", load.trials},
                              {"minutes", load.minutes},
                              {"exposure", load.exposure}});
            console.print(
                fmt::format("{}: {} trials, some {:.0f} minutes, A(8) = {:.2f} m/s2{} of {:.1f} allowed", load.group,
                            load.trials, load.minutes, load.exposure,
                            check.exposureIsAssumed
                                ? fmt::format(" (assuming {:.0f} m/s2 at full drive, which the profile does not state)",
                                              study::assumedAcceleration)
                                : "",
                            opened->study.limits.daily));
        }
        console.addToReport({{"findings", std::move(findings)},
                             {"groups", std::move(groups)},
                             {"exposureIsAssumed", check.exposureIsAssumed}});
        if (check.findings.empty())
            console.note("no problems found");
        return spoils ? Exit::failed : Exit::ok;
    }

    std::string named, profile;
};
} // namespace

std::unique_ptr<Command> checkStudySubcommand()
{
    return std::make_unique<CheckSubcommand>();
}

} // namespace pacini::cli
