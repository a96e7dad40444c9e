// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The haptic outputs that a clip plays on: which actuator is on each, its gain, delay and place. They are the user's
// and not the project's.

#include "document/PreviewRow.h"
#include "editor/clip/session/Actuators.h"

#include <optional>
#include <string>
#include <vector>

namespace pacini::editor
{

struct HapticOutput
{
    int channel = 2;      ///< of the device, from 0; on devices with fewer the last one; -1: none
    std::string actuator; ///< the name of a profile; empty: that of the project
    double gain = 0.0;    ///< dB, -60 (silent) to 0
    double delay = 0.0;   ///< s, 0 to 0.5
    double place = 0.0;   ///< 0 to 1, for the pan
    bool operator==(const HapticOutput&) const = default;
};

/// [message]
class HapticOutputs
{
public:
    static constexpr std::size_t most = PreviewRow::most;
    static constexpr double leastGain = -60.0, longestDelay = 0.5;
    static constexpr const char* plainDrive = "plain drive"; ///< as an actuator: none

    Signal changed;

    [[nodiscard]] const std::vector<HapticOutput>& outputs() const noexcept { return list; }
    /// 1 to 8; further ones are left out, values are clamped.
    void setOutputs(std::vector<HapticOutput> wanted);
    /// One more, on the next channel of the device, at the far end of the row; or one less, the last.
    void add();
    void removeLast();

    /// How a clip's position counts; none: every output plays all of it.
    [[nodiscard]] std::optional<PanLaw> pan() const noexcept { return law; }
    void setPan(std::optional<PanLaw> wanted);

    /// For the player.
    [[nodiscard]] PreviewRow row(const Actuators& actuators) const;

private:
    std::vector<HapticOutput> list{HapticOutput{}};
    std::optional<PanLaw> law;
};

} // namespace pacini::editor
