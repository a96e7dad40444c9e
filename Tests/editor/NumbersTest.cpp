// Numbers in windows have the decimal mark of the language, shown and typed.

#include "editor/Bench.h"
#include "editor/Controls.h"
#include "editor/Pump.h"
#include "editor/Translation.h"
#include "editor/clip/lanes/LaneText.h"
#include "editor/clip/session/ClipSteps.h"

#include <cstdlib>
#include <map>
#include <optional>
#include <regex>
#include <string>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// German until the end of the test.
struct German
{
    German() { editor::useLanguage("de"); }
    ~German() { editor::useLanguage("en"); }
};

/// All texts that a component and those inside it show or say.
void collect(const juce::Component& component, juce::StringArray& texts)
{
    texts.add(component.getTitle());
    texts.add(component.getDescription());
    if (const auto* label = dynamic_cast<const juce::Label*>(&component))
        texts.add(label->getText());
    if (const auto* button = dynamic_cast<const juce::Button*>(&component))
        texts.add(button->getButtonText());
    if (const auto* field = dynamic_cast<const juce::TextEditor*>(&component))
        texts.add(field->getText());
    if (const auto* box = dynamic_cast<const juce::ComboBox*>(&component))
        for (int i = 0; i < box->getNumItems(); ++i)
            texts.add(box->getItemText(i));
    if (auto* slider = dynamic_cast<juce::Slider*>(const_cast<juce::Component*>(&component)))
        texts.add(slider->getTextFromValue(slider->getValue()));
    for (const auto* child : component.getChildren())
        collect(*child, texts);
}
} // namespace

TEST_CASE("A number has the decimal mark of the language, and only between two digits")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    CHECK(editor::numberText(1.5, 2) == "1.50");
    CHECK(editor::withDecimalMark("-3.5 dB") == "-3.5 dB");
    const German german;
    CHECK(editor::numberText(1.5, 2) == "1,50");
    CHECK(editor::numberText(-0.04, 1) == "0,0");
    CHECK(editor::numberText(1234.0, 0) == "1234");
    for (const auto& [given, wanted] :
         std::initializer_list<std::pair<const char*, const char*>>{{"-3.5 dB", "-3,5 dB"},
                                                                    {"0.1 to 2.5 s", "0,1 to 2,5 s"},
                                                                    {"Pacini 0.1.0", "Pacini 0.1.0"},
                                                                    {"one. 2 three", "one. 2 three"},
                                                                    {".5", ".5"},
                                                                    {"5.", "5."},
                                                                    {"", ""},
                                                                    {"1..2", "1..2"}})
        CHECK(editor::withDecimalMark(given) == juce::String(wanted));
    CHECK(editor::hertzText(52.34) == "52,3 Hz");
    CHECK(editor::amplitudeText(0.5) == "-6,0 dB");
}

#if JUCE_LINUX
TEST_CASE("The system's language is that of its locale, in the order that locales have")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    const auto before = [](const char* name)
    {
        const char* value = std::getenv(name);
        return value != nullptr ? std::optional<std::string>(value) : std::nullopt;
    };
    const std::map<std::string, std::optional<std::string>> saved{
        {"LC_ALL", before("LC_ALL")}, {"LC_MESSAGES", before("LC_MESSAGES")}, {"LANG", before("LANG")}};
    const auto in = [](const char* all, const char* messages, const char* language)
    {
        setenv("LC_ALL", all, 1);
        setenv("LC_MESSAGES", messages, 1);
        setenv("LANG", language, 1);
        editor::useLanguage({});
        return editor::languageInUse().toStdString();
    };
    CHECK(in("", "", "de_DE.UTF-8") == "de");
    CHECK(in("", "de_AT.UTF-8", "en_GB.UTF-8") == "de");
    CHECK(in("C", "de_DE.UTF-8", "de_DE.UTF-8") == "en");
    CHECK(in("", "", "C.UTF-8") == "en");
    CHECK(in("", "", "") == "en");
    if (editor::canShow("ja"))
        CHECK(in("ja_JP.UTF-8", "", "de_DE.UTF-8") == "ja");
    for (const auto& [name, value] : saved)
        value ? setenv(name.c_str(), value->c_str(), 1) : unsetenv(name.c_str());
    editor::useLanguage("en");
}
#endif

TEST_CASE("A comma and a point count in what is typed")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    for (const char* typed : {"2,5", "2.5", "2,5 dB", " 2.5 dB", "2,50"})
    {
        CAPTURE(typed);
        const German german;
        editor::Slider slider;
        slider.setRange(0.0, 10.0, 0.1);
        slider.setTextValueSuffix(" dB");
        CHECK(slider.getValueFromText(typed) == Approx(2.5));
        slider.setValue(2.5, juce::dontSendNotification);
        CHECK(slider.getTextFromValue(slider.getValue()) == "2,5 dB");
    }
}

TEST_CASE("Fields of the German inspector show and take decimal commas")
{
    const German german;
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    const auto clip = bench.clip();
    REQUIRE(clip.transients.size() > 2);
    bench.session.clipSelection.select(Selection{{}, {1}});
    auto& field = get<juce::Label>(bench.view, editor::tr("Selection time"));
    CHECK(field.getText().containsChar(','));
    CHECK_FALSE(field.getText().containsChar('.'));
    const double wanted = clip.transients[1].time + 0.0125;
    field.setText(editor::numberText(wanted, 4) + " s", juce::sendNotificationSync);
    CHECK(bench.clip().transients[1].time == Approx(wanted).margin(0.001));
}

TEST_CASE("No text of the German window has a number with a point")
{
    const German german;
    EditorBench bench({shipped("lra-175")});
    bench.openDemo("drums_tabla_pattern");
    bench.session.clipSelection.select(Selection{{}, {1}});
    const std::regex pointed(R"((^|[^\d.])\d+\.\d+([^\d.]|$))");
    for (int page = 0; page < bench.view.sidePanel().getNumTabs(); ++page)
    {
        bench.view.sidePanel().setCurrentTabIndex(page);
        pumpFor(0.1);
        juce::StringArray texts;
        collect(bench.view, texts);
        for (const auto& text : texts)
        {
            CAPTURE(page, text);
            CHECK_FALSE(std::regex_search(text.toStdString(), pointed));
        }
    }
}
