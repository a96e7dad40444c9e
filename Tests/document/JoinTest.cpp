#include "document/Amendments.h"
#include "document/Document.h"
#include "document/ProjectEdits.h"
#include "support/Catch.h"
#include "support/RandomEdits.h"

#include <pacini/clip/edits/TimeEdits.h>

using namespace pacini;

TEST_CASE("Clips are joined in one step that can be undone, and the joint is an edit of the first")
{
    Document document;
    const Clip one = test::randomFullClip(3, 10);
    const Clip two = test::randomFullClip(4, 10);
    const int first = *addClip(document, one);
    const int second = *addClip(document, two);
    const auto before = document.project();
    REQUIRE(document.commit("Join", withJoined(document.project(), first, second)).ok());
    CHECK(document.project().clips.size() == 1);
    CHECK(*document.clip(first)->clip == *insertClip(one, one.duration, two));
    CHECK(*document.clip(first)->analysis == one);
    CHECK(document.clip(first)->edits.size() == 1);
    CHECK(document.steps().undoName() == "Join");
    CHECK(document.undo());
    CHECK(document.project() == before);
}

TEST_CASE("A clip is not joined with itself or with one that is not there")
{
    Document document;
    const int id = *addClip(document, test::randomFullClip(3, 10));
    const auto state = document.snapshot().state;
    CHECK_FALSE(document.commit("Join", withJoined(document.project(), id, id)).ok());
    CHECK_FALSE(document.commit("Join", withJoined(document.project(), id, id + 1)).ok());
    CHECK_FALSE(document.commit("Join", withJoined(document.project(), id + 1, id)).ok());
    CHECK(document.snapshot().state == state);
}

TEST_CASE("A clip that was split and joined again plays as before")
{
    Document document;
    const Clip clip = test::randomFullClip(5, 10);
    const int left = *addClip(document, clip);
    const int right = document.steps().newIds().clip;
    REQUIRE(document.commit("Split", withSplit(document.project(), left, 0.4 * clip.duration, right)));
    REQUIRE(document.commit("Join", withJoined(document.project(), left, right)).ok());
    const Clip joined = *document.clip(left)->clip;
    CHECK(joined.duration == Approx(clip.duration));
    CHECK(joined.transients.size() == clip.transients.size());
    for (double x = 0.013; x < 1.0; x += 0.05)
        CHECK(valueAt(joined.envelope, x * clip.duration) ==
              Approx(valueAt(clip.envelope, x * clip.duration)).margin(1e-9));
}
