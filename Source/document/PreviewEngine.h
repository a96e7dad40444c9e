#pragma once

// Preview engine: plays a clip while it is edited.

#include "document/PreviewSource.h"

#include <pacini/actuator/ActuatorFit.h>
#include <pacini/actuator/Profile.h>
#include <pacini/actuator/Protection.h>
#include <pacini/clip/edits/Audition.h>
#include <pacini/foundation/Result.h>
#include <pacini/realtime/HandOver.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// One of two takes that are compared: the clip before and after a change, two encodings, two clips.
enum class Take
{
    a,
    b
};

struct Playback
{
    bool source = false;           ///< the sound itself
    bool haptic = true;            ///< the drive signal
    std::optional<TimeRange> loop; ///< s of the clip; at least 5 ms, else it is no loop
    Take take = Take::a;
    std::shared_ptr<const Clip> a; ///< the clip that is edited
    std::shared_ptr<const Clip> b; ///< what it is compared with; null: the same
    Audition audition;             ///< bands that are soloed and muted

    [[nodiscard]] const std::shared_ptr<const Clip>& heard() const noexcept { return take == Take::b && b ? b : a; }
};

/// The plan of what is heard is built off the audio thread and handed over without locks; the audio thread fades from
/// the old to the new within 10 ms, beginning in the block in which it finds it (when the last fade is over). Up to
/// `exactFrom` seconds after a start the new plan has been played up to that place, so that sinusoids which an edit
/// leaves alone run on as they were; the same sound is rendered as `pacini render` does. Later it begins at the
/// playhead.
///
/// Three threads may use it at once: [message] says what to play, [worker] calls service() whenever wantsService() (at
/// least every 100 ms while playing: loops are built in pieces of 20 s), [audio] calls process().
class PreviewEngine
{
public:
    /// Meter readings of the drive signal.
    struct Meters
    {
        double peak = 0.0;          ///< of the drive signal, 1 = full drive
        double gainReduction = 0.0; ///< dB that the protection takes at most
    };

    static constexpr double exactFrom = 5.0; ///< s

    /// `sampleRate` 2000 to 768000 Hz; at any other service() says so and nothing plays.
    explicit PreviewEngine(double sampleRate) : fs(sampleRate) { bounds.prepare({fs, blockFrames}); }

    /// Another clip, another loop, other bands soloed: heard once service() has run. [message]
    void set(Playback playback);

    /// The actuator that is previewed (null: the plain drive signal) with its strength (see fitActuator), and the sound
    /// beside it (null: none). [any]
    void setProfile(std::shared_ptr<const Profile> profile, double strength = standardStrength);
    void setSource(std::shared_ptr<const PreviewSource> source);

    /// Starts at `time` s of the clip, or jumps there while playing. [message]
    void play(double time);

    /// Stops within 5 ms. [message]
    void stop() noexcept { playing.store(0, std::memory_order_release); }

    /// Whether it plays; false once the end has been reached. [any]
    [[nodiscard]] bool isPlaying() const noexcept { return playing.load(std::memory_order_relaxed) != 0; }

    /// The playhead, s of the clip. [any]
    [[nodiscard]] double position() const noexcept { return playhead.load(std::memory_order_relaxed); }

    /// The most since the last call; one reader. [any]
    [[nodiscard]] Meters takeMeters() noexcept
    {
        return {static_cast<double>(peakHeard.exchange(0.0f, std::memory_order_relaxed)),
                static_cast<double>(reductionHeard.exchange(0.0f, std::memory_order_relaxed))};
    }

    /// Whether service() has something to do. [any]
    [[nodiscard]] bool wantsService() const noexcept;

    /// Builds what has changed. Errors: those of compilePlan() and of loops that cannot be built; what played goes on.
    /// [worker]
    Result<void> service();

