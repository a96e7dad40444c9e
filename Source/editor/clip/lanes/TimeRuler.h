// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "editor/clip/session/Session.h"

#include <juce_gui_basics/juce_gui_basics.h>

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

} // namespace pacini::editor
