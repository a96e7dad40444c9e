#pragma once

// Voice allocation: which plays sound at a time on an actuator of few voices.

#include <pacini/clip/Curve.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Request of a play for voices of an actuator.
struct VoiceClaim
{
    double from = 0.0, to = 0.0; ///< s
    std::size_t voices = 1;      ///< sinusoids
    int priority = 0;            ///< 0 comes first
    double power = 0.0;          ///< the stronger of equal priority comes first
};

/// A time in which a play has no voice, s.
struct VoiceLoss
{
    double from = 0.0, to = 0.0;
    bool operator==(const VoiceLoss&) const = default;
};

/// The losses of every claim on an actuator of `voices` sinusoids. Between two starts or ends of plays the claims are
/// served in order of priority, then power, then index, as long as voices are left; a play with more sinusoids than are
/// left has none. Neighbouring losses are one.
[[nodiscard]] inline std::vector<std::vector<VoiceLoss>> voiceLosses(std::span<const VoiceClaim> claims,
                                                                     std::size_t voices)
{
    std::vector<std::size_t> order(claims.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b)
                     {
                         return claims[a].priority != claims[b].priority ? claims[a].priority < claims[b].priority
                                                                         : claims[a].power > claims[b].power;
                     });
    std::vector<double> times;
    for (const VoiceClaim& claim : claims)
    {
        times.push_back(claim.from);
        times.push_back(claim.to);
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());

    std::vector<std::vector<VoiceLoss>> losses(claims.size());
    for (std::size_t t = 0; t + 1 < times.size(); ++t)
    {
        std::size_t left = voices;
        for (const std::size_t i : order)
        {
            const VoiceClaim& claim = claims[i];
            if (claim.from > times[t] || claim.to <= times[t])
                continue;
            if (claim.voices <= left)
            {
                left -= claim.voices;
                continue;
            }
            auto& own = losses[i];
            if (!own.empty() && own.back().to == times[t])
                own.back().to = times[t + 1];
            else
                own.push_back({times[t], times[t + 1]});
        }
    }
    return losses;
}

/// A gain that is 0 in the losses, with fades of 5 ms inside them.
[[nodiscard]] inline Curve withoutVoice(const Curve& gain, std::span<const VoiceLoss> losses)
{
    constexpr double fade = 0.005; // s
    Curve result;
    std::size_t next = 0;
    for (const VoiceLoss& loss : losses)
    {
        while (next < gain.size() && gain[next].time < loss.from)
            result.push_back(gain[next++]);
        const double part = std::min(fade, 0.5 * (loss.to - loss.from));
        result.push_back({loss.from, valueAt(gain, loss.from)});
        result.push_back({loss.from + part, 0.0});
        result.push_back({loss.to - part, 0.0});
        result.push_back({loss.to, valueAt(gain, loss.to)});
        while (next < gain.size() && gain[next].time <= loss.to)
            ++next;
    }
    result.insert(result.end(), gain.begin() + static_cast<std::ptrdiff_t>(next), gain.end());
    return result;
}

} // namespace pacini
