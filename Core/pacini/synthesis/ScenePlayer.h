#pragma once

// Scene player: RenderPlan -> drive signals.

#include <pacini/actuator/OutputFilter.h>
#include <pacini/actuator/Protection.h>
#include <pacini/filters/BiquadCascade.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/ActuatorOutput.h>
#include <pacini/synthesis/Decoder.h>
#include <pacini/synthesis/PlayVoice.h>
#include <pacini/synthesis/RenderPlan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace pacini
{

/// Parameters of the scene player.
struct ScenePlayerParams
{
    double sampleRate = 48000.0; ///< Hz, 2000 to 768000; a scene at any other rate has no frames
    Seconds builtUntil{std::numeric_limits<double>::infinity()}; ///< makes the decoders of plays that start before
    bool protect = true;        ///< keep within full drive and the limits of the profile
    Seconds lookAhead{0.001};   ///< of that, 0 to 1 ms; taken out of the output
    Seconds liveDelay{0.0};     ///< the longest of setDelay(); memory for it costs a little time
    bool takeLatencyOut = true; ///< false: the output is delayed by latencyFrames()
    bool filtered = false;      ///< signals beside the scene have passed the output filter, and the scene has no plays
};

/// No signals beside a scene.
struct NoLivePlays
{
    void mix(std::span<const std::span<float>>, std::size_t, std::size_t, std::int64_t) noexcept {}
};

/// Scene player. Plays a plan on its actuators: only plays that are sounding cost anything. The output does not depend
/// on how it is cut into blocks. Decoders take memory: build() makes those that start soon and frees those that have
/// ended, from a thread that may wait; the constructor makes all of them, so that live use need not call it.
class ScenePlayer
{
public:
    explicit ScenePlayer(RenderPlan planToPlay, const ScenePlayerParams& params = {})
        : plan(std::move(planToPlay)),
          fs(clampTo(params.sampleRate, limits::lowestRate, limits::highestRate)),
          liveDelay(params.liveDelay),
          endFrame(frameCount(plan, params.sampleRate))
    {
        for (const PlannedPlay& planned : plan.plays)
            voices.emplace_back(planned, plan.actuators, fs);
        if (isOnePlay(plan))
            voiceFilter = designOutputFilter({plan.profile->equalizer, plan.flattening}, fs);
        if (voiceFilter && voiceFilter->sections.empty())
            voiceFilter.reset();
        if (voiceFilter)
        {
            liveFilter = std::make_unique<OutputFilter>();
            liveFilter->prepare({fs, blockFrames});
            liveFilter->setParams({plan.profile->equalizer, plan.flattening});
            besides.resize(blockFrames);
        }
        const bool filtered = voiceFilter.has_value() || params.filtered;
        if (plan.profile || params.protect)
            for (std::size_t a = 0; a < plan.actuators; ++a)
                outputs.emplace_back(plan, ProcessSpec{fs, blockFrames}, params.protect, params.lookAhead, filtered);
        if (params.takeLatencyOut)
            preRoll = latencyFrames();
        discarded.resize(plan.actuators * blockFrames);
        build(params.builtUntil);
    }

    [[nodiscard]] std::int64_t totalFrames() const noexcept { return endFrame; }
    [[nodiscard]] std::size_t actuators() const noexcept { return plan.actuators; }

    /// Look-ahead of the protection, frames.
    [[nodiscard]] std::size_t latencyFrames() const noexcept
    {
        return outputs.empty() ? 0 : outputs.front().latencyFrames();
    }

    /// Makes the decoders of plays that start before `until` (of the scene) and frees those that have ended. Not
    /// while process() runs. [worker]
    void build(Seconds until)
    {
        while (firstKept < voices.size() && voices[firstKept].ended() && !voices[firstKept].decoding())
            ++firstKept;
        // Plays are in order of start.
        for (std::size_t i = firstKept; i < voices.size() && (voices[i].ended() || plan.plays[i].start < until.value);
             ++i)
            if (voices[i].ended())
                voices[i].release();
            else if (!voices[i].decoding())
                prepare(voices[i], plan.plays[i]);
    }

    /// The plays whose decoders have been made, in order of start. [worker]
    [[nodiscard]] const std::vector<DecodedPlay>& decodedPlays() const noexcept { return decoded; }

    /// Largest number of plays that sound at a time so far, for reports.
    [[nodiscard]] std::size_t maxSounding() const noexcept { return most; }

    /// The most that the protection of any actuator has taken so far, dB, for reports.
    [[nodiscard]] double maxReduction() const noexcept { return reduction; }

    /// Writes the next frames: one span for each actuator, all of the same length; silence after the end. [audio]
    void process(std::span<const std::span<float>> out) noexcept
    {
        NoLivePlays nothing;
        process(out, nothing);
    }

    /// The same, with live signals beside the scene: live.mix(out, at, n, now) adds frames [at, at + n) to `out`, the
    /// first of which is frame `now` of the scene. [audio]
    template <typename Live>
    void process(std::span<const std::span<float>> out, Live& live) noexcept
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
            processBlock(std::span(unheard).first(channels), 0, n, live);
            preRoll -= n;
        }
        for (std::size_t done = 0; done < frames;)
        {
            const std::size_t n = std::min(frames - done, blockFrames);
            processBlock(out, done, n, live);
            done += n;
        }
    }

    /// Activity of an actuator's protection in the last call of process(), or in the last 1024 frames of a longer one;
    /// null without protection. [audio]
    [[nodiscard]] const ProtectionMeter* protectionMeter(std::size_t actuator = 0) const noexcept
    {
        return actuator < outputs.size() ? outputs[actuator].meter() : nullptr;
    }

    /// From the next frame on, glides play `play` of the scene (its index there) to `gain` (linear, -1000 to 1000, on
    /// top of the scene's own) within `glide`. Gains beyond are clamped, those that are not finite ignored. Plays that
    /// the plan leaves out stay out. [audio]
    void setGain(std::size_t play, double gain, Seconds glide = Seconds(0.005)) noexcept
    {
        if (std::isfinite(gain))
            forVoices(play, [&](PlayVoice& voice)
                      { voice.setFader(Fader::play, clampTo(gain, -maxGain, maxGain), frames(glide)); });
    }

    /// The same for its position over the actuators (0-1), from now on instead of the scene's. [audio]
    void setPan(std::size_t play, double pan, Seconds glide = Seconds(0.005)) noexcept
    {
        if (std::isfinite(pan))
            forVoices(play, [&](PlayVoice& voice) { voice.setPan(clampTo(pan, 0.0, 1.0), frames(glide)); });
    }

    /// The same for its delay, on top of the scene's; up to ScenePlayerParams::liveDelay. [audio]
    void setDelay(std::size_t play, Seconds delay, Seconds glide = Seconds(0.05)) noexcept
    {
        if (std::isfinite(delay.value))
            forVoices(play, [&](PlayVoice& voice) { voice.setDelay(delay.value, frames(glide)); });
    }

    /// Changes pitch (semitones) and speed of a play, as Decoder::change does: what is not finite is ignored. [audio]
    void setPitchAndSpeed(std::size_t play, double transposition, double stretch) noexcept
    {
        forVoices(play, [&](PlayVoice& voice) { voice.change(transposition, stretch); });
    }

