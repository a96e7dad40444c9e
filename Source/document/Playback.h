#pragma once

// Content of a preview: clip, loop and bands, and the mapping from played time to clip time.

#include <pacini/clip/Clip.h>
#include <pacini/clip/edits/Audition.h>
#include <pacini/foundation/Result.h>
#include <pacini/synthesis/Scene.h>

#include <memory>
#include <optional>
#include <utility>

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
    /// What plays together with the clip, on as many actuators as the row has; null: nothing. Live controls do not act
    /// on it, and there are none then.
    std::shared_ptr<const Scene> scene = nullptr;

    [[nodiscard]] const std::shared_ptr<const Clip>& heard() const noexcept { return take == Take::b && b ? b : a; }
};

/// A scene by itself, which lasts `duration` s.
[[nodiscard]] inline Playback scenePlayback(std::shared_ptr<const Scene> scene, double duration)
{
    Clip silent;
    silent.duration = duration;
    Playback playback;
    playback.a = std::make_shared<const Clip>(std::move(silent));
    playback.scene = std::move(scene);
    return playback;
}

/// How the seconds that an engine plays lie in the clip.
struct PlaybackWay
{
    enum class Kind
    {
        once, ///< the clip
        loop, ///< the loop alone, again and again
        lead  ///< the clip to the end of its loop and some passes of it: what comes before a loop
    };
    Kind kind = Kind::once;
    double loopFrom = 0.0, loopTo = 0.0; ///< s of the clip, whole frames; equal: no loop
    double end = 0.0;                    ///< of the clip, s
    bool operator==(const PlaybackWay&) const = default;

    /// Whether it would lead into the loop that another one is on.
    [[nodiscard]] bool onLoopOf(const PlaybackWay& other) const noexcept
    {
        return kind == Kind::lead && other.kind == Kind::loop && loopFrom == other.loopFrom && loopTo == other.loopTo &&
               end == other.end;
    }

    /// Where second `played` of what is played lies in the clip; in a loop also of what is a little before its start.
    [[nodiscard]] double placeOf(double played) const noexcept;
    /// The second of what is played that is at a place of the clip.
    [[nodiscard]] double playedAt(double place) const noexcept { return kind == Kind::loop ? place - loopFrom : place; }
    /// Until where, s of the clip, a lead that is in its loop can become the loop alone without skipping far.
    [[nodiscard]] double startOfLoop() const noexcept;
    [[nodiscard]] bool nearStartOfLoop(double place) const noexcept
    {
        return place >= loopFrom && place < startOfLoop();
    }
};

/// The way of a play from `place` s on. Loops are whole frames at `fs`, so that clip and sound stay together however
/// often they go round.
[[nodiscard]] PlaybackWay wayOf(const Playback& playback, double place, double fs);

/// The clip that is played on that way; the whole of it is repeated where its kind is `loop`. Errors: those of
/// repeatClip() and joinClips().
[[nodiscard]] Result<Clip> playedClip(const Playback& playback, const PlaybackWay& way);

} // namespace pacini
