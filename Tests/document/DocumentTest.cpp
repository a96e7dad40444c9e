#include "document/Document.h"

#include "document/Amendments.h"
#include "document/ProjectEdits.h"
#include "io/ClipFile.h"
#include "io/formats/json/ClipJson.h"
#include "support/Catch.h"
#include "support/RandomEdits.h"
#include "support/TempFolder.h"

#include <pacini/clip/edits/PointEdits.h>

#include <filesystem>
#include <limits>

using namespace pacini;

namespace
{
/// An operation with arguments of all kinds, also such that are refused.
EditOperation anyOperation(Random& random, const Clip& clip)
{
    const auto time = [&]
    {
        return test::anyNumber(random, 0.0, clip.duration);
    };
    switch (random.next() % 14)
    {
    case 0:
        return GainEdit{test::anyScope(random, clip), test::anyNumber(random, -20.0, 6.0)};
    case 1:
        return FadeEdit{test::anyScope(random, clip), FadeDirection::out, FadeShape::smooth};
    case 2:
        return InvertEdit{test::anyScope(random, clip)};
    case 3:
        return QuantiseEdit{test::anyScope(random, clip), {0.05, 0.0, 0.8}};
    case 4:
        return HumaniseEdit{test::anyScope(random, clip), {0.01, 2.0, 0.5, random.next()}};
    case 5:
        return TransposeEdit{test::anyNumber(random, -12.0, 12.0)};
    case 6:
        return TrimEdit{{time(), time()}};
    case 7:
        return CutEdit{{time(), time()}};
    case 8:
        return InsertEdit{time(), std::make_shared<const Clip>(test::randomFullClip(random.next() % 9, 5))};
    case 9:
        return RepeatEdit{static_cast<int>(random.next() % 3)};
    case 10:
        return ReverseEdit{};
    case 11:
        return StretchEdit{random.uniform(0.5, 2.0)};
    case 12:
        return ThinEdit{{time(), time()}, test::anyNumber(random, 0.0, 0.2), random.uniform(0.0, 0.3)};
    default:
        return RenameEdit{"name " + std::to_string(random.next() % 100)};
    }
}

/// Some step of a user on clip `id`.
void anyStep(Random& random, Document& document, int id)
{
    const auto item = document.clip(id);
    if (random.next() % 2 == 0)
    {
        if (auto edited = test::anyEdit(random, *item->clip); edited && breakpointCount(*edited) < 5000)
            REQUIRE(document.commit("Edit", withClip(document.project(), id, std::move(edited).value())));
        return;
    }
    const auto before = document.snapshot().state;
    if (breakpointCount(*item->clip) > 3000)
        REQUIRE(document.commit("Trim", withEdit(document.project(), id, TrimEdit{{0.0, 0.3 * item->clip->duration}})));
    else if (!document.commit("Operation", withEdit(document.project(), id, anyOperation(random, *item->clip))))
        CHECK(document.snapshot().state == before); // what is refused changes nothing
}

/// A clip as it comes out of a file: texts are UTF-8.
Clip fileClip(std::uint64_t seed)
{
    return readClipJson(writeClipJson(test::randomFullClip(seed, 12))).value();
}
} // namespace

TEST_CASE("Undoing everything gives the first project bit for bit, redoing everything the last")
{
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
    {
        Random random(seed);
        Document document;
        const int id = addClip(document, fileClip(seed)).value();
        std::vector<std::string> texts = {writeClipJson(*document.clip(id)->clip)};
        std::vector<std::size_t> states = {document.steps().current()};
        for (int step = 0; step < 40; ++step)
        {
            anyStep(random, document, id);
            INFO("seed " << seed << ", step " << step);
            REQUIRE(validate(*document.clip(id)->clip));
            if (document.steps().current() == states.back())
                continue;
            states.push_back(document.steps().current());
            texts.push_back(writeClipJson(*document.clip(id)->clip));
        }
        const Project last = document.project();
        for (std::size_t i = texts.size(); i-- > 0;)
        {
            CHECK(writeClipJson(*document.clip(id)->clip) == texts[i]);
            CHECK(document.undo() == (i > 0));
        }
        for (std::size_t i = 0; i < texts.size(); ++i)
        {
            CHECK(writeClipJson(*document.clip(id)->clip) == texts[i]);
            CHECK(document.redo() == (i + 1 < texts.size()));
        }
        CHECK(document.project() == last);
    }
}

