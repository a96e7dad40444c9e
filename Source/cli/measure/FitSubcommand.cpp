// Subcommand that fits an equaliser to a measured response.

#include "cli/Command.h"
#include "cli/Options.h"
#include "cli/ProfileInput.h"
#include "cli/plot/ResponseFigure.h"
#include "io/ProfileFields.h"
#include "io/ProfileFile.h"
#include "io/ResponseTable.h"
#include "io/Stopwatch.h"

#include <pacini/foundation/ParseNumber.h>
#include <pacini/foundation/Units.h>
#include <pacini/linearize/EqualizerCost.h>
#include <pacini/linearize/EqualizerFit.h>
#include <pacini/linearize/EqualizerFitParams.h>
#include <pacini/linearize/MeasuredProfile.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

/// The response to flatten, and the profile that receives the equaliser.
struct Fitted
{
    FrequencyResponse response;
    std::optional<Profile> profile;
    bool measured = false; ///< the response came from the profile
};

Result<Fitted> openInput(Console& console, const std::string& input)
{
    ReadWarnings warnings(console.isStrict());
    if (auto profile = profileIn(input, &warnings))
    {
        if (!*profile)
            return profile->error();
        console.warnings(input, warnings.texts());
        if (!(*profile)->measurement || (*profile)->measurement->points.empty())
            return Error{ErrorCode::invalidData, "measurement",
                         "is missing in this profile; 'pacini measure analyse' measures it from recordings"};
        FrequencyResponse response = measuredResponse(*(*profile)->measurement);
        return Fitted{std::move(response), std::move(**profile), true};
    }
    auto response = readResponse(input);
    if (!response)
        return response.error();
    return Fitted{std::move(*response), std::nullopt, false};
}

Json sectionJson(const EqualizerSection& section)
{
    Json json{{"type", nameOf(section.type, profileFields::equalizerTypes)},
              {"frequency", section.frequency},
              {"gain", section.gain},
              {"q", section.q}};
    if (section.type == EqualizerType::highpass)
        json["order"] = section.order;
    return json;
}

std::string sectionText(const EqualizerSection& section)
{
    const auto type = nameOf(section.type, profileFields::equalizerTypes);
    if (section.type == EqualizerType::highpass)
        return fmt::format("  {:<9} {:>8.2f} Hz   order {}", type, section.frequency, section.order);
    return fmt::format("  {:<9} {:>8.2f} Hz  {:>+7.2f} dB   Q {:.3f}", type, section.frequency, section.gain,
                       section.q);
}

/// One fit is over sooner than what disturbs a clock, so the middle of a few counts; they all give the same.
double medianMilliseconds(const FrequencyResponse& response, const EqualizerFitParams& params)
{
    std::array<double, 5> times{};
    for (double& time : times)
    {
        Stopwatch watch;
        watch.run([&] { (void)fitEqualizer(response, params); });
        time = 1e3 * watch.seconds();
    }
    std::nth_element(times.begin(), times.begin() + 2, times.end());
    return times[2];
}

Json costJson(const EqualizerCost& cost)
{
    Json json{{"powerChange", cost.powerChange},
              {"excursionChange", cost.excursionChange},
              {"excursionFrequency", cost.excursionFrequency}};
    if (cost.power)
        json["power"] = *cost.power;
    if (cost.excursion)
        json["excursion"] = *cost.excursion;
    return json;
}

std::string costText(const EqualizerCost& cost)
{
    return fmt::format(
        "  costs {} dB of power in the coil on pink noise{}, {} dB of largest excursion, at "
        "{:.0f} Hz{}",
        signedText(cost.powerChange, 1), cost.power ? fmt::format(" ({:.3g} W at full drive)", *cost.power) : "",
        signedText(cost.excursionChange, 1), cost.excursionFrequency,
        cost.excursion ? fmt::format(" ({:.0f} % of its limit at full drive)", 100.0 * *cost.excursion) : "");
}

/// `pacini measure fit`: the equaliser that flattens a measured response.
struct FitSubcommand : Command
{
    CLI::App* declare(CLI::App& app) override;
    Exit run(Console& console) override;

