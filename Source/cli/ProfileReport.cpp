#include "cli/ProfileReport.h"

#include "cli/Console.h"
#include "io/ProfileFields.h"
#include "io/ProfileJson.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace pacini::cli
{

namespace
{
using Json = nlohmann::ordered_json;

/// The paths of all numbers below `value`.
void numbersIn(const Json& value, const std::string& path, std::vector<std::string>& paths)
{
    if (value.is_number())
        paths.push_back(path);
    else if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i)
            numbersIn(value[i], fmt::format("{}[{}]", path, i), paths);
    else if (value.is_object())
        for (const auto& [name, inner] : value.items())
            numbersIn(inner, path.empty() ? name : path + "." + name, paths);
}

/// One line of the report: a label and what was said so far.
class Lines
{
public:
    explicit Lines(const Profile& shown) : profile(shown) {}

    std::string text;

    void start(std::string_view label)
    {
        text += fmt::format("\n  {:<13} ", label);
        first = true;
    }

    /// A piece of the line; an asterisk if the number at `path` is assumed.
    void add(std::string_view path, std::string_view piece)
    {
        const ProfileSource* source = sourceOf(profile.sources, path);
        const bool assumed = source != nullptr && isAssumed(*source);
        anyAssumed = anyAssumed || assumed;
        text += fmt::format("{}{}{}", first ? "" : ", ", piece, assumed ? "*" : "");
        first = false;
    }

    void end()
    {
        if (anyAssumed)
            text += "\n  * assumed, not measured: the file's \"sources\" say why";
    }

private:
    const Profile& profile;
    bool first = true;
    bool anyAssumed = false;
};

void addDrive(Lines& lines, const ActuatorDrive& drive)
{
    const auto add = [&](const char* path, const std::optional<double>& value, double unit, const char* format)
    {
        if (value)
            lines.add(path, fmt::format(fmt::runtime(format), *value / unit));
    };
    constexpr double milli = 1e-3;
    lines.start("drive");
    add("drive.impedance", drive.impedance, 1.0, "{:.3g} ohm");
    add("drive.maxVoltageRms", drive.maxVoltageRms, 1.0, "{:.3g} V rms");
    add("drive.maxPower", drive.maxPower, 1.0, "{:.3g} W continuous");
    add("drive.thermalTime", drive.thermalTime, 1.0, "warms up in {:.3g} s");
    add("drive.excursion", drive.excursion, milli, "moves {:.3g} mm far below resonance");
    add("drive.maxExcursion", drive.maxExcursion, milli, "at most {:.3g} mm");
    lines.add("drive.overdrive", fmt::format("overdrive {:.3g}", drive.overdrive));
}

void addEqualizer(Lines& lines, const EqualizerSections& sections)
{
    for (std::size_t i = 0; i < sections.size(); ++i)
    {
        const EqualizerSection& section = sections[i];
        lines.start(i == 0 ? "equalizer" : "");
        const auto kind = nameOf(section.type, profileFields::equalizerTypes);
        lines.add(
            fmt::format("equalizer[{}]", i),
            section.type == EqualizerType::highpass
                ? fmt::format("{} {:.4g} Hz, order {}", kind, section.frequency, section.order)
                : fmt::format("{} {:.4g} Hz, {:+.3g} dB, Q {:.3g}", kind, section.frequency, section.gain, section.q));
    }
}

void addBody(Lines& lines, const BodyParams& body)
{
    constexpr double gram = 1e-3;
    lines.start("body");
    lines.add("body.force", fmt::format("force {:.3g} N", body.force));
    lines.add("body.movingMass", fmt::format("moving mass {:.3g} g", body.movingMass / gram));
    lines.add("body.deviceMass", fmt::format("device {:.3g} g", body.deviceMass / gram));
    lines.add("body.jointStiffness", fmt::format("joint {:.3g} N/m", body.jointStiffness));
    lines.add("body.jointDamping", fmt::format("{:.3g} N s/m", body.jointDamping));
    lines.start("");
    lines.add("body.skinMass", fmt::format("skin {:.3g} g", body.skinMass / gram));
    lines.add("body.skinStiffness", fmt::format("{:.3g} N/m", body.skinStiffness));
    lines.add("body.skinDamping", fmt::format("{:.3g} N s/m", body.skinDamping));
}

void addMeasurement(Lines& lines, const ProfileMeasurement& measurement)
{
    lines.start("measured");
    lines.add("measurement",
              fmt::format("{} placement{}", measurement.placements, measurement.placements == 1 ? "" : "s"));
    lines.add("measurement", fmt::format("{:.3g} dB below full drive", -measurement.drive));
    if (measurement.distortionDrive)
        lines.add("measurement", fmt::format("10 % distortion at {:.3g} dB", *measurement.distortionDrive));
    if (!measurement.linearity)
        return;
    const Linearity& linearity = *measurement.linearity;
    lines.start("");
    lines.add("measurement", fmt::format("{} within \u00b1{:.3g} dB from {:.0f} to {:.0f} Hz",
                                         linearity.passed() ? "flat" : "not flat", linearity.tolerance,
                                         linearity.lowFrequency, linearity.highFrequency));
    lines.add("measurement", fmt::format("mean deviation {:.2f} dB", linearity.meanDeviation));
    lines.add("measurement",
              fmt::format("worst {:+.2f} dB at {:.0f} Hz", linearity.worstDeviation, linearity.worstFrequency));
}
} // namespace

