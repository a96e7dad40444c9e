// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Preview of a sound file that is not opened: heard and felt at once, on what clips play on.

#include "document/ClipPlayer.h"
#include "editor/clip/session/Actuators.h"
#include "editor/clip/session/HapticOutputs.h"
#include "editor/clip/session/Jobs.h"
#include "editor/clip/session/Signal.h"
#include "editor/clip/session/Sound.h"

#include <filesystem>

namespace pacini::editor
{

/// Only while no clip is shown: both would want the player. [message]
class FilePreview
{
public:
    FilePreview(EditorModel& project, const Actuators& profiles, const HapticOutputs& hapticOutputs,
                ClipPlayer& played);

    Signal changed;

    /// The file that plays or is about to; empty: none.
    [[nodiscard]] const std::filesystem::path& file() const noexcept { return wanted; }
    /// Reads and analyses it in the background, then plays it once. What cannot be read is silent: opening it says why.
    void play(const std::filesystem::path& sound);
    void stop();

private:
    EditorModel& model;
    const Actuators& actuators;
    const HapticOutputs& outputs;
    ClipPlayer& player;
    std::filesystem::path wanted;
    Jobs jobs;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
