// Subcommand that analyses recordings of sweeps.

#include "cli/Command.h"
#include "cli/InputFiles.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/ProfileInput.h"
#include "cli/measure/Recording.h"
#include "cli/plot/ResponseFigure.h"
#include "io/AtomicFile.h"
#include "io/AudioWriter.h"
#include "io/FileExtension.h"
#include "io/Overwrite.h"
#include "io/ProfileFile.h"
#include "io/ResponseTable.h"

#include <pacini/linearize/MeasuredProfile.h>
#include <pacini/linearize/MeasurementFindings.h>
#include <pacini/linearize/ResponseFeatures.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

constexpr std::size_t mostImpulses = 64; // channels of a WAV

/// What all recordings together say of the actuator.
Result<MeasurementFindings> findingsOf(const AnalysedRecordings& analysed, double smoothing, double distortionLimit)
{
    std::vector<const SweepMeasurement*> placements;
    for (const AnalysedRecording& recording : analysed.recordings)
        placements.push_back(&recording.measurement);
    return pacini::findingsOf(placements, analysed.average, smoothing, distortionLimit);
}

std::string table(const AnalysedRecordings& analysed)
{
    const FrequencyResponse& response = analysed.average.response;
    std::vector<TableColumn> columns{{"frequency", response.frequency}, {"dB", response.level}};
    const auto add = [&](std::string name, std::vector<double> values)
    {
        values.resize(response.size(), std::numeric_limits<double>::quiet_NaN());
        columns.push_back({std::move(name), std::move(values)});
    };
    if (analysed.recordings.size() > 1)
        add("spread dB", analysed.average.spread);
    for (std::size_t i = 0; i < analysed.recordings.size(); ++i)
    {
        const SweepMeasurement& measured = analysed.recordings[i].measurement;
        const LevelMeasurement& level = measured.levels[measured.main];
        const std::string number = analysed.recordings.size() > 1 ? fmt::format(" {}", i + 1) : "";
        if (analysed.recordings.size() > 1)
            add("dB" + number, level.response.level);
        add("SNR dB" + number, level.snr.level);
        add("distortion %" + number, level.distortion);
        for (const HarmonicResponse& harmonic : level.harmonics)
            add(fmt::format("order {} dB{}", harmonic.order, number), harmonic.response.level);
        auto delay = measured.groupDelay;
        for (double& seconds : delay)
            seconds *= 1e3;
        add("group delay ms" + number, std::move(delay));
    }
    return tableText(columns);
}

Json report(const AnalysedRecordings& analysed, const MeasurementFindings& findings, const std::string& output)
{
    Json recordings = Json::array();
    Json outliers = Json::array();
    for (std::size_t i = 0; i < analysed.recordings.size(); ++i)
    {
        const AnalysedRecording& recording = analysed.recordings[i];
        Json warnings = Json::array();
        for (const MeasurementWarning& warning : recording.measurement.warnings)
            warnings.push_back({{"where", warning.where}, {"message", warning.message}});
        Json entry{{"input", recording.file}, {"latency", recording.measurement.latency}};
        if (recording.measurement.driftPpm)
            entry["driftPpm"] = *recording.measurement.driftPpm;
        entry["offset"] = analysed.average.offsets[i];
        entry["warnings"] = std::move(warnings);
        recordings.push_back(std::move(entry));
    }
    for (const PlacementOutlier& outlier : analysed.average.outliers)
        outliers.push_back(
            {{"input", analysed.recordings[outlier.index].file}, {"offset", outlier.offset}, {"shape", outlier.shape}});
    const ResponseFeatures& features = findings.features;
    Json json{{"output", output},
              {"resonance", {{"frequency", features.resonance.frequency}, {"q", features.resonance.q}}},
              {"plateau", features.plateau},
              {"even", {{"lowFrequency", features.even.low}, {"highFrequency", features.even.high}}},
              {"felt", {{"lowFrequency", features.felt.low}, {"highFrequency", features.felt.high}}}};
    if (findings.times)
        json["response"] = {{"riseTime", findings.times->riseTime}, {"fallTime", findings.times->fallTime}};
    json["groupDelay"] = findings.groupDelay;
    json["distortion"] = findings.distortion;
    json["harmonics"] = Json::array();
    for (const HarmonicPeak& peak : findings.harmonics)
        json["harmonics"].push_back({{"order", peak.order}, {"level", peak.level}, {"frequency", peak.frequency}});
    if (findings.distortionDrive)
        json["distortionDrive"] = *findings.distortionDrive;
    json["outliers"] = std::move(outliers);
    json["recordings"] = std::move(recordings);
    return json;
}

