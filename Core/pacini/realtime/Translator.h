#pragma once

// Live translator: sound in, touch out.

#include <pacini/actuator/Protection.h>
#include <pacini/analysis/VoiceGate.h>
#include <pacini/filters/PolyphaseInterpolator.h>
#include <pacini/filters/WholeDecimator.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Fade.h>
#include <pacini/foundation/HandOver.h>
#include <pacini/foundation/LargestMagnitude.h>
#include <pacini/foundation/Units.h>
#include <pacini/realtime/TranslatorDesign.h>
#include <pacini/realtime/TranslatorEngine.h>
#include <pacini/realtime/TranslatorMeters.h>
#include <pacini/realtime/TranslatorParams.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Live translator: a block of mono audio in, a block of drive out, both at the host's rate. Analysis and synthesis run
/// at an inner rate of 6 to 12 kHz (see TranslatorEngine); linear-phase filters lead there and back and are all of
/// latencyFrames(): 1.3 ms at 48 kHz, never more than 1.4 ms. The latency depends on the host's rate only.
///
/// Where the actuator can show a band its own signal is played, scaled by its role: nothing that was in the sound is
/// then lost, and nothing is smeared. What it cannot show is played by sinusoids that follow the band's strength and
/// pitch, moved to where it can. Events that the range of touch holds too little of are topped by pulses.
///
/// Threads: prepare() and setSetup() [message]; setParams(), reset() and process() [audio]; meters() [any].
class Translator
{
public:
    using Params = TranslatorParams;

    Translator() { prepare(ProcessSpec{}); }

    /// Allocates; process() must not run.
    void prepare(const ProcessSpec& spec)
    {
        fs = spec.sampleRate;
        const std::size_t factor = translatorFactor(fs);
        const double inner = fs / static_cast<double>(factor);
        decimator = WholeDecimator(factor, fs, passFrequency);
        interpolator = std::make_unique<PolyphaseInterpolator>(factor, std::min(passFrequency / inner, 0.44));
        latency = decimator.latencyFrames() + interpolator->latencyFrames();
        const std::size_t frames = longestPiece / factor + 2;
        inFrames.assign(frames, 0.0f);
        peaks.assign(frames, 0.0f);
        highs.assign(frames, 0.0f);
        outFrames.assign(frames, 0.0f);
        ready.assign((frames + 1) * factor, 0.0f);
        dry.assign(latency + longestPiece, 0.0f);
        quieter.assign(longestPiece, 0.0f);
        voiceGate.prepare({fs, longestPiece});
        protection.prepare({fs, longestPiece});
        fade.prepare(static_cast<std::size_t>(0.015 * fs));
        bypass.prepare(static_cast<std::size_t>(0.010 * fs));
        tailShare = std::min(1.0, 1.0 / (0.010 * fs));
        sendDesign();
        reset();
    }

    /// Another actuator or other bands: the set is designed here and handed over; the audio thread fades out within 15
    /// ms, takes it and fades in. The latency stays. [message]
    void setSetup(const TranslatorSetup& wanted)
    {
        setup = wanted;
        sendDesign();
    }

    /// The parts that the newest set-up and `params` leave out, with the reasons. [message]
    [[nodiscard]] TranslatorPlan plan(const Params& wanted) const
    {
        return translatorPlan(designTranslator(setup, fs), wanted);
    }

    /// Takes effect on the next point of the control grid, about 1 ms, smoothly; right after reset() at once. Values
    /// that are not finite leave the ones before. [audio]
    void setParams(const Params& wanted) noexcept
    {
        const Params valid = clamped(wanted, current);
        if (valid == current)
            return;
        current = valid;
        engine.setParams(valid);
        voiceGate.setParams({valid.speech});
        bypass.aim(valid.bypass ? 1.0 : 0.0);
        if (!begun)
            bypass.jump(valid.bypass ? 1.0 : 0.0);
    }

    /// Silence, the newest set-up, the parameters as they are. [audio]
    void reset() noexcept
    {
        takeDesign();
        engine.reset();
        decimator.reset();
        voiceGate.reset();
        interpolator->reset();
        protection.reset();
        std::fill(dry.begin(), dry.end(), 0.0f);
        dryFrames = leftOver = 0;
        zeroFrames = 0;
        bypass.jump(current.bypass ? 1.0 : 0.0);
        fade.jump(1.0);
        settling = 0;
        last = tail = 0.0;
        begun = false;
        readings->reset();
    }

