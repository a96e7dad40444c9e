// Subcommand that checks clips and scenes.

#include "cli/Command.h"
#include "cli/Counted.h"
#include "cli/ExportOptions.h"
#include "cli/InputFiles.h"
#include "cli/LossText.h"
#include "cli/Manifest.h"
#include "cli/Options.h"
#include "io/ClipFile.h"
#include "io/SceneCheck.h"

#include <pacini/synthesis/Scene.h>
#include <pacini/synthesis/SceneTimeline.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

std::string targetList()
{
    std::string lines;
    for (const ClipFormat& format : clipFormats())
        if (!format.isOwn())
            lines += fmt::format("{}{:<14} {:<10} {}{}", lines.empty() ? "" : "\n", format.name, format.extension,
                                 format.title, !format.isWritten() ? " (read only)" : "");
    return lines;
}

Json targetsJson()
{
    Json targets = Json::array();
    for (const ClipFormat& format : clipFormats())
        if (!format.isOwn())
            targets.push_back({{"name", format.name},
                               {"extension", format.extension},
                               {"title", format.title},
                               {"readOnly", !format.isWritten()}});
    return {{"targets", targets}};
}

/// What is found in a scene itself, among the kinds of losses.
constexpr std::string_view sceneKind = "scene";

std::vector<std::string> kindNames()
{
    std::vector<std::string> names;
    for (int kind = 0; kind <= static_cast<int>(LossKind::transient); ++kind)
        names.emplace_back(lossName(static_cast<LossKind>(kind)));
    names.emplace_back(sceneKind);
    return names;
}

/// `pacini lint`: lists the losses of clips in a format before export, and the parts of a scene without effect.
struct LintCommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    /// Whether the user does not allow anything of this kind.
    [[nodiscard]] bool failsOn(std::string_view kind) const;

    /// Whether a loss is more than the user allows.
    [[nodiscard]] bool isTooMuch(const FormatLoss& loss) const;

    /// What is in the report of a file; each also prints it, and counts what is too much.
    using Json = nlohmann::ordered_json;
    [[nodiscard]] Result<Json> lint(Console& console, const InputFile& file, const ExportParams& params,
                                    std::size_t& tooMuch) const;
    [[nodiscard]] Json lintScene(Console& console, const std::string& name, const Scene& scene,
                                 std::size_t& tooMuch) const;
    [[nodiscard]] Result<Json> lintClip(Console& console, const std::string& name, const Clip& clip,
                                        const ExportParams& params, std::size_t& tooMuch) const;

    std::vector<std::string> inputs;
    std::string target;
    std::string clipFolder;
    ExportOptions options;
    double maxError = -1.0; ///< negative: any
    double maxOctaves = -1.0;
    double maxTime = -1.0;
    std::vector<std::string> forbidden;
    bool listTargets = false;
};
} // namespace

CLI::App* LintCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand(
        "lint", "Show losses of clips in another format, with place and size, and unplayed parts of scenes");
    addOption(*command, "inputs", inputs, "Clips of any format, scenes, or folders with clips and scenes", "CLIP");
    std::vector<std::string> names;
    for (const ClipFormat& known : clipFormats())
        if (known.isWritten() && !known.isOwn())
            names.emplace_back(known.name);
    addOption(*command, "--target", target, "Format to check, see --targets; scenes need none", oneOf(names));
    command->add_flag("--targets", listTargets, "List the formats and exit");
    options.declare(*command);
    addOption(*command, "--clips", clipFolder, "Folder with the clip files of scenes [the folder of the scene]", "DIR");
    addOption(*command, "--max-error", maxError,
              "Largest allowed amplitude error of bands, points, events and noise (1 = full drive)",
              numberFrom(0.0, 1000.0));
    addOption(*command, "--max-octaves", maxOctaves, "Largest allowed frequency error, octaves",
              numberFrom(0.0, 100.0));
    addOption(*command, "--max-time", maxTime, "Largest allowed time error, s",
              numberFrom(0.0, limits::duration, "24 h"));
    addOption(*command, "--fail-on", forbidden,
              "Fail on any loss of these kinds; scene fails on any finding in a scene", oneOf(kindNames()))
        ->delimiter(',');
    return command->footer(
        "Examples:\n  pacini lint door.json --target ahap\n"
        "  pacini lint clips/ --target haptic --max-error 0.1   exits with 1 if a clip loses more\n"
        "  pacini lint hall.scene.json --fail-on scene   exits with 1 if part of it is never played");
}

bool LintCommand::failsOn(std::string_view kind) const
{
    return std::find(forbidden.begin(), forbidden.end(), kind) != forbidden.end();
}

bool LintCommand::isTooMuch(const FormatLoss& loss) const
{
    const double limit = loss.kind == LossKind::frequency ? maxOctaves : isTime(loss.kind) ? maxTime : maxError;
    return (limit >= 0.0 && loss.error > limit) || failsOn(lossName(loss.kind));
}

