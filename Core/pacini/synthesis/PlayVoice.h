#pragma once

// One play while it sounds: its decoder, its live controls, and its level and delay towards every actuator.

#include <pacini/clip/Curve.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Glide.h>
#include <pacini/foundation/SizeInMemory.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/DelayTap.h>
#include <pacini/synthesis/PanSends.h>
#include <pacini/synthesis/RenderPlan.h>
#include <pacini/synthesis/TextureVoice.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace pacini
{

/// A straight piece of a curve. Values follow from the frame alone, so that they do not depend on blocks.
struct CurvePiece
{
    double value = 0.0; // at `origin`
    double slope = 0.0; // per s
    double origin = 0.0;
    double fs = 1.0;
    [[nodiscard]] double at(std::int64_t frame) const noexcept
    {
        return value + slope * (static_cast<double>(frame) / fs - origin);
    }
};

/// Calls use(i, end, piece) for the straight pieces of a curve (not empty, over s) over frames [now, now + n). `next`
/// is the point that is reached next: 0 at first, then as the call before has left it. [audio]
template <typename Use>
void forCurvePieces(const Curve& curve, std::size_t& next, std::int64_t now, std::size_t n, double fs,
                    Use&& use) noexcept
{
    for (std::size_t i = 0; i < n;)
    {
        const double t = static_cast<double>(now + static_cast<std::int64_t>(i)) / fs;
        while (next < curve.size() && curve[next].time <= t)
            ++next;
        std::size_t end = n;
        if (next < curve.size())
        {
            const double until = std::ceil(curve[next].time * fs) - static_cast<double>(now);
            end = until < static_cast<double>(n) ? std::max(i + 1, static_cast<std::size_t>(until)) : n;
        }
        if (next == 0 || next == curve.size() || curve[next - 1].value == curve[next].value)
            use(i, end, CurvePiece{next == 0 ? curve.front().value : curve[next - 1].value, 0.0, 0.0, fs});
        else
        {
            const Breakpoint& a = curve[next - 1];
            const Breakpoint& b = curve[next];
            use(i, end, CurvePiece{a.value, (b.value - a.value) / (b.time - a.time), a.time, fs});
        }
        i = end;
    }
}

/// Memory for mixing one block, shared by all voices.
struct MixBuffers
{
    static constexpr std::size_t frames = 1024;
    std::array<float, frames> mono{}, delayed{};
    std::array<double, frames> delays{}, lateness{}, gains{};
    PerRole<std::array<double, frames>> roles;
};

/// Target of a mix: frames [at, at + frames) of `out`, one span for each actuator; the first is frame `now` of the
/// scene.
struct MixTarget
{
    std::span<const std::span<float>> out;
    std::size_t at = 0, frames = 0;
    std::int64_t now = 0;
};

/// The live faders of a play, which multiply.
enum class Fader
{
    play,
    intensity,
    group,
    leave, ///< out where it is stopped, paused or left out, and in again
    fade   ///< in at the start, and from one pass of a loop into the next
};
inline constexpr std::size_t faderCount = 5;

/// The live faders of the level of a role, which multiply with each other and with the scene's.
enum class RoleFader
{
    play,
    group
};
inline constexpr std::size_t roleFaderCount = 2;

/// Set-up of the decoder of a voice.
struct VoiceParams
{
    const BiquadCascadeCoefficients* filter = nullptr; ///< behind the decoder; null = none
    std::int64_t until = 0;                            ///< frame at which the scene ends, for that filter
    const ActuatorRow* row = nullptr;                  ///< of live pans; null = none
    Seconds liveDelay{0.0};                            ///< the longest live delay
    InterpolatorDesigns* designs = nullptr;            ///< shared with other voices; null = its own
};

/// Voice of one play. Made without a decoder: prepare() and release() bound the memory of long scenes. Every call gets
/// the play that the voice was made for.
class PlayVoice
{
public:
    PlayVoice(const PlannedPlay& play, std::size_t actuators, double sampleRate)
        : fs(sampleRate), start(static_cast<std::int64_t>(std::floor(play.start * fs + 0.5))), levels(actuators)
    {
    }

    [[nodiscard]] std::int64_t startFrame() const noexcept { return start; }
    [[nodiscard]] bool ended() const noexcept { return over; }
    [[nodiscard]] const Decoder* decoding() const noexcept { return decoder.get(); }

    /// Makes the decoder and the delay line. [worker]
    void prepare(const PlannedPlay& play, const VoiceParams& voice = {})
    {
        DecoderParams params = play.decoder;
        params.sampleRate = fs;
        Clip silent;
        silent.duration = play.clip.duration;
        decoder =
            std::make_unique<Decoder>(play.texture ? silent : play.clip, params, play.timeline.changes, voice.designs);
        if (play.texture)
        {
            texture = std::make_unique<TextureVoice>(play.texture, play.textureSeed, play.timeline.speed,
                                                     play.timeline.force, MixBuffers::frames);
            textureOut = play.decoder.leftOut;
        }
        filtered = voice.filter != nullptr;
        if (filtered)
            decoder->filterBy(*voice.filter, voice.until - start);
        if (voice.row != nullptr)
            sends.emplace(*voice.row);
        mixesRoles = mixesRoles || hasRoleLevels(play.timeline);
        longestLive = voice.liveDelay.value;
        double longest = 0.0;
        for (const Curve& curve : play.timeline.delays)
            for (const Breakpoint& point : curve)
                longest = std::max(longest, point.value);
        if (sends)
            longest = std::max(longest, sends->longestDelay());
        if (longest + longestLive == 0.0)
            return;
        delay = DelayTap((longest + longestLive) * fs, MixBuffers::frames);
        tail = longest > 0.0 ? framesOfDelay(longest) : 0;
    }

    /// Frees their memory. [worker]
    void release()
    {
        decoder.reset();
        texture.reset();
        delay.reset();
        sends.reset();
    }

    /// Glides a fader to a linear gain. [audio]
    void setFader(Fader fader, double wanted, std::size_t frames) noexcept
    {
        faders[static_cast<std::size_t>(fader)].glideTo(wanted, frames);
    }

    /// The same for the level of a role: 0 or more. Without effect where a filter is behind the decoder. [audio]
    void setRole(Role role, RoleFader fader, double wanted, std::size_t frames) noexcept
    {
        roles[role][static_cast<std::size_t>(fader)].glideTo(wanted, frames);
        mixesRoles = mixesRoles || wanted != 1.0;
    }

    /// Glides to a speed and a force of its texture (0 to 1), instead of the scene's. [audio]
    void setTextureSpeed(double wanted, std::size_t frames) noexcept
    {
        if (texture)
            texture->setSpeed(wanted, frames);
    }
    void setTextureForce(double wanted, std::size_t frames) noexcept
    {
        if (texture)
            texture->setForce(wanted, frames);
    }

    [[nodiscard]] const Glide& fader(Fader which) const noexcept { return faders[static_cast<std::size_t>(which)]; }

    /// Begins (again) at frame `frame`: as it was prepared; live controls stay. [audio]
    void startAt(std::int64_t frame) noexcept
    {
        moveTo(frame);
        if (decoder)
            decoder->reset();
        if (texture)
            texture->reset();
        if (delay)
            delay->reset();
    }

    /// The same, but continues with its decoder, which has played `played` frames already. [audio]
    void goOnAt(std::int64_t frame, std::int64_t played) noexcept { moveTo(frame - played); }

    /// Delays everything in it by `frames`, for which it was not played. [audio]
    void shift(std::int64_t frames) noexcept
    {
        start += frames;
        reached += frames;
    }

    /// Advances live controls to frame `now`, as if the voice had been mixed until then. [audio]
    void passGlides(std::int64_t now) noexcept
    {
        if (now <= reached)
            return;
        const std::size_t frames = sizeInMemory(now - reached);
        for (Glide& fader : faders)
            fader.jump(frames);
        for (RoleFaders& role : roles)
            for (Glide& fader : role)
                fader.jump(frames);
        lateness.jump(frames);
        if (texture)
            texture->jump(frames);
        if (panned)
            sends->jump(frames);
        reached = now;
    }

    /// Continues at frame `now` after frames without output since the last mix: see Decoder::skip(). [audio]
    void catchUp(std::int64_t now) noexcept
    {
        passGlides(now);
        const std::int64_t behind = now - start - decoder->framesPlayed();
        if (behind <= 0)
            return;
        decoder->skip(behind);
        if (delay)
            delay->reset();
    }

    /// Plays the next `frames` frames unheard, for goOnAt(). [worker]
    void skip(std::int64_t frames, MixBuffers& buffers) noexcept
    {
        while (decoder && frames > 0)
        {
            const auto n = static_cast<std::size_t>(std::min<std::int64_t>(frames, MixBuffers::frames));
            decoder->process(std::span(buffers.mono).first(n));
            frames -= static_cast<std::int64_t>(n);
        }
    }

    /// Sets the pan (0-1), or glides to it, instead of the scene's pan. [audio]
    void setPan(double wanted, std::size_t frames) noexcept
    {
        if (!sends)
            return;
        if (!panned)
            sends->place(wanted); // where the scene's curves have it is not known here
        else
            sends->glideTo(wanted, frames);
        panned = true;
    }

    /// Glides to a delay (s) on top of the scene's, as far as there is room. [audio]
    void setDelay(double wanted, std::size_t frames) noexcept
    {
        lateness.glideTo(clampTo(wanted, 0.0, longestLive), frames);
        latest = std::max(latest, framesOfDelay(lateness.goal()));
    }

    /// Takes all live controls and glides except the fade from another voice. [audio]
    void follow(const PlayVoice& other) noexcept
    {
        std::copy_n(other.faders.begin(), static_cast<std::size_t>(Fader::fade), faders.begin());
        roles = other.roles;
        mixesRoles = mixesRoles || other.mixesRoles;
        lateness = other.lateness;
        latest = other.latest;
        panned = other.panned;
        if (texture && other.texture)
            texture->follow(*other.texture);
        if (sends && other.sends)
            sends->follow(*other.sends);
    }

    /// As Decoder::change does.
    void change(double transposition, double stretch) noexcept
    {
        if (decoder)
            decoder->change(transposition, stretch);
    }

    /// Adds the sound of the block. A voice that is `lone` in a cleared block may overwrite it. [audio]
    void mix(const PlannedPlay& play, const MixTarget& target, bool lone, MixBuffers& buffers) noexcept
    {
        const std::size_t from = sizeInMemory(start - target.now);
        if (from >= target.frames)
            return;
        const std::size_t n = target.frames - from;
        const std::int64_t now = target.now + static_cast<std::int64_t>(from);
        if (lone && isPlain(play, target.out.size()))
            decoder->process(target.out.front().subspan(target.at + from, n));
        else
            addTo(play, target.out, target.at + from, now, std::span(buffers.mono).first(n), buffers);
        reached = now + static_cast<std::int64_t>(n);
        over =
            now + static_cast<std::int64_t>(n) >= start + decoder->totalFrames() + tail + latest && !decoder->rings();
    }

private:
    /// With those that the delay's cubic looks back.
    [[nodiscard]] std::int64_t framesOfDelay(double seconds) const noexcept
    {
        return seconds > 0.0 ? static_cast<std::int64_t>(std::ceil(seconds * fs)) + 3 : 0;
    }

    void moveTo(std::int64_t frame) noexcept
    {
        start = frame;
        reached = frame;
        over = false;
        std::fill(levels.begin(), levels.end(), Level{});
        roleNext = PerRole<std::size_t>();
    }

    using RoleFaders = std::array<Glide, roleFaderCount>;

    /// Reading position in the curves towards one actuator.
    struct Level
    {
        std::size_t gain = 0;
        std::size_t delay = 0;
        std::size_t level = 0; ///< of the play's level without pan
        std::size_t late = 0;  ///< of its delay without pan
    };

    /// Whether the play goes to one actuator as it is.
    [[nodiscard]] bool isPlain(const PlannedPlay& play, std::size_t channels) const noexcept
    {
        const auto& gains = play.timeline.gains;
        return !texture && channels == 1 && gains.size() == 1 && gains[0].size() == 1 && gains[0][0].value == 1.0 &&
               !panned && !delay && !mixesRoles &&
               std::all_of(faders.begin(), faders.end(), [](const Glide& fader) { return fader.restsAt(1.0); });
    }

    /// The product of the faders in the next frames: one value where all rest.
    [[nodiscard]] std::span<const double> gainsOf(std::size_t frames, MixBuffers& buffers) noexcept
    {
        const bool rest = std::all_of(faders.begin(), faders.end(), [](const Glide& fader) { return fader.resting(); });
        const auto gains = std::span(buffers.gains).first(rest ? 1 : frames);
        std::fill(gains.begin(), gains.end(), 1.0);
        for (Glide& fader : faders)
            for (double& gain : gains)
                gain *= fader.next();
        return gains;
    }

    /// The levels of the roles in the frames from `now` on: one value where a level rests.
    [[nodiscard]] RoleGains roleGains(const PlannedPlay& play, std::int64_t now, std::size_t frames,
                                      MixBuffers& buffers) noexcept
    {
        RoleGains gains;
        for (const Role role : allRoles)
        {
            const Curve& curve = play.timeline.roles[role];
            RoleFaders& ways = roles[role];
            bool rests = std::all_of(ways.begin(), ways.end(), [](const Glide& fader) { return fader.resting(); });
            const auto values = std::span(buffers.roles[role]).first(rests && curve.empty() ? 1 : frames);
            if (curve.empty())
                std::fill(values.begin(), values.end(), 1.0);
            else
                forCurvePieces(curve, roleNext[role], now, frames, fs,
                               [&](std::size_t i, std::size_t end, const CurvePiece& piece)
                               {
                                   rests = rests && piece.slope == 0.0 && i == 0;
                                   for (; i < end; ++i)
                                       values[i] = std::max(0.0, piece.at(now + static_cast<std::int64_t>(i)));
                               });
            for (Glide& fader : ways)
                for (double& value : values)
                    value *= fader.next();
            gains[role] = RoleGain(rests ? values.first(1) : values);
        }
        return gains;
    }

    void addTexture(std::int64_t now, std::span<float> block, RoleGains levelsOfRoles) noexcept
    {
        static constexpr double out = 0.0;
        for (const Role role : allRoles)
            if (textureOut[role])
                levelsOfRoles[role] = RoleGain(std::span(&out, 1));
        texture->add(block, now, now - start, decoder->totalFrames(), levelsOfRoles);
    }

    void addTo(const PlannedPlay& play, std::span<const std::span<float>> out, std::size_t at, std::int64_t now,
               std::span<float> block, MixBuffers& buffers) noexcept
    {
        RoleGains levelsOfRoles;
        if (mixesRoles && !filtered)
        {
            levelsOfRoles = roleGains(play, now, block.size(), buffers);
            decoder->process(block, levelsOfRoles);
        }
        else
            decoder->process(block);
        if (texture)
            addTexture(now, block, levelsOfRoles);
        const std::span<const double> gains = gainsOf(block.size(), buffers);
        if (delay)
            delay->write(block);
        const std::size_t channels = std::min(out.size(), levels.size());
        const auto late = std::span(buffers.lateness).first(block.size());
        const bool isLate = delay && !lateness.restsAt(0.0);
        if (isLate)
            for (double& seconds : late)
                seconds = lateness.next();
        for (std::size_t i = 0; i < block.size();)
        {
            const std::size_t n = panned ? sends->straightFrames(block.size() - i) : block.size() - i;
            for (std::size_t a = 0; a < channels; ++a)
            {
                const SendPiece* send = panned ? &sends->send(a) : nullptr;
                std::span<const float> in = std::span<const float>(block).subspan(i, n);
                const bool moves = !play.timeline.delays.empty() || (send != nullptr && sends->hasDelays());
                if (isLate || moves)
                {
                    const auto delays = std::span(buffers.delays).first(n);
                    std::fill(delays.begin(), delays.end(), 0.0);
                    const std::int64_t first = now + static_cast<std::int64_t>(i);
                    if (send == nullptr && moves)
                        readDelays(play.timeline.delays[a], levels[a].delay, first, delays);
                    if (send != nullptr && !play.timeline.delay.empty())
                        readDelays(play.timeline.delay, levels[a].late, first, delays);
                    if (send != nullptr)
                        for (std::size_t k = 0; k < n; ++k)
                            delays[k] += send->delayAt(sends->framesIntoChord() + k);
                    for (std::size_t k = 0; k < n; ++k)
                        buffers.delayed[k] = delay->read(i + k, fs * (delays[k] + (isLate ? late[i + k] : 0.0)));
                    in = std::span(buffers.delayed).first(n);
                }
                const std::span<float> to = out[a].subspan(at + i, n);
                const std::span<const double> live = gains.size() == 1 ? gains : gains.subspan(i, n);
                if (send == nullptr)
                    addScaled(play.timeline.gains[a], levels[a].gain, now + static_cast<std::int64_t>(i), in, to, live);
                else
                    addSent(play.timeline.level, levels[a].level, now + static_cast<std::int64_t>(i), in, to, live,
                            *send);
            }
            if (panned)
                sends->advance(n);
            i += n;
        }
    }

    void readDelays(const Curve& curve, std::size_t& next, std::int64_t now, std::span<double> delays) const noexcept
    {
        forCurvePieces(curve, next, now, delays.size(), fs,
                       [&](std::size_t i, std::size_t end, const CurvePiece& piece)
                       {
                           for (; i < end; ++i)
                               delays[i] = std::max(0.0, piece.at(now + static_cast<std::int64_t>(i)));
                       });
    }

    /// Adds `in` by a curve of gains and the live ones.
    void addScaled(const Curve& gains, std::size_t& next, std::int64_t now, std::span<const float> in,
                   std::span<float> out, std::span<const double> live) const noexcept
    {
        forCurvePieces(gains, next, now, in.size(), fs,
                       [&](std::size_t i, std::size_t end, const CurvePiece& piece)
                       {
                           if (piece.slope != 0.0 || live.size() > 1)
                               for (; i < end; ++i)
                                   add(out[i],
                                       live[live.size() > 1 ? i : 0] * piece.at(now + static_cast<std::int64_t>(i)),
                                       in[i]);
                           else if (const double whole = live[0] * piece.value; whole != 0.0)
                               for (; i < end; ++i)
                                   add(out[i], whole, in[i]);
                       });
    }

    /// As addScaled(), along a chord of a live pan instead of the scene's.
    void addSent(const Curve& level, std::size_t& next, std::int64_t now, std::span<const float> in,
                 std::span<float> out, std::span<const double> live, const SendPiece& send) const noexcept
    {
        if (send.level == 0.0 && send.levelStep == 0.0)
            return;
        const std::size_t into = sends->framesIntoChord();
        forCurvePieces(level, next, now, in.size(), fs,
                       [&](std::size_t i, std::size_t end, const CurvePiece& piece)
                       {
                           if (piece.slope != 0.0 || send.levelStep != 0.0 || live.size() > 1)
                               for (; i < end; ++i)
                                   add(out[i],
                                       live[live.size() > 1 ? i : 0] * piece.at(now + static_cast<std::int64_t>(i)) *
                                           send.levelAt(into + i),
                                       in[i]);
                           else if (const double whole = live[0] * piece.value * send.level; whole != 0.0)
                               for (; i < end; ++i)
                                   add(out[i], whole, in[i]);
                       });
    }

    static void add(float& out, double gain, float in) noexcept
    {
        out += static_cast<float>(gain * static_cast<double>(in));
    }

    double fs;
    std::int64_t start;
    std::int64_t reached = 0; // frame that is mixed next
    std::unique_ptr<Decoder> decoder;
    std::unique_ptr<TextureVoice> texture; // beside a silent decoder
    PerRole<bool> textureOut{false};
    std::optional<DelayTap> delay;
    std::int64_t tail = 0, latest = 0; // frames that sound longer because of the scene's delays and live ones
    std::vector<Level> levels;
    std::optional<PanSends> sends;
    bool panned = false; // live: the sends count, not the scene's curves
    double longestLive = 0.0;
    std::array<Glide, faderCount> faders{Glide(1.0), Glide(1.0), Glide(1.0), Glide(1.0), Glide(1.0)};
    PerRole<RoleFaders> roles{RoleFaders{Glide(1.0), Glide(1.0)}};
    PerRole<std::size_t> roleNext; // points of the scene's levels that are reached next
    bool mixesRoles = false;       // some level was or will be another than 1
    Glide lateness{0.0};
    bool filtered = false; // behind the decoder, which then has no levels of roles
    bool over = false;
};

} // namespace pacini
