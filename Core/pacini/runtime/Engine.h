#pragma once

// Engine: clips that play at once on several actuators, started and changed while they play.

#include <pacini/foundation/Glide.h>
#include <pacini/foundation/Ring.h>
#include <pacini/foundation/Units.h>
#include <pacini/runtime/ActuatorKind.h>
#include <pacini/runtime/EngineMixer.h>
#include <pacini/runtime/EngineParams.h>
#include <pacini/runtime/EngineVoices.h>
#include <pacini/runtime/LiveCommand.h>
#include <pacini/runtime/LoadedClip.h>
#include <pacini/runtime/PlayContent.h>
#include <pacini/runtime/PlayMaker.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// A frame of the output at which something is known to be in some place, and how many frames after those that have
/// been rendered it may be exchanged at the soonest: as many as a block has, or it comes too late.
struct InTime
{
    std::int64_t at = 0; ///< as it is mixed: latencyFrames() ahead of the output
    std::size_t ahead = 0;
};

/// Engine. Plays clips on up to 16 actuators, each with its profile. Plays are made by a thread that may allocate and
/// wait ([message], one at a time), and handed to the audio thread, which mixes them ([audio]). A command names the
/// frame of the output at which it counts; one that comes too late counts at once. The output depends on the commands
/// and their frames alone, not on how it is cut into blocks, as long as they come latencyFrames() ahead.
class Engine
{
public:
    /// With a scene, that plays from frame 0 on as `pacini render` renders it. Errors: those of validate() and
    /// compilePlan(), and a scene made for another number of actuators (`scene.actuators`). [worker]
    [[nodiscard]] static Result<std::unique_ptr<Engine>> make(const EngineParams& params, const Scene* scene = nullptr)
    {
        if (auto valid = validate(params); !valid)
            return valid.error();
        if (scene != nullptr && static_cast<std::size_t>(scene->actuators) != params.actuators.size())
            return Error{ErrorCode::invalidArgument, "scene.actuators",
                         "is " + std::to_string(scene->actuators) + ", but the engine has " +
                             std::to_string(params.actuators.size())};
        auto kinds = makeActuatorKinds(params, scene);
        if (!kinds)
            return kinds.error();
        return std::unique_ptr<Engine>(new Engine(params, std::move(kinds).value()));
    }

    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    /// Neither thread may be at work.
    ~Engine()
    {
        LiveCommand command;
        while (commands.pop(command))
            freeCommand(command);
        while (!schedule.empty())
        {
            freeCommand(schedule.next());
            schedule.pop();
        }
        for (LivePlay* play : voices.plays())
            freePlay(play);
        collect();
    }

    // What may allocate and wait. [message]

    /// A play that begins at frame `frame` of the output. Errors: as PlayMaker::make(); tooLarge (`plays`, `commands`)
    /// when there are too many.
    [[nodiscard]] Result<PlayId> play(const std::shared_ptr<const LoadedClip>& clip, const PlaySettings& settings = {},
                                      std::int64_t frame = 0)
    {
        return startPlay(clip, settings, frame, {});
    }

    /// The same where `settings.from` is the place at frame `time.at`, which may have passed: it begins at the place
    /// that is due when it is ready.
    [[nodiscard]] Result<PlayId> play(const std::shared_ptr<const LoadedClip>& clip, const PlaySettings& settings,
                                      InTime time)
    {
        return startPlay(clip, settings, time.at, time);
    }

    /// A texture that begins at frame `frame` and plays until it is stopped, a day at most; its speed and force are
    /// controls of the play. Of `settings` what counts are controls, priority, group, fade and the seed of the
    /// variation. Errors: as play(); invalidArgument at `texture` for actuators that are all motors.
    [[nodiscard]] Result<PlayId> play(const std::shared_ptr<const Texture>& texture, PlaySettings settings,
                                      std::int64_t frame = 0)
    {
        if (!silence)
        {
            Clip day;
            day.duration = limits::duration;
            auto made = LoadedClip::asItIs(std::move(day));
            if (!made)
                return made.error();
            silence = std::move(*made);
        }
        settings.texture = texture;
        settings.from = settings.loop = settings.controls.transposition = settings.headroom = 0.0;
        settings.variation.amount = 0.0;
        settings.passes = 0;
        settings.controls.speed = 1.0;
        return startPlay(silence, settings, frame, {});
    }

