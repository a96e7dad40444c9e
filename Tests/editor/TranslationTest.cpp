// The interface in other languages.

#include "editor/Translation.h"

#include "document/measure/MeasureWords.h"
#include "editor/Bench.h"
#include "editor/Text.h"
#include "editor/Unmarked.h"
#include "editor/clip/lanes/LaneText.h"

using namespace pacini;

namespace
{
/// English again at the end.
struct Language
{
    explicit Language(const char* code) { editor::useLanguage(code); }
    ~Language() { editor::useLanguage("en"); }
};

bool anyTooltip(const juce::Component& root, const juce::String& wanted)
{
    for (const auto* child : root.getChildren())
    {
        const auto* tip = dynamic_cast<const juce::SettableTooltipClient*>(child);
        if (child->getTitle() == wanted ||
            (tip != nullptr && const_cast<juce::SettableTooltipClient*>(tip)->getTooltip() == wanted))
            return true;
        if (anyTooltip(*child, wanted))
            return true;
    }
    return false;
}
} // namespace

TEST_CASE("Menus, buttons and pages are in the chosen language, and in English without one")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    const auto menuNames = [](editor::EditorView& view)
    {
        return static_cast<juce::MenuBarModel&>(view.menus()).getMenuBarNames();
    };
    {
        const Language german("de");
        test::EditorBench bench;
        CHECK(menuNames(bench.view).contains("Bearbeiten"));
        CHECK(bench.view.sidePanel().getTabNames().contains("Analyse"));
        CHECK(anyTooltip(bench.view, "Zum Anfang"));
        CHECK_FALSE(anyTooltip(bench.view, "Go to start"));
    }
    test::EditorBench bench;
    CHECK(menuNames(bench.view).contains("Edit"));
    CHECK(anyTooltip(bench.view, "Go to start"));
    const Language unknown("tlh");
    CHECK(editor::tr("Edit") == "Edit");
}

TEST_CASE("Lanes have designers' words in every language, by whichever name they are asked")
{
    const Language german("de");
    CHECK(editor::designerWord("Transients") == "Ereignisse");
    CHECK(editor::designerWord("Transienten") == "Ereignisse");
    CHECK(editor::designerWord("Schwerpunkt") == "Helligkeit");
    CHECK(editor::designerWord("864 Hz") == "864 Hz");
}

TEST_CASE("Every language has a name of its own")
{
    CHECK(editor::languages().joinIntoString(" ") == "de ja");
    CHECK(editor::languageName("de") == "Deutsch");
    CHECK(editor::languageName("ja") == editor::toText("日本語"));
}

TEST_CASE("Templates put values where the language has them, and messages are found by their template")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    CHECK(editor::tr("{0} of {1} were found there.", {"2", "5"}) == "2 of 5 were found there.");
    CHECK(editor::counted(1, "{0} point", "{0} points") == "1 point");
    CHECK(editor::translateMessage("Gain of +3.0 dB") == "Gain of +3.0 dB");
    editor::useTranslations(editor::toText("\"{0} of {1} files not opened\" = \"von {1} Dateien {0} nicht\"\n"
                                           "\"Gain of {0} dB\" = \"Verstärkung {0} dB\"\n"
                                           "\"Points of {0:text}\" = \"Punkte: {0:text}\"\n"
                                           "\"the band at {0} Hz\" = \"Band bei {0} Hz\"\n"
                                           "\"{0} to {1} s\" = \"von {0} bis {1} s\"\n"
                                           "\"travel\" = \"Weg\"\n\"heat\" = \"Wärme\"\n"
                                           "\"Name \\\"{0}\\\"\" = \"Name „{0}“\"\n"
                                           "\"{0} points\" = \"{0} Punkte\"\n"));
    CHECK(editor::tr("{0} of {1} files not opened", {"2", "5"}) == "von 5 Dateien 2 nicht");
    CHECK(editor::counted(3, "{0} point", "{0} points") == "3 Punkte");
    CHECK(editor::translateMessage("Gain of +3.0 dB") == editor::toText("Verstärkung +3.0 dB"));
    CHECK(editor::translateMessage("Points of the band at 90 Hz") == "Punkte: Band bei 90 Hz");
    CHECK(editor::translateMessage("travel, heat") == editor::toText("Weg, Wärme"));
    CHECK(editor::translateMessage("kick: travel") == "kick: Weg");
    CHECK(editor::translateMessage("Name \"a\"") == editor::toText("Name „a“"));
    // A template of few letters says nothing of what a sentence means.
    CHECK(editor::translateMessage("from here to there in s") == "from here to there in s");
    CHECK(editor::translateMessage("travel\nheat") == editor::toText("Weg\nWärme"));
    // A value is none over several lines, each of which may be a sentence.
    CHECK(editor::translateMessage("2 of 5 files not opened\n1 of 3 files not opened") ==
          "von 5 Dateien 2 nicht\nvon 3 Dateien 1 nicht");
    // A value is no template.
    CHECK(editor::tr("{0} points", {"{0}"}) == "{0} Punkte");
    editor::useLanguage("en");
}

