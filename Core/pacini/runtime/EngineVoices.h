#pragma once

// Voices of an engine: the plays that sound, what commands change of them, and which of them there is time for.

#include <pacini/foundation/Glide.h>
#include <pacini/foundation/Ring.h>
#include <pacini/foundation/Units.h>
#include <pacini/runtime/EngineParams.h>
#include <pacini/runtime/LiveCommand.h>
#include <pacini/runtime/PlaySlot.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// Statistics of an engine, for reports.
struct EngineMeters
{
    std::size_t playing = 0;     ///< plays that sound
    std::size_t leftOut = 0;     ///< plays for which there was no time or voice in the last block
    double cost = 0.0;           ///< predicted, ns per frame of all actuators: see PlayCost
    double leftOutError = -1000; ///< predicted, energy left out since the start, dB below all that was to play
    double gainReduction = 0.0;  ///< dB that the protection of any actuator took in the last block
};

/// Objects that the audio thread hands back for deletion.
struct RetiredPlay
{
    LivePlay* play = nullptr;
    PlayContent* content = nullptr;
};

/// Plays of an engine. [audio]
class EngineVoices
{
public:
    /// Plays get their states in `places`, and go into `back` when they have ended.
    EngineVoices(const EngineParams& params, std::vector<PlaySlot>& places, Ring<RetiredPlay>& back)
        : fs(params.sampleRate),
          actuators(static_cast<double>(params.actuators.size())),
          slots(places),
          retired(back),
          budget(params.budget),
          bySlot(params.maxPlays, nullptr),
          groups(limits::groups)
    {
        active.reserve(params.maxPlays);
        order.reserve(params.maxPlays);
    }

    /// The frame that is mixed next.
    [[nodiscard]] std::int64_t frame() const noexcept { return now; }
    /// Plays that have begun, in order of start.
    [[nodiscard]] std::span<LivePlay* const> plays() const noexcept { return active; }

    void carryOut(const LiveCommand& command) noexcept
    {
        using Kind = LiveCommand::Kind;
        switch (command.kind)
        {
        case Kind::start:
            begin(command.play);
            return;
        case Kind::setGroup:
            if (command.control == LiveControl::gain)
                groups[command.slot].gain.glideTo(command.value, command.glide);
            if (const auto role = roleOf(command.control))
                groups[command.slot].roles[*role].glideTo(command.value, command.glide);
            for (LivePlay* play : active)
                if (play->group == command.slot)
                    setControl(*play, command, true);
            return;
        case Kind::stopGroup:
            for (LivePlay* play : active)
                if (play->group == command.slot)
                    stopPlay(*play, command.glide);
            return;
        case Kind::setActuator: // of the mixer
            return;
        case Kind::setBudget:
            budget = {command.value, command.glide};
            decisionDue = true;
            return;
        case Kind::replace:
        case Kind::stop:
        case Kind::pause:
        case Kind::resume:
        case Kind::set:
            break;
        }
        LivePlay* play = bySlot[command.slot];
        if (play == nullptr || play->generation != command.generation)
        {
            if (command.content != nullptr)
                static_cast<void>(giveBack({nullptr, command.content}));
            return;
        }
        if (command.kind == Kind::replace)
            replaceContent(*play, command);
        else if (command.kind == Kind::stop)
            stopPlay(*play, command.glide);
        else if (command.kind == Kind::pause && !play->stopping && !play->paused)
            pausePlay(*play, command.glide);
        else if (command.kind == Kind::resume && !play->stopping && !play->leftOut)
        {
            if (play->paused)
                play->content->shift(now - play->pausedAt);
            play->pausing = play->paused = false;
            play->content->fadeIn(play->cold ? std::max(command.glide, returnFrames()) : command.glide);
            play->cold = false;
            decisionDue = limited();
        }
        else if (command.kind == Kind::set)
            setControl(*play, command, false);
    }

