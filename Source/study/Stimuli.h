#pragma once

// Sound and touch of stimuli and whole trials, rendered before playback, on one clock.

#include "study/Study.h"

#include <pacini/actuator/Profile.h>
#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

namespace pacini::study
{

/// Devices of the participant.
struct StimulusParams
{
    int sampleRate = 48000;         ///< Hz, of the device
    std::optional<Profile> profile; ///< of the actuator; without it full drive is the one limit
    std::filesystem::path folder;   ///< base folder of the study's files
    double touchLatency = 0.0;      ///< delay of the touch against the sound in the set-up, s; trials compensate for it
};

/// A stimulus on the device's clock.
struct PreparedStimulus
{
    std::vector<float> sound;             ///< for both ears; as long as the touch
    std::vector<float> touch;             ///< drive signal of the first actuator, within the limits of the profile
    std::vector<std::vector<float>> more; ///< those of the other actuators in the row, each as long
};

/// Variable of a stimulus that an adaptive trial changes.
struct Variation
{
    Variable variable = Variable::level;
    double value = 0.0; ///< in its unit
    bool operator==(const Variation&) const = default;
};

/// Makes the stimuli of a study, each once. [worker]
class StimulusMaker
{
public:
    StimulusMaker(const Study& study, StimulusParams params) : whole(study), settings(std::move(params)) {}

    /// Returns sound and touch of a stimulus, unchanged or varied. A delay is left to the trial. Errors: those of
    /// reading and translating its files, with the stimulus as prefix.
    [[nodiscard]] Result<PreparedStimulus> make(std::size_t stimulus, const std::optional<Variation>& variation = {});

    [[nodiscard]] const Study& study() const noexcept { return whole; }
    [[nodiscard]] const StimulusParams& params() const noexcept { return settings; }

private:
    [[nodiscard]] Result<PreparedStimulus> made(const Stimulus& stimulus) const;
    [[nodiscard]] Result<PreparedStimulus> mixed(const Stimulus& stimulus) const;
    [[nodiscard]] PreparedStimulus placed(std::vector<float> sound, const std::vector<float>& touch,
                                          const Stimulus& stimulus) const;
    [[nodiscard]] Result<std::vector<float>> soundOf(const Stimulus& stimulus) const;
    [[nodiscard]] Result<std::vector<float>> touchOf(const Stimulus& stimulus) const;
    [[nodiscard]] Result<std::vector<float>> translated(const Stimulus& stimulus) const;
    [[nodiscard]] Result<std::vector<float>> rendered(const Clip& clip) const;
    [[nodiscard]] std::optional<Error> calibrate(std::vector<float>& touch, const Stimulus& stimulus) const;

    Study whole;
    StimulusParams settings;
    std::map<std::size_t, PreparedStimulus> kept;
};

/// Limits `samples` of a drive signal to full drive and the limits of the profile, without equalising. In place.
void protectDrive(std::vector<float>& samples, const std::optional<Profile>& profile, int sampleRate);

/// Whether a profile says what is felt, by its body model or a calibrated measurement.
[[nodiscard]] bool knowsFelt(const std::optional<Profile>& profile) noexcept;

/// Returns the felt acceleration of a drive signal, m/s2. Of a profile that does not know it, `assumedAcceleration` at
/// full drive is assumed, more than wristbands reach.
[[nodiscard]] std::vector<float> feltOf(const std::vector<float>& drive, const std::optional<Profile>& profile,
                                        int sampleRate);
inline constexpr double assumedAcceleration = 50.0;

/// Returns the dose (see doseOf()) of the actuator that vibrates most. `more`: drive signals of the other actuators.
[[nodiscard]] double largestDose(const std::vector<float>& touch, const std::vector<std::vector<float>>& more,
                                 const std::optional<Profile>& profile, int sampleRate, ExposedPart part);

} // namespace pacini::study
