// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The haptic outputs that a clip plays on: which actuator is on each, its gain, delay and place. They are the user's
// and not the project's.

#include "document/PreviewRow.h"
#include "editor/clip/session/Actuators.h"
#include "io/PlaybackSettings.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace pacini::editor
{

using pacini::HapticOutput;

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
    /// One more, on the next free channel of the device or on none, at the far end of the row; or one less, the last.
    void add();
    void removeLast();

    /// How a clip's position counts; none: every output plays all of it.
    [[nodiscard]] std::optional<PanLaw> pan() const noexcept { return law; }
    void setPan(std::optional<PanLaw> wanted);

    /// The channels of the device, by whether each is switched on, and the first of the two for the sound, or -1; no
    /// list where nobody knows, as in a host.
    void setDevice(std::optional<std::vector<bool>> channelsOn, int soundChannel = -1);
    /// False where it is known that there is none.
    [[nodiscard]] bool hasDevice() const noexcept { return !device || !device->empty(); }
    /// The channel that an output plays on, -1: nowhere. On devices with too few it is the last one; of several on one
    /// only the first plays: each drive is within the limits of its actuator, and their sum need not be.
    [[nodiscard]] int channelOf(std::size_t output) const;
    [[nodiscard]] std::size_t playingCount() const;

    /// Whether clips are felt on something without a channel: a controller, a phone. Null: never.
    std::function<bool()> playsElsewhere;
    /// Somebody wants to play, and there is nothing to play on.
    std::function<void()> onNowhere;
    [[nodiscard]] bool canPlay() const { return hasDevice() || (playsElsewhere && playsElsewhere()); }
    /// The same, and says so where it is not.
    [[nodiscard]] bool readyToPlay() const;

    /// For the player.
    [[nodiscard]] PreviewRow row(const Actuators& actuators) const;

private:
    [[nodiscard]] int freeChannel() const;

    std::vector<HapticOutput> list{HapticOutput{}};
    std::optional<PanLaw> law;
    std::optional<std::vector<bool>> device;
    int sound = -1;
};

} // namespace pacini::editor
