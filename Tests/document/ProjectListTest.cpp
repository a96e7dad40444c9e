#include "document/Amendments.h"
#include "document/Document.h"
#include "document/ProjectEdits.h"
#include "document/ProjectJson.h"
#include "document/view/ClipRows.h"
#include "support/Catch.h"

#include <map>
#include <set>

using namespace pacini;

namespace
{
Clip named(const std::string& name)
{
    Clip clip;
    clip.name = name;
    clip.duration = 1.0;
    return clip;
}

/// a, b without a group, c and e in "hits", d in "rain"; "empty" has none.
struct Shelf
{
    Document document;
    std::map<std::string, int> ids;

    Shelf()
    {
        for (const char* name : {"a", "c", "b", "d", "e"})
            ids[name] = addClip(document, named(name)).value();
        REQUIRE(document.commit("Groups", withGroups(document.project(), {"empty", "hits"})));
        group("c", "hits");
        group("e", "hits");
        group("d", "rain");
    }

    void group(const std::string& name, const std::string& wanted)
    {
        REQUIRE(document.commit("Group", withGroup(document.project(), {ids[name]}, wanted)));
    }

    /// "a b [empty] [hits] c e [rain] d"
    [[nodiscard]] std::string text() const
    {
        std::string all;
        for (const ClipRow& row : clipRows(document.project()))
            all += (all.empty() ? "" : " ") +
                   (row.clip != 0 ? document.clip(row.clip)->clip->name : "[" + row.group + "]");
        return all;
    }

    void drop(const std::string& name, std::size_t gap)
    {
        const auto rows = clipRows(document.project());
        const ClipPlace place = placeAbove(document.project(), rows, gap, ids[name]);
        REQUIRE(document.commit("Move clip", withPlaced(document.project(), ids[name], place.index, place.group)));
    }
};
} // namespace

TEST_CASE("Clips are listed without a group first, then under their groups in order, unknown groups last")
{
    const Shelf shelf;
    CHECK(shelf.text() == "a b [empty] [hits] c e [rain] d");
    CHECK(groupsOf(shelf.document.project()) == std::vector<std::string>{"empty", "hits", "rain"});
}

TEST_CASE("A clip dropped between two rows stands there, in the group above it, and one undo takes it back")
{
    struct Drop
    {
        const char* clip;
        std::size_t gap;
        const char* result;
    };
    for (const Drop& drop : {
             Drop{"b", 0, "b a [empty] [hits] c e [rain] d"}, // to the top
             Drop{"a", 2, "b a [empty] [hits] c e [rain] d"},
             Drop{"a", 1, "a b [empty] [hits] c e [rain] d"}, // where it is
             Drop{"a", 0, "a b [empty] [hits] c e [rain] d"},
             Drop{"a", 3, "b [empty] a [hits] c e [rain] d"}, // below an empty heading
             Drop{"a", 4, "b [empty] [hits] a c e [rain] d"}, // first of a group
             Drop{"a", 5, "b [empty] [hits] c a e [rain] d"},
             Drop{"a", 6, "b [empty] [hits] c e a [rain] d"},
             Drop{"a", 99, "b [empty] [hits] c e [rain] d a"}, // the end
             Drop{"e", 4, "a b [empty] [hits] e c [rain] d"},
             Drop{"c", 6, "a b [empty] [hits] e c [rain] d"},
             Drop{"c", 5, "a b [empty] [hits] c e [rain] d"},
             Drop{"e", 1, "a e b [empty] [hits] c [rain] d"}, // out of its group
             Drop{"d", 0, "d a b [empty] [hits] c e [rain]"}, // the group is kept
             Drop{"c", 3, "a b [empty] c [hits] e [rain] d"},
         })
    {
        Shelf shelf;
        INFO(drop.clip << " above row " << drop.gap);
        // "rain" becomes a group of the project so that it does not go with its last clip.
        REQUIRE(shelf.document.commit("Groups", withGroups(shelf.document.project(), {"empty", "hits", "rain"})));
        const Project before = shelf.document.project();
        shelf.drop(drop.clip, drop.gap);
        CHECK(shelf.text() == drop.result);
        shelf.document.undo();
        CHECK(shelf.document.project() == before);
    }
}

TEST_CASE("A clip may be placed in a group that is new")
{
    Shelf shelf;
    REQUIRE(shelf.document.commit("Move", withPlaced(shelf.document.project(), shelf.ids["b"], 0, "new")));
    CHECK(shelf.text() == "a [empty] [hits] c e [rain] d [new] b");
    CHECK_FALSE(shelf.document.commit("Move", withPlaced(shelf.document.project(), 99, 0, "new")));
}

TEST_CASE("Groups are renamed, joined and removed with all their clips, each in one step")
{
    Shelf shelf;
    const Project before = shelf.document.project();
    REQUIRE(shelf.document.commit("Rename", withGroupRenamed(shelf.document.project(), "hits", "knocks")));
    CHECK(shelf.text() == "a b [empty] [knocks] c e [rain] d");
    REQUIRE(shelf.document.commit("Rename", withGroupRenamed(shelf.document.project(), "knocks", "empty")));
    CHECK(shelf.text() == "a b [empty] c e [rain] d");
    REQUIRE(shelf.document.commit("Remove", withGroupRenamed(shelf.document.project(), "empty", "")));
    CHECK(shelf.text() == "a c b e [rain] d");
    // A group that only its clips know.
    REQUIRE(shelf.document.commit("Rename", withGroupRenamed(shelf.document.project(), "rain", "snow")));
    CHECK(shelf.text() == "a c b e [snow] d");
    for (int i = 0; i < 4; ++i)
        REQUIRE(shelf.document.undo());
    CHECK(shelf.document.project() == before);
}

TEST_CASE("A new group has a name that no other has")
{
    Document document;
    std::set<std::string> names;
    for (int i = 0; i < 5; ++i)
    {
        const std::string name = freeGroupName(document.project());
        CHECK(names.insert(name).second);
        auto groups = document.project().groups;
        groups.push_back(name);
        REQUIRE(document.commit("New group", withGroups(document.project(), groups)));
    }
    CHECK(names.contains("Group"));
    CHECK(names.contains("Group 5"));
}

TEST_CASE("Tags of several clips are one step, and files keep them")
{
    Document document;
    Clip clip;
    clip.duration = 1.0;
    const int first = addClip(document, clip).value(), second = addClip(document, clip).value();
    const std::size_t steps = document.steps().size();
    REQUIRE(document.commit("Clip tags", withTags(document.project(), {first, second}, {"ui", "soft"})));
    CHECK(document.steps().size() == steps + 1);
    const auto read = readProjectJson(projectJson(document.project()), {});
    REQUIRE(read);
    CHECK(read->project == document.project());
    CHECK(read->project.find(second)->tags == std::vector<std::string>{"ui", "soft"});
    document.undo();
    CHECK(document.clip(first)->tags.empty());
    CHECK_FALSE(document.commit("Clip tags", withTags(document.project(), {99}, {"ui"})));
}
