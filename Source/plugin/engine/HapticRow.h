// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Row of haptic channels: gain, delay and panning of each, between its drive and its output.

#include "document/RowPlaces.h"
#include "plugin/engine/Panorama.h"
#include "plugin/engine/ParameterValues.h"

#include <pacini/foundation/Units.h>
#include <pacini/synthesis/DelayTap.h>
#include <pacini/synthesis/PlayTimeline.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini::plugin
{

/// Applies a level and a delay to every channel. Changes run along chords of 32 frames, counted from reset() on, so
/// that blocks leave no trace: levels cross their whole range in 10 ms at least, delays change by a tenth of the time
/// that passes at most, which bends pitches by less than two semitones. All gains are at most 1 and apply after the
/// protection. A channel at full level without a delay is copied.
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
        panorama.prepare(fs);
        reset();
    }

    /// As freshly prepared. [audio]
    void reset() noexcept
    {
        sends = {};
        panorama.reset();
        into = 0;
        begun = false;
    }

    [[nodiscard]] std::size_t channels() const noexcept { return taps.size(); }

    /// Where `used` channels are to be from the next chord on; no more than channels(). [audio]
    void aim(const ParameterValues& values, std::size_t used) noexcept
    {
        count = std::min(used, taps.size());
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
    [[nodiscard]] bool silent(std::size_t channel) const noexcept
    {
        const Send& send = sends[channel];
        return send.level == 0.0 && send.levelEnd == 0.0;
    }
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
            if (pan == PanChoice::panorama && right.size() == frames)
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

    /// Along the chord, by frames since it began.
    struct Send
    {
        double level = 0.0, levelStep = 0.0, levelEnd = 0.0;
        double delay = 0.0, delayStep = 0.0, delayEnd = 0.0; // frames
        bool listens = false;                                // the delay line holds what came
    };

    static double towards(double from, double to, double most) noexcept
    {
        return from + std::clamp(to - from, -most, most);
    }

    void beginChord() noexcept
    {
        const double most = begun ? static_cast<double>(chord) / (0.010 * fs) : 1.0;
        position = towards(position, pan == PanChoice::panorama ? panorama.position() : wanted, most);
        const bool moves = pan != PanChoice::off && count > 1;
        const double place = moves ? row.onRow(position) : 0.0;
        for (std::size_t c = 0; c < count; ++c)
        {
            const Aim& aim = aims[c];
            Send& send = sends[c];
            const auto frames = static_cast<double>(chord);
            send.level = send.levelEnd;
            send.delay = send.delayEnd;
            double level = aim.muted ? 0.0 : aim.gain;
            double delay = aim.delay;
            if (moves)
            {
                level *= panGain(law, place, row.rank(c), count);
                if (law != PanLaw::constantPower)
                    delay += longestPanDelay * fs * std::abs(position - aim.place);
            }
            if (!begun)
            {
                send.level = level;
                send.delay = delay;
            }
            send.levelEnd = towards(send.level, level, most);
            send.delayEnd = towards(send.delay, delay, 0.1 * frames);
            send.levelStep = (send.levelEnd - send.level) / frames;
            send.delayStep = (send.delayEnd - send.delay) / frames;
            const bool late = send.delay != 0.0 || send.delayEnd != 0.0;
            if (late && !send.listens)
                taps[c].reset();
            send.listens = late;
        }
        begun = true;
    }

    void play(std::size_t c, std::span<const float> drive, std::span<float> out) noexcept
    {
        const Send& send = sends[c];
        const auto level = [&](std::size_t i)
        {
            return static_cast<float>(send.level + static_cast<double>(into + i) * send.levelStep);
        };
        if (send.listens)
        {
            taps[c].write(drive);
            for (std::size_t i = 0; i < out.size(); ++i)
                out[i] = level(i) * taps[c].read(i, send.delay + static_cast<double>(into + i) * send.delayStep);
        }
        else if (send.levelStep == 0.0 && send.level == 1.0)
            std::copy(drive.begin(), drive.end(), out.begin());
        else
            for (std::size_t i = 0; i < out.size(); ++i)
                out[i] = level(i) * drive[i];
    }

    double fs = 48000.0;
    std::vector<DelayTap> taps;
    std::array<Aim, maxHapticChannels> aims{};
    RowPlaces row;
    std::array<Send, maxHapticChannels> sends{};
    Panorama panorama;
    PanChoice pan = PanChoice::off;
    PanLaw law = PanLaw::constantPower;
    double wanted = 0.5, position = 0.5;
    std::size_t count = 1;
    std::size_t into = 0; // the chord
    bool begun = false;
};

} // namespace pacini::plugin
