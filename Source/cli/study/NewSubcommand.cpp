#include "cli/Command.h"
#include "cli/Counted.h"
#include "cli/InputFiles.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/ProfileInput.h"
#include "io/AtomicFile.h"
#include "study/Plan.h"
#include "study/Questionnaires.h"
#include "study/StudyFile.h"
#include "study/StudyResults.h"
#include "study/StudyTemplates.h"

#include <pacini/foundation/ParseNumber.h>

#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <utility>

namespace pacini::cli
{

namespace
{
/// Groups as NAME:SIZE.
Result<std::vector<study::Group>> groupsOf(const std::vector<std::string>& texts)
{
    std::vector<study::Group> groups;
    for (const std::string& text : texts)
    {
        const std::size_t colon = text.rfind(':');
        const auto size = colon == std::string::npos ? std::nullopt : parseNumber<int>(text.substr(colon + 1));
        if (!size || *size < 1 || *size > study::studyLimits::participants || colon == 0)
            return Error{ErrorCode::invalidArgument, "--group",
                         fmt::format("'{}' is not a name and a number of participants, such as A:11", text)};
        groups.push_back({text.substr(0, colon), *size});
    }
    return groups;
}

/// `study new`: a study to begin with.
struct NewSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override
    {
        std::vector<std::string> names;
        std::string list, questions;
        for (const auto& one : study::studyTemplates())
        {
            names.emplace_back(one.name);
            list += fmt::format("  {:<15}{}\n  {:<15}(sounds: {})\n", one.name, one.purpose, "", soundsOf(one));
        }
        auto* command = app.add_subcommand("new", "Create a study from a template");
        addOption(*command, "output", output, "Folder for study.json and the answers, or the name of a .json file",
                  "STUDY")
            ->required();
        addOption(*command, "sounds", sounds, "Sounds to present, or folders of sounds; as many as the template takes",
                  "SOUND");
        addOption(*command, "-t,--template", kind, "Template: the kind of question", oneOf(names), "NAME")->required();
        addOption(*command, "-g,--group", groups,
                  "Name and number of participants of a group; repeat for several groups", "NAME:SIZE")
            ->allow_extra_args(false);
        std::vector<std::string> askable;
        for (const auto& one : study::questionnaires())
        {
            askable.emplace_back(one.name);
            questions += fmt::format("  {:<15}{}\n", one.name, one.purpose);
        }
        addOption(*command, "--ask", asked, "Questionnaire at the beginning; repeat for several", oneOf(askable),
                  "NAME")
            ->allow_extra_args(false);
        addOption(*command, "--seed", seed, "Seed of all random orders", countingNumber(), "N")->capture_default_str();
        addOption(*command, "--profile", profile, "Actuator profile: a file or a shipped profile", "PROFILE");
        overwriting.declare(*command);
        return command->footer("Templates:\n" + list + "\nQuestionnaires:\n" + questions +
                               "\nEdit the JSON file to change the study: see Resources/docs/study.md.\n\nExample:\n"
                               "  pacini study new coherence --template coherence sounds/");
    }

    Exit run(Console& console) override
    {
        const fs::path named(output);
        const bool isFile = named.extension() == ".json";
        const fs::path file = isFile ? named : named / study::studyFileName;
        const fs::path folder = file.parent_path();
        std::error_code unknown;
        if (overwriting.keeps(console, {file}))
            return Exit::ok;
        if (isOccupied(file) && !overwriting.replacesAll())
            return console.fail(file.string(), {ErrorCode::io, "", "exists; -y replaces it"});
        const InputFiles found = findInputs(sounds, audioExtensions());
        for (const InputFailure& failure : found.failures)
            return console.fail(failure.path.string(), failure.error);
        std::vector<std::string> files;
        for (const InputFile& input : found.files)
        {
            if (!fs::is_regular_file(input.path, unknown))
                return console.fail(input.path.string(),
                                    {ErrorCode::io, "", "does not exist; check the name and the folder"});
            files.push_back(input.path.string());
        }
        auto made = study::makeStudy(kind, files);
        if (!made)
            return console.fail("", made.error(), Exit::usage);
        const auto own = groupsOf(groups);
        if (!own)
            return console.fail("", own.error(), Exit::usage);
        if (const auto set = own->empty() ? Result<void>() : study::setGroups(*made, *own); !set)
            return console.fail("", set.error(), Exit::usage);
        for (const std::string& one : asked)
            if (const auto added = study::addQuestionnaire(*made, one); !added)
                return console.fail("", added.error(), Exit::usage);
        made->seed = seed;
        if (!profile.empty())
        {
            const auto actuator = openProfile(console, profile);
            if (!actuator)
                return Exit::failed;
            study::setActuator(*made, profile, *actuator);
        }
        const study::Study written = study::relocated(std::move(*made), fs::path(), folder);
        if (const auto valid = study::validate(written); !valid)
            return console.fail("", valid.error());
        fs::create_directories(folder.empty() ? fs::path(".") : folder, unknown);
        const auto done = writeFileAtomically(file, study::studyJson(written));
        if (!done)
            return console.fail(file.string(), done.error());
        console.addToReport({{"study", file.string()}, {"participants", study::participantsOf(written)}});
        console.wrote(file, fmt::format("{}, {}, {}", counted(written.stimuli.size(), "stimulus", "stimuli"),
                                        counted(written.blocks.size(), "block", "blocks"),
                                        counted(static_cast<std::size_t>(study::participantsOf(written)), "participant",
                                                "participants")));
        return Exit::ok;
    }

    std::string output, kind, profile;
    std::vector<std::string> sounds, groups, asked;
    std::uint64_t seed = 1;
    OverwriteOptions overwriting;
};
} // namespace

std::unique_ptr<Command> newStudySubcommand()
{
    return std::make_unique<NewSubcommand>();
}

} // namespace pacini::cli
