#include "cli/EncodeCommand.h"

#include "cli/Checks.h"
#include "cli/EncodeJob.h"
#include "cli/InputFiles.h"
#include "cli/Task.h"
#include "cli/TaskRunner.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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
    std::string text = fmt::format("{} encoded", done);
    if (fresh > 0)
        text += fmt::format(", {} up to date", fresh);
    if (failed > 0)
        text += fmt::format(", {} failed", failed);
    if (duration > 0.0)
        text +=
            fmt::format(": {} of sound in {}, {:.0f} B/s", durationText(duration), bytesText(bytes), bytes / duration);
    if (seconds > 0.0)
        text += fmt::format(", {:.0f} times real time", worked / seconds);
    return text;
}
} // namespace

CLI::App* EncodeCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("encode", "Turn recordings into haptic clips");
    command->add_option("inputs", inputs, "Audio files, or folders of them (WAV, AIFF, FLAC, Ogg, MP3 ...)")
        ->required()
        ->type_name("IN");
    command->add_option("-o,--output", output, "File, or folder for several inputs [beside each input]")
        ->type_name("OUT|DIR");
    command
        ->add_option("--format", format,
                     "json (to read and edit) or packed (small) [by the extension of OUT, else json]")
        ->check(CLI::IsMember({"json", "packed"}));
    command->add_option("--bands", params.bands, "Number of frequency bands, 1 to 32")
        ->capture_default_str()
        ->check(CLI::Range(1, 32));
    command
        ->add_option("--breakpoints", params.breakpoints,
                     "At most this many breakpoints per second and band; simple sounds take fewer")
        ->capture_default_str()
        ->check(numberFrom(0.5, 1000.0));
    command->add_option("--quantise", params.quantise, "Bits of each value, 4 to 16")
        ->capture_default_str()
        ->check(CLI::Range(4, 16));
    command->add_option("--low", params.lowFrequency, "Lower end of the bands, Hz")
        ->capture_default_str()
        ->check(numberFrom(1.0, 1700.0));
    command->add_option("--high", params.highFrequency, "Upper end of the bands, Hz")
        ->capture_default_str()
        ->check(numberFrom(2.0, 1800.0));
    command->add_option("--spacing", spacing, "log or linear bands")
        ->capture_default_str()
        ->check(CLI::IsMember({"log", "linear"}));
    command->add_flag("--keep-level", keepLevel, "Keep the level of the sound instead of raising it to full drive");
    command->add_flag("--allow-nan", allowNan,
                      "Take samples that are no numbers or absurdly large as 0 instead of refusing the file");
    command->add_flag("--allow-truncated", allowTruncated, "Encode what is there of a file that was cut off");
    command->add_flag("-f,--force", force, "Encode also what is up to date");
    command->add_option("-j,--jobs", jobs, "Files to work on at a time [number of processors]")
        ->check(CLI::Range(1u, 256u))
        ->type_name("N");
    command->add_flag("--json", json, "Print a report as one JSON object");
    command->footer("Examples:\n  pacini encode door.wav                       writes door.json\n"
                    "  pacini encode door.wav -o door.pacb          packed: about 200 bytes per second\n"
                    "  pacini encode sounds/ -o clips/ --format packed -j 8");
    return command;
}

Exit EncodeCommand::run(Console& console)
{
    params.spacing = spacing == "log" ? BandSpacing::logarithmic : BandSpacing::linear;
    params.normalise = !keepLevel;
    if (auto valid = validate(params); !valid)
    {
        console.error("", valid.error());
        return Exit::usage;
    }
    EncodeSettings settings;
    settings.params = params;
    settings.reading = {allowTruncated, allowNan};
    settings.force = force;
    const bool packedName = lowerExtension(output) == ".pacb";
    settings.format = format == "packed" || (format.empty() && packedName) ? ClipFormat::packed : ClipFormat::json;

    const InputFiles found = findInputs(inputs, audioExtensions());
    auto tasks = makeTasks<EncodeResult>(found, output, settings.format == ClipFormat::packed ? ".pacb" : ".json");
    const auto nameOf = [&](std::size_t i)
    {
        return tasks[i].input.filename().string();
    };
    runTasks(console, tasks.size(), jobs, nameOf,
             [&]
             {
                 return
                     [&, job = EncodeJob(settings)](std::size_t i, const std::function<void(double)>& progress) mutable
                 {
                     EncodeTask& task = tasks[i];
                     attempt(task, [&] { return job.run(task.input, task.output, progress); });
                     if (task.error)
                         console.error(task.input.string(), *task.error);
                     else if (task.result->replacedSamples > 0)
                         console.warning(task.input.string(),
                                         fmt::format("{} samples were no numbers or absurdly large and were taken as 0",
                                                     task.result->replacedSamples));
                 };
             });

    if (json)
        console.print(jsonReport(tasks, toJson));
    else
        console.note(summary(tasks));
    return anyFailed(tasks) ? Exit::failed : Exit::ok;
}

} // namespace pacini::cli
