// Subcommand that draws charts.

#include "cli/Command.h"
#include "cli/EncodeJob.h"
#include "cli/InputFiles.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/ProfileInput.h"
#include "cli/plot/AnalysisFigure.h"
#include "cli/plot/ClipFigure.h"
#include "cli/plot/Figure.h"
#include "cli/plot/ProfileFigure.h"
#include "cli/plot/SceneFigure.h"
#include "cli/plot/Waveform.h"
#include "io/AudioReader.h"
#include "io/ClipFile.h"
#include "io/SettingsFile.h"

#include <pacini/analysis/MonoMix.h>
#include <pacini/synthesis/RenderScene.h>
#include <pacini/synthesis/Scene.h>
#include <pacini/synthesis/SceneTimeline.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

namespace pacini::cli
{

namespace
{
using Progress = std::function<void(double)>;

constexpr int smallestSide = 200; // pixels
constexpr int largestSide = 10000;

/// "1600x1000" as a size.
std::optional<plot::PictureSize> parseSize(const std::string& text)
{
    plot::PictureSize size;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    if (width.ec != std::errc() || width.ptr == end || *width.ptr != 'x')
        return std::nullopt;
    const auto height = std::from_chars(width.ptr + 1, end, size.height);
    if (height.ec != std::errc() || height.ptr != end)
        return std::nullopt;
    const auto allowed = [](int side)
    {
        return side >= smallestSide && side <= largestSide;
    };
    return allowed(size.width) && allowed(size.height) ? std::optional(size) : std::nullopt;
}

Result<plot::NamedWaveform> soundWaveform(const std::filesystem::path& file, plot::TimeRange range, std::size_t columns,
                                          std::vector<std::string>& warnings)
{
    auto reader = AudioReader::open(file);
    if (!reader)
        return reader.error();
    const auto channels = static_cast<std::size_t>(reader->channels());
    plot::Waveform waveform(range, columns, reader->sampleRate(), channels);
    const auto read =
        reader->forEachBlock(4096, [&](std::span<const float> block) { return waveform.push(block), true; });
    if (!read)
        return read.error();
    warnings = reader->warnings();
    return plot::NamedWaveform{fmt::format("Sound: {}{}", file.filename().string(),
                                           channels > 1 ? fmt::format(" (mean of {} channels)", channels) : ""),
                               waveform.points()};
}

/// Draws a drive signal.
class WaveformSink : public RenderSink
{
public:
    WaveformSink(plot::Waveform& toFill, const Progress& toTell) : waveform(toFill), told(toTell) {}

    Result<void> take(const RenderBlock& block) override
    {
        waveform.push(block.channels.front());
        return {};
    }
    Result<void> progress(double share) override
    {
        told(share);
        return {};
    }

private:
    plot::Waveform& waveform;
    const Progress& told;
};

/// The drive signal as `pacini render` makes it, for long clips at a lower rate: a pixel is much longer than a sample.
Result<plot::NamedWaveform> driveWaveform(const Clip& clip, const std::optional<Profile>& profile,
                                          plot::TimeRange range, std::size_t columns, const Progress& progress)
{
    constexpr double longClip = 300.0; // s
    RenderParams params;
    if (clip.duration > longClip)
        params.compile.sampleRate = 8000.0;
    const double fs = params.compile.sampleRate;
    params.to = (std::floor(range.to * fs) + 2.0) / fs;
    plot::Waveform waveform(range, columns, fs, 1);
    WaveformSink sink(waveform, progress);
    if (auto rendered = renderScene(sceneOf(clip), profile ? &*profile : nullptr, params, sink); !rendered)
        return rendered.error();
    return plot::NamedWaveform{profile ? fmt::format("Drive signal for {} (1 = full drive)", profile->name)
                                       : "Drive signal rendered from the clip (1 = full drive)",
                               waveform.points()};
}

/// `pacini plot`: a clip, a scene, a sound and the clip it becomes, or an actuator, as a picture.
struct PlotCommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    /// What is shown of something that lasts `duration` s. Errors: invalidArgument.
    [[nodiscard]] Result<plot::TimeRange> rangeWithin(double duration) const;

    [[nodiscard]] Progress progressOf(Console& console) const
    {
        return [&](double share)
        {
            console.progress(share, input);
        };
    }

    /// Draws a clip under the sound `heard`; empty: under its drive signal.
    Exit plotClip(Console& console, const std::filesystem::path& target, const Clip& clip, const std::string& heard,
                  const plot::FigureStyle& style) const;
    Exit plotScene(Console& console, const std::filesystem::path& target, const Scene& scene,
                   const plot::FigureStyle& style) const;
    /// Draws what the settings do to a sound.
    Exit plotAnalysis(Console& console, const std::filesystem::path& target, const plot::FigureStyle& style) const;
    Exit write(Console& console, const std::filesystem::path& target, const plot::Figure& figure,
               const plot::FigureStyle& style) const;