    /// Sets a control of a play from frame `frame` on, in a glide (pitch, speed and priority step). Errors:
    /// invalidArgument for a play that has ended (`play`), for values out of range (`value`).
    Result<void> set(PlayId play, LiveControl control, double value, Seconds glide = Seconds(0.005),
                     std::int64_t frame = 0)
    {
        if (auto there = check(play); !there)
            return there;
        if (auto valid = checkControl(control, value, longestDelay); !valid)
            return valid;
        auto done = send(LiveCommand::Kind::set, play, control, value, glide, frame);
        if (done)
            apply(slots[play.slot].settings.controls, control, value);
        return done;
    }

    /// As set(), for all plays of a group. Its gain and the levels of its roles are faders of their own, which plays to
    /// come are under too.
    Result<void> setGroup(std::uint32_t group, LiveControl control, double value, Seconds glide = Seconds(0.005),
                          std::int64_t frame = 0)
    {
        if (group >= limits::groups)
            return Error{ErrorCode::invalidArgument, "group", "must be 0 to 31"};
        if (auto valid = checkControl(control, value, longestDelay); !valid)
            return valid;
        return send(LiveCommand::Kind::setGroup, {group, 0}, control, value, glide, frame);
    }

    Result<void> stop(PlayId play, Seconds fade = Seconds(0.005), std::int64_t frame = 0)
    {
        if (auto there = check(play); !there)
            return there;
        return send(LiveCommand::Kind::stop, play, {}, 0.0, fade, frame);
    }

    Result<void> stopGroup(std::uint32_t group, Seconds fade = Seconds(0.005), std::int64_t frame = 0)
    {
        if (group >= limits::groups)
            return Error{ErrorCode::invalidArgument, "group", "must be 0 to 31"};
        return send(LiveCommand::Kind::stopGroup, {group, 0}, {}, 0.0, fade, frame);
    }

    /// Waits where it is.
    Result<void> pause(PlayId play, Seconds fade = Seconds(0.005), std::int64_t frame = 0)
    {
        if (auto there = check(play); !there)
            return there;
        return send(LiveCommand::Kind::pause, play, {}, 0.0, fade, frame);
    }

    Result<void> resume(PlayId play, Seconds fade = Seconds(0.005), std::int64_t frame = 0)
    {
        if (auto there = check(play); !there)
            return there;
        return send(LiveCommand::Kind::resume, play, {}, 0.0, fade, frame);
    }

    /// Goes on at second `position` of the clip, 0 to a day, behind its end for one that is to end: what played fades
    /// into it.
    Result<void> seek(PlayId play, double position, std::int64_t frame = 0)
    {
        if (auto there = check(play); !there)
            return there;
        if (slots[play.slot].settings.texture)
            return Error{ErrorCode::invalidArgument, "position", "is none: a texture has no length"};
        if (!(position >= 0.0 && position <= limits::duration))
            return Error{ErrorCode::invalidArgument, "position", "must be 0 s or more, and a day at most"};
        return exchange(play, slots[play.slot].clip, position, frame);
    }

    /// Goes on with another clip, from where the play is or its end: hot reload.
    Result<void> replace(PlayId play, const std::shared_ptr<const LoadedClip>& clip, std::int64_t frame = 0)
    {
        if (auto there = check(play); !there)
            return there;
        return exchange(play, clip, slots[play.slot].position.load(std::memory_order_relaxed), frame);
    }

    /// The same, sample by sample in time: the play is at second `position` of its clip at frame `time.at`, which may
    /// have passed, and goes on where it would be when the other clip is ready.
    Result<void> replace(PlayId play, const std::shared_ptr<const LoadedClip>& clip, double position, InTime time)
    {
        if (auto there = check(play); !there)
            return there;
        return exchange(play, clip, position, time.at, time);
    }

    /// Another content of a play, which was made and waits to be handed over.
    struct Replacement
    {
        PlayId play;
        PlaySettings settings; ///< with which it goes on
        std::unique_ptr<PlayContent> content;
    };

    /// Prepares the replacement of a clip in all its plays, for replaceAll(). Changes nothing itself. Errors: as
    /// replace(), for any of them.
    [[nodiscard]] Result<std::vector<Replacement>> makeReplacements(const LoadedClip* old,
                                                                    const std::shared_ptr<const LoadedClip>& clip)
    {
        collect();
        std::vector<Replacement> made;
        for (std::uint32_t i = 0; i < slots.size(); ++i)
        {
            if (!slots[i].used || slots[i].clip.get() != old)
                continue;
            auto one = makeReplacement({i, slots[i].generation.load(std::memory_order_relaxed)}, clip,
                                       slots[i].position.load(std::memory_order_relaxed));
            if (!one)
                return one.error();
            made.push_back(std::move(one).value());
        }
        if (auto room = checkRoom(made.size()); !room)
            return room.error();
        return made;
    }

