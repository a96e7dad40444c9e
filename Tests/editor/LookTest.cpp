// What the look promises of every window: text is cut, not squeezed; figures are equally wide; knobs show their value.

#include "editor/Bench.h"
#include "editor/Icons.h"
#include "editor/LineBreaks.h"
#include "editor/Text.h"
#include "editor/Translation.h"

#include <set>

using namespace pacini;
using namespace pacini::test;

namespace
{
juce::Image pictureOf(juce::Component& component)
{
    return component.createComponentSnapshot(component.getLocalBounds(), true, 1.0f);
}

int pixelsOf(const juce::Image& image, juce::Colour colour)
{
    int count = 0;
    for (int y = 0; y < image.getHeight(); ++y)
        for (int x = 0; x < image.getWidth(); ++x)
        {
            const auto pixel = image.getPixelAt(x, y);
            const auto close = [](int a, int b)
            {
                return std::abs(a - b) < 12;
            };
            count += close(pixel.getRed(), colour.getRed()) && close(pixel.getGreen(), colour.getGreen()) &&
                             close(pixel.getBlue(), colour.getBlue())
                         ? 1
                         : 0;
        }
    return count;
}

struct Knob
{
    juce::ScopedJuceInitialiser_GUI gui;
    editor::Look look;
    juce::Slider slider{juce::Slider::RotaryHorizontalVerticalDrag, juce::Slider::TextBoxBelow};

    Knob()
    {
        slider.setLookAndFeel(&look);
        slider.setBounds(0, 0, 80, 100);
    }
    ~Knob() { slider.setLookAndFeel(nullptr); }

    int arcAt(double value)
    {
        slider.setValue(value, juce::dontSendNotification);
        return pixelsOf(pictureOf(slider), look.palette().accent);
    }
};
} // namespace

TEST_CASE("A knob's arc grows with the value, from the least, or to both sides of 0")
{
    Knob knob;
    knob.slider.setRange(0.0, 1.0);
    CHECK(knob.arcAt(0.0) == 0);
    const int half = knob.arcAt(0.5), whole = knob.arcAt(1.0);
    CHECK(half > 20);
    CHECK(whole > half * 3 / 2);
    knob.slider.setRange(-12.0, 12.0);
    const int rest = knob.arcAt(0.0), down = knob.arcAt(-12.0), up = knob.arcAt(12.0);
    CHECK(down > 3 * rest);
    CHECK(std::abs(down - up) < 12 + down / 8);
}

TEST_CASE("A knob is at least 32 points wide with its number right below it, in a tall box as well")
{
    Knob knob;
    for (const int height : {56, 100, 300})
    {
        CAPTURE(height);
        knob.slider.setBounds(0, 0, 80, height);
        const auto layout = knob.look.getSliderLayout(knob.slider);
        CHECK(layout.sliderBounds.getWidth() >= editor::space::leastKnob);
        CHECK(layout.textBoxBounds.getY() == layout.sliderBounds.getBottom());
        CHECK(layout.textBoxBounds.getBottom() <= height);
    }
}

TEST_CASE("Figures are equally wide in every size of type, and there are four sizes")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    editor::installFonts();
    std::set<float> sizes;
    for (const juce::Font& font :
         {editor::captionFont(), editor::smallFont(), editor::usualFont(), editor::titleFont()})
    {
        sizes.insert(font.getHeight());
        if (editor::hasEmbeddedFont())
            for (const char* figure : {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"})
                CHECK(font.getStringWidthFloat(figure) == Approx(font.getStringWidthFloat("8")));
    }
    CHECK(sizes.size() == 4);
}

TEST_CASE("Text that does not fit is cut with an ellipsis and never squeezed")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    editor::installFonts();
    CHECK(juce::Font::getDefaultMinimumHorizontalScaleFactor() == 1.0f);
    CHECK(juce::Label().getMinimumHorizontalScale() == 0.0f); // the default
}

TEST_CASE("Every icon draws something of its own, and the buttons with one have a name and a tooltip")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge"); // what is disabled cannot have the keyboard
    std::set<std::string> seen;
    int icons = 0;
    for (int i = 0; i <= static_cast<int>(editor::Icon::tick); ++i, ++icons)
    {
        juce::Image image(juce::Image::RGB, 16, 16, true, juce::SoftwareImageType());
        juce::Graphics g(image);
        g.setColour(juce::Colours::white);
        editor::drawIcon(g, static_cast<editor::Icon>(i), {0.0f, 0.0f, 16.0f, 16.0f});
        std::string pixels;
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                pixels += static_cast<char>(image.getPixelAt(x, y).getRed());
        seen.insert(pixels);
    }
    CHECK(static_cast<int>(seen.size()) == icons);
    int buttons = 0;
    const auto visit = [&](auto& self, juce::Component& parent) -> void
    {
        for (auto* child : parent.getChildren())
        {
            if (auto* button = dynamic_cast<editor::IconButton*>(child))
            {
                CAPTURE(button->getTitle());
                CHECK(button->getTitle().isNotEmpty());
                CHECK(button->getTooltip().isNotEmpty());
                CHECK(button->getWantsKeyboardFocus());
                ++buttons;
            }
            self(self, *child);
        }
    };
    visit(visit, bench.view);
    CHECK(buttons >= 6);
}

