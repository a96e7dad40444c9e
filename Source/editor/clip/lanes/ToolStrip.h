// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "editor/clip/session/Session.h"

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::editor
{

/// What the mouse does in lanes, beside the ruler: drawing, snapping, and which version is seen and heard.
class ToolStrip final : public juce::Component, private Session::Listener
{
public:
    explicit ToolStrip(Session& shared);
    ~ToolStrip() override;

    void resized() override;

private:
    void sessionChanged(unsigned changes) override;
    void showState();

    Session& session;
    juce::ToggleButton drawButton, snapButton, versionButton;
};

} // namespace pacini::editor