    std::string input;
    std::string output;
    std::string sound;
    std::string profile;
    std::string clipFolder;
    std::string settingsFile;
    std::string size = "1600x1000";
    std::optional<double> from;
    std::optional<double> to;
    bool dark = false;
    bool analysis = false;
    std::optional<Profile> actuator;
    OverwriteOptions overwriting;
    Replaceable replaceable = Replaceable::named; ///< at the target
};
} // namespace

CLI::App* PlotCommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("plot", "Draw a clip, a scene, a sound with its clip, or an actuator");
    addOption(*command, "input", input,
              "Clip of any format, scene, sound (encoded first), or actuator profile (a file or a shipped profile)",
              "IN|PROFILE")
        ->required();
    addOption(*command, "-o,--output", output, "Picture (.png, .svg or .pdf) or folder [the name of IN with .png]",
              "OUT");
    addOption(*command, "--sound", sound, "Sound to show above the clip instead of its drive signal", "FILE");
    addOption(*command, "--profile", profile,
              "Actuator profile: a file or a shipped profile such as l5-wristband; draws the drive signal for it",
              "PROFILE");
    addOption(*command, "--clips", clipFolder, "Folder with the clip files of a scene [the folder of the scene]",
              "DIR");
    addPreset(*command, "--size", size, "Size of the picture in pixels",
              CLI::Validator(
                  [](const std::string& text)
                  {
                      return parseSize(text)
                                 ? std::string()
                                 : fmt::format("must be WIDTHxHEIGHT, each {} to {}", smallestSide, largestSide);
                  },
                  "", "size"),
              "WxH");
    addOption(*command, "--from", from, "Start of the part to show, s [0]", numberFrom(0.0, limits::duration, "24 h"),
              "S");
    addOption(*command, "--to", to, "End of the part to show, s [the end]", numberFrom(0.0, limits::duration, "24 h"),
              "S");
    command->add_flag("--dark", dark, "Dark background");
    auto* asAnalysis = command->add_flag("--analysis", analysis,
                                         "Draw the analysis of a sound: envelope, onset score and threshold, centroid, "
                                         "response of the bands and their sum");
    addOption(*command, "--settings", settingsFile, "Settings of the analysis, as `pacini encode` has them", "FILE")
        ->needs(asAnalysis);
    overwriting.declare(*command);
    return command->footer("Examples:\n  pacini plot door.pacb -o door.png --sound door.wav\n"
                           "  pacini plot door.wav -o door.svg --from 0.5 --to 1.5\n"
                           "  pacini plot door.haptic -o door.png\n"
                           "  pacini plot hall.scene.json -o hall.png        times and actuators of each clip\n"
                           "  pacini plot door.wav --analysis -o analysis.png\n"
                           "  pacini plot l5-wristband -o l5.png");
}

Exit PlotCommand::run(Console& console)
{
    const std::filesystem::path path(input);
    const auto place = outputFor({path, path.filename()}, {output, ".png", ".png"}, false);
    if (!place)
        return console.fail(output, place.error());
    const std::filesystem::path* target = &place->path;
    replaceable = overwriting.of(place->named);
    if (!plot::pictureFormatOf(*target))
        return console.fail(target->string(),
                            {ErrorCode::invalidArgument, "", "must have the extension .png, .svg or .pdf"},
                            Exit::usage);
    if (from && to && *from >= *to)
        return console.fail("", {ErrorCode::invalidArgument, "--from", "must be before --to"}, Exit::usage);
    if (std::error_code ignored; std::filesystem::equivalent(*target, path, ignored))
        return console.fail(input, {ErrorCode::invalidArgument, "", alsoInput});
    if (overwriting.keeps(console, {*target}))
        return Exit::ok;

    const plot::FigureStyle style{*parseSize(size), dark};
    ReadWarnings keys(console.isStrict());
    if (const auto shown = profileIn(input, &keys))
    {
        console.warnings(input, keys.texts());
        if (!*shown)
            return console.fail(input, shown->error());
        if (from || to || !sound.empty() || !profile.empty() || analysis)
            return console.fail(input,
                                {ErrorCode::invalidArgument, "",
                                 "is a profile; leave out --from, --to, --sound, --profile and --analysis, which are "
                                 "for clips and sounds"},
                                Exit::usage);
        return write(console, *target, makeProfileFigure(**shown, style), style);
    }

    if (!profile.empty() && !(actuator = openProfile(console, profile)))
        return Exit::failed;
    const bool isClip = looksLikeClip(path);
    if (analysis && (isClip || !sound.empty() || !profile.empty()))
        return console.fail(
            input, {ErrorCode::invalidArgument, "--analysis", "is for one sound, without --sound and --profile"},
            Exit::usage);
    if (analysis)
        return plotAnalysis(console, *target, style);
    std::optional<Clip> clip;
    if (isClip)
    {
        auto read = readClipOrScene(path, {clipFolder, console.isStrict()});
        if (!read)
            return console.fail(input, read.error());
        console.warnings(input, read->warnings);
        if (const auto* scene = std::get_if<Scene>(&read->content))
            return plotScene(console, *target, *scene, style);
        clip = std::get<Clip>(std::move(read->content));
    }
    else
    {
        auto encoded = EncodeJob(EncodeSettings{}).encode(path, progressOf(console));
        if (!encoded)
            return console.fail(input, encoded.error());
        clip = std::move(*encoded);
    }
    return plotClip(console, *target, *clip, !isClip && sound.empty() ? input : sound, style);
}

