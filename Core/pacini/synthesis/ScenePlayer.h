#pragma once

// RenderPlan -> drive signals.

#include <pacini/actuator/LevelLimiter.h>
#include <pacini/actuator/MotorDrive.h>
#include <pacini/actuator/OutputFilter.h>
#include <pacini/actuator/Protection.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/synthesis/CurvePieces.h>
#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/DelayTap.h>
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

struct ScenePlayerParams
{
    double sampleRate = 48000.0; ///< Hz, 2000 to 768000; a scene at any other rate has no frames
    double builtUntil = std::numeric_limits<double>::infinity(); ///< s: makes the decoders of plays that start before
    bool protect = true;      ///< keep within full drive and the limits of the profile
    Seconds lookAhead{0.001}; ///< of that, 0 to 1 ms; taken out of the output
};

/// What the decoder of a play was made to play.
struct DecodedPlay
{
    std::size_t play = 0;  ///< index into the scene's plays
    double start = 0.0;    ///< s
    double duration = 0.0; ///< s, with the changes that were known
    DecoderReport decoder;
};

/// Plays a plan on its actuators: only plays that are sounding cost anything. The output does not depend on how it is
/// cut into blocks. Decoders take memory: build() makes those that start soon and frees those that have ended, from a
/// thread that may wait; the constructor makes all of them, so that live use need not call it.
class ScenePlayer
{
public:
    explicit ScenePlayer(RenderPlan planToPlay, const ScenePlayerParams& params = {})
        : plan(std::move(planToPlay)),
          fs(clampTo(params.sampleRate, limits::lowestRate, limits::highestRate)),
          endFrame(isPlayableRate(params.sampleRate) ? static_cast<std::int64_t>(std::floor(plan.duration * fs + 0.5))
                                                     : 0)
    {
        for (const PlannedPlay& planned : plan.plays)
        {
            Voice voice;
            voice.start = static_cast<std::int64_t>(std::floor(planned.start * fs + 0.5));
            voice.levels.assign(plan.actuators, Level{});
            voices.push_back(std::move(voice));
        }
        if (plan.profile || params.protect)
            for (std::size_t a = 0; a < plan.actuators; ++a)
                outputs.push_back(plan.profile ? makeOutput(*plan.profile, params) : makeOutput(params));
        if (!outputs.empty())
            preRoll = outputs.front().latencyFrames();
        discarded.resize(plan.actuators * blockFrames);
        build(params.builtUntil);
    }

    [[nodiscard]] std::int64_t totalFrames() const noexcept { return endFrame; }
    [[nodiscard]] std::size_t actuators() const noexcept { return plan.actuators; }

    /// Makes the decoders of plays that start before `until` (s of the scene) and frees those that have ended. Not
    /// while process() runs. [worker]
    void build(double until)
    {
        while (firstKept < voices.size() && voices[firstKept].ended && !voices[firstKept].decoder)
            ++firstKept;
        // Plays are in order of start.
        for (std::size_t i = firstKept; i < voices.size() && (voices[i].ended || plan.plays[i].start < until); ++i)
        {
            Voice& voice = voices[i];
            if (voice.ended)
            {
                voice.decoder.reset();
                voice.delay = {};
            }
            else if (!voice.decoder)
                make(voice, plan.plays[i]);
        }
    }

    /// The plays whose decoders have been made, in order of start. [worker]
    [[nodiscard]] const std::vector<DecodedPlay>& decodedPlays() const noexcept { return decoded; }

    /// Largest number of plays that sound at a time so far, for reports.
    [[nodiscard]] std::size_t mostSounding() const noexcept { return most; }

    /// The most that the protection of any actuator has taken so far, dB, for reports.
    [[nodiscard]] double mostReduction() const noexcept { return reduction; }

