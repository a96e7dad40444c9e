#include "cli/LintCommand.h"

#include "cli/Checks.h"
#include "cli/ConvertManifest.h"
#include "cli/Counted.h"
#include "cli/InputFiles.h"
#include "io/AnyClip.h"
#include "io/ClipExport.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

std::string targetList()
{
    std::string lines;
    for (const ForeignFormat& format : foreignFormats())
        lines += fmt::format("{}{:<14} {:<10} {}{}", lines.empty() ? "" : "\n", format.name, format.extension,
                             format.title, format.write == nullptr ? " (read only)" : "");
    return lines;
}

Json targetsJson()
{
    Json targets = Json::array();
    for (const ForeignFormat& format : foreignFormats())
        targets.push_back({{"name", format.name},
                           {"extension", format.extension},
                           {"title", format.title},
                           {"readOnly", format.write == nullptr}});
    return {{"targets", targets}};
}

std::vector<std::string> kindNames()
{
    std::vector<std::string> names;
    for (int kind = 0; kind <= static_cast<int>(LossKind::text); ++kind)
        names.emplace_back(lossName(static_cast<LossKind>(kind)));
    return names;
}

/// Whether errors of this kind are seconds.
bool isTime(LossKind kind)
{
    return kind == LossKind::timeStep || kind == LossKind::length;
}

/// "0.25 octaves"
std::string errorText(const FormatLoss& loss)
{
    if (loss.error <= 0.0)
        return "";
    if (loss.kind == LossKind::frequency)
        return fmt::format("{:.2f} octaves", loss.error);
    if (isTime(loss.kind))
        return fmt::format("{:.2g} ms", 1000.0 * loss.error);
    return fmt::format("{:.3f}", loss.error);
}
} // namespace

CLI::App* LintCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("lint", "Say what another format will lose of clips, where and how much");
    command->add_option("inputs", inputs, "Clips of any format, or folders of them")->type_name("CLIP");
    std::vector<std::string> names;
    for (const ClipTarget& known : clipTargets())
        if (known.foreign != nullptr)
            names.emplace_back(known.name);
    command->add_option("--target", target, "The format, see --targets")->check(oneOf(names));
    command->add_flag("--targets", listTargets, "List the formats and do nothing else");
    options.declare(*command);
    command
        ->add_option("--max-error", maxError,
                     "Fail when an amplitude is off by more (1 = full drive): bands, points, events, noise")
        ->check(numberFrom(0.0, 1000.0));
    command->add_option("--max-octaves", maxOctaves, "Fail when a frequency is off by more octaves")
        ->check(numberFrom(0.0, 100.0));
    command->add_option("--max-time", maxTime, "Fail when a time is off by more seconds")
        ->check(numberFrom(0.0, limits::duration, "24 h"));
    command->add_option("--fail-on", forbidden, "Fail on any loss of these kinds")
        ->check(oneOf(kindNames()))
        ->delimiter(',');
    command->footer("Examples:\n  pacini lint door.json --target ahap\n"
                    "  pacini lint clips/ --target haptic --max-error 0.1   exits with 1 when a clip loses more");
    return command;
}

bool LintCommand::isTooMuch(const FormatLoss& loss) const
{
    const double limit = loss.kind == LossKind::frequency ? maxOctaves : isTime(loss.kind) ? maxTime : maxError;
    return (limit >= 0.0 && loss.error > limit) ||
           std::find(forbidden.begin(), forbidden.end(), lossName(loss.kind)) != forbidden.end();
}

Exit LintCommand::run(Console& console)
{
    if (listTargets)
    {
        console.addToReport(targetsJson());
        console.print(targetList());
        return Exit::ok;
    }
    if (inputs.empty() || target.empty())
    {
        console.error("", {ErrorCode::invalidArgument, "lint",
                           inputs.empty() ? "a file to work on is missing; try 'pacini lint --help'"
                                          : "--target is missing; 'pacini lint --targets' lists them"});
        return Exit::usage;
    }
    const auto params = options.params(console);
    if (!params)
        return Exit::failed;
    const ForeignFormat& format = *foreignFormatNamed(target);

    const InputFiles found = findInputs(inputs, anyClipExtensions());
    Json files = Json::array();
    bool failed = false;
    const auto fail = [&](const std::string& file, const Error& error)
    {
        console.error(file, error);
        failed = true;
    };
    for (const InputFailure& failure : found.failures)
        fail(failure.path.string(), failure.error);
    std::size_t tooMuch = 0;
    for (const InputFile& file : found.files)
    {
        const std::string name = file.path.string();
        const auto read = readAnyClip(file.path);
        const auto exported = read ? format.write(read->clip, *params) : Result<ExportedClip>(read.error());
        if (!exported)
        {
            fail(name, exported.error());
            continue;
        }
        for (const std::string& warning : read->warnings)
            console.warning(name, warning);
        Json losses = Json::array();
        std::size_t beyond = 0;
        for (const FormatLoss& loss : exported->losses)
        {
            const bool over = isTooMuch(loss);
            beyond += over ? 1u : 0u;
            losses.push_back(toJson(loss));
            losses.back()["tooMuch"] = over;
            console.print(fmt::format("{}: {:8.3f} s {:>7}  {:<10}{:>13}  {}{}", printable(name), loss.time,
                                      loss.duration > 0.0 ? fmt::format("+{:.3f}", loss.duration) : "",
                                      lossName(loss.kind), errorText(loss), loss.message, over ? "  TOO MUCH" : ""));
        }
        tooMuch += beyond;
        if (exported->losses.empty())
            console.note(fmt::format("{}: loses nothing", printable(name)));
        files.push_back({{"input", name},
                         {"format", read->format},
                         {"target", target},
                         {"duration", read->clip.duration},
                         {"ok", beyond == 0},
                         {"losses", losses}});
    }
    console.addToReport({{"files", files}});
    if (tooMuch > 0)
        console.error("", {ErrorCode::invalidData, "lint",
                           fmt::format("{} more than is allowed", counted(tooMuch, "loss is", "losses are"))});
    return tooMuch > 0 || failed ? Exit::failed : Exit::ok;
}

} // namespace pacini::cli
