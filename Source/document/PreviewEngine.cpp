#include "document/PreviewEngine.h"

#include <pacini/clip/edits/TimeEdits.h>
#include <pacini/synthesis/CompilePlan.h>

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
std::optional<ProtectionParams> boundsBehind(const Profile& profile, bool turns)
{
    constexpr double apart = 1.0 + 1e-6; // more than rounding
    ProtectionParams params = protectionParams(profile, Seconds(0.0));
    params.boundsAlone = true;
    if (turns) // nothing swings
        params.excursion.reset();
    if (params.excursion)
        params.excursion->maxExcursion *= apart;
    if (params.heat)
        params.heat->maxPower *= apart;
    return params.excursion || params.heat ? std::optional(params) : std::nullopt;
}

constexpr double fadeSeconds = 0.010;
constexpr double rampSeconds = 0.005;  // of starting, stopping and switching
constexpr double shortestLoop = 0.005; // s
constexpr double loopAhead = 20.0;     // s that are built of a loop
constexpr double loopReserve = 5.0;    // s before the end of that at which more is built
constexpr double jointSeconds = 0.002; // over which the sound is faded where a loop jumps

std::int64_t framesOf(double seconds, double fs)
{
    return std::llround(seconds * fs);
}
} // namespace

PreviewEngine::~PreviewEngine()
{
    delete current;
    delete next;
}

void PreviewEngine::set(Playback playback)
{
    hearHaptic.store(playback.haptic, std::memory_order_relaxed);
    hearSource.store(playback.source, std::memory_order_relaxed);
    const std::lock_guard lock(mutex);
    const Playback& old = wanted.playback;
    const bool same = old.heard() == playback.heard() && old.loop == playback.loop && old.audition == playback.audition;
    wanted.playback = std::move(playback);
    if (!same)
        wantedVersion.store(++wanted.version, std::memory_order_release);
}

void PreviewEngine::setProfile(std::shared_ptr<const Profile> profile, double strength)
{
    const std::lock_guard lock(mutex);
    wanted.profile = std::move(profile);
    wanted.strength = strength;
    wantedVersion.store(++wanted.version, std::memory_order_release);
}

