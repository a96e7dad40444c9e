// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/commands/KeyText.h"

#include "editor/Text.h"
#include "editor/Translation.h"

#include <algorithm>
#include <array>
#include <utility>

namespace pacini::editor
{

namespace
{
/// Of a key alone.
juce::String nameOfKey(int code)
{
    using Key = juce::KeyPress;
    const std::array<std::pair<int, const char*>, 4> arrows{
        {{Key::leftKey, "←"}, {Key::rightKey, "→"}, {Key::upKey, "↑"}, {Key::downKey, "↓"}}};
    for (const auto& [arrow, symbol] : arrows)
        if (code == arrow)
            return toText(symbol);
    const std::array<std::pair<int, const char*>, 10> named{{{Key::spaceKey, "Space"},
                                                             {Key::returnKey, "Return"},
                                                             {Key::escapeKey, "Esc"},
                                                             {Key::tabKey, "Tab"},
                                                             {Key::deleteKey, "Delete"},
                                                             {Key::backspaceKey, "Backspace"},
                                                             {Key::homeKey, "Home"},
                                                             {Key::endKey, "End"},
                                                             {Key::pageUpKey, "Page up"},
                                                             {Key::pageDownKey, "Page down"}}};
    for (const auto& [one, name] : named)
        if (code == one)
            return tr(name);
    if (code >= Key::F1Key && code <= Key::F16Key)
        return "F" + juce::String(code - Key::F1Key + 1);
    if (code == '-')
        return toText("−");
    return juce::String::charToString(juce::CharacterFunctions::toUpperCase(static_cast<juce::juce_wchar>(code)));
}
} // namespace

juce::String keyText(const juce::KeyPress& key)
{
    if (!key.isValid())
        return {};
    const auto mods = key.getModifiers();
    juce::String text;
#if JUCE_MAC
    text << (mods.isCtrlDown() ? toText("⌃") : "") << (mods.isAltDown() ? toText("⌥") : "")
         << (mods.isShiftDown() ? toText("⇧") : "") << (mods.isCommandDown() ? toText("⌘") : "");
#else
    if (mods.isCommandDown())
        text << tr("Ctrl+");
    if (mods.isAltDown())
        text << tr("Alt+");
    if (mods.isShiftDown())
        text << tr("Shift+");
#endif
    return text + nameOfKey(key.getKeyCode());
}

} // namespace pacini::editor