    [[nodiscard]] EqualizerFitParams paramsFor(const std::optional<Profile>& profile) const;
    Result<std::size_t> drawPicture(const FrequencyResponse& response, const EqualizerFit& fit,
                                    const EqualizerFitParams& params) const;

    std::string input, output, base, picture, sections = "auto";
    double rate = 48000.0, maxBoost = 12.0, goal = 2.0;
    std::optional<double> low, high, highpass;
    bool boostOutside = false, peaksOnly = false;
};
} // namespace

CLI::App* FitSubcommand::declare(CLI::App& app)
{
    auto* command = app.add_subcommand("fit", "Fit the equaliser that flattens a measured response");
    addOption(*command, "response", input,
              "CSV file with frequency (Hz) and level (dB), or a profile with a measurement", "RESPONSE")
        ->required();
    addOption(*command, "-o,--output", output, "Profile to write, with the equaliser", "PROFILE.json");
    addOption(*command, "--profile", base, "Profile that receives the equaliser when RESPONSE is a CSV file",
              "PROFILE");
    addOption(*command, "--plot", picture, "Picture of the response before and after (.png, .svg or .pdf)", "PICTURE");
    addPreset(*command, "--sections", sections,
              "Number of sections, 1 to 16, or auto for the smallest sufficient number",
              CLI::Validator(
                  [](const std::string& text)
                  {
                      const auto count = parseNumber<int>(text);
                      return (count && *count >= 1 && *count <= 16) || text == "auto"
                                 ? std::string()
                                 : text + " is neither auto nor a number from 1 to 16";
                  },
                  "", "sections"),
              "K|auto");
    addPreset(*command, "--rate", rate, "Sample rate of the equaliser, Hz", numberFrom(1000.0, 1e7), "HZ");
    addPreset(*command, "--max-boost", maxBoost, "Maximum boost at any frequency, dB", numberFrom(0.0, 40.0), "DB");
    addPreset(*command, "--goal", goal,
              "Maximum deviation for an automatic number of sections, dB; the RMS limit is a quarter of it",
              numberFrom(0.01, 100.0), "DB");
    addOption(*command, "--low", low, "Start of the range to flatten, Hz [that of the profile, else the first point]",
              numberFrom(0.1, 200000.0), "HZ");
    addOption(*command, "--high", high, "End of the range to flatten, Hz [that of the profile, else the last point]",
              numberFrom(0.1, 200000.0), "HZ");
    addOption(*command, "--highpass", highpass, "Protect the actuator by a high-pass of order 5 at this frequency, Hz",
              numberFrom(1.0, 20000.0), "HZ");
    command->add_flag("--boost-outside", boostOutside,
                      "Allow boost outside the range; below the range this takes much power and travel");
    command->add_flag("--peaks-only", peaksOnly, "Use no shelving filters");
    return command->footer("Examples:\n  pacini measure fit response.csv --sections 5 --json\n"
                           "  pacini measure fit mine.json -o mine.json --plot mine.png");
}

EqualizerFitParams FitSubcommand::paramsFor(const std::optional<Profile>& profile) const
{
    EqualizerFitParams params;
    params.sampleRate = rate;
    if (sections != "auto")
        params.sections = std::stoi(sections);
    params.maxBoost = maxBoost;
    params.lowFrequency = low.value_or(profile ? profile->range.lowFrequency : 0.0);
    params.highFrequency = high.value_or(profile ? profile->range.highFrequency : 0.0);
    params.goalMax = goal;
    params.goalRms = 0.25 * goal;
    params.boostOutside = boostOutside;
    params.shelves = !peaksOnly;
    if (highpass)
        params.highpass = protectingHighpass(*highpass);
    return params;
}