    /// Writes the next frames: one span for each actuator, all of the same length; silence after the end. [audio]
    void process(std::span<const std::span<float>> out) noexcept
    {
        const std::size_t frames = out.empty() ? 0 : out.front().size();
        while (preRoll > 0)
        {
            // What the protection looks ahead is played before the first frame is given out.
            const std::size_t n = std::min(preRoll, blockFrames);
            std::array<std::span<float>, limits::actuators> unheard;
            const std::size_t channels = std::min(out.size(), plan.actuators);
            for (std::size_t a = 0; a < channels; ++a)
                unheard[a] = std::span(discarded).subspan(a * blockFrames, n);
            processBlock(std::span(unheard).first(channels), 0, n);
            preRoll -= n;
        }
        for (std::size_t done = 0; done < frames;)
        {
            const std::size_t n = std::min(frames - done, blockFrames);
            processBlock(out, done, n);
            done += n;
        }
    }

    /// What the protection of an actuator did in the last call of process(), or in the last 1024 frames of a longer
    /// one; null when nothing is protected. [audio]
    [[nodiscard]] const ProtectionMeter* protectionMeter(std::size_t actuator = 0) const noexcept
    {
        return actuator < outputs.size() ? outputs[actuator].meter() : nullptr;
    }

    /// From the next frame on, glides play `play` of the scene (its index there) to `gain` (linear, -1000 to 1000, on
    /// top of the scene's own) within 5 ms. Gains beyond are clamped, those that are not finite ignored. Plays that the
    /// plan leaves out stay out. [audio]
    void setGain(std::size_t play, double gain) noexcept
    {
        if (!std::isfinite(gain))
            return;
        gain = clampTo(gain, -mostGain, mostGain);
        forPlay(play,
                [&](Voice& voice, const PlannedPlay&)
                {
                    voice.liveStep = (gain - voice.liveGain) / (0.005 * fs);
                    voice.liveTarget = gain;
                });
    }

    /// Changes pitch (semitones) and speed of a play, as Decoder::change does: what is not finite is ignored. [audio]
    void setPitchAndSpeed(std::size_t play, double transposition, double stretch) noexcept
    {
        forPlay(play,
                [&](Voice& voice, const PlannedPlay&)
                {
                    if (voice.decoder)
                        voice.decoder->change(transposition, stretch);
                });
    }

private:
    static constexpr std::size_t blockFrames = 1024;
    static constexpr double mostGain = 1000.0; // 60 dB, as in scenes

    /// Where a curve has been read to.
    struct Level
    {
        std::size_t gain = 0;
        std::size_t delay = 0;
    };

    struct Voice
    {
        std::int64_t start = 0;
        std::unique_ptr<Decoder> decoder;
        std::int64_t frames = 0; // of the decoder
        DelayTap delay;
        std::int64_t tail = 0; // frames that sound longer because of delays
        std::vector<Level> levels;
        double liveGain = 1.0, liveTarget = 1.0, liveStep = 0.0;
        bool ended = false;
    };

    /// What stands between the sum of the plays and an actuator.
    struct Output
    {
        std::unique_ptr<OutputFilter> filter;
        std::unique_ptr<MotorDrive> motor;
        std::unique_ptr<Protection> protection;
        std::unique_ptr<LevelLimiter> limiter; ///< where there is no profile
        double scale = 1.0;

        [[nodiscard]] std::size_t latencyFrames() const noexcept
        {
            return protection ? protection->latencyFrames() : limiter ? limiter->latencyFrames() : 0;
        }
        [[nodiscard]] const ProtectionMeter* meter() const noexcept
        {
            return protection ? &protection->meter() : limiter ? &limiter->meter() : nullptr;
        }
    };

    /// For plain drive signals: full drive is the one limit that is known.
    Output makeOutput(const ScenePlayerParams& params) const
    {
        Output output;
        output.limiter = std::make_unique<LevelLimiter>();
        output.limiter->prepare({fs, blockFrames});
        LevelLimiterParams limits;
        limits.lookAhead = params.lookAhead;
        output.limiter->setParams(limits);
        output.limiter->reset();
        return output;
    }

