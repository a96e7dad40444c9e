// The tracks of sliders are long enough to set a value with the mouse, in every language and size of window.

#include "editor/Bench.h"
#include "editor/Tracks.h"
#include "editor/clip/panels/SidePanel.h"

#include <array>
#include <utility>

using namespace pacini;
using namespace pacini::test;

namespace
{
constexpr std::array sizes{std::pair(880, 560), std::pair(1024, 700), std::pair(1280, 800), std::pair(1920, 1080),
                           std::pair(2560, 1440)};
} // namespace

TEST_CASE("Every slider of the editor has a track of 80 points, in every language and size")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    juce::StringArray found;
    auto codes = editor::languages();
    codes.insert(0, "en");
    for (const auto& code : codes)
    {
        useTableOf(code);
        for (const auto& [width, height] : sizes)
        {
            const juce::String where = code + " " + juce::String(width);
            EditorBench bench({shipped("lra-175"), shipped("phone-taptic")});
            bench.view.setBounds(0, 0, width, height);
            bench.openDemo("knock_wood_bridge");
            bench.session.actuators.setProfile("lra-175");
            bench.view.doCommand(editor::selectAll);
            for (int page = 0; page < bench.view.sidePanel().getNumTabs(); ++page)
            {
                bench.view.sidePanel().setCurrentTabIndex(page);
                addShortTracks(bench.view, where + " page " + juce::String(page), found);
            }
            for (const auto& [name, command] : sheetCommands)
            {
                if (!bench.view.doCommand(command) || bench.view.sheet() == nullptr)
                    continue;
                addShortTracks(*bench.view.sheet(), where + " " + name, found);
                bench.view.showSheet(nullptr);
            }
        }
    }
    editor::useLanguage("en");
    INFO(found.joinIntoString("\n"));
    CHECK(found.isEmpty());
}

TEST_CASE("The name of a slider with the number above its track takes no clicks of the track, and moves back")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    bench.view.sidePanel().setCurrentTabIndex(3);
    auto& slider = get<juce::Slider>(bench.view.sidePanel(), "Gain");
    const auto nameIn = [](juce::Component& parent) -> juce::Label*
    {
        for (auto* child : parent.getChildren())
            if (auto* label = dynamic_cast<juce::Label*>(child); label != nullptr && label->getText() == "Gain")
                return label;
        return nullptr;
    };
    REQUIRE(slider.getTextBoxPosition() == juce::Slider::TextBoxAbove);
    auto* name = nameIn(slider);
    REQUIRE(name != nullptr);
    CHECK(slider.getComponentAt(name->getBounds().getCentre()) == name);
    CHECK(slider.getLookAndFeel().getSliderLayout(slider).sliderBounds.getY() >= name->getBottom());
    const double before = slider.getValue();
    auto& page = *slider.getParentComponent();
    page.setSize(500, page.getHeight());
    CHECK(slider.getTextBoxPosition() == juce::Slider::TextBoxRight);
    name = nameIn(page);
    REQUIRE(name != nullptr);
    CHECK(name->getRight() <= slider.getX());
    CHECK(slider.getValue() == before);
}
