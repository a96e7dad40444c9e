#include "support/Catch.h"
#include "support/Pinned.h"
#include "support/RandomClip.h"

#include <pacini/clip/edits/Audition.h>
#include <pacini/clip/edits/Clipboard.h>
#include <pacini/clip/edits/PointEdits.h>
#include <pacini/clip/edits/RangeEdits.h>
#include <pacini/clip/edits/TimeEdits.h>
#include <pacini/clip/edits/TransientEdits.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace pacini;

namespace
{

constexpr double editInfinity = std::numeric_limits<double>::infinity();

/// Everything of a clip that edits can change.
std::vector<double> editNumbersOf(const Clip& clip)
{
    std::vector<double> all = {clip.duration, static_cast<double>(clip.bands.size())};
    for (const Lane& lane : lanesOf(clip))
    {
        all.push_back(static_cast<double>(curveOf(clip, lane)->size()));
        const double scale = isFrequency(lane.kind) ? 1e-2 : 1.0;
        for (const Breakpoint& p : *curveOf(clip, lane))
        {
            all.push_back(p.time);
            all.push_back(scale * p.value);
        }
    }
    for (const Band& band : clip.bands)
        for (const double f : {band.lowFrequency, band.centreFrequency, band.highFrequency})
            all.push_back(1e-2 * f);
    for (const NoiseBand& band : clip.noise)
        for (const double f : {band.lowFrequency, band.highFrequency})
            all.push_back(1e-2 * f);
    for (const Transient& event : clip.transients)
        all.insert(all.end(), {event.time, event.amplitude, event.sharpness});
    for (const Marker& marker : clip.markers)
        all.push_back(marker.time);
    return all;
}

/// A clip of two seconds in which every lane has points at round times, steps among them.
Clip editedClip()
{
    Clip clip;
    clip.duration = 2.0;
    clip.name = "edited";
    clip.envelope = {{0.0, 0.0}, {0.25, 1.0}, {0.25, 0.5}, {1.0, 0.75}, {2.0, 0.25}};
    clip.centroid = {{0.5, 100.0}, {1.5, 400.0}};
    clip.bands = {{50.0, 75.0, 100.0, 1, {{0.0, 0.25}, {1.0, 0.5}, {1.5, 0.125}}, {{0.0, 60.0}, {2.0, 90.0}}},
                  {100.0, 150.0, 200.0, 0, {{0.5, 1.0}}, {}},
                  {200.0, 300.0, 400.0, 2, {}, {{1.0, 250.0}}}};
    clip.transients = {{0.0, 1.0, 0.0}, {0.5, 0.5, 1.0}, {0.5, 0.25, 0.5}, {1.25, 0.75, 0.25}, {2.0, 0.125, 0.75}};
    clip.noise = {{100.0, 500.0, {{0.0, 0.125}, {1.0, 0.25}, {2.0, 0.0}}}};
    clip.markers = {{0.0, "start"}, {1.0, "middle"}, {2.0, "end"}};
    return clip;
}

EditScope rangeOnly(TimeRange range)
{
    EditScope scope;
    scope.range = range;
    return scope;
}

void addEdit(std::vector<double>& all, const Result<Clip>& edited)
{
    REQUIRE(edited.ok());
    CHECK(validate(*edited).ok());
    const auto more = editNumbersOf(*edited);
    all.insert(all.end(), more.begin(), more.end());
}

std::string editError(const Result<Clip>& edited)
{
    REQUIRE_FALSE(edited.ok());
    CHECK(edited.error().code != ErrorCode::invalidData);
    return edited.error().where + ": " + edited.error().message;
}

} // namespace

