#include "document/MarkerEdits.h"

#include "document/view/MarkerLabels.h"
#include "support/Catch.h"

using namespace pacini;

TEST_CASE("Markers stay in order of time whatever is added, moved, renamed and removed")
{
    std::vector<Marker> markers;
    for (const double time : {2.0, 0.5, 1.0})
        markers = withMarker(markers, {time, freeMarkerName(markers)});
    CHECK(markers == std::vector<Marker>{{0.5, "Marker 2"}, {1.0, "Marker 3"}, {2.0, "Marker 1"}});
    markers = renamedMarker(markers, 1, "hit");
    CHECK(freeMarkerName(markers) == "Marker 3");
    markers = movedMarker(markers, 1, 9.0, 4.0);
    CHECK(markers == std::vector<Marker>{{0.5, "Marker 2"}, {2.0, "Marker 1"}, {4.0, "hit"}});
    markers = movedMarker(markers, 2, -1.0, 4.0);
    CHECK(markers.front() == Marker{0.0, "hit"});
    markers = withoutMarker(markers, 1);
    CHECK(markers == std::vector<Marker>{{0.0, "hit"}, {2.0, "Marker 1"}});
    CHECK(withoutMarker(markers, 2) == markers);
    CHECK(movedMarker(markers, 2, 1.0, 4.0) == markers);
}

TEST_CASE("The next marker is behind the playhead also when that stands on one")
{
    const std::vector<Marker> markers = {{1.0, "a"}, {1.0, "b"}, {3.0, "c"}};
    CHECK(markerAfter(markers, 0.0) == 1.0);
    CHECK(markerAfter(markers, 1.0) == 3.0);
    CHECK_FALSE(markerAfter(markers, 3.0).has_value());
    CHECK(markerBefore(markers, 3.0) == 1.0);
    CHECK_FALSE(markerBefore(markers, 1.0).has_value());
    CHECK(markerNear(markers, 1.05, 0.1) == 0u);
    CHECK(markerNear(markers, 2.9, 0.2) == 2u);
    CHECK_FALSE(markerNear(markers, 2.0, 0.5).has_value());
}

TEST_CASE("Names of markers never reach over the next flag, and those out of view are left out")
{
    const std::vector<Marker> markers = {{0.0, "a"}, {1.0, "b"}, {1.1, "c"}, {8.0, "d"}, {30.0, "e"}};
    const TimeAxis axis{0.5, 0.01};
    const auto labels = markerLabels(markers, axis, 1000.0, 120.0);
    REQUIRE(labels.size() == 4); // the name of the first reaches into view
    for (std::size_t i = 0; i + 1 < labels.size(); ++i)
        CHECK(labels[i].x + labels[i].width <= labels[i + 1].x + 1e-9);
    CHECK(labels[0].width == Approx(100.0));
    CHECK(labels[1].width == Approx(10.0));
    CHECK(labels[2].width == 120.0);
    CHECK(labels[3].x == Approx(750.0));
}
