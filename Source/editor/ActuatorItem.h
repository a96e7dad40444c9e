// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Actuators in menus: a short name in the box, the whole name beside it in the list.

#include "editor/Text.h"
#include "editor/Translation.h"

#include <pacini/actuator/Profile.h>

#include <juce_gui_basics/juce_gui_basics.h>

#include <utility>

namespace pacini::editor
{

/// The short name of an actuator in the user's language; names of the user's own profiles as they are.
[[nodiscard]] inline juce::String actuatorText(const Profile& profile)
{
    return tr(toText(shortNameOf(profile)));
}

/// Adds an actuator to a box.
inline void addActuator(juce::ComboBox& box, const Profile& profile, int id)
{
    juce::PopupMenu::Item item(actuatorText(profile));
    item.itemID = id;
    if (shortNameOf(profile) != profile.name)
        item.shortcutKeyDescription = toText(profile.name);
    box.getRootMenu()->addItem(std::move(item));
}

} // namespace pacini::editor
