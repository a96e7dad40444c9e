// Subcommand that encodes sounds.

#include "cli/Batch.h"
#include "cli/Command.h"
#include "cli/Counted.h"
#include "cli/DescribedOptions.h"
#include "cli/EncodeJob.h"
#include "cli/ExportOptions.h"
#include "cli/InputFiles.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/RayRun.h"
#include "cli/SceneFiles.h"
#include "cli/Task.h"
#include "cli/TaskRunner.h"
#include "io/EncoderPresets.h"
#include "io/FileExtension.h"
#include "io/GivenParameters.h"
#include "io/OnsetFile.h"
#include "io/SettingsFile.h"

#include <pacini/analysis/methods/Method.h>
#include <pacini/synthesis/RenderParams.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
using EncodeTask = Task<EncodeResult>;

nlohmann::ordered_json toJson(const EncodeTask& task)
{
    const EncodeResult& r = *task.result;
    return {{"input", task.input.string()},
            {"output", task.output.string()},
            {"bytes", r.bytes},
            {"duration", r.duration},
            {"seconds", r.seconds},
            {"timesRealTime", r.seconds > 0.0 ? r.duration / r.seconds : 0.0},
            {"bytesPerSecond", r.duration > 0.0 ? static_cast<double>(r.bytes) / r.duration : 0.0},
            {"breakpoints", r.breakpoints},
            {"transients", r.transients},
            {"scenes", r.scenes},
            {"upToDate", r.upToDate}};
}

std::string summary(const std::vector<EncodeTask>& tasks)
{
    std::size_t done = 0, fresh = 0, failed = 0;
    double bytes = 0.0, duration = 0.0, seconds = 0.0, worked = 0.0;
    for (const EncodeTask& task : tasks)
    {
        failed += task.error ? 1u : 0u;
        if (!task.result)
            continue;
        (task.result->upToDate ? fresh : done) += 1u;
        bytes += static_cast<double>(task.result->bytes);
        duration += task.result->duration;
        seconds += task.result->seconds;
        worked += task.result->upToDate ? 0.0 : task.result->duration;
    }
    std::string text = fmt::format("{} encoded{}", done, restText(fresh, countSkipped(tasks), failed));
    if (duration > 0.0)
        text +=
            fmt::format(": {} of sound in {}, {:.0f} B/s", durationText(duration), bytesText(bytes), bytes / duration);
    if (seconds > 0.0)
        text += fmt::format(", {:.0f} times real time", worked / seconds);
    return text;
}

std::string methodNames(MethodOutput output)
{
    std::string names;
    for (const MethodInfo& info : methodTable)
        if (info.output == output)
            names += (names.empty() ? "" : ", ") + std::string(info.name);
    return names;
}

std::string methodList()
{
    std::string lines;
    for (const MethodInfo& info : methodTable)
        lines += fmt::format("{}{:<18} {}{}", lines.empty() ? "" : "\n", info.name, info.description,
                             info.output == MethodOutput::signal ? " (writes a WAV file)" : "");
    return lines;
}

nlohmann::ordered_json methodsJson()
{
    auto methods = nlohmann::ordered_json::array();
    for (const MethodInfo& info : methodTable)
        methods.push_back({{"name", info.name},
                           {"description", info.description},
                           {"output", info.output == MethodOutput::signal ? "signal" : "clip"}});
    return {{"methods", methods}};
}

Error wrongUsage(std::string where, std::string message)
{
    return {ErrorCode::invalidArgument, std::move(where), std::move(message)};
}

