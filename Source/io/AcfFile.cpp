#include "io/AcfFile.h"

#include "io/FileExtension.h"
#include "io/InputFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>

namespace pacini
{

namespace
{
// "Determining Emphasis Values" in the ACF documentation of the Meta haptics SDK.
constexpr double dullestOverResonance = 0.8;
constexpr double sharpestOverResonance = 1.8;

constexpr double milliseconds = 1000.0;

/// "a, b and c"
std::string listed(const std::vector<std::string>& names)
{
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return text;
}

void warn(std::vector<std::string>& warnings, const std::vector<std::string>& names, const std::string& what)
{
    if (!names.empty())
        warnings.push_back(listed(names) + what);
}

/// The fixed transient that both ends are, if they are.
std::optional<ActuatorTransient> fixedTransient(const Acf& acf)
{
    const AcfEmphasisEnd& end = acf.ends[0];
    const double cycles = end.frequency * end.duration / milliseconds;
    if (end != acf.ends[1] || cycles < 0.1 || cycles > 100.0)
        return std::nullopt;
    if (end.shape == AcfShape::sine)
        return ActuatorTransient{TransientShape::sine, end.frequency, cycles};
    if (end.shape == AcfShape::square)
        return ActuatorTransient{TransientShape::square, end.frequency, cycles};
    return std::nullopt;
}

/// What `profile` says that an ACF has no place for.
std::vector<std::string> beyondAcf(const Profile& profile)
{
    const Profile plain;
    const bool amplitudeOnly = profile.polyphony == 0;
    ActuatorDrive drive = profile.drive;
    drive.overdrive = plain.drive.overdrive;
    std::vector<std::string> names;
    const auto addIf = [&](bool differs, const char* name)
    {
        if (differs)
            names.emplace_back(name);
    };
    addIf(profile.technology != plain.technology, "technology");
    addIf(profile.resonance.q != plain.resonance.q, "resonance.q");
    addIf(amplitudeOnly, "range.lowFrequency");
    addIf(amplitudeOnly, "range.highFrequency");
    addIf(profile.range.dynamicRange != plain.range.dynamicRange, "range.dynamicRange");
    addIf(profile.response != plain.response, "response");
    addIf(!amplitudeOnly && profile.polyphony != plain.polyphony, "polyphony");
    addIf(profile.frequencyMapping != plain.frequencyMapping, "frequencyMapping");
    addIf(drive != plain.drive, "drive (but overdrive)");
    addIf(!profile.equalizer.empty(), "equalizer");
    addIf(profile.body.has_value(), "body");
    addIf(!profile.sources.empty(), "sources");
    return names;
}
} // namespace

bool hasAcfExtension(const std::filesystem::path& path)
{
    return lowerExtension(path) == ".acf";
}

ProfileOfAcf profileOfAcf(const Acf& acf)
{
    ProfileOfAcf result;
    Profile& profile = result.profile;
    profile.name = acf.device.empty() ? "Unnamed actuator" : acf.device;
    profile.sources = {{"drive.overdrive", "ACF file, emphasis.gain over continuous.gain"},
                       {"polyphony", "assumed: an ACF file does not state the number of voices"},
                       {"range", "ACF file, continuous"},
                       {"range.dynamicRange", "assumed: an ACF file does not state it"},
                       {"resonance.frequency",
                        "assumed: from the emphasis frequencies of an ACF file, by the rule that "
                        "they are 0.8 and 1.8 times the resonance"},
                       {"resonance.q", "assumed: an ACF file does not state it"}};
    const auto fixed = fixedTransient(acf);
    const double middle = std::sqrt(acf.ends[0].frequency * acf.ends[1].frequency);
    profile.resonance.frequency =
        std::max(1.0, fixed ? middle : middle / std::sqrt(dullestOverResonance * sharpestOverResonance));
    profile.range.lowFrequency = acf.lowFrequency;
    profile.range.highFrequency = acf.highFrequency;
    if (acf.lowFrequency == acf.highFrequency)
    {
        profile.polyphony = 0;
        profile.resonance.frequency = acf.lowFrequency;
        profile.range.lowFrequency = std::max(1.0, acf.lowFrequency / std::numbers::sqrt2);
        profile.range.highFrequency = std::min(20000.0, acf.lowFrequency * std::numbers::sqrt2);
        profile.sources[1].text = "ACF file: equal frequencies, so only amplitude counts";
        profile.sources[2].text = "assumed: half an octave on each side of the one frequency of the ACF file";
        profile.sources[4].text = "ACF file, continuous";
    }
    if (fixed)
    {
        profile.transient = *fixed;
        profile.sources.push_back({"transient", "ACF file, emphasis"});
    }
    constexpr double largestOverdrive = 10.0;
    const double headroom = acf.emphasisGain / std::max(acf.continuousGain, 1e-3);
    profile.drive.overdrive = std::clamp(headroom, 1.0, largestOverdrive);

    std::vector<std::string> lost;
    const auto loseIf = [&](bool isLost, const char* name)
    {
        if (isLost)
            lost.emplace_back(name);
    };
    loseIf(!acf.version.empty(), "metadata.version");
    loseIf(!acf.date.empty(), "metadata.date");
    loseIf(!acf.author.empty(), "metadata.author");
    loseIf(std::max(acf.continuousGain, acf.emphasisGain) != 1.0 || headroom != profile.drive.overdrive,
           "the absolute gains");
    loseIf(true, "continuous.emphasis_ducking");
    loseIf(acf.fadeOutPercent != 0.0, "emphasis.fade_out_percent");
    warn(result.warnings, lost, " cannot be held by a profile");
    if (!fixed)
        result.warnings.push_back("emphasis.frequency_min and frequency_max differ: events are played adaptively, and "
                                  "the resonance is estimated from them");
    warn(result.warnings, {"technology", "q", "dynamic range", "response and drive limits"},
         " are not in an ACF file; the profile has defaults for them");
    return result;
}

AcfOfProfile acfOfProfile(const Profile& profile)
{
    constexpr double emphasisCycles = 2.0;
    constexpr double highestEmphasis = 2000.0;
    AcfOfProfile result;
    Acf& acf = result.acf;
    acf.version = "1.0.0";
    acf.device = profile.name;
    acf.continuousGain = 1.0 / profile.drive.overdrive;
    acf.lowFrequency = profile.polyphony == 0 ? profile.resonance.frequency : profile.range.lowFrequency;
    acf.highFrequency = profile.polyphony == 0 ? profile.resonance.frequency : profile.range.highFrequency;
    if (profile.transient.shape == TransientShape::adaptive)
    {
        const auto end = [&](double overResonance, AcfShape shape)
        {
            const double frequency = std::clamp(overResonance * profile.resonance.frequency, 1.0, highestEmphasis);
            return AcfEmphasisEnd{
                frequency, milliseconds * std::max(emphasisCycles / frequency, profile.response.riseTime), shape};
        };
        acf.ends = {end(dullestOverResonance, AcfShape::sine), end(sharpestOverResonance, AcfShape::square)};
        result.warnings.emplace_back("emphasis is made up from the resonance: 0.8 and 1.8 times its frequency, two "
                                     "cycles or the rise time");
    }
    else
    {
        const double duration = milliseconds * profile.transient.cycles / profile.transient.frequency;
        const auto shape = profile.transient.shape == TransientShape::sine ? AcfShape::sine : AcfShape::square;
        acf.ends.fill({profile.transient.frequency, std::clamp(duration, 0.1, 10000.0), shape});
    }
    warn(result.warnings, beyondAcf(profile), " cannot be held by an ACF file");
    result.warnings.emplace_back(
        "continuous.emphasis_ducking 0.5 and emphasis.fade_out_percent 0 are not in a profile; "
        "they are the usual values");
    return result;
}

Result<ProfileOfAcf> readAcfFile(const std::filesystem::path& path)
{
    const auto text = readWholeFile(path, largestAcfText);
    if (!text)
        return text.error();
    const auto acf = readAcf(*text);
    if (!acf)
        return acf.error();
    return profileOfAcf(*acf);
}

} // namespace pacini
