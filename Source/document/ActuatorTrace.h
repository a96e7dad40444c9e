#pragma once

// Trace of a clip on an actuator: the signal that it plays, and the losses.

#include "document/view/Columns.h"

#include <pacini/actuator/Profile.h>
#include <pacini/clip/Clip.h>
#include <pacini/clip/edits/Lane.h>
#include <pacini/foundation/Result.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

/// Reason why part of a clip is changed or not played.
enum class Loss : std::uint8_t
{
    none,
    belowTouch, ///< what is driven is not felt
    outOfRange, ///< the actuator cannot show the frequency
    noVoice,    ///< it is played by another band's voice
    dropped,    ///< left out as a whole
    limited     ///< protection takes from it
};

/// A stretch of time in which something is lost.
struct LostPart
{
    TimeRange time; ///< s, whole steps
    Loss loss = Loss::none;
    bool operator==(const LostPart&) const = default;
};

/// Trace of one clip that was played. Immutable once made; the same steps of time for all. Levels are in dB re full
/// drive.
class ActuatorTrace
{
public:
    static constexpr double step = 0.005;    ///< s
    static constexpr float silent = -120.0f; ///< dB, and all below

    /// A band, or a band of noise, of the clip.
    struct Source
    {
        Lane lane;
        Loss whole = Loss::none;  ///< nothing of it, or nothing at its own pitch, is played
        std::string why;          ///< of `whole`, in plain words
        std::vector<Loss> losses; ///< none where the clip is silent
        std::vector<float> levels;
        std::vector<float> wanted, played; ///< Hz in the clip and on the actuator
    };

    /// What is played; the sources are filled in before anybody else sees it.
    ActuatorTrace(Profile profile, double duration, std::vector<float> drivePeaks, std::vector<float> gainReductions,
                  std::vector<std::uint8_t> limitsReached);
    ActuatorTrace(const ActuatorTrace&) = delete;
    ActuatorTrace& operator=(const ActuatorTrace&) = delete;

    enum Limit : std::uint8_t
    {
        fullDrive = 1,
        travel = 2,
        heat = 4
    };

    const Profile actuator;
    const double duration;                  ///< s
    const double touch;                     ///< dB: below it nothing is felt
    const std::vector<float> peaks;         ///< of the drive, 1 = full drive
    const std::vector<float> reductions;    ///< dB that protection takes
    const std::vector<std::uint8_t> limits; ///< which ones are near, see Limit
    const WaveformPeaks drive, reduction;   ///< the same for columns of a view
    std::vector<Loss> losses;               ///< of the whole output
    std::vector<Source> sources;            ///< the clip's bands, then its noise
    std::vector<std::string> changes;       ///< what was done to the clip, in plain words

    /// The step that a time lies in; nothing outside the clip.
    [[nodiscard]] std::optional<std::size_t> stepAt(double time) const noexcept;

    /// What is lost at a step and why, in plain words; empty: nothing. Of the whole output, and of a source.
    [[nodiscard]] std::string textOf(std::size_t step) const;
    [[nodiscard]] std::string textOf(const Source& source, std::size_t step) const;

    /// Stretches of one loss, in order of time; of such losses as are above.
    [[nodiscard]] static std::vector<LostPart> parts(std::span<const Loss> losses);
};

/// Renders the clip for the actuator as `pacini render` does, at 16 kHz, with `strength` as fitActuator() has it.
/// Errors: those of renderScene(), and cancelled when `cancelled` has become true meanwhile. [worker]
[[nodiscard]] Result<std::shared_ptr<const ActuatorTrace>>
traceActuator(const Clip& clip, const Profile& profile, double strength, const std::atomic<bool>& cancelled);

/// The clip with levels and frequencies that the actuator can play, see adaptClip().
[[nodiscard]] Clip fittedClip(const Clip& clip, const Profile& profile, double strength);

/// Whether a clip that was designed on this actuator can be felt alike on another, see transparentClip().
[[nodiscard]] bool canBeAlike(const Profile& profile) noexcept;

/// A clip that is felt on one actuator as another was where it was designed.
struct AlikeClip
{
    Clip clip;
    std::vector<std::string> lost; ///< what cannot be felt alike
};

/// The clip, designed on `designedOn`, as it feels alike on `actuator`; see transparentClip(), whose errors it has.
[[nodiscard]] Result<AlikeClip> feltAlike(const Clip& clip, const Profile& designedOn, const Profile& actuator,
                                          double strength);

} // namespace pacini
