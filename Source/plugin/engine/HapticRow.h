// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Row of haptic channels: gain, delay and panning of each, between its drive and its output.

#include "document/RowPlaces.h"
#include "plugin/engine/Panorama.h"
#include "plugin/engine/ParameterValues.h"

#include <pacini/foundation/Fade.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/DelayTap.h>
#include <pacini/synthesis/PlayTimeline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pacini::plugin
{

/// Smoothed delay. It changes by at most a tenth of the elapsed time, which bends pitches by less than two semitones,
/// and without a sudden change of speed, which would be heard as a click.
class DelayGlide
{
public:
    void prepare(double sampleRate) noexcept { share = std::min(1.0 / (0.005 * sampleRate), 0.5); }

    /// Sets the delay at once, in frames.
    void jump(double frames) noexcept
    {
        now = goal = frames;
        pace = 0.0;
    }
    void aim(double frames) noexcept { goal = frames; }
    [[nodiscard]] bool restsAt(double frames) const noexcept { return now == frames && goal == frames; }

    /// The present or target delay, whichever is longer, rounded up.
    [[nodiscard]] std::size_t longest() const noexcept
    {
        return static_cast<std::size_t>(std::ceil(std::max(now, goal)));
    }

    double next() noexcept
    {
        if (now == goal)
            return now;
        // The pace follows the pull of the goal, critically damped: the goal is not passed.
        pace += share * (std::clamp(0.25 * share * (goal - now), -fastest, fastest) - pace);
        now = std::max(now + pace, 0.0);
        if (std::abs(goal - now) < nearest)
            jump(goal);
        return now;
    }

private:
    static constexpr double fastest = 0.1;
    static constexpr double nearest = 1e-4; // frames: 90 dB below a tone of 1 kHz at 48 kHz

    double share = 1.0;
    double now = 0.0, goal = 0.0, pace = 0.0;
};

/// Applies a level and a delay to every channel. Their aims change with chords of 32 frames, counted from reset() on,
/// so that blocks leave no trace; levels fade within 10 ms (see Fade), delays glide. All gains are at most 1 and apply
/// after the protection. A channel at full level without a delay is copied.
class HapticRow
{
public:
    static constexpr double longestPanDelay = 0.010; // s, over the whole row

    /// For at most `channels`. Allocates.
    void prepare(double sampleRate, std::size_t channels)
    {
        fs = sampleRate;
        const double longest = fs * (0.001 * rowOf(channelParameter(0, ChannelSetting::delay)).high + longestPanDelay);
        taps.clear();
        for (std::size_t c = 0; c < std::clamp<std::size_t>(channels, 1, maxHapticChannels); ++c)
            taps.emplace_back(longest + 1.0, chord);
        for (Send& send : sends)
        {
            send.level.prepare(static_cast<std::size_t>(0.010 * fs));
            send.delay.prepare(fs);
        }
        panorama.prepare(fs);
        reset();
    }

    /// Resets to the state after prepare(). [audio]
    void reset() noexcept
    {
        for (Send& send : sends)
        {
            send.level.jump(0.0);
            send.delay.jump(0.0);
        }
        for (DelayTap& tap : taps)
            tap.reset();
        panorama.reset();
        into = 0;
        begun = false;
    }

    [[nodiscard]] std::size_t channels() const noexcept { return taps.size(); }

    /// Sets the targets of `used` channels from the next chord on; no more than channels(). [audio]
    void aim(const ParameterValues& values, std::size_t used) noexcept
    {
        const std::size_t before = std::exchange(count, std::min(used, taps.size()));
        for (std::size_t c = before; c < count; ++c)
            taps[c].reset(); // of what came before a pause
        pan = static_cast<PanChoice>(values.index(ParameterId::pan));
        law = static_cast<PanLaw>(values.index(ParameterId::panLaw));
        wanted = values[ParameterId::position];
        const bool asSet = values.index(ParameterId::places) == 1;
        std::array<double, maxHapticChannels> spots{};
        for (std::size_t c = 0; c < count; ++c)
        {
            Aim& each = aims[c];
            const double dB = values[channelParameter(c, ChannelSetting::gain)];
            each.gain = dB <= rowOf(channelParameter(c, ChannelSetting::gain)).low ? 0.0 : Decibels(dB).gain();
            each.delay = 0.001 * values[channelParameter(c, ChannelSetting::delay)] * fs;
            each.place = asSet ? values[channelParameter(c, ChannelSetting::place)] : RowPlaces::placeOf(c, count);
            spots[c] = each.place;
        }
        row = RowPlaces(std::span(spots).first(count));
    }

    /// Whether a channel has faded out, as it was asked to. [audio]
    [[nodiscard]] bool silent(std::size_t channel) const noexcept { return sends[channel].level.restsAt(0.0); }
    /// The longest that a sample of a channel may still wait. [audio]
    [[nodiscard]] std::size_t delayFrames(std::size_t channel) const noexcept { return sends[channel].delay.longest(); }
    /// Fades a channel out, or in again. [audio]
    void setMuted(std::size_t channel, bool muted) noexcept { aims[channel].muted = muted; }

    /// `out[c]` from `drives[c]`, for each of the channels in use; `left` and `right` are the sound, or empty. All of
    /// one length. [audio]
    void process(std::span<const std::span<const float>> drives, std::span<const float> left,
                 std::span<const float> right, std::span<const std::span<float>> out) noexcept
    {
        const std::size_t frames = drives.empty() ? 0 : drives[0].size();
        for (std::size_t done = 0; done < frames;)
        {
            if (into == 0)
                beginChord();
            const std::size_t n = std::min(chord - into, frames - done);
            for (std::size_t c = 0; c < count; ++c)
                play(c, drives[c].subspan(done, n), out[c].subspan(done, n));
            if (count > 1 && right.size() == frames) // at once where the sound is, when it is to follow it
                panorama.process(left.subspan(done, n), right.subspan(done, n));
            done += n;
            into = (into + n) % chord;
        }
    }

private:
    static constexpr std::size_t chord = 32;

    struct Aim
    {
        double gain = 1.0;
        double delay = 0.0; // frames
        double place = 0.0;
        bool muted = false;
    };

    struct Send
    {
        Fade level;
        DelayGlide delay; // frames
    };

    void beginChord() noexcept
    {
        const double position = pan == PanChoice::panorama ? panorama.position() : wanted;
        const bool moves = pan != PanChoice::off && count > 1;
        const double place = moves ? row.onRow(position) : 0.0;
        for (std::size_t c = 0; c < count; ++c)
        {
            const Aim& aim = aims[c];
            double level = aim.muted ? 0.0 : aim.gain;
            double delay = aim.delay;
            if (moves)
            {
                level *= panGain(law, place, row.rank(c), count);
                if (law != PanLaw::constantPower)
                    delay += longestPanDelay * fs * std::abs(position - aim.place);
            }
            Send& send = sends[c];
            if (!begun)
            {
                send.level.jump(level);
                send.delay.jump(delay);
            }
            send.level.aim(level);
            send.delay.aim(delay);
        }
        begun = true;
    }

    void play(std::size_t c, std::span<const float> drive, std::span<float> out) noexcept
    {
        auto& [level, delay] = sends[c];
        taps[c].write(drive); // so that a delay that begins finds what came before
        if (!delay.restsAt(0.0))
            for (std::size_t i = 0; i < out.size(); ++i)
                out[i] = static_cast<float>(level.next()) * taps[c].read(i, delay.next());
        else if (level.restsAt(1.0))
            std::copy(drive.begin(), drive.end(), out.begin());
        else
            for (std::size_t i = 0; i < out.size(); ++i)
                out[i] = static_cast<float>(level.next()) * drive[i];
    }

    double fs = 48000.0;
    std::vector<DelayTap> taps;
    std::array<Aim, maxHapticChannels> aims{};
    RowPlaces row;
    std::array<Send, maxHapticChannels> sends{};
    Panorama panorama;
    PanChoice pan = PanChoice::off;
    PanLaw law = PanLaw::constantPower;
    double wanted = 0.5;
    std::size_t count = 1;
    std::size_t into = 0; // the chord
    bool begun = false;
};

} // namespace pacini::plugin
