// Subcommand that reports what standards and guides ask of a measured actuator.

#include "cli/Command.h"
#include "cli/InputFiles.h"
#include "cli/Options.h"
#include "cli/Overwrite.h"
#include "cli/ProfileInput.h"
#include "cli/measure/Recording.h"
#include "cli/plot/ResponseFigure.h"
#include "cli/study/Page.h"
#include "cli/study/StudyFigures.h"
#include "io/AtomicFile.h"
#include "io/FileExtension.h"

#include <pacini/linearize/ActuatorFigures.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

Json bandwidthJson(const Bandwidth& width)
{
    return {{"lowFrequency", width.range.low},
            {"highFrequency", width.range.high},
            {"lowOpen", width.lowOpen},
            {"highOpen", width.highOpen}};
}

Json figuresJson(const ActuatorFigures& figures)
{
    Json json{{"resonance", {{"frequency", figures.resonance.frequency}, {"q", figures.resonance.q}}},
              {"bandwidth3", bandwidthJson(figures.within3)},
              {"bandwidth10", bandwidthJson(figures.within10)}};
    if (figures.edges)
        json["edges"] = {{"rise", figures.edges->rise}, {"fall", figures.edges->fall}};
    json["strongest"] = {{"frequency", figures.strongestFrequency}};
    if (figures.strongest)
        json["strongest"]["acceleration"] = *figures.strongest;
    if (figures.perVolt)
        json["strongest"]["perVolt"] = *figures.perVolt;
    json["drive"] = figures.drive;
    json["distortion"] = {{"largest", figures.distortion}, {"atResonance", figures.distortionAtResonance}};
    json["harmonics"] = Json::array();
    for (const HarmonicPeak& peak : figures.harmonics)
        json["harmonics"].push_back({{"order", peak.order}, {"level", peak.level}, {"frequency", peak.frequency}});
    json["noise"] = {{"atResonance", figures.noiseAtResonance}, {"least", figures.noiseAtWorst}};
    if (figures.worn)
        json["worn"] = {
            {"resonance", {{"frequency", figures.worn->resonance.frequency}, {"q", figures.worn->resonance.q}}},
            {"atResonance", figures.worn->atResonance},
            {"atStrongest", figures.worn->atStrongest},
            {"mean", figures.worn->mean}};
    return json;
}

std::string bandwidthText(const Bandwidth& width)
{
    return fmt::format("{}{:.1f} to {:.1f} Hz{}", width.lowOpen ? "below " : "", width.range.low, width.range.high,
                       width.highOpen ? " and above" : "");
}

/// A figure as people read it: its name, its value, and which public text names it.
using Row = std::vector<std::string>;

std::string distortionText(double percent, double drive)
{
    return percent > 0.0 ? fmt::format("{:.3g} % at {} dB", percent, decimalText(drive, 1))
                         : fmt::format("not above the noise at {} dB", decimalText(drive, 1));
}

