#pragma once

// Plausibility checks of a recording before it is analysed.

#include <pacini/foundation/Result.h>
#include <pacini/linearize/SweepMeasurement.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace pacini
{

/// A time with its unit, for messages: `12.35 s`.
[[nodiscard]] inline std::string secondsText(double seconds)
{
    const long long hundredths = std::llround(std::abs(seconds) * 100.0);
    std::string text = seconds < 0.0 ? "-" : "";
    text += std::to_string(hundredths / 100);
    text += hundredths % 100 < 10 ? ".0" : ".";
    text += std::to_string(hundredths % 100);
    text += " s";
    return text;
}

[[nodiscard]] inline std::string channelPath(std::size_t channel)
{
    return "channels[" + std::to_string(channel) + "]";
}

/// Success for 1 to 3 channels of equal length and finite samples. Errors: invalidArgument at `channels` for other
/// counts, truncated at `channels[c]` for one shorter than the first or without samples, invalidData for a longer one,
/// notFinite at `channels[c][n]`.
[[nodiscard]] inline Result<void> checkRecording(std::span<const std::vector<float>> channels)
{
    if (channels.empty() || channels.size() > 3)
        return Error{ErrorCode::invalidArgument, "channels", "must be one to three: a microphone or the axes"};
    for (std::size_t c = 0; c < channels.size(); ++c)
    {
        if (channels[c].empty())
            return Error{ErrorCode::truncated, channelPath(c), "has no samples"};
        if (channels[c].size() != channels.front().size())
            return Error{channels[c].size() < channels.front().size() ? ErrorCode::truncated : ErrorCode::invalidData,
                         channelPath(c), "differs in length from the first channel; record all channels together"};
        const auto bad =
            std::find_if(channels[c].begin(), channels[c].end(), [](float v) { return !std::isfinite(v); });
        if (bad != channels[c].end())
            return Error{ErrorCode::notFinite, channelPath(c) + "[" + std::to_string(bad - channels[c].begin()) + "]",
                         "must be a finite number"};
    }
    return {};
}

/// Clipping: samples at a limit.
struct Clipping
{
    std::size_t samples = 0;
    std::size_t firstFrame = 0;
};

/// Looks for a limit on both sides of a channel. A signal that is not limited spends less time in the outermost 0.1 %
/// of its range than in the 3 % below them (a sinusoid, which stays longest at its ends, a third), a limited one more;
/// so an accelerometer's own limit is found as well as the converter's. Ten samples at least; a channel with a
/// resolution below 100 steps is judged by full scale alone.
[[nodiscard]] inline std::optional<Clipping> findClipping(std::span<const float> x)
{
    Clipping found;
    const auto count = [&](double limit, double sign)
    {
        for (std::size_t n = 0; n < x.size(); ++n)
            if (sign * static_cast<double>(x[n]) >= limit)
            {
                if (found.samples == 0 || n < found.firstFrame)
                    found.firstFrame = n;
                ++found.samples;
            }
    };
    double mean = 0.0;
    for (const float v : x)
        mean += static_cast<double>(v);
    mean /= static_cast<double>(std::max<std::size_t>(1, x.size()));
    for (const double sign : {1.0, -1.0})
    {
        double largest = 0.0;
        for (const float v : x)
            largest = std::max(largest, sign * (static_cast<double>(v) - mean));
        if (!(largest > 0.0))
            continue;
        std::size_t outermost = 0;
        std::size_t below = 0;
        double nextBelow = 0.0;
        for (const float v : x)
        {
            const double part = sign * (static_cast<double>(v) - mean) / largest;
            outermost += part >= 0.999 ? 1 : 0;
            below += part >= 0.969 && part < 0.999 ? 1 : 0;
            if (part < 1.0)
                nextBelow = std::max(nextBelow, part);
        }
        const double end = largest + sign * mean;
        const bool coarse = nextBelow < 0.99;
        const bool atFullScale = end >= 0.9999 && outermost >= 3;
        if (atFullScale || (!coarse && outermost >= 10 && outermost > below))
            count(sign * mean + 0.999 * largest, sign);
    }
    return found.samples > 0 ? std::optional(found) : std::nullopt;
}

/// Warnings for every channel that clips, or that never changes while another one does.
inline void warnOfChannels(std::span<const std::vector<float>> channels, double fs,
                           std::vector<MeasurementWarning>& warnings)
{
    for (std::size_t c = 0; c < channels.size(); ++c)
    {
        const auto [least, most] = std::minmax_element(channels[c].begin(), channels[c].end());
        if (*least == *most)
            warnings.push_back(
                {MeasurementDefect::silentChannel, channelPath(c), "never changes; check that the axis is connected"});
        else if (const auto clipping = findClipping(channels[c]))
            warnings.push_back({MeasurementDefect::clipping, channelPath(c),
                                std::to_string(clipping->samples) + " samples at the limit, first at " +
                                    secondsText(static_cast<double>(clipping->firstFrame) / fs) +
                                    "; record or drive at a lower level"});
    }
}

} // namespace pacini
