#include "document/TimeWarp.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <type_traits>
#include <utility>
#include <variant>

namespace pacini
{

namespace
{
using Pair = TimeWarp::Pair;

constexpr double tolerance = 0.04; // s: below the 50 ms at which two events are surely two
constexpr double farthest = 10.0;  // s

std::vector<Pair> matched(const std::vector<Transient>& before, const std::vector<Transient>& after, double shift)
{
    std::vector<Pair> pairs;
    std::size_t j = 0;
    for (const Transient& event : before)
    {
        const double wanted = event.time + shift;
        while (j < after.size() && after[j].time < wanted - tolerance)
            ++j;
        std::size_t best = j;
        while (best + 1 < after.size() && std::abs(after[best + 1].time - wanted) < std::abs(after[best].time - wanted))
            ++best;
        if (best >= after.size() || std::abs(after[best].time - wanted) > tolerance)
            continue;
        if (!pairs.empty() && !(event.time > pairs.back().before && after[best].time > pairs.back().after))
            continue;
        pairs.push_back({event.time, after[best].time});
        j = best + 1;
    }
    return pairs;
}

/// The shift that most pairs of transients agree on, to 10 ms. Strong ones suffice.
double commonShift(const std::vector<Transient>& before, const std::vector<Transient>& after)
{
    constexpr std::size_t most = 400;
    constexpr double bin = 0.01;
    const auto strongest = [&](std::vector<Transient> events)
    {
        std::stable_sort(events.begin(), events.end(),
                         [](const Transient& a, const Transient& b) { return a.amplitude > b.amplitude; });
        events.resize(std::min(events.size(), most));
        return events;
    };
    std::map<std::int64_t, int> votes;
    const auto others = strongest(after);
    for (const Transient& a : strongest(before))
        for (const Transient& b : others)
            if (std::abs(b.time - a.time) <= farthest)
                ++votes[std::llround((b.time - a.time) / bin)];
    std::int64_t best = 0;
    int bestVotes = 0;
    for (const auto& [shift, count] : votes)
    {
        // A shift that is not a whole number of bins votes in two of them.
        const auto next = votes.find(shift + 1);
        const int both = count + (next != votes.end() ? next->second : 0);
        if (both > bestVotes || (both == bestVotes && std::abs(shift) < std::abs(best)))
        {
            best = shift;
            bestVotes = both;
        }
    }
    return bin * static_cast<double>(best);
}

double mapped(const std::vector<Pair>& pairs, double time)
{
    if (pairs.empty())
        return time;
    const auto next =
        std::lower_bound(pairs.begin(), pairs.end(), time, [](const Pair& pair, double t) { return pair.before < t; });
    if (next != pairs.end() && next->before == time)
        return next->after;
    if (next == pairs.begin())
        return time + (next->after - next->before);
    const Pair& a = *(next - 1);
    if (next == pairs.end() || next->after - next->before == a.after - a.before)
        return time + (a.after - a.before);
    return a.after + (next->after - a.after) * ((time - a.before) / (next->before - a.before));
}

/// Keeps what is ascending in both times.
void keepAscending(std::vector<Pair>& pairs)
{
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.before < b.before; });
    std::vector<Pair> kept;
    for (const Pair& pair : pairs)
        if (kept.empty() || (pair.before > kept.back().before && pair.after > kept.back().after))
            kept.push_back(pair);
    pairs = std::move(kept);
}
} // namespace

TimeWarp TimeWarp::between(const Clip& before, const Clip& after)
{
    TimeWarp warp;
    warp.oldDuration = before.duration;
    warp.duration = after.duration;
    warp.pairs = matched(before.transients, after.transients, 0.0);
    const std::size_t fewer = std::min(before.transients.size(), after.transients.size());
    if (warp.pairs.size() * 5 < fewer * 4)
    {
        auto shifted = matched(before.transients, after.transients, commonShift(before.transients, after.transients));
        if (shifted.size() * 4 > warp.pairs.size() * 5 && shifted.size() >= 3)
            warp.pairs = std::move(shifted);
    }
    return warp;
}

