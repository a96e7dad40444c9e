// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Questions for files, which give the keyboard back.

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>
#include <utility>

namespace pacini::editor
{

/// Asks with `chooser`. The keyboard is where it was before `chosen` is called: closing the question leaves it with
/// nobody. [message]
inline void askForFiles(juce::FileChooser& chooser, int flags, std::function<void(const juce::FileChooser&)> chosen)
{
    using Holder = juce::Component::SafePointer<juce::Component>;
    chooser.launchAsync(flags,
                        [before = Holder(juce::Component::getCurrentlyFocusedComponent()),
                         chosen = std::move(chosen)](const juce::FileChooser& done)
                        {
                            if (before != nullptr && before->isShowing())
                                before->grabKeyboardFocus();
                            chosen(done);
                        });
}

} // namespace pacini::editor
