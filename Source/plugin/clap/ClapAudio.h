// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Audio of a CLAP host: its ports, and the way of its samples through the processor.

#include "plugin/clap/Clap.h"
#include "plugin/engine/PluginProcessor.h"

#include <cstdint>

namespace pacini::plugin
{

/// Hands the samples of a block to the processor, in pieces between events. The processor works on memory of its own:
/// hosts may lay inputs and outputs over each other as they like, and leave out ports and channels.
class ClapAudio
{
public:
    explicit ClapAudio(PluginProcessor& wanted) noexcept : processor(wanted) {}

    /// For the channels that the processor has now. Allocates. [message]
    void prepare();

    /// Processes a block of any number of frames, with each event at its frame. False if there is nothing to process
    /// with: before prepare(), or where the host has samples of 64 bits only, which the ports do not offer. [audio]
    bool process(const clap_process_t& block) noexcept;

private:
    static constexpr std::uint32_t pieceFrames = 1024;

    void play(const clap_process_t& block, std::uint32_t begin, std::uint32_t end) noexcept;
    void piece(const clap_process_t& block, std::uint32_t begin, std::uint32_t frames) noexcept;

    PluginProcessor& processor;
    juce::AudioBuffer<float> buffer;
    juce::MidiBuffer noMidi;
};

/// The ports of a processor. False if there is none at this index.
bool describePort(const juce::AudioProcessor& processor, bool isInput, std::uint32_t index,
                  clap_audio_port_info_t& info) noexcept;

/// The extensions `clap.audio-ports`, and `clap.configurable-audio-ports/1` and `clap.audio-ports-config`, by which
/// hosts change the number of channels.
[[nodiscard]] const clap_plugin_audio_ports_t& audioPortsExtension() noexcept;
[[nodiscard]] const clap_plugin_configurable_audio_ports_t& configurablePortsExtension() noexcept;
[[nodiscard]] const clap_plugin_audio_ports_config_t& portsConfigExtension() noexcept;

} // namespace pacini::plugin
