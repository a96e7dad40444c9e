#include "cli/Command.h"
#include "cli/Options.h"
#include "cli/study/OpenStudy.h"
#include "io/FileHandle.h"
#include "study/Session.h"
#include "study/StudyResults.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

namespace pacini::cli
{

namespace
{
/// `study forget`: a participant's answers, all of them.
struct ForgetSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        auto* command = addStudyCommand(app, "forget", "Delete all answers of a participant", named);
        addOption(*command, "participant", participant, "Pseudonym, such as P007", "NAME")->required();
        command->add_flag("--yes", sure, "Delete the answers; without this option the command only lists them");
        return command->footer(
            "The place becomes free: the next session takes it, with its group and orders. Earlier reports and\ntables "
            "still contain the answers.\n\nExample:\n  pacini study forget coherence P007 --yes");
    }

    Exit run(Console& console) override
    {
        const fs::path folder = study::studyFileOf(named).parent_path();
        for (const fs::path& log : study::sessionLogs(folder))
        {
            if (log.stem() != participant)
                continue;
            if (!sure)
            {
                console.print(fmt::format("{} would be deleted; confirm with --yes", printable(log.string())));
                return Exit::ok;
            }
            std::error_code failed;
            if (!fs::remove(log, failed))
                return console.fail(log.string(), fileError(failed.value()));
            console.addToReport({{"deleted", log.string()}});
            console.note(fmt::format("{} is deleted", printable(log.string())));
            return Exit::ok;
        }
        return console.fail(
            named, {ErrorCode::invalidArgument, "", fmt::format("has no session of '{}'", printable(participant))});
    }

    std::string named, participant;
    bool sure = false;
};
} // namespace

std::unique_ptr<Command> forgetStudySubcommand()
{
    return std::make_unique<ForgetSubcommand>();
}

} // namespace pacini::cli
