// Command group for studies with people: from a question to its statistics.

#include "cli/CommandGroup.h"
#include "cli/study/ToneSubcommand.h"

namespace pacini::cli
{

std::unique_ptr<Command> studyCommand()
{
    return commandGroup("study", "Plan, check, simulate and evaluate studies with participants",
                        {newStudySubcommand, checkStudySubcommand, simulateStudySubcommand, toneStudySubcommand,
                         latencyStudySubcommand, reportStudySubcommand, profileStudySubcommand, exportStudySubcommand,
                         forgetStudySubcommand},
                        "Example:\n"
                        "  pacini study new coherence --template coherence sounds/\n"
                        "  pacini study check coherence --profile l5-wristband\n"
                        "  pacini study simulate coherence --effect 1\n"
                        "Run the sessions in the editor: Tools, Run a study... Then\n"
                        "  pacini study report coherence\n"
                        "A study is a folder with study.json and, below sessions, one file for each participant.");
}

} // namespace pacini::cli
