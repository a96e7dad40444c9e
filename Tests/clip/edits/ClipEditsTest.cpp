#include "support/Catch.h"
#include "support/RandomClip.h"
#include "support/RandomEdits.h"

#include <pacini/clip/edits/Audition.h>
#include <pacini/clip/edits/Clipboard.h>
#include <pacini/clip/edits/PointEdits.h>
#include <pacini/clip/edits/RangeEdits.h>
#include <pacini/clip/edits/TimeEdits.h>
#include <pacini/clip/edits/TransientEdits.h>
#include <pacini/simplify/SimplifyLanes.h>

#include <cmath>
#include <limits>

using namespace pacini;

TEST_CASE("Every edit of a valid clip gives a valid clip, whatever the arguments")
{
    for (std::uint64_t seed = 1; seed <= 60; ++seed)
    {
        Random random(seed);
        Clip clip = test::randomFullClip(seed, 12);
        for (int step = 0; step < 60; ++step)
        {
            auto edited = test::anyEdit(random, clip);
            if (!edited)
                continue;
            const auto valid = validate(*edited);
            INFO("seed " << seed << ", step " << step << (valid ? "" : ": " + valid.error().text()));
            REQUIRE(valid.ok());
            if (breakpointCount(*edited) < 20000)
                clip = std::move(edited).value();
        }
    }
}

TEST_CASE("An edit of a range leaves what is outside as it was")
{
    for (std::uint64_t seed = 1; seed <= 30; ++seed)
    {
        const Clip clip = test::randomFullClip(seed);
        EditScope scope;
        scope.range = {0.3 * clip.duration, 0.6 * clip.duration};
        for (const Clip& edited :
             {amplify(clip, scope, -6.0), fade(clip, scope, FadeDirection::out), invert(clip, scope)})
            for (const Lane& lane : lanesOf(clip))
                for (int i = 0; i <= 200; ++i)
                {
                    const double t = clip.duration * i / 200.0;
                    if (t > scope.range.from - 1e-9 && t < scope.range.to + 1e-9)
                        continue;
                    INFO("seed " << seed << ", time " << t);
                    CHECK(valueAt(*curveOf(edited, lane), t) ==
                          Approx(valueAt(*curveOf(clip, lane), t)).epsilon(1e-9).margin(1e-9));
                }
    }
}

TEST_CASE("Gain scales amplitudes inside its range and no frequencies")
{
    const Clip clip = test::randomFullClip(3);
    EditScope scope;
    scope.range = {0.2 * clip.duration, 0.7 * clip.duration};
    const Clip louder = amplify(clip, scope, 6.0);
    for (const Lane& lane : lanesOf(clip))
        for (int i = 41; i < 140; ++i)
        {
            const double t = clip.duration * i / 200.0;
            const double before = valueAt(*curveOf(clip, lane), t);
            const double expected = isFrequency(lane.kind) ? before : 1.9952623149688795 * before;
            CHECK(valueAt(*curveOf(louder, lane), t) == Approx(expected).epsilon(1e-9).margin(1e-12));
        }
}

TEST_CASE("A fade-in is silent at its start, full at its end and close to its law between")
{
    Clip clip;
    clip.duration = 2.0;
    clip.envelope = {{0.0, 1.0}, {0.7, 0.2}, {2.0, 0.9}};
    EditScope scope;
    scope.range = {0.5, 1.5};
    for (const FadeShape shape : {FadeShape::linear, FadeShape::smooth, FadeShape::square})
    {
        const Clip faded = fade(clip, scope, FadeDirection::in, shape);
        CHECK(valueAt(faded.envelope, 0.5) == 0.0);
        CHECK(valueAt(faded.envelope, 1.5) == Approx(valueAt(clip.envelope, 1.5)));
        for (double t = 0.5; t < 1.5; t += 0.003)
        {
            const double x = t - 0.5;
            const double law = shape == FadeShape::linear   ? x
                               : shape == FadeShape::square ? x * x
                                                            : std::pow(std::sin(0.5 * 3.14159265358979 * x), 2.0);
            CHECK(std::abs(valueAt(faded.envelope, t) - law * valueAt(clip.envelope, t)) < 1.5e-3);
        }
    }
}

