#include "cli/ConvertCommand.h"

#include "cli/Checks.h"
#include "cli/Task.h"
#include "cli/TaskRunner.h"
#include "io/AcfFile.h"
#include "io/AnyClip.h"
#include "io/AtomicFile.h"
#include "io/ProfileFile.h"
#include "io/Sha256.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace pacini::cli
{

namespace
{
using ConvertTask = Task<ConvertResult>;

constexpr const char* manifestName = "pacini.manifest.json";

nlohmann::ordered_json toJson(const ConvertTask& task)
{
    const ConvertResult& result = *task.result;
    auto outputs = nlohmann::ordered_json::array(), losses = nlohmann::ordered_json::array();
    std::size_t bytes = 0;
    for (const ManifestOutput& output : result.entry.outputs)
    {
        outputs.push_back({{"file", output.file}, {"bytes", output.bytes}, {"sha256", output.sha256}});
        bytes += output.bytes;
    }
    for (const FormatLoss& loss : result.entry.losses)
        losses.push_back(cli::toJson(loss));
    return {{"input", task.input.string()},
            {"output", task.output.string()},
            {"bytes", bytes},
            {"duration", result.entry.duration},
            {"outputs", outputs},
            {"losses", losses},
            {"upToDate", result.upToDate}};
}

/// "8.2 kB; loses bands (0.31), text"
std::string details(const ConvertResult& result)
{
    double bytes = 0.0;
    for (const ManifestOutput& output : result.entry.outputs)
        bytes += static_cast<double>(output.bytes);
    std::string text = bytesText(bytes);
    const char* separator = "; loses ";
    for (const FormatLoss& loss : result.entry.losses)
    {
        text += separator + std::string(lossName(loss.kind));
        if (loss.error > 0.0)
            text += fmt::format(" ({:.2g})", loss.error);
        separator = ", ";
    }
    return text;
}

/// The outputs of a task: of the first, which was named, also what it loses.
void sayWritten(Console& console, const ConvertTask& task, const std::filesystem::path& folder)
{
    const auto& outputs = task.result->entry.outputs;
    console.wrote(task.output, details(*task.result));
    for (std::size_t i = 1; i < outputs.size(); ++i)
        console.wrote(folder / outputs[i].file);
}

std::string summary(const std::vector<ConvertTask>& tasks)
{
    std::size_t done = 0, fresh = 0, failed = 0;
    double bytes = 0.0;
    for (const ConvertTask& task : tasks)
    {
        failed += task.error ? 1u : 0u;
        if (!task.result)
            continue;
        (task.result->upToDate ? fresh : done) += 1u;
        for (const ManifestOutput& output : task.result->entry.outputs)
            bytes += static_cast<double>(output.bytes);
    }
    std::string text = fmt::format("{} converted", done);
    if (fresh > 0)
        text += fmt::format(", {} up to date", fresh);
    if (failed > 0)
        text += fmt::format(", {} failed", failed);
    return text + fmt::format(": {}", bytesText(bytes));
}

ConvertManifest manifestOf(const std::vector<ConvertTask>& tasks, const std::vector<std::string>& keys)
{
    ConvertManifest manifest;
    for (std::size_t i = 0; i < tasks.size(); ++i)
    {
        ManifestEntry entry;
        if (tasks[i].result)
            entry = tasks[i].result->entry;
        else
            entry.error = tasks[i].error->text();
        manifest.insert_or_assign(keys[i], std::move(entry));
    }
    return manifest;
}
} // namespace

CLI::App* ConvertCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand(
        "convert", "Convert clips between formats, Pacini's own and others', or a profile between JSON and ACF");
    command->add_option("inputs", inputs, "Clips or folders of them, or a profile, then what to write unless -o does")
        ->required()
        ->type_name("IN... OUT");
    command->add_option("-o,--output", output, "File, or folder for several inputs")->type_name("OUT|DIR");
    std::vector<std::string> names;
    for (const ClipTarget& target : clipTargets())
        names.emplace_back(target.name);
    command->add_option("--format", format, "What to write; 'pacini lint --targets' explains [by the extension of OUT]")
        ->check(oneOf(names));
    command
        ->add_option("--quantise", quantise,
                     "Bits of each value of a packed clip [those the clip was encoded with, else 12]")
        ->check(wholeNumberFrom(4, 16));
    options.declare(*command);
    command
        ->add_option(
            "--manifest", manifest,
            fmt::format("Where to record what became of each input [{} in the folder of several]", manifestName))
        ->type_name("FILE");
    command->add_flag("-f,--force", force, "Convert also what the manifest says is up to date");
    command->add_flag("--dry-run", dryRun, "Only say what would be done with each file; write nothing");
    command->add_option("-j,--jobs", jobs, "Files to work on at a time [number of processors]")
        ->check(wholeNumberFrom(1u, 256u))
        ->type_name("N");
    command->footer("Examples:\n  pacini convert door.json door.pacb             no loss between the two\n"
                    "  pacini convert door.pacb door.haptic           for Lofelt's and Meta's players\n"
                    "  pacini convert door.haptic door.ahap --split   from one to another, through a clip\n"
                    "  pacini convert clips/ ios/ --format ahap -j 8  a folder; a second time only what changed");
    return command;
}

