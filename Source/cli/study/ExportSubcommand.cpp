#include "cli/Command.h"
#include "cli/Counted.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/study/OpenStudy.h"
#include "io/AtomicFile.h"
#include "study/StudyExport.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

namespace pacini::cli
{

namespace
{
/// `study export`: for other programs.
struct ExportSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        auto* command = addStudyCommand(
            app, "export", "Write all answers as tables for other programs (CSV, and folders in the layout of BIDS)",
            named);
        addOption(*command, "-o,--output", output, "New folder for the tables", "DIR")->required();
        overwriting.declare(*command);
        return command->footer(
            "answers.csv has a line for each answer; 'study report' reads ratings.csv. Below bids every "
            "participant\nhas a folder with sub-P001_task-NAME_beh.tsv, as the Brain Imaging Data Structure specifies "
            "for\nbehavioural data.\n\nExample:\n  pacini study export coherence -o tables");
    }

    Exit run(Console& console) override
    {
        const auto results = openResults(console, named);
        if (!results)
            return Exit::failed;
        std::error_code failed;
        const bool isThere = fs::exists(output, failed) && !fs::is_empty(output, failed);
        if (isThere && overwriting.keepsAll())
        {
            console.kept(output);
            return Exit::ok;
        }
        if (isThere && !overwriting.replacesAll())
            return console.fail(
                output, {ErrorCode::io, "", "exists and is not empty; -y replaces its tables, or name a new folder"});
        const auto files = study::exportedFiles(*results);
        for (const auto& [name, text] : files)
        {
            const fs::path file = fs::path(output) / name;
            fs::create_directories(file.parent_path(), failed);
            if (failed)
                return console.fail(file.parent_path().string(), fileError(failed.value()));
            if (const auto written = writeFileAtomically(file, text); !written)
                return console.fail(file.string(), written.error());
        }
        console.addToReport({{"output", output}, {"files", files.size()}});
        console.note(fmt::format("{}: {} of {}", printable(output), counted(files.size(), "file", "files"),
                                 counted(results->sessions.size(), "session", "sessions")));
        return Exit::ok;
    }

    std::string named, output;
    OverwriteOptions overwriting;
};
} // namespace

std::unique_ptr<Command> exportStudySubcommand()
{
    return std::make_unique<ExportSubcommand>();
}

} // namespace pacini::cli