    /// Replaces a clip in all that plays of it by what makeReplacements() made since the last command.
    void replaceAll(const LoadedClip* old, const std::shared_ptr<const LoadedClip>& clip,
                    std::vector<Replacement>&& made)
    {
        for (Replacement& one : made)
            handOver(std::move(one), clip, 0);
        maker.forget(old);
    }

    /// Gain of an actuator behind its protection, 0 to 1.
    Result<void> setActuatorGain(std::size_t actuator, double gain, Seconds glide = Seconds(0.005),
                                 std::int64_t frame = 0)
    {
        if (actuator >= mixer.actuators())
            return Error{ErrorCode::invalidArgument, "actuator", "is not one of the engine's"};
        if (!(gain >= 0.0 && gain <= 1.0))
            return Error{ErrorCode::invalidArgument, "value", "must be 0 to 1"};
        return send(LiveCommand::Kind::setActuator, {static_cast<std::uint32_t>(actuator), 0}, {}, gain, glide, frame);
    }

    /// From the next block on.
    Result<void> setBudget(const EngineBudget& wanted)
    {
        if (!(wanted.nanosecondsPerFrame >= 0.0 && wanted.nanosecondsPerFrame <= 1e9))
            return Error{ErrorCode::invalidArgument, "budget", "must be 0 to 1e9 ns for a frame"};
        if (kinds.front().asRendered && (wanted.nanosecondsPerFrame > 0.0 || wanted.voices > 0))
            return Error{ErrorCode::invalidArgument, "budget",
                         "must not be set when the engine plays clips as rendered"};
        LiveCommand command;
        command.kind = LiveCommand::Kind::setBudget;
        command.value = wanted.nanosecondsPerFrame;
        command.glide = wanted.voices;
        return pushChecked(command, 0);
    }

    /// Forgets what was made of a clip.
    void forget(const LoadedClip* clip) { maker.forget(clip); }

    /// Frees what has ended. Every call that makes something does so.
    void collect() noexcept
    {
        RetiredPlay old;
        while (retired.pop(old))
        {
            if (old.play != nullptr)
                freePlay(old.play);
            delete old.content;
        }
    }

    // What any thread may ask. [any]

    [[nodiscard]] PlayStatus status(PlayId play) const noexcept
    {
        if (play.generation == 0 || play.slot >= slots.size())
            return {};
        const PlaySlot& slot = slots[play.slot];
        if (slot.generation.load(std::memory_order_acquire) != play.generation)
            return {};
        return {slot.state.load(std::memory_order_relaxed), slot.position.load(std::memory_order_relaxed)};
    }

    [[nodiscard]] EngineMeters meters() const noexcept
    {
        EngineMeters read = voices.meters();
        read.gainReduction = reductionNow.load(std::memory_order_relaxed);
        return read;
    }

    /// Frames that have been rendered.
    [[nodiscard]] std::int64_t framesRendered() const noexcept { return rendered.load(std::memory_order_relaxed); }

    /// How far ahead of its frame a command must come at least.
    [[nodiscard]] std::size_t latencyFrames() const noexcept { return mixer.latencyFrames(); }

    [[nodiscard]] std::size_t actuators() const noexcept { return mixer.actuators(); }
    [[nodiscard]] double sampleRate() const noexcept { return fs; }

    // The audio thread. [audio]

    /// Writes the next frames: one span for each actuator, all of the same length.
    void render(std::span<const std::span<float>> out) noexcept
    {
        take();
        if (out.empty())
            return;
        const std::size_t frames = out.front().size();
        while (preRoll > 0)
        {
            const std::size_t n = std::min(preRoll, EngineMixer::blockFrames);
            const auto unheard = mixer.unheard(n);
            renderPart(std::span(unheard).first(actuators()), 0, n);
            preRoll -= n;
        }
        for (std::size_t done = 0; done < frames;)
        {
            const std::size_t n = std::min(frames - done, EngineMixer::blockFrames);
            renderPart(out, done, n);
            done += n;
        }
        rendered.store(voices.frame() - static_cast<std::int64_t>(latencyFrames()), std::memory_order_relaxed);
        reductionNow.store(mixer.gainReduction(), std::memory_order_relaxed);
        voices.publish();
    }

private:
    static constexpr double swapSeconds = 0.01;

