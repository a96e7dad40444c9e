// The interface in other languages.

#include "editor/Translation.h"

#include "editor/Bench.h"
#include "support/Paths.h"

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

using namespace pacini;

namespace
{
/// English again at the end.
struct Language
{
    explicit Language(const char* code) { editor::useLanguage(code); }
    ~Language() { editor::useLanguage("en"); }
};

std::string contentOf(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

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

TEST_CASE("Every line of a translation is for a text that there is")
{
    std::string sources;
    for (const char* room : {"Source/editor", "Source/app/editor"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(sourceFolder() / room))
            if (entry.path().extension() == ".cpp")
                sources += contentOf(entry.path());
    for (const auto& code : editor::languages())
    {
        const auto file = sourceFolder() / "Resources/translations" / (code.toStdString() + ".txt");
        std::istringstream lines(contentOf(file));
        std::set<std::string> seen;
        std::size_t count = 0;
        for (std::string line; std::getline(lines, line);)
        {
            if (line.empty() || line.front() != '"')
                continue;
            const std::string key = line.substr(0, line.find("\" = \"") + 1);
            CAPTURE(file, line);
            CHECK(line.back() == '"');
            CHECK(seen.insert(key).second);
            const bool dots = key.find("\xe2\x80\xa6") != std::string::npos; // put behind the word by the program
            CHECK((dots || sources.find(key) != std::string::npos));
            ++count;
        }
        CHECK(count > 100);
    }
    CHECK(editor::languages().contains("de"));
    CHECK(editor::languageName("de") == "Deutsch");
}
