// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The rows of the clip view that show time and sound: ruler, waveform, and the whole clip at a glance.

#include "editor/clip/Session.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <vector>

namespace pacini::editor
{

/// Times. A click puts the playhead there, a drag selects a range.
class TimeRuler final : public juce::Component, public juce::SettableTooltipClient, private Session::Listener
{
public:
    explicit TimeRuler(Session& shared);
    ~TimeRuler() override;

    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& event) override;
    void mouseDrag(const juce::MouseEvent& event) override;
    void mouseDoubleClick(const juce::MouseEvent& event) override;

private:
    void sessionChanged(unsigned changes) override;
    [[nodiscard]] double timeAt(float x) const;

    Session& session;
    double anchor = 0.0; // s, where a drag began
};

/// The sound that the clip was made from. Clicks and drags as in the ruler.
class WaveformRow final : public juce::Component, public juce::SettableTooltipClient, private Session::Listener
{
public:
    explicit WaveformRow(Session& shared);
    ~WaveformRow() override;

    void paint(juce::Graphics& g) override;

private:
    void sessionChanged(unsigned changes) override;

    Session& session;
};

/// The envelope of the whole clip with a frame around what is visible, which can be dragged and resized.
class Overview final : public juce::Component, public juce::SettableTooltipClient, private Session::Listener
{
public:
    explicit Overview(Session& shared);
    ~Overview() override;

    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& event) override;
    void mouseDrag(const juce::MouseEvent& event) override;
    void mouseDoubleClick(const juce::MouseEvent& event) override;

private:
    void sessionChanged(unsigned changes) override;
    [[nodiscard]] TimeAxis whole() const;
    [[nodiscard]] juce::Rectangle<float> frame() const;

    Session& session;
    enum class Drag
    {
        frame,
        left,
        right
    };
    Drag drag = Drag::frame;
    TimeRange before; // the visible range when a drag began
};

} // namespace pacini::editor
