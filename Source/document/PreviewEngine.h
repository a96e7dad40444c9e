#pragma once

// Preview engine: plays a clip while it is edited, on the engine that games play it on.

#include "document/Playback.h"
#include "document/PreviewRow.h"
#include "document/PreviewSound.h"
#include "document/PreviewSource.h"
#include "io/StoredAudio.h"

#include <pacini/actuator/Protection.h>
#include <pacini/foundation/HandOver.h>
#include <pacini/foundation/Result.h>
#include <pacini/runtime/Engine.h>

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

/// Plays one clip on an Engine: edits, seeking, loops and live controls are its commands. What it does not have is
/// here: the sound beside the touch, bands that are soloed, the lead into a loop, and other actuators, for which there
/// is another engine that the old one fades into. From its start on, a clip is what `pacini render` renders, sample by
/// sample; an edit is heard within two blocks of its being built, and fades in within 10 ms.
///
/// Three threads may use it at once: [message] sets the content, [worker] calls service() whenever wantsService() (at
/// least every 100 ms while playing), [audio] calls process().
class PreviewEngine
{
public:
    /// `sampleRate` 2000 to 768000 Hz; at any other service() says so and nothing plays.
    explicit PreviewEngine(double sampleRate);

    /// Another clip, another loop, other bands soloed: heard once service() has run. [message]
    void set(Playback playback);

    /// The actuators, and the sound beside them (null: none). [any]
    void setRow(PreviewRow row);
    void setSource(std::shared_ptr<const StoredAudio> source);

    /// Live controls, which need nothing to be built: gain, intensity, pan (over the places of the row), transposition
    /// and speed. The sound follows the speed, with its pitch. [any]
    void setControls(const PlayControls& controls);

    /// Starts at `time` s of the clip, or jumps there while playing. [message]
    void play(double time);

    /// Stops within 5 ms. [message]
    void stop() noexcept { playing.store(0, std::memory_order_release); }

    /// Whether it plays; false once the end has been reached. [any]
    [[nodiscard]] bool isPlaying() const noexcept { return playing.load(std::memory_order_relaxed) != 0; }

    /// The playhead, s of the clip. [any]
    [[nodiscard]] double position() const noexcept { return playhead.load(std::memory_order_relaxed); }

    /// The most since the last call for an output; one reader. [any]
    [[nodiscard]] PreviewMeters takeMeters(std::size_t output = 0) noexcept;

    /// Whether service() has something to do. [any]
    [[nodiscard]] bool wantsService() const noexcept;

    /// Builds what has changed. Errors: those of Engine::make(), Engine::play() and of loops that cannot be built; what
    /// played goes on. [worker]
    Result<void> service();

    /// Writes the next frames of the drive signals, one for each actuator of the row, and of the sound (any number of
    /// channels; a mono sound goes to all). All spans have one length. [audio]
    void process(std::span<const std::span<float>> haptic, std::span<const std::span<float>> sound) noexcept;

private:
    static constexpr std::size_t blockFrames = 512;
    using Signals = std::array<std::array<float, blockFrames>, PreviewRow::most>;
    using Spans = std::array<std::span<float>, PreviewRow::most>;

    /// Latest request of the message thread.
    struct Wanted
    {
        Playback playback;
        PreviewRow row;
        std::shared_ptr<const StoredAudio> source;
        PlayControls controls;
        std::uint64_t version = 0;
        std::uint64_t start = 0; ///< counts calls of play()
        double startTime = 0.0;  ///< s of the clip
    };

    /// An engine for a row of actuators, and for the scene that it plays.
    struct Stage
    {
        std::shared_ptr<Engine> engine;
        std::uint64_t number = 0;
        std::size_t outputs = 1;
        std::array<std::size_t, PreviewRow::most> channels{};                 ///< of the engine, for each output
        std::array<std::optional<ProtectionParams>, PreviewRow::most> limits; ///< of each output
        std::optional<std::int64_t> since; ///< the frame of the preview that is its first; none: when it is taken
    };
    using StageNode = HandOver<Stage>::Node;
    using PlayNode = HandOver<PreviewPlay>::Node;

    /// Latest result of the worker.
    struct Made
    {
        std::uint64_t version = 0, start = 0, stage = 0;
        PreviewRow row;
        std::shared_ptr<const Scene> scene;
        std::shared_ptr<Engine> engine;
        PlayId play;
        PlaybackWay way;
        double place = 0.0; ///< of the clip, where the play is heard first
        double from = 0.0;  ///< s of what is played, where the play began
        std::shared_ptr<const Clip> heard;
        Audition audition;
        std::shared_ptr<const LoadedClip> clip;    ///< of `heard`
        std::shared_ptr<const LoadedClip> played;  ///< what the engine has of it
        std::shared_ptr<const StoredAudio> source; ///< that `resampled` is of
        std::shared_ptr<const PreviewSource> resampled;
        PlayControls controls;
        double transposition = 0.0; ///< with which the play was made
    };

