#include "document/Paste.h"

#include "support/Catch.h"

using namespace pacini;

namespace
{
Clip withBands(std::initializer_list<double> centres)
{
    Clip clip;
    clip.duration = 4.0;
    clip.envelope = {{0.0, 0.5}, {4.0, 0.5}};
    clip.centroid = {{0.0, 100.0}, {4.0, 100.0}};
    for (const double centre : centres)
        clip.bands.push_back({0.8 * centre, centre, 1.2 * centre, 0, {{0.0, 0.1}, {4.0, 0.1}}, {}});
    return clip;
}

constexpr Lane envelope{LaneKind::envelope, 0};
constexpr Lane centroid{LaneKind::centroid, 0};

EditScope only(Lane lane, TimeRange range)
{
    EditScope scope;
    scope.range = range;
    scope.allLanes = false;
    scope.lanes = {lane};
    scope.transients = false;
    return scope;
}
} // namespace

TEST_CASE("One copied lane goes into the lane that is asked for, and is selected there")
{
    Clip clip = withBands({60.0, 120.0});
    clip.envelope = {{0.0, 0.2}, {1.0, 0.8}, {2.0, 0.4}, {4.0, 0.4}};
    const Copied copied = copyOf(clip, only(envelope, {0.0, 2.0}));
    const Lane band{LaneKind::amplitude, 1};
    const auto pasted = pasteInto(clip, copied, 1.0, band);
    REQUIRE(pasted.ok());
    CHECK(pasted->clip.envelope == clip.envelope);
    CHECK(valueAt(pasted->clip.bands[1].amplitude, 2.0) == 0.8);
    CHECK(valueAt(pasted->clip.bands[1].amplitude, 0.5) == 0.1);
    CHECK_FALSE(selectedIn(pasted->selection, band).empty());
    CHECK_FALSE(pasteInto(clip, copied, 1.0, centroid).ok());
}

TEST_CASE("Several copied lanes keep their own, whatever has the focus")
{
    Clip clip = withBands({60.0, 120.0});
    clip.transients = {{0.5, 0.7, 0.2}};
    EditScope all;
    all.range = {0.0, 1.0};
    const auto pasted = pasteInto(clip, copyOf(clip, all), 2.0, centroid);
    REQUIRE(pasted.ok());
    CHECK(pasted->leftOut == 0);
    CHECK(pasted->clip.transients == std::vector<Transient>{{0.5, 0.7, 0.2}, {2.5, 0.7, 0.2}});
    CHECK(pasted->selection.transients == Indices{1});
    CHECK(valueAt(pasted->clip.centroid, 2.5) == 100.0);
}

TEST_CASE("In another clip bands are found by frequency, each once, and what has no place is counted")
{
    Clip from = withBands({62.0, 115.0, 125.0, 500.0});
    for (std::size_t k = 0; k < 4; ++k)
        from.bands[k].amplitude = {{0.0, 0.2 + 0.1 * static_cast<double>(k)},
                                   {4.0, 0.2 + 0.1 * static_cast<double>(k)}};
    const Clip to = withBands({30.0, 60.0, 120.0});
    EditScope all;
    all.range = {0.0, 4.0};
    const auto pasted = pasteInto(to, copyOf(from, all), 0.0, std::nullopt);
    REQUIRE(pasted.ok());
    CHECK(pasted->leftOut == 2); // one of 115 and 125 Hz, and 500 Hz
    CHECK(valueAt(pasted->clip.bands[0].amplitude, 1.0) == 0.1);
    CHECK(valueAt(pasted->clip.bands[1].amplitude, 1.0) == Approx(0.2));
    CHECK(valueAt(pasted->clip.bands[2].amplitude, 1.0) == Approx(0.4)); // 125 Hz is nearer in octaves
    CHECK(pasted->clip.bands.size() == 3);
}

TEST_CASE("What has no place at all is refused")
{
    const Clip from = withBands({900.0});
    const auto pasted =
        pasteInto(withBands({30.0}), copyOf(from, only({LaneKind::amplitude, 0}, {0.0, 1.0})), 0.0, std::nullopt);
    CHECK_FALSE(pasted.ok());
}
