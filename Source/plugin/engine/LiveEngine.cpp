// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/engine/LiveEngine.h"

#include <algorithm>
#include <cmath>

namespace pacini::plugin
{

void LiveEngine::prepare(double sampleRate, std::size_t mainChannels)
{
    fs.store(sampleRate, std::memory_order_relaxed);
    translator.prepare({sampleRate, pieceFrames});
    mix.prepare(sampleRate);
    routing.prepare(sampleRate);
    preview.prepare(sampleRate);
    delay.prepare(std::min(mainChannels, maxMainChannels), translator.latencyFrames());
    const auto ringFrames = static_cast<std::size_t>(captureSeconds * std::min(sampleRate, 96000.0));
    if (ring.capacityFrames() == ringFrames)
        ring.reset();
    else
        ring.prepare(ringFrames);
    reset();
}

void LiveEngine::reset() noexcept
{
    translator.reset();
    mix.reset();
    routing.reset();
    delay.reset();
}

void LiveEngine::process(const EngineBlock& block, const ParameterValues& values, bool bypassed) noexcept
{
    translator.setParams(values.translator());
    mix.aim(static_cast<SourceChoice>(values.index(ParameterId::source)), values[ParameterId::sourceMix]);
    routing.aim(static_cast<OutputMode>(values.index(ParameterId::outputMode)),
                values.index(ParameterId::outputChannel) - 1, bypassed || values.isOn(ParameterId::bypass));

    std::array<std::span<float>, maxMainChannels> main;
    std::array<std::span<const float>, maxSidechainChannels> sidechain;
    std::array<std::span<float>, maxHapticChannels> haptic;
    const std::size_t mains = std::min(block.main.size(), main.size());
    const std::size_t sides = std::min(block.sidechain.size(), sidechain.size());
    const std::size_t haptics = std::min(block.haptic.size(), haptic.size());
    for (std::size_t done = 0; done < block.frames; done += pieceFrames)
    {
        const std::size_t n = std::min(pieceFrames, block.frames - done);
        for (std::size_t c = 0; c < mains; ++c)
            main[c] = {block.main[c] + done, n};
        for (std::size_t c = 0; c < sides; ++c)
            sidechain[c] = {block.sidechain[c] + done, n};
        for (std::size_t c = 0; c < haptics; ++c)
            haptic[c] = {block.haptic[c] + done, n};
        piece(std::span(main).first(mains), std::span(sidechain).first(sides), std::span(haptic).first(haptics), n);
    }
}

void LiveEngine::piece(std::span<const std::span<float>> main, std::span<const std::span<const float>> sidechain,
                       std::span<const std::span<float>> haptic, std::size_t frames) noexcept
{
    const auto in = std::span(source).first(frames);
    const auto out = std::span(drive).first(frames);
    mix.process(main, sidechain, in);
    float peak = 0.0f;
    for (const float x : in)
        peak = std::abs(x) > peak ? std::abs(x) : peak;
    if (peak > inputPeak.load(std::memory_order_relaxed))
        inputPeak.store(peak, std::memory_order_relaxed);
    ring.push(in);
    translator.process(in, out);
    delay.process(main);
    if (clips != nullptr)
        preview.process(*clips, out, main);
    routing.process(main, haptic, out);
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