TEST_CASE("The edits over an analysis make the clip again, bit for bit")
{
    for (std::uint64_t seed = 1; seed <= 25; ++seed)
    {
        Random random(seed);
        Document document;
        const int id = addClip(document, fileClip(seed)).value();
        for (int step = 0; step < 25; ++step)
            anyStep(random, document, id);
        const auto item = document.clip(id);
        const Clip analysis = *item->analysis;
        REQUIRE(document.commit("Again", withAnalysis(document.project(), item->encoder, {id, analysis},
                                                      document.steps().newIds().source)));
        INFO("seed " << seed);
        CHECK(document.clip(id)->unfitting.size() == 0);
        for (const auto& waiting : document.clip(id)->unfitting)
            UNSCOPED_INFO(waiting.edit << ": " << waiting.reason);
        CHECK((writeClipJson(*document.clip(id)->clip) == writeClipJson(*item->clip)));
    }
}

TEST_CASE("An edit of one of two bands with the same centre comes back on that one")
{
    Clip clip = fileClip(3);
    clip.bands.assign(2, clip.bands.front());
    for (std::size_t band : {0u, 1u})
    {
        Document document;
        const int id = addClip(document, clip).value();
        Clip edited = clip;
        edited.bands[band].amplitude = {{0.0, 0.25}, {clip.duration, 0.5}};
        REQUIRE(document.commit("Edit", withClip(document.project(), id, edited)));
        const auto item = document.clip(id);
        REQUIRE(document.commit("Again", withAnalysis(document.project(), item->encoder, {id, Clip(*item->analysis)},
                                                      document.steps().newIds().source)));
        CHECK(document.clip(id)->unfitting.empty());
        CHECK(*document.clip(id)->clip == *item->clip);
    }
}

TEST_CASE("Edit, save, close, open, export: identical clips and edits")
{
    const test::TempFolder folder;
    for (std::uint64_t seed = 1; seed <= 12; ++seed)
    {
        Random random(seed);
        Document document;
        const int id = addClip(document, fileClip(seed)).value();
        const int other = addClip(document, fileClip(seed + 100)).value();
        for (int step = 0; step < 20; ++step)
            anyStep(random, document, step % 3 == 0 ? other : id);
        REQUIRE(document.commit("Group", withGroup(document.project(), {id}, "group \"ä\"")));
        REQUIRE(document.commit("Notes", withNotes(document.project(), other, "two\nlines")));
        REQUIRE(document.commit("Groups", withGroups(document.project(), {"group \"ä\"", "empty"})));
        REQUIRE(document.commit("Notes", withProjectNotes(document.project(), "all")));
        const auto path = folder / "sub folder.pacini";
        REQUIRE(document.saveAs(path));
        CHECK_FALSE(document.isDirty());

        auto opened = Document::open(path);
        INFO("seed " << seed << (opened ? "" : opened.error().text()));
        REQUIRE(opened);
        CHECK(opened->project() == document.project());
        CHECK_FALSE(opened->isDirty());
        REQUIRE(writeClip(folder / "a.json", *document.clip(id)->clip, jsonFormat()));
        REQUIRE(writeClip(folder / "b.json", *opened->clip(id)->clip, jsonFormat()));
        CHECK(test::bytesOf(folder / "a.json") == test::bytesOf(folder / "b.json"));
        REQUIRE(opened->saveAs(folder / "again.pacini"));
        CHECK(test::bytesOf(folder / "again.pacini") == test::bytesOf(path));
    }
}