TEST_CASE("Every edit gives the pinned clip")
{
    std::vector<std::pair<std::string, Clip>> clips = {{"small", editedClip()}};
    for (const std::uint64_t seed : {3u, 7u, 19u})
        clips.emplace_back("full " + std::to_string(seed), test::randomFullClip(seed, 10));
    for (const auto& [name, clip] : clips)
    {
        const double end = clip.duration;
        EditScope lanes;
        lanes.range = {0.125 * end, 0.875 * end};
        lanes.allLanes = false;
        lanes.lanes = {{LaneKind::envelope, 0}, {LaneKind::centroid, 0}, {LaneKind::pitch, 0}, {LaneKind::noise, 99}};
        lanes.transients = false;
        const std::vector<std::pair<std::string, EditScope>> scopes = {{"all", {}},
                                                                       {"inside", rangeOnly({0.25 * end, 0.625 * end})},
                                                                       {"backwards", rangeOnly({0.8 * end, 0.1 * end})},
                                                                       {"front", rangeOnly({-1.0, 0.5 * end})},
                                                                       {"back", rangeOnly({0.5 * end, end + 1.0})},
                                                                       {"lanes", lanes}};
        for (const auto& [part, scope] : scopes)
        {
            std::vector<double> all;
            addEdit(all, amplify(clip, scope, 3.5));
            addEdit(all, amplify(clip, scope, -200.0));
            addEdit(all, amplify(clip, scope, 300.0));
            addEdit(all, fade(clip, scope, FadeDirection::in));
            addEdit(all, fade(clip, scope, FadeDirection::out, FadeShape::smooth));
            addEdit(all, fade(clip, scope, FadeDirection::in, FadeShape::square));
            addEdit(all, invert(clip, scope));
            addEdit(all, quantiseTimes(clip, scope, {0.13 * end, 0.02, 1.0}));
            addEdit(all, quantiseTimes(clip, scope, {0.13 * end, 0.02, 0.5}));
            addEdit(all, humanise(clip, scope, {0.05, 3.0, 2.0, 5}));
            addEdit(all, humanise(clip, scope, {5.0, 50.0, 50.0, 6}));
            addEdit(all, humanise(clip, scope, {0.0, 1.0, 0.5, 7}));
            addEdit(all, thinTransients(clip, scope.range, 0.2 * end, 0.2));
            addEdit(all, trimClip(clip, scope.range));
            addEdit(all, cutClip(clip, scope.range));
            const Fragment fragment = copyFragment(clip, scope);
            addEdit(all, pasteFragment(clip, fragment, 0.3 * end));
            addEdit(all, pasteFragment(clip, fragment, 0.9 * end));
            addEdit(all, pasteFragment(clip, fragment, -5.0));
            checkPinned("clip/edits of " + name + ", " + part, all, 1e-9);
        }
        std::vector<double> whole;
        addEdit(whole, transpose(clip, 7.0));
        addEdit(whole, transpose(clip, -13.5));
        addEdit(whole, transpose(clip, 1000.0));
        addEdit(whole, transpose(clip, -1000.0));
        addEdit(whole, reverseClip(clip));
        addEdit(whole, stretchClip(clip, 1.7));
        addEdit(whole, repeatClip(clip, 3));
        addEdit(whole, insertClip(clip, 0.4 * end, editedClip()));
        addEdit(whole, joinClips(clip, editedClip()));
        addEdit(whole, joinClips(editedClip(), clip));
        Clip bare = editedClip();
        bare.envelope.clear();
        bare.centroid.clear();
        bare.noise.clear();
        addEdit(whole, joinClips(clip, bare));
        addEdit(whole, joinClips(bare, clip));
        addEdit(whole, audibleClip(clip, {{1}, {}, true, true}));
        addEdit(whole, audibleClip(clip, {{}, {0}, false, true}));
        addEdit(whole, audibleClip(clip, {{0, 1}, {1}, true, false}));
        const auto [left, right] = splitClip(clip, 0.5 * end);
        addEdit(whole, left);
        addEdit(whole, right);
        checkPinned("clip/edits of " + name + " as a whole", whole, 1e-9);
    }
}

