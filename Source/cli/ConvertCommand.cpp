// Subcommand that converts clips and profiles between formats.

#include "cli/Batch.h"
#include "cli/Command.h"
#include "cli/ConvertJob.h"
#include "cli/ExportOptions.h"
#include "cli/InputFiles.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/Task.h"
#include "cli/TaskRunner.h"
#include "io/AcfFile.h"
#include "io/ClipFile.h"
#include "io/FileExtension.h"
#include "io/ProfileFile.h"
#include "io/ProfileJson.h"
#include "io/Sha256.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
using ConvertTask = Task<ConvertResult>;

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
    return fmt::format("{} converted{}: {}", done, restText(fresh, countSkipped(tasks), failed), bytesText(bytes));
}

ManifestEntry entryOf(const ConvertTask& task)
{
    if (task.result)
        return task.result->entry;
    ManifestEntry entry;
    entry.error = task.error->text();
    return entry;
}

void report(Console& console, const std::vector<ConvertTask>& tasks, bool several)
{
    console.addToReport(jsonReport(
        tasks, [](const ConvertTask& task) { return toJson(task); }, !several));
    if (several)
        console.note(summary(tasks));
    else if (!tasks.empty() && tasks.front().skipped)
        console.kept(tasks.front().output);
}

/// `pacini convert`: clips, or profiles, of one format become another.
struct ConvertCommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    Exit convertProfile(Console& console);
    Exit convertClips(Console& console);

    /// What may be replaced at a file that the user named: the last of the files may be there by mistake.
    [[nodiscard]] Replaceable replaceable() const noexcept { return overwriting.of(byName); }

    /// Whether output would overwrite the only input, which is said.
    bool overwritesInput(Console& console) const;

    /// What to convert to; nothing when the options do not say, and the console has said why.
    [[nodiscard]] std::optional<ConvertSettings> settingsFor(Console& console, bool several) const;

    /// The clips to convert, without second files of a clip.
    [[nodiscard]] InputFiles findClips() const;

    [[nodiscard]] std::vector<ConvertTask> tasksFor(const InputFiles& found, bool several,
                                                    const std::string& extension) const;

    /// Where the record of conversions into `folder` is; empty: there is none.
    [[nodiscard]] std::filesystem::path recordFile(bool several, const std::filesystem::path& folder) const;

    std::vector<std::string> inputs;
    std::string output;
    std::string format;
    ExportOptions options;
    std::string shard;
    std::string manifest;
    int quantise = 0;
    unsigned jobs = 0;
    bool force = false;
    OverwriteOptions overwriting;
    bool byName = true; ///< the output was named with -o
    bool dryRun = false;
};
} // namespace

CLI::App* ConvertCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("convert", "Convert clips between formats, or a profile between JSON and ACF");
    addOption(*command, "inputs", inputs,
              "Clips, folders of clips, - for standard input, or a profile. The last argument is the output unless -o "
              "names it; an existing file is replaced only if it has the same content",
              "IN... OUT")
        ->required();
    addOption(*command, "-o,--output", output, "File, folder for several inputs, or - for standard output", "OUT|DIR");
    std::vector<std::string> names;
    for (const ClipFormat& known : clipFormats())
        if (known.isWritten())
            names.emplace_back(known.name);
    addOption(*command, "--format", format,
              "Format to write; 'pacini lint --targets' describes all formats [by the extension of OUT]", oneOf(names));
    addOption(*command, "--quantise", quantise,
              "Bits of each value in a packed clip [as the clip was encoded, else 12]", wholeNumberFrom(4, 16));
    options.declare(*command);
    addShard(*command, shard);
    addOption(
        *command, "--manifest", manifest,
        fmt::format(
            "Record the result of each input in FILE; --shard 2/8 writes NAME.2-of-8.json [{} in the output folder]",
            manifestName),
        "FILE");
    command->add_flag("-f,--force", force, "Also convert files that are up to date");
    overwriting.declare(*command);
    command->add_flag("--dry-run", dryRun, "Print what would be done with each file and write nothing");
    addOption(*command, "-j,--jobs", jobs, "Number of files processed in parallel [number of processors]",
              wholeNumberFrom(1u, 256u), "N");
    return command->footer(
        "Examples:\n  pacini convert door.json door.pacb             no loss between the two\n"
        "  pacini convert door.pacb door.haptic           for the players of Lofelt and Meta\n"
        "  pacini convert door.haptic door.ahap --split   from one format to another, by way of a clip\n"
        "  pacini convert clips/ ios/ --format ahap -j 8  a folder; the second run converts only changed files");
}