    /// Passes loops on and decides what is left out, before frames from frame() on are mixed.
    void prepare() noexcept
    {
        passLoops();
        if (now % decisionFrames == 0 || decisionDue)
            decide();
    }

    /// The frame up to which can be mixed in one go, `end` at most: until a joint of a loop or a decision comes.
    [[nodiscard]] std::int64_t nextCut(std::int64_t end) const noexcept
    {
        std::int64_t until = std::min(end, (now / decisionFrames + 1) * decisionFrames);
        for (const LivePlay* play : active)
            if (!play->paused)
                until = std::min(until, std::max(play->content->nextCut(now), now + 1));
        return until;
    }

    /// Adds all voices for one kind of actuator.
    void mix(std::size_t kind, const MixTarget& target, MixBuffers& buffers) noexcept
    {
        for (LivePlay* play : active)
        {
            if (play->leaving != nullptr)
                play->leaving->mix(kind, target, buffers);
            play->content->mix(kind, target, buffers);
        }
    }

    /// Goes on to frame `until`, which has been mixed up to.
    void pass(std::int64_t until) noexcept
    {
        for (GroupFaders& group : groups)
            group.skip(static_cast<std::size_t>(until - now));
        now = until;
        retire();
    }

    /// Tells states and places of the plays.
    void publish() noexcept
    {
        for (const LivePlay* play : active)
        {
            PlaySlot& slot = slots[play->slot];
            slot.position.store(play->leftOut ? play->content->clipTimeAt(now) : play->content->clipTime(),
                                std::memory_order_relaxed);
            slot.state.store(play->leftOut  ? PlayState::leftOut
                             : play->paused ? PlayState::paused
                                            : PlayState::playing,
                             std::memory_order_relaxed);
        }
    }

    /// All but the gain reduction. [any]
    [[nodiscard]] EngineMeters meters() const noexcept
    {
        EngineMeters read;
        read.playing = playingNow.load(std::memory_order_relaxed);
        read.leftOut = leftOutNow.load(std::memory_order_relaxed);
        read.cost = costNow.load(std::memory_order_relaxed);
        const double all = energyAll.load(std::memory_order_relaxed), out = energyOut.load(std::memory_order_relaxed);
        read.leftOutError = out > 0.0 ? Decibels::fromPower(out / all).value : -1000.0;
        return read;
    }

private:
    static constexpr std::int64_t decisionFrames = 256; // between two decisions what is left out
    static constexpr double fadeSeconds = 0.005;
    static constexpr double returnSeconds = 0.02; // of what was left out: see Decoder::settling

    void passLoops() noexcept
    {
        for (LivePlay* play : active)
            if (!play->paused && play->content->nextJoint() <= now)
                play->content->passOn(now, play->controls);
    }

    void begin(LivePlay* play) noexcept
    {
        play->started = now;
        play->content->begin(now, play->controls, groups[play->group], play->fadeIn);
        active.push_back(play);
        bySlot[play->slot] = play;
        decisionDue = limited(); // before anything of it sounds
        slots[play->slot].state.store(PlayState::playing, std::memory_order_relaxed);
    }

    void replaceContent(LivePlay& play, const LiveCommand& command) noexcept
    {
        if (play.leaving != nullptr)
            static_cast<void>(giveBack({nullptr, play.leaving})); // there is room for each command
        command.content->takeOver(*play.content, now, play.controls, command.glide);
        play.leaving = play.content.release();
        play.content.reset(command.content);
        play.measureContent();
        if (play.paused || play.pausing || play.stopping)
            play.content->fadeOut(0);
        else if (play.leftOut)
            play.content->fadeIn(0);
        play.leftOut = play.cold = false;
        decisionDue = limited();
    }

    void pausePlay(LivePlay& play, std::size_t frames) noexcept
    {
        if (play.leftOut)
        {
            play.content->catchUp(now);
            play.leftOut = false;
            play.cold = true;
        }
        play.content->fadeOut(frames);
        play.pausing = true;
        hold(play);
    }

