// The start page without a screen: the library, what will feel it, the first steps.

#include "editor/Bench.h"
#include "editor/Pump.h"
#include "editor/clip/session/ClipSteps.h"
#include "support/TempFolder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

using namespace pacini;
using namespace pacini::test;

namespace
{
std::vector<std::filesystem::path> shippedSounds()
{
    std::vector<std::filesystem::path> all;
    for (const char* folder : {"Resources/library", "Resources/demo"})
        for (const auto& entry : std::filesystem::directory_iterator(sourceFolder() / folder))
            if (entry.path().extension() == ".flac")
                all.push_back(entry.path());
    std::sort(all.begin(), all.end());
    return all;
}

/// An editor that has just been started.
struct StartBench
{
    juce::ScopedJuceInitialiser_GUI gui;
    editor::Session session{{}, {shipped("phone-taptic"), shipped("l5-wristband")}};
    editor::EditorView view{session, services()};

    static editor::HostServices services()
    {
        editor::HostServices around;
        around.demoSounds = shippedSounds();
        return around;
    }
    StartBench() { view.setBounds(0, 0, 1280, 800); }
    [[nodiscard]] juce::StringArray search(const juce::String& words)
    {
        auto& field = get<juce::TextEditor>(view, "Search sounds");
        field.setText(words, false);
        field.onTextChange();
        return view.startPage().shownSounds();
    }
    bool opens(const juce::String& sound)
    {
        get<juce::Button>(view.startPage(), sound).onClick();
        return pumpUntil([this] { return session.model.clip() != nullptr && !session.sounds.workNow(); });
    }
};
} // namespace

TEST_CASE("The library has its ten sounds, found by name and by tag")
{
    StartBench bench;
    const auto all = bench.view.startPage().shownSounds();
    for (const char* name : {"UI click", "Notification", "Heartbeat", "Footsteps", "Weapon", "Explosion", "Engine loop",
                             "Rain", "Texture", "Music bed"})
        CHECK(all.contains(name));
    CHECK(all.size() > 15); // recordings too, none by the name of its file
    for (const auto& name : all)
    {
        CAPTURE(name);
        CHECK(juce::CharacterFunctions::isUpperCase(name[0]));
    }
    CHECK(bench.search("heart") == juce::StringArray{"Heartbeat"});
    CHECK(bench.search("gravel walk") == juce::StringArray{"Footsteps"});
    CHECK(bench.search("nothing like it").isEmpty());
    CHECK(bench.search("").size() == all.size());
}

TEST_CASE("A sound of the library opens with the actuator that was chosen, and an old project keeps its own")
{
    StartBench bench;
    get<juce::Button>(bench.view.startPage(), "Phone").onClick();
    CHECK(bench.session.actuators.usual() == "phone-taptic");
    CHECK(bench.session.actuators.profileName() == "phone-taptic"); // previews are within its limits
    REQUIRE(bench.session.outputs.row(bench.session.actuators).profiles.front() != nullptr);
    bench.session.model.newProject();
    CHECK(bench.session.actuators.profileName() == "phone-taptic");
    bench.session.actuators.setProfile(""); // as in the toolbar
    CHECK(bench.session.actuators.usual().empty());
    bench.session.actuators.setUsual("phone-taptic");
    CHECK_FALSE(bench.session.model.document().isDirty());
    REQUIRE(bench.opens("Heartbeat"));
    CHECK(bench.session.actuators.profileName() == "phone-taptic");
    CHECK(bench.session.model.clip()->transients.size() >= 6);
    CHECK(bench.view.statusBar().playsOn().contains("iPhone (Taptic)"));
    // Nor does a project lose it that is empty for a while.
    bench.session.actuators.setProfile("l5-wristband");
    editor::removeClips(bench.session.model, {bench.session.model.activeId()});
    CHECK(bench.session.actuators.profileName() == "l5-wristband");
    bench.session.model.undo();
    CHECK(bench.session.actuators.profileName() == "l5-wristband");
    bench.session.actuators.setProfile("phone-taptic");
    // Another choice is for what begins.
    bench.session.actuators.setUsual("l5-wristband");
    CHECK(bench.session.actuators.profileName() == "phone-taptic");
    bench.session.actuators.setProfile("");
    const TempFolder folder;
    REQUIRE(bench.session.model.saveAs(folder / "none.pacini"));
    bench.session.model.newProject();
    REQUIRE(bench.session.model.openProject(folder / "none.pacini"));
    CHECK(bench.session.actuators.profileName().empty());
}

TEST_CASE("Sounds of the start page are heard and felt without being opened")
{
    StartBench bench;
    auto& preview = bench.session.filePreview;
    preview.play(sourceFolder() / "Resources/library/heartbeat.flac");
    CHECK(preview.file().filename() == "heartbeat.flac");
    float most = 0.0f;
    REQUIRE(pumpUntil(
        [&]
        {
            std::array<float, 256> haptic{}, sound{};
            const std::span<float> drive(haptic), heard(sound);
            bench.session.player.process(std::span(&drive, 1), std::span(&heard, 1));
            for (std::size_t i = 0; i < haptic.size(); ++i)
                most = std::max(most, std::min(std::abs(haptic[i]) * 100.0f, std::abs(sound[i])));
            return most > 0.01f;
        },
        20.0));
    CHECK(bench.session.model.isEmpty());
    preview.stop();
    CHECK_FALSE(bench.session.player.isPlaying());
    preview.play(sourceFolder() / "Resources/library/rain.flac");
    REQUIRE(bench.opens("UI click"));
    CHECK(preview.file().empty());
    preview.play(sourceFolder() / "Resources/library/rain.flac"); // a clip is shown
    CHECK(preview.file().empty());
}

