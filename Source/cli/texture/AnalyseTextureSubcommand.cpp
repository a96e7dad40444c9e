// Subcommand that makes a texture of a recording.

#include "cli/Command.h"
#include "cli/Counted.h"
#include "cli/DescribedOptions.h"
#include "cli/Options.h"
#include "cli/texture/TextureOutput.h"
#include "io/AtomicFile.h"
#include "io/AudioReader.h"
#include "io/MotionFile.h"
#include "io/TextureFile.h"

#include <pacini/analysis/MonoMix.h>
#include <pacini/texture/TextureAnalysis.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
constexpr std::uint64_t mostSeconds = 3600; // of a recording

/// `pacini texture analyse`: makes a texture of a recording.
struct AnalyseTextureSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    void tell(Console& console, const TextureFit& fit) const;

    std::string input, output, speed, name;
    DescribedOptions described;
    OverwriteOptions overwriting;
};
} // namespace

CLI::App* AnalyseTextureSubcommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("analyse", "Make a texture of the recording of a stroke, a river or an engine");
    addOption(*command, "recording", input, "Sound of an accelerometer or a microphone; channels are averaged",
              "STROKE.wav")
        ->required();
    addOption(*command, "-o,--output", output, "Texture to write (JSON)", "OUT.texture.json")->required();
    addOption(*command, "--speed", speed,
              "CSV file with time (s), speed and, if known, force: any units [one speed throughout]", "FILE.csv");
    described.declare(*command, infosOf(textureParameters));
    addOption(*command, "--name", name, "Name of the texture [that of the recording]", "NAME");
    overwriting.declare(*command);
    return command->footer("Examples:\n  pacini texture analyse stroke.wav --speed hand.csv -o wood.texture.json\n"
                           "  pacini texture analyse river.wav --pitch 0 -o river.texture.json");
}

void AnalyseTextureSubcommand::tell(Console& console, const TextureFit& fit) const
{
    const Texture& texture = fit.texture;
    nlohmann::ordered_json nodes = nlohmann::ordered_json::array();
    for (const TextureNode& node : texture.nodes)
        nodes.push_back({{"speed", node.speed}, {"level", node.level}});
    nlohmann::ordered_json tones = nlohmann::ordered_json::array();
    for (const TextureTone& tone : texture.tones)
        tones.push_back({{"frequency", tone.frequency}, {"levels", tone.levels}});
    console.addToReport({{"input", input},
                         {"output", output},
                         {"frames", fit.frames},
                         {"pitch", texture.pitch},
                         {"levelBySpeed", texture.levelBySpeed},
                         {"levelByForce", texture.levelByForce},
                         {"nodes", std::move(nodes)},
                         {"tones", std::move(tones)}});
    const auto law = [](bool assumed)
    {
        return assumed ? " (assumed)" : "";
    };
    const double slowest = texture.nodes.front().speed;
    const std::string speeds =
        texture.nodes.size() == 1
            ? fmt::format("one speed, {:.2g}", slowest)
            : fmt::format("{} speeds from {:.2g} to {:.2g}", texture.nodes.size(), slowest, texture.nodes.back().speed);
    const std::string found = texture.tones.empty() ? "" : ", " + counted(texture.tones.size(), "tone", "tones");
    console.wrote(output, fmt::format("{}{}; frequencies as speed^{:.2g}{}, level as speed^{:.2g}{} and force^{:.2g}{}",
                                      speeds, found, texture.pitch, law(fit.pitchAssumed), texture.levelBySpeed,
                                      law(fit.speedLawAssumed), texture.levelByForce, law(fit.forceLawAssumed)));
}

Exit AnalyseTextureSubcommand::run(Console& console)
{
    std::vector<std::string> inputs{input};
    if (!speed.empty())
        inputs.push_back(speed);
    if (const auto ended = checkTextureOutput(console, output, inputs, overwriting))
        return *ended;
    TextureParams params;
    described.apply(textureParameters, params);
    TextureMotion motion;
    if (!speed.empty())
    {
        auto read = readMotion(speed);
        if (!read)
            return console.fail(speed, read.error());
        motion = std::move(*read);
    }
    auto sound = readAudio(input, {}, mostSeconds * 768000);
    if (!sound)
        return console.fail(input, sound.error());
    console.warnings(input, sound->warnings);
    auto fit = analyseTexture(monoMix(sound->samples, static_cast<std::size_t>(sound->channels)), sound->sampleRate,
                              motion, params);
    if (!fit)
        return console.fail(fit.error().where.empty() ? input : speed, fit.error());
    console.warnings(speed, fit->warnings);
    fit->texture.name = name.empty() ? std::filesystem::path(input).stem().string() : name;
    if (const auto written = writeFileAtomically(output, textureJson(fit->texture)); !written)
        return console.fail(output, written.error());
    tell(console, *fit);
    return Exit::ok;
}

std::unique_ptr<Command> analyseTextureSubcommand()
{
    return std::make_unique<AnalyseTextureSubcommand>();
}

} // namespace pacini::cli
