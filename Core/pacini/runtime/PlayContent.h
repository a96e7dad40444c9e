#pragma once

// One active play of an engine: its prepared objects, and its processing on the audio thread.

#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Glide.h>
#include <pacini/runtime/PlayControls.h>
#include <pacini/runtime/PlayCost.h>
#include <pacini/synthesis/PlayVoice.h>
#include <pacini/synthesis/RenderPlan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// The faders of a group, which all of its plays are under.
struct GroupFaders
{
    Glide gain{1.0};
    PerRole<Glide> roles{Glide(1.0)};

    /// Goes on by `frames`. [audio]
    void skip(std::size_t frames) noexcept
    {
        gain.skip(frames);
        for (Glide& role : roles)
            role.skip(frames);
    }
};

/// What plays of a clip from some place on: a voice for each kind of actuator, twice where it loops without end, so
/// that one pass fades into the next. Made where memory may be allocated, used by the audio thread.
class PlayContent
{
public:
    static constexpr double joint = 0.01; ///< s in which one pass of a loop fades into the next

    struct Voice
    {
        PlannedPlay planned; ///< its clip is not needed any more
        PlayVoice voice;
    };

    /// Where a content begins, and how it was made.
    struct Params
    {
        double sampleRate = 48000.0;
        double loop = 0.0;          ///< s after which the other pass begins, where there are two
        double offset = 0.0;        ///< s of the clip that were cut off before
        std::int64_t played = 0;    ///< frames that the voices of the first pass have played already
        double transposition = 0.0; ///< semitones with which the decoders were made
        double speed = 1.0;
        PerRole<double> power; ///< of the roles of the clip
    };

    /// `madePasses[i]`: voices of pass i, in the order of the engine's kinds of actuators, prepared; one pass or two.
    PlayContent(std::vector<std::vector<Voice>> madePasses, const Params& wanted)
        : passes(std::move(madePasses)), params(wanted)
    {
    }

    /// Begins at frame `frame` with what is set. [audio]
    void begin(std::int64_t frame, const PlayControls& controls, const GroupFaders& group, std::size_t fadeIn) noexcept
    {
        current = 0;
        sounding = {true, false};
        for (std::size_t pass = 0; pass < passes.size(); ++pass)
            for (Voice& v : passes[pass])
            {
                v.voice.goOnAt(frame, pass == 0 ? params.played : 0);
                v.voice.setFader(Fader::play, controls.gain, 0);
                v.voice.setFader(Fader::intensity, controls.intensity, 0);
                follow(group.gain,
                       [&](double value, std::size_t frames) { v.voice.setFader(Fader::group, value, frames); });
                for (const Role role : allRoles)
                {
                    v.voice.setRole(role, RoleFader::play, controls.roles[role], 0);
                    follow(group.roles[role], [&](double value, std::size_t frames)
                           { v.voice.setRole(role, RoleFader::group, value, frames); });
                }
                v.voice.setPan(controls.pan, 0);
                v.voice.setDelay(controls.delay, 0);
                v.voice.setTextureSpeed(controls.textureSpeed, 0);
                v.voice.setTextureForce(controls.textureForce, 0);
                v.voice.setFader(Fader::leave, 1.0, 0);
                v.voice.setFader(Fader::fade, fadeIn > 0 ? 0.0 : 1.0, 0);
                v.voice.setFader(Fader::fade, 1.0, fadeIn);
            }
        change(controls);
    }

    /// Begins at frame `frame` in the place of another one, which fades out. [audio]
    void takeOver(PlayContent& other, std::int64_t frame, const PlayControls& controls, std::size_t frames) noexcept
    {
        begin(frame, controls, {}, frames);
        for (std::size_t kind = 0; kind < passes[0].size(); ++kind)
            passes[0][kind].voice.follow(other.passes[other.current][kind].voice);
        leaving = other.leaving;
        other.fadeOut(frames);
    }

    /// Plays the next `frames` unheard, before it begins. [worker]
    void advance(std::int64_t frames, MixBuffers& buffers) noexcept
    {
        for (Voice& v : passes[0])
            v.voice.skip(frames, buffers);
        params.played += frames;
    }

    template <typename Use>
    void forVoices(Use&& use) noexcept
    {
        for (auto& pass : passes)
            for (Voice& v : pass)
                use(v.voice);
    }

    /// Pitch and speed. [audio]
    void change(const PlayControls& controls) noexcept
    {
        if (!changed && controls.transposition == params.transposition && controls.speed == params.speed)
            return;
        changed = true;
        forVoices([&](PlayVoice& voice) { voice.change(controls.transposition, 1.0 / controls.speed); });
    }

    /// Fades out. [audio]
    void fadeOut(std::size_t frames) noexcept
    {
        leaving = true;
        forVoices([frames](PlayVoice& voice) { voice.setFader(Fader::leave, 0.0, frames); });
    }