TEST_CASE("No page, sheet or menu of the editor has a text that bypasses the tables")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    const test::MarkedLanguage marked;
    test::EditorBench bench({test::shipped("lra-175")});
    juce::StringArray found;
    // What things are called, units, and keys as the system calls them.
    const juce::StringArray names{"lra-175",     "10 mm coin LRA, 175 Hz",
                                  "LRA 175 Hz",  "knock_wood_bridge",
                                  "kHz",         "bit",
                                  "ctrl",        "shift",
                                  "alt",         "spacebar",
                                  "cursor left", "cursor right",
                                  "cursor up",   "cursor down",
                                  "page up",     "page down",
                                  "home",        "end",
                                  "delete",      "return",
                                  "escape",      ".flac",
                                  ".json",       ".wav",
                                  ".haptic",     ".ahap",
                                  ".hjif",       ".haps",
                                  ".pulsar",     ".hmpg",
                                  ".xml",        ".java",
                                  ".tact",       ".csv",
                                  ".pacb"};
    test::addUnmarked(bench.view, names, found); // without a clip
    bench.openDemo("knock_wood_bridge");
    bench.view.doCommand(editor::addMarker);
    test::addUnmarked(bench.view, names, found);
    auto& bar = static_cast<juce::MenuBarModel&>(bench.view.menus());
    for (int i = 0; i < bar.getMenuBarNames().size(); ++i)
    {
        CHECK(test::unmarkedWords(bar.getMenuBarNames()[i], names).isEmpty());
        test::addUnmarked(bar.getMenuForIndex(i, bar.getMenuBarNames()[i]), names, found);
    }
    for (const editor::Command command :
         {editor::exportClips, editor::shortcuts, editor::preferences, editor::changeGain, editor::quantise,
          editor::humanise, editor::thinOut, editor::transposePitch, editor::stretch, editor::repeatClipTimes,
          editor::renameMarker, editor::measureActuator})
    {
        REQUIRE(bench.view.doCommand(command));
        REQUIRE(bench.view.sheet() != nullptr);
        test::addUnmarked(*bench.view.sheet(), names, found);
        bench.view.showSheet(nullptr);
    }
    bench.view.doCommand(editor::keepVersionA);
    bench.view.doCommand(editor::compareWithA);
    bench.view.doCommand(editor::invertCurves); // is refused with a message
    if (bench.view.sheet() != nullptr)
        test::addUnmarked(*bench.view.sheet(), names, found);
    INFO(found.joinIntoString("\n"));
    CHECK(found.isEmpty());
}

TEST_CASE("The manual is in the language where there is one")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    const Language german("de");
    test::EditorBench bench;
    REQUIRE(bench.view.doCommand(editor::manual));
    const auto* topics = test::find<juce::ListBox>(*bench.view.sheet(), "Themen");
    REQUIRE(topics != nullptr);
    CHECK(topics->getModel()->getNameForRow(0) == "Erste Schritte");
}

TEST_CASE("Ticks of a time axis have two digits of seconds before any decimal mark")
{
    using editor::timeText;
    CHECK(timeText(0.25, 0.05) == "0.25 s");
    CHECK(timeText(65.5, 0.5) == "1:05.5");
    CHECK(timeText(600.0, 60.0) == "10:00");
    const Language german("de");
    CHECK(timeText(0.25, 0.05) == "0,25 s");
    CHECK(timeText(65.5, 0.5) == "1:05,5");
    CHECK(timeText(75.5, 0.5) == "1:15,5");
    CHECK(timeText(62.0, 2.0) == "1:02");
}

TEST_CASE("What is wrong with a measurement is said in the language")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    const Language german("de");
    using Defect = MeasurementDefect;
    const auto said = [](Defect code, const char* where, const char* message)
    {
        return editor::translateMessage(editor::toText(explain(MeasurementWarning{code, where, message}, {})));
    };
    CHECK(said(Defect::lowSnr, "below 10.2 Hz",
               "the signal is down to 9 dB over the noise; drive harder, or play longer or more sweeps") ==
          editor::toText("Schwach unter 10,2 Hz: das Signal liegt nur noch 9 dB über dem Rauschen; stärker aussteuern, "
                         "oder längere oder mehr Sweeps spielen."));
    CHECK(said(Defect::clipping, "channels[0]",
               "12 samples at the limit, first at 1.25 s; record or drive at a lower level")
              .contains("12 Abtastwerte an der Grenze"));
    CHECK(
        said(Defect::droppedFrames, "1.25 s", "48 frames are missing about here; use larger buffers and measure again")
            .contains("48 Frames fehlen"));
    CHECK(said(Defect::clockDrift, "clock", "player and recorder differ by 12 ppm; the result is corrected for it")
              .contains("weichen um 12 ppm"));
}
