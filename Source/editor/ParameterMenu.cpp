// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/ParameterMenu.h"

#include "editor/ParameterControls.h"
#include "editor/Text.h"
#include "editor/Translation.h"

#include <memory>
#include <utility>

namespace pacini::editor
{

bool isContextMenuKey(const juce::KeyPress& key)
{
    return key == juce::KeyPress(juce::KeyPress::F10Key, juce::ModifierKeys::shiftModifier, 0);
}

juce::PopupMenu parameterMenu(juce::AudioProcessorParameter& parameter, std::function<void()> type,
                              const juce::AudioProcessorEditorHostContext* host)
{
    juce::PopupMenu menu;
    menu.addItem(tr("Reset to {0}", {withDecimalMark(parameter.getText(parameter.getDefaultValue(), 0))}),
                 parameter.getValue() != parameter.getDefaultValue(), false,
                 [&parameter] { setAsGesture(parameter, parameter.getDefaultValue()); });
    if (type)
        menu.addItem(tr(toText("Type a value…")), std::move(type));
    if (host == nullptr)
        return menu;
    // Its items call back into it.
    const std::shared_ptr<juce::HostProvidedContextMenu> offered = host->getContextMenuForParameter(&parameter);
    if (!offered)
        return menu;
    const juce::PopupMenu items = offered->getEquivalentPopupMenu();
    if (!items.containsAnyActiveItems())
        return menu;
    menu.addSeparator();
    for (juce::PopupMenu::MenuItemIterator each(items, false); each.next();)
    {
        juce::PopupMenu::Item item = each.getItem();
        if (item.action)
            item.action = [offered, action = std::move(item.action)]
            {
                action();
            };
        menu.addItem(std::move(item));
    }
    return menu;
}

void showParameterMenu(juce::Component& control, juce::AudioProcessorParameter& parameter, std::function<void()> type,
                       bool atPointer)
{
    const auto* window = control.findParentComponentOfClass<juce::AudioProcessorEditor>();
    auto menu = parameterMenu(parameter, std::move(type), window != nullptr ? window->getHostContext() : nullptr);
    menu.setLookAndFeel(&control.getLookAndFeel());
    auto options = juce::PopupMenu::Options().withTargetComponent(control);
    if (atPointer)
        options = options.withMousePosition();
    menu.showMenuAsync(options);
}

} // namespace pacini::editor
