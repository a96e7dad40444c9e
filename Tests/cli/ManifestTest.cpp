#include "cli/Manifest.h"

#include "support/Catch.h"
#include "support/TempFolder.h"

#include <initializer_list>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::cli;
using test::bytesOf;
using test::put;
using test::TempFolder;

namespace
{
ManifestEntry entryFor(const std::string& name)
{
    ManifestEntry entry;
    entry.inputSha256 = "of " + name;
    entry.settings = "as usual";
    entry.outputs = {{name + ".haptic", 12, "abc"}};
    entry.duration = 1.5;
    entry.warnings = {"one", "two\nlines"};
    entry.losses = {{LossKind::text, 0.5, 0.25, 0.125, "said"}};
    entry.report = {{"seconds", 0.25}, {"breakpoints", 40}};
    return entry;
}

Manifest manifestOf(std::initializer_list<const char*> names)
{
    Manifest manifest;
    manifest.command = "encode";
    manifest.arguments = {"sounds/", "--output=clips/"};
    for (const char* name : names)
        manifest.entries[name] = entryFor(name);
    return manifest;
}
} // namespace

TEST_CASE("A manifest grows by whole lines and is read as far as it goes", "[cli]")
{
    const TempFolder folder;
    const auto path = folder / "manifest.json";
    {
        GrowingManifest growing;
        REQUIRE(growing.start(path, manifestOf({"old"})).ok());
        growing.add("b", entryFor("b"));
        growing.add("a", entryFor("a"));
    } // as if killed: never finished
    const std::string torn = bytesOf(path);
    const auto whole = readManifest(path);
    REQUIRE(whole.has_value());
    CHECK(*whole == manifestOf({"old", "a", "b"}));

    // Cut anywhere, all but the last line is kept.
    for (std::size_t size = torn.rfind("{\"input\":\"a\""); size < torn.size() - 2; size += 7)
    {
        put(path, torn.substr(0, size));
        const auto part = readManifest(path);
        REQUIRE(part.has_value());
        CHECK(part->entries.size() == 2);
        CHECK(part->entries.at("b") == entryFor("b"));
    }
}

TEST_CASE("A finished manifest is one JSON document in the order of its names", "[cli]")
{
    const TempFolder folder;
    const auto path = folder / "manifest.json";
    GrowingManifest growing;
    REQUIRE(growing.start(path, manifestOf({})).ok());
    for (const char* name : {"c", "a", "b"})
        growing.add(name, entryFor(name));
    REQUIRE(growing.finish().ok());
    const Manifest all = manifestOf({"a", "b", "c"});
    CHECK(bytesOf(path) == manifestText(all));
    CHECK(nlohmann::json::parse(bytesOf(path))["files"].size() == 3);
    CHECK(readManifest(path) == all);
    CHECK(nlohmann::json::parse(manifestText({}))["files"].empty());
}

TEST_CASE("What is no manifest is told from none", "[cli]")
{
    const TempFolder folder;
    CHECK(readManifest(folder / "missing") == Manifest());
    for (const char* text : {"", "notes", "[]", "{}", "{\"format\": \"pacini.clip\", \"version\": 1, \"files\": []}"})
    {
        put(folder / "file", text);
        CHECK_FALSE(readManifest(folder / "file").has_value());
    }
}

TEST_CASE("A manifest remembers its shards, and expects what was not reached", "[cli]")
{
    const TempFolder folder;
    const auto path = folder / "run.manifest.json";
    Manifest begun = manifestOf({"old"});
    begun.shards = {{{1, 3}, 2, 5}};
    begun.expect("old");
    begun.expect("new");
    {
        GrowingManifest growing;
        REQUIRE(growing.start(path, begun).ok());
    } // as if killed
    const auto read = readManifest(path);
    REQUIRE(read.has_value());
    CHECK(*read == begun);
    CHECK(read->find("old")->error.empty());
    CHECK(read->find("new")->error == "was not reached before the run ended");
    for (const char* wrong : {R"("4/3")", R"("a")", "3"})
    {
        std::string text = manifestText(begun);
        text.replace(text.find(R"("1/3")"), 5, wrong);
        put(path, text);
        CHECK_FALSE(readManifest(path).has_value());
    }
}

TEST_CASE("Shards of one division make a run whole; of several incomplete ones the fullest tells what is missing",
          "[cli]")
{
    const auto missing = [](const std::vector<std::vector<ManifestShard>>& manifests)
    {
        ShardUnion made;
        for (const auto& one : manifests)
            made.add(one);
        return made.missing();
    };
    const ManifestShard first{{1, 3}, 4, 12}, second{{2, 3}, 5, 12}, third{{3, 3}, 3, 12}, half{{1, 2}, 7, 12};
    CHECK(missing({{first}, {second}, {third}}).names.empty());
    CHECK(missing({{first}, {}}).names.empty()); // the other one is of all of it
    CHECK(missing({{first}, {third}}).names == "shard 2/3");
    CHECK(missing({{first}, {third}, {first}}).files == 5);
    CHECK(missing({{first}, {half}}).names == "shard 2/2");
    CHECK(missing({{first}, {half}}).files == 5);
    CHECK(missing({{first, third}, {half}, {second}}).names.empty());
    CHECK(missing({{{{500, 1000}, 1, 900}}}).names ==
          "shards 1/1000, 2/1000, 3/1000, 4/1000, 5/1000, 6/1000, 7/1000, 8/1000 and 991 more");
}
