// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Start page of an editor without a clip: what will feel it, a library to begin with, opening and recent projects.

#include "editor/Controls.h"
#include "editor/clip/session/FilePreview.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace pacini::editor
{

/// A haptic device that is connected.
struct FoundDevice
{
    juce::String name;
    std::string profile; ///< that fits it; empty: none is known
    bool chosen = false; ///< it plays along
    std::function<Result<void>()> choose;
};

class StartPage final : public juce::Component, private juce::Timer
{
public:
    /// `sounds` are those that come with the program, the library's and recordings.
    StartPage(EditorModel& project, Actuators& profiles, FilePreview& preview,
              const std::vector<std::filesystem::path>& sounds);
    ~StartPage() override;

    std::function<void()> onOpen;
    std::function<void(const std::filesystem::path&)> onFile;
    std::function<void()> onOutputs;                        ///< to choose where it is felt
    std::function<std::vector<FoundDevice>()> foundDevices; ///< null: nobody looks
    /// Looks for them now; else every second while the page is shown.
    void findDevices();

    void setDropping(bool dropping);
    void paint(juce::Graphics& g) override;
    void resized() override;

    /// The names of the sounds that are shown, as far as the search has left them.
    [[nodiscard]] juce::StringArray shownSounds() const;

private:
    class Tile;

    void timerCallback() override;
    void visibilityChanged() override;
    void fillRecent();
    void search();
    void followActuator();
    void chooseDevice(std::size_t index);
    [[nodiscard]] juce::Rectangle<int> left() const;
    [[nodiscard]] juce::Rectangle<int> dropArea() const; ///< with the button that opens
    [[nodiscard]] juce::Rectangle<int> right() const;
    void layOutTiles();

    EditorModel& model;
    Actuators& actuators;
    FilePreview& preview;
    std::vector<std::unique_ptr<juce::TextButton>> feltBy, found, recentButtons;
    std::vector<FoundDevice> devices;
    juce::TextButton openButton, outputsButton;
    PromptField words;
    juce::TextButton hoverButton;
    juce::Viewport viewport;
    juce::Component tileArea;
    std::vector<std::unique_ptr<Tile>> tiles;
    juce::String nothingFound;
    bool dropNow = false;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
