#pragma once

// Dynamic compensation of a live drive by an accelerometer in a channel of the sound.

#include <pacini/actuator/DynamicCompensation.h>
#include <pacini/actuator/LevelLimiter.h>
#include <pacini/actuator/Profile.h>
#include <pacini/actuator/Protection.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace pacini::cli
{

/// What a person is told of a sensor.
[[nodiscard]] constexpr std::string_view sensorText(SensorState state) noexcept
{
    switch (state)
    {
    case SensorState::waiting:
        return "waits for the drive";
    case SensorState::good:
        return "follows the drive";
    case SensorState::apart:
        return "does not follow the drive";
    case SensorState::dead:
        return "does not move";
    case SensorState::saturated:
        return "is saturated";
    case SensorState::notANumber:
        return "gives no numbers";
    }
    return {};
}

/// Changes the drive by what comes back from its actuator, and keeps it within the limits of that. What is compared is
/// the drive as it is played, behind these limits.
class LiveFollow
{
public:
    /// One band, as it is now.
    struct Band
    {
        double frequency = 0.0; ///< Hz
        double gain = 0.0;      ///< dB
        bool held = false;
    };

    /// `channelToFollow`: of the sound, from 0. Allocates.
    LiveFollow(double sampleRate, std::size_t longestPiece, std::size_t channelToFollow,
               DynamicCompensationParams params, const std::optional<Profile>& profile)
        : channel(channelToFollow)
    {
        constexpr Seconds lookAhead(0.001);
        const ProcessSpec spec{sampleRate, longestPiece};
        params.needsEvidence = true;
        if (profile)
        {
            protection.emplace();
            protection->prepare(spec);
            protection->setParams(protectionParams(*profile, lookAhead));
            protection->reset();
            params.lowFrequency = Hertz(std::max(10.0, profile->range.lowFrequency));
            params.highFrequency = Hertz(profile->range.highFrequency);
        }
        else
        {
            limiter.emplace();
            limiter->prepare(spec);
            LevelLimiterParams limiting;
            limiting.lookAhead = lookAhead;
            limiter->setParams(limiting);
            limiter->reset();
        }
        compensation.setParams(params);
        compensation.prepare(spec);
    }

    [[nodiscard]] std::size_t followedChannel() const noexcept { return channel; }

    /// Frames by which the drive is later.
    [[nodiscard]] std::size_t latencyFrames() const noexcept
    {
        return protection ? protection->latencyFrames() : limiter->latencyFrames();
    }

    /// The drive in place, with what came back meanwhile. [audio]
    void process(std::span<float> drive, std::span<const float> feedback) noexcept
    {
        compensation.process(drive, drive);
        if (protection)
            protection->process(drive, drive);
        else
            limiter->process(drive, drive);
        compensation.learn(drive, feedback);
        const auto count = compensation.frequencies().size();
        bool held = false;
        for (std::size_t k = 0; k < count; ++k)
        {
            gains[k].store(static_cast<float>(compensation.gain(k)), std::memory_order_relaxed);
            holds[k].store(compensation.holds(k), std::memory_order_relaxed);
            held = held || compensation.holds(k);
        }
        state.store(compensation.sensor(), std::memory_order_relaxed);
        if (held)
            heldFrames.store(heldFrames.load(std::memory_order_relaxed) + drive.size(), std::memory_order_relaxed);
    }

    /// [any]
    [[nodiscard]] SensorState sensor() const noexcept { return state.load(std::memory_order_relaxed); }

    /// Frames in which some band held its gain for want of evidence. [any]
    [[nodiscard]] std::uint64_t held() const noexcept { return heldFrames.load(std::memory_order_relaxed); }

    /// [message]
    [[nodiscard]] std::vector<Band> bands() const
    {
        std::vector<Band> list;
        for (std::size_t k = 0; k < compensation.frequencies().size(); ++k)
            list.push_back({compensation.frequencies()[k],
                            static_cast<double>(gains[k].load(std::memory_order_relaxed)),
                            holds[k].load(std::memory_order_relaxed)});
        return list;
    }

private:
    std::size_t channel;
    DynamicCompensation compensation;
    std::optional<Protection> protection; ///< of the profile
    std::optional<LevelLimiter> limiter;  ///< without one
    std::array<std::atomic<float>, DynamicCompensation::maxBands> gains{};
    std::array<std::atomic<bool>, DynamicCompensation::maxBands> holds{};
    std::atomic<SensorState> state{SensorState::waiting};
    std::atomic<std::uint64_t> heldFrames{0};
};

} // namespace pacini::cli