    Engine(const EngineParams& wanted, std::vector<ActuatorKind> madeKinds)
        : fs(wanted.sampleRate),
          longestDelay(wanted.longestDelay.value),
          kinds(std::move(madeKinds)),
          maker(kinds, fs, wanted.longestDelay),
          slots(wanted.maxPlays),
          commands(wanted.maxCommands),
          schedule(wanted.maxCommands + 1),
          retired(4 * wanted.maxPlays + wanted.maxCommands),
          voices(wanted, slots, retired),
          mixer(wanted, kinds),
          preRoll(mixer.latencyFrames())
    {
        for (std::size_t i = wanted.maxPlays; i-- > 0;)
            free.push_back(static_cast<std::uint32_t>(i));
    }

    // [message]

    /// 1 to 2^24 - 1, so that it fits in the handles of other languages.
    [[nodiscard]] static std::uint32_t nextGeneration(std::uint32_t generation) noexcept
    {
        return generation < 0xFFFFFFu ? generation + 1 : 1;
    }

    [[nodiscard]] Result<void> check(PlayId play) noexcept
    {
        collect();
        if (play.generation == 0 || play.slot >= slots.size() || !slots[play.slot].used ||
            slots[play.slot].generation.load(std::memory_order_relaxed) != play.generation)
            return Error{ErrorCode::invalidArgument, "play", "has ended"};
        return {};
    }

    [[nodiscard]] Result<void> checkRoom(std::size_t wanted = 1) const
    {
        if (commands.room() < wanted)
            return Error{ErrorCode::tooLarge, "commands", "too many commands are waiting; render the engine"};
        return {};
    }

    Result<PlayId> startPlay(const std::shared_ptr<const LoadedClip>& clip, const PlaySettings& settings,
                             std::int64_t frame, const std::optional<InTime>& time)
    {
        collect();
        if (free.empty())
            return Error{ErrorCode::tooLarge, "plays", "all voices of the engine are playing"};
        if (auto room = checkRoom(); !room)
            return room.error();
        for (const auto& [control, value] : valuesOf(settings.controls))
            if (auto valid = checkControl(control, value, longestDelay); !valid)
                return valid.error();
        auto content = maker.make(clip, settings);
        if (!content)
            return content.error();
        auto play = std::make_unique<LivePlay>();
        const std::uint32_t slot = free.back();
        PlaySlot& entry = slots[slot];
        play->slot = slot;
        play->generation = nextGeneration(entry.generation.load(std::memory_order_relaxed));
        play->group = settings.group;
        play->priority = settings.priority;
        play->order = sent;
        play->controls = settings.controls;
        play->content = std::move(content).value();
        play->measureContent();
        play->fadeIn = framesOfGlide(settings.fadeIn, fs);
        if (time)
            frame = advance(*play->content, *time);
        free.pop_back();
        entry.clip = clip;
        entry.settings = settings;
        entry.position.store(settings.from, std::memory_order_relaxed);
        entry.state.store(PlayState::waiting, std::memory_order_relaxed);
        entry.generation.store(play->generation, std::memory_order_release);
        entry.used = true;
        const PlayId id{slot, play->generation};
        LiveCommand command;
        command.kind = LiveCommand::Kind::start;
        command.slot = slot;
        command.generation = id.generation;
        command.play = play.release();
        push(command, frame);
        return id;
    }

    /// Brings what was made for frame `time.at` to the frame at which it can begin, and returns that.
    [[nodiscard]] std::int64_t advance(PlayContent& content, const InTime& time)
    {
        std::int64_t at = time.at;
        // That takes time too, a small part of what is played.
        for (int i = 0; i < 8; ++i)
        {
            const std::int64_t soonest = framesRendered() + static_cast<std::int64_t>(latencyFrames() + time.ahead);
            if (soonest <= at)
                break;
            maker.advance(content, soonest - at);
            at = soonest;
        }
        return at;
    }

    Result<void> exchange(PlayId play, const std::shared_ptr<const LoadedClip>& clip, double position,
                          std::int64_t frame, std::optional<InTime> time = {})
    {
        if (auto room = checkRoom(); !room)
            return room;
        auto made = makeReplacement(play, clip, position);
        if (!made)
            return made.error();
        if (time)
            frame = advance(*made->content, *time);
        handOver(std::move(made).value(), clip, frame);
        return {};
    }

