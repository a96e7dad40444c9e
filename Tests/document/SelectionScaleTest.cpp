#include "document/SelectionScale.h"

#include "support/Catch.h"
#include "support/RandomEdits.h"

#include <cmath>

using namespace pacini;

namespace
{
Clip twoLanes()
{
    Clip clip;
    clip.duration = 4.0;
    clip.envelope = {{0.5, 0.1}, {1.0, 0.4}, {2.0, 0.2}, {3.5, 0.3}};
    clip.bands.push_back({50.0, 60.0, 70.0, 0, {{1.0, 0.5}, {1.5, 0.25}}, {{1.0, 60.0}, {1.5, 65.0}}});
    clip.transients = {{0.75, 0.2, 0.3}, {1.5, 0.8, 0.6}, {3.0, 0.5, 0.5}};
    return clip;
}

Selection someSelection()
{
    return {{{{LaneKind::envelope, 0}, {1, 2}}, {{LaneKind::amplitude, 0}, {0, 1}}}, {1}};
}
} // namespace

TEST_CASE("A selection is stretched over all lanes about one time, in proportion")
{
    const Clip before = twoLanes();
    const EditedClip after = scaleSelected(before, someSelection(), {1.0, 1.4, 1.0});
    CHECK(after.clip.envelope == Curve{{0.5, 0.1}, {1.0, 0.4}, {2.4, 0.2}, {3.5, 0.3}});
    CHECK(after.clip.bands[0].amplitude[0] == Breakpoint{1.0, 0.5});
    CHECK(after.clip.bands[0].amplitude[1].time == Approx(1.7));
    CHECK(after.clip.bands[0].pitch == before.bands[0].pitch);
    CHECK(after.clip.transients[1].time == Approx(1.7));
    CHECK(after.clip.transients[0] == before.transients[0]);
    CHECK(after.selection == someSelection());
}

TEST_CASE("A stretch stops as a whole at the ends of the clip")
{
    const Clip after = scaleSelected(twoLanes(), someSelection(), {1.0, 100.0, 1.0}).clip;
    CHECK(after.envelope.back().time == Approx(4.0)); // the point of 2.0 s; that of 3.5 s lies before it now
    CHECK(after.bands[0].amplitude[1].time == Approx(2.5));
    CHECK(after.transients.size() == 3);
    CHECK(after.transients[1].time == Approx(2.5));
}

TEST_CASE("Differences of levels grow about their mean in dB")
{
    const Clip before = twoLanes();
    const Clip after = scaleSelected(before, someSelection(), {1.0, 1.0, 2.0}).clip;
    const double mean = std::sqrt(0.4 * 0.2);
    CHECK(after.envelope[1].value == Approx(mean * std::pow(0.4 / mean, 2.0)));
    CHECK(after.envelope[1].value / after.envelope[2].value == Approx(4.0));
    CHECK(after.envelope[0] == before.envelope[0]);
    CHECK(after.transients[1].amplitude == Approx(0.8)); // alone it is its own mean
}

TEST_CASE("Whatever is scaled, the clip stays valid and the selection as large")
{
    Random random(8);
    for (std::uint64_t seed = 1; seed <= 40; ++seed)
    {
        const Clip clip = test::randomFullClip(seed, 12);
        Selection selection;
        for (const Lane& lane : lanesOf(clip))
            selection = withPoints(selection, lane, allIndices(curveOf(clip, lane)->size()));
        selection.transients = allIndices(clip.transients.size());
        const EditedClip edited = scaleSelected(clip, selection,
                                                {test::anyNumber(random, 0.0, clip.duration),
                                                 test::anyNumber(random, 0.0, 3.0), test::anyNumber(random, 0.0, 4.0)});
        const auto valid = validate(edited.clip);
        INFO(seed << (valid ? "" : valid.error().text()));
        CHECK(valid.ok());
        CHECK(selectedCount(edited.selection) == selectedCount(selection));
    }
}