std::string text(const AnalysedRecordings& analysed, const MeasurementFindings& findings, double distortionLimit)
{
    const ResponseFeatures& features = findings.features;
    std::string lines =
        fmt::format("{} recording{}{}: resonance {:.2f} Hz, Q {:.2f}; plateau {} dB; felt from {:.0f} to {:.0f} "
                    "Hz, even within "
                    "3 dB from {:.0f} to {:.0f} Hz",
                    analysed.recordings.size(), analysed.recordings.size() == 1 ? "" : "s",
                    findings.outliers.empty() ? "" : fmt::format(", {} of them left out", findings.outliers.size()),
                    features.resonance.frequency, features.resonance.q, decimalText(features.plateau, 1),
                    features.felt.low, features.felt.high, features.even.low, features.even.high);
    if (findings.times)
        lines += fmt::format("\n  rises in {:.1f} ms, falls in {:.1f} ms", 1e3 * findings.times->riseTime,
                             1e3 * findings.times->fallTime);
    lines += fmt::format("\n  group delay {} ms at the resonance", decimalText(1e3 * findings.groupDelay, 1));
    lines += fmt::format(
        "\n  distortion at most {:.2g} % at {} dB", findings.distortion,
        decimalText(*std::max_element(analysed.sweep.sweep.levels.begin(), analysed.sweep.sweep.levels.end()), 1));
    if (findings.distortionDrive)
        lines += fmt::format(", passes {:.3g} % at {} dB", distortionLimit, decimalText(*findings.distortionDrive, 1));
    if (!findings.harmonics.empty())
    {
        lines += "\n  by order, re the fundamental:";
        for (const HarmonicPeak& peak : findings.harmonics)
            lines += fmt::format("{} {} {} dB at {:.0f} Hz", &peak == findings.harmonics.data() ? "" : ",", peak.order,
                                 decimalText(peak.level, 1), peak.frequency);
    }
    for (const AnalysedRecording& recording : analysed.recordings)
        lines += fmt::format("\n  {}: latency {} ms{}", printable(recording.file),
                             decimalText(1e3 * recording.measurement.latency, 2),
                             recording.measurement.driftPpm
                                 ? fmt::format(", clock {} ppm", signedText(*recording.measurement.driftPpm, 1))
                                 : "");
    return lines;
}

/// `pacini measure analyse`: computes the response of an actuator from recordings of a sweep.
struct AnalyseSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    /// Writes the impulse responses, a channel each; returns what the report says of them. Errors as in writeAudio().
    Result<Json> writeImpulses(const AnalysedRecordings& analysed) const;
    Result<std::size_t> drawPicture(const AnalysedRecordings& analysed, const ResponseFeatures& features) const;

    RecordingOptions options;
    std::string output;
    std::string base;
    std::string name;
    std::string picture;
    std::string impulse;
    double distortionLimit = 10.0;
    OverwriteOptions overwriting;
};
} // namespace

