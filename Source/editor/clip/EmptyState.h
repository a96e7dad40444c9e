// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Start page of an editor without a clip: opening, demo sounds and recent projects.

#include "editor/clip/session/EditorModel.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace pacini::editor
{

class EmptyState final : public juce::Component
{
public:
    EmptyState(EditorModel& project, std::vector<std::filesystem::path> demoSounds);

    std::function<void()> onOpen;
    std::function<void(const std::filesystem::path&)> onFile;

    void setDropping(bool dropping);
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void fill();
    [[nodiscard]] juce::Rectangle<int> field() const;

    EditorModel& model;
    std::vector<std::filesystem::path> demos;
    juce::TextButton openButton;
    std::vector<std::unique_ptr<juce::TextButton>> demoButtons, recentButtons;
    bool dropNow = false;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