TEST_CASE("The defaults of edits are as documented")
{
    const EditScope scope;
    CHECK(scope.range == TimeRange{0.0, 86400.0});
    CHECK(scope.allLanes);
    CHECK(scope.lanes.empty());
    CHECK(scope.transients);
    CHECK(TimeGrid{} == TimeGrid{0.1, 0.0, 1.0});
    CHECK(Humanisation{} == Humanisation{0.0, 0.0, 0.0, 0});
    CHECK(MapLines{}.step == 0.0);
    const PointMove move;
    CHECK(move.time == 0.0);
    CHECK(move.offset == 0.0);
    CHECK(move.factor == 1.0);
    CHECK(CurveLimits{}.duration == 0.0);
    CHECK(CurveLimits{}.values == ValueRange{0.0, 0.0});
    CHECK(Audition{}.transients);
    CHECK(Audition{}.noise);
    CHECK(Fragment{}.duration == 0.0);
    CHECK(Lane{} == Lane{LaneKind::envelope, 0});
    CHECK(TimeRange{} == TimeRange{0.0, 0.0});
    // Without anything asked for, humanise and quantise of strength 0 change nothing.
    const Clip clip = editedClip();
    CHECK(humanise(clip, {}, {}) == clip);
    CHECK(quantiseTimes(clip, {}, {0.3, 0.0, 0.0}) == clip);
    CHECK(quantiseTimes(clip, {}, {0.0, 0.0, 1.0}) == clip);
    CHECK(quantiseTimes(clip, {}, {-1.0, 0.0, 1.0}) == clip);
    CHECK(quantiseTimes(clip, {}, {editInfinity, 0.0, 1.0}) == clip);
    CHECK(quantiseTimes(clip, {}, {0.3, std::nan(""), 1.0}) == clip);
    CHECK(amplify(clip, {}, 0.0) == clip);
    CHECK(transpose(clip, 0.0) == clip);
    CHECK(*stretchClip(clip, 1.0) == clip);
    CHECK(*repeatClip(clip, 1) == clip);
    CHECK(*repeatClip(clip, 0) == clip);
    CHECK(*repeatClip(clip, -5) == clip);
    CHECK(fade(clip, rangeOnly({1.0, 1.0}), FadeDirection::in) == clip);
    CHECK(audibleClip(clip, {}) == clip);
}

TEST_CASE("Every lane has its curve, kind and range")
{
    Clip clip = editedClip();
    CHECK(lanesOf(clip) == std::vector<Lane>{{LaneKind::envelope, 0},
                                             {LaneKind::centroid, 0},
                                             {LaneKind::amplitude, 0},
                                             {LaneKind::pitch, 0},
                                             {LaneKind::amplitude, 1},
                                             {LaneKind::pitch, 1},
                                             {LaneKind::amplitude, 2},
                                             {LaneKind::pitch, 2},
                                             {LaneKind::noise, 0}});
    CHECK(curveOf(clip, {LaneKind::envelope, 0}) == &clip.envelope);
    CHECK(curveOf(clip, {LaneKind::centroid, 0}) == &clip.centroid);
    CHECK(curveOf(clip, {LaneKind::amplitude, 2}) == &clip.bands[2].amplitude);
    CHECK(curveOf(clip, {LaneKind::pitch, 2}) == &clip.bands[2].pitch);
    CHECK(curveOf(clip, {LaneKind::noise, 0}) == &clip.noise[0].amplitude);
    for (const LaneKind kind : {LaneKind::amplitude, LaneKind::pitch, LaneKind::noise})
        CHECK(curveOf(clip, {kind, 3}) == nullptr);
    CHECK(curveOf(clip, {LaneKind::noise, 1}) == nullptr);
    for (const LaneKind kind : {LaneKind::envelope, LaneKind::amplitude, LaneKind::noise})
    {
        CHECK_FALSE(isFrequency(kind));
        CHECK(laneRange(kind) == ValueRange{0.0, 1000.0});
    }
    CHECK(isFrequency(LaneKind::centroid));
    CHECK(isFrequency(LaneKind::pitch));
    CHECK(laneRange(LaneKind::centroid) == ValueRange{0.0, 400000.0});
    CHECK(laneRange(LaneKind::pitch) == ValueRange{1e-3, 400000.0});
    CHECK(limitsOf(clip, {LaneKind::pitch, 0}).duration == 2.0);
    CHECK(limitsOf(clip, {LaneKind::pitch, 0}).values == ValueRange{1e-3, 400000.0});
    CHECK(withinClip({1.5, 0.5}, 2.0) == TimeRange{0.5, 1.5});
    CHECK(withinClip({0.5, 1.5}, 2.0) == TimeRange{0.5, 1.5});
    CHECK(withinClip({-1.0, 9.0}, 2.0) == TimeRange{0.0, 2.0});
    CHECK(withinClip({std::nan(""), 9.0}, 2.0) == TimeRange{0.0, 2.0});
}