TEST_CASE("What is split and joined again sounds the same at every time")
{
    for (std::uint64_t seed = 1; seed <= 40; ++seed)
    {
        const Clip clip = test::randomFullClip(seed);
        const auto [left, right] = splitClip(clip, 0.37 * clip.duration);
        CHECK(left.duration + right.duration == Approx(clip.duration));
        const auto whole = joinClips(left, right);
        REQUIRE(whole);
        CHECK(whole->transients.size() == clip.transients.size());
        CHECK(whole->markers.size() == clip.markers.size());
        for (const Lane& lane : lanesOf(clip))
            for (int i = 0; i <= 100; ++i)
            {
                const double t = clip.duration * (i + 0.5) / 101.0;
                CHECK(valueAt(*curveOf(*whole, lane), t) ==
                      Approx(valueAt(*curveOf(clip, lane), t)).epsilon(1e-6).margin(1e-9));
            }
    }
}

TEST_CASE("Reversing twice gives the clip back up to rounding")
{
    const Clip clip = test::randomFullClip(8);
    const Clip twice = reverseClip(reverseClip(clip));
    REQUIRE(twice.transients.size() == clip.transients.size());
    for (const Lane& lane : lanesOf(clip))
    {
        const Curve& a = *curveOf(clip, lane);
        const Curve& b = *curveOf(twice, lane);
        REQUIRE(a.size() == b.size());
        for (std::size_t i = 0; i < a.size(); ++i)
        {
            CHECK(b[i].time == Approx(a[i].time).margin(1e-12));
            CHECK(b[i].value == a[i].value);
        }
    }
}

TEST_CASE("Joining clips of different bands keeps both, each silent during the other")
{
    Clip a;
    a.duration = 1.0;
    a.bands = {{50.0, 60.0, 70.0, 0, {{0.0, 0.5}, {1.0, 0.5}}, {}}};
    Clip b;
    b.duration = 2.0;
    b.bands = {{100.0, 120.0, 140.0, 0, {{0.0, 0.25}}, {{0.0, 110.0}}}};
    const auto both = joinClips(a, b);
    REQUIRE(both);
    REQUIRE(both->bands.size() == 2);
    CHECK(valueAt(both->bands[0].amplitude, 0.5) == 0.5);
    CHECK(valueAt(both->bands[0].amplitude, 1.5) == 0.0);
    CHECK(valueAt(both->bands[1].amplitude, 0.5) == 0.0);
    CHECK(valueAt(both->bands[1].amplitude, 1.5) == 0.25);
    CHECK(valueAt(both->bands[1].pitch, 0.5) == 120.0);
    CHECK(valueAt(both->bands[1].pitch, 1.5) == 110.0);
}

TEST_CASE("Clips that would become too long or too large are refused")
{
    Clip day;
    day.duration = limits::duration;
    CHECK(joinClips(day, day).error().code == ErrorCode::tooLarge);
    CHECK(repeatClip(day, 2).error().code == ErrorCode::tooLarge);
    CHECK(stretchClip(day, 1.1).error().code == ErrorCode::tooLarge);
    Clip many = test::randomFullClip(1);
    many.bands.resize(200, {1.0, 2.0, 3.0, 0, {}, {}});
    Clip others = many;
    for (Band& band : others.bands)
        band.highFrequency += 1.0;
    CHECK(joinClips(many, others).error().where == "bands");
}

TEST_CASE("Points move together, stop together at the clip's ends and may pass others")
{
    const Curve curve = {{0.1, 1.0}, {0.2, 2.0}, {0.5, 3.0}, {0.9, 4.0}};
    const CurveLimits limits{1.0, {0.0, 10.0}};
    const auto early = movePoints(curve, {0, 1}, {-5.0, 0.0, 1.0}, limits);
    CHECK(early.curve[0].time == 0.0);
    CHECK(early.curve[1].time == Approx(0.1));
    const auto passed = movePoints(curve, {1}, {0.5, 1.0, 2.0}, limits);
    CHECK(passed.curve == Curve{{0.1, 1.0}, {0.5, 3.0}, {0.7, 5.0}, {0.9, 4.0}});
    CHECK(passed.selection == Indices{2});
}