Exit ConvertCommand::run(Console& console)
{
    if (output.empty())
    {
        if (inputs.size() < 2)
        {
            console.error("", {ErrorCode::invalidArgument, "convert",
                               "a file to work on is missing; try 'pacini convert --help'"});
            return Exit::usage;
        }
        output = std::move(inputs.back());
        inputs.pop_back();
    }
    const bool profile = inputs.size() == 1 && (hasAcfExtension(inputs.front()) || isProfile(inputs.front()));
    return profile ? convertProfile(console) : convertClips(console);
}

bool ConvertCommand::overwritesInput(Console& console) const
{
    std::error_code unknown;
    if (!std::filesystem::equivalent(inputs.front(), output, unknown))
        return false;
    console.error(output, {ErrorCode::invalidArgument, "", "is input and output; name another output"});
    return true;
}

Exit ConvertCommand::convertProfile(Console& console)
{
    const std::string& input = inputs.front();
    const bool toAcf = hasAcfExtension(output);
    if (!format.empty() || quantise > 0 || options.given())
    {
        console.error(
            input, {ErrorCode::invalidArgument, "", "is a profile; --format, --quantise and the others are for clips"});
        return Exit::usage;
    }
    if (!toAcf && lowerExtension(output) != ".json")
    {
        console.error(output,
                      {ErrorCode::invalidArgument, "", "has neither the extension .json nor .acf, as a profile needs"});
        return Exit::usage;
    }
    std::vector<std::string> warnings;
    const auto read = [&]() -> Result<Profile>
    {
        if (!hasAcfExtension(input))
            return readProfile(input);
        auto imported = readAcfFile(input);
        if (!imported)
            return imported.error();
        warnings = std::move(imported->warnings);
        return std::move(imported->profile);
    };
    const auto profile = read();
    if (!profile)
    {
        console.error(input, profile.error());
        return Exit::failed;
    }
    if (overwritesInput(console))
        return Exit::failed;
    if (dryRun)
    {
        std::vector<ConvertTask> tasks{{input, output, ConvertResult(), {}}};
        reportPlan(console, tasks);
        return Exit::ok;
    }
    const auto write = [&]
    {
        if (!toAcf)
            return writeProfile(output, *profile);
        const auto exported = acfOfProfile(*profile);
        warnings.insert(warnings.end(), exported.warnings.begin(), exported.warnings.end());
        return writeAcfFile(output, exported.acf);
    };
    const auto written = write();
    if (!written)
    {
        console.error(output, written.error());
        return Exit::failed;
    }
    for (const std::string& warning : warnings)
        console.warning(input, warning);
    auto files = nlohmann::ordered_json::array({{{"input", input}, {"output", output}, {"bytes", *written}}});
    console.addToReport(fileList(std::move(files), true));
    console.wrote(output, bytesText(static_cast<double>(*written)));
    return Exit::ok;
}