    /// Holds a play that has faded out to be paused. One that has come to its end by then ends: a fade of which nothing
    /// is mixed any more would go on for ever, or not, as blocks are cut.
    void hold(LivePlay& play) const noexcept
    {
        if (!play.pausing || !play.content->fadedOut() || play.content->finished())
            return;
        play.pausing = false;
        play.paused = true;
        play.pausedAt = now;
    }

    static void stopPlay(LivePlay& play, std::size_t frames) noexcept
    {
        play.stopping = true;
        play.paused = play.pausing = false;
        play.content->fadeOut(frames);
    }

    /// `ofGroup`: by its group, whose faders are beside those of the play.
    void setControl(LivePlay& play, const LiveCommand& command, bool ofGroup) noexcept
    {
        if (play.leftOut && !play.paused)
        {
            if (command.control == LiveControl::transposition || command.control == LiveControl::speed)
                play.content->catchUp(now);
            else
                play.content->passGlides(now);
        }
        const double value = command.value;
        const std::size_t glide = command.glide;
        if (command.control == LiveControl::priority)
            play.priority = static_cast<int>(value);
        const std::optional<Role> role = roleOf(command.control);
        if (!ofGroup || (command.control != LiveControl::gain && !role))
            apply(play.controls, command.control, value);
        const auto each = [&](auto&& use)
        {
            play.content->forVoices(use);
            if (play.leaving != nullptr)
                play.leaving->forVoices(use);
        };
        switch (command.control)
        {
        case LiveControl::gain:
            each([&](PlayVoice& voice) { voice.setFader(ofGroup ? Fader::group : Fader::play, value, glide); });
            return;
        case LiveControl::intensity:
            each([&](PlayVoice& voice) { voice.setFader(Fader::intensity, value, glide); });
            return;
        case LiveControl::pan:
            each([&](PlayVoice& voice) { voice.setPan(value, glide); });
            return;
        case LiveControl::delay:
            each([&](PlayVoice& voice) { voice.setDelay(value, glide); });
            return;
        case LiveControl::transposition:
        case LiveControl::speed:
            play.content->change(play.controls);
            return;
        case LiveControl::tones:
        case LiveControl::events:
        case LiveControl::noise:
            each([&](PlayVoice& voice)
                 { voice.setRole(*role, ofGroup ? RoleFader::group : RoleFader::play, value, glide); });
            return;
        case LiveControl::textureSpeed:
            each([&](PlayVoice& voice) { voice.setTextureSpeed(value, glide); });
            return;
        case LiveControl::textureForce:
            each([&](PlayVoice& voice) { voice.setTextureForce(value, glide); });
            return;
        case LiveControl::priority:
            return;
        }
    }

    /// Gives back plays that have ended and contents that have been replaced.
    void retire() noexcept
    {
        for (std::size_t i = 0; i < active.size();)
        {
            LivePlay& play = *active[i];
            if (play.leaving != nullptr && play.leaving->ended())
                if (giveBack({nullptr, play.leaving}))
                    play.leaving = nullptr;
            hold(play);
            const bool silent = play.pausing ? play.content->finished() : play.content->ended();
            const bool over = play.leftOut ? leftOutIsOver(play) : !play.paused && silent && play.leaving == nullptr;
            if (over)
            {
                // Once it is given back, it may be freed at any time and its slot be another's.
                bySlot[play.slot] = nullptr;
                slots[play.slot].state.store(PlayState::ended, std::memory_order_relaxed);
                if (giveBack({&play, nullptr}))
                {
                    active.erase(active.begin() + static_cast<std::ptrdiff_t>(i));
                    continue;
                }
            }
            ++i;
        }
    }

    [[nodiscard]] bool leftOutIsOver(const LivePlay& play) const noexcept
    {
        return play.leaving == nullptr && (play.content->fadedOut() || play.content->ended()) &&
               (play.stopping || now >= play.content->endFrame());
    }