TEST_CASE("Values before and at a step are its two sides, and points are not repeated")
{
    const Curve curve = {{0.0, 1.0}, {1.0, 3.0}, {1.0, 7.0}, {2.0, 9.0}};
    CHECK(valueBefore({}, 1.0) == 0.0);
    CHECK(valueBefore(curve, 1.0) == 3.0);
    CHECK(valueAt(curve, 1.0) == 7.0);
    CHECK(valueBefore(curve, 0.5) == 2.0);
    CHECK(valueBefore(curve, 0.0) == 1.0);
    CHECK(valueBefore(curve, 2.0) == 9.0);
    CHECK(valueBefore(curve, 3.0) == 9.0);
    CHECK(valueBefore(curve, -1.0) == 1.0);
    Curve built;
    for (const Breakpoint p : {Breakpoint{0.0, 1.0},
                               {0.0, 1.0},
                               {0.0, 2.0},
                               {0.0, 3.0},
                               {1.0, 3.0},
                               {1.0, 3.0},
                               {1.0, 4.0},
                               {1.0, 3.0},
                               {2.0, 3.0}})
        appendPoint(built, p);
    CHECK(built == Curve{{0.0, 1.0}, {0.0, 3.0}, {1.0, 3.0}, {2.0, 3.0}});
    CHECK(curveSection({}, {0.0, 1.0}).empty());
    CHECK(curveSection(curve, {0.5, 1.5}) == Curve{{0.0, 2.0}, {0.5, 3.0}, {0.5, 7.0}, {1.0, 8.0}});
    CHECK(curveSection(curve, {1.0, 2.0}) == Curve{{0.0, 7.0}, {1.0, 9.0}});
    CHECK(curveSection(curve, {0.0, 1.0}) == Curve{{0.0, 1.0}, {1.0, 3.0}});
    CHECK(curveSection(curve, {0.25, 0.75}) == Curve{{0.0, 1.5}, {0.5, 2.5}});
    CHECK(curveSection(curve, {1.0, 1.0}) == Curve{{0.0, 7.0}, {0.0, 3.0}});
    Curve joined = {{0.0, 1.0}, {1.0, 2.0}};
    appendCurve(joined, {{0.0, 5.0}, {0.0, 6.0}, {1.0, 7.0}, {1.0, 8.0}, {1.0, 9.0}}, 1.0);
    CHECK(joined == Curve{{0.0, 1.0}, {1.0, 2.0}, {1.0, 6.0}, {2.0, 7.0}, {2.0, 8.0}, {2.0, 9.0}});
    CHECK(replaceSection(curve, {1.0, 1.0}, {{1.0, 5.0}}) == Curve{{0.0, 1.0}, {1.0, 5.0}, {2.0, 9.0}});
    CHECK(replaceSection(curve, {0.5, 1.5}, {}) == Curve{{0.0, 1.0}, {2.0, 9.0}});
    CHECK(replaceSection(curve, {0.0, 2.0}, {{1.0, 5.0}}) == Curve{{1.0, 5.0}});
    Curve cut = curve;
    cutAfter(cut, 2.0);
    CHECK(cut == curve);
    cutAfter(cut, 1.5);
    CHECK(cut == Curve{{0.0, 1.0}, {1.0, 3.0}, {1.0, 7.0}, {1.5, 8.0}});
    cutAfter(cut, 1.0);
    CHECK(cut == Curve{{0.0, 1.0}, {1.0, 7.0}});
    cutAfter(cut, -1.0);
    CHECK(cut == Curve{{-1.0, 1.0}});
    Curve none;
    cutAfter(none, 1.0);
    CHECK(none.empty());
}

TEST_CASE("Mapped values change inside the range alone, with steps where it ends inside the clip")
{
    const Curve curve = {{0.0, 1.0}, {2.0, 3.0}, {4.0, 1.0}};
    const auto twice = [](const Breakpoint& p)
    {
        return 2.0 * p.value;
    };
    CHECK(mapValues({}, {0.0, 4.0}, 4.0, {}, twice).empty());
    CHECK(mapValues(curve, {0.0, 4.0}, 4.0, {}, twice) == Curve{{0.0, 2.0}, {2.0, 6.0}, {4.0, 2.0}});
    CHECK(mapValues(curve, {1.0, 3.0}, 4.0, {}, twice) ==
          Curve{{0.0, 1.0}, {1.0, 2.0}, {1.0, 4.0}, {2.0, 6.0}, {3.0, 4.0}, {3.0, 2.0}, {4.0, 1.0}});
    CHECK(mapValues(curve, {2.0, 4.0}, 4.0, {}, twice) == Curve{{0.0, 1.0}, {2.0, 3.0}, {2.0, 6.0}, {4.0, 2.0}});
    CHECK(mapValues(curve, {0.0, 2.0}, 4.0, {}, twice) == Curve{{0.0, 2.0}, {2.0, 6.0}, {2.0, 3.0}, {4.0, 1.0}});
    CHECK(mapValues(curve, {1.0, 1.0}, 4.0, {}, twice) == Curve{{0.0, 1.0}, {1.0, 2.0}, {2.0, 3.0}, {4.0, 1.0}});
    // Lines are split into equal pieces that are no longer than the step.
    CHECK(mapValues(curve, {0.0, 4.0}, 4.0, {1.0}, twice) ==
          Curve{{0.0, 2.0}, {1.0, 4.0}, {2.0, 6.0}, {3.0, 4.0}, {4.0, 2.0}});
    CHECK(mapValues(curve, {0.0, 4.0}, 4.0, {1.5}, twice) ==
          Curve{{0.0, 2.0}, {1.0, 4.0}, {2.0, 6.0}, {3.0, 4.0}, {4.0, 2.0}});
    CHECK(mapValues(curve, {0.0, 4.0}, 4.0, {2.0}, twice) == Curve{{0.0, 2.0}, {2.0, 6.0}, {4.0, 2.0}});
    const Curve middle = {{1.0, 1.0}};
    CHECK(mapValues(middle, {0.0, 2.0}, 2.0, {}, twice) == Curve{{1.0, 2.0}});
    CHECK(mapValues(middle, {0.0, 2.0}, 2.0, {1.0}, twice) == Curve{{0.0, 2.0}, {1.0, 2.0}, {2.0, 2.0}});
}

