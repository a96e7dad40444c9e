// The mouse wheel over controls of pages that are scrolled.

#include "editor/Bench.h"
#include "editor/Controls.h"
#include "editor/clip/panels/AnalysisPanel.h"
#include "editor/clip/scene/SceneSheet.h"
#include "editor/clip/sheets/OutputsSheet.h"
#include "editor/measure/MeasurePage.h"
#include "support/Paths.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// A notch of a wheel, each at a time of its own: JUCE leaves out what is told twice.
void turn(juce::Component& over)
{
    static double time = 1000.0;
    const juce::Time now(static_cast<juce::int64>(time += 100.0));
    const juce::MouseEvent event(juce::Desktop::getInstance().getMainMouseSource(), {4.0f, 4.0f}, {}, 0.0f, 0.0f, 0.0f,
                                 0.0f, 0.0f, &over, &over, now, {4.0f, 4.0f}, now, 0, false);
    juce::MouseWheelDetails wheel{};
    wheel.deltaY = -0.5f;
    over.mouseWheelMove(event, wheel);
}

/// Turns the wheel over all sliders and choices inside; those in scrolled pages keep what they say. How many there are.
int checkAll(juce::Component& inside)
{
    int count = 0;
    for (juce::Component* child : inside.getChildren())
    {
        const bool scrolled = child->findParentComponentOfClass<juce::Viewport>() != nullptr;
        CAPTURE(child->getTitle());
        if (auto* slider = dynamic_cast<juce::Slider*>(child); slider != nullptr && scrolled)
        {
            slider->setEnabled(true);
            slider->setValue(0.5 * (slider->getMinimum() + slider->getMaximum()), juce::dontSendNotification);
            const double before = slider->getValue();
            turn(*slider);
            CHECK(slider->getValue() == before);
            ++count;
        }
        if (auto* box = dynamic_cast<juce::ComboBox*>(child); box != nullptr && scrolled)
        {
            const int before = box->getSelectedId();
            turn(*box);
            CHECK(box->getSelectedId() == before);
            ++count;
        }
        count += checkAll(*child);
    }
    return count;
}
} // namespace

TEST_CASE("A wheel over controls of a scrolled page scrolls it and changes nothing", "[wheel]")
{
    EditorBench bench({shipped("lra-175")});
    bench.view.setSize(1000, 560); // the pages are longer than that
    bench.openDemo("drums_tabla_pattern");
    const auto encoder = bench.session.model.item()->encoder;
    auto* tabs = [&]
    {
        juce::TabbedComponent* found = nullptr;
        const auto look = [&](auto& self, juce::Component& in) -> void
        {
            for (auto* child : in.getChildren())
            {
                if (auto* one = dynamic_cast<juce::TabbedComponent*>(child))
                    found = one;
                self(self, *child);
            }
        };
        look(look, bench.view);
        return found;
    }();
    REQUIRE(tabs != nullptr);
    int count = 0, moved = 0;
    for (int page = 0; page < tabs->getNumTabs(); ++page)
    {
        tabs->setCurrentTabIndex(page);
        count += checkAll(*tabs);
        auto* view = dynamic_cast<juce::Viewport*>(tabs->getCurrentContentComponent());
        REQUIRE(view != nullptr);
        moved += view->getViewPositionY() > 0 ? 1 : 0;
    }
    CHECK(count > 10);
    CHECK(moved > 0);
    CHECK(bench.session.model.item()->encoder == encoder);
    CHECK_FALSE(bench.session.sounds.workNow());
    REQUIRE(bench.view.doCommand(editor::measureActuator));
    auto* page = dynamic_cast<editor::MeasurePage*>(bench.view.sheet());
    REQUIRE(page != nullptr);
    CHECK(checkAll(*page) > 5);
    bench.view.showSheet(nullptr);
}

TEST_CASE("All sliders of all windows leave the wheel to pages that are scrolled", "[wheel]")
{
    // A slider of JUCE's own would not.
    const std::regex own(R"((^|[^&*:\w])juce::Slider\s+\w+[,;{(]|<juce::Slider>|public juce::Slider\b)");
    int files = 0;
    for (const char* room : {"Source/editor", "Source/app", "Source/plugin"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(sourceFolder() / room))
        {
            const auto name = entry.path().filename();
            if ((entry.path().extension() != ".h" && entry.path().extension() != ".cpp") || name == "Controls.h")
                continue;
            std::ifstream file(entry.path());
            const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
            CAPTURE(entry.path().string());
            CHECK_FALSE(std::regex_search(text, own));
            CHECK(text.find("setScrollWheelEnabled(true)") == std::string::npos);
            ++files;
        }
    CHECK(files > 200);
}