TEST_CASE("Thinning keeps the strongest events and leaves no two closer than the gap")
{
    for (std::uint64_t seed = 1; seed <= 50; ++seed)
    {
        Random random(seed);
        Clip clip;
        clip.duration = 1.0;
        for (int i = 0; i < 60; ++i)
            clip = addTransient(clip, {random.uniform(), random.uniform(), 0.5});
        const double gap = random.uniform(0.001, 0.2);
        const Clip thin = thinTransients(clip, {0.0, 1.0}, gap);
        for (std::size_t i = 1; i < thin.transients.size(); ++i)
            CHECK(thin.transients[i].time - thin.transients[i - 1].time >= gap);
        // Each event that went had a stronger one nearby that stayed.
        for (const Transient& event : clip.transients)
        {
            bool explained = false;
            for (const Transient& kept : thin.transients)
                explained = explained || kept == event ||
                            (std::abs(kept.time - event.time) < gap && kept.amplitude >= event.amplitude);
            CHECK(explained);
        }
    }
}

TEST_CASE("Thinning drops what is too weak inside the range, and nothing outside")
{
    Clip clip;
    clip.duration = 1.0;
    clip.transients = {{0.1, 0.05, 0.5}, {0.3, 0.05, 0.5}, {0.305, 0.2, 0.5}, {0.5, 0.1, 0.5}, {0.9, 0.01, 0.5}};
    const Clip thin = thinTransients(clip, {0.2, 0.8}, 0.0, 0.1);
    CHECK(thin.transients ==
          std::vector<Transient>{clip.transients[0], clip.transients[2], clip.transients[3], clip.transients[4]});
    // What is too weak keeps nothing away.
    CHECK(thinTransients(clip, {0.0, 1.0}, 0.3, 0.06).transients == std::vector<Transient>{clip.transients[2]});
}

TEST_CASE("Humanise is the same for a seed, another for another, and stays within its amounts")
{
    const Clip clip = test::randomFullClip(11);
    const Humanisation amount{0.01, 3.0, 1.0, 42};
    const Clip once = humanise(clip, {}, amount);
    CHECK(once == humanise(clip, {}, amount));
    Humanisation other = amount;
    other.seed = 43;
    CHECK_FALSE(once == humanise(clip, {}, other));
    CHECK(humanise(clip, {}, {}) == clip);
    for (const Lane& lane : lanesOf(clip))
        for (std::size_t i = 0; i < curveOf(clip, lane)->size(); ++i)
        {
            const Breakpoint a = (*curveOf(clip, lane))[i];
            const Breakpoint b = (*curveOf(once, lane))[i];
            CHECK(std::abs(a.time - b.time) <= 0.0100001);
            const double most = isFrequency(lane.kind) ? 1.0595 : 1.4126;
            CHECK(b.value <= a.value * most);
            CHECK(b.value >= a.value / most);
        }
}

TEST_CASE("Quantised events lie on the grid")
{
    const Clip clip = test::randomFullClip(11);
    const Clip even = quantiseTimes(clip, {}, {0.25, 0.1, 1.0});
    REQUIRE(!even.transients.empty());
    for (const Transient& event : even.transients)
    {
        const double lines = (event.time - 0.1) / 0.25;
        const bool atEnd = event.time == 0.0 || event.time == clip.duration;
        CHECK((atEnd || std::abs(lines - std::round(lines)) < 1e-9));
    }
}