    /// Fades in again after fadeOut(). [audio]
    void fadeIn(std::size_t frames) noexcept
    {
        leaving = false;
        forVoices([frames](PlayVoice& voice) { voice.setFader(Fader::leave, 1.0, frames); });
    }

    /// Live controls stand at frame `now` where they would if it had been mixed until then. [audio]
    void passGlides(std::int64_t now) noexcept
    {
        for (std::size_t pass = 0; pass < passes.size(); ++pass)
            if (sounding[pass])
                for (Voice& v : passes[pass])
                    v.voice.passGlides(now);
    }

    /// Goes on at frame `now`, unheard since it was mixed last; what is not in a joint of its loop any more ends.
    /// [audio]
    void catchUp(std::int64_t now) noexcept
    {
        passGlides(now);
        for (std::size_t pass = 0; pass < passes.size(); ++pass)
            if (sounding[pass] && !fadedAway(pass))
                for (Voice& v : passes[pass])
                    v.voice.catchUp(now);
    }

    /// Whether nothing of it sounds any more, or, after fadeOut(), can be heard.
    [[nodiscard]] bool ended() const noexcept
    {
        for (std::size_t pass = 0; pass < passes.size(); ++pass)
            if (sounding[pass] && !silent(pass))
                return false;
        return true;
    }

    /// Whether all that sounded has come to its own end, whatever fades out. [audio]
    [[nodiscard]] bool finished() const noexcept
    {
        for (std::size_t pass = 0; pass < passes.size(); ++pass)
            if (sounding[pass] && !fadedAway(pass) &&
                !std::all_of(passes[pass].begin(), passes[pass].end(), [](const Voice& v) { return v.voice.ended(); }))
                return false;
        return true;
    }

    /// Whether it has faded out, though it might go on.
    [[nodiscard]] bool fadedOut() const noexcept
    {
        const auto& voices = passes[current];
        return leaving && std::all_of(voices.begin(), voices.end(),
                                      [](const Voice& v) { return v.voice.fader(Fader::leave).resting(); });
    }

    /// Delays everything in it by `frames`, for which it waited. [audio]
    void shift(std::int64_t frames) noexcept
    {
        forVoices([&](PlayVoice& voice) { voice.shift(frames); });
    }

    /// The next frame before which it must be looked after: where a pass of a loop or a fade out ends. [audio]
    [[nodiscard]] std::int64_t nextCut(std::int64_t now) const noexcept
    {
        const std::size_t left = passes[current].front().voice.fader(Fader::leave).framesLeft();
        return leaving && left > 0 ? std::min(nextJoint(), now + static_cast<std::int64_t>(left)) : nextJoint();
    }

    /// The frame at which the other pass of a loop begins.
    [[nodiscard]] std::int64_t nextJoint() const noexcept
    {
        if (passes.size() < 2 || !sounding[current])
            return std::numeric_limits<std::int64_t>::max();
        const PlayVoice& voice = passes[current].front().voice;
        return voice.startFrame() +
               static_cast<std::int64_t>(std::ceil(voice.decoding()->frameAt(Seconds(params.loop))));
    }

    /// At the joint: the other pass begins. [audio]
    void passOn(std::int64_t frame, const PlayControls& controls) noexcept
    {
        const auto frames = static_cast<std::size_t>(joint * params.sampleRate + 0.5);
        for (Voice& v : passes[current])
            v.voice.setFader(Fader::fade, 0.0, frames);
        const auto& before = passes[current];
        current = 1 - current;
        sounding[current] = true;
        for (std::size_t kind = 0; kind < before.size(); ++kind)
        {
            Voice& v = passes[current][kind];
            v.voice.startAt(frame);
            v.voice.follow(before[kind].voice);
            if (changed)
                v.voice.change(controls.transposition, 1.0 / controls.speed);
            v.voice.setFader(Fader::fade, 0.0, 0);
            v.voice.setFader(Fader::fade, 1.0, frames);
        }
    }

    /// Adds the voices for one kind of actuator. [audio]
    void mix(std::size_t kind, const MixTarget& target, MixBuffers& buffers) noexcept
    {
        for (std::size_t pass = 0; pass < passes.size(); ++pass)
            if (sounding[pass] && !silent(pass))
            {
                Voice& v = passes[pass][kind];
                if (!v.voice.ended())
                    v.voice.mix(v.planned, target, false, buffers);
            }
    }

    /// The second of the clip that plays, or would at frame `now` if it had been mixed until then. [audio]
    [[nodiscard]] double clipTime() const noexcept { return params.offset + firstDecoder().clipTime(); }
    [[nodiscard]] double clipTimeAt(std::int64_t now) const noexcept
    {
        const std::int64_t played = now - passes[current].front().voice.startFrame();
        return params.offset + firstDecoder().clipTime(played - firstDecoder().framesPlayed());
    }