TEST_CASE("A project is dirty exactly when it differs from its file")
{
    const test::TempFolder folder;
    Document document;
    CHECK_FALSE(document.isDirty());
    CHECK(document.save().error().code == ErrorCode::invalidArgument);
    const int id = addClip(document, fileClip(1)).value();
    CHECK(document.isDirty());
    REQUIRE(document.saveAs(folder / "p.pacini"));
    REQUIRE(document.commit("Reverse", withEdit(document.project(), id, ReverseEdit{})));
    CHECK(document.isDirty());
    CHECK(document.steps().undoName() == "Reverse");
    document.undo();
    CHECK_FALSE(document.isDirty());
    CHECK(document.steps().redoName() == "Reverse");
    document.redo();
    CHECK(document.isDirty());
    document.undo();
    REQUIRE(document.commit("Notes", withNotes(document.project(), id, "other way")));
    CHECK_FALSE(document.steps().canRedo());
    CHECK(document.isDirty());
}

TEST_CASE("A file that cannot be written leaves the old one and the project as they were")
{
    const test::TempFolder folder;
    Document document;
    (void)addClip(document, fileClip(1));
    REQUIRE(document.saveAs(folder / "p.pacini"));
    const std::string before = test::bytesOf(folder / "p.pacini");
    REQUIRE(document.commit("Notes", withProjectNotes(document.project(), "new")));
    CHECK(document.saveAs(folder / "missing/p.pacini").error().code == ErrorCode::io);
    CHECK(document.path() == folder / "p.pacini");
    CHECK(document.isDirty());
    CHECK(test::bytesOf(folder / "p.pacini") == before);
    REQUIRE(document.save());
    CHECK_FALSE(document.isDirty());
}

TEST_CASE("All edits of a gesture are one step, each in place of the one before")
{
    Document document;
    Clip clip;
    clip.duration = 1.0;
    clip.envelope = {{0.0, 0.5}, {0.5, 0.8}, {1.0, 0.5}};
    const int id = addClip(document, clip).value();
    const auto steps = document.steps().size();
    const Gesture drag = document.beginGesture();
    for (int i = 1; i <= 30; ++i)
    {
        Clip moved = *document.gestureStart(drag).find(id)->clip;
        moved.envelope =
            movePoints(moved.envelope, {1}, {0.01 * i, 0.0, 1.0}, limitsOf(moved, {LaneKind::envelope, 0})).curve;
        REQUIRE(document.commit("Move point", withClip(document.gestureStart(drag), id, moved), drag));
    }
    CHECK(document.steps().size() == steps + 1);
    CHECK(document.clip(id)->clip->envelope[1].time == Approx(0.8));
    CHECK(document.clip(id)->edits.size() == 1);
    const Gesture turn = document.beginGesture();
    for (int i = 1; i <= 6; ++i)
        REQUIRE(document.commit("Gain", withEdit(document.gestureStart(turn), id, GainEdit{{}, -1.0 * i}), turn));
    CHECK(document.clip(id)->clip->envelope[0].value == Approx(0.5 * std::pow(10.0, -0.3)));
    document.undo();
    CHECK(document.clip(id)->clip->envelope[0].value == 0.5);
    document.undo();
    CHECK(*document.clip(id)->clip == clip);
}