Exit PlotCommand::plotClip(Console& console, const std::filesystem::path& target, const Clip& clip,
                           const std::string& heard, const plot::FigureStyle& style) const
{
    const auto range = rangeWithin(clip.duration);
    if (!range)
        return console.fail(input, range.error());
    const auto columns = static_cast<std::size_t>(style.size.width);
    std::vector<plot::NamedWaveform> waveforms;
    if (!heard.empty())
    {
        std::vector<std::string> doubts;
        auto waveform = soundWaveform(heard, *range, columns, doubts);
        if (!waveform)
            return console.fail(heard, waveform.error());
        console.warnings(heard, doubts);
        waveforms.push_back(std::move(waveform.value()));
    }
    if (heard.empty() || actuator)
    {
        auto waveform = driveWaveform(clip, actuator, *range, columns, progressOf(console));
        if (!waveform)
            return console.fail(input, waveform.error());
        waveforms.push_back(std::move(waveform.value()));
    }
    console.endProgress();

    const std::string title = clip.name.empty() ? std::filesystem::path(input).filename().string() : clip.name;
    return write(console, target, makeClipFigure(clip, title, waveforms, *range, style), style);
}

Result<plot::TimeRange> PlotCommand::rangeWithin(double duration) const
{
    constexpr double shortest = 1e-6; // s
    const double end = duration > shortest ? duration : 1.0;
    const plot::TimeRange range{from.value_or(0.0), std::min(to.value_or(end), end)};
    if (range.to - range.from < shortest)
        return Error{ErrorCode::invalidArgument, "--from",
                     fmt::format("is not before --to and the end, {:.3f} s", duration)};
    return range;
}

Exit PlotCommand::plotScene(Console& console, const std::filesystem::path& target, const Scene& scene,
                            const plot::FigureStyle& style) const
{
    if (!sound.empty() || !profile.empty())
        return console.fail(
            input, {ErrorCode::invalidArgument, "", "is a scene; leave out --sound and --profile, which are for clips"},
            Exit::usage);
    const auto range = rangeWithin(timelineOf(scene).duration);
    if (!range)
        return console.fail(input, range.error());
    const std::string title = scene.name.empty() ? std::filesystem::path(input).filename().string() : scene.name;
    return write(console, target, plot::makeSceneFigure(scene, title, *range, style), style);
}

Exit PlotCommand::plotAnalysis(Console& console, const std::filesystem::path& target,
                               const plot::FigureStyle& style) const
{
    Settings settings;
    if (!settingsFile.empty())
    {
        ReadWarnings warnings(console.isStrict());
        auto read = readSettingsFile(settingsFile, &warnings);
        if (!read)
            return console.fail(settingsFile, read.error());
        console.warnings(settingsFile, warnings.texts());
        settings = std::move(*read);
    }
    const auto translation = translationOf(settings);
    if (!translation)
        return console.fail(settingsFile, translation.error());
    if (translation->method != Method::a2vt && translation->method != Method::thesis)
        return console.fail(settingsFile, {ErrorCode::invalidArgument, "method",
                                           fmt::format("must be a2vt or thesis to draw the analysis, not {}",
                                                       methodInfo(translation->method).name)});
    constexpr std::uint64_t mostFrames = std::uint64_t{48000} * 3600;
    const auto audio = readAudio(input, {}, mostFrames);
    if (!audio)
        return console.fail(input, audio.error());
    console.warnings(input, audio->warnings);
    const auto mono = monoMix(audio->samples, static_cast<std::size_t>(audio->channels));
    const auto range = rangeWithin(static_cast<double>(mono.size()) / audio->sampleRate);
    if (!range)
        return console.fail(input, range.error());
    return write(console, target,
                 plot::makeAnalysisFigure(mono, audio->sampleRate, *translation,
                                          std::filesystem::path(input).filename().string(), *range, style),
                 style);
}

Exit PlotCommand::write(Console& console, const std::filesystem::path& target, const plot::Figure& figure,
                        const plot::FigureStyle& style) const
{
    const auto written = plot::writeFigure(target, figure, style, replaceable);
    if (!written)
        return console.fail(written.error().where.empty() ? target.string() : "", written.error());
    console.addToReport({{"input", input},
                         {"output", target.string()},
                         {"width", style.size.width},
                         {"height", style.size.height},
                         {"bytes", *written}});
    console.wrote(target, fmt::format("{} x {} pixels, {}", style.size.width, style.size.height,
                                      bytesText(static_cast<double>(*written))));
    return Exit::ok;
}

std::unique_ptr<Command> plotCommand()
{
    return std::make_unique<PlotCommand>();
}

} // namespace pacini::cli