/// `pacini encode`: recordings become clips, or drive signals by methods that make no clip.
struct EncodeCommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    /// Complains of options of the output that do not fit the method.
    [[nodiscard]] Result<void> checkOptions(const MethodInfo& method) const;
    [[nodiscard]] Result<void> checkFormat() const;
    [[nodiscard]] std::optional<Settings> chosenSettings(Console& console) const;

    /// Reads what is written and how; what is wrong is said, and anything but ok returned.
    [[nodiscard]] Exit readOutput(Console& console, const Settings& chosen, EncodeSettings& settings) const;
    [[nodiscard]] Exit readMarkers(Console& console, const InputFiles& found, EncodeSettings& settings) const;
    /// Prints the settings of --print-settings.
    static void printChosen(Console& console, const TranslationParams& translation);
    void tell(Console& console, const EncodeTask& task) const;
    [[nodiscard]] Error runOnCluster() const;

    /// The sounds to encode, without drive signals that Pacini made, which may lie beside them.
    [[nodiscard]] InputFiles findSounds() const;

    CLI::App* command = nullptr;
    std::vector<std::string> inputs;
    std::string methodName = "a2vt";
    std::string preset;
    bool listMethods = false;
    DescribedOptions described;
    std::string settingsFile;
    bool printSettings = false;
    std::string output;
    std::string format;
    std::string markersFile;
    ExportOptions exporting;
    double scenes = 0.0;
    bool withoutCentre = false;
    bool allowNan = false;
    bool allowTruncated = false;
    bool force = false;
    OverwriteOptions overwriting;
    bool dryRun = false;
    unsigned jobs = 0;
    Batch batch;
    std::string rayAddress;
};
} // namespace

CLI::App* EncodeCommand::declare(CLI::App& app)
{
    command = app.add_subcommand("encode", "Turn recordings into haptic clips");
    std::vector<std::string> names;
    for (const MethodInfo& info : methodTable)
        names.emplace_back(info.name);
    addOption(
        *command, "inputs", inputs,
        "Audio files (WAV, AIFF, FLAC, Ogg, MP3 ...), films where ffmpeg is installed, folders of these, or - for "
        "standard input",
        "IN");
    const auto group = [this](const char* heading)
    {
        command->option_defaults()->group(heading);
    };
    std::vector<const ParameterInfo*> common, special;
    for (const ParameterInfo* parameter : translationParameters())
        (parameter->group == "Analysis" ? common : special).push_back(parameter);
    group("Analysis");
    addPreset(*command, "--method", methodName,
              "Translation method, see --list-methods; six methods write drive signals as WAV", oneOf(names), "NAME");
    command->add_flag("--list-methods", listMethods, "List the methods and exit");
    addOption(*command, "--preset", preset,
              "Set these options for a kind of sound; other options on the command line override it",
              oneOf(presetNames()), "NAME");
    addOption(*command, "--settings", settingsFile,
              "Read the values of these options from a JSON file; options on the command line override them", "FILE");
    command->add_flag("--print-settings", printSettings, "Print all settings in the form of that file and exit");
    described.declare(*command, common);
    group("Output");
    addOption(*command, "-o,--output", output,
              "File, folder for several inputs, or - for standard output [beside each input]", "OUT|DIR");
    std::vector<std::string> formats;
    for (const ClipFormat& known : clipFormats())
        if (known.isWritten())
            formats.emplace_back(known.name);
    addOption(
        *command, "--format", format,
        "Format to write: json (readable), packed (small), or a format of another program; 'pacini lint --targets' "
        "lists them [by the extension of OUT, else json]",
        oneOf(formats));
    addOption(
        *command, "--markers", markersFile,
        "Cue sheet (.cue), or text file of times in s and labels, such as Audacity's, that become markers of the clip "
        "besides those of the sound; for one sound",
        "FILE");
    addOption(
        *command, "--scenes", scenes,
        "Cut long sounds at silences into clips of at least so many seconds, and write a scene that plays them at "
        "the times of the sound; needs a folder as OUT",
        numberFrom(1.0, 86400.0), "S");
    command->add_flag(
        "--without-centre", withoutCentre,
        "Leave out the centre channel, where films have their speech, of sounds that name their channels");
    group("Other formats");
    exporting.declare(*command);
    group("Files");
    command->add_flag("--allow-nan", allowNan,
                      "Replace samples that are not finite or absurdly large by 0 instead of refusing the file");
    command->add_flag("--allow-truncated", allowTruncated, "Encode the remaining part of truncated files");
    command->add_flag("-f,--force", force, "Also encode files that are up to date");
    overwriting.declare(*command);
    command->add_flag("--dry-run", dryRun, "Print what would be done with each file and write nothing");
    group("Many files");
    addOption(*command, "-j,--jobs", jobs, "Number of files processed in parallel [number of processors]",
              wholeNumberFrom(1u, 256u), "N");
    batch.declare(*command);
    addOption(*command, "--ray", rayAddress,
              "Encode on a Ray cluster whose machines see the same files: its address, auto, or local for this "
              "machine; needs Python with pacini[ray]",
              "ADDRESS");
    described.declare(*command, special);
    group(CLI::OptionDefaults().get_group().c_str());
    return command->footer("Examples:\n  pacini encode door.wav                       writes door.json\n"
                           "  pacini encode door.wav -o door.pacb          packed: about 200 bytes per second\n"
                           "  pacini encode sounds/ -o clips/ --format packed -j 8\n"
                           "  pacini encode door.wav -o door.haptic        for the players of Lofelt and Meta\n"
                           "  pacini encode door.wav --method thesis --bands 8\n"
                           "  pacini encode song.flac --preset music       the beat first\n"
                           "  pacini encode --bands 8 --print-settings > mine.json\n"
                           "  pacini encode sounds/ -o clips/ --settings mine.json\n"
                           "  pacini encode door.wav --method lowpass      writes door.lowpass.wav\n"
                           "  pacini encode film.mp4 -o clips/ --scenes 10 a clip for each scene of a film");
}