CLI::App* AnalyseSubcommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("analyse", "Compute the response of an actuator from recordings of a sweep");
    options.declare(*command);
    addOption(*command, "-o,--output", output, "Profile (.json) or table (.csv) to write", "OUT");
    addOption(*command, "--profile", base, "Profile with the unmeasured values, such as drive limits", "PROFILE");
    addOption(*command, "--name", name, "Name of the profile to write", "NAME");
    addOption(*command, "--plot", picture,
              "Picture of all responses, the distortion by order and the group delay (.png, .svg or .pdf)", "PICTURE");
    addOption(*command, "--impulse", impulse,
              "Impulse responses to write (.wav), a channel for each recording, m/s\u00b2 at full drive", "OUT.wav");
    addPreset(*command, "--distortion-limit", distortionLimit, "Distortion whose drive level is reported, %",
              numberFrom(0.01, 100.0), "%");
    overwriting.declare(*command);
    return command->footer(
        "Examples:\n  pacini measure analyse rec.wav --sweep sweep.json --full-scale 5g -o mine.json\n"
        "  pacini measure analyse rec-*.wav --sweep sweep.json --channels 1,2,3 -o response.csv --plot r.png\n"
        "  pacini measure analyse rec.wav --sweep sweep.json --impulse impulse.wav");
}

Exit AnalyseSubcommand::run(Console& console)
{
    const std::string extension = lowerExtension(output);
    if (!output.empty() && extension != ".json" && extension != ".csv")
        return console.fail(output, {ErrorCode::invalidArgument, "", "must have the extension .json or .csv"},
                            Exit::usage);
    if (!picture.empty() && !plot::pictureFormatOf(picture))
        return console.fail(
            picture, {ErrorCode::invalidArgument, "--plot", "must have the extension .png, .svg or .pdf"}, Exit::usage);
    if (!impulse.empty() && lowerExtension(impulse) != ".wav")
        return console.fail(impulse, {ErrorCode::invalidArgument, "--impulse", "must have the extension .wav"},
                            Exit::usage);
    if (!impulse.empty() && options.recordings.size() > mostImpulses)
        return console.fail(impulse,
                            {ErrorCode::invalidArgument, "--impulse",
                             fmt::format("holds {} recordings at most; write them in groups", mostImpulses)},
                            Exit::usage);
    if (const auto wrong = overwrittenInput(options, {output, picture, impulse}))
        return console.fail(wrong->first, wrong->second, Exit::usage);
    if (overwriting.keeps(console, {output, picture, impulse}))
        return Exit::ok;
    Profile profile;
    profile.technology = Technology::vca;
    profile.name = output.empty() ? "" : std::filesystem::path(output).stem().string();
    if (!base.empty())
    {
        auto opened = openProfile(console, base);
        if (!opened)
            return Exit::failed;
        profile = std::move(*opened);
    }
    if (!name.empty())
        renameProfile(profile, name);

    const auto analysed = analyseRecordings(console, options);
    if (!analysed)
        return Exit::failed;
    if (!analysed->sweep.equalizedFor.empty())
        console.warning(options.sweep, fmt::format("was played through the equaliser of '{}', so this response "
                                                   "includes the equaliser; check it with 'pacini measure verify'",
                                                   analysed->sweep.equalizedFor));
    const auto findings = findingsOf(*analysed, options.smoothingOctaves(), distortionLimit);
    if (!findings)
        return console.fail("", findings.error());

    if (extension == ".json")
    {
        const auto& levels = analysed->sweep.sweep.levels;
        setMeasurement(profile, analysed->average.response, *findings, analysed->recordings.size(),
                       *std::max_element(levels.begin(), levels.end()), options.isCalibrated());
        if (const auto written = writeProfile(output, profile); !written)
            return console.fail(output, written.error());
    }
    else if (extension == ".csv")
        if (const auto written = writeFileAtomically(output, table(*analysed)); !written)
            return console.fail(output, written.error());
    if (!picture.empty())
        if (const auto drawn = drawPicture(*analysed, findings->features); !drawn)
            return console.fail(picture, drawn.error());

    Json json = report(*analysed, *findings, output);
    if (!impulse.empty())
    {
        auto written = writeImpulses(*analysed);
        if (!written)
            return console.fail(impulse, written.error());
        json["impulse"] = std::move(*written);
    }
    console.addToReport(json);
    console.print(text(*analysed, *findings, distortionLimit));
    if (!output.empty())
        console.wrote(output);
    if (!picture.empty())
        console.wrote(picture);
    if (!impulse.empty())
        console.wrote(impulse);
    return Exit::ok;
}

