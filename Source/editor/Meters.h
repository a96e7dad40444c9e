// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Level meter, and a lamp that lights up with events.

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

/// A horizontal bar over a range of decibels with its name and its value. It falls back slowly and repaints only when a
/// pixel or a digit changes.
class LevelMeter final : public juce::Component, public juce::SettableTooltipClient
{
public:
    struct Scale
    {
        float low = -60.0f, high = 0.0f; ///< dB
        float from = -60.0f;             ///< where the bar begins
        float warnAbove = 1000.0f;
        float fall = 1.2f; ///< dB for each call of show()
        bool sign = false; ///< plus signs
    };

    LevelMeter(const juce::String& name, const juce::String& help, Scale wanted);

    /// -infinity is allowed.
    void show(double decibels);
    void paint(juce::Graphics& g) override;

private:
    [[nodiscard]] int pixelOf(float decibels) const noexcept;
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override;

    juce::String title;
    Scale scale;
    float level;
    juce::String text;
    int pixel = -1;
};

/// Lights up with every event and fades.
class EventLamp final : public juce::Component
{
public:
    EventLamp();
    /// `events` counts them; `level` is that of the newest, linear.
    void show(unsigned events, double level);
    void paint(juce::Graphics& g) override;

private:
    unsigned counted = 0;
    bool begun = false;
    int glow = 0; // of 10
};

} // namespace pacini::editor
