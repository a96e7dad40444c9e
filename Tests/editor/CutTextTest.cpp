// No text of the windows is cut, in any language, from the least size of the window on.

#include "editor/Bench.h"
#include "editor/Fonts.h"
#include "editor/PaintedText.h"
#include "editor/Translation.h"
#include "editor/clip/session/ClipSteps.h"

#include <array>
#include <utility>

#if JUCE_LINUX && JUCE_MAJOR_VERSION < 8

using namespace pacini;
using namespace pacini::test;

namespace
{
struct InLanguage
{
    explicit InLanguage(const char* code) { editor::useLanguage(code); }
    ~InLanguage() { editor::useLanguage("en"); }
};

/// The languages that a font of this system can show.
std::vector<const char*> shownLanguages()
{
    std::vector<const char*> codes{"en", "de"};
    if (editor::canShow("ja"))
        codes.push_back("ja");
    return codes;
}

const std::array sizes{std::pair(880, 560), std::pair(1024, 700), std::pair(1280, 800)};
constexpr int tall = 2000; // with everything that has to be scrolled to
} // namespace

TEST_CASE("Text that has no room is found wherever it is painted, and menus are asked for all of their items")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    editor::Look look;
    juce::Component page;
    page.setLookAndFeel(&look);
    page.setSize(400, 200);
    juce::TextButton button("a long text of a button");
    juce::ComboBox box;
    box.setTitle("Box");
    box.addItemList({"short", "a long text of a menu, which nothing shows"}, 1);
    box.setSelectedId(1, juce::dontSendNotification);
    page.addAndMakeVisible(button);
    page.addAndMakeVisible(box);
    juce::StringArray cut, items;
    button.setBounds(0, 0, 300, 24);
    box.setBounds(0, 40, 100, 24);
    addCutTexts(page, "page", {}, cut);
    CHECK(cut.isEmpty());
    addCutItems(page, "page", {}, items);
    CHECK(items == juce::StringArray("page, Box: a long text of a menu, which nothing shows"));
    button.setSize(60, 24);
    addCutTexts(page, "page", {}, cut);
    CHECK(cut.size() == 1);
    page.setLookAndFeel(nullptr);
}

TEST_CASE("No text of the editor's pages and sheets is cut and no control lies on another, in any language and size")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    juce::StringArray found;
    for (const char* code : shownLanguages())
    {
        const InLanguage language(code);
        for (const auto& [width, height] : sizes)
        {
            const juce::String where = juce::String(code) + " " + juce::String(width);
            EditorBench bench({shipped("lra-175"), shipped("phone-taptic")});
            const auto look = [&](const juce::String& what)
            {
                addCutTexts(bench.view, where + " " + what, {"knock_wood_bridge"}, found);
                addCutItems(bench.view, where + " " + what, {}, found);
                addOverlaps(bench.view, where + " " + what, found);
            };
            bench.view.setBounds(0, 0, width, height);
            look("start");
            bench.openDemo("knock_wood_bridge");
            Clip named = bench.clip();
            named.name = std::string("short");
            REQUIRE(editor::setClip(bench.session.model, "Name", named));
            bench.session.actuators.setProfile("lra-175");
            look("clip");
            bench.view.setBounds(0, 0, width, tall);
            for (int page = 0; page < bench.view.sidePanel().getNumTabs(); ++page)
            {
                bench.view.sidePanel().setCurrentTabIndex(page);
                look("page " + juce::String(page));
            }
            bench.view.doCommand(editor::selectAll);
            bench.view.sidePanel().setCurrentTabIndex(0);
            look("selection");
            bench.view.setBounds(0, 0, width, height);
            for (const auto& [name, command] : sheetCommands)
            {
                if (!bench.view.doCommand(command) || bench.view.sheet() == nullptr)
                    continue;
                look(name);
                bench.view.showSheet(nullptr);
            }
        }
    }
    INFO(found.joinIntoString("\n"));
    CHECK(found.isEmpty());
}
#endif
