#pragma once

// Live panning: the level and delay of a play towards each actuator of a row, while its position glides.

#include <pacini/foundation/Glide.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/PlayTimeline.h>
#include <pacini/synthesis/Scene.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace pacini
{

/// A row of actuators, some of which are rendered here.
struct ActuatorRow
{
    std::vector<std::size_t> places; ///< of each channel, in the whole row
    std::size_t length = 1;          ///< of the whole row
    PanLaw law = PanLaw::constantPower;
    double longestDelay = 0.01; ///< s, for the whole row
};

/// A row that is played as a whole.
[[nodiscard]] inline ActuatorRow wholeRow(std::size_t actuators, PanLaw law, Seconds longestDelay)
{
    ActuatorRow row{std::vector<std::size_t>(actuators), actuators, law, longestDelay.value};
    std::iota(row.places.begin(), row.places.end(), std::size_t(0));
    return row;
}

/// Send level of one actuator along a chord, by frames since the start.
struct SendPiece
{
    double level = 0.0, levelStep = 0.0;
    double delay = 0.0, delayStep = 0.0; ///< s

    [[nodiscard]] double levelAt(std::size_t frame) const noexcept
    {
        return level + static_cast<double>(frame) * levelStep;
    }
    [[nodiscard]] double delayAt(std::size_t frame) const noexcept
    {
        return delay + static_cast<double>(frame) * delayStep;
    }
};

/// Sends of a play to the actuators of a row. While the position glides, levels and delays run along chords of at most
/// 32 frames, so that a cosine is computed once in a while; they never jump, whenever a glide begins.
class PanSends
{
public:
    /// Allocates.
    explicit PanSends(ActuatorRow actuators) : row(std::move(actuators)), sends(row.places.size()) { place(0.5); }

    /// Stands at `position` (0-1) at once. [audio]
    void place(double position) noexcept
    {
        pan = Glide(position);
        settle();
    }

    /// Glides to `position` (0-1) within `frames`, 1 at least. [audio]
    void glideTo(double position, std::size_t frames) noexcept
    {
        pan.glideTo(position, std::max<std::size_t>(frames, 1));
        startChord();
    }

    /// Stands and glides as another one over as many actuators. [audio]
    void follow(const PanSends& other) noexcept
    {
        pan = other.pan;
        std::copy_n(other.sends.begin(), std::min(sends.size(), other.sends.size()), sends.begin());
        chordLeft = other.chordLeft;
        into = other.into;
    }

    [[nodiscard]] double position() const noexcept { return pan.goal(); }

    [[nodiscard]] bool hasDelays() const noexcept { return row.law != PanLaw::constantPower && row.longestDelay > 0.0; }

    /// s
    [[nodiscard]] double longestDelay() const noexcept { return hasDelays() ? row.longestDelay : 0.0; }

    /// Frames from the next one on, up to `most`, that lie on one chord. [audio]
    [[nodiscard]] std::size_t straightFrames(std::size_t most) const noexcept { return std::min(chordLeft, most); }

    /// Frames of the chord before the next one. [audio]
    [[nodiscard]] std::size_t framesIntoChord() const noexcept { return into; }

    /// The send to channel `a` along the chord. [audio]
    [[nodiscard]] const SendPiece& send(std::size_t a) const noexcept { return sends[a]; }

    /// Whether no send changes. [audio]
    [[nodiscard]] bool resting() const noexcept { return chordLeft == forever; }

    /// Advances by `frames`, at most straightFrames(). [audio]
    void advance(std::size_t frames) noexcept
    {
        if (chordLeft == forever)
            return;
        pan.skip(frames);
        into += frames;
        chordLeft -= frames;
        if (chordLeft > 0)
            return;
        if (pan.resting())
            settle();
        else
            startChord();
    }

    /// Advances by any number of frames without output. [audio]
    void jump(std::size_t frames) noexcept
    {
        if (chordLeft == forever)
            return;
        pan.jump(frames);
        settle();
        if (!pan.resting())
            startChord();
    }

private:
    static constexpr std::size_t chord = 32;
    static constexpr std::size_t forever = std::numeric_limits<std::size_t>::max();

    [[nodiscard]] double levelAt(double position, std::size_t a) const noexcept
    {
        return panGain(row.law, position, row.places[a], row.length);
    }
    [[nodiscard]] double delayAt(double position, std::size_t a) const noexcept
    {
        return hasDelays() ? panDelay(position, row.places[a], row.length, row.longestDelay) : 0.0;
    }

    void settle() noexcept
    {
        chordLeft = forever;
        into = 0;
        for (std::size_t a = 0; a < sends.size(); ++a)
            sends[a] = {levelAt(pan.now(), a), 0.0, delayAt(pan.now(), a), 0.0};
    }

    void startChord() noexcept
    {
        chordLeft = std::min(chord, pan.framesLeft());
        Glide ahead = pan;
        ahead.skip(chordLeft);
        const auto frames = static_cast<double>(chordLeft);
        for (std::size_t a = 0; a < sends.size(); ++a)
        {
            const double level = sends[a].levelAt(into), delay = sends[a].delayAt(into);
            sends[a] = {level, (levelAt(ahead.now(), a) - level) / frames, delay,
                        (delayAt(ahead.now(), a) - delay) / frames};
        }
        into = 0;
    }

    ActuatorRow row;
    Glide pan{0.5};
    std::vector<SendPiece> sends;
    std::size_t chordLeft = forever;
    std::size_t into = 0;
};

} // namespace pacini