    [[nodiscard]] bool giveBack(const RetiredPlay& old) noexcept { return retired.push(old); }

    [[nodiscard]] bool limited() const noexcept { return budget.nanosecondsPerFrame > 0.0 || budget.voices > 0; }

    /// Decides what is left out until the next decision: plays are kept by priority, then by the energy that they
    /// bring for their time. What was left out comes back when there is room for it, and takes the place of what plays
    /// only when it brings twice as much, so that equals do not take turns.
    void decide() noexcept
    {
        decisionDue = false;
        const double seconds = static_cast<double>(now - decidedAt) / fs;
        decidedAt = now;
        energyAll.store(energyAll.load(std::memory_order_relaxed) + seconds * powerAll, std::memory_order_relaxed);
        energyOut.store(energyOut.load(std::memory_order_relaxed) + seconds * powerOut, std::memory_order_relaxed);

        order.assign(active.begin(), active.end());
        double all = 0.0, out = 0.0,
               cost = PlayCost::actuator * actuators + PlayCost::waiting * static_cast<double>(order.size());
        std::size_t voices = 0, left = 0;
        for (LivePlay* play : order)
        {
            play->energy = play->energyUnder(groups[play->group]);
            play->cost = play->costUnder(groups[play->group]);
            play->worth = play->energy / (budget.nanosecondsPerFrame > 0.0 ? play->cost : 1.0);
            if (play->leftOut)
                play->worth *= 0.5;
        }
        if (limited())
            std::sort(order.begin(), order.end(), isMoreImportant);
        for (LivePlay* play : order)
        {
            if (play->paused)
                continue;
            all += play->energy;
            const double more = play->cost;
            const bool fits = (budget.voices == 0 || voices < budget.voices) &&
                              (budget.nanosecondsPerFrame == 0.0 || cost + more <= budget.nanosecondsPerFrame);
            if (!fits)
            {
                if (!play->leftOut)
                    leaveOut(*play);
                out += play->energy;
                ++left;
                continue;
            }
            if (play->leftOut && !play->stopping)
                bringBack(*play);
            cost += more;
            ++voices;
        }
        playingNow.store(voices, std::memory_order_relaxed);
        leftOutNow.store(left, std::memory_order_relaxed);
        costNow.store(cost, std::memory_order_relaxed);
        powerAll = all;
        powerOut = out;
    }

    static bool isMoreImportant(const LivePlay* a, const LivePlay* b) noexcept
    {
        if (a->priority != b->priority)
            return a->priority < b->priority;
        if (a->worth != b->worth)
            return a->worth > b->worth;
        return a->order < b->order;
    }

    void leaveOut(LivePlay& play) noexcept
    {
        play.leftOut = !play.pausing; // that has faded out soon
        play.content->fadeOut(play.started == now ? 0 : framesOfGlide(Seconds(fadeSeconds), fs));
    }

    /// Where it would be by now.
    void bringBack(LivePlay& play) noexcept
    {
        play.leftOut = false;
        play.content->catchUp(now);
        play.content->fadeIn(returnFrames());
    }

    [[nodiscard]] std::size_t returnFrames() const noexcept { return framesOfGlide(Seconds(returnSeconds), fs); }

    double fs;
    double actuators; // how many
    std::vector<PlaySlot>& slots;
    Ring<RetiredPlay>& retired;
    EngineBudget budget;
    std::vector<LivePlay*> active; // in order of start
    std::vector<LivePlay*> order;
    std::vector<LivePlay*> bySlot;
    std::vector<GroupFaders> groups;
    std::int64_t now = 0;
    std::int64_t decidedAt = 0;
    bool decisionDue = false;
    double powerAll = 0.0, powerOut = 0.0; // since the last decision
    std::atomic<std::size_t> playingNow{0}, leftOutNow{0};
    std::atomic<double> costNow{0.0}, energyAll{0.0}, energyOut{0.0};
};

} // namespace pacini