void PreviewEngine::setSource(std::shared_ptr<const PreviewSource> source)
{
    const std::lock_guard lock(mutex);
    wanted.source = std::move(source);
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

bool PreviewEngine::wantsService() const noexcept
{
    if (wantedVersion.load(std::memory_order_acquire) != builtVersion.load(std::memory_order_relaxed))
        return true;
    const std::int64_t left = builtTo.load(std::memory_order_relaxed) - reached.load(std::memory_order_relaxed);
    return isPlaying() && static_cast<double>(left) < loopReserve * fs;
}

Result<void> PreviewEngine::service()
{
    hand.collect();
    Wanted now;
    {
        const std::lock_guard lock(mutex);
        now = wanted;
    }
    const bool started = now.start != built.start;
    const bool changed = now.version != built.version;
    const bool counts = reachedStart.load(std::memory_order_acquire) == now.start;
    const std::int64_t from = started || !counts ? 0 : reached.load(std::memory_order_relaxed);
    const std::int64_t end = builtTo.load(std::memory_order_relaxed);
    const bool runsOut =
        end != std::numeric_limits<std::int64_t>::max() && static_cast<double>(end - from) < loopReserve * fs;
    if (!changed && !runsOut)
        return {};
    // Whatever comes of it: a clip that cannot be built is not tried again and again.
    built = {now.version, now.start};
    builtVersion.store(now.version, std::memory_order_relaxed);
    if (!isPlaying()) // play() makes it anew
        return {};
    const auto giveUp = [&]
    {
        auto expected = now.start;
        if (started)
            playing.compare_exchange_strong(expected, 0);
    };
    if (!now.playback.heard())
    {
        giveUp();
        return {};
    }
    auto piece = build(now, from);
    if (!piece)
    {
        giveUp();
        return piece.error();
    }
    builtTo.store(piece->builtTo, std::memory_order_relaxed);
    hand.send(std::move(piece).value());
    return {};
}

Result<PreviewEngine::Piece> PreviewEngine::build(const Wanted& now, std::int64_t from) const
{
    Piece piece;
    piece.start = now.start;
    piece.source = now.source;
    Clip clip = audibleClip(*now.playback.heard(), now.playback.audition);
    const std::int64_t length = framesOf(clip.duration, fs);
    piece.way.first = std::min(framesOf(now.startTime, fs), length);
    TimeRange loop;
    if (now.playback.loop)
        loop = withinClip(*now.playback.loop, clip.duration);
    // Loops are whole frames, so that clip and sound stay together however often they go round.
    const std::int64_t loopFrom = framesOf(loop.from, fs);
    const std::int64_t loopTo = std::min(framesOf(loop.to, fs), length);
    const bool loops = static_cast<double>(loopTo - loopFrom) >= shortestLoop * fs && piece.way.first < loopTo;
    if (loops)
    {
        piece.way.loopFrom = loopFrom;
        piece.way.loopTo = loopTo;
    }

    // Near the start the player is brought to `from` by playing; later its content begins there.
    const std::int64_t begin = static_cast<double>(from) <= exactFrom * fs ? 0 : from;
    const double at = static_cast<double>(piece.way.at(begin)) / fs;
    if (loops)
    {
        const TimeRange range{static_cast<double>(loopFrom) / fs, static_cast<double>(loopTo) / fs};
        const Clip once = trimClip(clip, range);
        const Clip lead = trimClip(clip, {at, range.to});
        const auto points = static_cast<double>(breakpointCount(once) + once.transients.size() + 1);
        const double wantedPasses = std::ceil((loopAhead + exactFrom) / once.duration);
        const double most = std::max(2.0, 2e6 / points);
        auto looped = repeatClip(once, static_cast<int>(std::min(wantedPasses, most)));
        if (!looped)
            return looped.error();
        auto whole = joinClips(lead, *looped);
        if (!whole)
            return whole.error();
        clip = std::move(whole).value();
        piece.end = std::numeric_limits<std::int64_t>::max();
        piece.builtTo = begin + framesOf(clip.duration, fs);
    }
    else
    {
        if (at > 0.0)
        {
            const TimeRange rest{at, clip.duration};
            clip = trimClip(std::move(clip), rest);
        }
        piece.builtTo = std::numeric_limits<std::int64_t>::max();
    }

    Scene scene;
    scene.clips.push_back(std::move(clip));
    scene.plays.emplace_back();
    CompileParams params;
    params.sampleRate = fs;
    params.adaptation.strength = now.strength;
    auto plan = compilePlan(scene, now.profile.get(), params);
    if (!plan)
        return plan.error();
    ScenePlayerParams playerParams;
    playerParams.sampleRate = fs;
    if (now.profile)
        piece.limits = boundsBehind(*now.profile, plan->motor);
    piece.player = std::make_unique<ScenePlayer>(std::move(plan).value(), playerParams);
    if (!loops)
        piece.end = begin + piece.player->totalFrames();
    std::array<float, 1024> unheard;
    for (std::int64_t left = from - begin; left > 0;)
    {
        const auto n = static_cast<std::size_t>(std::min<std::int64_t>(left, 1024));
        const std::span<float> out = std::span(unheard).first(n);
        piece.player->process(std::span(&out, 1));
        left -= static_cast<std::int64_t>(n);
    }
    piece.position = from;
    return piece;
}

void PreviewEngine::take() noexcept
{
    // Only when no fade is under way: the old piece may go only when it is silent.
    if (next != nullptr)
    {
        // What waits in silence has not been heard, and may be of a start before: a newer one takes its place.
        if (level > 0.0 || !hand.waiting())
            return;
        hand.giveBack(next);
    }
    next = hand.receive();
    faded = 0;
    ready = false;
}

void PreviewEngine::catchUp(std::size_t frames) noexcept
{
    // The playhead has moved on while a piece was built: it is played up to there, at a cost that stays bounded in
    // every block.
    if (next == nullptr || ready)
        return;
    const bool sounding = current != nullptr && level > 0.0;
    if (!sounding)
        faded = std::numeric_limits<std::size_t>::max() / 2; // nothing to fade from
    if (sounding && current->content.start == next->content.start)
        for (std::size_t left = std::max<std::size_t>(8 * frames, 4096); left > 0;)
        {
            const std::int64_t behind = current->content.position - next->content.position;
            if (behind <= 0)
                break;
            const auto n = std::min({static_cast<std::size_t>(behind), left, blockFrames});
            renderPiece(next->content, std::span(newSignal).first(n));
            left -= n;
        }
    ready = !sounding || current->content.start != next->content.start ||
            next->content.position >= current->content.position;
}

void PreviewEngine::renderPiece(Piece& piece, std::span<float> out) noexcept
{
    if (piece.player)
        piece.player->process(std::span(&out, 1));
    else
        std::fill(out.begin(), out.end(), 0.0f);
    piece.position += static_cast<std::int64_t>(out.size());
}

void PreviewEngine::addSound(const Piece& piece, std::span<const std::span<float>> sound, std::size_t at, std::size_t n,
                             std::span<const float> gains) const noexcept
{
    if (!piece.source || piece.source->channels.empty())
        return;
    const std::int64_t first = piece.position - static_cast<std::int64_t>(n);
    const auto joint = std::max<double>(1.0, jointSeconds * fs);
    for (std::size_t i = 0; i < n; ++i)
    {
        const std::int64_t frame = first + static_cast<std::int64_t>(i);
        const std::int64_t place = piece.way.at(frame);
        if (frame >= piece.end || place < 0)
            continue;
        double gain = static_cast<double>(gains[i]);
        if (piece.way.loopTo > piece.way.loopFrom)
        {
            const auto toJump = static_cast<double>(piece.way.loopTo - 1 - place);
            const auto sinceJump = static_cast<double>(place - piece.way.loopFrom);
            const bool afterJump = piece.way.first + frame >= piece.way.loopTo;
            gain *= std::min({1.0, toJump / joint, afterJump ? sinceJump / joint : 1.0});
        }
        for (std::size_t c = 0; c < sound.size(); ++c)
        {
            const auto& samples = piece.source->channels[std::min(c, piece.source->channels.size() - 1)];
            if (static_cast<std::size_t>(place) < samples.size())
                sound[c][at + i] +=
                    static_cast<float>(gain * static_cast<double>(samples[static_cast<std::size_t>(place)]));
        }
    }
}

void PreviewEngine::processBlock(std::span<float> haptic, std::span<const std::span<float>> sound, std::size_t at,
                                 std::size_t n) noexcept
{
    const std::uint64_t wantedStart = playing.load(std::memory_order_acquire);
    HandOver<Piece>::Node* const rising = fadingIn();
    // What has stopped does not go on while the piece of a new start is being built, nor what was built for the start
    // before and never heard.
    const auto isWanted = [wantedStart](const HandOver<Piece>::Node* node)
    {
        return node != nullptr && node->content.start == wantedStart;
    };
    const bool mayRise = level > 0.0 || isWanted(rising) || isWanted(current);
    const double target = wantedStart != 0 && mayRise ? 1.0 : 0.0;
    if (target <= 0.0 && level <= 0.0)
        return;
    const double step = 1.0 / (rampSeconds * fs);
    const auto approach = [step](double from, double to)
    {
        return from < to ? std::min(from + step, to) : std::max(from - step, to);
    };
    const auto fadeFrames = static_cast<std::size_t>(fadeSeconds * fs) + 1;
    const bool both = rising != nullptr && faded < fadeFrames;
    const auto oldPart = std::span(oldSignal).first(n);
    const auto newPart = std::span(newSignal).first(n);
    if (current != nullptr && (both || rising == nullptr))
        renderPiece(current->content, oldPart);
    else
        std::fill(oldPart.begin(), oldPart.end(), 0.0f);
    if (rising != nullptr)
        renderPiece(rising->content, newPart);
    const double wantedHaptic = hearHaptic.load(std::memory_order_relaxed) ? 1.0 : 0.0;
    const double wantedSource = hearSource.load(std::memory_order_relaxed) ? 1.0 : 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
        level = approach(level, target);
        hapticLevel = approach(hapticLevel, wantedHaptic);
        sourceLevel = approach(sourceLevel, wantedSource);
        // Equal gain: what an edit has left alone is the same signal in both.
        double share = 0.0;
        if (rising != nullptr)
        {
            const double x = std::min(1.0, static_cast<double>(faded + i + 1) / static_cast<double>(fadeFrames));
            share = 0.5 - 0.5 * std::cos(std::numbers::pi * x);
        }
        const double a = level * (1.0 - share);
        const double b = level * share;
        // Where nothing is to be mixed the signal is passed on bit for bit.
        const double mixed = b == 0.0   ? a * static_cast<double>(oldPart[i])
                             : a == 0.0 ? b * static_cast<double>(newPart[i])
                                        : a * static_cast<double>(oldPart[i]) + b * static_cast<double>(newPart[i]);
        haptic[at + i] = static_cast<float>(hapticLevel * mixed);
        oldGains[i] = static_cast<float>(sourceLevel * a);
        newGains[i] = static_cast<float>(sourceLevel * b);
    }
    if (sourceLevel > 0.0 || wantedSource > 0.0)
    {
        if (current != nullptr && (both || rising == nullptr))
            addSound(current->content, sound, at, n, std::span(oldGains).first(n));
        if (rising != nullptr)
            addSound(rising->content, sound, at, n, std::span(newGains).first(n));
    }
    if (rising != nullptr && (faded += n) >= fadeFrames)
    {
        hand.giveBack(current);
        current = rising;
        next = nullptr;
        ready = false;
    }
}

