// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/engine/LiveEngine.h"

#include "live/LiveDrive.h"

#include <pacini/foundation/LargestMagnitude.h>
#include <pacini/realtime/Translator.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace pacini::plugin
{

namespace
{
/// Of the engine, for a translator that has one of its own at that rate.
std::size_t engineLatency(double sampleRate, std::size_t ofTranslator)
{
    constexpr double commonRate = 48000.0, lowestOfThem = 44100.0; // Hz
    if (sampleRate < lowestOfThem || sampleRate >= commonRate)
        return ofTranslator;
    Translator common;
    common.prepare({commonRate, 1});
    return std::max(ofTranslator, common.latencyFrames());
}

/// Whether all samples are 0. By their bits, without a branch for each; what is not a number is no silence. Sound is
/// found out by its first samples.
template <typename Sample>
bool isSilent(std::span<const std::span<Sample>> channels) noexcept
{
    constexpr std::uint32_t allButSign = 0x7fffffff;
    constexpr std::size_t some = 64;
    for (const auto& channel : channels)
        for (std::size_t done = 0; done < channel.size(); done += some)
        {
            std::uint32_t bits = 0;
            for (const float x : channel.subspan(done, std::min(some, channel.size() - done)))
                bits |= std::bit_cast<std::uint32_t>(x);
            if ((bits & allButSign) != 0)
                return false;
        }
    return true;
}
} // namespace

LiveEngine::LiveEngine()
{
    voices[0].translator = std::make_unique<Translator>();
    latency = voices[0].translator->latencyFrames();
}

LiveEngine::~LiveEngine() = default;

void LiveEngine::prepare(double sampleRate, std::size_t mainChannels, std::size_t hapticChannels)
{
    fs.store(sampleRate, std::memory_order_relaxed);
    for (Voice& voice : voices)
        if (voice.translator)
            voice.translator->prepare({sampleRate, pieceFrames});
    latency = engineLatency(sampleRate, voices[0].translator->latencyFrames());
    for (Voice& voice : voices)
        if (voice.translator)
            prepareVoice(voice);
    mix.prepare(sampleRate);
    row.prepare(sampleRate, std::max(hapticChannels, mainChannels));
    routing.prepare(sampleRate, std::min(mainChannels, maxMainChannels), pieceFrames);
    preview.prepare(sampleRate);
    watch.prepare(sampleRate);
    delay.prepare(std::min(mainChannels, maxMainChannels), latencyFrames());
    const auto ringFrames = static_cast<std::size_t>(captureSeconds * std::min(sampleRate, 96000.0));
    if (ring.capacityFrames() == ringFrames)
        ring.reset();
    else
        ring.prepare(ringFrames);
    reset();
}

/// Its translator is prepared.
void LiveEngine::prepareVoice(Voice& voice) const
{
    voice.late.prepare(1, latency - std::min(latency, voice.translator->latencyFrames()));
}

void LiveEngine::reset() noexcept
{
    for (Voice& voice : voices)
        voice.plays = false;
    for (std::size_t c = 0; c < playing.size(); ++c)
    {
        playing[c] = sources[c].load(std::memory_order_acquire);
        Voice& voice = voices[playing[c]];
        if (!std::exchange(voice.plays, true))
        {
            voice.translator->reset();
            voice.late.reset();
        }
    }
    settling = {};
    begun = false;
    watch.reset();
    mix.reset();
    row.reset();
    routing.reset();
    delay.reset();
}

TranslatorMeterReading LiveEngine::readMeters(std::size_t channel) const noexcept
{
    return voices[sources[channel].load(std::memory_order_acquire)].translator->meters().read();
}

void LiveEngine::setSetup(std::size_t channel, const TranslatorSetup& setup)
{
    Voice& voice = voices[channel];
    voice.restSeconds.store(restSeconds(setup), std::memory_order_relaxed);
    if (voice.translator)
        voice.translator->setSetup(setup);
    else
    {
        auto made = std::make_unique<Translator>();
        made->setSetup(setup);
        made->prepare({sampleRate(), pieceFrames});
        voice.translator = std::move(made);
        prepareVoice(voice);
    }
    // The audio thread sees the translator no earlier than this.
    sources[channel].store(channel, std::memory_order_release);
    disturbed.store(true, std::memory_order_release);
}

void LiveEngine::process(const EngineBlock& block, const ParameterValues& values, bool bypassed) noexcept
{
    const std::array shape{block.main.size(), block.sidechain.size(), block.haptic.size()};
    const bool same = values == seen && bypassed == seenBypass && shape == seenChannels;
    if (!same || disturbed.load(std::memory_order_relaxed))
    {
        wake(); // with what was in force until now
        disturbed.store(false, std::memory_order_relaxed);
        seen = values;
        seenBypass = bypassed;
        seenChannels = shape;
    }
    if (!watch.resting())
        aim(block, values, bypassed);
    std::array<std::span<float>, maxMainChannels> main;
    std::array<std::span<const float>, maxSidechainChannels> sidechain;
    std::array<std::span<float>, maxHapticChannels> haptic;
    const std::size_t mains = std::min(block.main.size(), main.size());
    const std::size_t sides = std::min(block.sidechain.size(), sidechain.size());
    const std::size_t haptics = std::min(block.haptic.size(), channels);
    for (std::size_t done = 0; done < block.frames; done += pieceFrames)
    {
        const std::size_t n = std::min(pieceFrames, block.frames - done);
        for (std::size_t c = 0; c < mains; ++c)
            main[c] = {block.main[c] + done, n};
        for (std::size_t c = 0; c < sides; ++c)
            sidechain[c] = {block.sidechain[c] + done, n};
        for (std::size_t c = 0; c < haptics; ++c)
            haptic[c] = {block.haptic[c] + done, n};
        piece(std::span(main).first(mains), std::span(sidechain).first(sides), std::span(haptic).first(haptics), n,
              block.controller);
    }
}

/// Where everything is to be from this block on. At rest it is there.
void LiveEngine::aim(const EngineBlock& block, const ParameterValues& values, bool bypassed) noexcept
{
    params = values.translator();
    const auto choice = static_cast<SourceChoice>(values.index(ParameterId::source));
    mix.aim(choice, values[ParameterId::sourceMix]);
    hearsSidechain = choice == SourceChoice::sidechain;
    const auto mode = static_cast<OutputMode>(values.index(ParameterId::outputMode));
    const std::size_t added = mode == OutputMode::addToChannel ? values.index(ParameterId::outputCount) : 1;
    routing.aim(mode, values.index(ParameterId::outputChannel) - 1, added,
                bypassed || values.isOn(ParameterId::bypass));
    // Where the drives take the place of the sound, each of its channels has one.
    const std::size_t wanted = std::max(block.haptic.size(), routing.drivesInMain(block.main.size()));
    channels = std::clamp<std::size_t>(wanted, 1, row.channels());
    inUse.store(channels, std::memory_order_relaxed);
    row.aim(values, channels);
}

void LiveEngine::piece(std::span<const std::span<float>> main, std::span<const std::span<const float>> sidechain,
                       std::span<const std::span<float>> haptic, std::size_t frames,
                       live::LiveDrive* controller) noexcept
{
    const auto in = std::span(source).first(frames);
    const bool previews = clips != nullptr && preview.take(*clips, frames);
    const bool silent = !previews && isSilent(main) && isSilent(sidechain);
    if (!silent)
        wake();
    if (watch.resting())
    {
        std::fill(in.begin(), in.end(), 0.0f);
        ring.push(in);
        for (const auto& channel : haptic)
            std::fill(channel.begin(), channel.end(), 0.0f);
        watch.rested(frames);
        return;
    }
    mix.process(main, sidechain, in);
    const float peak = largestMagnitude(in);
    if (peak > inputPeak.load(std::memory_order_relaxed))
        inputPeak.store(peak, std::memory_order_relaxed);
    ring.push(in);
    followSources(frames);
    translate(in);
    begun = true;
    delay.process(main);

    std::array<std::span<float>, maxHapticChannels> others;
    std::size_t otherCount = 0;
    for (std::size_t v = 1; v < voices.size(); ++v)
        if (voices[v].plays)
            others[otherCount++] = std::span(voices[v].drive).first(frames);
    if (previews)
        preview.process(std::span(voices[0].drive).first(frames), std::span(others).first(otherCount), main);

    std::array<std::span<const float>, maxHapticChannels> from;
    std::array<std::span<float>, maxHapticChannels> to;
    for (std::size_t c = 0; c < channels; ++c)
    {
        from[c] = std::span(voices[playing[c]].drive).first(frames);
        to[c] = std::span(drives[c]).first(frames);
    }
    std::span<const float> left, right;
    if (hearsSidechain && sidechain.size() >= 2)
        left = sidechain[0], right = sidechain[1];
    else if (main.size() >= 2)
        left = main[0], right = main[1];
    row.process(std::span(from).first(channels), left, right, std::span(to).first(channels));
    routing.process(main, haptic, std::span(to).first(channels), controller != nullptr ? 1 : 0);
    if (controller != nullptr)
        controller->push(to[0]); // nothing at rest: who waits for more than some packets falls silent
    meterPeaks(main.size(), frames, controller != nullptr);
    watch.worked(frames, mayRest && silent && isStill(main, frames), framesToRest());
}

/// Of what is played, and what went out in the last piece.
bool LiveEngine::isStill(std::span<const std::span<float>> main, std::size_t frames) const noexcept
{
    const auto still = [](std::span<const float> signal)
    {
        return largestMagnitude(signal) <= SilenceWatch::stillness;
    };
    for (const Voice& voice : voices)
        if (voice.plays && !still(std::span(voice.drive).first(frames)))
            return false;
    for (std::size_t c = 0; c < channels; ++c)
        if (!still(std::span(drives[c]).first(frames)))
            return false;
    return std::all_of(main.begin(), main.end(), still);
}

std::size_t LiveEngine::framesToRest() const noexcept
{
    double seconds = 0.0;
    for (const Voice& voice : voices)
        if (voice.plays)
            seconds = std::max(seconds, voice.restSeconds.load(std::memory_order_relaxed));
    return static_cast<std::size_t>(seconds * fs.load(std::memory_order_relaxed));
}

/// Works at the silence that is owed, a part of a turn of all grids: then they stand as if there had been no rest. A
/// new actuator, which waits for the translator to go on, fades in by that much earlier.
void LiveEngine::wake() noexcept
{
    if (!watch.resting())
        return watch.reset();
    const SilenceWatch::Debt debt = watch.wake();
    for (Voice& voice : voices)
        if (voice.translator && voice.plays)
            voice.translator->pass(debt.passed);
    for (std::size_t due = debt.owed; due > 0;)
    {
        const std::size_t n = std::min(due, pieceFrames);
        const auto in = std::span(source).first(n);
        std::fill(in.begin(), in.end(), 0.0f);
        translate(in);
        std::array<std::span<const float>, maxHapticChannels> from;
        std::array<std::span<float>, maxHapticChannels> to;
        for (std::size_t c = 0; c < channels; ++c)
        {
            from[c] = std::span(voices[playing[c]].drive).first(n);
            to[c] = std::span(drives[c]).first(n);
        }
        row.process(std::span(from).first(channels), in, in, std::span(to).first(channels));
        due -= n;
    }
}

/// A channel that is to play another voice fades out before it does, and in when that has settled.
void LiveEngine::followSources(std::size_t frames) noexcept
{
    for (std::size_t c = 0; c < channels; ++c)
    {
        const std::size_t wanted = sources[c].load(std::memory_order_acquire);
        if (wanted != playing[c] && (!begun || row.silent(c)))
        {
            playing[c] = wanted;
            if (begun) // its delay holds the other voice still
                settling[c] =
                    row.delayFrames(c) + (voices[wanted].plays ? 0 : voices[wanted].translator->settlingFrames());
        }
        row.setMuted(c, wanted != playing[c] || settling[c] > 0);
        settling[c] -= std::min(settling[c], frames);
    }
}

/// Every voice that a channel plays; others cost nothing. The first one is always there: the window shows its bands.
void LiveEngine::translate(std::span<const float> in) noexcept
{
    for (std::size_t v = 0; v < voices.size(); ++v)
    {
        Voice& voice = voices[v];
        const auto used = std::span(playing).first(channels);
        const bool plays = v == 0 || std::find(used.begin(), used.end(), v) != used.end();
        if (plays)
        {
            voice.translator->setParams(params);
            if (!voice.plays)
            {
                voice.translator->reset();
                voice.late.reset();
            }
            const auto drive = std::span(voice.drive).first(in.size());
            voice.translator->process(in, drive);
            voice.late.process(std::span(&drive, 1));
        }
        voice.plays = plays;
    }
}

/// What goes out.
void LiveEngine::meterPeaks(std::size_t mainChannels, std::size_t frames, bool onController) noexcept
{
    const unsigned haptics = connected.load(std::memory_order_relaxed);
    for (std::size_t c = 0; c < channels; ++c)
    {
        if ((haptics >> c & 1u) == 0 && !routing.isInMain(c, mainChannels) && !(onController && c == 0))
            continue;
        const float peak = largestMagnitude(std::span(drives[c]).first(frames));
        if (peak > peaks[c].load(std::memory_order_relaxed))
            peaks[c].store(peak, std::memory_order_relaxed);
    }
}

Capture LiveEngine::capture(double seconds) const
{
    Capture capture = ring.newest(static_cast<std::size_t>(std::max(seconds, 0.0) * sampleRate()));
    for (float& x : capture.samples)
        if (!std::isfinite(x))
            x = 0.0f;
    return capture;
}

} // namespace pacini::plugin