TEST_CASE("Marquees hold their edges, and selections are united and toggled")
{
    const Curve curve = {{0.0, 1.0}, {1.0, 2.0}, {1.0, 3.0}, {2.0, 2.0}};
    CHECK(pointsInside(curve, {1.0, 2.0}, {2.0, 3.0}) == Indices{1, 2, 3});
    CHECK(pointsInside(curve, {0.0, 1.0}, {1.0, 2.0}) == Indices{0, 1});
    CHECK(pointsInside(curve, {0.5, 0.9}, {0.0, 9.0}).empty());
    CHECK(pointsInside(curve, {0.0, 9.0}, {2.5, 2.9}).empty());
    const Clip clip = editedClip();
    CHECK(transientsInside(clip, {0.5, 1.25}, {0.25, 0.75}) == Indices{1, 2, 3});
    CHECK(transientsInside(clip, {0.51, 1.24}, {0.0, 9.0}).empty());
    CHECK(transientsInside(clip, {0.0, 2.0}, {0.26, 0.74}) == Indices{1});
    CHECK(allIndices(3) == Indices{0, 1, 2});
    CHECK(allIndices(0).empty());
    CHECK(unionOf({0, 2}, {1, 2}) == Indices{0, 1, 2});
    CHECK(toggled({0, 2}, {1, 2}) == Indices{0, 1});
}

TEST_CASE("Points are added behind those at their time, removed by index, and limited to their lane")
{
    const Curve curve = {{0.0, 1.0}, {1.0, 2.0}, {1.0, 3.0}, {2.0, 2.0}};
    const CurveLimits limits{2.0, {0.5, 4.0}};
    const EditedCurve added = addPoint(curve, {1.0, 9.0}, limits);
    CHECK(added.curve == Curve{{0.0, 1.0}, {1.0, 2.0}, {1.0, 3.0}, {1.0, 4.0}, {2.0, 2.0}});
    CHECK(added.selection == Indices{3});
    CHECK(addPoint(curve, {-1.0, 0.0}, limits).curve[1] == Breakpoint{0.0, 0.5});
    CHECK(addPoint(curve, {9.0, 1.0}, limits).curve[4] == Breakpoint{2.0, 1.0});
    for (const Breakpoint bad : {Breakpoint{std::nan(""), 1.0}, {1.0, std::nan("")}, {editInfinity, 1.0}})
    {
        CHECK(addPoint(curve, bad, limits).curve == curve);
        CHECK(addPoint(curve, bad, limits).selection.empty());
    }
    CHECK(deletePoints(curve, {1, 3}) == Curve{{0.0, 1.0}, {1.0, 3.0}});
    CHECK(deletePoints(curve, {}) == curve);
    CHECK(deletePoints(curve, {0, 1, 2, 3, 9}).empty());
    const EditedCurve moved = movePoints(curve, {0, 9}, {1.5, 0.25, 2.0}, limits);
    CHECK(moved.curve == Curve{{1.0, 2.0}, {1.0, 3.0}, {1.5, 2.25}, {2.0, 2.0}});
    CHECK(moved.selection == Indices{2});
    CHECK(movePoints(curve, {1, 2}, {9.0, 0.0, 1.0}, limits).curve ==
          Curve{{0.0, 1.0}, {2.0, 2.0}, {2.0, 3.0}, {2.0, 2.0}});
    CHECK(movePoints(curve, {1, 2}, {-9.0, 0.0, 1.0}, limits).curve ==
          Curve{{0.0, 1.0}, {0.0, 2.0}, {0.0, 3.0}, {2.0, 2.0}});
    CHECK(movePoints(curve, {1}, {0.0, 1.0, -3.0}, limits).curve[1].value == 1.0); // a factor below 0 is 0
    CHECK(movePoints(curve, {1}, {0.0, 9.0, 1.0}, limits).curve[1].value == 4.0);
    CHECK(movePoints(curve, {7, 9}, {1.0, 1.0, 1.0}, limits).selection.empty());
    // The group keeps its shape at the end.
    CHECK(movePoints({{0.25, 1.0}, {1.75, 2.0}}, {0, 1}, {9.0, 0.0, 1.0}, limits).curve ==
          Curve{{0.5, 1.0}, {2.0, 2.0}});
    for (const PointMove bad : {PointMove{std::nan(""), 0.0, 1.0}, {0.0, std::nan(""), 1.0}, {0.0, 0.0, std::nan("")}})
    {
        CHECK(movePoints(curve, {1, 9}, bad, limits).curve == curve);
        CHECK(movePoints(curve, {1, 9}, bad, limits).selection == Indices{1});
    }
}

