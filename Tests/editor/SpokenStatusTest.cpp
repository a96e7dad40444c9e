// Status messages are spoken by the program spd-say, where the user wants that.

#if !defined(_WIN32)

#include "editor/SpokenStatus.h"

#include "editor/Bench.h"
#include "editor/Pump.h"
#include "editor/Translation.h"
#include "support/TempFolder.h"

#include <cstdlib>
#include <fstream>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// A stand-in for spd-say, which writes what it is to say, alone in PATH. It takes a moment for the text "slow".
class StandIn
{
public:
    explicit StandIn(bool there = true)
    {
        if (there)
        {
            const auto program = folder / "spd-say";
            put(program, "#!/bin/sh\nfor last; do :; done\nif [ \"$last\" = slow ]; then /bin/sleep 0.5; fi\n"
                         "printf '%s|' \"$@\" >> '" +
                             (folder / "said").string() + "'\nprintf '\\n' >> '" + (folder / "said").string() + "'\n");
            std::filesystem::permissions(program, std::filesystem::perms::owner_all);
        }
        setenv("PATH", folder.path().c_str(), 1);
    }
    ~StandIn() { setenv("PATH", before.c_str(), 1); }

    [[nodiscard]] std::vector<std::string> said() const
    {
        std::ifstream file(folder / "said");
        std::vector<std::string> lines;
        for (std::string line; std::getline(file, line);)
            lines.push_back(line);
        return lines;
    }

private:
    TempFolder folder;
    const std::string before = std::getenv("PATH");
};

void turnOn(editor::Session& session)
{
    auto options = session.viewState.viewOptions();
    options.spoken = true;
    session.viewState.setViewOptions(options);
}
} // namespace

TEST_CASE("Of several texts the newest is spoken, in the language of the windows")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    const StandIn program;
    editor::SpokenStatus speaker;
    speaker.say("slow");
    pumpFor(0.2);
    for (const char* text : {"one", "two", "-three"})
        speaker.say(text);
    REQUIRE(pumpUntil([&] { return program.said().size() == 2; }));
    pumpFor(0.2);
    const auto said = program.said();
    REQUIRE(said.size() == 2);
    CHECK(said[0] == "--application-name|pacini|--priority|text|--language|en|--|slow|");
    CHECK(said[1] == "--application-name|pacini|--priority|text|--language|en|--|-three|");
}

TEST_CASE("Nothing is spoken unless the user wants it; then notices, questions and the status are")
{
    const StandIn program;
    EditorBench bench({shipped("lra-175")});
    const auto heard = [&](const std::string& text)
    {
        const auto said = program.said();
        return std::any_of(said.begin(), said.end(),
                           [&](const std::string& line) { return line.find(text) != std::string::npos; });
    };
    bench.session.model.onNotice("before");
    bench.openDemo("knock_wood_bridge");
    pumpFor(0.3);
    CHECK(program.said().empty());
    turnOn(bench.session);
    CHECK(pumpUntil([&] { return heard(bench.view.statusBar().playsOn().toStdString()); }));
    bench.session.model.onNotice("a notice");
    CHECK(pumpUntil([&] { return heard("--|a notice|"); }));
    bench.session.model.onError("Not possible", "a reason");
    CHECK(pumpUntil([&] { return heard("--|Not possible. a reason|"); }));
}

TEST_CASE("Where speech-dispatcher is missing the window says so once")
{
    const StandIn nothing(false);
    const juce::ScopedJuceInitialiser_GUI gui;
    editor::SpokenStatus speaker;
    int told = 0;
    speaker.onMissing = [&]
    {
        ++told;
    };
    speaker.say("one");
    REQUIRE(pumpUntil([&] { return told > 0; }));
    speaker.say("two");
    pumpFor(0.3);
    CHECK(told == 1);
}

#endif