std::optional<Settings> EncodeCommand::chosenSettings(Console& console) const
{
    Settings settings;
    if (!settingsFile.empty())
    {
        ReadWarnings warnings(console.isStrict());
        auto read = readSettingsFile(settingsFile, &warnings);
        if (!read)
        {
            console.error(settingsFile, read.error());
            return std::nullopt;
        }
        console.warnings(settingsFile, warnings.texts());
        settings = std::move(*read);
    }
    if (command->count("--method") > 0)
        settings.method = methodName;
    if (!preset.empty())
        if (const auto used = usePreset(settings, preset); !used)
        {
            console.error("--preset", used.error());
            return std::nullopt;
        }
    described.addGiven(settings.encode);
    return settings;
}

Result<void> EncodeCommand::checkOptions(const MethodInfo& method) const
{
    if (inputs.empty())
        return wrongUsage("encode", "the input file is missing; try 'pacini encode --help'");
    if (method.output == MethodOutput::signal)
    {
        const std::string clips = methodNames(MethodOutput::clip);
        if (const std::string option = exporting.firstGiven(); !option.empty())
            return wrongUsage(
                option,
                fmt::format("is for formats of other programs, but the method {} writes a WAV file; leave it out",
                            method.name));
        if (!markersFile.empty())
            return wrongUsage("--markers", fmt::format("is for clips, but the method {} writes a WAV file; these "
                                                       "methods write clips: {}",
                                                       method.name, clips));
        if (command->count("--scenes") > 0)
            return wrongUsage("--scenes", fmt::format("is for clips, but the method {} writes a WAV file; these "
                                                      "methods write clips: {}",
                                                      method.name, clips));
        if (!format.empty())
            return wrongUsage(
                "--format",
                fmt::format("is for clips, but the method {} writes a WAV file; these methods write clips: {}",
                            method.name, clips));
        if (isOwnExtension(lowerExtension(output)))
            return wrongUsage(
                "--output",
                fmt::format(
                    "has the extension of a clip, but the method {} writes a WAV file; these methods write clips: {}",
                    method.name, clips));
        // Results between the recordings would be taken for recordings the next time.
        const auto isFolder = [](const std::string& input)
        {
            std::error_code ignored;
            return std::filesystem::is_directory(input, ignored);
        };
        if (output.empty() && std::any_of(inputs.begin(), inputs.end(), isFolder))
            return wrongUsage("--output", "is needed: name a folder for the signals");
    }
    else if (auto formatKnown = checkFormat(); !formatKnown)
        return formatKnown;
    if (command->count("--scenes") > 0 && (output.empty() || !namesFolder(output)))
        return wrongUsage("--scenes", "writes several files; name a folder for them with -o, such as -o clips/");
    return {};
}

