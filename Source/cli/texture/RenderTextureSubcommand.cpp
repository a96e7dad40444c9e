// Subcommand that renders a texture by a course of speed and force.

#include "cli/Command.h"
#include "cli/DescribedOptions.h"
#include "cli/Options.h"
#include "cli/ProfileInput.h"
#include "cli/texture/TextureOutput.h"
#include "io/AudioWriter.h"
#include "io/FileExtension.h"
#include "io/MotionFile.h"
#include "io/TextureFile.h"

#include <pacini/synthesis/RenderTexture.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
/// `pacini texture render`: renders a texture as a drive signal.
struct RenderTextureSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    Exit render(Console& console, const Texture& texture, const TextureMotion& motion,
                const TextureRenderParams& params) const;

    std::string input, output, speed, force = "1", profile;
    std::uint64_t seed = 1;
    CLI::Option* forceOption = nullptr;
    DescribedOptions described;
    OverwriteOptions overwriting;
};

/// The speed alone, in words.
Result<TextureMotion> motionInWords(const std::string& speed)
{
    auto curve = curveOfText(speed);
    if (!curve)
        return curve.error();
    return TextureMotion{std::move(*curve), {}};
}

Error atOption(const char* option, const Error& error)
{
    return {error.code, option, error.message};
}

/// Of a speed that gives the length.
Error tooLong(double seconds)
{
    return {
        ErrorCode::invalidArgument, "",
        fmt::format("ends after {:g} s, but textures are rendered for 0.001 to 86400 s; state a --duration", seconds)};
}

/// Divides a curve of a table by what counts as 1. Returns whether any of it is beyond that.
bool scale(Curve& curve, double full)
{
    bool beyond = false;
    for (Breakpoint& point : curve)
    {
        point.value /= full;
        beyond = beyond || point.value > 1.0;
    }
    return beyond;
}
} // namespace

CLI::App* RenderTextureSubcommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("render", "Render a texture as a drive signal by speed and force");
    addOption(*command, "texture", input, "Texture (JSON) of 'pacini texture analyse'", "TEXTURE")->required();
    addOption(*command, "-o,--output", output, "Sound file to write (.wav or .flac)", "OUT")->required();
    addOption(*command, "--speed", speed,
              "Speed from 0 to 1: a number, points of time (s) and speed such as \"0:0 .5:1 1:.3\", or a CSV file "
              "with time, speed and perhaps force in the units of the texture's recording",
              "CURVE|FILE.csv")
        ->required();
    forceOption =
        addPreset(*command, "--force", force, "Force from 0 to 1: a number, or points as for the speed", "CURVE");
    addOption(*command, "--profile", profile,
              "Actuator that the drive is for: its equaliser or the inverse of its resonance, and its limits",
              "PROFILE");
    described.declare(*command, infosOf(textureRenderParameters));
    addPreset(*command, "--seed", seed, "Seed of the noise", countingNumber());
    overwriting.declare(*command);
    return command->footer(
        "Examples:\n  pacini texture render wood.texture.json --speed \"0:0 .5:1 1:.3\" -o drive.wav\n"
        "  pacini texture render wood.texture.json --speed 0.6 --force \"0:0 1:1\" --duration 2 -o drive.wav --profile "
        "l5-wristband");
}

Exit RenderTextureSubcommand::run(Console& console)
{
    const bool isTable = lowerExtension(speed) == ".csv";
    std::vector<std::string> inputs{input};
    if (isTable)
        inputs.push_back(speed);
    if (const auto ended = checkTextureOutput(console, output, inputs, overwriting))
        return *ended;
    TextureRenderParams params;
    described.apply(textureRenderParameters, params);
    params.sampleRate = std::round(params.sampleRate);
    auto motion = isTable ? readMotion(speed) : motionInWords(speed);
    if (!motion)
        return isTable ? console.fail(speed, motion.error())
                       : console.fail("", atOption("--speed", motion.error()), Exit::usage);
    auto forces = curveOfText(force);
    if (!forces)
        return console.fail("", atOption("--force", forces.error()), Exit::usage);
    const bool isGiven = params.duration.has_value();
    if (!isGiven)
        params.duration = motion->speed.back().time;
    if (!(*params.duration > 0.0))
        return console.fail(
            "", {ErrorCode::invalidArgument, "--duration", "is missing; a speed without points has no end of its own"},
            Exit::usage);
    const auto allowed = checkParameters(textureRenderParameters, params);
    if (!allowed && isGiven)
        return console.fail("", atOption("--duration", allowed.error()), Exit::usage);
    if (!allowed)
        return isTable ? console.fail(speed, tooLong(*params.duration))
                       : console.fail("", atOption("--speed", tooLong(*params.duration)), Exit::usage);
    ReadWarnings warnings(console.isStrict());
    const auto texture = readTexture(input, &warnings);
    if (!texture)
        return console.fail(input, texture.error());
    console.warnings(input, warnings.texts());
    if (isTable && scale(motion->speed, texture->fullSpeed))
        console.warning(speed, fmt::format("goes beyond the full speed of the texture, {:g}, and is limited to it",
                                           texture->fullSpeed));
    if (scale(motion->force, texture->fullForce))
        console.warning(speed, fmt::format("goes beyond the full force of the texture, {:g}, and is limited to it",
                                           texture->fullForce));
    if (motion->force.empty() || forceOption->count() > 0)
        motion->force = std::move(*forces);
    return render(console, *texture, *motion, params);
}

Exit RenderTextureSubcommand::render(Console& console, const Texture& texture, const TextureMotion& motion,
                                     const TextureRenderParams& params) const
{
    std::optional<Profile> actuator;
    if (!profile.empty())
    {
        actuator = openProfile(console, profile);
        if (!actuator)
            return Exit::failed;
        if (actuator->technology == Technology::erm)
            return console.fail(profile, {ErrorCode::invalidData, "technology",
                                          "is a motor, which cannot follow a texture; take another actuator"});
    }
    const double fs = params.sampleRate;
    AudioWriteParams writing;
    writing.sampleRate = static_cast<int>(fs);
    writing.encoding = lowerExtension(output) == ".flac" ? SampleEncoding::pcm24 : SampleEncoding::float32;
    writing.expectedFrames = static_cast<std::uint64_t>(std::llround(*params.duration * fs));
    auto writer = AudioWriter::create(output, writing);
    if (!writer)
        return console.fail(output, writer.error());
    const auto rendered =
        renderTexture(texture, {motion.speed, motion.force}, params, seed, actuator ? &*actuator : nullptr,
                      [&](std::span<const float> samples, double done) -> Result<void>
                      {
                          console.progress(done, output);
                          return writer->write(samples);
                      });
    console.endProgress();
    if (!rendered)
        return console.fail(output, rendered.error());
    const auto report = writer->finish();
    if (!report)
        return console.fail(output, report.error());
    console.addToReport({{"input", input},
                         {"output", output},
                         {"bytes", report->bytes},
                         {"duration", *params.duration},
                         {"sampleRate", fs},
                         {"peak", rendered->peak},
                         {"rms", rendered->rms}});
    console.wrote(output, fmt::format("{}, RMS {:.3f}, peak {:.3f}", durationText(*params.duration), rendered->rms,
                                      rendered->peak));
    return Exit::ok;
}

std::unique_ptr<Command> renderTextureSubcommand()
{
    return std::make_unique<RenderTextureSubcommand>();
}

} // namespace pacini::cli