std::optional<ConvertSettings> ConvertCommand::settingsFor(Console& console, bool several) const
{
    const auto wrongUsage = [&](const std::string& where, const std::string& message)
    {
        console.error(where, {ErrorCode::invalidArgument, "", message});
        return std::nullopt;
    };
    const ClipTarget* target = clipTargetNamed(format);
    if (target == nullptr && several)
        return wrongUsage(output, "is a folder for clips of one format; say which with --format");
    if (target == nullptr)
        target = clipTargetOf(lowerExtension(output));
    if (target == nullptr)
        return wrongUsage(output,
                          "has neither the extension .json nor .pacb nor that of another format; say which with "
                          "--format");
    if (target->foreign == nullptr && options.given())
        return wrongUsage(output, "holds all of a clip; --points, --split, --sample-rate and --profile are for other "
                                  "formats");
    if (target->foreign != nullptr && quantise > 0)
        return wrongUsage(output, "is no packed clip; --quantise is for those");
    const auto params = options.params(console);
    if (!params)
        return std::nullopt;
    ConvertSettings settings;
    settings.target = *target;
    settings.params = *params;
    settings.quantise = quantise;
    settings.force = force;
    settings.dryRun = dryRun;
    settings.record =
        fmt::format("Pacini {}: {}, quantise {}, {}", PACINI_VERSION, target->name, quantise, options.record());
    if (params->profile)
        settings.record += ", " + sha256(profileJson(*params->profile));
    settings.folder = several ? std::filesystem::path(output) : std::filesystem::path(output).parent_path();
    return settings;
}

InputFiles ConvertCommand::findClips() const
{
    InputFiles found = findInputs(inputs, anyClipExtensions());
    std::erase_if(found.files,
                  [&](const InputFile& file)
                  {
                      const bool named = std::find(inputs.begin(), inputs.end(), file.path.string()) != inputs.end();
                      return !named && (file.path.filename() == manifestName || !companionOf(file.path).empty());
                  });
    return found;
}

Exit ConvertCommand::convertClips(Console& console)
{
    const InputFiles found = findClips();
    std::error_code ignored;
    const bool several = found.several || output.ends_with('/') || std::filesystem::is_directory(output, ignored);
    auto settings = settingsFor(console, several);
    if (!settings)
        return Exit::usage;
    if (!several && overwritesInput(console))
        return Exit::failed;

    auto tasks = makeTasks<ConvertResult>(found, several ? output + "/" : output,
                                          std::string(settings->target.extension), !dryRun);
    std::vector<std::string> keys(tasks.size());
    for (std::size_t i = 0; i < tasks.size(); ++i)
        keys[i] = i < found.failures.size() ? found.failures[i].path.generic_string()
                                            : found.files[i - found.failures.size()].relative.generic_string();
    const std::filesystem::path record = !manifest.empty() ? std::filesystem::path(manifest)
                                         : several         ? std::filesystem::path(output) / manifestName
                                                           : std::filesystem::path();
    const ConvertManifest before = record.empty() ? ConvertManifest() : readManifest(record);
    const auto nameOf = [&](std::size_t i)
    {
        return tasks[i].input.filename().string();
    };
    runTasks(console, tasks.size(), jobs, nameOf,
             [&]
             {
                 return [&](std::size_t i, const std::function<void(double)>&)
                 {
                     ConvertTask& task = tasks[i];
                     const auto entry = before.find(keys[i]);
                     attempt(task,
                             [&] {
                                 return convertClip(task.input, task.output, *settings,
                                                    entry == before.end() ? nullptr : &entry->second);
                             });
                     if (task.error)
                     {
                         console.error(task.input.string(), *task.error);
                         return;
                     }
                     if (!task.result->upToDate && !dryRun)
                         sayWritten(console, task, settings->folder);
                     for (const std::string& warning : task.result->entry.warnings)
                         console.warning(task.input.string(), warning);
                 };
             });
    bool failed = anyFailed(tasks);
    if (dryRun)
    {
        reportPlan(console, tasks);
        return failed ? Exit::failed : Exit::ok;
    }
    if (!record.empty() && std::filesystem::is_directory(settings->folder, ignored))
        if (const auto written = writeFileAtomically(record, manifestText(manifestOf(tasks, keys))); !written)
        {
            console.error(record.string(), written.error());
            failed = true;
        }

    console.addToReport(jsonReport(
        tasks, [](const ConvertTask& task) { return toJson(task); }, !several));
    if (several)
        console.note(summary(tasks));
    return failed ? Exit::failed : Exit::ok;
}

} // namespace pacini::cli
