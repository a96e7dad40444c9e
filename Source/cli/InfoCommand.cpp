// Subcommand that describes files.

#include "cli/Command.h"
#include "cli/Counted.h"
#include "cli/Options.h"
#include "cli/ProfileInput.h"
#include "cli/ProfileReport.h"
#include "cli/SceneReport.h"
#include "io/AudioReader.h"
#include "io/ClipFile.h"
#include "io/Overwrite.h"
#include "io/TextureFile.h"
#include "io/formats/json/ClipJson.h"

#include <pacini/clip/Clip.h>
#include <pacini/clip/PackedClip.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

/// The bits that a clip takes as the thesis counts (Weber 2020, Eq. 4.11): `bits` for each time and each value of all
/// breakpoints, and of the time and amplitude of all transients.
std::size_t thesisBits(const Clip& clip, int bits) noexcept
{
    return (breakpointCount(clip) + clip.transients.size()) * 2 * static_cast<std::size_t>(bits);
}

Json describeClip(const Clip& clip, const ClipFormat& format)
{
    Json encoder = Json::object();
    for (const EncoderParameter& parameter : clip.encoder)
        std::visit([&](const auto& value) { encoder[parameter.name] = value; }, parameter.value);
    const auto packed = packClip(clip, packParamsFor(clip)).size();
    return {{"kind", "clip"},
            {"format", format.name},
            {"name", clip.name},
            {"duration", clip.duration},
            {"source",
             {{"file", clip.source.file}, {"sampleRate", clip.source.sampleRate}, {"channels", clip.source.channels}}},
            {"encoder", encoder},
            {"bands", clip.bands.size()},
            {"breakpoints", breakpointCount(clip)},
            {"transients", clip.transients.size()},
            {"markers", clip.markers.size()},
            {"bytes",
             {{"json", writeClipJson(clip).size()},
              {"packed", packed},
              {"thesisBits", thesisBits(clip, packParamsFor(clip).bits)}}},
            {"bytesPerSecond", clip.duration > 0.0 ? static_cast<double>(packed) / clip.duration : 0.0}};
}

/// "method a2vt, bands 12, ..."
std::string encoderText(const std::vector<EncoderParameter>& encoder)
{
    std::string line;
    for (const EncoderParameter& parameter : encoder)
    {
        const std::string value =
            std::visit([](const auto& v) { return printable(fmt::format("{}", v)); }, parameter.value);
        line += fmt::format("{}{} {}", line.empty() ? "" : ", ", printable(parameter.name), value);
    }
    return line;
}

/// Of a clip of another program, the program.
std::string titleOf(const ClipFormat& format)
{
    return format.isOwn() ? "" : fmt::format(" ({})", format.title);
}

/// " (48000 Hz, 2 channels)", as far as it is known.
std::string soundText(const ClipSource& source)
{
    std::string text;
    if (source.sampleRate > 0.0)
        text = fmt::format("{:.0f} Hz", source.sampleRate);
    if (source.channels > 0)
        text +=
            fmt::format("{}{} channel{}", text.empty() ? "" : ", ", source.channels, source.channels == 1 ? "" : "s");
    return text.empty() ? "" : " (" + text + ")";
}

std::string text(const std::string& file, const Clip& clip, const ClipFormat& format)
{
    const Json j = describeClip(clip, format);
    std::string lines = fmt::format("{}: haptic clip \"{}\"{}, {}\n", printable(file), printable(clip.name),
                                    titleOf(format), durationText(clip.duration));
    if (!clip.source.file.empty())
        lines += fmt::format("  made from     {}{}\n", printable(clip.source.file), soundText(clip.source));
    if (!clip.encoder.empty())
        lines += "  encoder       " + encoderText(clip.encoder) + "\n";
    if (!clip.bands.empty())
        lines += fmt::format("  bands         {} from {:.0f} to {:.0f} Hz\n", clip.bands.size(),
                             clip.bands.front().lowFrequency, clip.bands.back().highFrequency);
    lines += fmt::format("  breakpoints   {}\n  transients    {}\n", breakpointCount(clip), clip.transients.size());
    lines += fmt::format("  size          {} packed ({:.0f} B/s), {} as JSON, {} bits by the thesis' count",
                         bytesText(j["bytes"]["packed"].get<double>()), j["bytesPerSecond"].get<double>(),
                         bytesText(j["bytes"]["json"].get<double>()), j["bytes"]["thesisBits"].get<std::size_t>());
    return lines;
}

/// Reads the whole sound, since only that finds out whether it is sound.
Result<Json> describeAudio(const std::string& file, std::vector<std::string>& warnings)
{
    auto reader = AudioReader::open(file, {.lowestSampleRate = limits::slowestSound});
    if (!reader)
        return reader.error();
    std::size_t samples = 0;
    double peak = 0.0;
    const auto read = reader->forEachBlock(4096,
                                           [&](std::span<const float> block)
                                           {
                                               samples += block.size();
                                               for (const float sample : block)
                                                   peak = std::max(peak, std::abs(static_cast<double>(sample)));
                                               return true;
                                           });
    if (!read)
        return read.error();
    warnings = reader->warnings();
    const std::size_t frames = samples / static_cast<std::size_t>(reader->channels());
    return Json{{"kind", "audio"},
                {"duration", static_cast<double>(frames) / reader->sampleRate()},
                {"sampleRate", reader->sampleRate()},
                {"channels", reader->channels()},
                {"frames", frames},
                {"peak", peak}};
}

