// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The plugin's window within one of a CLAP host.

#include "plugin/clap/Clap.h"

#include <juce_audio_processors/juce_audio_processors.h>

#include <cstdint>
#include <memory>

namespace pacini::plugin
{

/// Holds the editor between create and destroy. All functions: [main], with the lock of JUCE's messages.
class ClapWindow final : private juce::Component, private juce::ComponentListener
{
public:
    ClapWindow(juce::AudioProcessor& wanted, const clap_host_t& itsHost) : processor(wanted), host(itsHost) {}
    ~ClapWindow() override;

    /// The windows of this system: embedded, or none.
    [[nodiscard]] static const char* windowApi() noexcept;
    [[nodiscard]] static bool supports(const char* api, bool floating) noexcept;

    bool create();
    void close();
    [[nodiscard]] bool exists() const noexcept { return editor != nullptr; }
    bool setScale(double scale);
    /// In pixels of the host's window.
    [[nodiscard]] juce::Point<int> size() const { return {getWidth(), getHeight()}; }
    /// The size next to this one that the window can have.
    [[nodiscard]] juce::Point<int> nearestSize(std::uint32_t width, std::uint32_t height) const;
    bool setWindowSize(std::uint32_t width, std::uint32_t height);
    bool setParent(const clap_window_t& parent);
    bool show(bool wanted);

private:
    void resized() override;
    void paint(juce::Graphics& g) override { g.fillAll(juce::Colours::black); }
    void componentMovedOrResized(juce::Component& moved, bool wasMoved, bool wasResized) override;
    void fitEditor();

    juce::AudioProcessor& processor;
    const clap_host_t& host;
    std::unique_ptr<juce::AudioProcessorEditor> editor;
    bool byHost = false; ///< the host resizes the window
};

/// The extension `clap.gui`.
[[nodiscard]] const clap_plugin_gui_t& guiExtension() noexcept;

} // namespace pacini::plugin