    Output makeOutput(const Profile& profile, const ScenePlayerParams& params) const
    {
        Output output;
        // Room for overdrive: the rated drive is played at 1 / overdrive.
        output.scale = 1.0 / profile.drive.overdrive;
        if (plan.motor)
        {
            output.motor = std::make_unique<MotorDrive>();
            output.motor->prepare({fs, blockFrames});
            MotorDriveParams motor = motorDriveParams(profile);
            if (!params.protect)
                motor.heat.reset();
            output.motor->setParams(motor);
        }
        else
        {
            output.filter = std::make_unique<OutputFilter>();
            output.filter->prepare({fs, blockFrames});
            output.filter->setParams({profile.equalizer, plan.flattening});
        }
        if (!plan.motor && params.protect)
        {
            output.protection = std::make_unique<Protection>();
            output.protection->prepare({fs, blockFrames});
            output.protection->setParams(protectionParams(profile, params.lookAhead));
            output.protection->reset();
        }
        return output;
    }

    void finish(Output& output, std::span<float> samples) noexcept
    {
        if (output.motor)
            output.motor->process(samples, samples);
        if (output.filter)
            output.filter->process(samples, samples);
        if (output.scale != 1.0)
            for (float& sample : samples)
                sample = static_cast<float>(output.scale * static_cast<double>(sample));
        if (output.protection)
            output.protection->process(samples, samples);
        if (output.limiter)
            output.limiter->process(samples, samples);
        if (const ProtectionMeter* meter = output.meter())
            reduction = std::max(reduction, meter->gainReduction);
    }

    void make(Voice& voice, const PlannedPlay& planned)
    {
        DecoderParams params = planned.decoder;
        params.sampleRate = fs;
        voice.decoder = std::make_unique<Decoder>(planned.clip, params, planned.timeline.changes);
        decoded.push_back({planned.play, planned.start, static_cast<double>(voice.decoder->totalFrames()) / fs,
                           voice.decoder->report()});
        if (!planned.timeline.delays.empty())
        {
            double longest = 0.0;
            for (const Curve& curve : planned.timeline.delays)
                for (const Breakpoint& point : curve)
                    longest = std::max(longest, point.value);
            voice.delay = DelayTap(longest * fs, blockFrames);
            voice.tail = static_cast<std::int64_t>(std::ceil(longest * fs)) + 4;
        }
    }

    template <typename F>
    void forPlay(std::size_t play, F&& f) noexcept
    {
        for (std::size_t i = 0; i < voices.size(); ++i)
            if (plan.plays[i].play == play)
                f(voices[i], plan.plays[i]);
    }

    void processBlock(std::span<const std::span<float>> out, std::size_t at, std::size_t n) noexcept
    {
        for (const auto& channel : out)
            std::fill_n(channel.begin() + static_cast<std::ptrdiff_t>(at), n, 0.0f);
        const std::int64_t left = endFrame - position;
        const auto sounding = static_cast<std::size_t>(std::clamp<std::int64_t>(left, 0, static_cast<std::int64_t>(n)));
        const std::int64_t end = position + static_cast<std::int64_t>(sounding);
        while (first < voices.size() && voices[first].ended)
            ++first;
        std::size_t count = 0;
        // Plays are in order of start.
        std::size_t last = first;
        while (last < voices.size() && voices[last].start < end)
            ++last;
        for (std::size_t i = first; i < last; ++i)
            if (!voices[i].ended && voices[i].decoder)
            {
                play(voices[i], plan.plays[i], out, at, sounding, last - first == 1);
                ++count;
            }
        most = std::max(most, count);
        for (std::size_t a = 0; a < outputs.size() && a < out.size(); ++a)
            finish(outputs[a], out[a].subspan(at, n));
        position += static_cast<std::int64_t>(n);
    }

