#pragma once

// A running session: plays trials, allows answers at the right time, and stores measurements.

#include "study/Session.h"
#include "study/TrialPlayback.h"

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace pacini::study
{

/// Sound device of a session. [message]
class TrialPlayer
{
public:
    virtual ~TrialPlayer() = default;

    /// Tries to open the device again that went away.
    virtual void recover() {}

    /// Hz; 0 without a device.
    [[nodiscard]] virtual int sampleRate() const = 0;
    virtual void play(TrialSound trial) = 0;
    virtual void stop() = 0;
    [[nodiscard]] virtual PlaybackReport report() const = 0;
};

/// Why something is not played.
enum class PlayRefusal
{
    none,
    noDevice,
    noReplayLeft,
    exposure,   ///< it would pass the limit of the study
    soundLevel, ///< the sound is louder than the study allows
    failed      ///< see StudyRun::failure()
};

/// [message]
class StudyRun
{
public:
    /// `player` outlives this.
    StudyRun(const Study& study, std::unique_ptr<Session> session, const StimulusParams& params, TrialPlayer& player);

    [[nodiscard]] Session& session() noexcept { return *running; }
    [[nodiscard]] const Study& study() const noexcept { return maker.study(); }
    [[nodiscard]] const Trial* trial() const noexcept { return running->trial(); }
    [[nodiscard]] const Block& block() const;

    /// Whether the stimuli of the trial are played one by one, at the participant's choice.
    [[nodiscard]] bool isPage() const;

    /// Plays the trial, or of a page one stimulus.
    PlayRefusal play(std::size_t part = 0);

    /// Plays a stimulus that does not belong to a trial, at a level relative to the study's.
    PlayRefusal tryOut(std::size_t stimulus);
    void stop() { player.stop(); }

    /// State of playback: whether something plays, and its part (interval). Call poll() often.
    struct Playing
    {
        bool now = false;
        std::optional<std::size_t> part;
    };
    Playing poll();

    /// Whether everything has been played to its end at least once.
    [[nodiscard]] bool canAnswer() const;

    /// Returns the number of remaining plays; none: any number.
    [[nodiscard]] std::optional<int> playsLeft(std::size_t part = 0) const;

    /// Completes the answer with times, replays, onsets and exposure, and keeps it. Errors: those of Session::answer().
    [[nodiscard]] Result<std::optional<bool>> answer(Answer answer);

    /// A(8) so far, m/s2.
    [[nodiscard]] double exposure() const;
    [[nodiscard]] const std::optional<Error>& failure() const noexcept { return error; }

    /// Lowers everything that is felt, as a participant wishes, dB.
    void lowerTouch(double decibels);
    [[nodiscard]] double touchTrim() const noexcept { return trim; }

private:
    [[nodiscard]] PlayRefusal checkDevice();
    [[nodiscard]] PlayRefusal start(Result<TrialSound> sound, std::size_t part);
    void beginTrial();

    StimulusMaker maker;
    std::unique_ptr<Session> running;
    TrialPlayer& player;
    std::optional<Error> error;
    std::optional<std::size_t> startedPart; ///< that plays
    std::vector<FrameRange> parts;          ///< of what plays
    std::vector<int> plays;                 ///< of each part
    std::set<std::size_t> played;           ///< parts that were played to their end
    PlaybackReport last;                    ///< of the first whole play
    int dropouts = 0;
    double trim = 0.0; ///< dB
    std::chrono::steady_clock::time_point ended = std::chrono::steady_clock::now();
};

} // namespace pacini::study
