#include "document/EditLayer.h"

#include "document/TimeWarp.h"

#include <pacini/clip/edits/TimeEdits.h>
#include <pacini/clip/edits/TransientEdits.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>

namespace pacini
{

namespace
{
template <typename T>
constexpr bool hasScope = requires(T operation)
{
    operation.scope;
};

constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

/// Calls visit(lane) for each lane that an operation names.
template <typename Operation, typename Visit>
void forNamedLanes(Operation& operation, Visit&& visit)
{
    std::visit(
        [&](auto& op)
        {
            using Op = std::decay_t<decltype(op)>;
            if constexpr (std::is_same_v<Op, LanePatch>)
                visit(op.lane);
            else if constexpr (hasScope<Op>)
                if (!op.scope.allLanes)
                    for (auto& lane : op.scope.lanes)
                        visit(lane);
        },
        operation);
}

double centreOf(const Clip& clip, Lane lane)
{
    if ((lane.kind == LaneKind::amplitude || lane.kind == LaneKind::pitch) && lane.index < clip.bands.size())
        return clip.bands[lane.index].centreFrequency;
    if (lane.kind == LaneKind::noise && lane.index < clip.noise.size())
        return std::sqrt(clip.noise[lane.index].lowFrequency * clip.noise[lane.index].highFrequency);
    return 0.0;
}

Clip withTransient(Clip clip, const TransientPatch& patch)
{
    const auto same =
        patch.before ? std::find(clip.transients.begin(), clip.transients.end(), *patch.before) : clip.transients.end();
    if (patch.before && same == clip.transients.end())
        return clip;
    if (same != clip.transients.end())
        clip.transients.erase(same);
    return patch.after ? addTransient(std::move(clip), *patch.after) : clip;
}

Result<Clip> withPatch(Clip clip, const LanePatch& patch)
{
    Curve* curve = curveOf(clip, patch.lane);
    if (curve == nullptr)
        return Error{ErrorCode::invalidArgument, "lane", "is not in the clip"};
    *curve = replaceSection(*curve, patch.range, patch.points);
    return clip;
}

Result<Clip> replaced(const std::shared_ptr<const Clip>& clip)
{
    if (!clip)
        return Error{ErrorCode::invalidData, "clip", "is missing"};
    return *clip;
}

struct Applier
{
    const Clip& clip;

    Result<Clip> operator()(const LanePatch& e) const { return withPatch(clip, e); }
    Result<Clip> operator()(const TransientPatch& e) const { return withTransient(clip, e); }
    Result<Clip> operator()(const MarkersEdit& e) const
    {
        Clip result = clip;
        result.markers = e.markers;
        return result;
    }
    Result<Clip> operator()(const RenameEdit& e) const
    {
        Clip result = clip;
        result.name = e.name;
        return result;
    }
    Result<Clip> operator()(const GainEdit& e) const { return amplify(clip, e.scope, e.decibels); }
    Result<Clip> operator()(const FadeEdit& e) const { return fade(clip, e.scope, e.direction, e.shape); }
    Result<Clip> operator()(const InvertEdit& e) const { return invert(clip, e.scope); }
    Result<Clip> operator()(const QuantiseEdit& e) const { return quantiseTimes(clip, e.scope, e.grid); }
    Result<Clip> operator()(const HumaniseEdit& e) const { return humanise(clip, e.scope, e.amount); }
    Result<Clip> operator()(const TransposeEdit& e) const { return transpose(clip, e.semitones); }
    Result<Clip> operator()(const TrimEdit& e) const { return trimClip(clip, e.range); }
    Result<Clip> operator()(const CutEdit& e) const { return cutClip(clip, e.range); }
    Result<Clip> operator()(const InsertEdit& e) const
    {
        return e.part ? insertClip(clip, e.time, *e.part) : Result<Clip>(clip);
    }
    Result<Clip> operator()(const RepeatEdit& e) const { return repeatClip(clip, e.passes); }
    Result<Clip> operator()(const ReverseEdit&) const { return reverseClip(clip); }
    Result<Clip> operator()(const StretchEdit& e) const { return stretchClip(clip, e.ratio); }
    Result<Clip> operator()(const ReplaceEdit& e) const { return replaced(e.clip); }
    Result<Clip> operator()(const ThinEdit& e) const { return thinTransients(clip, e.range, e.gap, e.weakest); }
};

bool sameHead(const Clip& a, const Clip& b)
{
    if (a.duration != b.duration || a.source != b.source || a.encoder != b.encoder ||
        a.bands.size() != b.bands.size() || a.noise.size() != b.noise.size())
        return false;
    for (std::size_t k = 0; k < a.bands.size(); ++k)
        if (a.bands[k].lowFrequency != b.bands[k].lowFrequency ||
            a.bands[k].centreFrequency != b.bands[k].centreFrequency ||
            a.bands[k].highFrequency != b.bands[k].highFrequency || a.bands[k].priority != b.bands[k].priority)
            return false;
    for (std::size_t k = 0; k < a.noise.size(); ++k)
        if (a.noise[k].lowFrequency != b.noise[k].lowFrequency || a.noise[k].highFrequency != b.noise[k].highFrequency)
            return false;
    return true;
}

LanePatch patchBetween(Lane lane, const Curve& before, const Curve& after)
{
    const std::size_t fewer = std::min(before.size(), after.size());
    std::size_t front = 0;
    while (front < fewer && before[front] == after[front])
        ++front;
    std::size_t back = 0;
    while (back < fewer - front && before[before.size() - 1 - back] == after[after.size() - 1 - back])
        ++back;
    LanePatch patch;
    patch.lane = lane;
    const double beginning = 0.0;
    double end = 0.0;
    for (const Curve* curve : {&before, &after})
        if (curve->size() > back)
            end = std::max(end, (*curve)[curve->size() - 1 - back].time);
    patch.range.from = front > 0 ? before[front - 1].time : beginning;
    patch.range.to = back > 0 ? before[before.size() - back].time : end;
    const auto first = std::lower_bound(after.begin(), after.end(), patch.range.from,
                                        [](const Breakpoint& p, double t) { return p.time < t; });
    const auto last =
        std::upper_bound(first, after.end(), patch.range.to, [](double t, const Breakpoint& p) { return t < p.time; });
    patch.points.assign(first, last);
    return patch;
}

/// The transients that only one of two lists has become patches: the i-th that went and the i-th that came belong
/// together when equally many did (a group was moved), else each stands alone.
std::vector<EditOperation> transientsBetween(const std::vector<Transient>& before, const std::vector<Transient>& after)
{
    const auto less = [](const Transient& a, const Transient& b)
    {
        return std::tie(a.time, a.amplitude, a.sharpness) < std::tie(b.time, b.amplitude, b.sharpness);
    };
    auto old = before;
    auto now = after;
    std::sort(old.begin(), old.end(), less);
    std::sort(now.begin(), now.end(), less);
    std::vector<Transient> gone, come;
    std::set_difference(old.begin(), old.end(), now.begin(), now.end(), std::back_inserter(gone), less);
    std::set_difference(now.begin(), now.end(), old.begin(), old.end(), std::back_inserter(come), less);
    std::vector<EditOperation> patches;
    if (gone.size() == come.size())
        for (std::size_t i = 0; i < gone.size(); ++i)
            patches.push_back(TransientPatch{gone[i], come[i]});
    else
    {
        for (const Transient& event : gone)
            patches.push_back(TransientPatch{event, std::nullopt});
        for (const Transient& event : come)
            patches.push_back(TransientPatch{std::nullopt, event});
    }
    return patches;
}

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
                              if (const std::size_t k = nearest(lane.kind, frequency); k != nowhere)
                                  claim(lane.kind, k, frequency);
                          });
        }
    }

    /// The index of the lane's band, or `nowhere`.
    [[nodiscard]] std::size_t find(LaneKind kind, double frequency) const
    {
        if (kind == LaneKind::envelope || kind == LaneKind::centroid)
            return 0;
        const std::size_t k = nearest(kind, frequency);
        return k != nowhere && holders.at({kind, k}) == frequency ? k : nowhere;
    }

