#pragma once

// Engine: clips that play at once on several actuators, started and changed while they play.

#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/Glide.h>
#include <pacini/foundation/Ring.h>
#include <pacini/foundation/Units.h>
#include <pacini/runtime/ActuatorKind.h>
#include <pacini/runtime/EngineParams.h>
#include <pacini/runtime/LiveCommand.h>
#include <pacini/runtime/LoadedClip.h>
#include <pacini/runtime/PlayContent.h>
#include <pacini/runtime/PlayMaker.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Identifier of a play: a slot and its use count. Identifiers of ended plays are invalid.
struct PlayId
{
    std::uint32_t slot = 0;
    std::uint32_t generation = 0; ///< 0 = no play
    bool operator==(const PlayId&) const = default;
};

enum class PlayState
{
    ended,   ///< or never there
    waiting, ///< for its frame
    playing,
    paused,
    leftOut ///< there is no time or voice for it
};

struct PlayStatus
{
    PlayState state = PlayState::ended;
    double position = 0.0; ///< s of the clip
};

/// A frame of the output at which something is known to be in some place, and how many frames after those that have
/// been rendered it may be exchanged at the soonest: as many as a block has, or it comes too late.
struct InTime
{
    std::int64_t at = 0; ///< as it is mixed: latencyFrames() ahead of the output
    std::size_t ahead = 0;
};

/// Statistics of an engine, for reports.
struct EngineMeters
{
    std::size_t playing = 0;     ///< plays that sound
    std::size_t leftOut = 0;     ///< plays for which there was no time or voice in the last block
    double cost = 0.0;           ///< predicted, ns per frame of all actuators: see PlayCost
    double leftOutError = -1000; ///< predicted, energy left out since the start, dB below all that was to play
    double gainReduction = 0.0;  ///< dB that the protection of any actuator took in the last block
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
        for (LivePlay* play : active)
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

    /// Sets a control of a play from frame `frame` on, in a glide (pitch, speed and priority step). Errors:
    /// invalidArgument for a play that has ended (`play`), for values out of range (`value`).
    Result<void> set(PlayId play, LiveControl control, double value, Seconds glide = Seconds(0.005),
                     std::int64_t frame = 0)
    {
        if (auto there = check(play); !there)
            return there;
        if (auto valid = checkValue(control, value); !valid)
            return valid;
        auto done = send(LiveCommand::Kind::set, play, control, value, glide, frame);
        if (done)
            remember(slots[play.slot], control, value);
        return done;
    }

    /// As set(), for all plays of a group. Its gain and the levels of its roles are faders of their own, which plays to
    /// come are under too.
    Result<void> setGroup(std::uint32_t group, LiveControl control, double value, Seconds glide = Seconds(0.005),
                          std::int64_t frame = 0)
    {
        if (group >= limits::groups)
            return Error{ErrorCode::invalidArgument, "group", "must be 0 to 31"};
        if (auto valid = checkValue(control, value); !valid)
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

    /// What takes the place of a clip in all that plays of it, for replaceAll(). Until then nothing changes. Errors: as
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
        if (actuator >= gains.size())
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
            return Error{ErrorCode::invalidArgument, "budget", "must be unset for plays as rendered"};
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
        Retired old;
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
        const Slot& slot = slots[play.slot];
        if (slot.generation.load(std::memory_order_acquire) != play.generation)
            return {};
        return {slot.state.load(std::memory_order_relaxed), slot.position.load(std::memory_order_relaxed)};
    }

    [[nodiscard]] EngineMeters meters() const noexcept
    {
        EngineMeters read;
        read.playing = playingNow.load(std::memory_order_relaxed);
        read.leftOut = leftOutNow.load(std::memory_order_relaxed);
        read.cost = costNow.load(std::memory_order_relaxed);
        const double all = energyAll.load(std::memory_order_relaxed), out = energyOut.load(std::memory_order_relaxed);
        read.leftOutError = out > 0.0 ? Decibels::fromPower(out / all).value : -1000.0;
        read.gainReduction = reductionNow.load(std::memory_order_relaxed);
        return read;
    }

    /// Frames that have been rendered.
    [[nodiscard]] std::int64_t framesRendered() const noexcept { return rendered.load(std::memory_order_relaxed); }

