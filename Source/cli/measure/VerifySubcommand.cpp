// Subcommand that verifies an equaliser by a sweep through it.

#include "cli/Command.h"
#include "cli/Options.h"
#include "cli/measure/Recording.h"
#include "cli/plot/ResponseFigure.h"
#include "io/ProfileFile.h"

#include <pacini/linearize/MeasuredProfile.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

Json outlierJson(const LinearityOutlier& outlier)
{
    return {{"lowFrequency", outlier.lowFrequency},
            {"highFrequency", outlier.highFrequency},
            {"deviation", outlier.deviation}};
}

Json linearityJson(const Linearity& linearity)
{
    Json outliers = Json::array();
    for (const LinearityOutlier& outlier : linearity.outliers)
        outliers.push_back(outlierJson(outlier));
    return {{"passed", linearity.passed()},
            {"lowFrequency", linearity.lowFrequency},
            {"highFrequency", linearity.highFrequency},
            {"tolerance", linearity.tolerance},
            {"level", linearity.level},
            {"meanDeviation", linearity.meanDeviation},
            {"standardDeviation", linearity.standardDeviation},
            {"worstDeviation", linearity.worstDeviation},
            {"worstFrequency", linearity.worstFrequency},
            {"outliers", std::move(outliers)}};
}

std::string linearityText(const Linearity& linearity)
{
    std::string text =
        fmt::format("mean deviation {:.2f} dB, SD {:.2f} dB, worst {} dB at {:.0f} Hz, from {:.0f} to {:.0f} Hz",
                    linearity.meanDeviation, linearity.standardDeviation, signedText(linearity.worstDeviation, 2),
                    linearity.worstFrequency, linearity.lowFrequency, linearity.highFrequency);
    for (const LinearityOutlier& outlier : linearity.outliers)
        text += fmt::format("\n  {:.0f} to {:.0f} Hz: {} dB", outlier.lowFrequency, outlier.highFrequency,
                            signedText(outlier.deviation, 2));
    return text;
}

/// `pacini measure verify`: whether an actuator is flat through its equaliser.
struct VerifySubcommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    [[nodiscard]] Result<std::size_t> drawPicture(const Profile& actuator, const AnalysedRecordings& analysed,
                                                  const LinearityParams& params, const Linearity& linearity) const;

    RecordingOptions options;
    std::string profile;
    std::string output;
    std::string picture;
    std::optional<double> low;
    std::optional<double> high;
    double tolerance = 4.0;
};
} // namespace

CLI::App* VerifySubcommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("verify", "Verify that an actuator is flat with its equaliser");
    options.declare(*command);
    addOption(*command, "--profile", profile, "Profile with the equaliser of the sweep; the result is written into it",
              "PROFILE.json")
        ->required();
    addOption(*command, "-o,--output", output, "Profile to write instead", "PROFILE.json");
    addOption(*command, "--plot", picture, "Picture of the response before and after (.png, .svg or .pdf)", "PICTURE");
    addPreset(*command, "--tolerance", tolerance, "Allowed deviation from the mean, dB to both sides",
              numberFrom(0.0, 100.0), "DB");
    addOption(*command, "--low", low, "Start of the range to verify, Hz [that of the profile]",
              numberFrom(0.1, 200000.0), "HZ");
    addOption(*command, "--high", high, "End of the range to verify, Hz [that of the profile]",
              numberFrom(0.1, 200000.0), "HZ");
    return command->footer("Exits with 1 when the actuator is not flat.\nExamples:\n"
                           "  pacini measure verify after.wav --sweep flat.json --full-scale 5g --profile mine.json");
}