private:
    static constexpr std::size_t blockFrames = MixBuffers::frames;
    static constexpr double maxGain = 1000.0; // 60 dB, as in scenes

    template <typename Use>
    void forVoices(std::size_t play, Use&& use) noexcept
    {
        for (std::size_t i = 0; i < voices.size(); ++i)
            if (plan.plays[i].play == play)
                use(voices[i]);
    }

    [[nodiscard]] std::size_t frames(Seconds glide) const noexcept { return framesOfGlide(glide, fs); }

    /// Whether all that the output filter gets is one play as it is: then its decoder filters it, which costs less. The
    /// play's live gain acts behind the filter then.
    [[nodiscard]] static bool isOnePlay(const RenderPlan& plan) noexcept
    {
        if (!plan.profile || plan.motor || plan.actuators != 1 || plan.plays.size() != 1 || plan.plays.front().texture)
            return false;
        const PlayTimeline& timeline = plan.plays.front().timeline;
        return !hasRoleLevels(timeline) && timeline.delays.empty() && timeline.gains.size() == 1 &&
               timeline.gains[0].size() == 1 && timeline.gains[0][0].value == 1.0;
    }

    void prepare(PlayVoice& voice, const PlannedPlay& planned)
    {
        voice.prepare(planned, {voiceFilter ? &*voiceFilter : nullptr, endFrame, &plan.row, liveDelay});
        const Decoder& decoder = *voice.decoding();
        decoded.push_back(
            {planned.play, planned.start, static_cast<double>(decoder.totalFrames()) / fs, decoder.report()});
    }

    template <typename Live>
    void processBlock(std::span<const std::span<float>> out, std::size_t at, std::size_t n, Live& live) noexcept
    {
        for (const auto& channel : out)
            std::fill_n(channel.begin() + static_cast<std::ptrdiff_t>(at), n, 0.0f);
        mixVoices(out, at, n);
        if (!voiceFilter)
            live.mix(out, at, n, position);
        else if (!std::is_same_v<Live, NoLivePlays>)
            addFiltered(out, at, n, live);
        for (std::size_t a = 0; a < outputs.size() && a < out.size(); ++a)
        {
            outputs[a].process(out[a].subspan(at, n));
            if (const ProtectionMeter* meter = outputs[a].meter())
                reduction = std::max(reduction, meter->gainReduction);
        }
        position += static_cast<std::int64_t>(n);
    }

    /// Separate filter for signals beside the one voice that is filtered itself.
    template <typename Live>
    void addFiltered(std::span<const std::span<float>> out, std::size_t at, std::size_t n, Live& live) noexcept
    {
        const std::span<float> beside = std::span(besides).first(n);
        std::fill(beside.begin(), beside.end(), 0.0f);
        live.mix(std::span(&beside, 1), 0, n, position);
        liveFilter->process(beside, beside);
        for (std::size_t i = 0; i < n; ++i)
            out.front()[at + i] += beside[i];
    }

    void mixVoices(std::span<const std::span<float>> out, std::size_t at, std::size_t n) noexcept
    {
        const std::int64_t left = endFrame - position;
        // A filter rings on behind the end.
        const std::size_t sounding =
            voiceFilter ? n : static_cast<std::size_t>(std::clamp<std::int64_t>(left, 0, static_cast<std::int64_t>(n)));
        const std::int64_t end = position + static_cast<std::int64_t>(sounding);
        while (first < voices.size() && voices[first].ended())
            ++first;
        std::size_t count = 0;
        // Plays are in order of start.
        std::size_t last = first;
        while (last < voices.size() && voices[last].startFrame() < end)
            ++last;
        for (std::size_t i = first; i < last; ++i)
            if (!voices[i].ended() && voices[i].decoding())
            {
                voices[i].mix(plan.plays[i], {out, at, sounding, position}, last - first == 1, buffers);
                ++count;
            }
        most = std::max(most, count);
    }

    RenderPlan plan;
    double fs;
    Seconds liveDelay;
    std::int64_t endFrame;
    std::vector<PlayVoice> voices; // as plan.plays
    std::vector<DecodedPlay> decoded;
    std::optional<BiquadCascadeCoefficients> voiceFilter; // where the one voice is filtered, not the output
    std::unique_ptr<OutputFilter> liveFilter;             // of what plays beside it
    std::vector<ActuatorOutput> outputs;
    std::size_t preRoll = 0;
    MixBuffers buffers;
    std::vector<float> discarded, besides;
    std::int64_t position = 0;
    std::size_t first = 0;     // voices before it have ended
    std::size_t firstKept = 0; // voices before it have ended and are freed
    std::size_t most = 0;
    double reduction = 0.0; // dB
};

} // namespace pacini
