#pragma once

// Translator engine at the inner rate: analysis of the sound and synthesis of the vibration.

#include <pacini/realtime/CarrierSection.h>
#include <pacini/realtime/DriveStage.h>
#include <pacini/realtime/HeardVoice.h>
#include <pacini/realtime/HighBandVoice.h>
#include <pacini/realtime/LiveOnsetDetector.h>
#include <pacini/realtime/TranslatorDesign.h>
#include <pacini/synthesis/TransientPulse.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace pacini
{

/// Noise gate. Opens at once when the level passes the threshold (the jump is as small as the threshold), stays open
/// while the level is above half of it or was so during the release, and closes over another release, without a corner.
/// Where the threshold passes the level instead, it opens likewise: that jump may be large.
class LiveGate
{
public:
    /// `threshold` linear, `releaseFrames` at least 1, `openFrames` for a threshold that moves.
    void setParams(double threshold, double releaseFrames, double openFrames = 1.0) noexcept
    {
        if (begun && threshold < limit)
            rise = 1.0 / openFrames;
        limit = threshold;
        fall = 1.0 / releaseFrames;
        held = static_cast<std::size_t>(releaseFrames);
    }
    void reset() noexcept
    {
        gain = 0.0;
        rise = 1.0;
        left = 0;
        begun = false;
    }

    [[nodiscard]] double tick(double level) noexcept
    {
        begun = true;
        if (level >= limit || (left > 0 && level >= 0.5 * limit))
        {
            left = held;
            gain = std::min(1.0, gain + rise);
            if (gain == 1.0)
                rise = 1.0;
        }
        else if (left > 0)
            --left;
        else
        {
            gain = std::max(0.0, gain - fall);
            rise = 1.0;
        }
        return gain * gain * (3.0 - 2.0 * gain);
    }

    [[nodiscard]] bool closed() const noexcept { return gain == 0.0; }

private:
    double limit = 0.0;
    double fall = 1.0;
    std::size_t held = 0;
    std::size_t left = 0;
    double gain = 0.0;
    double rise = 1.0;
    bool begun = false;
};

/// Pulse voices. Pulses start at once; when all voices are busy, a new pulse replaces the oldest, which has almost
/// ended.
class EventPulses
{
public:
    void reset() noexcept { *this = EventPulses(); }

    /// Starts a pulse at frame `after` of the next call of addTo().
    void begin(const Pulse& pulse, double gain, std::size_t after) noexcept
    {
        voices[next] = {PulseVoice(pulse), gain, after};
        next = (next + 1) % voices.size();
        ++sounding;
    }

    [[nodiscard]] bool silent() const noexcept { return sounding == 0; }

    void addTo(std::span<float> out) noexcept
    {
        sounding = 0;
        for (Voice& voice : voices)
            if (!voice.pulse.finished())
            {
                const std::size_t wait = std::min(std::exchange(voice.after, 0), out.size());
                voice.pulse.addTo(out.subspan(wait), voice.gain);
                sounding += voice.pulse.finished() ? 0u : 1u;
            }
    }

private:
    struct Voice
    {
        PulseVoice pulse;
        double gain = 0.0;
        std::size_t after = 0;
    };

    std::array<Voice, 4> voices{};
    std::size_t next = 0;
    std::size_t sounding = 0;
};

/// Translator engine. Runs on frames of the inner rate, decides on a fixed grid (see ControlHop.h), so that its output
/// does not depend on how it is called. Asleep, in silence, it does nothing.
class TranslatorEngine
{
public:
    /// Takes a design, which must stay where it is until the next one. Silence follows. Only the limits of limiter and
    /// motor are computed here.
    void adopt(const TranslatorDesign& wanted) noexcept
    {
        design = &wanted;
        const double fs = wanted.innerRate;
        meter = wanted.meter;
        direct = wanted.direct;
        carriers.adopt(wanted);
        stage.adopt(wanted);
        if (fs != rate)
        {
            rate = fs;
            watch.prepare(fs);
            bright.design(fs);
        }
        heardVoice.design(wanted.lowest, wanted.highest, fs);
        gainShare = hopShare(0.005, fs);
        glideShare = hopShare(0.006, fs);
        levelShare = hopShare(0.030, fs);
        peakDecay = 1.0 - hopShare(0.020, fs);
        clearSignal();
        setParams(params);
        jumpShares();
    }

    /// Linear gains and the like of clamped parameters. [audio]
    void setParams(const TranslatorParams& wanted) noexcept
    {
        params = wanted;
        const auto gain = [](double level)
        {
            return Decibels(level).gain();
        };
        const auto role = [&](const RoleParams& r)
        {
            return r.muted ? 0.0 : gain(r.level);
        };
        inputGain = gain(params.inputGain);
        rumble = role(params.rumble);
        texture = role(params.texture);
        transients = role(params.transients);
        intensity = gain(params.intensity);
        brightness = params.brightness > lowestBrightness ? gain(params.brightness) : 0.0;
        transposition = std::exp2(params.transposition / 12.0);
        attackShare = hopShare(0.001 * params.attack, rate);
        releaseShare = hopShare(0.001 * params.release, rate);
        threshold = baseThreshold * gain(30.0 * (0.5 - params.transientSensitivity));
        gate.setParams(gain(params.gateThreshold), 0.001 * params.gateRelease * rate, gateOpening * rate);
        if (!begun)
            jumpToParams();
    }

    void reset() noexcept
    {
        clearSignal();
        watch.reset();
        gate.reset();
        framesIntoHop = 0;
        frame = 0;
        begun = false;
        jumpToParams();
    }

    /// Whether process() analyses the samples above the range of the frames.
    [[nodiscard]] bool wantsHighs() const noexcept { return audibleShare() > 0.0 || !heardVoice.silent(); }

    /// All spans of one length: band-limited frames, full-band peaks and, where they are wanted and else none, levels
    /// (RMS) of what lies above the frames in, drive out. `onEvent(frame, level)` is
    /// called for every event, with the frame since reset.
    template <typename OnEvent>
    void process(std::span<const float> in, std::span<const float> peaks, std::span<const float> highs,
                 std::span<float> out, OnEvent&& onEvent) noexcept
    {
        std::size_t done = 0;
        while (done < in.size())
        {
            if (framesIntoHop == 0)
                beginHop();
            const std::size_t n = std::min(in.size() - done, controlHop - framesIntoHop);
            run(in.subspan(done, n), peaks.subspan(done, n), highs.empty() ? highs : highs.subspan(done, n),
                out.subspan(done, n), onEvent);
            done += n;
            frame += n;
            framesIntoHop = (framesIntoHop + n) % controlHop;
        }
    }

    [[nodiscard]] double bandPower(std::size_t k) const noexcept { return bandPowers[k]; }
    /// The smallest gain of the limiter since the last call.
    [[nodiscard]] double takeLimiterGain() noexcept { return stage.takeLimiterGain(); }

private:
    static constexpr double baseThreshold = 1.0;
    static constexpr double gateOpening = 0.060; // s
    // The felt level of an event is its peak below 3 kHz, clamped to these shares of its full-band peak. Bright clicks
    // have little energy below 3 kHz but must be felt.
    static constexpr double leastShare = 0.06;
    static constexpr double brightShare = 0.25;

    void clearSignal() noexcept
    {
        meter.reset();
        direct.reset();
        carriers.reset();
        bright.reset();
        heardVoice.reset();
        pulses.reset();
        stage.reset();
        bandPowers = {};
        playedEnergy = playedPeak = heardPeak = 0.0;
        loudest = 0.0;
        asleep = false;
    }

    void jumpToParams() noexcept
    {
        if (!design)
            return;
        input.jump(inputGain);
        stage.jump(intensity);
        ratio.jump(transposition);
        jumpShares();
    }

    void jumpShares() noexcept
    {
        rumbleGain.jump(rumble);
        textureGain.jump(texture);
        ownShare.jump(directShare());
        levelling.jump(levelShareWanted());
        direct.jump(rumble * directShare(), texture * directShare());
        bright.jump(brightGain());
        heardShare.jump(audibleShare());
        heardVoice.jump(audibleShare());
    }

    /// Returns how far carriers are brought to the strength of the whole range, if no band is played by its own signal.
    [[nodiscard]] double levelShareWanted() const noexcept
    {
        return directShare() == 0.0 || !design->anyDirect ? 1.0 : 0.0;
    }

    /// Returns the share of a band's own signal, within the range of the actuator.
    [[nodiscard]] double directShare() const noexcept
    {
        if (design->motor)
            return 1.0;
        return design->anyDirect && params.transposition == 0.0 ? params.direct : 0.0;
    }

    [[nodiscard]] double brightGain() const noexcept
    {
        return design->brightFrequency > 0.0 ? texture * brightness : 0.0;
    }

    [[nodiscard]] double audibleShare() const noexcept
    {
        return design->playsHeard && texture > 0.0 ? params.audible : 0.0;
    }

    void beginHop() noexcept
    {
        begun = true;
        input.aim(inputGain, glideShare);
        stage.aim(intensity, gainShare, playedPeak, playedEnergy);
        ratio.aim(transposition, glideShare);
        rumbleGain.aim(rumble, glideShare);
        textureGain.aim(texture, glideShare);
        ownShare.aim(directShare(), glideShare);
        levelling.aim(levelShareWanted(), glideShare);
        heardShare.aim(audibleShare(), glideShare);

        // A hop without any sign of life: what may be left is 180 dB below full scale.
        const bool wasAsleep =
            std::exchange(asleep, frame > 0 && loudest < 1e-9 && pulses.silent() && !stage.bursting());
        if (asleep && !wasAsleep)
        {
            meter.reset();
            direct.reset();
            carriers.reset();
            bright.reset();
            heardVoice.reset();
            stage.rest();
            bandPowers = {};
        }
        loudest = 0.0;

        direct.aim(rumble * directShare(), texture * directShare(), glideShare);
        double played = 0.0; // power (amplitude squared) of the bands
        double low = 0.0;    // of those that mask what is heard
        std::array<double, maxTranslatorBands> carrierGains{};
        for (std::size_t k = 0; k < design->bands.size(); ++k)
        {
            const TranslatorBand& band = design->bands[k];
            const double role = (band.rumble ? rumbleGain : textureGain).end();
            if (!design->motor)
                carrierGains[k] = role * (band.shown ? 1.0 - ownShare.end() : 1.0);
            const double power = 2.0 * meter.takePower(k) / static_cast<double>(controlHop);
            bandPowers[k] += levelShare * (power - bandPowers[k]);
            flushTiny(bandPowers[k]);
            played += role * role * bandPowers[k];
            low += band.centre.value < heardMaskedBy ? role * role * bandPowers[k] : 0.0;
        }
        noteEvent();
        heardVoice.aim(heardShare.end(), textureGain.end(), 1.0, std::sqrt(played), low);
        carriers.aim(carrierGains, ratio.end(), attackShare, releaseShare, levelling.end(), ownShare.end());
        bright.aim((1.0 - heardVoice.share()) * brightGain(), glideShare, design->brightFrequency / rate);
        playedEnergy = 0.0;
        playedPeak *= peakDecay;
        heardPeak *= peakDecay;
        for (double* value : {&playedPeak, &heardPeak})
            flushTiny(*value);
        meter.flush();
        direct.flush();
        carriers.flush();
        bright.flush();
        heardVoice.flush();
        watch.flush();
    }

    /// Sinusoids that are added to the sound's own signal begin again with an event of the last hop.
    void noteEvent() noexcept
    {
        if (directShare() == 0.0 || watch.framesSinceEvent() >= controlHop)
            return;
        const auto frames = static_cast<double>(watch.framesSinceEvent() + 1);
        carriers.noteEvent(frames);
        bright.noteEvent(frames);
        heardVoice.noteEvent(frames);
    }

    template <typename OnEvent>
    void run(std::span<const float> in, std::span<const float> peaks, std::span<const float> highs,
             std::span<float> out, OnEvent&& onEvent) noexcept
    {
        const std::size_t n = in.size();
        std::array<double, controlHop> x{}, y{}, h{}, gates{};
        const bool rising = input.end() > 1.02 * input.start(); // what the gain makes of a steady sound is no event
        double heard = 0.0;
        std::size_t eventAt = n;
        HeardEvent event;
        for (std::size_t i = 0; i < n; ++i)
        {
            const double g = input.at(framesIntoHop + i);
            x[i] = g * static_cast<double>(in[i]);
            const double peak = g * static_cast<double>(peaks[i]);
            if (!highs.empty())
                h[i] = g * static_cast<double>(highs[i]);
            gates[i] = gate.tick(peak);
            heard = std::max({heard, std::abs(x[i]), peak});
            if (watch.tick(peak, threshold, event) && gates[i] > 0.0 && !rising)
                eventAt = i; // events are farther apart than a hop
        }
        loudest = std::max(loudest, heard);
        if (asleep && heard == 0.0 && pulses.silent() && eventAt == n)
        {
            std::fill(out.begin(), out.end(), 0.0f);
            return;
        }
        asleep = false;
        const auto xs = std::span<const double>(x).first(n);
        const auto ys = std::span<double>(y).first(n);
        meter.process(xs);
        if (!direct.silent())
            direct.process(xs, ys, framesIntoHop);
        carriers.process(xs, ys, framesIntoHop);
        if (!bright.silent())
            bright.process(xs, ys, framesIntoHop);
        if (!heardVoice.silent())
            heardVoice.process(xs, std::span<const double>(h).first(highs.size()), ys, framesIntoHop);
        for (std::size_t i = 0; i < n; ++i)
        {
            heardPeak = std::max(heardPeak, std::abs(x[i]));
            playedPeak = std::max(playedPeak, std::abs(y[i]));
            playedEnergy += y[i] * y[i];
            out[i] = static_cast<float>(y[i]);
            if (i == eventAt)
            {
                onEvent(frame + i - std::min<std::uint64_t>(frame + i, watch.delayFrames()), event.amplitude);
                beginPulse(event, i);
            }
        }
        if (!pulses.silent() && !design->motor)
            pulses.addTo(out);
        loudest = std::max(loudest, stage.process(out, gates, framesIntoHop));
    }

    /// Raises an event from the level of the bands to its felt level with a pulse. An event is sharp if little of it
    /// lies in the range of touch.
    void beginPulse(const HeardEvent& event, std::size_t at) noexcept
    {
        const double felt = std::clamp(heardPeak, leastShare * event.amplitude, brightShare * event.amplitude);
        const double wanted = std::min(1.0, transients * felt);
        if (design->motor)
        {
            if (wanted > 0.0)
                stage.beginBurst(wanted);
            return;
        }
        const double missing = wanted - playedPeak;
        if (!(missing > 0.05 * wanted))
            return;
        const double share = std::min(1.0, heardPeak / std::max(event.amplitude, 1e-9));
        const double sharpness = std::clamp(1.0 - share + params.transientSharpness, 0.0, 1.0);
        pulses.begin(makePulse(design->pulses, sharpness, event.gap, rate, ratio.end()), missing, at);
    }

    const TranslatorDesign* design = nullptr;
    double rate = 0.0;
    TranslatorParams params;
    double inputGain = 1.0, rumble = 1.0, texture = 1.0, transients = 1.0, brightness = 0.5, intensity = 1.0,
           transposition = 1.0;
    double attackShare = 1.0, releaseShare = 1.0, threshold = baseThreshold;
    double gainShare = 1.0, glideShare = 1.0, levelShare = 1.0, peakDecay = 0.9;

    LiveGate gate;
    LiveOnsetDetector watch;
    EventPulses pulses;
    BandMeter meter;
    DirectPath direct;
    CarrierSection carriers;
    HighBandVoice bright;
    HeardVoice heardVoice;
    DriveStage stage;

    HopGlide input, ratio, rumbleGain, textureGain, ownShare, levelling, heardShare;
    double playedEnergy = 0.0;                // in this hop
    double playedPeak = 0.0, heardPeak = 0.0; // of late
    double loudest = 0.0;                     // in this hop, of input and output
    std::array<double, maxTranslatorBands> bandPowers{};
    std::size_t framesIntoHop = 0;
    std::uint64_t frame = 0;
    bool begun = false;
    bool asleep = false;
};

} // namespace pacini
