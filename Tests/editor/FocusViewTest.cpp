// The keyboard is always seen: what it reaches is scrolled into view.

#include "editor/Bench.h"

using namespace pacini;
using namespace pacini::test;

TEST_CASE("What gets the keyboard below the fold is scrolled into view, and what is in view stays")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    bench.view.setBounds(0, 0, 1024, 600);
    const auto bands = bench.clip().bands.size();
    auto& last = bench.row({LaneKind::amplitude, 0});
    auto& first = bench.row({LaneKind::amplitude, bands - 1});
    auto* viewport = last.findParentComponentOfClass<juce::Viewport>();
    REQUIRE(viewport != nullptr);
    const auto isSeen = [&](const juce::Component& row)
    {
        return viewport->getLocalBounds().contains(viewport->getLocalArea(&row, row.getLocalBounds()));
    };
    REQUIRE_FALSE(isSeen(last));
    editor::EditorView::scrollIntoView(last);
    CHECK(isSeen(last));
    const auto place = viewport->getViewPosition();
    editor::EditorView::scrollIntoView(last);
    CHECK(viewport->getViewPosition() == place);
    editor::EditorView::scrollIntoView(first);
    CHECK(isSeen(first));
}