nlohmann::ordered_json LintCommand::lintScene(Console& console, const std::string& name, const Scene& scene,
                                              std::size_t& tooMuch) const
{
    Json found = Json::array();
    const bool over = failsOn(sceneKind);
    for (const SceneFinding& finding : checkScene(scene))
    {
        tooMuch += over ? 1u : 0u;
        found.push_back({{"where", finding.where}, {"message", finding.message}, {"tooMuch", over}});
        console.print(
            fmt::format("{}: {}: {}{}", printable(name), finding.where, finding.message, over ? "  TOO MUCH" : ""));
    }
    return found;
}

Result<nlohmann::ordered_json> LintCommand::lintClip(Console& console, const std::string& name, const Clip& clip,
                                                     const ExportParams& params, std::size_t& tooMuch) const
{
    const auto exported = clipFormatNamed(target)->write(clip, params);
    if (!exported)
        return exported.error();
    Json losses = Json::array();
    for (const FormatLoss& loss : exported->losses)
    {
        const bool over = isTooMuch(loss);
        tooMuch += over ? 1u : 0u;
        losses.push_back(toJson(loss));
        losses.back()["tooMuch"] = over;
        console.print(lossLine(name, loss) + (over ? "  TOO MUCH" : ""));
    }
    return losses;
}

Result<nlohmann::ordered_json> LintCommand::lint(Console& console, const InputFile& file, const ExportParams& params,
                                                 std::size_t& tooMuch) const
{
    const std::string name = file.path.string();
    const auto read = readClipOrScene(file.path, {clipFolder, console.isStrict()});
    if (!read)
        return read.error();
    const auto* scene = std::get_if<Scene>(&read->content);
    if (scene == nullptr && target.empty())
        return Error{ErrorCode::invalidArgument, "",
                     "is a clip and needs --target; 'pacini lint --targets' lists the formats"};
    console.warnings(name, read->warnings);
    std::size_t beyond = 0;
    Json found = Json::array(), losses = Json::array();
    double duration = 0.0;
    if (scene == nullptr)
    {
        const Clip& clip = std::get<Clip>(read->content);
        auto all = lintClip(console, name, clip, params, beyond);
        if (!all)
            return all.error();
        losses = std::move(*all);
        duration = clip.duration;
    }
    else
    {
        found = lintScene(console, name, *scene, beyond);
        duration = timelineOf(*scene).duration;
        for (std::size_t i = 0; i < scene->clips.size() && !target.empty(); ++i)
        {
            auto all = lintClip(console, fmt::format("{}: clips[{}]", name, i), scene->clips[i], params, beyond);
            if (!all)
                return Error{all.error().code, fmt::format("clips[{}]", i), all.error().text()};
            for (Json& loss : *all)
            {
                loss["clip"] = i;
                losses.push_back(std::move(loss));
            }
        }
    }
    if (found.empty() && losses.empty())
        console.note(fmt::format("{}: {}", printable(name), target.empty() ? "plays all" : "loses nothing"));
    tooMuch += beyond;
    Json report{{"input", name},
                {"format", read->formatName()},
                {"target", target.empty() ? Json(nullptr) : Json(target)},
                {"duration", duration},
                {"ok", beyond == 0},
                {"losses", std::move(losses)}};
    if (scene != nullptr)
        report["findings"] = std::move(found);
    return report;
}

Exit LintCommand::run(Console& console)
{
    if (listTargets)
    {
        console.addToReport(targetsJson());
        console.print(targetList());
        return Exit::ok;
    }
    if (inputs.empty())
        return console.fail("",
                            {ErrorCode::invalidArgument, "lint", "the input file is missing; try 'pacini lint --help'"},
                            Exit::usage);
    if (target.empty())
    {
        if (const std::string option = options.firstGiven(); !option.empty())
            return console.fail("",
                                {ErrorCode::invalidArgument, option,
                                 "needs a format to check; name it with --target, see 'pacini lint --targets'"},
                                Exit::usage);
    }
    else if (const auto fits = options.checkFor(*clipFormatNamed(target)); !fits)
        return console.fail("", fits.error(), Exit::usage);
    const auto params =
        target.empty() ? std::optional(ExportParams()) : options.params(console, *clipFormatNamed(target));
    if (!params)
        return Exit::failed;

    const InputFiles found = findInputs(inputs, clipFileExtensions());
    Json files = Json::array();
    bool failed = false, wrongUsage = false;
    const auto fail = [&](const std::string& file, const Error& error)
    {
        wrongUsage = wrongUsage || error.code == ErrorCode::invalidArgument;
        console.error(file, error);
        failed = true;
    };
    for (const InputFailure& failure : found.failures)
        fail(failure.path.string(), failure.error);
    std::size_t tooMuch = 0;
    for (const InputFile& file : found.files)
    {
        auto report = lint(console, file, *params, tooMuch);
        if (report)
            files.push_back(std::move(*report));
        else
            fail(file.path.string(), report.error());
    }
    console.addToReport({{"files", files}});
    if (tooMuch > 0)
        console.error("", {ErrorCode::invalidData, "lint",
                           fmt::format("{} more than is allowed", counted(tooMuch, "loss is", "losses are"))});
    if (wrongUsage && target.empty())
        return Exit::usage;
    return tooMuch > 0 || failed ? Exit::failed : Exit::ok;
}

std::unique_ptr<Command> lintCommand()
{
    return std::make_unique<LintCommand>();
}

} // namespace pacini::cli