    /// Where the newest play is, told by the audio thread.
    struct Here
    {
        std::uint64_t start = 0, stage = 0;
        double played = 0.0;     ///< s of what is played
        double heard = 0.0;      ///< the same as it is put out
        std::int64_t mixed = 0;  ///< frame of the engine at which `played` counts
        std::int64_t frames = 0; ///< of the preview
    };

    /// A value that one thread tells and others read, without waiting.
    class Told
    {
    public:
        void tell(const Here& here) noexcept;
        [[nodiscard]] Here read() const noexcept;

    private:
        std::atomic<std::uint64_t> count{0}; ///< odd: it is being written
        std::atomic<std::uint64_t> start{0}, stage{0};
        std::atomic<double> played{0.0}, heard{0.0};
        std::atomic<std::int64_t> mixed{0}, frames{0};
    };

    /// How a play begins.
    struct Begin
    {
        PlaybackWay way;
        double place = 0.0; ///< s of the clip
        PlayControls controls;
    };

    // [worker]
    Result<void> follow(const Wanted& now, const Here& here, bool started, bool counts);
    Result<void> playOnOther(const Wanted& now, const Begin& begin, std::optional<std::int64_t> since);
    Result<void> playAnew(const Wanted& now, const Begin& begin, std::optional<InTime> time);
    Result<void> playOn(const Wanted& now, const PlayControls& controls, double played, InTime time);
    Result<void> startPlay(const Wanted& now, const Begin& begin, Seconds fadeIn, std::optional<InTime> time);
    void tell(const Wanted& now);
    [[nodiscard]] Result<Stage> makeStage(const Wanted& now) const;
    Result<void> makeClip(const Wanted& now, const PlaybackWay& way);
    [[nodiscard]] PlayControls controlsFor(const Wanted& now) const noexcept;
    void setChanged(const PlayControls& controls);
    void endPlay(Seconds fade);

    // [audio]
    void take() noexcept;
    [[nodiscard]] bool catchUp(std::size_t frames) noexcept;
    void useNext() noexcept;
    void usePlay() noexcept;
    void endFade() noexcept;
    void processBlock(std::span<const std::span<float>> haptic, std::span<const std::span<float>> sound, std::size_t at,
                      std::size_t n) noexcept;
    void render(Stage& stage, Signals& signals, std::size_t n) noexcept;
    void keepWithinLimits(std::span<float> haptic, std::size_t output) noexcept;
    void meter(std::span<const float> haptic, std::size_t output) noexcept;
    void publish() noexcept;

    const double fs;

    std::mutex mutex; ///< between [message] and [worker]
    Wanted wanted;
    Made made; ///< the worker's

    HandOver<Stage> stages;
    HandOver<PreviewPlay> plays;
    Told told;
    std::atomic<std::uint64_t> wantedVersion{0};
    std::atomic<std::uint64_t> builtVersion{0};
    std::atomic<std::uint64_t> playing{0};            ///< Wanted::start of what plays; 0: stopped
    std::atomic<bool> alive{false};                   ///< the engine has a play
    std::atomic<bool> silent{true};                   ///< nothing is heard
    std::atomic<double> leadsFrom{0.0}, leadsTo{0.0}; ///< s of the clip where a lead may become its loop
    std::atomic<std::size_t> block{0};                ///< frames that process() was asked for last
    std::atomic<double> speed{1.0};
    std::atomic<bool> hearHaptic{true}, hearSource{false};
    std::atomic<double> playhead{0.0};
    std::array<std::atomic<float>, PreviewRow::most> peaks{}; ///< see takeMeters()
    std::atomic<float> reductionHeard{0.0f};

    // Of the audio thread.
    StageNode* stage = nullptr;
    StageNode* nextStage = nullptr; ///< waits, is brought to the place of `stage` and fades in
    PlayNode* current = nullptr;    ///< what is heard, of `stage` or, in a fade, of `nextStage`
    PlayNode* leaving = nullptr;    ///< fades out
    PlayNode* coming = nullptr;     ///< waits for its stage
    bool stageFades = false;
    std::size_t faded = 0; ///< frames of the fade to `current`
    PreviewSound sound, oldSound;
    std::int64_t frames = 0;
    bool quiet = true; ///< the engine has put out silence
    double level = 0.0, hapticLevel = 1.0, sourceLevel = 0.0;
    std::array<std::optional<ProtectionParams>, PreviewRow::most> limits;
    std::array<Protection, PreviewRow::most> bounds; ///< behind all stages
    Signals oldSignals{}, newSignals{};
    std::array<float, blockFrames> oldGains{}, newGains{};

public:
    PreviewEngine(const PreviewEngine&) = delete;
    PreviewEngine& operator=(const PreviewEngine&) = delete;
    ~PreviewEngine();
};

} // namespace pacini
