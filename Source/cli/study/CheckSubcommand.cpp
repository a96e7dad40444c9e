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
/// `study check`: what would spoil it.
class CheckSubcommand : public Command
{
public:
    CLI::App* declare(CLI::App& app) override
    {
        auto* command = app.add_subcommand("check", "Find what would spoil a study before anybody is invited");
        addOption(*command, "study", named, "Folder or file of the study", "STUDY")->required();
        addOption(*command, "--profile", profile,
                  "Actuator: a profile file, or the name of one that comes with Pacini [that of the study]", "PROFILE");
        command->footer(
            "Missing files and texts, uneven groups, sessions that are too long, exposure beyond the limit\n"
            "(ISO 5349-1), stimuli that can hardly be told apart. The exit code is 1 where it cannot be run so.");
        return command;
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
                                ? fmt::format(" (assuming {:.0f} m/s2 at full drive: the profile does not tell)",
                                              study::assumedAcceleration)
                                : "",
                            opened->study.limits.daily));
        }
        console.addToReport({{"findings", std::move(findings)},
                             {"groups", std::move(groups)},
                             {"exposureIsAssumed", check.exposureIsAssumed}});
        if (check.findings.empty())
            console.note("nothing that would spoil it");
        return spoils ? Exit::failed : Exit::ok;
    }

private:
    std::string named, profile;
};
} // namespace

std::unique_ptr<Command> checkStudySubcommand()
{
    return std::make_unique<CheckSubcommand>();
}

} // namespace pacini::cli
