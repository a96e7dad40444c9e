// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/clap/ClapAudio.h"

#include "plugin/clap/ClapParameters.h"

#include <algorithm>
#include <span>

namespace pacini::plugin
{

namespace
{
/// A channel of a port from a frame on; null where the host has none.
template <typename Port>
float* channelFrom(const std::span<Port>& ports, int port, int channel, std::uint32_t begin) noexcept
{
    const auto at = static_cast<std::size_t>(port);
    const auto wanted = static_cast<std::uint32_t>(channel);
    if (at >= ports.size() || ports[at].data32 == nullptr || wanted >= ports[at].channel_count ||
        ports[at].data32[wanted] == nullptr)
        return nullptr;
    return ports[at].data32[wanted] + begin;
}

std::span<const clap_audio_buffer_t> inputsOf(const clap_process_t& block) noexcept
{
    return {block.audio_inputs, block.audio_inputs == nullptr ? 0 : block.audio_inputs_count};
}

std::span<clap_audio_buffer_t> outputsOf(const clap_process_t& block) noexcept
{
    return {block.audio_outputs, block.audio_outputs == nullptr ? 0 : block.audio_outputs_count};
}

template <typename Ports>
bool hasOnlyDoubles(const Ports& ports) noexcept
{
    return std::any_of(ports.begin(), ports.end(),
                       [](const clap_audio_buffer_t& port)
                       { return port.channel_count > 0 && port.data32 == nullptr && port.data64 != nullptr; });
}
} // namespace

void ClapAudio::prepare()
{
    buffer.setSize(std::max(processor.getTotalNumInputChannels(), processor.getTotalNumOutputChannels()),
                   static_cast<int>(pieceFrames));
}

bool ClapAudio::process(const clap_process_t& block) noexcept
{
    if (buffer.getNumChannels() == 0 || hasOnlyDoubles(inputsOf(block)) || hasOnlyDoubles(outputsOf(block)))
        return false;
    const clap_input_events_t* events = block.in_events;
    const std::uint32_t count = events != nullptr && events->size != nullptr ? events->size(events) : 0;
    std::uint32_t done = 0;
    for (std::uint32_t i = 0; i < count; ++i)
    {
        const clap_event_header_t* event = events->get(events, i);
        if (event == nullptr)
            continue;
        // One that comes too late counts from here on, one behind the block at its end.
        const std::uint32_t time = std::clamp(event->time, done, block.frames_count);
        play(block, done, time);
        done = time;
        applyEvent(processor, *event);
    }
    play(block, done, block.frames_count);
    for (clap_audio_buffer_t& port : outputsOf(block))
        port.constant_mask = 0;
    return true;
}

void ClapAudio::play(const clap_process_t& block, std::uint32_t begin, std::uint32_t end) noexcept
{
    for (; begin < end; begin += std::min(pieceFrames, end - begin))
        piece(block, begin, std::min(pieceFrames, end - begin));
}

void ClapAudio::piece(const clap_process_t& block, std::uint32_t begin, std::uint32_t frames) noexcept
{
    const int length = static_cast<int>(frames);
    buffer.clear(0, length);
    const auto inputs = inputsOf(block);
    for (int bus = 0; bus < processor.getBusCount(true); ++bus)
        for (int c = 0; c < processor.getChannelCountOfBus(true, bus); ++c)
            if (const float* from = channelFrom(inputs, bus, c, begin))
                buffer.copyFrom(processor.getChannelIndexInProcessBlockBuffer(true, bus, c), 0, from, length);

    juce::AudioBuffer<float> part(buffer.getArrayOfWritePointers(), buffer.getNumChannels(), length);
    processor.processBlock(part, noMidi);

    const auto outputs = outputsOf(block);
    for (int bus = 0; bus < static_cast<int>(outputs.size()); ++bus)
    {
        const int made = bus < processor.getBusCount(false) ? processor.getChannelCountOfBus(false, bus) : 0;
        for (int c = 0; c < static_cast<int>(outputs[static_cast<std::size_t>(bus)].channel_count); ++c)
            if (float* to = channelFrom(outputs, bus, c, begin))
            {
                if (c < made)
                    std::copy_n(part.getReadPointer(processor.getChannelIndexInProcessBlockBuffer(false, bus, c)),
                                frames, to);
                else
                    std::fill_n(to, frames, 0.0f);
            }
    }
}

} // namespace pacini::plugin