    void play(Voice& voice, const PlannedPlay& planned, std::span<const std::span<float>> out, std::size_t at,
              std::size_t n, bool lone) noexcept
    {
        const auto from = static_cast<std::size_t>(std::max<std::int64_t>(voice.start - position, 0));
        if (from >= n)
            return;
        if (lone && isPlain(voice, planned, out.size()))
        {
            // Nothing to mix: what was cleared is overwritten.
            voice.decoder->process(out.front().subspan(at + from, n - from));
            end(voice, position + static_cast<std::int64_t>(n));
            return;
        }
        const auto block = std::span(mono).first(n - from);
        voice.decoder->process(block);
        applyLiveGain(voice, block);
        const std::int64_t now = position + static_cast<std::int64_t>(from);
        const bool delayed = !planned.timeline.delays.empty();
        if (delayed)
            voice.delay.write(block);
        for (std::size_t a = 0; a < std::min(out.size(), plan.actuators); ++a)
        {
            Level& level = voice.levels[a];
            const auto to = out[a].subspan(at + from, block.size());
            if (delayed)
            {
                read(planned.timeline.delays[a], level.delay, now, std::span(delays).first(block.size()));
                for (std::size_t i = 0; i < block.size(); ++i)
                    shifted[i] = voice.delay.read(i, fs * delays[i]);
            }
            mix(planned.timeline.gains[a], level.gain, now, delayed ? std::span(shifted).first(block.size()) : block,
                to);
        }
        end(voice, now + static_cast<std::int64_t>(block.size()));
    }

    static void end(Voice& voice, std::int64_t reached) noexcept
    {
        voice.ended = reached >= voice.start + voice.decoder->totalFrames() + voice.tail;
    }

    /// Whether a play goes to one actuator as it is.
    static bool isPlain(const Voice& voice, const PlannedPlay& planned, std::size_t channels) noexcept
    {
        const auto& gains = planned.timeline.gains;
        return channels == 1 && gains.size() == 1 && gains[0].size() == 1 && gains[0][0].value == 1.0 &&
               voice.liveGain == 1.0 && voice.liveTarget == 1.0;
    }

    void applyLiveGain(Voice& voice, std::span<float> block) noexcept
    {
        if (voice.liveGain == 1.0 && voice.liveTarget == 1.0)
            return;
        for (float& sample : block)
        {
            sample = toSample(voice.liveGain * static_cast<double>(sample));
            const double next = voice.liveGain + voice.liveStep;
            voice.liveGain = voice.liveStep > 0.0 ? std::min(next, voice.liveTarget) : std::max(next, voice.liveTarget);
        }
    }

    void mix(const Curve& gains, std::size_t& next, std::int64_t now, std::span<const float> in,
             std::span<float> out) const noexcept
    {
        forCurvePieces(gains, next, now, in.size(), fs,
                       [&](std::size_t i, std::size_t end, const CurvePiece& piece)
                       {
                           if (piece.slope != 0.0)
                               for (; i < end; ++i)
                                   out[i] += static_cast<float>(piece.at(now + static_cast<std::int64_t>(i)) *
                                                                static_cast<double>(in[i]));
                           else if (piece.value != 0.0)
                               for (; i < end; ++i)
                                   out[i] += static_cast<float>(piece.value * static_cast<double>(in[i]));
                       });
    }

    void read(const Curve& curve, std::size_t& next, std::int64_t now, std::span<double> values) const noexcept
    {
        forCurvePieces(curve, next, now, values.size(), fs,
                       [&](std::size_t i, std::size_t end, const CurvePiece& piece)
                       {
                           for (; i < end; ++i)
                               values[i] = std::max(0.0, piece.at(now + static_cast<std::int64_t>(i)));
                       });
    }

    RenderPlan plan;
    double fs;
    std::int64_t endFrame;
    std::vector<Voice> voices; // as plan.plays
    std::vector<DecodedPlay> decoded;
    std::vector<Output> outputs;
    std::size_t preRoll = 0;
    std::array<float, blockFrames> mono{}, shifted{};
    std::vector<float> discarded;
    std::array<double, blockFrames> delays{};
    std::int64_t position = 0;
    std::size_t first = 0;     // voices before it have ended
    std::size_t firstKept = 0; // voices before it have ended and are freed
    std::size_t most = 0;
    double reduction = 0.0; // dB
};

} // namespace pacini