Result<void> EncodeCommand::checkFormat() const
{
    std::error_code ignored;
    if (!format.empty() || output.empty() || output.ends_with('/') || isStream(output) ||
        std::filesystem::is_directory(output, ignored))
        return {};
    const std::string extension = lowerExtension(output);
    const auto& sounds = audioExtensions();
    if (std::find(sounds.begin(), sounds.end(), extension) != sounds.end())
        return wrongUsage("--output", fmt::format("{} has the extension of a sound, but encode writes clips; use .json "
                                                  "or .pacb, or render the clip afterwards",
                                                  output));
    if (inputs.size() == 1 && !std::filesystem::is_directory(inputs.front(), ignored) &&
        clipFormatWrittenTo(extension) == nullptr)
        return wrongUsage("--output", fmt::format("{} has an unknown extension; use .json or .pacb, choose the format "
                                                  "with --format, or write {}/ for a folder",
                                                  output, output));
    return {};
}

/// Comes back only where that is not possible.
Error EncodeCommand::runOnCluster() const
{
    std::vector<std::string> known{"inputs",    "output",          "method", "preset", "settings", "format",
                                   "allow-nan", "allow-truncated", "ray",    "quiet",  "overwrite"};
    for (const ParameterInfo* parameter : translationParameters())
        known.push_back(separatedName(parameter->name, '-'));
    if (output.empty() || isStream(output))
        return wrongUsage("--output", "is needed with --ray: name a folder for the clips");
    for (const CLI::Option* option : command->get_options())
        if (const std::string name = option->get_single_name();
            option->count() > 0 && std::find(known.begin(), known.end(), name) == known.end())
            return wrongUsage("--" + name, "cannot be combined with --ray; leave it out");
    std::vector<std::string> words = lastingArguments(*command);
    std::erase_if(words, [](const std::string& word) { return word.starts_with("--ray="); });
    if (rayAddress != "local")
        words.push_back("--address=" + rayAddress);
    if (format.empty())
        words.emplace_back("--format=json");
    return runOnRay(words);
}

InputFiles EncodeCommand::findSounds() const
{
    InputFiles found = findInputs(inputs, audioExtensions());
    std::erase_if(found.files,
                  [&](const InputFile& file)
                  {
                      const bool named = std::find(inputs.begin(), inputs.end(), file.path.string()) != inputs.end();
                      return !named && readOrigin(file.path).has_value();
                  });
    return found;
}

Exit EncodeCommand::readOutput(Console& console, const Settings& chosen, EncodeSettings& settings) const
{
    settings.reading.allowTruncated = allowTruncated;
    settings.reading.allowNan = allowNan;
    settings.reading.withoutCentre = withoutCentre;
    if (command->count("--scenes") > 0)
        settings.shortestScene = scenes;
    settings.force = force;
    settings.dryRun = dryRun;
    const ClipFormat* target = clipFormatNamed(format);
    if (target == nullptr)
        target = clipFormatWrittenTo(lowerExtension(output));
    if (target != nullptr)
        settings.format = target;
    if (const auto fits = exporting.checkFor(*settings.format); !fits)
        return console.fail("", fits.error(), Exit::usage);
    const auto exportParams = exporting.params(console, *settings.format, chosen.exporting);
    if (!exportParams)
        return Exit::failed;
    settings.exporting = *exportParams;
    return Exit::ok;
}

void EncodeCommand::tell(Console& console, const EncodeTask& task) const
{
    const EncodeResult& result = *task.result;
    if (!result.upToDate && !dryRun)
        console.wrote(task.output, (result.scenes > 0 ? counted(result.scenes, "scene, ", "scenes, ") : "") +
                                       bytesText(static_cast<double>(result.bytes)));
    console.warnings(task.input.string(), result.warnings);
    if (result.replacedSamples > 0)
        console.warning(task.input.string(),
                        counted(result.replacedSamples, "sample is not finite or absurdly large and counts as 0",
                                "samples are not finite or absurdly large and count as 0"));
    if (!result.stray.empty())
        console.warning(task.input.string(), strayWarning(result.stray));
}