std::vector<Row> rowsOf(const ActuatorFigures& figures, const std::string& wornWith)
{
    constexpr const char* speed = "Immersion, IEEE 1918.1.1, thesis";
    constexpr const char* sheets = "data sheets";
    std::vector<Row> rows;
    const auto row = [&](const char* name, std::string value, const char* by)
    {
        rows.push_back({name, std::move(value), by});
    };
    const auto milliseconds = [&](double BurstEdges::*edge)
    {
        return figures.edges ? fmt::format("{:.2f} ms", 1e3 * (*figures.edges).*edge) : std::string("not measured");
    };
    row("Resonance", fmt::format("{:.2f} Hz, Q {:.2f}", figures.resonance.frequency, figures.resonance.q),
        "data sheets, thesis");
    row("Bandwidth within 3 dB", bandwidthText(figures.within3), "Immersion, thesis");
    row("Bandwidth within 10 dB", bandwidthText(figures.within10), "Immersion, thesis");
    row("Rise, 10 to 90 %", milliseconds(&BurstEdges::rise), speed);
    row("Fall, 90 to 10 %", milliseconds(&BurstEdges::fall), speed);
    constexpr const char* relative = "not known without --full-scale";
    const auto acceleration = [](double value)
    {
        return fmt::format("{:.4g} m/s\u00b2 ({:.3g} g)", value, value / standardGravity);
    };
    row("Strongest frequency", fmt::format("{:.1f} Hz", figures.strongestFrequency), sheets);
    row("Acceleration at full drive", figures.strongest ? acceleration(*figures.strongest) : relative,
        "IEEE 1918.1.1, data sheets");
    row("Acceleration at 1 V",
        !figures.strongest ? relative
        : figures.perVolt  ? acceleration(*figures.perVolt)
                           : "not known without --volts",
        sheets);
    row("Distortion at the resonance", distortionText(figures.distortionAtResonance, figures.drive), "thesis");
    row("Largest distortion within 10 dB", distortionText(figures.distortion, figures.drive), "thesis");
    row("Noise at the resonance", fmt::format("{} dB", decimalText(-figures.noiseAtResonance, 1)), "IEEE 1918.1.1");
    row("Largest noise within 10 dB", fmt::format("{} dB", decimalText(-figures.noiseAtWorst, 1)), "IEEE 1918.1.1");
    if (!figures.worn)
    {
        row("Drop with worn mass", "not known without --worn", "thesis");
        return rows;
    }
    row("Worn with", wornWith, "thesis");
    row("Resonance, worn",
        fmt::format("{:.2f} Hz, Q {:.2f}", figures.worn->resonance.frequency, figures.worn->resonance.q), "thesis");
    row("Drop at the free resonance", fmt::format("{} dB", decimalText(figures.worn->atResonance, 2)), "thesis");
    row("Drop of the strongest level", fmt::format("{} dB", decimalText(figures.worn->atStrongest, 2)), "thesis");
    row("Mean drop within 10 dB", fmt::format("{} dB", decimalText(figures.worn->mean, 2)), "thesis");
    return rows;
}

/// What is known of the documents without buying or asking for them.
void addDocuments(Page& page)
{
    const auto paragraph = [&](const char* text)
    {
        page.parts.emplace_back(PageParagraph{text});
    };
    page.parts.emplace_back(PageHeading{2, "What the documents ask, as far as it is public"});
    paragraph("ISO 9241-910:2011 is a framework of terms, ISO 9241-940:2017 a guide to methods by which haptic devices "
              "are evaluated. Their abstracts are public, their clauses are not; the abstracts name no figure.");
    paragraph("IEEE 1918.1.1 (haptic codecs for the tactile internet) has devices exchange what they can: amplitude "
              "range, temporal and spatial resolution by its public scope. Its clauses are not public.");
    paragraph("VT-1 (Lofelt, 2019) was a proposal of parameters and requirements for realistic vibrotactile feedback; "
              "its text is not public any more.");
    paragraph("Immersion's HD Actuator Selection and Testing Guide grades actuators by frequency range and by how fast "
              "they accelerate. It is given on request; its tests and grades are not public.");
    paragraph(
        "Data sheets of actuators have resonance, rise, fall, and acceleration at a voltage, often with a mass of "
        "100 g. The thesis (Weber 2020, ch. 3) adds bandwidth, distortion and what a wearer does.");
    paragraph("No limit of any of these is public, so that figures are reported and none is judged.");
}

void addMethods(Page& page)
{
    const auto paragraph = [&](const char* text)
    {
        page.parts.emplace_back(PageParagraph{text});
    };
    page.parts.emplace_back(PageHeading{2, "How each figure is taken"});
    paragraph("Swept sines at one or more levels, the root of the sum of squares of all axes, averaged over the "
              "recordings without outliers. Resonance and Q are those of the second-order model that fits the "
              "response best.");
    paragraph("Bandwidths lie around the strongest frequency. An end that was not reached by the sweep is told.");
    paragraph("Rise and fall are those of the envelope of a burst at the resonance, computed from the impulse "
              "response. The rise and fall of a profile are others: from rest to 90 %, and from the end to 10 %.");
    paragraph("Acceleration at 1 V is peak for peak and RMS for RMS, at the strongest frequency.");
    paragraph("Distortion is the sum of all harmonics over the fundamental, noise what would be measured without a "
              "drive, relative to the response; both belong to the loudest sweep.");
    paragraph("The drop is the level without the mass less the level with it, so that a gain is negative.");
}