TEST_CASE("Clips are added, copied, moved, split and removed, and each of these can be undone")
{
    Document document;
    const Clip clip = fileClip(4);
    const int id = addClip(document, clip).value();
    const int copy = document.steps().newIds().clip;
    REQUIRE(document.commit("Copy", withDuplicate(document.project(), id, copy)));
    CHECK(*document.clip(copy)->clip == clip);
    const int right = document.steps().newIds().clip;
    REQUIRE(document.commit("Split", withSplit(document.project(), id, 0.4 * clip.duration, right)));
    CHECK(document.clip(id)->clip->duration + document.clip(right)->clip->duration == Approx(clip.duration));
    CHECK(document.project().clips[1]->id == right);
    REQUIRE(document.commit("Move", withPlaced(document.project(), right, 9, "")));
    CHECK(document.project().clips.back()->id == right);
    REQUIRE(document.commit("Remove", withoutClips(document.project(), {copy})));
    CHECK_FALSE(document.clip(copy));
    CHECK_FALSE(document.commit("Remove", withoutClips(document.project(), {copy})));
    for (int i = 0; i < 3; ++i)
        document.undo();
    CHECK(*document.clip(id)->clip == clip);
    CHECK(document.project().clips.size() == 2);
    document.undo();
    CHECK(document.project().clips.size() == 1);
    CHECK_FALSE(document.undo());
}

TEST_CASE("Removing one edit keeps those after it")
{
    Document document;
    Clip clip;
    clip.duration = 1.0;
    clip.envelope = {{0.0, 0.1}, {0.3, 0.8}, {0.6, 0.2}, {1.0, 0.5}};
    const int id = addClip(document, clip).value();
    REQUIRE(document.commit("Gain", withEdit(document.project(), id, GainEdit{{}, 6.0})));
    REQUIRE(document.commit("Trim", withEdit(document.project(), id, TrimEdit{{0.3, 1.0}})));
    REQUIRE(document.commit("Remove gain", withoutEdits(document.project(), id, {0})));
    CHECK(document.clip(id)->edits.size() == 1);
    CHECK(*document.clip(id)->clip == trimClip(clip, {0.3, 1.0}));
}

TEST_CASE("Undo steps of a clip of 50 000 breakpoints cost kilobytes, not the clip")
{
    Random random(1);
    Clip clip;
    clip.duration = 100.0;
    for (int i = 0; i < 50000; ++i)
        clip.envelope.push_back({0.002 * i, random.uniform()});
    Document document;
    const int id = addClip(document, clip).value();
    for (int i = 0; i < 200; ++i)
    {
        Clip edited = *document.clip(id)->clip;
        const auto limits = limitsOf(edited, {LaneKind::envelope, 0});
        edited.envelope = movePoints(edited.envelope, {random.next() % 50000}, {0.0, 0.1, 1.0}, limits).curve;
        edited.envelope = addPoint(edited.envelope, {random.uniform(0.0, 100.0), 0.5}, limits).curve;
        REQUIRE(document.commit("Edit", withClip(document.project(), id, edited)));
    }
    // Two places far apart: all between them is new once, at the most.
    std::size_t sum = 0;
    for (int i = 0; i < 200; ++i)
    {
        Clip edited = *document.clip(id)->clip;
        edited.envelope = movePoints(edited.envelope, {random.next() % 50000}, {0.0, 0.01, 1.0},
                                     limitsOf(edited, {LaneKind::envelope, 0}))
                              .curve;
        REQUIRE(document.commit("Edit", withClip(document.project(), id, edited)));
        sum += document.steps().bytes(document.steps().current());
    }
    CHECK(sum / 200 < 20'000); // the clip has 800 000 bytes
    while (document.undo())
    {
    }
    CHECK(*document.clip(id)->clip == clip);
}

#ifdef __linux__
TEST_CASE("A full disk is told with its reason, and the project stays unsaved and whole")
{
    const test::TempFolder folder;
    Document document;
    (void)addClip(document, fileClip(1));
    const Project before = document.project();
    const auto full = document.saveAs("/dev/full");
    REQUIRE_FALSE(full);
    CHECK(full.error().code == ErrorCode::diskFull);
    CHECK(full.error().text().find("the disk is full") != std::string::npos);
    CHECK(document.path().empty());
    CHECK(document.isDirty());
    CHECK(document.project() == before);
    REQUIRE(document.saveAs(folder / "p.pacini"));
    CHECK(Document::open(folder / "p.pacini")->project() == before);
}
#endif

TEST_CASE("What a project is felt with is kept through undo and redo, and is no step; out of range it is refused")
{
    const test::TempFolder folder;
    Document document;
    const int id = addClip(document, fileClip(1)).value();
    REQUIRE(document.commit("Reverse", withEdit(document.project(), id, ReverseEdit{})));
    REQUIRE(document.saveAs(folder / "p.pacini"));
    ProjectProfile profile;
    profile.name = "lra-175";
    profile.strength = 0.7;
    REQUIRE(setProfile(document, profile));
    CHECK(document.steps().undoName() == "Reverse");
    CHECK(document.isDirty());
    REQUIRE(document.undo());
    CHECK(document.project().profile == profile);
    CHECK(document.isDirty());
    CHECK_FALSE(document.steps().canUndo());
    REQUIRE(document.redo());
    CHECK(document.project().profile == profile);
    REQUIRE(document.save());
    REQUIRE(setProfile(document, profile));
    CHECK_FALSE(document.isDirty());
    for (const double strength : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()})
    {
        profile.strength = strength;
        CHECK_FALSE(setProfile(document, profile));
    }
    CHECK(document.project().profile.strength == 0.7);
}

