// Windows open inside the screen that there is.

#include "app/WindowPlace.h"

#include "support/Catch.h"

using namespace pacini;

TEST_CASE("A window opens inside the screen there is, with its title bar")
{
    using app::insideOf;
    const juce::Rectangle<int> laptop(0, 0, 1280, 800), desktop(0, 24, 2560, 1416);
    const auto room = laptop.withTrimmedTop(app::usualTitleBar);
    CHECK(room.contains(insideOf(laptop, {0, 0, 1280, 800})));       // the first start
    CHECK(room.contains(insideOf(laptop, {1400, 900, 1900, 1200}))); // kept on a larger screen
    CHECK(room.contains(insideOf(laptop, {-900, -300, 1000, 700}))); // kept on a screen at the left
    CHECK(insideOf(desktop, {300, 200, 1280, 800}) == juce::Rectangle<int>(300, 200, 1280, 800)); // as it was
    CHECK(app::fills(laptop, insideOf(laptop, laptop)));
    CHECK_FALSE(app::fills(desktop, {300, 200, 1280, 800}));
}

TEST_CASE("A window that is larger than the screen even at its least size is drawn as large as fits")
{
    const juce::Rectangle<int> screen(0, 0, 1280, 800);
    CHECK(app::scaleThatFits(screen, {936.0f, 650.0f}) == 1.0f);
    for (const auto& least : {juce::Point<float>(1872.0f, 1300.0f), juce::Point<float>(1404.0f, 975.0f)})
    {
        const float scale = app::scaleThatFits(screen, least);
        CHECK(scale < 1.0f);
        CHECK(least.x * scale <= 1280.5f);
        CHECK(least.y * scale <= 800.5f - app::usualTitleBar);
        CHECK((least.x * scale > 1279.0f || least.y * scale > 799.0f - app::usualTitleBar));
    }
    CHECK(app::scaleThatFits({0, 0, 1, 1}, {936.0f, 650.0f}) > 0.0f);
}