double TimeWarp::map(double time) const
{
    return clampTo(mapped(pairs, time), 0.0, duration);
}

TimeRange TimeWarp::map(TimeRange range) const
{
    if (range.from > range.to)
        std::swap(range.from, range.to);
    const double from = range.from <= 0.0 ? 0.0 : map(range.from);
    if (range.to > oldDuration)
        return {from, range.to};
    return {from, range.to == oldDuration ? duration : std::max(from, map(range.to))};
}

template <typename Move>
void TimeWarp::moveAll(Move&& move)
{
    std::vector<Pair> moved;
    for (const Pair& pair : pairs)
        move(pair, moved);
    pairs = std::move(moved);
    keepAscending(pairs);
}

void TimeWarp::followOne(const TrimEdit& before, const TrimEdit& after)
{
    const TimeRange a = withinClip(before.range, oldDuration);
    const TimeRange b = withinClip(after.range, duration);
    oldDuration = a.to - a.from;
    moveAll(
        [&](const Pair& p, std::vector<Pair>& moved)
        {
            if (detail::isInside(a, p.before) && detail::isInside(b, p.after))
                moved.push_back({p.before - a.from, p.after - b.from});
        });
}

void TimeWarp::followOne(const CutEdit& before, const CutEdit& after)
{
    const TimeRange a = withinClip(before.range, oldDuration);
    const TimeRange b = withinClip(after.range, duration);
    oldDuration -= a.to - a.from;
    moveAll(
        [&](const Pair& p, std::vector<Pair>& moved)
        {
            if (p.before < a.from && p.after < b.from)
                moved.push_back(p);
            else if (p.before >= a.to && p.after >= b.to)
                moved.push_back({p.before - (a.to - a.from), p.after - (b.to - b.from)});
        });
}

void TimeWarp::followOne(const InsertEdit& before, const InsertEdit& after)
{
    const double a = clampTo(before.time, 0.0, oldDuration);
    const double b = clampTo(after.time, 0.0, duration);
    const double length = before.part ? before.part->duration : 0.0;
    oldDuration += length;
    moveAll(
        [&](const Pair& p, std::vector<Pair>& moved)
        {
            if (p.before < a && p.after < b)
                moved.push_back(p);
            else if (p.before >= a && p.after >= b)
                moved.push_back({p.before + length, p.after + length});
        });
    pairs.push_back({a, b});
    pairs.push_back({a + length, b + length});
    keepAscending(pairs);
}

void TimeWarp::followOne(const RepeatEdit& before, const RepeatEdit&)
{
    const int passes = std::clamp(before.passes, 1, 10'000);
    const double a = oldDuration;
    oldDuration *= passes;
    moveAll(
        [&](const Pair& p, std::vector<Pair>& moved)
        {
            for (int pass = 0; pass < passes; ++pass)
                moved.push_back({p.before + a * pass, p.after + duration * pass});
        });
}

void TimeWarp::followOne(const ReverseEdit&, const ReverseEdit&)
{
    moveAll(
        [&](const Pair& p, std::vector<Pair>& moved) {
            moved.push_back({oldDuration - p.before, duration - p.after});
        });
}

void TimeWarp::followOne(const StretchEdit& before, const StretchEdit&)
{
    const double ratio = clampTo(before.ratio, 0.01, 100.0);
    oldDuration *= ratio;
    moveAll([&](const Pair& p, std::vector<Pair>& moved) { moved.push_back({ratio * p.before, ratio * p.after}); });
}

void TimeWarp::follow(const EditOperation& before, const EditOperation& after, double newDuration)
{
    std::visit(
        [&](const auto& edit)
        {
            using Kind = std::decay_t<decltype(edit)>;
            if constexpr (std::is_same_v<Kind, ReplaceEdit>)
            {
                oldDuration = duration = newDuration;
                pairs.clear();
            }
            else if constexpr (requires { followOne(edit, edit); })
            {
                followOne(edit, std::get<Kind>(after));
                duration = newDuration;
            }
        },
        before);
}

} // namespace pacini