Exit FitSubcommand::run(Console& console)
{
    auto opened = openInput(console, input);
    if (!opened)
        return console.fail(input, opened.error());
    auto& [response, profile, measured] = *opened;
    if (measured && !base.empty())
        return console.fail(input,
                            {ErrorCode::invalidArgument, "--profile", "is for responses from a CSV file; leave it out"},
                            Exit::usage);
    if (!base.empty() && !(profile = openProfile(console, base)))
        return Exit::failed;
    if (!output.empty() && !profile)
        return console.fail(output,
                            {ErrorCode::invalidArgument, "--profile",
                             "must name the profile for the equaliser, as RESPONSE is not a profile"},
                            Exit::usage);
    if (!picture.empty() && !plot::pictureFormatOf(picture))
        return console.fail(
            picture, {ErrorCode::invalidArgument, "--plot", "must have the extension .png, .svg or .pdf"}, Exit::usage);

    const EqualizerFitParams params = paramsFor(profile);
    const auto fit = fitEqualizer(response, params);
    if (!fit)
        return console.fail(input, fit.error());
    const double milliseconds = medianMilliseconds(response, params);

    if (profile)
        setEqualizer(*profile, *fit, measured ? "the measurement" : std::filesystem::path(input).filename().string(),
                     rate);
    if (!output.empty())
        if (const auto written = writeProfile(output, *profile); !written)
            return console.fail(output, written.error());
    if (!picture.empty())
        if (const auto written = drawPicture(response, *fit, params); !written)
            return console.fail(picture, written.error());

    std::optional<EqualizerCost> cost;
    if (profile)
        cost = equalizerCost(*profile, fit->sections, rate);
    Json list = Json::array();
    for (const EqualizerSection& section : fit->sections)
        list.push_back(sectionJson(section));
    Json report{{"input", input},        {"sections", std::move(list)},   {"rms", fit->rms},
                {"max", fit->max},       {"level", fit->level},           {"boost", fit->boost},
                {"points", fit->points}, {"dropouts", fit->dropouts},     {"reachedGoal", fit->reachedGoal},
                {"rate", rate},          {"iterations", fit->iterations}, {"milliseconds", milliseconds}};
    if (cost)
        report["cost"] = costJson(*cost);
    console.addToReport(report);
    std::string text = fmt::format("{}: {} section{} at {:.0f} Hz leave{} {:.2f} dB RMS, {:.2f} dB at most; {:.2f} ms",
                                   printable(input), fit->sections.size(), fit->sections.size() == 1 ? "" : "s", rate,
                                   fit->sections.size() == 1 ? "s" : "", fit->rms, fit->max, milliseconds);
    for (const EqualizerSection& section : fit->sections)
        text += "\n" + sectionText(section);
    if (cost)
        text += "\n" + costText(*cost);
    console.print(text);
    if (!output.empty())
        console.wrote(output);
    if (!picture.empty())
        console.wrote(picture);
    return Exit::ok;
}

Result<std::size_t> FitSubcommand::drawPicture(const FrequencyResponse& response, const EqualizerFit& fit,
                                               const EqualizerFitParams& params) const
{
    plot::ResponseFigureContent content;
    content.title = std::filesystem::path(input).filename().string();
    content.subtitle = fmt::format("equaliser fitted at {:.0f} Hz: {:.2f} dB RMS and {:.2f} dB at most from its mean",
                                   rate, fit.rms, fit.max);
    content.equalizer = fit.sections;
    content.sampleRate = rate;
    content.lowFrequency = params.lowFrequency;
    content.highFrequency = params.highFrequency;
    FrequencyResponse after = response;
    const auto filter = designEqualizer(fit.sections, rate);
    for (std::size_t i = 0; i < after.size(); ++i)
        after.level[i] += Decibels::fromGain(std::abs(filter.response(Hertz(after.frequency[i]), rate))).value;
    content.responses = {{"measured", response, plot::ResponseRole::measured},
                         {"with the equaliser", std::move(after), plot::ResponseRole::flattened}};
    const plot::FigureStyle style;
    return plot::writeFigure(picture, makeResponseFigure(content, style), style);
}

std::unique_ptr<Command> fitSubcommand()
{
    return std::make_unique<FitSubcommand>();
}

} // namespace pacini::cli
