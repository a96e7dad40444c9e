// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// What an editor without a clip shows.

#include "editor/clip/session/Session.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace pacini::editor
{

class EmptyState final : public juce::Component, private Session::Listener
{
public:
    EmptyState(Session& shared, std::vector<std::filesystem::path> demoSounds);
    ~EmptyState() override;

    std::function<void()> onOpen;
    std::function<void(const std::filesystem::path&)> onFile;

    void setDropping(bool dropping);
    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void sessionChanged(unsigned changes) override;
    void fill();
    [[nodiscard]] juce::Rectangle<int> field() const;

    Session& session;
    std::vector<std::filesystem::path> demos;
    juce::TextButton openButton;
    std::vector<std::unique_ptr<juce::TextButton>> demoButtons, recentButtons;
    bool dropNow = false;
};

} // namespace pacini::editor