const char* technologyText(Technology technology)
{
    constexpr std::array texts{
        "eccentric rotating mass", "linear resonant actuator", "piezoelectric", "electroactive polymer", "voice coil",
        "no actuator known"};
    static_assert(texts.size() == profileFields::technologies.size());
    return texts[static_cast<std::size_t>(technology)];
}

std::string voicesText(int polyphony)
{
    if (polyphony == 0)
        return "amplitude only";
    if (polyphony == Profile::unlimitedPolyphony)
        return "any number";
    return fmt::format("{}", polyphony);
}

Json describe(const Profile& profile)
{
    Json report{{"kind", "profile"}};
    const Json entries = Json::parse(profileJson(profile));
    for (const auto& [name, value] : entries.items())
        if (name != "format" && name != "version")
            report[name] = value;
    // These are told even where they are the defaults.
    report["polyphony"] = profile.polyphony;
    std::vector<std::string> numbers;
    numbersIn(entries, "", numbers);
    Json assumed = Json::array();
    for (const std::string& path : numbers)
        if (const ProfileSource* source = sourceOf(profile.sources, path); source != nullptr && isAssumed(*source))
            assumed.push_back(path);
    report["assumed"] = assumed;
    return report;
}

std::string profileText(const std::string& file, const Profile& profile)
{
    constexpr double milli = 1e-3;
    Lines lines(profile);
    lines.text = fmt::format("{}: actuator profile \"{}\"", printable(file), printable(profile.name));
    lines.start("technology");
    lines.add("technology", technologyText(profile.technology));
    lines.start("resonance");
    lines.add("resonance.frequency", fmt::format("{:.4g} Hz", profile.resonance.frequency));
    lines.add("resonance.q", fmt::format("Q {:.3g}", profile.resonance.q));
    lines.start("range");
    lines.add("range.lowFrequency", fmt::format("from {:.4g} Hz", profile.range.lowFrequency));
    lines.add("range.highFrequency", fmt::format("to {:.4g} Hz", profile.range.highFrequency));
    lines.add("range.dynamicRange", fmt::format("{:.3g} dB", profile.range.dynamicRange));
    lines.start("response");
    lines.add("response.riseTime", fmt::format("rises in {:.3g} ms", profile.response.riseTime / milli));
    lines.add("response.fallTime", fmt::format("falls in {:.3g} ms", profile.response.fallTime / milli));
    lines.start("voices");
    lines.add("polyphony", voicesText(profile.polyphony));
    lines.add("frequencyMapping", fmt::format("frequencies outside the range: {}",
                                              nameOf(profile.frequencyMapping, profileFields::frequencyMappings)));
    addDrive(lines, profile.drive);
    addEqualizer(lines, profile.equalizer);
    lines.start("events");
    const auto shape = nameOf(profile.transient.shape, profileFields::transientShapes);
    lines.add("transient", profile.transient.shape == TransientShape::adaptive
                               ? std::string(shape)
                               : fmt::format("{:.3g} {} cycles at {:.4g} Hz", profile.transient.cycles, shape,
                                             profile.transient.frequency));
    if (profile.body)
        addBody(lines, *profile.body);
    if (profile.measurement)
        addMeasurement(lines, *profile.measurement);
    lines.end();
    return lines.text;
}

} // namespace pacini::cli
