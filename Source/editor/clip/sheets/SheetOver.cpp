// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/SheetOver.h"

#include "editor/Translation.h"

#include <utility>

namespace pacini::editor
{

SheetOver::SheetOver(juce::Component& covered) : behind(covered)
{
    behind.addComponentListener(this);
}

SheetOver::~SheetOver()
{
    behind.removeComponentListener(this);
}

void SheetOver::show(std::unique_ptr<Sheet> wanted)
{
    now = std::move(wanted);
    if (!now)
        return;
    now->onClose = [this]
    {
        // Not from within one of its own functions.
        juce::MessageManager::callAsync(
            [this, watch = std::weak_ptr<int>(alive), closed = now.get()]
            {
                if (watch.expired() || now.get() != closed)
                    return;
                now.reset();
                if (onClosed)
                    onClosed();
            });
    };
    translateTexts(*now);
    behind.addAndMakeVisible(*now);
    now->sendLookAndFeelChange();
    componentMovedOrResized(behind, false, true);
    now->takeFocus();
}

void SheetOver::componentMovedOrResized(juce::Component&, bool, bool)
{
    if (now)
        now->setBounds(behind.getLocalBounds());
}

} // namespace pacini::editor