TEST_CASE("Transients are added behind those at their time, limited, removed and thinned")
{
    const Clip clip = editedClip();
    const Clip added = addTransient(clip, {0.5, 2000.0, 7.0});
    REQUIRE(added.transients.size() == 6);
    CHECK(added.transients[3] == Transient{0.5, 1000.0, 1.0});
    CHECK(addTransient(clip, {-1.0, -1.0, -1.0}).transients[1] == Transient{0.0, 0.0, 0.0});
    CHECK(addTransient(clip, {9.0, 1.0, 1.0}).transients[5] == Transient{2.0, 1.0, 1.0});
    CHECK(addTransient(clip, {std::nan(""), 1.0, 1.0}) == clip);
    CHECK(addTransient(clip, {1.0, editInfinity, 1.0}) == clip);
    CHECK(addTransient(clip, {1.0, 1.0, std::nan("")}) == clip);
    CHECK(deleteTransients(clip, {0, 2, 9}).transients.size() == 3);
    CHECK(deleteTransients(clip, {0, 2, 9}).transients[0].sharpness == 1.0);
    const auto times = [](const Clip& thinned)
    {
        std::vector<double> all;
        for (const Transient& event : thinned.transients)
            all.push_back(event.time + event.amplitude);
        return all;
    };
    CHECK(times(thinTransients(clip, {0.0, 2.0}, 0.0)) == times(clip)); // two at one time are not closer than 0
    CHECK(times(thinTransients(clip, {0.0, 2.0}, 1e-9)) == std::vector{1.0, 1.0, 2.0, 2.125});
    CHECK(times(thinTransients(clip, {0.0, 2.0}, 0.5)) == std::vector{1.0, 1.0, 2.0, 2.125});
    CHECK(times(thinTransients(clip, {0.0, 2.0}, 0.51)) == std::vector{1.0, 2.0, 2.125});
    CHECK(times(thinTransients(clip, {0.0, 2.0}, 0.76)) == std::vector{1.0, 2.0});
    CHECK(times(thinTransients(clip, {0.5, 2.0}, 0.76)) == std::vector{1.0, 2.0}); // 0.5 lies within 0.75 of 1.25
    CHECK(times(thinTransients(clip, {0.25, 1.0}, 9.0)) == std::vector{1.0, 1.0, 2.0, 2.125});
    CHECK(times(thinTransients(clip, {0.0, 2.0}, 0.0, 0.25)) == std::vector{1.0, 1.0, 0.75, 2.0});
    CHECK(times(thinTransients(clip, {0.0, 2.0}, 0.0, 0.26)) == std::vector{1.0, 1.0, 2.0});
    Clip equal = clip;
    for (Transient& event : equal.transients)
        event.amplitude = 0.5;
    CHECK(thinTransients(equal, {0.0, 2.0}, 9.0).transients == std::vector<Transient>{{0.0, 0.5, 0.0}});
}