TEST_CASE("Tabs are as wide as their texts need, in every language, and buttons of the clip list are not cut")
{
    for (const char* code : {"en", "de"})
    {
        CAPTURE(code);
        const juce::ScopedJuceInitialiser_GUI gui;
        editor::useLanguage(code);
        {
            EditorBench bench;
            bench.openDemo("knock_wood_bridge");
            auto& tabs = bench.view.sidePanel().getTabbedButtonBar();
            for (int i = 0; i < tabs.getNumTabs(); ++i)
            {
                const auto text = tabs.getTabNames()[i];
                CHECK(tabs.getTabButton(i)->getWidth() >= editor::usualFont().getStringWidth(text) + 4);
            }
            bench.view.sidePanel().setCurrentTabIndex(2);
            for (const char* name : {"Duplicate", "Remove", "Group…"})
            {
                bool found = false;
                const auto wanted = editor::tr(juce::String::fromUTF8(name));
                const auto visit = [&](auto& self, juce::Component& parent) -> void
                {
                    for (auto* child : parent.getChildren())
                    {
                        auto* button = dynamic_cast<juce::TextButton*>(child);
                        if (button != nullptr && button->getButtonText() == wanted)
                        {
                            found = true;
                            CHECK(button->getWidth() >=
                                  editor::usualFont().getStringWidth(button->getButtonText()) + 8);
                        }
                        self(self, *child);
                    }
                };
                visit(visit, bench.view.sidePanel());
                CAPTURE(name);
                CHECK(found);
            }
        }
        editor::useLanguage("en");
    }
}

TEST_CASE("The text of a menu is one line, cut at its end, however tall the box is")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    editor::Look look;
    juce::ComboBox box;
    box.setLookAndFeel(&look);
    box.addItem("a long name of a format, which would fill two lines", 1);
    box.setSelectedId(1, juce::dontSendNotification);
    box.setBounds(0, 0, 160, 36);
    const auto picture = pictureOf(box);
    // One line of text leaves the rows at a quarter and three quarters of the height empty.
    for (const int y : {7, 28})
        for (int x = 12; x < 120; ++x)
        {
            CAPTURE(x, y);
            REQUIRE(picture.getPixelAt(x, y) == picture.getPixelAt(12, y));
        }
    box.setLookAndFeel(nullptr);
}

TEST_CASE("A text without spaces is broken where it would be cut, and no line begins with a mark that closes")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    const juce::String text =
        editor::toText("私は自分の意思で参加し、理由を述べずにいつでも中止できることを理解しています。"
                       "回答は仮名（Weber 2020）で保存されます。\n終わり");
    const auto font = editor::usualFont();
    for (const float width : {80.0f, 200.0f, 333.0f})
    {
        const auto broken = editor::withLineBreaks(text, font, width);
        CHECK(broken.removeCharacters("\n") == text.removeCharacters("\n"));
        const auto lines = juce::StringArray::fromLines(broken);
        CHECK(lines.size() > 2);
        for (const auto& line : lines)
        {
            CAPTURE(line);
            CHECK(font.getStringWidthFloat(line) <= width + (line.containsChar('W') ? 80.0f : 0.0f));
            CHECK_FALSE(line.startsWith(editor::toText("、")));
            CHECK_FALSE(line.startsWith(editor::toText("。")));
        }
    }
    CHECK(editor::withLineBreaks("In English, spaces are enough to break a line", font, 60.0f) ==
          "In English, spaces are enough to break a line");
}

TEST_CASE("Buttons that end the rows of the export end below each other")
{
    EditorBench bench;
    bench.openDemo("impact_boom");
    REQUIRE(bench.view.doCommand(editor::exportClips));
    auto& sheet = *bench.view.sheet();
    const int also = get<juce::Button>(sheet, "Further formats").getRight();
    for (juce::Component* child : sheet.getChildren())
        if (const auto* button = dynamic_cast<juce::TextButton*>(child);
            button != nullptr && button->getButtonText() == editor::toText("Browse…"))
            CHECK(button->getRight() == also);
    CHECK(get<juce::ComboBox>(sheet, "Format").getRight() < also);
}