TEST_CASE("What is copied and pasted at its own place changes nothing that is heard")
{
    const Clip clip = test::randomFullClip(5);
    EditScope scope;
    scope.range = {0.2 * clip.duration, 0.5 * clip.duration};
    const auto same = pasteFragment(clip, copyFragment(clip, scope), scope.range.from);
    REQUIRE(same);
    for (const Lane& lane : lanesOf(clip))
        for (int i = 0; i < 300; ++i)
        {
            const double t = clip.duration * (i + 0.5) / 300.0;
            CHECK(valueAt(*curveOf(*same, lane), t) ==
                  Approx(valueAt(*curveOf(clip, lane), t)).epsilon(1e-6).margin(1e-9));
        }
    const Fragment fragment = copyFragment(clip, {{0.0, 1.0}, false, {{LaneKind::envelope, 0}}, false});
    if (!fragment.lanes.empty())
        CHECK_FALSE(pasteCurve(clip, {LaneKind::centroid, 0}, fragment.lanes[0], 0.0));
}

TEST_CASE("What is pasted stands in its place alone, and the curve goes on behind it as before")
{
    Clip clip;
    clip.duration = 1.0;
    clip.envelope = {{0.0, 0.0}, {1.0, 1.0}};
    const Lane lane{LaneKind::envelope, 0};
    const Fragment::LanePart part{lane, {{0.0, 0.9}, {0.1, 0.7}, {0.2, 0.9}}};
    for (const double at : {0.0, 0.3, 0.8, 0.95})
    {
        const auto pasted = pasteCurve(clip, lane, part, at);
        REQUIRE(pasted);
        for (int i = 0; i < 200; ++i)
        {
            const double t = (i + 0.5) / 200.0;
            CAPTURE(at, t);
            const double expected = t < at || t > at + 0.2 ? t : valueAt(part.curve, t - at);
            CHECK(valueAt(pasted->envelope, t) == Approx(expected));
        }
    }
    clip.envelope.clear();
    const auto onto = pasteCurve(clip, lane, part, 0.5);
    REQUIRE(onto);
    CHECK(onto->envelope.front().time == 0.5);
    CHECK(onto->envelope.back().time == Approx(0.7));
}

TEST_CASE("A fade-out is the fade-in the other way round")
{
    Clip clip;
    clip.duration = 2.0;
    clip.envelope = {{0.0, 0.8}};
    clip.transients = {{0.7, 0.8, 0.5}};
    for (const FadeShape shape : {FadeShape::linear, FadeShape::smooth, FadeShape::square})
    {
        EditScope scope;
        scope.range = {0.5, 1.3};
        const Clip out = fade(clip, scope, FadeDirection::out, shape);
        const Clip in = fade(clip, scope, FadeDirection::in, shape);
        for (int i = 1; i < 64; ++i)
            CHECK(valueAt(out.envelope, 1.3 - i / 80.0) == Approx(valueAt(in.envelope, 0.5 + i / 80.0)));
        CHECK(valueAt(out.envelope, 0.5) == Approx(0.8));
        CHECK(out.transients[0].amplitude == Approx(0.8 * fadeGain(shape, 0.75)));
        CHECK(in.transients[0].amplitude == Approx(0.8 * fadeGain(shape, 0.25)));
    }
}

TEST_CASE("Turned upside down, amplitudes go about half of full drive and frequencies about their mean")
{
    Clip clip;
    clip.duration = 3.0;
    clip.envelope = {{0.0, 0.3}, {1.0, 0.1}, {1.5, 0.9}, {1.7, 1.2}, {3.0, 0.5}};
    clip.centroid = {{0.0, 50.0}, {1.0, 100.0}, {1.5, 400.0}, {3.0, 900.0}};
    clip.transients = {{0.5, 0.8, 0.3}, {1.2, 0.8, 0.3}};
    EditScope scope;
    scope.range = {0.9, 2.0};
    const Clip turned = invert(clip, scope);
    CHECK(valueAt(turned.envelope, 0.5) == Approx(0.2));
    CHECK(valueAt(turned.envelope, 1.0) == Approx(0.9));
    CHECK(valueAt(turned.envelope, 1.25) == Approx(0.5));
    CHECK(valueAt(turned.envelope, 1.5) == Approx(0.1));
    CHECK(valueAt(turned.envelope, 1.7) == 0.0);
    CHECK(valueAt(turned.envelope, 3.0) == Approx(0.5));
    // 100 to 400 Hz are what the range holds: their geometric mean is 200 Hz.
    CHECK(valueAt(turned.centroid, 0.5) == Approx(75.0));
    CHECK(valueAt(turned.centroid, 0.9) == Approx(40000.0 / 95.0));
    CHECK(valueAt(turned.centroid, 1.0) == Approx(400.0));
    CHECK(valueAt(turned.centroid, 1.5) == Approx(100.0));
    CHECK(valueAt(turned.centroid, 3.0) == Approx(900.0));
    CHECK(turned.transients[0].sharpness == 0.3);
    CHECK(turned.transients[1].sharpness == Approx(0.7));
    // Without a point inside, about where the range begins.
    const double begin = 400.0 + 500.0 * 0.1 / 1.5;
    scope.range = {1.6, 2.0};
    const Clip lines = invert(clip, scope);
    CHECK(valueAt(lines.centroid, 1.6) == Approx(begin));
    CHECK(valueAt(lines.centroid, 2.0 - 1e-9) == Approx(begin * begin / (400.0 + 500.0 * 0.5 / 1.5)).epsilon(1e-6));
    CHECK(valueAt(lines.envelope, 1.6) == 0.0); // 1.05 before
}

