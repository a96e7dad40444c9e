// The keyboard is always seen: each stop of Tab has a ring in both themes and is scrolled into view, and it is never
// behind a sheet.

#include "editor/Bench.h"
#include "editor/Pump.h"
#include "editor/ShownWindow.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
juce::Component* focused()
{
    return juce::Component::getCurrentlyFocusedComponent();
}

juce::String nameOf(const juce::Component* component)
{
    if (component == nullptr)
        return "nothing";
    juce::String name(component->getTitle().isNotEmpty() ? component->getTitle() : component->getName());
    if (const auto* button = dynamic_cast<const juce::Button*>(component); button != nullptr && name.isEmpty())
        name = button->getButtonText();
    for (const auto* at = component->getParentComponent(); at != nullptr && name.length() < 60;
         at = at->getParentComponent())
        if (at->getTitle().isNotEmpty())
            name = at->getTitle() + " / " + name;
    return name;
}

/// The pixels of a component and a little around it.
juce::Image pictureOf(juce::Component& window, const juce::Component& of)
{
    const auto area =
        window.getLocalArea(&of, of.getLocalBounds()).expanded(4).getIntersection(window.getLocalBounds());
    return window.createComponentSnapshot(area, true, 1.0f);
}

int differingPixels(const juce::Image& a, const juce::Image& b)
{
    if (a.getBounds() != b.getBounds())
        return 0;
    int count = 0;
    for (int y = 0; y < a.getHeight(); ++y)
        for (int x = 0; x < a.getWidth(); ++x)
        {
            const auto p = a.getPixelAt(x, y), q = b.getPixelAt(x, y);
            const int most = std::max({std::abs(p.getRed() - q.getRed()), std::abs(p.getGreen() - q.getGreen()),
                                       std::abs(p.getBlue() - q.getBlue())});
            count += most > 24 ? 1 : 0;
        }
    return count;
}

/// As the system tells it: to what has the keyboard, then to what is around that.
void pressTab(bool back = false)
{
    if (auto* peer = focused() != nullptr ? focused()->getPeer() : nullptr)
        peer->handleKeyPress(juce::KeyPress(
            juce::KeyPress::tabKey, back ? juce::ModifierKeys::shiftModifier : juce::ModifierKeys::noModifiers, '\t'));
}

/// Each stop of Tab from where the keyboard is until it comes round.
std::vector<juce::Component::SafePointer<juce::Component>> stops()
{
    std::vector<juce::Component::SafePointer<juce::Component>> all;
    for (int i = 0; i < 400; ++i)
    {
        auto* now = focused();
        if (now == nullptr || std::any_of(all.begin(), all.end(), [now](const auto& one) { return one == now; }))
            break;
        all.emplace_back(now);
        pressTab();
    }
    return all;
}

/// What can be seen of it is a good part: half of it, or of something long as much as a page shows.
bool isSeen(const juce::Component& window, const juce::Component& one)
{
    auto shown = window.getLocalArea(&one, one.getLocalBounds());
    for (const auto* at = one.getParentComponent(); at != nullptr && at != &window; at = at->getParentComponent())
        shown = shown.getIntersection(window.getLocalArea(at, at->getLocalBounds()));
    shown = shown.getIntersection(window.getLocalBounds());
    return 2 * shown.getHeight() >= std::min(one.getHeight(), 200) &&
           2 * shown.getWidth() >= std::min(one.getWidth(), 200);
}

/// The keyboard goes to the first stop inside.
void enter(juce::Component& container)
{
    const auto traverser = container.createKeyboardFocusTraverser();
    if (auto* first = traverser->getDefaultComponent(&container))
        first->grabKeyboardFocus();
}

/// What is told of stops that nobody sees.
void addUnseen(juce::Component& window, const juce::String& where, juce::StringArray& found)
{
    const int leastRing = 20;
    const auto all = stops();
    if (all.empty())
        found.addIfNotAlreadyThere(where + ": has no stop");
    for (const auto& stop : all)
    {
        if (stop == nullptr)
            continue;
        juce::Component& one = *stop.getComponent();
        one.grabKeyboardFocus();
        if (focused() != &one)
            continue; // was disabled meanwhile
        // JUCE tells of a change of the keyboard a little later.
        const juce::Component::SafePointer<juce::Component> watched(&one);
        if (!isSeen(window, one) && !pumpUntil([&] { return watched == nullptr || isSeen(window, *watched); }, 1.0))
            found.addIfNotAlreadyThere(where + ": out of sight: " + nameOf(&one));
        if (watched == nullptr)
            continue;
        const auto with = pictureOf(window, one);
        juce::Component::unfocusAllComponents();
        if (differingPixels(with, pictureOf(window, one)) < leastRing)
            found.addIfNotAlreadyThere(where + ": no ring: " + nameOf(&one));
    }
}
} // namespace

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
    const auto isInView = [&](const juce::Component& row)
    {
        return viewport->getLocalBounds().contains(viewport->getLocalArea(&row, row.getLocalBounds()));
    };
    REQUIRE_FALSE(isInView(last));
    editor::EditorView::scrollIntoView(last);
    CHECK(isInView(last));
    const auto place = viewport->getViewPosition();
    editor::EditorView::scrollIntoView(last);
    CHECK(viewport->getViewPosition() == place);
    editor::EditorView::scrollIntoView(first);
    CHECK(isInView(first));
}

