// A language that no font can show is told of at every door that has a language.

#include "editor/LanguageProblem.h"

#include "editor/Bench.h"
#include "editor/Fonts.h"
#include "editor/Translation.h"
#include "editor/clip/sheets/PreferencesSheet.h"
#include "editor/study/StudyPage.h"
#include "support/TempFolder.h"

#include <iostream>
#include <sstream>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// A system without a font of Japanese, or one with it, whatever is installed.
struct Fonts
{
    explicit Fonts(bool there) { editor::assumeJapaneseFont(there); }
    ~Fonts()
    {
        editor::assumeJapaneseFont({});
        editor::useLanguage("en");
    }
};

class NoDevice final : public study::TrialPlayer
{
public:
    [[nodiscard]] int sampleRate() const override { return 48000; }
    void play(study::TrialSound) override {}
    void stop() override {}
    [[nodiscard]] study::PlaybackReport report() const override { return {}; }
};

bool says(juce::Component& within, const juce::String& text)
{
    if (within.getDescription().contains(text))
        return true;
    if (const auto* label = dynamic_cast<juce::Label*>(&within); label != nullptr && label->getText().contains(text))
        return true;
    if (const auto* shown = dynamic_cast<editor::Paragraph*>(&within); shown != nullptr && shown->text().contains(text))
        return true;
    for (auto* child : within.getChildren())
        if (says(*child, text))
            return true;
    return false;
}

std::string printed()
{
    const std::ostringstream caught;
    auto* const usual = std::cerr.rdbuf(caught.rdbuf());
    editor::tellLanguageProblem("PaciniEditor");
    std::cerr.rdbuf(usual);
    return caught.str();
}
} // namespace

TEST_CASE("Japanese without a font for it is English, and the terminal and the window tell what to install")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    const Fonts none(false);
    editor::useLanguage("ja");
    CHECK(editor::languageInUse() == "en");
    CHECK(editor::languageProblem().contains("Japanese needs a font"));
    CHECK(printed().starts_with("PaciniEditor: language ja: Japanese needs a font. Install"));
    EditorBench bench;
    CHECK(says(bench.view, "Japanese needs a font"));
}

TEST_CASE("Nothing is told of languages that are shown, and of a system's language without texts")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    const Fonts some(true);
    for (const char* code : {"en", "de", "ja", "de_DE.UTF-8"})
    {
        CAPTURE(code);
        editor::useLanguage(code);
        CHECK(editor::languageInUse() == juce::String(code).substring(0, 2));
        CHECK(editor::languageProblem().isEmpty());
        CHECK(printed().empty());
    }
    editor::useLanguage("xx");
    CHECK(editor::languageInUse() == "en");
    CHECK(printed() == "PaciniEditor: language xx: There are no texts in xx, so it is English. Choose en or one of de, "
                       "ja.\n");
}

TEST_CASE("Preferences tell what a language needs when it is chosen, in the language of the window")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    const Fonts none(false);
    for (const auto& [code, told] : {std::pair("en", "Japanese needs a font"), std::pair("de", "braucht eine Schrift")})
    {
        editor::useLanguage(code);
        EditorBench bench;
        editor::HostServices around;
        juce::String chosen;
        around.language = code;
        around.chooseLanguage = [&chosen](const juce::String& wanted)
        {
            chosen = wanted;
        };
        editor::EditorView view(bench.session, around);
        view.setBounds(0, 0, 1280, 800);
        REQUIRE(view.doCommand(editor::preferences));
        auto& sheet = *view.sheet();
        auto& box = get<juce::ComboBox>(sheet, editor::tr("Language"));
        CHECK_FALSE(says(sheet, told));
        box.setSelectedId(1 + 1 + editor::languages().indexOf("ja"), juce::sendNotificationSync);
        CHECK(chosen == "ja");
        CHECK(says(sheet, told));
        box.setSelectedId(1, juce::sendNotificationSync);
        CHECK_FALSE(says(sheet, told));
    }
}

TEST_CASE("The set-up of a study tells that its language cannot be shown, before anybody reads it")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    const Fonts none(false);
    const TempFolder folder;
    NoDevice device;
    study::Study study;
    study.name = "tones";
    study.groups = {{"all", 1}};
    study.welcome = {{"en", "Hello"}, {"ja", "\xe3\x82\x88\xe3\x81\x86\xe3\x81\x93\xe3\x81\x9d"}};
    editor::StudyServices services;
    services.player = &device;
    editor::StudyPage page({study, folder.path()}, services);
    page.setBounds(0, 0, 1280, 800);
    auto& box = get<juce::ComboBox>(page, "Language");
    CHECK(box.getItemText(1) == "Japanese (needs a font)");
    CHECK_FALSE(says(page, "needs a font. "));
    box.setSelectedId(2, juce::sendNotificationSync);
    CHECK(says(page, "needs a font. "));
    box.setSelectedId(1, juce::sendNotificationSync);
    CHECK_FALSE(says(page, "needs a font. "));
}