private:
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
            problem = "lies behind the end of the sound";
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
                problem = fmt::format("the event at {:.3f} s is no longer there", wanted);
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
                      lane.index = bands.find(lane.kind, frequency);
                      if (lane.index == nowhere)
                          missing += fmt::format("{}{:.0f} Hz", missing.empty() ? "" : ", ", frequency);
                  });
    return missing.empty() ? missing : "no band is left for what was at " + missing;
}
} // namespace

Edit anchored(EditOperation operation, const Clip& clip)
{
    Edit edit{std::move(operation), {}, clip.duration};
    std::visit(
        [&](auto& op)
        {
            if constexpr (hasScope<std::decay_t<decltype(op)>>)
                std::erase_if(op.scope.lanes, [&](const Lane& lane) { return curveOf(clip, lane) == nullptr; });
        },
        edit.operation);
    forNamedLanes(edit.operation, [&](const Lane& lane) { edit.frequencies.push_back(centreOf(clip, lane)); });
    return edit;
}

Result<Clip> applyEdit(const Clip& clip, const EditOperation& operation)
{
    auto result = std::visit(Applier{clip}, operation);
    if (!result)
        return result;
    if (auto valid = validate(*result); !valid)
        return valid.error();
    return result;
}

std::vector<EditOperation> editsBetween(const Clip& before, const Clip& after)
{
    if (!sameHead(before, after))
        return {ReplaceEdit{std::make_shared<const Clip>(after)}};
    std::vector<EditOperation> edits;
    if (before.name != after.name)
        edits.push_back(RenameEdit{after.name});
    for (const Lane& lane : lanesOf(before))
        if (const Curve& a = *curveOf(before, lane), &b = *curveOf(after, lane); a != b)
            edits.push_back(patchBetween(lane, a, b));
    if (before.transients != after.transients)
    {
        const auto patches = transientsBetween(before.transients, after.transients);
        Clip check;
        check.duration = before.duration;
        check.transients = before.transients;
        for (const EditOperation& patch : patches)
            check = withTransient(std::move(check), std::get<TransientPatch>(patch));
        // Equal times in another order: patches cannot say that.
        if (check.transients != after.transients)
            return {ReplaceEdit{std::make_shared<const Clip>(after)}};
        edits.insert(edits.end(), patches.begin(), patches.end());
    }
    if (before.markers != after.markers)
        edits.push_back(MarkersEdit{after.markers});
    return edits;
}

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