    /// How far ahead of its frame a command must come at least.
    [[nodiscard]] std::size_t latencyFrames() const noexcept { return latency; }

    [[nodiscard]] std::size_t actuators() const noexcept { return gains.size(); }
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
            const std::size_t n = std::min(preRoll, blockFrames);
            std::array<std::span<float>, limits::actuators> unheard;
            for (std::size_t a = 0; a < gains.size(); ++a)
                unheard[a] = std::span(discarded).subspan(a * blockFrames, n);
            renderPart(std::span(unheard).first(gains.size()), 0, n);
            preRoll -= n;
        }
        for (std::size_t done = 0; done < frames;)
        {
            const std::size_t n = std::min(frames - done, blockFrames);
            renderPart(out, done, n);
            done += n;
        }
        rendered.store(now - static_cast<std::int64_t>(latency), std::memory_order_relaxed);
        publish();
    }

private:
    static constexpr std::size_t blockFrames = MixBuffers::frames;
    static constexpr std::size_t decisionFrames = 256; // between two decisions what is left out
    static constexpr double fadeSeconds = 0.005, swapSeconds = 0.01;
    static constexpr double returnSeconds = 0.02; // of what was left out: see Decoder::settling

    struct Slot
    {
        // [message]
        bool used = false;
        std::shared_ptr<const LoadedClip> clip;
        PlaySettings settings;
        // [any]
        std::atomic<std::uint32_t> generation{0};
        std::atomic<PlayState> state{PlayState::ended};
        std::atomic<double> position{0.0};
    };

    struct Retired
    {
        LivePlay* play = nullptr;
        PlayContent* content = nullptr;
    };

    Engine(const EngineParams& wanted, std::vector<ActuatorKind> madeKinds)
        : fs(wanted.sampleRate),
          longestDelay(wanted.longestDelay.value),
          kinds(std::move(madeKinds)),
          maker(kinds, fs, wanted.longestDelay),
          slots(wanted.maxPlays),
          commands(wanted.maxCommands),
          schedule(wanted.maxCommands + 1),
          retired(4 * wanted.maxPlays + wanted.maxCommands),
          budget(wanted.budget)
    {
        for (std::size_t i = wanted.maxPlays; i-- > 0;)
            free.push_back(static_cast<std::uint32_t>(i));
        active.reserve(wanted.maxPlays);
        order.reserve(wanted.maxPlays);
        bySlot.assign(wanted.maxPlays, nullptr);
        groups.resize(limits::groups);
        for (const ActuatorKind& kind : kinds)
            latency = std::max(latency, kind.player->latencyFrames());
        preRoll = latency;
        const std::size_t count = wanted.actuators.size();
        taps.resize(count);
        for (const EngineActuator& actuator : wanted.actuators)
            gains.emplace_back(actuator.gain);
        for (const ActuatorKind& kind : kinds)
            for (const std::size_t a : kind.actuators)
            {
                const double frames =
                    wanted.actuators[a].delay.value * fs + static_cast<double>(latency - kind.player->latencyFrames());
                if (frames > 0.0)
                    taps[a].emplace(Tap{DelayTap(frames, blockFrames), frames});
            }
        discarded.resize(count * blockFrames);
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

    [[nodiscard]] Result<void> checkValue(LiveControl control, double value) const
    {
        struct Range
        {
            const char* where;
            double low, high;
            const char* message;
        };
        const std::array<Range, 10> ranges{{{"gain", 0.0, 1000.0, "must be 0 to 1000"},
                                            {"intensity", 0.0, 1.0, "must be 0 to 1"},
                                            {"pan", 0.0, 1.0, "must be 0 to 1"},
                                            {"delay", 0.0, longestDelay, "must be 0 to the engine's longest delay"},
                                            {"transposition", -96.0, 96.0, "must be -96 to 96 semitones"},
                                            {"speed", 0.01, 100.0, "must be 0.01 to 100"},
                                            {"priority", -1e9, 1e9, "must be -1e9 to 1e9"},
                                            {"tones", 0.0, 1000.0, "must be 0 to 1000"},
                                            {"events", 0.0, 1000.0, "must be 0 to 1000"},
                                            {"noise", 0.0, 1000.0, "must be 0 to 1000"}}};
        const Range& range = ranges[static_cast<std::size_t>(control)];
        if (!(value >= range.low && value <= range.high))
            return Error{ErrorCode::invalidArgument, range.where, range.message};
        return {};
    }

    [[nodiscard]] static std::array<std::pair<LiveControl, double>, 9> values(const PlayControls& c)
    {
        return {{{LiveControl::gain, c.gain},
                 {LiveControl::intensity, c.intensity},
                 {LiveControl::pan, c.pan},
                 {LiveControl::delay, c.delay},
                 {LiveControl::transposition, c.transposition},
                 {LiveControl::speed, c.speed},
                 {LiveControl::tones, c.roles[Role::tones]},
                 {LiveControl::events, c.roles[Role::events]},
                 {LiveControl::noise, c.roles[Role::noise]}}};
    }

    /// What a new content of the play would begin with.
    static void remember(Slot& slot, LiveControl control, double value) noexcept
    {
        apply(slot.settings.controls, control, value);
    }

    static void apply(PlayControls& controls, LiveControl control, double value) noexcept
    {
        switch (control)
        {
        case LiveControl::gain:
            controls.gain = value;
            break;
        case LiveControl::intensity:
            controls.intensity = value;
            break;
        case LiveControl::pan:
            controls.pan = value;
            break;
        case LiveControl::delay:
            controls.delay = value;
            break;
        case LiveControl::transposition:
            controls.transposition = value;
            break;
        case LiveControl::speed:
            controls.speed = value;
            break;
        case LiveControl::tones:
        case LiveControl::events:
        case LiveControl::noise:
            controls.roles[*roleOf(control)] = value;
            break;
        case LiveControl::priority:
            break;
        }
    }

    Result<PlayId> startPlay(const std::shared_ptr<const LoadedClip>& clip, const PlaySettings& settings,
                             std::int64_t frame, const std::optional<InTime>& time)
    {
        collect();
        if (free.empty())
            return Error{ErrorCode::tooLarge, "plays", "all voices of the engine are playing"};
        if (auto room = checkRoom(); !room)
            return room.error();
        for (const auto& [control, value] : values(settings.controls))
            if (auto valid = checkValue(control, value); !valid)
                return valid.error();
        auto content = maker.make(clip, settings);
        if (!content)
            return content.error();
        auto play = std::make_unique<LivePlay>();
        const std::uint32_t slot = free.back();
        Slot& entry = slots[slot];
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
            const std::int64_t soonest = framesRendered() + static_cast<std::int64_t>(latency + time.ahead);
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
        Slot& slot = slots[made.play.slot];
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
        Slot& slot = slots[play->slot];
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

    [[nodiscard]] std::int64_t frameOf(const LiveCommand& command) const noexcept
    {
        return std::max(command.frame, now);
    }

    /// Frames [at, at + n) of `out`, at most blockFrames: cut where a command, a joint of a loop or a decision comes.
    void renderPart(std::span<const std::span<float>> out, std::size_t at, std::size_t n) noexcept
    {
        const std::int64_t end = now + static_cast<std::int64_t>(n);
        while (now < end)
        {
            while (!schedule.empty() && schedule.next().frame <= now)
            {
                const LiveCommand command = schedule.next();
                schedule.pop();
                carryOut(command);
            }
            passLoops();
            if (now % static_cast<std::int64_t>(decisionFrames) == 0 || decisionDue)
                decide();
            std::int64_t until = std::min(end, (now / static_cast<std::int64_t>(decisionFrames) + 1) *
                                                   static_cast<std::int64_t>(decisionFrames));
            if (!schedule.empty())
                until = std::min(until, schedule.next().frame);
            for (const LivePlay* play : active)
                if (!play->paused)
                    until = std::min(until, std::max(play->content->nextCut(now), now + 1));
            const auto frames = static_cast<std::size_t>(until - now);
            mixFrames(out, at, frames);
            at += frames;
            now = until;
            retire();
        }
    }

    void passLoops() noexcept
    {
        for (LivePlay* play : active)
            if (!play->paused && play->content->nextJoint() <= now)
                play->content->passOn(now, play->controls);
    }

    /// What plays beside the scene on one kind of actuator.
    struct LiveMix
    {
        Engine& engine;
        std::size_t kind;
        void mix(std::span<const std::span<float>> out, std::size_t at, std::size_t n, std::int64_t frame) noexcept
        {
            for (LivePlay* play : engine.active)
            {
                if (play->leaving != nullptr)
                    play->leaving->mix(kind, {out, at, n, frame}, engine.buffers);
                play->content->mix(kind, {out, at, n, frame}, engine.buffers);
            }
        }
    };

    void mixFrames(std::span<const std::span<float>> out, std::size_t at, std::size_t n) noexcept
    {
        std::array<std::span<float>, limits::actuators> channels;
        for (std::size_t k = 0; k < kinds.size(); ++k)
        {
            const auto& actuators = kinds[k].actuators;
            for (std::size_t c = 0; c < actuators.size(); ++c)
                // What the caller does not want is played unheard: its protection goes on.
                channels[c] = actuators[c] < out.size() ? out[actuators[c]].subspan(at, n)
                                                        : std::span(discarded).subspan(actuators[c] * blockFrames, n);
            LiveMix live{*this, k};
            kinds[k].player->process(std::span(channels).first(actuators.size()), live);
        }
        for (std::size_t a = 0; a < std::min(out.size(), gains.size()); ++a)
            finish(a, out[a].subspan(at, n));
        for (GroupFaders& group : groups)
            group.skip(n);
    }

    void finish(std::size_t a, std::span<float> samples) noexcept
    {
        Glide& gain = gains[a];
        if (!gain.restsAt(1.0))
            for (float& sample : samples)
                sample = toSample(gain.next() * static_cast<double>(sample));
        if (taps[a])
        {
            taps[a]->line.write(samples);
            for (std::size_t i = 0; i < samples.size(); ++i)
                samples[i] = taps[a]->line.read(i, taps[a]->frames);
        }
    }

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
        case Kind::setActuator:
            gains[command.slot].glideTo(command.value, command.glide);
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

    [[nodiscard]] bool giveBack(const Retired& old) noexcept { return retired.push(old); }

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
               cost = PlayCost::actuator * static_cast<double>(gains.size()) +
                      PlayCost::waiting * static_cast<double>(order.size());
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

    void publish() noexcept
    {
        for (const LivePlay* play : active)
        {
            Slot& slot = slots[play->slot];
            slot.position.store(play->leftOut ? play->content->clipTimeAt(now) : play->content->clipTime(),
                                std::memory_order_relaxed);
            slot.state.store(play->leftOut  ? PlayState::leftOut
                             : play->paused ? PlayState::paused
                                            : PlayState::playing,
                             std::memory_order_relaxed);
        }
        double reduction = 0.0;
        for (const ActuatorKind& kind : kinds)
            for (std::size_t a = 0; a < kind.actuators.size(); ++a)
                if (const ProtectionMeter* meter = kind.player->protectionMeter(a))
                    reduction = std::max(reduction, meter->gainReduction);
        reductionNow.store(reduction, std::memory_order_relaxed);
    }

    double fs;
    double longestDelay;
    std::vector<ActuatorKind> kinds;
    PlayMaker maker;
    std::vector<Slot> slots;
    std::vector<std::uint32_t> free;
    std::uint64_t sent = 0;

    Ring<LiveCommand> commands;
    CommandSchedule schedule;
    Ring<Retired> retired;

    struct Tap
    {
        DelayTap line;
        double frames;
    };

    EngineBudget budget;
    std::vector<LivePlay*> active; // in order of start
    std::vector<LivePlay*> order;
    std::vector<LivePlay*> bySlot;
    std::vector<GroupFaders> groups;
    std::vector<Glide> gains;
    std::vector<std::optional<Tap>> taps;
    std::size_t latency = 0, preRoll = 0;
    std::int64_t now = 0; // frame that is mixed next: latencyFrames() ahead of the output
    std::int64_t decidedAt = 0;
    bool decisionDue = false;
    double powerAll = 0.0, powerOut = 0.0; // since the last decision
    MixBuffers buffers;
    std::vector<float> discarded;

    std::atomic<std::int64_t> rendered{0};
    std::atomic<std::size_t> playingNow{0}, leftOutNow{0};
    std::atomic<double> costNow{0.0}, energyAll{0.0}, energyOut{0.0}, reductionNow{0.0};
};

} // namespace pacini