TEST_CASE("Every stop of Tab is in sight and has a ring, on all pages and sheets, dark and light")
{
    juce::StringArray found;
    for (const bool dark : {true, false})
    {
        EditorBench bench({shipped("lra-175"), shipped("l5-wristband")});
        bench.view.setBounds(0, 0, 1024, 640);
        bench.view.setDark(dark);
        ShownWindow window(bench.view);
        const juce::String theme = dark ? "dark " : "light ";
        enter(bench.view);
        addUnseen(window, theme + "start", found);
        bench.openDemo("drums_tabla_pattern");
        for (int page = 0; page < bench.view.sidePanel().getNumTabs(); ++page)
        {
            bench.view.sidePanel().setCurrentTabIndex(page);
            enter(bench.view);
            addUnseen(window, theme + "page " + juce::String(page), found);
        }
        for (const auto& [name, command] : sheetCommands)
        {
            bench.view.grabKeyboardFocus();
            if (!bench.view.doCommand(command) || bench.view.sheet() == nullptr)
                continue;
            addUnseen(window, theme + name, found);
            bench.view.showSheet(nullptr);
        }
    }
    INFO(found.joinIntoString("\n"));
    CHECK(found.isEmpty());
}

TEST_CASE("Tab goes into a window that has the keyboard itself, as after the start and behind a sheet")
{
    EditorBench bench({shipped("lra-175"), shipped("l5-wristband")});
    bench.view.setBounds(0, 0, 1280, 800);
    ShownWindow window(bench.view);
    for (const bool opened : {false, true})
    {
        if (opened)
            bench.openDemo("drums_tabla_pattern");
        for (const bool back : {false, true})
        {
            CAPTURE(opened, back);
            bench.view.takeFocus();
            REQUIRE(focused() == &bench.view);
            pressTab(back);
            CAPTURE(nameOf(focused()));
            CHECK((focused() != &bench.view && bench.view.isParentOf(focused())));
            auto* first = focused();
            pressTab(back);
            CHECK((focused() != first && bench.view.isParentOf(focused())));
        }
    }
    for (const auto& [name, command] : sheetCommands)
    {
        CAPTURE(name);
        bench.view.takeFocus();
        if (!bench.view.doCommand(command) || bench.view.sheet() == nullptr)
            continue;
        auto& sheet = *bench.view.sheet();
        sheet.grabKeyboardFocus();
        REQUIRE(focused() == &sheet);
        pressTab();
        CAPTURE(nameOf(focused()));
        CHECK(sheet.isParentOf(focused()));
        bench.view.showSheet(nullptr);
        pressTab();
        CHECK((focused() != &bench.view && bench.view.isParentOf(focused())));
    }
}

TEST_CASE("A sheet has the keyboard and keeps it, and Escape gives it back to what had it")
{
    EditorBench bench({shipped("lra-175"), shipped("l5-wristband")});
    bench.view.setBounds(0, 0, 1280, 800);
    ShownWindow window(bench.view);
    bench.openDemo("drums_tabla_pattern");
    for (const auto& [name, command] : sheetCommands)
    {
        CAPTURE(name);
        auto& row = bench.row({LaneKind::amplitude, 0});
        row.grabKeyboardFocus();
        REQUIRE(focused() == &row);
        if (!bench.view.doCommand(command) || bench.view.sheet() == nullptr)
            continue;
        auto* sheet = bench.view.sheet();
        CAPTURE(nameOf(focused()));
        CHECK((focused() == sheet || sheet->isParentOf(focused())));
        for (const auto& stop : stops())
        {
            if (stop == nullptr)
                continue; // a list that was made anew
            CAPTURE(nameOf(stop.getComponent()));
            CHECK((stop.getComponent() == sheet || sheet->isParentOf(stop.getComponent())));
        }
        juce::Component* at = focused();
        bool used = false;
        for (; at != nullptr && !used; at = at->getParentComponent())
            used = at->keyPressed(juce::KeyPress(juce::KeyPress::escapeKey));
        CHECK(used);
        CHECK(pumpUntil([&] { return bench.view.sheet() == nullptr; }));
        CAPTURE(nameOf(focused()));
        CHECK(focused() == &row);
        bench.view.showSheet(nullptr);
    }
}

namespace
{
/// Counts how often a component is asked to be drawn again.
struct Redraws final : juce::CachedComponentImage
{
    explicit Redraws(int& counted) : count(counted) {}
    void paint(juce::Graphics&) override {}
    bool invalidateAll() override { return ++count, true; }
    bool invalidate(const juce::Rectangle<int>&) override { return ++count, true; }
    void releaseResources() override {}
    int& count;
};
} // namespace

TEST_CASE("A ring is drawn when a component gets the keyboard, and goes when it loses it")
{
    EditorBench bench({shipped("lra-175"), shipped("l5-wristband")});
    bench.view.setBounds(0, 0, 1280, 800);
    ShownWindow window(bench.view);
    bench.openDemo("drums_tabla_pattern");
    const auto check = [&](juce::Component& in)
    {
        for (const auto& stop : stops())
        {
            if (stop == nullptr || !in.isParentOf(stop.getComponent()) || !stop->isShowing())
                continue;
            CAPTURE(nameOf(stop.getComponent()));
            int count = 0;
            in.grabKeyboardFocus();
            stop->setCachedComponentImage(new Redraws(count)); // which it owns
            stop->grabKeyboardFocus();
            CHECK(count > 0);
            count = 0;
            bench.view.grabKeyboardFocus();
            CHECK(count > 0);
            if (stop != nullptr)
                stop->setCachedComponentImage(nullptr);
        }
    };
    check(bench.view);
    REQUIRE(bench.view.doCommand(editor::editScene));
    check(*bench.view.sheet());
}