    /// A loop is as long as the clip at most, and the place within it.
    Result<Replacement> makeReplacement(PlayId play, const std::shared_ptr<const LoadedClip>& clip, double position)
    {
        Replacement made{play, slots[play.slot].settings, nullptr};
        made.settings.loop = std::min(made.settings.loop, clip->duration());
        made.settings.from = clip == slots[play.slot].clip ? position : std::min(position, clip->duration());
        auto content = maker.make(clip, made.settings);
        if (!content)
            return content.error();
        made.content = std::move(content).value();
        return made;
    }

    /// There is room.
    void handOver(Replacement made, const std::shared_ptr<const LoadedClip>& clip, std::int64_t frame)
    {
        LiveCommand command;
        command.kind = LiveCommand::Kind::replace;
        command.slot = made.play.slot;
        command.generation = made.play.generation;
        command.glide = framesOfGlide(Seconds(swapSeconds), fs);
        command.content = made.content.release();
        push(command, frame);
        PlaySlot& slot = slots[made.play.slot];
        slot.settings.loop = made.settings.loop;
        slot.clip = clip;
    }

    Result<void> send(LiveCommand::Kind kind, PlayId play, LiveControl control, double value, Seconds glide,
                      std::int64_t frame)
    {
        LiveCommand command;
        command.kind = kind;
        command.control = control;
        command.slot = play.slot;
        command.generation = play.generation;
        command.value = value;
        command.glide = framesOfGlide(glide, fs);
        return pushChecked(command, frame);
    }

    Result<void> pushChecked(const LiveCommand& command, std::int64_t frame)
    {
        if (auto room = checkRoom(); !room)
            return room;
        push(command, frame);
        return {};
    }

    /// There is room.
    void push(LiveCommand command, std::int64_t frame) noexcept
    {
        command.frame = frame;
        command.sequence = ++sent;
        static_cast<void>(commands.push(command));
    }

    void freePlay(LivePlay* play) noexcept
    {
        PlaySlot& slot = slots[play->slot];
        slot.clip.reset();
        slot.used = false;
        slot.state.store(PlayState::ended, std::memory_order_relaxed);
        if (free.size() < free.capacity())
            free.push_back(play->slot);
        delete play->leaving;
        delete play;
    }

    void freeCommand(const LiveCommand& command) noexcept
    {
        if (command.play != nullptr)
            freePlay(command.play);
        delete command.content;
    }

    // [audio]

    void take() noexcept
    {
        LiveCommand command;
        while (!schedule.full() && commands.pop(command))
            schedule.push(command);
    }

    /// Frames [at, at + n) of `out`, at most EngineMixer::blockFrames: cut where a command, a joint of a loop or a
    /// decision comes.
    void renderPart(std::span<const std::span<float>> out, std::size_t at, std::size_t n) noexcept
    {
        const std::int64_t end = voices.frame() + static_cast<std::int64_t>(n);
        while (voices.frame() < end)
        {
            while (!schedule.empty() && schedule.next().frame <= voices.frame())
            {
                const LiveCommand command = schedule.next();
                schedule.pop();
                if (command.kind == LiveCommand::Kind::setActuator)
                    mixer.setGain(command.slot, command.value, command.glide);
                else
                    voices.carryOut(command);
            }
            voices.prepare();
            std::int64_t until = voices.nextCut(end);
            if (!schedule.empty())
                until = std::min(until, schedule.next().frame);
            const auto frames = static_cast<std::size_t>(until - voices.frame());
            mixer.mix(voices, out, at, frames);
            at += frames;
            voices.pass(until);
        }
    }

    double fs;
    double longestDelay;
    std::vector<ActuatorKind> kinds;
    PlayMaker maker;
    std::shared_ptr<const LoadedClip> silence; ///< a day, during which textures play
    std::vector<PlaySlot> slots;
    std::vector<std::uint32_t> free;
    std::uint64_t sent = 0;

    Ring<LiveCommand> commands;
    CommandSchedule schedule;
    Ring<RetiredPlay> retired;
    EngineVoices voices;
    EngineMixer mixer;
    std::size_t preRoll;

    std::atomic<std::int64_t> rendered{0};
    std::atomic<double> reductionNow{0.0};
};

} // namespace pacini