TEST_CASE("The first steps are shown until each was done once")
{
    StartBench bench;
    CHECK_FALSE(bench.view.statusBar().steps().chosen);
    REQUIRE(bench.opens("UI click"));
    CHECK(bench.view.statusBar().steps().chosen);
    CHECK_FALSE(bench.view.statusBar().steps().shaped);
    REQUIRE(bench.view.doCommand(editor::tapEvent));
    CHECK(bench.view.statusBar().steps().shaped);
    bench.view.lastExport.written = true;
    bench.view.showSheet(nullptr);
    CHECK(bench.view.statusBar().steps().all());
}

TEST_CASE("Connected devices are offered, play along, and new sounds are fitted to them")
{
    StartBench bench;
    auto& page = bench.view.startPage();
    bool chosen = false, refuses = false;
    std::vector<editor::FoundDevice> connected;
    page.foundDevices = [&]
    {
        return connected;
    };
    page.findDevices();
    CHECK(find<juce::Button>(page, "Wireless Controller (connected)") == nullptr);
    connected.push_back({"Wireless Controller", "dualsense-voice-coil", false,
                         [&]() -> Result<void>
                         {
                             if (refuses)
                                 return Error{ErrorCode::io, "", "no permission"};
                             chosen = true;
                             return {};
                         }});
    page.findDevices();
    auto& button = get<juce::Button>(page, "Wireless Controller (connected)");
    button.onClick();
    CHECK(chosen);
    CHECK(bench.session.actuators.usual() == "dualsense-voice-coil");
    CHECK(bench.session.actuators.profileName() == "dualsense-voice-coil");
    // What fails is told, and changes nothing.
    bench.session.actuators.setUsual("");
    refuses = true;
    juce::String told;
    bench.session.model.onError = [&](const juce::String& title, const juce::String&)
    {
        told = title;
    };
    button.onClick();
    CHECK(told.contains("Wireless Controller"));
    CHECK(bench.session.actuators.usual().empty());
    connected.clear();
    page.findDevices();
    CHECK(find<juce::Button>(page, "Wireless Controller (connected)") == nullptr);
}

TEST_CASE("A device is offered a moment after it is connected, from the first start page on")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    editor::Session session({}, {});
    editor::HostServices services;
    bool plugged = false;
    services.foundDevices = [&]
    {
        std::vector<editor::FoundDevice> found;
        if (plugged)
            found.push_back({"Pad", "", false,
                             []
                             {
                                 return Result<void>();
                             }});
        return found;
    };
    editor::EditorView view(session, services);
    view.setBounds(0, 0, 1280, 800);
    plugged = true;
    CHECK(pumpUntil([&] { return find<juce::Button>(view.startPage(), "Pad (connected)") != nullptr; }, 5.0));
    plugged = false;
    CHECK(pumpUntil([&] { return find<juce::Button>(view.startPage(), "Pad (connected)") == nullptr; }, 5.0));
}

TEST_CASE("The pointer plays no sound unless that is switched on; the triangle of a sound does")
{
    StartBench bench;
    auto& page = bench.view.startPage();
    auto& tile = get<juce::Button>(page, "Heartbeat");
    auto& preview = bench.session.filePreview;
    CHECK_FALSE(get<juce::Button>(page, "Play on hover").getToggleState());
    Mouse(tile).press({8.0f, 20.0f});
    CHECK(preview.file().filename() == "heartbeat.flac");
    Mouse(tile).press({8.0f, 20.0f});
    CHECK(preview.file().empty());
    CHECK(bench.session.model.isEmpty());
}

TEST_CASE("Nothing on the start page is cut off or lies on another, in a low window as well")
{
    StartBench bench;
    for (const auto size : {juce::Point<int>(1280, 800), juce::Point<int>(880, 560), juce::Point<int>(720, 460)})
    {
        bench.view.setSize(size.x, size.y);
        auto& page = bench.view.startPage();
        std::vector<juce::Component*> placed;
        for (juce::Component* child : page.getChildren())
            if (child->isVisible())
                placed.push_back(child);
        CHECK(placed.size() >= (size.y < 500 ? 8u : 9u)); // a row that has no room is left out
        for (std::size_t i = 0; i < placed.size(); ++i)
        {
            CAPTURE(size.x, placed[i]->getTitle(), placed[i]->getBounds().toString());
            CHECK(page.getLocalBounds().contains(placed[i]->getBounds()));
            CHECK(placed[i]->getHeight() >= 24);
            for (std::size_t k = 0; k < i; ++k)
                CHECK_FALSE(placed[k]->getBounds().intersects(placed[i]->getBounds()));
        }
    }
}

TEST_CASE("The sounds end where the head above them does, where no scroll bar needs room")
{
    StartBench bench;
    for (const auto& [width, height] : {std::pair(1280, 800), std::pair(1920, 1080)})
    {
        CAPTURE(width);
        bench.view.setBounds(0, 0, width, height);
        const auto rightOf = [&](const juce::String& title)
        {
            auto& button = get<juce::Button>(bench.view, title);
            return bench.view.getLocalArea(&button, button.getLocalBounds()).getRight();
        };
        int right = 0;
        for (const auto& sound : bench.view.startPage().shownSounds())
            right = std::max(right, rightOf(sound));
        CHECK(std::abs(right - rightOf("Play on hover")) <= 4); // columns are whole points wide
    }
}