TEST_CASE("Edits that would make a clip too long or too large say so")
{
    Clip clip = editedClip();
    clip.duration = 43200.0;
    CHECK(joinClips(clip, clip).ok());
    CHECK(repeatClip(clip, 2).ok());
    CHECK(editError(repeatClip(clip, 3)) == "duration: would be longer than 24 hours");
    CHECK(stretchClip(clip, 2.0).ok());
    CHECK(editError(stretchClip(clip, 2.0001)) == "duration: would be longer than 24 hours");
    CHECK(editError(joinClips(clip, *stretchClip(clip, 1.0001))) == "duration: would be longer than 24 hours");
    CHECK(stretchClip(editedClip(), 0.0)->duration == 2.0 * 0.01);
    CHECK(stretchClip(editedClip(), 1e9)->duration == 200.0);
    CHECK(joinClips(clip, Clip{}).value() == clip);
    Clip many, others;
    many.duration = others.duration = 1.0;
    for (int k = 0; k < 200; ++k)
        many.bands.push_back({100.0 + k, 200.0 + k, 300.0 + k, 0, {}, {}});
    for (int k = 0; k < 56; ++k)
        others.bands.push_back({1000.0 + k, 2000.0 + k, 3000.0 + k, 0, {}, {}});
    CHECK(joinClips(many, others)->bands.size() == 256);
    others.bands.push_back({5000.0, 6000.0, 7000.0, 0, {}, {}});
    CHECK(editError(joinClips(many, others)) == "bands: would be more than 256");
    CHECK(joinClips(many, many)->bands.size() == 200);
    // 2 curves of 12 500 points, 2000 times: exactly 50 million.
    Clip dense;
    dense.duration = 1.0;
    for (int i = 0; i <= 25000; ++i)
        dense.envelope.push_back({i / 25000.0, 0.5});
    CHECK(editError(repeatClip(dense, 2000)) == ": would have more than 50 million points");
    const Fragment::LanePart part{{LaneKind::envelope, 0}, {{0.0, 1.0}}};
    CHECK(editError(pasteCurve(clip, {LaneKind::noise, 5}, part, 0.0)) == "lane: is not in the clip");
    CHECK(editError(pasteCurve(clip, {LaneKind::pitch, 0}, part, 0.0)) ==
          "lane: frequencies cannot replace amplitudes, nor amplitudes frequencies");
    CHECK(*pasteCurve(clip, {LaneKind::envelope, 0}, {{LaneKind::envelope, 0}, {}}, 0.0) == clip);
    CHECK(pasteCurve(clip, {LaneKind::noise, 0}, part, 0.0).ok());
}

TEST_CASE("What is pasted replaces its length, up to the clip's end")
{
    const Clip clip = editedClip();
    const Fragment::LanePart part{{LaneKind::amplitude, 0}, {{0.0, 0.25}, {0.5, 2000.0}}};
    const auto pasted = [&](LaneKind kind, std::size_t index, double time)
    {
        const auto result = pasteCurve(clip, {kind, index}, part, time);
        REQUIRE(result.ok());
        return *curveOf(*result, {kind, index});
    };
    CHECK(pasted(LaneKind::noise, 0, 0.5) ==
          Curve{{0.0, 0.125}, {0.5, 0.1875}, {0.5, 0.25}, {1.0, 1000.0}, {1.0, 0.25}, {2.0, 0.0}});
    CHECK(pasted(LaneKind::noise, 0, 0.0) == Curve{{0.0, 0.25}, {0.5, 1000.0}, {0.5, 0.1875}, {1.0, 0.25}, {2.0, 0.0}});
    CHECK(pasted(LaneKind::noise, 0, 1.5) ==
          Curve{{0.0, 0.125}, {1.0, 0.25}, {1.5, 0.125}, {1.5, 0.25}, {2.0, 1000.0}});
    CHECK(pasted(LaneKind::noise, 0, 1.75).back().time == 2.0);
    CHECK(pasted(LaneKind::noise, 0, 1.75).back().value == Approx(0.5 * (0.25 + 1000.0)));
    CHECK(pasted(LaneKind::amplitude, 2, 0.5) == Curve{{0.5, 0.25}, {1.0, 1000.0}});
    const Fragment fragment = copyFragment(clip, {{0.5, 1.25}, true, {}, true});
    CHECK(fragment.duration == 0.75);
    CHECK(fragment.lanes.size() == 7); // the empty pitch and amplitude are left out
    CHECK(fragment.transients == std::vector<Transient>{{0.0, 0.5, 1.0}, {0.0, 0.25, 0.5}});
    CHECK(copyFragment(clip, {{0.5, 1.25}, true, {}, false}).transients.empty());
    CHECK(copyFragment(clip, {{0.5, 2.0}, true, {}, true}).transients.size() == 4);
    CHECK(copyFragment(clip, {{0.5, 1.25}, false, {{LaneKind::noise, 0}}, false}).lanes ==
          std::vector<Fragment::LanePart>{{{LaneKind::noise, 0}, {{0.0, 0.1875}, {0.5, 0.25}, {0.75, 0.1875}}}});
    // Transients over the fragment's length, both ends included, make room for those that it carries.
    Fragment events;
    events.duration = 0.75;
    events.transients = {{0.25, 0.5, 0.5}, {0.75, 1.0, 0.5}};
    const auto replaced = pasteFragment(clip, events, 0.5);
    REQUIRE(replaced.ok());
    CHECK(replaced->transients ==
          std::vector<Transient>{{0.0, 1.0, 0.0}, {0.75, 0.5, 0.5}, {1.25, 1.0, 0.5}, {2.0, 0.125, 0.75}});
    const auto late = pasteFragment(clip, events, 1.5);
    REQUIRE(late.ok());
    CHECK(late->transients.size() == 5); // the last one of the clip goes, the second of the fragment has no room
    CHECK(late->transients.back() == Transient{1.75, 0.5, 0.5});
}