TEST_CASE("Opening is no step: undo takes back the edits only, and no state has lost a clip")
{
    const test::TempFolder folder;
    Document document;
    const int first = addClip(document, fileClip(1)).value();
    REQUIRE(document.saveAs(folder / "p.pacini"));
    REQUIRE(document.commit("Reverse", withEdit(document.project(), first, ReverseEdit{})));
    REQUIRE(document.commit("Notes", withNotes(document.project(), first, "reversed")));
    REQUIRE(document.undo());
    AudioReference sound;
    sound.path = folder / "s.wav";
    sound.hash = "0123456789abcdef";
    const int second = addSound(document, sound, {}, fileClip(2)).value();
    CHECK(document.steps().undoName() == "Reverse");
    CHECK(document.steps().redoName() == "Notes");
    REQUIRE(document.commit("Reverse", withEdit(document.project(), second, ReverseEdit{})));
    const int third = addClip(document, fileClip(3)).value();
    const Project last = document.project();
    while (document.undo())
    {
        CHECK(document.project().clips.size() == 3);
        CHECK(document.isDirty()); // the file has one
    }
    CHECK(*document.clip(first)->clip == fileClip(1));
    CHECK(*document.clip(second)->clip == fileClip(2));
    CHECK(document.project().findSource(document.clip(second)->source)->path == sound.path);
    while (document.redo())
        CHECK(document.clip(third));
    CHECK(document.project() == last);
}

TEST_CASE("A clip that is opened after an undo has an id that no clip to be redone has")
{
    Document document;
    const int first = addClip(document, fileClip(1)).value();
    const int copy = document.steps().newIds().clip;
    REQUIRE(document.commit("Duplicate", withDuplicate(document.project(), first, copy)));
    REQUIRE(document.undo());
    const int opened = addClip(document, fileClip(2)).value();
    CHECK(opened != copy);
    REQUIRE(document.redo());
    REQUIRE(document.project().clips.size() == 3);
    CHECK(*document.clip(copy)->clip == fileClip(1));
    CHECK(*document.clip(opened)->clip == fileClip(2));
}

TEST_CASE("What is opened during a gesture does not end it, and is not lost by it")
{
    Document document;
    const int id = addClip(document, fileClip(1)).value();
    const Gesture turn = document.beginGesture();
    REQUIRE(document.commit("Gain", withEdit(document.gestureStart(turn), id, GainEdit{{}, -1.0}), turn));
    const int opened = addClip(document, fileClip(2)).value();
    REQUIRE(document.commit("Gain", withEdit(document.gestureStart(turn), id, GainEdit{{}, -2.0}), turn));
    CHECK(document.clip(opened));
    CHECK(document.clip(id)->edits.size() == 1);
    REQUIRE(document.undo());
    CHECK(document.clip(opened));
    CHECK(*document.clip(id)->clip == fileClip(1));
}