Exit VerifySubcommand::run(Console& console)
{
    if (!picture.empty() && !plot::pictureFormatOf(picture))
        return console.fail(
            picture, {ErrorCode::invalidArgument, "--plot", "must have the extension .png, .svg or .pdf"}, Exit::usage);
    ReadWarnings warnings(console.isStrict());
    auto actuator = readProfile(profile, &warnings);
    if (!actuator)
        return console.fail(profile, actuator.error());
    console.warnings(profile, warnings.texts());
    if (actuator->equalizer.empty())
        return console.fail(profile, {ErrorCode::invalidData, "equalizer",
                                      "is empty, so there is nothing to verify; fit one with 'pacini measure fit'"});
    const auto analysed = analyseRecordings(console, options);
    if (!analysed)
        return Exit::failed;
    if (analysed->sweep.equalizedFor.empty())
        return console.fail(
            options.sweep,
            {ErrorCode::invalidData, "equalizedFor",
             "is missing: this sweep was made without an equaliser; make one with 'pacini measure sweep --profile'"});
    if (analysed->sweep.equalizedFor != actuator->name)
        console.warning(options.sweep, fmt::format("was played through the equaliser of '{}', not of '{}'",
                                                   analysed->sweep.equalizedFor, actuator->name));

    const FrequencyResponse& after = analysed->average.response;
    const LinearityParams params{low.value_or(actuator->range.lowFrequency),
                                 high.value_or(actuator->range.highFrequency), tolerance};
    const auto linearity = judgeLinearity(after, params);
    if (!linearity)
        return console.fail(profile, linearity.error());
    setVerification(*actuator, after, *linearity);
    const std::string target = output.empty() ? profile : output;
    if (const auto written = writeProfile(target, *actuator); !written)
        return console.fail(target, written.error());
    console.wrote(target);

    if (!picture.empty())
    {
        if (const auto drawn = drawPicture(*actuator, *analysed, params, *linearity); !drawn)
            return console.fail(picture, drawn.error());
        console.wrote(picture);
    }

    Json each = Json::array();
    for (const AnalysedRecording& recording : analysed->recordings)
        if (const auto one = judgeLinearity(recording.measurement.response(), params))
            each.push_back({{"input", recording.file},
                            {"meanDeviation", one->meanDeviation},
                            {"worstDeviation", one->worstDeviation},
                            {"worstFrequency", one->worstFrequency}});
    Json report{{"profile", target}};
    report.update(linearityJson(*linearity));
    report["recordings"] = std::move(each);
    console.addToReport(report);
    console.print(fmt::format("{}: {} within \u00b1{:.3g} dB: {}", printable(target),
                              linearity->passed() ? "PASS" : "FAIL", tolerance, linearityText(*linearity)));
    if (linearity->passed())
        return Exit::ok;
    return console.fail(target,
                        {ErrorCode::invalidData, "", fmt::format("is not flat within \u00b1{:.3g} dB", tolerance)});
}

Result<std::size_t> VerifySubcommand::drawPicture(const Profile& actuator, const AnalysedRecordings& analysed,
                                                  const LinearityParams& params, const Linearity& linearity) const
{
    plot::ResponseFigureContent content;
    content.title = actuator.name;
    content.absolute = options.isCalibrated();
    content.subtitle = fmt::format("{}: {:.2f} dB mean deviation, {} dB at most, tolerance \u00b1{:.3g} dB",
                                   linearity.passed() ? "flat" : "not flat", linearity.meanDeviation,
                                   signedText(linearity.worstDeviation, 2), tolerance);
    content.equalizer = actuator.equalizer;
    content.sampleRate = analysed.sweep.sweep.sampleRate;
    content.lowFrequency = params.lowFrequency;
    content.highFrequency = params.highFrequency;
    content.linearity = linearity;
    for (const AnalysedRecording& recording : analysed.recordings)
        if (analysed.recordings.size() > 1)
            content.responses.push_back({fmt::format("{} placements", analysed.recordings.size()),
                                         recording.measurement.response(), plot::ResponseRole::placement});
    if (!actuator.measurement->points.empty())
        content.responses.push_back({"before", measuredResponse(*actuator.measurement), plot::ResponseRole::measured});
    content.responses.push_back({"with the equaliser", analysed.average.response, plot::ResponseRole::flattened});
    const plot::FigureStyle style;
    return plot::writeFigure(picture, makeResponseFigure(content, style), style);
}

std::unique_ptr<Command> verifySubcommand()
{
    return std::make_unique<VerifySubcommand>();
}

} // namespace pacini::cli