TEST_CASE("Transposition moves every frequency by its interval, within the range")
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {{50.0, 60.0, 70.0, 0, {{0.0, 0.3}}, {{0.0, 61.0}}}};
    clip.noise = {{100.0, 200.0, {{0.0, 0.1}}}};
    clip.centroid = {{0.0, 90.0}};
    const Clip higher = transpose(clip, 12.0);
    CHECK(higher.bands[0].lowFrequency == Approx(100.0));
    CHECK(higher.bands[0].centreFrequency == Approx(120.0));
    CHECK(higher.bands[0].highFrequency == Approx(140.0));
    CHECK(higher.bands[0].pitch[0].value == Approx(122.0));
    CHECK(higher.noise[0].lowFrequency == Approx(200.0));
    CHECK(higher.noise[0].highFrequency == Approx(400.0));
    CHECK(higher.centroid[0].value == Approx(180.0));
    CHECK(higher.bands[0].amplitude == clip.bands[0].amplitude);
    CHECK(transpose(clip, -7.0).bands[0].centreFrequency == Approx(60.0 / std::pow(2.0, 7.0 / 12.0)));
    CHECK(transpose(clip, 500.0).bands[0].centreFrequency == Approx(60.0 * 256.0)); // 96 semitones at most
    CHECK(transpose(clip, -500.0).bands[0].centreFrequency == Approx(60.0 / 256.0));
}

TEST_CASE("Simplified lanes report the error that they have")
{
    Clip clip;
    clip.duration = 10.0;
    for (int i = 0; i <= 1000; ++i)
        clip.envelope.push_back({i / 100.0, 0.5 + 0.4 * std::sin(0.02 * i)});
    const Lane lanes[] = {{LaneKind::envelope, 0}, {LaneKind::noise, 7}};
    SimplifyParams params;
    params.count = 40;
    const auto simple = simplifyLanes(clip, lanes, params);
    REQUIRE(simple);
    REQUIRE(simple->lanes.size() == 1);
    CHECK(simple->lanes[0].before == 1001);
    CHECK(simple->lanes[0].after <= 40);
    double worst = 0.0;
    for (const Breakpoint& p : clip.envelope)
        worst = std::max(worst, std::abs(valueAt(simple->clip.envelope, p.time) - p.value));
    CHECK(simple->lanes[0].error.max == Approx(worst).epsilon(0.01));
}

TEST_CASE("A soloed band keeps the level that it has in the whole")
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {{50, 60, 70, 0, {{0.0, 0.3}, {1.0, 0.3}}, {}}, {100, 120, 140, 0, {{0.0, 0.4}, {1.0, 0.4}}, {}}};
    clip.envelope = {{0.0, 0.5}, {1.0, 0.5}};
    const Clip solo = audibleClip(clip, {{1}, {}, true, true});
    CHECK(solo.bands[0].amplitude.empty());
    CHECK(valueAt(solo.envelope, 0.5) == Approx(0.4));
    CHECK(audibleClip(clip, {}) == clip);
}
