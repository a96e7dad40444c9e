#include "document/PreviewEngine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace pacini
{

namespace
{
/// Bounds that nothing meets which was kept within the limits of the profile already; null: it has none to keep.
std::optional<ProtectionParams> boundsBehind(const Profile& profile)
{
    constexpr double apart = 1.0 + 1e-6; // more than rounding
    ProtectionParams params = protectionParams(profile, Seconds(0.0));
    params.boundsAlone = true;
    if (profile.technology == Technology::erm) // nothing swings
        params.excursion.reset();
    if (params.excursion)
        params.excursion->maxExcursion *= apart;
    if (params.heat)
        params.heat->maxPower *= apart;
    return params.excursion || params.heat ? std::optional(params) : std::nullopt;
}

constexpr double fadeSeconds = 0.010;
constexpr double rampSeconds = 0.005; // of starting, stopping and switching
constexpr double silence = 1e-9;      // of full drive
constexpr double pastSeconds = 2.0;   // that another engine has played before it is heard
} // namespace

// What [worker] and [audio] tell each other.

void PreviewEngine::Told::tell(const Here& here) noexcept
{
    const std::uint64_t before = count.load(std::memory_order_relaxed);
    count.store(before + 1, std::memory_order_relaxed);
    std::atomic_thread_fence(std::memory_order_release);
    start.store(here.start, std::memory_order_relaxed);
    stage.store(here.stage, std::memory_order_relaxed);
    played.store(here.played, std::memory_order_relaxed);
    heard.store(here.heard, std::memory_order_relaxed);
    mixed.store(here.mixed, std::memory_order_relaxed);
    frames.store(here.frames, std::memory_order_relaxed);
    count.store(before + 2, std::memory_order_release);
}

PreviewEngine::Here PreviewEngine::Told::read() const noexcept
{
    for (;;)
    {
        const std::uint64_t before = count.load(std::memory_order_acquire);
        const Here here{start.load(std::memory_order_relaxed),  stage.load(std::memory_order_relaxed),
                        played.load(std::memory_order_relaxed), heard.load(std::memory_order_relaxed),
                        mixed.load(std::memory_order_relaxed),  frames.load(std::memory_order_relaxed)};
        std::atomic_thread_fence(std::memory_order_acquire);
        if (before % 2 == 0 && count.load(std::memory_order_relaxed) == before)
            return here;
    }
}

PreviewEngine::PreviewEngine(double sampleRate) : fs(sampleRate)
{
    for (Protection& each : bounds)
        each.prepare({fs, blockFrames});
}

PreviewEngine::~PreviewEngine()
{
    for (StageNode* node : {stage, nextStage})
        delete node;
    for (PlayNode* node : {current, leaving, coming})
        delete node;
}

// What is asked for.

void PreviewEngine::set(Playback playback)
{
    hearHaptic.store(playback.haptic, std::memory_order_relaxed);
    hearSource.store(playback.source, std::memory_order_relaxed);
    const std::lock_guard lock(mutex);
    const Playback& old = wanted.playback;
    const bool same = old.heard() == playback.heard() && old.loop == playback.loop &&
                      old.audition == playback.audition && old.scene == playback.scene;
    wanted.playback = std::move(playback);
    if (!same)
        wantedVersion.store(++wanted.version, std::memory_order_release);
}

void PreviewEngine::setRow(PreviewRow row)
{
    const std::lock_guard lock(mutex);
    if (row == wanted.row)
        return;
    wanted.row = std::move(row);
    wantedVersion.store(++wanted.version, std::memory_order_release);
}

void PreviewEngine::setSource(std::shared_ptr<const StoredAudio> source)
{
    const std::lock_guard lock(mutex);
    wanted.source = std::move(source);
    wantedVersion.store(++wanted.version, std::memory_order_release);
}

void PreviewEngine::setControls(const PlayControls& controls)
{
    const std::lock_guard lock(mutex);
    wanted.controls = controls;
    wantedVersion.store(++wanted.version, std::memory_order_release);
}

void PreviewEngine::play(double time)
{
    const std::lock_guard lock(mutex);
    ++wanted.start;
    wanted.startTime = std::isfinite(time) ? std::max(0.0, time) : 0.0;
    wantedVersion.store(++wanted.version, std::memory_order_release);
    playing.store(wanted.start, std::memory_order_release);
}

PreviewMeters PreviewEngine::takeMeters(std::size_t output) noexcept
{
    PreviewMeters read;
    if (output < peaks.size())
        read.peak = static_cast<double>(peaks[output].exchange(0.0f, std::memory_order_relaxed));
    read.gainReduction = static_cast<double>(reductionHeard.exchange(0.0f, std::memory_order_relaxed));
    return read;
}

// What the worker builds.

bool PreviewEngine::wantsService() const noexcept
{
    if (wantedVersion.load(std::memory_order_acquire) != builtVersion.load(std::memory_order_relaxed))
        return true;
    if (!isPlaying())
        return alive.load(std::memory_order_relaxed);
    const double here = position();
    return here >= leadsFrom.load(std::memory_order_relaxed) && here < leadsTo.load(std::memory_order_relaxed);
}

Result<void> PreviewEngine::service()
{
    stages.collect();
    plays.collect();
    Wanted now;
    {
        const std::lock_guard lock(mutex);
        now = wanted;
    }
    if (made.engine)
        made.engine->collect();
    const Here here = told.read();
    const bool started = now.start != made.start;
    const bool counts = !started && here.start == now.start && here.stage == made.stage;
    const bool loops =
        made.way.kind == PlaybackWay::Kind::lead && counts && made.way.nearStartOfLoop(made.way.placeOf(here.played));
    if (now.version == made.version && !loops && isPlaying())
        return {};
    // Whatever comes of it: a clip that cannot be built is not tried again and again.
    made.version = now.version;
    builtVersion.store(now.version, std::memory_order_relaxed);
    leadsTo.store(0.0, std::memory_order_relaxed);
    if (!isPlaying()) // play() makes it anew
    {
        endPlay(Seconds(silent.load(std::memory_order_relaxed) ? 0.0 : rampSeconds));
        return {};
    }
    Result<void> done;
    if (now.playback.heard())
        done = follow(now, here, started, counts);
    if (auto expected = now.start; started && (!now.playback.heard() || !done))
        playing.compare_exchange_strong(expected, 0);
    if (made.way.kind == PlaybackWay::Kind::lead)
    {
        leadsFrom.store(made.way.loopFrom, std::memory_order_relaxed);
        leadsTo.store(made.way.startOfLoop(), std::memory_order_relaxed);
    }
    return done;
}

/// `started`: from another place; `counts`: `here` tells where the play is, or else it has not been heard yet.
Result<void> PreviewEngine::follow(const Wanted& now, const Here& here, bool started, bool counts)
{
    if (counts && made.engine->status(made.play).state == PlayState::ended)
        return {};
    // A scene plays from the first frame of its engine on.
    const bool otherRow = !made.engine || now.row != made.row || now.playback.scene != made.scene ||
                          (started && made.scene) || (!started && !counts && here.stage != made.stage);
    // Another engine begins where the output is, and is brought to where that is by then.
    const double place = std::clamp(started  ? std::round(now.startTime * fs) / fs
                                    : counts ? made.way.placeOf(otherRow ? here.heard : here.played)
                                             : made.place,
                                    0.0, now.playback.heard()->duration);
    PlaybackWay way = wayOf(now.playback, place, fs);
    const bool sameClip = made.heard == now.playback.heard() && made.audition == now.playback.audition;
    if (counts && !otherRow && sameClip && way.onLoopOf(made.way))
        way = made.way; // a loop is left for a lead into it only where it would have to be made anew
    // What is behind its lead is in the loop.
    const bool otherWay =
        started || !counts || way != made.way || (way.kind == PlaybackWay::Kind::lead && here.played >= way.loopTo);
    const std::shared_ptr<const LoadedClip> before = made.clip;
    if (auto done = makeClip(now, way); !done)
        return done;
    const PlayControls controls = controlsFor(now);
    speed.store(controls.speed, std::memory_order_relaxed);
    const InTime inTime{here.mixed, block.load(std::memory_order_relaxed)};
    Result<void> done;
    if (otherRow)
        done = playOnOther(now, {way, place, controls}, counts ? std::optional(here.frames) : std::nullopt);
    else if (otherWay)
        done = playAnew(now, {way, place, controls}, counts ? std::optional(inTime) : std::nullopt);
    else
        done = playOn(now, controls, here.played, inTime);
    if (before && before != made.clip)
        made.engine->forget(before.get());
    return done;
}

/// On an engine for the row, whose first frame is frame `since` of the preview.
Result<void> PreviewEngine::playOnOther(const Wanted& now, const Begin& begin, std::optional<std::int64_t> since)
{
    auto built = makeStage(now);
    if (!built)
        return built.error();
    made.row = now.row;
    made.scene = now.playback.scene;
    made.engine = built->engine;
    made.stage = built->number;
    const double ramp = !since && begin.place > 0.0 ? rampSeconds : 0.0;
    // Filters and protection of an actuator that plays have a past, and a scene has begun at its start.
    const double passed = begin.way.playedAt(begin.place) / begin.controls.speed;
    const double before = made.scene ? passed : since ? std::min(pastSeconds, passed) : 0.0;
    const auto past = static_cast<std::int64_t>(std::floor(before * fs));
    Begin earlier = begin;
    earlier.place -= static_cast<double>(past) * begin.controls.speed / fs;
    if (auto begun = startPlay(now, earlier, Seconds(ramp), {}); !begun)
        return begun;
    made.place = begin.place;
    std::vector<float> unheard(built->outputs * blockFrames);
    for (std::int64_t left = past; left > 0;)
    {
        const auto n = static_cast<std::size_t>(std::min<std::int64_t>(left, blockFrames));
        std::vector<std::span<float>> nowhere;
        for (std::size_t c = 0; c < built->outputs; ++c)
            nowhere.push_back(std::span(unheard).subspan(c * blockFrames, n));
        built->engine->render(nowhere);
        left -= static_cast<std::int64_t>(n);
    }
    if (since)
        built->since = *since - past;
    stages.send(std::move(built).value());
    tell(now);
    return {};
}

/// From another place or another way, on the same engine.
Result<void> PreviewEngine::playAnew(const Wanted& now, const Begin& begin, std::optional<InTime> time)
{
    const PlayId old = made.play;
    const bool fromSilence = silent.load(std::memory_order_relaxed);
    const double ramp = !fromSilence ? fadeSeconds : begin.place > 0.0 ? rampSeconds : 0.0;
    const auto end = [&](double fade)
    {
        if (old.generation != 0)
            static_cast<void>(made.engine->stop(old, Seconds(fade))); // or it has ended
    };
    if (fromSilence)
        end(0.0);
    if (auto begun = startPlay(now, begin, Seconds(ramp), time); !begun)
        return begun;
    tell(now);
    if (!fromSilence)
        end(fadeSeconds); // when the audio thread can know of the new one
    return {};
}

/// What plays goes on, changed.
Result<void> PreviewEngine::playOn(const Wanted& now, const PlayControls& controls, double played, InTime time)
{
    setChanged(controls);
    // Pitches are made with room up to what is wanted.
    if (made.played != made.clip || controls.transposition > made.transposition)
    {
        if (auto done = made.engine->replace(made.play, made.clip, played, time); !done)
            return done;
        made.played = made.clip;
        made.transposition = controls.transposition;
    }
    if (made.source != now.source)
        tell(now);
    return {};
}

Result<void> PreviewEngine::startPlay(const Wanted& now, const Begin& begin, Seconds fadeIn, std::optional<InTime> time)
{
    PlaySettings settings;
    settings.controls = begin.controls;
    settings.fadeIn = fadeIn;
    settings.from = begin.way.playedAt(begin.place);
    settings.loop = begin.way.kind == PlaybackWay::Kind::loop ? made.clip->duration() : 0.0;
    const auto begun = time ? made.engine->play(made.clip, settings, *time) : made.engine->play(made.clip, settings);
    if (!begun)
        return begun.error();
    made.play = *begun;
    made.played = made.clip;
    made.way = begin.way;
    made.place = begin.place;
    made.from = settings.from;
    made.start = now.start;
    made.controls = begin.controls;
    made.transposition = begin.controls.transposition;
    return {};
}

/// The audio thread follows what has been made.
void PreviewEngine::tell(const Wanted& now)
{
    // Between rates that share no large divisor the filter has millions of taps.
    if (std::exchange(made.source, now.source) != now.source)
        made.resampled = PreviewSource::of(now.source, static_cast<int>(std::lround(fs)));
    alive.store(true, std::memory_order_relaxed);
    plays.send({made.start, made.stage, made.play, made.way, made.from, made.resampled});
}

Result<PreviewEngine::Stage> PreviewEngine::makeStage(const Wanted& now) const
{
    const PreviewRow& row = now.row;
    const std::size_t count = row.profiles.size();
    if (count < 1 || count > PreviewRow::most)
        return Error{ErrorCode::invalidArgument, "row", "must have 1 to 8 actuators"};
    const RowPlaces places = row.rowPlaces();
    EngineParams params;
    params.sampleRate = fs;
    params.actuators.resize(count);
    params.panLaw = row.pan.value_or(PanLaw::delay);
    if (!row.pan)
        params.panDelay = Seconds(0.0);
    params.longestDelay = Seconds(0.0);
    params.maxPlays = 16;
    params.maxCommands = 1024;
    params.asRendered = true;
    params.adaptation.strength = row.strength;
    Stage built;
    built.number = made.stage + 1;
    built.outputs = count;
    for (std::size_t i = 0; i < count; ++i)
    {
        const auto& profile = row.profiles[i];
        built.channels[i] = places.rank(i);
        if (!profile)
            continue;
        params.actuators[places.rank(i)].profile = *profile;
        built.limits[i] = boundsBehind(*profile);
    }
    std::optional<Scene> scene;
    if (now.playback.scene)
    {
        scene = *now.playback.scene;
        scene->actuators = static_cast<int>(count);
    }
    auto engine = Engine::make(params, scene ? &*scene : nullptr);
    if (!engine)
        return engine.error();
    built.engine = std::move(engine).value();
    return built;
}

Result<void> PreviewEngine::makeClip(const Wanted& now, const PlaybackWay& way)
{
    const auto& heard = now.playback.heard();
    if (made.clip && made.heard == heard && made.audition == now.playback.audition && made.way == way)
        return {};
    auto clip = playedClip(now.playback, way);
    if (!clip)
        return clip.error();
    auto loaded = LoadedClip::asItIs(std::move(clip).value());
    if (!loaded)
        return loaded.error();
    made.clip = std::move(loaded).value();
    made.heard = heard;
    made.audition = now.playback.audition;
    return {};
}

PlayControls PreviewEngine::controlsFor(const Wanted& now) const noexcept
{
    if (now.playback.scene)
        return {};
    PlayControls controls = now.controls;
    const RowPlaces places = now.row.rowPlaces();
    controls.delay = 0.0;
    controls.pan = now.row.pan ? places.onRow(controls.pan) : 0.5;
    if (!now.row.pan) // the engine's row shares a play's power
        controls.gain *= std::sqrt(static_cast<double>(places.size()));
    return controls;
}

void PreviewEngine::setChanged(const PlayControls& controls)
{
    const auto set = [&](LiveControl control, double& before, double value)
    {
        if (before == value || !made.engine->set(made.play, control, value, Seconds(fadeSeconds)))
            return;
        before = value;
    };
    set(LiveControl::gain, made.controls.gain, controls.gain);
    set(LiveControl::intensity, made.controls.intensity, controls.intensity);
    set(LiveControl::pan, made.controls.pan, controls.pan);
    set(LiveControl::transposition, made.controls.transposition, controls.transposition);
    set(LiveControl::speed, made.controls.speed, controls.speed);
}

void PreviewEngine::endPlay(Seconds fade)
{
    alive.store(false, std::memory_order_relaxed);
    if (made.engine && made.play.generation != 0)
        static_cast<void>(made.engine->stop(made.play, fade)); // or it has ended
    made.play = {};
}

// What the audio thread plays.

void PreviewEngine::take() noexcept
{
    if (stages.waiting() && !stageFades)
    {
        stages.giveBack(nextStage);
        nextStage = stages.receive();
    }
    if (plays.waiting())
    {
        plays.giveBack(coming);
        coming = plays.receive();
    }
}

/// Whether the next stage is where the present one is. It may be brought there at a cost that stays bounded in every
/// block.
bool PreviewEngine::catchUp(std::size_t wantedFrames) noexcept
{
    Stage& next = nextStage->content;
    if (!next.since)
        return true;
    const std::int64_t behind = frames - *next.since - next.engine->framesRendered();
    auto left =
        std::min<std::int64_t>(behind, static_cast<std::int64_t>(std::max<std::size_t>(8 * wantedFrames, 4096)));
    const bool reaches = left == behind;
    while (left > 0)
    {
        const auto n = static_cast<std::size_t>(std::min<std::int64_t>(left, blockFrames));
        render(next, newSignals, n);
        left -= static_cast<std::int64_t>(n);
    }
    return reaches;
}

void PreviewEngine::endFade() noexcept
{
    plays.giveBack(std::exchange(leaving, nullptr));
    if (!stageFades)
        return;
    stages.giveBack(stage);
    stage = std::exchange(nextStage, nullptr);
    stageFades = false;
}

/// The next play is heard from now on, the present one fades out.
void PreviewEngine::usePlay() noexcept
{
    plays.giveBack(leaving);
    leaving = std::exchange(current, std::exchange(coming, nullptr));
    oldSound = sound;
    // Another sound beside the same play.
    if (leaving == nullptr || leaving->content.id != current->content.id ||
        leaving->content.stage != current->content.stage)
        sound = {};
    sound.forgetSource();
    faded = 0;
}

void PreviewEngine::useNext() noexcept
{
    if (coming == nullptr || stageFades)
        return;
    stageFades = nextStage != nullptr && coming->content.stage == nextStage->content.number;
    if (!stageFades && (stage == nullptr || coming->content.stage != stage->content.number))
        return; // its stage is still to come
    usePlay();
    if (level > 0.0)
        return;
    quiet = quiet || stageFades;
    endFade(); // there is nothing to fade from
}

void PreviewEngine::render(Stage& from, Signals& signals, std::size_t n) noexcept
{
    Spans out;
    for (std::size_t c = 0; c < from.outputs; ++c)
        out[from.channels[c]] = std::span(signals[c]).first(n);
    from.engine->render(std::span(out).first(from.outputs));
}

void PreviewEngine::processBlock(std::span<const std::span<float>> haptic, std::span<const std::span<float>> soundOut,
                                 std::size_t at, std::size_t n) noexcept
{
    const std::uint64_t wantedStart = playing.load(std::memory_order_acquire);
    // What has stopped does not go on while a new start is being built.
    const bool mayRise = level > 0.0 || (current != nullptr && current->content.start == wantedStart);
    const double target = wantedStart != 0 && mayRise ? 1.0 : 0.0;
    if (stage == nullptr || (target <= 0.0 && level <= 0.0 && quiet))
        return;
    if (target > 0.0 && level <= 0.0 && quiet)
        level = 1.0; // there is nothing from before
    render(stage->content, oldSignals, n);
    if (stageFades)
        render(nextStage->content, newSignals, n);
    const double speedNow = speed.load(std::memory_order_relaxed);
    Stage& newest = stageFades ? nextStage->content : stage->content;
    const bool ended = current != nullptr && !sound.follow(current->content, *newest.engine, n, speedNow);
    if (leaving != nullptr)
        oldSound.follow(leaving->content, *stage->content.engine, n, speedNow);

    const double step = 1.0 / (rampSeconds * fs);
    const auto approach = [step](double from, double to)
    {
        return from < to ? std::min(from + step, to) : std::max(from - step, to);
    };
    const auto fadeFrames = static_cast<std::size_t>(fadeSeconds * fs) + 1;
    const double wantedHaptic = hearHaptic.load(std::memory_order_relaxed) ? 1.0 : 0.0;
    const double wantedSource = hearSource.load(std::memory_order_relaxed) ? 1.0 : 0.0;
    const std::size_t outputs =
        std::min(haptic.size(), stageFades ? std::max(stage->content.outputs, newest.outputs) : newest.outputs);
    // What the engine still has of a play that was cut off in silence is not let out.
    const bool waits = level <= 0.0 && !quiet;
    const std::int64_t put = sound.framesHeard() - static_cast<std::int64_t>(n);
    float loudest = 0.0f;
    for (std::size_t i = 0; i < n; ++i)
    {
        level = approach(level, waits && put + static_cast<std::int64_t>(i) < 0 ? 0.0 : target);
        hapticLevel = approach(hapticLevel, wantedHaptic);
        sourceLevel = approach(sourceLevel, wantedSource);
        // Equal gain: what an edit has left alone is the same signal in both.
        const double x = std::min(1.0, static_cast<double>(faded + i + 1) / static_cast<double>(fadeFrames));
        const double share = leaving == nullptr && !stageFades ? 1.0 : 0.5 - 0.5 * std::cos(std::numbers::pi * x);
        for (std::size_t c = 0; c < outputs; ++c)
        {
            const auto sample = [&](const Stage& of, const Signals& signals)
            {
                return c < of.outputs ? static_cast<double>(signals[c][i]) : 0.0;
            };
            double mixed = sample(stage->content, oldSignals);
            if (stageFades)
                mixed = share * sample(newest, newSignals) + (1.0 - share) * mixed;
            loudest = std::max(loudest, std::abs(static_cast<float>(mixed)));
            haptic[c][at + i] = static_cast<float>(hapticLevel * level * mixed);
        }
        oldGains[i] = static_cast<float>(sourceLevel * level * (1.0 - share));
        newGains[i] = static_cast<float>(sourceLevel * level * share);
    }
    quiet = static_cast<double>(loudest) < silence;
    if (sourceLevel > 0.0 || wantedSource > 0.0)
    {
        if (leaving != nullptr)
            oldSound.add(leaving->content, fs, soundOut, at, std::span(oldGains).first(n));
        if (current != nullptr)
            sound.add(current->content, fs, soundOut, at, std::span(newGains).first(n));
    }
    if ((leaving != nullptr || stageFades) && (faded += n) >= fadeFrames)
        endFade();
    if (auto start = wantedStart; ended && current->content.start == start)
        playing.compare_exchange_strong(start, 0);
}

void PreviewEngine::keepWithinLimits(std::span<float> haptic, std::size_t output) noexcept
{
    // An engine takes the actuator to be at rest and cold when it begins. It is not while one fades into the next, nor
    // where a stop has cut off what it played.
    if (const StageNode* newest = stageFades ? nextStage : stage;
        newest != nullptr && newest->content.limits[output] != limits[output])
    {
        limits[output] = newest->content.limits[output];
        if (limits[output])
            bounds[output].setParams(*limits[output]);
        bounds[output].reset();
    }
    if (limits[output])
        bounds[output].process(haptic, haptic);
}

void PreviewEngine::meter(std::span<const float> haptic, std::size_t output) noexcept
{
    float peak = 0.0f;
    for (const float sample : haptic)
        peak = std::max(peak, std::abs(sample));
    // A reader between the two lines only takes one block's reading twice.
    if (peak > peaks[output].load(std::memory_order_relaxed))
        peaks[output].store(peak, std::memory_order_relaxed);
}

void PreviewEngine::process(std::span<const std::span<float>> haptic,
                            std::span<const std::span<float>> soundOut) noexcept
{
    for (const auto& channel : haptic)
        std::fill(channel.begin(), channel.end(), 0.0f);
    for (const auto& channel : soundOut)
        std::fill(channel.begin(), channel.end(), 0.0f);
    const std::size_t wantedFrames = haptic.empty() ? 0 : haptic.front().size();
    if (wantedFrames > 0)
        block.store(wantedFrames, std::memory_order_relaxed);
    take();
    for (std::size_t done = 0; done < wantedFrames;)
    {
        if (nextStage == nullptr || stageFades || stage == nullptr || level <= 0.0 || catchUp(wantedFrames))
            useNext();
        const std::size_t n = std::min(wantedFrames - done, blockFrames);
        processBlock(haptic, soundOut, done, n);
        for (std::size_t c = 0; c < std::min(haptic.size(), PreviewRow::most); ++c)
        {
            keepWithinLimits(haptic[c].subspan(done, n), c);
            meter(haptic[c].subspan(done, n), c);
        }
        done += n;
        frames += static_cast<std::int64_t>(n);
    }
    publish();
}

void PreviewEngine::publish() noexcept
{
    silent.store(level <= 0.0, std::memory_order_relaxed);
    const StageNode* newest = stageFades ? nextStage : stage;
    if (newest == nullptr || current == nullptr || !sound.begun() || level <= 0.0)
        return;
    const Engine& engine = *newest->content.engine;
    told.tell({current->content.start, newest->content.number, sound.mixed(), sound.heard(),
               engine.framesRendered() + static_cast<std::int64_t>(engine.latencyFrames()), frames});
    const PlaybackWay& way = current->content.way;
    playhead.store(std::clamp(way.placeOf(sound.heard()), 0.0, way.end), std::memory_order_relaxed);
    const auto reduction = static_cast<float>(engine.meters().gainReduction);
    if (isPlaying() && reduction > reductionHeard.load(std::memory_order_relaxed))
        reductionHeard.store(reduction, std::memory_order_relaxed);
}

} // namespace pacini