TEST_CASE("A part of a clip has the events of its time, and its last ones only where the clip ends")
{
    const Clip clip = editedClip();
    const Clip part = trimClip(clip, {0.5, 1.25});
    CHECK(part.duration == 0.75);
    CHECK(part.transients == std::vector<Transient>{{0.0, 0.5, 1.0}, {0.0, 0.25, 0.5}});
    CHECK(part.markers == std::vector<Marker>{{0.5, "middle"}});
    CHECK(trimClip(clip, {1.0, 2.0}).markers == std::vector<Marker>{{0.0, "middle"}, {1.0, "end"}});
    CHECK(trimClip(clip, {0.0, 1.0}).markers == std::vector<Marker>{{0.0, "start"}});
    const auto [all, nothing] = splitClip(clip, 2.0);
    CHECK(all.duration == 2.0);
    CHECK(all.transients == clip.transients);
    CHECK(all.markers == clip.markers);
    CHECK(nothing.duration == 0.0);
    CHECK(nothing.transients.empty());
    CHECK(nothing.markers.empty());
    const auto [none, whole] = splitClip(clip, 0.0);
    CHECK(none.duration == 0.0);
    CHECK(whole.duration == 2.0);
    CHECK(whole.transients == clip.transients);
    CHECK(reverseClip(clip).markers == std::vector<Marker>{{0.0, "end"}, {1.0, "middle"}, {2.0, "start"}});
    // Times may lie a microsecond behind the end: they end up on it.
    Clip late = clip;
    late.transients.back().time = late.markers.back().time = late.envelope.back().time = 2.0 + 0.9e-6;
    REQUIRE(validate(late).ok());
    CHECK(reverseClip(late).transients.front().time == 0.0);
    CHECK(stretchClip(late, 2.0)->transients.back().time == 4.0);
    CHECK(stretchClip(late, 2.0)->envelope.back().time == 4.0);
    CHECK(trimClip(late, {0.0, 2.0}).markers.back().time == 2.0);
    CHECK(validate(*joinClips(late, late)).ok());
    CHECK(joinClips(late, clip)->transients[4].time == 2.0);
    CHECK(joinClips(clip, late)->envelope.back().time == 4.0);
    // Bands are the same ones where all three frequencies are.
    for (double Band::*frequency : {&Band::lowFrequency, &Band::centreFrequency, &Band::highFrequency})
    {
        Clip other = clip;
        other.bands[1].*frequency += 0.5;
        CHECK(joinClips(clip, other)->bands.size() == 4);
    }
    for (double NoiseBand::*frequency : {&NoiseBand::lowFrequency, &NoiseBand::highFrequency})
    {
        Clip other = clip;
        other.noise[0].*frequency += 0.5;
        CHECK(joinClips(clip, other)->noise.size() == 2);
    }
    CHECK(joinClips(clip, clip)->bands.size() == 3);
    CHECK(joinClips(clip, clip)->noise.size() == 1);
}
