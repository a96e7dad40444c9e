// Command group for studies with people.

#include "cli/CommandGroup.h"
#include "cli/study/ToneSubcommand.h"

#include <memory>

namespace pacini::cli
{

namespace
{
/// `pacini study`: from a question to its statistics.
struct StudyCommand : CommandGroup
{
    CLI::App* declare(CLI::App& app) override
    {
        auto* command = app.add_subcommand("study", "Plan, check, simulate and evaluate studies with participants");
        command->require_subcommand(1);
        for (const auto make : {newStudySubcommand, checkStudySubcommand, simulateStudySubcommand, toneStudySubcommand,
                                latencyStudySubcommand, reportStudySubcommand, profileStudySubcommand,
                                exportStudySubcommand, forgetStudySubcommand})
            addStep(*command, make());
        return command->footer(
            "Example:\n"
            "  pacini study new coherence --template coherence sounds/\n"
            "  pacini study check coherence --profile l5-wristband\n"
            "  pacini study simulate coherence --effect 1\n"
            "Run the sessions in the editor: Tools, Run a study... Then\n"
            "  pacini study report coherence\n"
            "A study is a folder with study.json and, below sessions, one file for each participant.");
    }
};
} // namespace

std::unique_ptr<Command> studyCommand()
{
    return std::make_unique<StudyCommand>();
}

} // namespace pacini::cli