    /// Takes that `frames` frames of silence went by without process(), after as many as silence needs to come to rest:
    /// only coils still cooled. [audio]
    void pass(double frames) noexcept
    {
        if (held && held->content.protection)
            protection.pass(frames);
    }

    /// Any number of frames, 0 too; `in` and `out` of one length may be the same memory. Not finite input counts as 0.
    /// The drive stays within +-1. [audio]
    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        double peak = 0.0;
        double reduction = 0.0;
        for (std::size_t i = 0; i < in.size();)
        {
            changeDesign();
            std::size_t n = std::min(longestPiece, in.size() - i);
            if (!fade.resting())
                n = std::min(n, fade.framesLeft()); // the design changes where the fade ends
            else if (settling > 0)
                n = std::min(n, settling);
            piece(in.subspan(i, n), out.subspan(i, n));
            peak = std::max(peak, static_cast<double>(largestMagnitude(out.subspan(i, n))));
            reduction = std::max(reduction, held->content.protection ? protection.gainReduction() : 0.0);
            i += n;
            settling -= std::min(settling, n);
        }
        if (in.empty())
            return;
        for (std::size_t k = 0; k < held->content.bands.size(); ++k)
            readings->setBand(k, engine.bandPower(k));
        readings->setOutput(peak, std::max(reduction, -Decibels::fromGain(engine.takeLimiterGain()).value));
    }

    /// Delay of the drive against the sound, frames.
    [[nodiscard]] std::size_t latencyFrames() const noexcept { return latency; }

    /// Frames after a reset until a sound that was there before is played steadily. [audio]
    [[nodiscard]] std::size_t settlingFrames() const noexcept
    {
        return static_cast<std::size_t>((held->content.motor ? 0.100 : 0.010) * fs);
    }

    [[nodiscard]] const TranslatorMeters& meters() const noexcept { return *readings; }

