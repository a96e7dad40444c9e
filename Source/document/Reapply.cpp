#include "document/Reapply.h"

#include "document/EditLanes.h"
#include "document/EditLayer.h"
#include "document/TimeWarp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace pacini
{

namespace
{
constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

/// Finds the bands of edits among those of another analysis. Of several old bands that lie in one new band, the one
/// nearest to its centre has it.
class BandFinder
{
public:
    BandFinder(const Clip& target, std::span<const Edit> edits) : clip(target)
    {
        for (const Edit& edit : edits)
        {
            std::size_t i = 0;
            forNamedLanes(edit.operation,
                          [&](const Lane& lane)
                          {
                              const double frequency = i < edit.frequencies.size() ? edit.frequencies[i] : 0.0;
                              ++i;
                              if (const std::size_t k = bandOf(lane, frequency); k != nowhere)
                                  claim(lane.kind, k, frequency);
                          });
        }
    }

    /// The index of the band of a lane that had this frequency, or `nowhere`.
    [[nodiscard]] std::size_t find(const Lane& lane, double frequency) const
    {
        if (lane.kind == LaneKind::envelope || lane.kind == LaneKind::centroid)
            return 0;
        const std::size_t k = bandOf(lane, frequency);
        return k != nowhere && holders.at({lane.kind, k}) == frequency ? k : nowhere;
    }

private:
    /// The band of that number where nothing has moved: several may have the same centre, as after transposing to the
    /// end of the range. Else the one that is nearest.
    [[nodiscard]] std::size_t bandOf(const Lane& lane, double frequency) const
    {
        const std::size_t count = lane.kind == LaneKind::noise ? clip.noise.size() : clip.bands.size();
        return lane.index < count && centreOf(clip, lane) == frequency ? lane.index : nearest(lane.kind, frequency);
    }

    [[nodiscard]] std::size_t nearest(LaneKind kind, double frequency) const
    {
        const bool noise = kind == LaneKind::noise;
        const std::size_t count = noise ? clip.noise.size() : clip.bands.size();
        std::size_t best = nowhere;
        for (std::size_t k = 0; k < count; ++k)
        {
            const double low = noise ? clip.noise[k].lowFrequency : clip.bands[k].lowFrequency;
            const double high = noise ? clip.noise[k].highFrequency : clip.bands[k].highFrequency;
            if (frequency >= low && frequency <= high &&
                (best == nowhere || distance(kind, k, frequency) < distance(kind, best, frequency)))
                best = k;
        }
        return best;
    }

    [[nodiscard]] double distance(LaneKind kind, std::size_t band, double frequency) const
    {
        return std::abs(std::log(std::max(frequency, 1e-3) / std::max(centreOf(clip, {kind, band}), 1e-3)));
    }

    void claim(LaneKind kind, std::size_t band, double frequency)
    {
        const auto [holder, isFirst] = holders.emplace(std::pair(kind, band), frequency);
        if (!isFirst && distance(kind, band, frequency) < distance(kind, band, holder->second))
            holder->second = frequency;
    }

    const Clip& clip;
    std::map<std::pair<LaneKind, std::size_t>, double> holders;
};

/// Whether edits behind this one are anchored to other bands.
bool movesBands(const EditOperation& operation)
{
    return std::holds_alternative<TransposeEdit>(operation) || std::holds_alternative<ReplaceEdit>(operation) ||
           std::holds_alternative<InsertEdit>(operation);
}

/// The edits from `first` on that are anchored to the same bands.
std::span<const Edit> onSameBands(const std::vector<Edit>& edits, std::size_t first)
{
    std::size_t last = first;
    while (last < edits.size() && !movesBands(edits[last].operation))
        ++last;
    return std::span(edits).subspan(first, last - first);
}

/// One edit moved into the time of another clip.
class EditMover
{
public:
    EditMover(const Clip& target, const TimeWarp& timeWarp) : clip(target), warp(timeWarp) {}

    std::string problem;

    void operator()(LanePatch& e)
    {
        const double length = warp.durationBefore();
        const bool toTheEnd = e.range.to >= length;
        for (Breakpoint& p : e.points)
            p.time = p.time <= 0.0 ? 0.0 : p.time >= length ? clip.duration : warp.map(p.time);
        const double before = e.range.from;
        e.range = warp.map(e.range);
        e.range.to = std::min(e.range.to, clip.duration);
        if (toTheEnd)
            e.range.to = clip.duration + 1e-6; // all that validate() lets be there
        if (before > 0.0 && e.range.from >= clip.duration && clip.duration < length)
            problem = "lies beyond the end of the sound";
    }

    void operator()(TransientPatch& e)
    {
        const double shift = e.before && e.after ? e.after->time - e.before->time : 0.0;
        if (e.before)
        {
            const double wanted = warp.map(e.before->time);
            const Transient* nearest = nullptr;
            for (const Transient& event : clip.transients)
            {
                // The same event first; else the nearest.
                const auto distance = [&](const Transient& t)
                {
                    return std::abs(t.time - wanted) + (t.amplitude == e.before->amplitude ? 0.0 : 1e-9);
                };
                if (nearest == nullptr || distance(event) < distance(*nearest))
                    nearest = &event;
            }
            constexpr double reach = 0.02; // s: skin tells 8 to 10 ms apart, analyses place an event within about 10
            if (nearest == nullptr || std::abs(nearest->time - wanted) > reach)
            {
                e.before->time = wanted;
                if (e.after)
                    e.after->time = wanted + shift;
                problem = fmt::format("the event at {:.3f} s no longer exists", wanted);
                return;
            }
            const Transient was = *e.before;
            e.before = *nearest;
            if (e.after)
            {
                // What was not changed by hand follows the analysis.
                e.after->time = e.after->time == was.time ? nearest->time : nearest->time + shift;
                if (e.after->amplitude == was.amplitude)
                    e.after->amplitude = nearest->amplitude;
                if (e.after->sharpness == was.sharpness)
                    e.after->sharpness = nearest->sharpness;
            }
        }
        else if (e.after)
            e.after->time = warp.map(e.after->time);
    }

    void operator()(MarkersEdit& e)
    {
        for (Marker& marker : e.markers)
            marker.time = warp.map(marker.time);
    }

    void operator()(InsertEdit& e) { e.time = e.time >= warp.durationBefore() ? clip.duration : warp.map(e.time); }
    void operator()(TrimEdit& e) { e.range = warp.map(e.range); }
    void operator()(CutEdit& e) { e.range = warp.map(e.range); }
    void operator()(ThinEdit& e) { e.range = warp.map(e.range); }
    void operator()(QuantiseEdit& e) { e.scope.range = warp.map(e.scope.range); }

    template <typename Other>
    void operator()(Other& e)
    {
        if constexpr (hasScope<Other>)
            e.scope.range = warp.map(e.scope.range);
    }

private:
    const Clip& clip;
    const TimeWarp& warp;
};

/// Puts an edit on the lanes of another clip; what is wrong, or nothing.
std::string placeLanes(Edit& edit, const BandFinder& bands)
{
    std::string missing;
    std::size_t i = 0;
    forNamedLanes(edit.operation,
                  [&](Lane& lane)
                  {
                      const double frequency = i < edit.frequencies.size() ? edit.frequencies[i] : 0.0;
                      ++i;
                      lane.index = bands.find(lane, frequency);
                      if (lane.index == nowhere)
                          missing += fmt::format("{}{:.0f} Hz", missing.empty() ? "" : ", ", frequency);
                  });
    return missing.empty() ? missing : "no band left near " + missing;
}
} // namespace

Reapplied reapply(const Clip& before, const Clip& after, const std::vector<Edit>& edits)
{
    Reapplied result{after, {}, {}};
    TimeWarp warp = TimeWarp::between(before, after);
    std::optional<BandFinder> bands;
    for (std::size_t i = 0; i < edits.size(); ++i)
    {
        const Edit& made = edits[i];
        if (!bands)
            bands.emplace(result.clip, onSameBands(edits, i));
        Edit edit = made;
        std::string problem = placeLanes(edit, *bands);
        warp.setDurationBefore(made.duration);
        edit.duration = result.clip.duration;
        EditMover mover(result.clip, warp);
        std::visit(mover, edit.operation);
        if (!mover.problem.empty())
            problem = mover.problem;
        const bool whole = problem.empty() || !std::holds_alternative<LanePatch>(edit.operation);
        if (whole && mover.problem.empty())
        {
            auto applied = applyEdit(result.clip, edit.operation);
            if (applied)
            {
                result.clip = std::move(applied).value();
                warp.follow(made.operation, edit.operation, result.clip.duration);
                if (movesBands(edit.operation))
                    bands.reset();
            }
            else
                problem = applied.error().text();
        }
        if (!problem.empty())
            result.unfitting.push_back({result.edits.size(), problem});
        result.edits.push_back(std::move(edit));
    }
    return result;
}

} // namespace pacini
