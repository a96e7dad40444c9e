// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Key logic of a switch that stays when its key is tapped and goes back when it was held.

#include <cstdint>

namespace pacini::editor
{

/// The key of a switch: a tap toggles the switch; holding the key toggles it until release. Times in ms.
class HeldSwitch
{
public:
    /// The key is pressed, or repeats because it is held. True: the switch turns.
    bool press(std::uint32_t now) noexcept
    {
        if (down)
            return false;
        down = true;
        since = now;
        return true;
    }

    /// The key is up. True: it was held, and the switch turns back.
    bool release(std::uint32_t now) noexcept
    {
        constexpr std::uint32_t tap = 400;
        const bool was = down;
        down = false;
        return was && now - since > tap;
    }

    [[nodiscard]] bool isDown() const noexcept { return down; }

private:
    bool down = false;
    std::uint32_t since = 0;
};

} // namespace pacini::editor