private:
    using Designs = HandOver<TranslatorDesign>;

    static constexpr std::size_t longestPiece = 256;
    static constexpr double passFrequency = 1000.0; // Hz

    /// Gives a node back to be freed when the translator ends.
    struct FreeNode
    {
        void operator()(Designs::Node* node) const noexcept { delete node; }
    };

    void sendDesign() { designs->send(designTranslator(setup, fs)); }

    /// Fades out where a design waits, takes it, and fades in when its filters have settled.
    void changeDesign() noexcept
    {
        if (designs->waiting())
        {
            fade.aim(0.0);
            if (!begun) // there is nothing to fade
                takeDesign();
            else if (fade.restsAt(0.0))
            {
                takeDesign();
                settling = settlingFrames();
                tail = last;
            }
        }
        if (!designs->waiting() && settling == 0)
            fade.aim(1.0);
    }

    void takeDesign() noexcept
    {
        Designs::Node* node = designs->receive();
        if (!node)
            return;
        const TranslatorDesign& design = node->content;
        // Only another actuator is at rest and cold: the same one goes on moving while the drive fades.
        const bool same = held && held->content.protection == design.protection;
        designs->giveBack(held.release());
        held.reset(node);
        engine.adopt(design);
        if (design.protection)
            protection.setParams(*design.protection);
        if (!same)
            protection.reset();
        readings->setBands(design.bands.size(), design.feltRange);
    }

    void piece(std::span<const float> in, std::span<float> out) noexcept
    {
        begun = true;
        const std::size_t frames = decimator.framesFor(in.size());
        const auto x = std::span(inFrames).first(frames);
        const auto p = std::span(peaks).first(frames);
        const auto y = std::span(outFrames).first(frames);
        const auto h = std::span(highs).first(engine.wantsHighs() ? frames : 0);
        decimator.process(withoutSpeech(in), x, p, h);
        keepDry(in);
        translate(x, p, h, y);

        const std::size_t factor = decimator.factor();
        raise(y, std::span(ready).subspan(leftOver, frames * factor));
        const std::size_t made = leftOver + frames * factor;
        std::copy_n(ready.begin(), in.size(), out.begin());
        std::copy(ready.begin() + static_cast<std::ptrdiff_t>(in.size()),
                  ready.begin() + static_cast<std::ptrdiff_t>(made), ready.begin());
        leftOver = made - in.size();

        if (!fade.restsAt(1.0))
            for (float& sample : out)
                sample *= static_cast<float>(fade.next());
        if (!bypass.restsAt(0.0))
            mixDry(out);
        for (std::size_t i = 0; i < out.size() && tail != 0.0; ++i)
        {
            tail = std::abs(tail) > 1e-7 ? tail - tailShare * tail : 0.0;
            out[i] += static_cast<float>(tail);
        }
        if (held->content.protection)
            protection.process(out, out);
        else
            for (float& sample : out)
                sample = sample > 1.0f ? 1.0f : (sample < -1.0f ? -1.0f : sample);
        if (!out.empty())
            last = static_cast<double>(out.back());
    }

    [[nodiscard]] std::span<const float> withoutSpeech(std::span<const float> in) noexcept
    {
        if (!voiceGate.isOn())
            return in;
        const auto out = std::span(quieter).first(in.size());
        voiceGate.process(in, out);
        return out;
    }

    void translate(std::span<const float> x, std::span<const float> p, std::span<const float> h,
                   std::span<float> y) noexcept
    {
        const auto onEvent = [this](std::uint64_t frame, double level)
        {
            readings->noteEvent(frame * decimator.factor(), level);
        };
        engine.process(x, p, h, y, onEvent);
    }

    /// Resamples to the host's rate; silence costs nothing.
    void raise(std::span<const float> y, std::span<float> to) noexcept
    {
        const bool silent = std::all_of(y.begin(), y.end(), [](float v) { return v == 0.0f; });
        const std::size_t taps = 2 * interpolator->latencyFrames() / interpolator->factor();
        if (silent && zeroFrames >= taps)
            std::fill(to.begin(), to.end(), 0.0f);
        else
            interpolator->process(y, to);
        zeroFrames = silent ? std::min(zeroFrames + y.size(), taps) : 0;
    }

    /// dry holds the newest `latency` frames of the input and, behind them, this piece.
    void keepDry(std::span<const float> in) noexcept
    {
        std::copy(dry.begin() + static_cast<std::ptrdiff_t>(dryFrames),
                  dry.begin() + static_cast<std::ptrdiff_t>(dryFrames + latency), dry.begin());
        for (std::size_t i = 0; i < in.size(); ++i)
            dry[latency + i] = toSample(finiteOrZero(in[i]));
        dryFrames = in.size();
    }

    void mixDry(std::span<float> out) noexcept
    {
        for (std::size_t i = 0; i < out.size(); ++i)
        {
            const auto share = static_cast<float>(bypass.next());
            out[i] = share * dry[i] + (1.0f - share) * out[i];
        }
    }

    double fs = ProcessSpec{}.sampleRate;
    TranslatorSetup setup;
    Params current;
    std::unique_ptr<Designs> designs = std::make_unique<Designs>();
    std::unique_ptr<TranslatorMeters> readings = std::make_unique<TranslatorMeters>();
    std::unique_ptr<Designs::Node, FreeNode> held;
    TranslatorEngine engine;
    VoiceGate voiceGate;
    WholeDecimator decimator;
    std::unique_ptr<PolyphaseInterpolator> interpolator;
    Protection protection;
    std::vector<float> inFrames, peaks, highs, outFrames;
    std::vector<float> ready; // drive that is made but not given out
    std::vector<float> dry;
    std::vector<float> quieter; // sound with less speech
    std::size_t dryFrames = 0;
    std::size_t leftOver = 0;
    std::size_t zeroFrames = 0;
    std::size_t latency = 0;
    Fade fade;                // out and in, around a change of the design
    std::size_t settling = 0; // frames until the fade in
    double last = 0.0;        // sample that went out
    double tail = 0.0;        // of what the protection of the design before had still to give out
    double tailShare = 1.0;
    Fade bypass; // the share of `dry`
    bool begun = false;
};

static_assert(DspBlock<Translator>);

} // namespace pacini