/// `pacini measure report`: the figures of an actuator by which others compare it.
struct ReportSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    /// How the command ends before anything is read, if it does.
    [[nodiscard]] std::optional<Exit> checkOptions(Console& console, const RecordingOptions& loaded) const;
    /// The peak at full drive, V, if it is known.
    [[nodiscard]] std::optional<double> voltage(const std::optional<Profile>& actuator) const;
    [[nodiscard]] Result<Page> page(const AnalysedRecordings& free, const std::optional<AnalysedRecordings>& worn,
                                    const ActuatorFigures& figures) const;
    [[nodiscard]] std::string wornWith() const;

    RecordingOptions options;
    std::vector<std::string> worn;
    std::string output, profile, name;
    std::optional<double> volts, mass;
    OverwriteOptions overwriting;
};
} // namespace

CLI::App* ReportSubcommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("report", "Report what standards and guides ask of a measured actuator");
    options.declare(*command);
    addOption(*command, "-o,--output", output, "Report to write: a page (.html) or figures (.json)", "OUT")->required();
    addOption(*command, "--volts", volts, "Peak voltage at full drive, V [that of --profile, if it has one]",
              numberFrom(1e-3, 1e4), "V");
    addOption(*command, "--profile", profile, "Profile of the actuator, for its voltage and its name", "PROFILE");
    addOption(*command, "--worn", worn, "Recordings of the same sweep with a mass on the actuator, or worn",
              "RECORDING");
    addOption(*command, "--mass", mass, "The mass of --worn, g, for the text of the report", numberFrom(0.0, 1e6), "G");
    addOption(*command, "--name", name, "Name of the actuator in the report", "NAME");
    overwriting.declare(*command);
    return command->footer(
        "Examples:\n  pacini measure report rec.wav --sweep sweep.json --full-scale 5g -o report.html\n"
        "  pacini measure report rec.wav --sweep sweep.json --full-scale 5g --volts 2.8 --worn "
        "heavy.wav --mass 100 -o report.html");
}

std::optional<double> ReportSubcommand::voltage(const std::optional<Profile>& actuator) const
{
    if (volts)
        return volts;
    if (actuator && actuator->drive.maxVoltageRms)
        return std::numbers::sqrt2 * *actuator->drive.maxVoltageRms * actuator->drive.overdrive;
    return std::nullopt;
}

std::string ReportSubcommand::wornWith() const
{
    return mass ? fmt::format("{:g} g", *mass)
                : fmt::format("{} recording{}", worn.size(), worn.size() == 1 ? "" : "s");
}

Result<Page> ReportSubcommand::page(const AnalysedRecordings& free, const std::optional<AnalysedRecordings>& loaded,
                                    const ActuatorFigures& figures) const
{
    Page page;
    page.title = name.empty() ? "Measured actuator" : name;
    page.parts.emplace_back(PageHeading{1, page.title});
    page.parts.emplace_back(PageParagraph{
        fmt::format("{} recording{} of swept sines from {:g} to {:g} Hz, the loudest at {} dB of full drive.",
                    free.recordings.size(), free.recordings.size() == 1 ? "" : "s", free.sweep.sweep.lowFrequency,
                    free.sweep.sweep.highFrequency, decimalText(figures.drive, 1))});
    page.parts.emplace_back(PageTable{"", {"Figure", "Value", "Named in public by"}, rowsOf(figures, wornWith())});
    if (!figures.harmonics.empty())
    {
        PageTable table{"Strongest harmonics within the felt range", {"Order", "Level, dB", "At, Hz"}, {}};
        for (const HarmonicPeak& peak : figures.harmonics)
            table.rows.push_back(
                {fmt::format("{}", peak.order), decimalText(peak.level, 1), fmt::format("{:.0f}", peak.frequency)});
        page.parts.emplace_back(std::move(table));
    }
    plot::ResponseFigureContent content;
    content.title = page.title;
    content.absolute = options.isCalibrated();
    content.subtitle = content.absolute ? "dB re 1 m/s\u00b2 at full drive" : "dB at full drive, relative";
    content.lowFrequency = figures.within10.range.low;
    content.highFrequency = figures.within10.range.high;
    const SweepMeasurement& first = free.recordings.front().measurement;
    const LevelMeasurement& level = first.levels[first.main];
    content.responses.push_back({"noise", level.noise, plot::ResponseRole::noise});
    if (loaded)
        content.responses.push_back({"worn", loaded->average.response, plot::ResponseRole::flattened});
    content.responses.push_back({"response", free.average.response});
    content.distortion = plot::NamedResponse{"all harmonics", {level.response.frequency, level.distortion}};
    const plot::FigureStyle style;
    auto svg = svgOf(makeResponseFigure(content, style), style);
    if (!svg)
        return svg.error();
    page.parts.emplace_back(PagePicture{"response.svg", "Response, noise and distortion over frequency", *svg});
    addDocuments(page);
    addMethods(page);
    return page;
}