    /// Writes the next frames of the drive signal and of the sound (any number of channels; a mono sound goes to all).
    /// All spans have one length. [audio]
    void process(std::span<float> haptic, std::span<const std::span<float>> sound) noexcept;

private:
    /// What [message] has asked for.
    struct Wanted
    {
        Playback playback;
        std::shared_ptr<const Profile> profile;
        double strength = standardStrength;
        std::shared_ptr<const PreviewSource> source;
        std::uint64_t version = 0;
        std::uint64_t start = 0; ///< counts calls of play()
        double startTime = 0.0;  ///< s of the clip
    };

    /// The way of the playhead: frames since the start -> frames of the clip.
    struct Way
    {
        std::int64_t first = 0;                ///< frame of the clip at the start
        std::int64_t loopFrom = 0, loopTo = 0; ///< equal: no loop

        [[nodiscard]] std::int64_t at(std::int64_t frame) const noexcept
        {
            const std::int64_t there = first + frame;
            if (loopTo <= loopFrom || there < loopTo || first >= loopTo)
                return there;
            return loopFrom + (there - loopTo) % (loopTo - loopFrom);
        }
    };

    /// One plan being played.
    struct Piece
    {
        std::unique_ptr<ScenePlayer> player;
        std::optional<ProtectionParams> limits; ///< of the actuator, for what comes of several pieces
        std::shared_ptr<const PreviewSource> source;
        Way way;
        std::uint64_t start = 0;   ///< as Wanted
        std::int64_t position = 0; ///< frames since the start, of the player's next frame
        std::int64_t end = 0;      ///< frames since the start at which the clip ends
        std::int64_t builtTo = 0;  ///< frames since the start until which the player has something to play
    };

    struct Built
    {
        std::uint64_t version = 0;
        std::uint64_t start = 0;
    };

    Result<Piece> build(const Wanted& wanted, std::int64_t from) const;
    void take() noexcept;
    void catchUp(std::size_t frames) noexcept;
    [[nodiscard]] HandOver<Piece>::Node* fadingIn() const noexcept { return ready ? next : nullptr; }
    void processBlock(std::span<float> haptic, std::span<const std::span<float>> sound, std::size_t at,
                      std::size_t n) noexcept;
    void renderPiece(Piece& piece, std::span<float> out) noexcept;
    void keepWithinLimits(std::span<float> haptic) noexcept;
    void meter(std::span<const float> haptic) noexcept;
    void addSound(const Piece& piece, std::span<const std::span<float>> sound, std::size_t at, std::size_t n,
                  std::span<const float> gains) const noexcept;

    static constexpr std::size_t blockFrames = 512;

    const double fs;

    std::mutex mutex; ///< between [message] and [worker]
    Wanted wanted;
    Built built;

    HandOver<Piece> hand;
    std::atomic<std::uint64_t> wantedVersion{0};
    std::atomic<std::uint64_t> builtVersion{0};
    std::atomic<std::uint64_t> playing{0}; ///< Wanted::start of what plays; 0: stopped
    std::atomic<bool> hearHaptic{true}, hearSource{false};
    std::atomic<double> playhead{0.0};
    std::atomic<float> peakHeard{0.0f}, reductionHeard{0.0f}; ///< see takeMeters()
    std::atomic<std::int64_t> reached{0};                     ///< frames since the start
    std::atomic<std::uint64_t> reachedStart{0};               ///< the start that they count from
    std::atomic<std::int64_t> builtTo{0};

    // Of the audio thread.
    HandOver<Piece>::Node* current = nullptr;
    HandOver<Piece>::Node* next = nullptr; ///< fades in
    bool ready = false;                    ///< next has caught up with current
    std::size_t faded = 0;                 ///< frames of that fade
    double level = 0.0, hapticLevel = 1.0, sourceLevel = 0.0;
    std::optional<ProtectionParams> limits;
    Protection bounds; ///< behind all pieces
    std::array<float, blockFrames> oldSignal{}, newSignal{}, oldGains{}, newGains{};

public:
    PreviewEngine(const PreviewEngine&) = delete;
    PreviewEngine& operator=(const PreviewEngine&) = delete;
    ~PreviewEngine();
};

} // namespace pacini
