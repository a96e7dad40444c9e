// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "editor/clip/session/Session.h"

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

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

} // namespace pacini::editor