void EncodeCommand::printChosen(Console& console, const TranslationParams& translation)
{
    const auto document = settingsJson(translation, usualChoices(translation.method));
    console.addToReport({{"settings", document},
                         {"presets", presetsJson()},
                         {"parameters",
                          {{"encode", translationDescriptionsJson()},
                           {"export", exportDescriptionsJson()},
                           {"render", descriptionsJson(infosOf(renderParameters))},
                           {"felt", descriptionsJson(infosOf(feltParameters))}}},
                         {"play", playbackDescriptionsJson()}});
    console.print(document.dump(4));
}

Exit EncodeCommand::readMarkers(Console& console, const InputFiles& found, EncodeSettings& settings) const
{
    if (markersFile.empty())
        return Exit::ok;
    if (found.files.size() > 1)
        return console.fail("--markers", wrongUsage("", "is for one sound; encode the others in calls of their own"),
                            Exit::usage);
    auto labels = readLabels(markersFile);
    if (!labels)
        return console.fail(markersFile, labels.error());
    console.warnings(markersFile, std::exchange(labels->warnings, {}));
    settings.markers = std::move(*labels);
    return Exit::ok;
}

Exit EncodeCommand::run(Console& console)
{
    if (listMethods)
    {
        console.addToReport(methodsJson());
        console.print(methodList());
        return Exit::ok;
    }
    const auto chosen = chosenSettings(console);
    if (!chosen)
        return Exit::failed;
    const auto translation = translationOf(*chosen);
    if (!translation)
        return console.fail("", wrongUsage(optionOf(translation.error().where), translation.error().message),
                            Exit::usage);
    if (printSettings)
    {
        printChosen(console, *translation);
        return Exit::ok;
    }
    const MethodInfo& method = methodInfo(translation->method);
    if (auto valid = checkOptions(method); !valid)
        return console.fail("", valid.error(), Exit::usage);
    if (!rayAddress.empty())
        return console.fail("", runOnCluster(), Exit::usage);
    EncodeSettings settings;
    static_cast<TranslationParams&>(settings) = *translation;
    if (const Exit read = readOutput(console, *chosen, settings); read != Exit::ok)
        return read;
    const std::string extension(settings.format->extension);
    OutputNames names{output, extension, extension};
    if (settings.shortestScene)
        names = {output, std::string(sceneExtension), std::string(sceneExtension)};
    if (method.output == MethodOutput::signal) // beside its recording a signal must not replace it
        names = {output, ".wav", fmt::format(".{}.wav", method.name)};

    const InputFiles found = findSounds();
    if (const Exit read = readMarkers(console, found, settings); read != Exit::ok)
        return read;
    if (const auto fits = checkOutput(found, output, console.isJson()); !fits)
        return console.fail("", fits.error(), Exit::usage);
    if (isStandardOutput(output))
        console.keepStdoutFree();
    // A clip would be encoded onto itself, but is no sound in the first place.
    const auto unreadable = [&settings](const std::filesystem::path& input)
    {
        const auto sound = AudioReader::open(input, settings.reading);
        return sound ? std::nullopt : std::optional(sound.error());
    };
    auto tasks = makeTasks<EncodeResult>(found, names, overwriting, !dryRun, unreadable);
    if (const auto started = batch.start(tasks, dryRun); !started)
        return console.fail("", started.error());
    BatchEnd end;
    runTasks(console, tasks, jobs,
             [&]
             {
                 return
                     [&, job = EncodeJob(settings)](std::size_t i, const std::function<void(double)>& progress) mutable
                 {
                     EncodeTask& task = tasks[i];
                     attempt(task, end, [&] { return job.run(task.input, task.output, task.replaceable, progress); });
                     tellError(console, task, end);
                     batch.add(task, [](const EncodeTask& done) { return toJson(done); });
                     if (task.result)
                         tell(console, task);
                 };
             });

    if (dryRun)
        reportPlan(console, tasks);
    else
    {
        console.addToReport(jsonReport(tasks, [](const EncodeTask& task) { return toJson(task); }));
        console.note(summary(tasks));
    }
    return batch.finish(console) && !anyFailed(tasks) ? Exit::ok : Exit::failed;
}

std::unique_ptr<Command> encodeCommand()
{
    return std::make_unique<EncodeCommand>();
}

} // namespace pacini::cli
