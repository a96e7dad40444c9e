// Where someone works in a project is found again.

#include "document/Amendments.h"
#include "document/Autosave.h"
#include "document/RecentFiles.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

using namespace pacini;

TEST_CASE("The list of recent projects keeps where each was worked on")
{
    const test::TempFolder folder;
    const WorkPlace first{3, 1.25, TimeRange{0.5, 2.0}, TimeRange{0.25, 4.5}};
    const WorkPlace second{1, 0.0, std::nullopt, std::nullopt};
    {
        RecentFiles list(folder / "recent.json");
        REQUIRE(list.add(folder / "a.pacini"));
        REQUIRE(list.add(folder / "b.pacini"));
        REQUIRE(list.setPlace(folder / "a.pacini", first));
        REQUIRE(list.setPlace(folder / "b.pacini", second));
        REQUIRE(list.setPlace(folder / "not in the list.pacini", first));
    }
    RecentFiles list(folder / "recent.json");
    CHECK(list.files().size() == 2);
    CHECK(list.placeOf(folder / "a.pacini") == first);
    CHECK(list.placeOf(folder / "b.pacini") == second);
    CHECK(list.placeOf(folder / "not in the list.pacini") == WorkPlace{});
    // A project that is opened again keeps its place, and one that leaves the list takes it along.
    REQUIRE(list.add(folder / "a.pacini"));
    CHECK(list.placeOf(folder / "a.pacini") == first);
    REQUIRE(list.remove(folder / "a.pacini"));
    CHECK(RecentFiles(folder / "recent.json").placeOf(folder / "a.pacini") == WorkPlace{});
}

TEST_CASE("A list of recent projects without places, or with broken ones, is read all the same")
{
    const test::TempFolder folder;
    for (const char* places : {"", R"(, "places": 5)", R"(, "places": [{"path": "/a.pacini", "clip": 1.5}])",
                               R"(, "places": [{"path": "/a.pacini", "selectionFrom": 2, "selectionTo": 1}])"})
    {
        CAPTURE(places);
        test::put(folder / "recent.json",
                  std::string(R"({"format": "pacini.recent", "version": 1, "files": ["/a.pacini"])") + places + "}");
        const RecentFiles list(folder / "recent.json");
        CHECK(list.files().size() == 1);
        CHECK(list.placeOf("/a.pacini") == WorkPlace{});
    }
}

TEST_CASE("What is recovered says where it was worked on")
{
    const test::TempFolder folder;
    Document document;
    Clip clip;
    clip.name = "clip";
    clip.duration = 1.0;
    REQUIRE(addClip(document, clip));
    DocumentSnapshot snapshot = document.snapshot();
    snapshot.place = {7, 0.5, TimeRange{0.25, 0.75}, std::nullopt};
    REQUIRE(writeRecovery(folder / "1-1-5e1.pacini-recovery", snapshot));
    const auto found = listRecoverable(folder.path());
    REQUIRE(found.size() == 1);
    CHECK(found[0].place == snapshot.place);
}