    /// The frame at which it ends by itself, as far as is known; never in a loop.
    [[nodiscard]] std::int64_t endFrame() const noexcept
    {
        return passes.size() > 1 ? std::numeric_limits<std::int64_t>::max()
                                 : passes[current].front().voice.startFrame() + firstDecoder().totalFrames();
    }

    /// Predicted time on the audio thread for a frame, ns, while some of the roles are heard. Of joints, which are
    /// rare, nothing is counted.
    [[nodiscard]] double cost(const PerRole<bool>& heard) const noexcept
    {
        double sum = 0.0;
        for (const Voice& v : passes[0])
        {
            const auto seconds = static_cast<double>(v.voice.decoding()->totalFrames()) / params.sampleRate;
            DecoderReport made = v.voice.decoding()->report();
            made.carriers = heard[Role::tones] ? made.carriers : 0;
            made.noiseBands = heard[Role::noise] ? made.noiseBands : 0;
            made.pulses = heard[Role::events] ? made.pulses : 0;
            made.levelled = made.levelled && made.carriers + made.noiseBands > 0;
            sum += PlayCost::of(made, seconds, v.planned.timeline.gains.size(), params.sampleRate);
            if (v.planned.texture && (heard[Role::noise] || heard[Role::tones]))
                sum += PlayCost::texture + PlayCost::tone * static_cast<double>(v.planned.texture->allTones().size());
        }
        return sum;
    }

    /// Mean of the power of the roles of the clip at gain 1, full drive = 1.
    [[nodiscard]] const PerRole<double>& power() const noexcept { return params.power; }

private:
    /// set(value, frames) stands and glides as `fader` does.
    template <typename Set>
    static void follow(const Glide& fader, Set&& set) noexcept
    {
        set(fader.now(), 0);
        if (!fader.resting())
            set(fader.goal(), fader.framesLeft());
    }

    [[nodiscard]] const Decoder& firstDecoder() const noexcept { return *passes[current].front().voice.decoding(); }

    /// Returns whether another pass has replaced this one.
    [[nodiscard]] bool fadedAway(std::size_t pass) const noexcept
    {
        return passes[pass].front().voice.fader(Fader::fade).restsAt(0.0);
    }

    [[nodiscard]] bool silent(std::size_t pass) const noexcept
    {
        const auto& voices = passes[pass];
        return fadedAway(pass) ||
               std::all_of(voices.begin(), voices.end(),
                           [](const Voice& v) { return v.voice.ended() || v.voice.fader(Fader::leave).restsAt(0.0); });
    }

    std::vector<std::vector<Voice>> passes;
    Params params;
    std::size_t current = 0;
    std::array<bool, 2> sounding{false, false};
    bool changed = false; // pitch or speed, ever
    bool leaving = false;
};

/// One play, with its current content and the replaced content that fades out.
struct LivePlay
{
    std::uint32_t slot = 0, generation = 0;
    std::uint32_t group = 0;
    int priority = 0;
    std::uint64_t order = 0; ///< among all plays that were started
    PerRole<double> power;   ///< of its content
    std::size_t fadeIn = 0;  ///< frames
    PlayControls controls;
    std::unique_ptr<PlayContent> content;

    // Of the audio thread:
    PlayContent* leaving = nullptr; ///< owned; given back when it is silent
    std::int64_t started = 0;
    std::int64_t pausedAt = 0;
    bool pausing = false, paused = false, stopping = false, leftOut = false;
    bool cold = false;                            ///< paused without having been played up to there
    double energy = 0.0, cost = 0.0, worth = 0.0; ///< at the last decision what is left out

    /// What it brings in a second, full drive = 1.
    [[nodiscard]] double energyUnder(const GroupFaders& faders) const noexcept
    {
        const double gain = controls.gain * controls.intensity * faders.gain.goal();
        double sum = 0.0;
        for (const Role role : allRoles)
        {
            const double level = controls.roles[role] * faders.roles[role].goal();
            sum += level * level * power[role];
        }
        return gain * gain * sum;
    }

    /// What it costs while the roles are heard that are not at 0, ns for a frame.
    [[nodiscard]] double costUnder(const GroupFaders& faders) const noexcept
    {
        std::size_t heard = 0;
        for (const Role role : allRoles)
            heard |= controls.roles[role] * faders.roles[role].goal() != 0.0 ? bitOf(role) : 0;
        return costs[heard];
    }

    /// Takes over what is predicted of its content.
    void measureContent() noexcept
    {
        power = content->power();
        for (std::size_t heard = 0; heard < costs.size(); ++heard)
        {
            PerRole<bool> roles;
            for (const Role role : allRoles)
                roles[role] = (heard & bitOf(role)) != 0;
            costs[heard] = content->cost(roles);
        }
    }

private:
    static constexpr std::size_t bitOf(Role role) noexcept { return std::size_t{1} << static_cast<std::size_t>(role); }

    std::array<double, std::size_t{1} << roleCount> costs{}; // by the roles that are heard
};

} // namespace pacini