Json describeTexture(const Texture& texture)
{
    Json nodes = Json::array();
    for (const TextureNode& node : texture.nodes)
        nodes.push_back({{"speed", node.speed}, {"level", node.level}});
    return {{"kind", "texture"},
            {"name", texture.name},
            {"fullSpeed", texture.fullSpeed},
            {"fullForce", texture.fullForce},
            {"pitch", texture.pitch},
            {"levelBySpeed", texture.levelBySpeed},
            {"levelByForce", texture.levelByForce},
            {"nodes", std::move(nodes)},
            {"tones", texture.tones.size()}};
}

std::string textureText(const std::string& file, const Texture& texture)
{
    return fmt::format("{}: texture \"{}\", {} from {:.2g} to {:.2g} of the full speed ({:g} in the unit of the "
                       "recording), {}\n  frequencies as speed^{:.2g}, level as speed^{:.2g} and force^{:.2g}",
                       printable(file), printable(texture.name), counted(texture.nodes.size(), "speed", "speeds"),
                       texture.nodes.front().speed, texture.nodes.back().speed, texture.fullSpeed,
                       counted(texture.tones.size(), "tone", "tones"), texture.pitch, texture.levelBySpeed,
                       texture.levelByForce);
}

/// `pacini info`: shows the content of a clip, a scene, a texture, a sound file or a profile.
struct InfoCommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    std::vector<std::string> inputs;
    std::string clipFolder;
};
} // namespace

CLI::App* InfoCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand(
        "info", "Show the content of a clip of any format, a scene, a texture, a sound or an actuator profile");
    addOption(*command, "inputs", inputs,
              "Clips, scenes, textures, audio files, profiles, or names of shipped profiles", "FILE|PROFILE")
        ->required();
    addOption(*command, "--clips", clipFolder, "Folder with the clip files of scenes [the folder of the scene]", "DIR");
    return command->footer("Examples:\n  pacini info door.json door.haptic door.wav\n"
                           "  pacini info l5-wristband                       a profile that comes with Pacini");
}

Exit InfoCommand::run(Console& console)
{
    Json files = Json::array();
    const auto add = [&files](const std::string& file, const Json& described)
    {
        files.push_back({{"input", file}});
        files.back().update(described);
    };
    bool failed = false;
    for (const std::string& file : inputs)
    {
        ReadWarnings keys(console.isStrict());
        if (const auto profile = profileIn(file, &keys))
        {
            console.warnings(file, keys.texts());
            if (!*profile)
            {
                console.error(file, profile->error());
                failed = true;
            }
            else
            {
                add(file, describe(**profile));
                console.print(profileText(file, **profile));
            }
            continue;
        }
        if (!isStream(file) && kindOf(file) == FileKind::texture)
        {
            const auto texture = readTexture(file, &keys);
            console.warnings(file, keys.texts());
            if (texture)
            {
                add(file, describeTexture(*texture));
                console.print(textureText(file, *texture));
            }
            else
                console.error(file, texture.error());
            failed = failed || !texture;
            continue;
        }
        const auto read = readClipOrScene(file, {clipFolder, console.isStrict()});
        if (read)
        {
            console.warnings(file, read->warnings);
            if (const auto* clip = std::get_if<Clip>(&read->content))
            {
                add(file, describeClip(*clip, *read->format));
                console.print(text(file, *clip, *read->format));
            }
            else
            {
                const Scene& scene = std::get<Scene>(read->content);
                add(file, sceneReport(scene));
                console.print(sceneText(file, scene));
            }
            continue;
        }
        // A file that is no clip may be a sound; a broken clip should be reported as a clip.
        std::vector<std::string> doubts;
        const auto audio = looksLikeClip(file) ? Result<Json>(read.error()) : describeAudio(file, doubts);
        if (!audio)
        {
            console.error(file, audio.error());
            failed = true;
            continue;
        }
        console.warnings(file, doubts);
        add(file, *audio);
        console.print(fmt::format("{}: sound, {}, {} Hz, {} channel{}, peak {:.3f}", printable(file),
                                  durationText((*audio)["duration"].get<double>()), (*audio)["sampleRate"].get<int>(),
                                  (*audio)["channels"].get<int>(), (*audio)["channels"] == 1 ? "" : "s",
                                  (*audio)["peak"].get<double>()));
    }
    console.addToReport(fileList(std::move(files), inputs.size() == 1));
    return failed ? Exit::failed : Exit::ok;
}

std::unique_ptr<Command> infoCommand()
{
    return std::make_unique<InfoCommand>();
}

} // namespace pacini::cli
