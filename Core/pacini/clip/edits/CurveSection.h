#pragma once

// Sections of curves, the basis of edits of a time range.

#include <pacini/clip/Curve.h>
#include <pacini/clip/edits/Lane.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace pacini
{

/// The value just before `time`: at a step the earlier one, elsewhere that of valueAt(). 0 for an empty curve. O(log
/// n).
[[nodiscard]] inline double valueBefore(const Curve& curve, double time) noexcept
{
    const auto next =
        std::lower_bound(curve.begin(), curve.end(), time, [](const Breakpoint& p, double t) { return p.time < t; });
    if (next != curve.end() && next->time == time)
        return next->value;
    return valueAt(curve, time);
}

/// Appends a point that is not earlier than the last. Of points at one time only the first and the newest stay, which
/// is all that a step needs; a point that is already there is not repeated.
inline void appendPoint(Curve& curve, Breakpoint point)
{
    const std::size_t n = curve.size();
    if (n > 0 && curve[n - 1] == point)
        return;
    if (n > 1 && curve[n - 2].time == point.time)
        curve.pop_back();
    if (curve.empty() || curve.back() != point)
        curve.push_back(point);
}

/// The points of `range` (in order, within the curve's clip), moved by -range.from, with points at both ends on the
/// lines that lead there. Empty for an empty curve.
[[nodiscard]] inline Curve curveSection(const Curve& curve, TimeRange range)
{
    Curve part;
    if (curve.empty())
        return part;
    part.push_back({0.0, valueAt(curve, range.from)});
    const auto first = std::upper_bound(curve.begin(), curve.end(), range.from,
                                        [](double t, const Breakpoint& p) { return t < p.time; });
    const auto last =
        std::lower_bound(first, curve.end(), range.to, [](const Breakpoint& p, double t) { return p.time < t; });
    for (auto p = first; p != last; ++p)
        part.push_back({p->time - range.from, p->value});
    appendPoint(part, {range.to - range.from, valueBefore(curve, range.to)});
    return part;
}

/// Appends `part` moved by `at`, which is not before the curve's end. A step joins them where values differ.
inline void appendCurve(Curve& curve, const Curve& part, double at)
{
    std::size_t i = 0;
    for (; i < part.size() && part[i].time <= 0.0; ++i)
        appendPoint(curve, {at + part[i].time, part[i].value});
    for (; i < part.size(); ++i)
        curve.push_back({at + part[i].time, part[i].value});
}

/// Treatment of the lines between points by mapValues().
struct MapLines
{
    double step = 0.0; ///< s: lines are split so that no piece is longer; 0 = `f` is linear in the value alone
};

/// A curve whose values inside `range` (in order, within 0..duration) become f(point); outside nothing changes: where
/// the range ends inside the clip, the curve steps. An empty curve stays empty.
template <typename F>
[[nodiscard]] Curve mapValues(const Curve& curve, TimeRange range, double duration, MapLines lines, F&& f)
{
    if (curve.empty())
        return {};
    const auto first = std::lower_bound(curve.begin(), curve.end(), range.from,
                                        [](const Breakpoint& p, double t) { return p.time < t; });
    const auto last =
        std::upper_bound(first, curve.end(), range.to, [](double t, const Breakpoint& p) { return t < p.time; });
    Curve inside;
    const auto add = [&](Breakpoint p)
    {
        if (lines.step > 0.0 && !inside.empty() && p.time - inside.back().time > lines.step)
        {
            const Breakpoint a = inside.back();
            const double pieces = std::ceil((p.time - a.time) / lines.step);
            for (double k = 1.0; k < pieces; k += 1.0)
            {
                const double x = k / pieces;
                inside.push_back({a.time + x * (p.time - a.time), a.value + x * (p.value - a.value)});
            }
        }
        inside.push_back(p);
    };
    if (lines.step > 0.0 || range.from > 0.0)
        if (first == last || first->time > range.from)
            add({range.from, valueAt(curve, range.from)});
    for (auto p = first; p != last; ++p)
        add(*p);
    if (lines.step > 0.0 || range.to < duration)
        if (inside.empty() || inside.back().time < range.to)
            add({range.to, valueAt(curve, range.to)});

    Curve result;
    result.reserve(curve.size() + inside.size() - static_cast<std::size_t>(std::distance(first, last)) + 2);
    result.assign(curve.begin(), first);
    if (range.from > 0.0)
        appendPoint(result, {range.from, valueBefore(curve, range.from)});
    for (const Breakpoint& p : inside)
        appendPoint(result, {p.time, f(p)});
    if (range.to < duration)
        appendPoint(result, {range.to, valueAt(curve, range.to)});
    result.insert(result.end(), last, curve.end());
    return result;
}

/// A curve whose points inside `range` (closed, in order) are replaced by `points`, which lie inside it.
[[nodiscard]] inline Curve replaceSection(const Curve& curve, TimeRange range, const Curve& points)
{
    const auto first = std::lower_bound(curve.begin(), curve.end(), range.from,
                                        [](const Breakpoint& p, double t) { return p.time < t; });
    const auto last =
        std::upper_bound(first, curve.end(), range.to, [](double t, const Breakpoint& p) { return t < p.time; });
    Curve result;
    result.reserve(curve.size() + points.size());
    result.assign(curve.begin(), first);
    result.insert(result.end(), points.begin(), points.end());
    result.insert(result.end(), last, curve.end());
    return result;
}

} // namespace pacini
