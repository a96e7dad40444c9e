// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Line at the foot of the window that says what was done, for some seconds.

#include <juce_gui_basics/juce_gui_basics.h>

#include <filesystem>
#include <vector>

namespace pacini::editor
{

class NoticeBar final : public juce::Component, private juce::Timer
{
public:
    NoticeBar();

    void show(const juce::String& text);
    /// The same for longer: there is something to do.
    void showAdvice(const juce::String& text);
    /// What was written, with a button that shows where.
    void showWritten(const std::vector<std::filesystem::path>& files);
    [[nodiscard]] const juce::String& text() const noexcept { return words; }

    void paint(juce::Graphics& g) override;
    void resized() override;

private:
    void timerCallback() override;
    void tell(const juce::String& text, int milliseconds);
    [[nodiscard]] juce::Rectangle<int> box() const;

    juce::String words;
    juce::File written;
    juce::TextButton folderButton;
};

} // namespace pacini::editor