std::optional<Exit> ReportSubcommand::checkOptions(Console& console, const RecordingOptions& loaded) const
{
    const std::string extension = lowerExtension(output);
    if (extension != ".html" && extension != ".json")
        return console.fail(output, {ErrorCode::invalidArgument, "", "must have the extension .html or .json"},
                            Exit::usage);
    for (const RecordingOptions* inputs : {&options, &loaded})
        if (const auto wrong = overwrittenInput(*inputs, {output}))
            return console.fail(wrong->first, wrong->second, Exit::usage);
    if (mass && worn.empty())
        return console.fail("", {ErrorCode::invalidArgument, "--mass", "needs --worn, the recordings with that mass"},
                            Exit::usage);
    if (overwriting.keeps(console, {output}))
        return Exit::ok;
    return {};
}

Exit ReportSubcommand::run(Console& console)
{
    RecordingOptions loaded = options;
    loaded.recordings = worn;
    if (const auto ended = checkOptions(console, loaded))
        return *ended;
    std::optional<Profile> actuator;
    if (!profile.empty())
    {
        actuator = openProfile(console, profile);
        if (!actuator)
            return Exit::failed;
        if (name.empty())
            name = actuator->name;
    }

    const auto free = analyseRecordings(console, options);
    if (!free)
        return Exit::failed;
    if (!free->sweep.equalizedFor.empty())
        console.warning(options.sweep, fmt::format("was played through the equaliser of '{}', so these figures "
                                                   "include the equaliser",
                                                   free->sweep.equalizedFor));
    std::optional<AnalysedRecordings> heavy;
    if (!worn.empty())
    {
        heavy = analyseRecordings(console, loaded);
        if (!heavy)
            return Exit::failed;
    }

    std::vector<const SweepMeasurement*> placements;
    for (const AnalysedRecording& recording : free->recordings)
        placements.push_back(&recording.measurement);
    constexpr double distortionLimit = 10.0; // %, of a drive that is not reported
    const auto findings = findingsOf(placements, free->average, options.smoothingOctaves(), distortionLimit);
    if (!findings)
        return console.fail("", findings.error());
    ActuatorFigures figures =
        actuatorFigures(placements, free->average, *findings, voltage(actuator), options.isCalibrated());
    if (heavy)
    {
        const auto drop =
            wornDrop(figures, free->average.response, heavy->average.response, options.smoothingOctaves());
        if (!drop)
            return console.fail(worn.front(), drop.error());
        figures.worn = *drop;
    }

    Json json{{"output", output}, {"recordings", options.recordings}};
    if (heavy)
        json["wornRecordings"] = worn;
    if (mass)
        json["mass"] = *mass;
    if (const auto peak = voltage(actuator))
        json["volts"] = *peak;
    json.update(figuresJson(figures));
    std::string text;
    if (lowerExtension(output) == ".json")
        text = json.dump(2) + "\n";
    else
    {
        const auto made = page(*free, heavy, figures);
        if (!made)
            return console.fail(output, made.error());
        text = htmlOf(*made);
    }
    if (const auto written = writeFileAtomically(output, text); !written)
        return console.fail(output, written.error());
    console.addToReport(json);
    for (const Row& row : rowsOf(figures, wornWith()))
        console.print(fmt::format("{}: {}", row[0], row[1]));
    console.wrote(output);
    return Exit::ok;
}

std::unique_ptr<Command> reportSubcommand()
{
    return std::make_unique<ReportSubcommand>();
}

} // namespace pacini::cli
