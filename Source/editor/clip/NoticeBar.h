// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Line at the foot of the window that says what was done, for some seconds.

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

class NoticeBar final : public juce::Component, private juce::Timer
{
public:
    NoticeBar();

    void show(const juce::String& text);
    [[nodiscard]] const juce::String& text() const noexcept { return words; }

    void paint(juce::Graphics& g) override;

private:
    void timerCallback() override;

    juce::String words;
};

} // namespace pacini::editor