Result<Json> AnalyseSubcommand::writeImpulses(const AnalysedRecordings& analysed) const
{
    std::size_t before = 0; // samples of the longest before the arrival
    std::size_t after = 0;
    for (const AnalysedRecording& recording : analysed.recordings)
    {
        const ImpulseResponse& response = recording.measurement.impulseResponse;
        before = std::max(before, response.origin);
        after = std::max(after, response.samples.size() - response.origin);
    }
    const double rate = analysed.recordings.front().measurement.impulseResponse.sampleRate;
    const std::size_t channels = analysed.recordings.size();
    std::vector<float> interleaved((before + after) * channels, 0.0f);
    for (std::size_t c = 0; c < channels; ++c)
    {
        const ImpulseResponse& response = analysed.recordings[c].measurement.impulseResponse;
        if (response.sampleRate != rate)
            return Error{ErrorCode::invalidArgument, "--impulse",
                         "holds recordings of one sample rate; write those of other rates by themselves"};
        for (std::size_t i = 0; i < response.samples.size(); ++i)
            interleaved[(before - response.origin + i) * channels + c] = static_cast<float>(response.samples[i]);
    }
    AudioWriteParams params;
    params.sampleRate = static_cast<int>(rate);
    params.channels = static_cast<int>(channels);
    params.markers = {{static_cast<double>(before) / rate, "arrival"}};
    if (const auto written = writeAudio(impulse, interleaved, params); !written)
        return written.error();
    return Json{{"output", impulse}, {"sampleRate", rate}, {"arrival", static_cast<double>(before) / rate}};
}

Result<std::size_t> AnalyseSubcommand::drawPicture(const AnalysedRecordings& analysed,
                                                   const ResponseFeatures& features) const
{
    plot::ResponseFigureContent content;
    content.title = !name.empty()    ? name
                    : output.empty() ? "Measured response"
                                     : std::filesystem::path(output).stem().string();
    content.absolute = options.isCalibrated();
    content.subtitle = fmt::format("resonance {:.1f} Hz, Q {:.2f}", features.resonance.frequency, features.resonance.q);
    content.lowFrequency = features.felt.low;
    content.highFrequency = features.felt.high;
    const bool several = analysed.recordings.size() > 1;
    for (std::size_t i = 0; i < analysed.recordings.size() && several; ++i)
    {
        const auto& outliers = analysed.average.outliers;
        const bool out = std::any_of(outliers.begin(), outliers.end(),
                                     [i](const PlacementOutlier& outlier) { return outlier.index == i; });
        content.responses.push_back({out ? "left out" : "placements", analysed.recordings[i].measurement.response(),
                                     out ? plot::ResponseRole::outlier : plot::ResponseRole::placement});
    }
    const SweepMeasurement& first = analysed.recordings.front().measurement;
    const LevelMeasurement& level = first.levels[first.main];
    content.responses.push_back({"noise", level.noise, plot::ResponseRole::noise});
    content.responses.push_back({several ? "average" : "response", analysed.average.response});
    content.distortion = plot::NamedResponse{"all harmonics", {level.response.frequency, level.distortion}};
    for (const HarmonicResponse& harmonic : level.harmonics)
    {
        plot::NamedResponse percent{fmt::format("order {}", harmonic.order), harmonic.response};
        for (double& value : percent.response.level)
            value = 100.0 * Decibels(value).gain();
        content.harmonics.push_back(std::move(percent));
    }
    plot::NamedResponse delay{several ? "first recording" : "response", {level.response.frequency, first.groupDelay}};
    for (double& value : delay.response.level)
        value *= 1e3;
    content.groupDelay = std::move(delay);
    const plot::FigureStyle style;
    return plot::writeFigure(picture, makeResponseFigure(content, style), style);
}

std::unique_ptr<Command> analyseSubcommand()
{
    return std::make_unique<AnalyseSubcommand>();
}

} // namespace pacini::cli
