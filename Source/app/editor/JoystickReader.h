// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Reader of game controllers on Linux: pressed buttons.

#include <juce_core/juce_core.h>

#include <filesystem>
#include <functional>

namespace pacini::app
{

/// A pressed button, or a stick or cross moved to an end; repeated while it stays there.
struct JoystickPress
{
    int button = -1;   ///< counted from 0; -1: an axis
    int axis = -1;     ///< counted from 0; -1: a button
    int direction = 0; ///< of the axis: -1 or 1
};

/// Listens to all joysticks, also those connected later. Finds none on systems other than Linux.
class JoystickReader final : private juce::Thread
{
public:
    /// `joysticks`: the folder that has them, as `js0`. `pressed` is called from a thread of this.
    JoystickReader(std::filesystem::path joysticks, std::function<void(const JoystickPress&)> pressed);
    ~JoystickReader() override;

private:
    void run() override;

    const std::filesystem::path folder;
    const std::function<void(const JoystickPress&)> tell;
};

} // namespace pacini::app
