#pragma once

// Packets of a clip: the tones of its bands and its events, cut into equal intervals.

#include "devices/BandTones.h"

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Units.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace pacini::devices
{

/// A part of a clip, once or over and over. from < to, both within the clip.
struct PlayRange
{
    Seconds from;
    Seconds to;
    bool loop = false;
};

/// An event as a controller can play it.
struct EventPulse
{
    RumbleTone tone;        ///< on top of the bands: 0 where they reach the event by themselves
    double level = 0.0;     ///< of the event as a whole
    double sharpness = 0.0; ///< 0 dull, 1 crisp
};

struct PacketContent
{
    std::vector<RumbleTone> bands;   ///< one for each band of the clip
    std::optional<EventPulse> event; ///< one that begins with this packet
};

/// Cuts a clip into packets of equal length. Packet n starts n intervals after the start of playing.
class ClipPackets
{
public:
    /// `clip` valid, `gain` linear, 0 or above, `interval` above 0.
    ClipPackets(Clip clipToPlay, const PlayRange& rangeToPlay, double gainToPlay, Seconds packetInterval);

    /// How many packets hold something; nothing when the clip is looped.
    [[nodiscard]] std::optional<std::int64_t> count() const noexcept;

    /// The content of a packet of 0 or later, silent after the end.
    ///
    /// Bands: see bandTones(); the packet in which a loop starts anew plays the longer of its two parts. Events go into
    /// the packet that starts nearest to them, so that they come at most half an interval early or late; those of
    /// packets that were left out go into the next. Of several events in one packet the one is played that rises most
    /// above the bands. Its frequency is that of the pulse by which a decoder plays it (makePulse()), its amplitude
    /// that by which it rises above them (pulseLevel()), so that no energy is played twice. [worker]
    [[nodiscard]] PacketContent at(std::int64_t packet);

private:
    [[nodiscard]] std::vector<RumbleTone> bandsBetween(double start, double end) const;
    [[nodiscard]] std::optional<EventPulse> strongestBetween(double start, double end) const;
    [[nodiscard]] EventPulse pulseOf(std::size_t event) const;

    Clip clip;
    PlayRange range;
    double length; ///< s of the range
    double gain;
    double interval;           ///< s
    double eventsUntil = -1e9; ///< s of playing: those before have been given out
};

} // namespace pacini::devices