void PreviewEngine::keepWithinLimits(std::span<float> haptic) noexcept
{
    // Each piece takes the actuator to be at rest and cold when it begins. It is not while one fades into the next,
    // nor when a play begins soon after another.
    const auto* newest = fadingIn() != nullptr ? next : current;
    if (newest != nullptr && newest->content.limits != limits)
    {
        limits = newest->content.limits;
        if (limits)
            bounds.setParams(*limits);
        bounds.reset();
    }
    if (limits)
        bounds.process(haptic, haptic);
}

void PreviewEngine::meter(std::span<const float> haptic) noexcept
{
    float peak = 0.0f;
    for (const float sample : haptic)
        peak = std::max(peak, std::abs(sample));
    double reduction = 0.0;
    for (const auto* node : {current, fadingIn()})
        if (node != nullptr && node->content.player && isPlaying())
            if (const ProtectionMeter* protection = node->content.player->protectionMeter())
                reduction = std::max(reduction, protection->gainReduction);
    // A reader between the two lines only takes one block's reading twice.
    if (peak > peakHeard.load(std::memory_order_relaxed))
        peakHeard.store(peak, std::memory_order_relaxed);
    if (static_cast<float>(reduction) > reductionHeard.load(std::memory_order_relaxed))
        reductionHeard.store(static_cast<float>(reduction), std::memory_order_relaxed);
}

void PreviewEngine::process(std::span<float> haptic, std::span<const std::span<float>> sound) noexcept
{
    std::fill(haptic.begin(), haptic.end(), 0.0f);
    for (const auto& channel : sound)
        std::fill(channel.begin(), channel.end(), 0.0f);
    take();
    catchUp(haptic.size());
    for (std::size_t done = 0; done < haptic.size();)
    {
        const std::size_t n = std::min(haptic.size() - done, blockFrames);
        processBlock(haptic, sound, done, n);
        keepWithinLimits(haptic.subspan(done, n));
        meter(haptic.subspan(done, n));
        done += n;
    }
    const auto* newest = fadingIn() != nullptr ? next : current;
    if (newest == nullptr)
        return;
    const Piece& piece = newest->content;
    reached.store(piece.position, std::memory_order_relaxed);
    reachedStart.store(piece.start, std::memory_order_release);
    playhead.store(static_cast<double>(piece.way.at(std::min(piece.position, piece.end))) / fs,
                   std::memory_order_relaxed);
    if (auto start = piece.start; piece.position >= piece.end)
        playing.compare_exchange_strong(start, 0);
}

} // namespace pacini
