#pragma once

// Actuator profile: technology, limits, response and equalizer of an actuator, as far as they are known.

#include <pacini/actuator/Equalizer.h>
#include <pacini/actuator/ProfileMeasurement.h>
#include <pacini/actuator/TransientShape.h>
#include <pacini/foundation/Result.h>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini
{

/// Source of the number at `path`, or of all numbers below it: `{"drive", "datasheet of ..."}`. A text that starts with
/// "assumed" marks numbers without a measurement.
struct ProfileSource
{
    std::string path; ///< as in the file, such as `resonance.frequency` or `equalizer[1]`
    std::string text;
    bool operator==(const ProfileSource&) const = default;
};

/// The sources of a profile, each path once, in the order of their bytes.
using ProfileSources = std::vector<ProfileSource>;

inline constexpr std::size_t maxProfileSources = 256;

/// Checks that there are at most maxProfileSources, sorted, each path once, none without path or text.
[[nodiscard]] inline Result<void> validate(const ProfileSources& sources)
{
    if (sources.size() > maxProfileSources)
        return Error{ErrorCode::tooLarge, "sources", "has more than 256 entries"};
    for (std::size_t i = 0; i < sources.size(); ++i)
    {
        if (sources[i].path.empty())
            return Error{ErrorCode::invalidData, "sources", "has an entry without a path"};
        const std::string where = "sources." + sources[i].path;
        if (sources[i].text.empty())
            return Error{ErrorCode::invalidData, where, "must not be empty"};
        if (i > 0 && !(sources[i - 1].path < sources[i].path))
            return Error{ErrorCode::invalidData, where, "is out of order or given twice"};
    }
    return {};
}

/// The source of the number at `path`: the entry that names it, else the nearest object or list around it that an entry
/// names. Null when there is none.
[[nodiscard]] inline const ProfileSource* sourceOf(const ProfileSources& sources, std::string_view path) noexcept
{
    const ProfileSource* nearest = nullptr;
    for (const ProfileSource& source : sources)
    {
        if (!path.starts_with(source.path))
            continue;
        const bool whole =
            path.size() == source.path.size() || path[source.path.size()] == '.' || path[source.path.size()] == '[';
        if (whole && (nearest == nullptr || source.path.size() > nearest->path.size()))
            nearest = &source;
    }
    return nearest;
}

/// Whether the source says that its numbers are not measured.
[[nodiscard]] inline bool isAssumed(const ProfileSource& source) noexcept
{
    return std::string_view(source.text).starts_with("assumed");
}

/// Technology of an actuator.
enum class Technology
{
    erm,   ///< eccentric rotating mass: its frequency rises with its strength
    lra,   ///< linear resonant actuator: strong at one frequency only
    piezo, ///< piezoelectric bender or stack
    eap,   ///< electroactive polymer
    vca,   ///< voice coil
    pcm    ///< no actuator known: the drive signal as it is
};

/// Resonance of an actuator: the mass on its spring, with its base held still.
struct Resonance
{
    double frequency = 67.0; ///< Hz
    double q = 1.0;
    bool operator==(const Resonance&) const = default;
};

/// Range of frequencies and levels that the actuator can reproduce.
struct ActuatorRange
{
    double lowFrequency = 20.0;    ///< Hz
    double highFrequency = 1000.0; ///< Hz
    double dynamicRange = 60.0;    ///< dB between full drive and the weakest drive that is felt
    bool operator==(const ActuatorRange&) const = default;
};

/// Rise and fall times of the response to a burst at the resonance, at full drive.
struct ActuatorResponse
{
    double riseTime = 0.0; ///< s from rest to 90 % of the final strength
    double fallTime = 0.0; ///< s from there to 10 % when the drive ends
    bool operator==(const ActuatorResponse&) const = default;
};

/// Electrical and mechanical limits. The rated drive is the peak of a sinusoid of `maxVoltageRms` V, or of a motor that
/// direct voltage. A sample of 1 of the drive signal is `overdrive` times the rated drive; the limits hold for all of
/// it.
struct ActuatorDrive
{
    std::optional<double> impedance;     ///< ohm
    std::optional<double> maxVoltageRms; ///< V
    std::optional<double> maxPower;      ///< W of heat the coil bears for ever; needs impedance and voltage
    std::optional<double> thermalTime;   ///< s, time constant of its heating
    std::optional<double> maxExcursion;  ///< m from rest, of the moving mass against its case
    std::optional<double> excursion;     ///< m from rest at the rated drive far below resonance; times q at resonance
    double overdrive = 1.0; ///< a driver may push up to this many times the rated drive for moments; a rated amplitude
                            ///< of 1 is then played at 1 / overdrive, so that there is room
    bool operator==(const ActuatorDrive&) const = default;
};

/// Mechanical parameters of actuator, device and skin: the way of the force from the moving mass through the device
/// into the skin (Weber 2020, Fig. 3.2). The moving mass hangs in the device on a spring and damper that follow from
/// the resonance; the joint links device and skin.
struct BodyParams
{
    double force = 1.0;            ///< N on the moving mass at a drive of 1
    double movingMass = 0.012;     ///< kg
    double deviceMass = 0.040;     ///< kg
    double jointStiffness = 4.0e4; ///< N/m
    double jointDamping = 5.0;     ///< N s/m
    double skinMass = 0.010;       ///< kg
    double skinStiffness = 800.0;  ///< N/m
    double skinDamping = 2.5;      ///< N s/m
    bool operator==(const BodyParams&) const = default;
};

/// Pulse of an event: how events are played.
struct ActuatorTransient
{
    TransientShape shape = TransientShape::adaptive;
    double frequency = 67.0; ///< Hz, for square and sine
    double cycles = 1.0;     ///< for square and sine
    bool operator==(const ActuatorTransient&) const = default;
};

/// Frequency mapping mode, for frequencies outside the actuator's range.
enum class FrequencyMapping
{
    clamp,   ///< to the nearest end of the range
    rescale, ///< 30-1000 Hz onto the range, in octaves
    fold     ///< by octaves into the range, as near to the resonance as can be
};

/// An actuator profile: response, limits and equaliser.
struct Profile
{
    static constexpr int unlimitedPolyphony = 64; ///< more than a clip has bands

    std::string name;
    std::string shortName; ///< for boxes and rows of windows; empty: the name, see shortNameOf()
    Technology technology = Technology::pcm;
    Resonance resonance;
    ActuatorRange range;
    ActuatorResponse response;
    int polyphony = unlimitedPolyphony; ///< sinusoids at a time: 0 amplitude only, 1 monophonic
    FrequencyMapping frequencyMapping = FrequencyMapping::clamp;
    ActuatorDrive drive;
    EqualizerSections equalizer;
    ActuatorTransient transient;
    std::optional<BodyParams> body;
    std::optional<ProfileMeasurement> measurement;
    ProfileSources sources;
    bool operator==(const Profile&) const = default;
};

/// The short name of an actuator, or its name where the profile has no short one.
[[nodiscard]] inline const std::string& shortNameOf(const Profile& profile) noexcept
{
    return profile.shortName.empty() ? profile.name : profile.shortName;
}

/// Gives a profile another name. The short one belonged to the old name and goes.
inline void renameProfile(Profile& profile, std::string name)
{
    profile.name = std::move(name);
    profile.shortName.clear();
}

/// Checks every number of a profile. Errors name the path as in the file, such as `body.skinMass`. Frequencies are 1 to
/// 20000 Hz (transients 1 to 2000), low below high; q 0.01 to 1000; the rest as the messages say.
[[nodiscard]] inline Result<void> validate(const Profile& profile)
{
    std::optional<Error> error;
    const auto wrong = [&](const char* where, std::string message)
    {
        if (!error)
            error = Error{ErrorCode::invalidData, where, std::move(message)};
    };
    // NaN fails every comparison, so it is never within.
    const auto check = [&](const char* where, double value, double low, double high, const char* message)
    {
        if (!(value >= low && value <= high))
            wrong(where, message);
    };
    const auto checkIf =
        [&](const char* where, std::optional<double> value, double low, double high, const char* message)
    {
        if (value)
            check(where, *value, low, high, message);
    };
    check("resonance.frequency", profile.resonance.frequency, 1.0, 20000.0, "must be 1 to 20000 Hz");
    check("resonance.q", profile.resonance.q, 0.01, 1000.0, "must be 0.01 to 1000");
    check("range.lowFrequency", profile.range.lowFrequency, 1.0, 20000.0, "must be 1 to 20000 Hz");
    check("range.highFrequency", profile.range.highFrequency, 1.0, 20000.0, "must be 1 to 20000 Hz");
    if (!(profile.range.lowFrequency < profile.range.highFrequency))
        wrong("range.highFrequency", "must be above lowFrequency");
    check("range.dynamicRange", profile.range.dynamicRange, 1.0, 140.0, "must be 1 to 140 dB");
    check("response.riseTime", profile.response.riseTime, 0.0, 2.0, "must be 0 to 2 s");
    check("response.fallTime", profile.response.fallTime, 0.0, 2.0, "must be 0 to 2 s");
    check("polyphony", profile.polyphony, 0, Profile::unlimitedPolyphony, "must be 0 to 64 voices");

    const ActuatorDrive& drive = profile.drive;
    checkIf("drive.impedance", drive.impedance, 0.1, 1e6, "must be 0.1 to 1000000 ohm");
    checkIf("drive.maxVoltageRms", drive.maxVoltageRms, 1e-3, 1e3, "must be 0.001 to 1000 V");
    checkIf("drive.maxPower", drive.maxPower, 1e-6, 1e3, "must be 0.000001 to 1000 W");
    if (drive.maxPower && !(drive.impedance && drive.maxVoltageRms))
        wrong("drive.maxPower", "also needs drive.impedance and drive.maxVoltageRms");
    checkIf("drive.thermalTime", drive.thermalTime, 0.01, 1e4, "must be 0.01 to 10000 s");
    checkIf("drive.maxExcursion", drive.maxExcursion, 1e-7, 0.1, "must be 0.0000001 to 0.1 m");
    checkIf("drive.excursion", drive.excursion, 1e-9, 1.0, "must be 0.000000001 to 1 m");
    if (drive.maxExcursion && !drive.excursion)
        wrong("drive.maxExcursion", "also needs drive.excursion");
    check("drive.overdrive", drive.overdrive, 1.0, 10.0, "must be 1 to 10");
    if (auto valid = validate(profile.equalizer, "equalizer"); !valid && !error)
        error = valid.error();
    check("transient.frequency", profile.transient.frequency, 1.0, 2000.0, "must be 1 to 2000 Hz");
    check("transient.cycles", profile.transient.cycles, 0.1, 100.0, "must be 0.1 to 100");
    if (profile.body)
    {
        const BodyParams& body = *profile.body;
        check("body.force", body.force, 1e-6, 1e3, "must be 0.000001 to 1000 N");
        check("body.movingMass", body.movingMass, 1e-7, 10.0, "must be 0.0000001 to 10 kg");
        check("body.deviceMass", body.deviceMass, 1e-6, 100.0, "must be 0.000001 to 100 kg");
        check("body.jointStiffness", body.jointStiffness, 1.0, 1e13, "must be 1 to 1e13 N/m");
        check("body.jointDamping", body.jointDamping, 0.0, 1e9, "must be 0 to 1e9 N s/m");
        check("body.skinMass", body.skinMass, 1e-7, 100.0, "must be 0.0000001 to 100 kg");
        check("body.skinStiffness", body.skinStiffness, 0.0, 1e9, "must be 0 to 1e9 N/m");
        check("body.skinDamping", body.skinDamping, 0.0, 1e6, "must be 0 to 1000000 N s/m");
    }
    if (profile.measurement)
        if (auto valid = validate(*profile.measurement, "measurement"); !valid && !error)
            error = valid.error();
    if (error)
        return *error;
    return validate(profile.sources);
}

} // namespace pacini
