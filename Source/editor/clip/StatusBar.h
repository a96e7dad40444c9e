// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Status bar: the first steps until each was done once, and what plays where.

#include "editor/clip/session/Session.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>

namespace pacini::editor
{

/// Steps that the user has done at least once; stored by the program.
struct FirstSteps
{
    bool chosen = false, shaped = false, exported = false;
    bool operator==(const FirstSteps&) const = default;

    [[nodiscard]] bool all() const noexcept { return chosen && shaped && exported; }
};

class StatusBar final : public juce::Component
{
public:
    StatusBar(Session& shared, std::function<juce::StringArray()> outputNames);

    [[nodiscard]] const FirstSteps& steps() const noexcept { return done; }
    void setSteps(const FirstSteps& wanted);
    void setExported();
    /// "Plays on: 10 mm coin LRA, output 3".
    [[nodiscard]] juce::String playsOn() const;

    std::function<void()> onReconnect; ///< looks for a audio device; null: the host has them

    void paint(juce::Graphics& g) override;
    void resized() override;

    static constexpr int height = 26;

private:
    void follow();

    Session& session;
    const std::function<juce::StringArray()> names;
    FirstSteps done;
    juce::TextButton reconnectButton;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