Exit ConvertCommand::run(Console& console)
{
    if (output.empty())
    {
        if (inputs.size() < 2)
            return console.fail(
                "", {ErrorCode::invalidArgument, "convert", "the input file is missing; try 'pacini convert --help'"},
                Exit::usage);
        byName = false;
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
    console.error(output, {ErrorCode::invalidArgument, "", alsoInput});
    return true;
}

Exit ConvertCommand::convertProfile(Console& console)
{
    const std::string& input = inputs.front();
    const bool toAcf = hasAcfExtension(output);
    if (!format.empty() || quantise > 0 || !options.firstGiven().empty())
        return console.fail(input,
                            {ErrorCode::invalidArgument, "",
                             "is a profile; leave out --format, --quantise and the other options for clips"},
                            Exit::usage);
    if (!toAcf && lowerExtension(output) != ".json")
        return console.fail(
            output,
            {ErrorCode::invalidArgument, "", "must have the extension .json or .acf, as the input is a profile"},
            Exit::usage);
    std::vector<std::string> warnings;
    const auto read = [&]() -> Result<Profile>
    {
        if (!hasAcfExtension(input))
        {
            ReadWarnings doubts(console.isStrict());
            auto own = readProfile(input, &doubts);
            warnings = doubts.texts();
            return own;
        }
        auto imported = readAcfFile(input);
        if (!imported)
            return imported.error();
        warnings = std::move(imported->warnings);
        return std::move(imported->profile);
    };
    const auto profile = read();
    if (!profile)
        return console.fail(input, profile.error());
    if (overwritesInput(console))
        return Exit::failed;
    if (dryRun)
    {
        std::vector<ConvertTask> tasks{{input, output, {}, ConvertResult(), {}, {}, {}}};
        tasks.front().skipped = overwriting.keepsAll() && isOccupied(output);
        reportPlan(console, tasks);
        return Exit::ok;
    }
    if (overwriting.keeps(console, {output}))
    {
        console.addToReport(fileList(nlohmann::ordered_json::array(), false));
        return Exit::ok;
    }
    const auto textOf = [&]() -> std::string
    {
        if (!toAcf)
            return profileJson(*profile);
        const auto exported = acfOfProfile(*profile);
        warnings.insert(warnings.end(), exported.warnings.begin(), exported.warnings.end());
        return acfText(exported.acf);
    };
    const std::string text = textOf();
    const auto existing = mayReplace(output, text, replaceable());
    if (!existing)
        return console.fail("", existing.error());
    const auto written = writeFileAtomically(output, text, *existing);
    if (!written)
        return console.fail(output, written.error());
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
    const ClipFormat* target = clipFormatNamed(format);
    if (target == nullptr && several)
        return wrongUsage(output, "is a folder; choose the format of its clips with --format");
    if (target == nullptr)
        target = clipFormatWrittenTo(lowerExtension(output));
    if (target == nullptr)
        return wrongUsage(
            output,
            "has an unknown extension; use .json, .pacb or that of another format, or choose the format with --format");
    if (const auto fits = options.checkFor(*target); !fits)
    {
        console.error("", fits.error());
        return std::nullopt;
    }
    if (!target->isOwn() && quantise > 0)
        return wrongUsage(output, "is not a packed clip; leave out --quantise");
    const auto params = options.params(console, *target);
    if (!params)
        return std::nullopt;
    ConvertSettings settings;
    settings.format = target;
    settings.params = *params;
    settings.quantise = quantise;
    settings.force = force;
    settings.dryRun = dryRun;
    settings.strict = console.isStrict();
    settings.record =
        fmt::format("Pacini {}: {}, quantise {}, {}", PACINI_VERSION, target->name, quantise, options.record());
    if (params->profile)
        settings.record += ", " + sha256(profileJson(*params->profile));
    settings.folder = several ? std::filesystem::path(output) : std::filesystem::path(output).parent_path();
    return settings;
}

InputFiles ConvertCommand::findClips() const
{
    InputFiles found = findInputs(inputs, clipFileExtensions());
    std::erase_if(found.files,
                  [&](const InputFile& file)
                  {
                      const bool named = std::find(inputs.begin(), inputs.end(), file.path.string()) != inputs.end();
                      return !named && !companionOf(file.path).empty();
                  });
    return found;
}

std::vector<ConvertTask> ConvertCommand::tasksFor(const InputFiles& found, bool several,
                                                  const std::string& extension) const
{
    auto tasks =
        makeTasks<ConvertResult>(found, {several ? output + "/" : output, extension, extension}, overwriting, !dryRun);
    for (ConvertTask& task : tasks)
        if (task.replaceable == Replaceable::named)
            task.replaceable = replaceable();
    return tasks;
}

std::filesystem::path ConvertCommand::recordFile(bool several, const std::filesystem::path& folder) const
{
    std::filesystem::path record = !manifest.empty() ? std::filesystem::path(manifest)
                                   : several         ? std::filesystem::path(output) / manifestName
                                                     : std::filesystem::path();
    if (std::error_code ignored; several && !std::filesystem::is_directory(folder, ignored))
        record.clear(); // nothing could be written
    return manifestOfShard(record, shard);
}

Exit ConvertCommand::convertClips(Console& console)
{
    const InputFiles found = findClips();
    std::error_code ignored;
    const bool several = found.several || output.ends_with('/') || std::filesystem::is_directory(output, ignored);
    if (const auto fits = checkOutput(found, output, console.isJson()); !fits)
        return console.fail("", fits.error(), Exit::usage);
    auto settings = settingsFor(console, several);
    if (!settings)
        return Exit::usage;
    if (!several && overwritesInput(console))
        return Exit::failed;

    if (isStandardOutput(output))
        console.keepStdoutFree();

    auto tasks = tasksFor(found, several, std::string(settings->format->extension));
    std::vector<std::filesystem::path> all;
    for (const ConvertTask& task : tasks)
        all.push_back(task.input);
    const auto inShard = inputsOfShard(all, shard);
    if (!inShard)
        return console.fail("", inShard.error(), Exit::usage);
    keepChosen(tasks, *inShard);
    const std::filesystem::path record = recordFile(several, settings->folder);
    if (!record.empty())
        settings->folder = record.parent_path();
    const auto before = readManifest(record);
    if (!before && !overwriting.replacesAll())
        return console.fail(record.string(),
                            {ErrorCode::invalidData, "",
                             "exists and is not a manifest of conversions; name another file with --manifest"});
    GrowingManifest growing;
    Manifest begun = before.value_or(Manifest());
    begun.shards = manifestShards(*inShard, shard);
    for (const ConvertTask& task : tasks)
        if (!task.skipped)
            begun.expect(task.key);
    if (const auto started = growing.start(dryRun ? std::filesystem::path() : record, begun); !started)
        return console.fail(record.string(), started.error());
    BatchEnd end;
    runTasks(console, tasks, jobs,
             [&]
             {
                 return [&](std::size_t i, const std::function<void(double)>&)
                 {
                     ConvertTask& task = tasks[i];
                     const ManifestEntry* earlier = before ? before->find(task.key) : nullptr;
                     attempt(task, end,
                             [&]
                             { return convertClip(task.input, task.output, task.replaceable, *settings, earlier); });
                     tellError(console, task, end);
                     if (task.result && !task.result->upToDate && !dryRun)
                         sayWritten(console, task, settings->folder);
                     if (task.result)
                         console.warnings(task.input.string(), task.result->entry.warnings);
                     // What was not replaced is still what it was made from before.
                     if (!dryRun && (task.result || (task.error && (earlier == nullptr || earlier->outputs.empty()))))
                         growing.add(task.key, entryOf(task));
                 };
             });
    bool failed = anyFailed(tasks);
    if (dryRun)
    {
        reportPlan(console, tasks);
        return failed ? Exit::failed : Exit::ok;
    }
    if (const auto finished = growing.finish(); !finished)
    {
        if (end.isNews(finished.error()))
            console.error(record.string(), finished.error());
        failed = true;
    }

    report(console, tasks, several);
    return failed ? Exit::failed : Exit::ok;
}

std::unique_ptr<Command> convertCommand()
{
    return std::make_unique<ConvertCommand>();
}

} // namespace pacini::cli
