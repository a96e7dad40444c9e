// Haptic outputs and live controls in the editor.

#include "editor/Bench.h"
#include "editor/Meters.h"
#include "editor/Pump.h"
#include "editor/clip/scene/SceneSheet.h"
#include "editor/clip/sheets/OutputsSheet.h"
#include "io/SettingsFile.h"
#include "support/TempFolder.h"

using namespace pacini;
using test::EditorBench;
using test::find;
using test::get;
using test::put;
using test::TempFolder;

TEST_CASE("One output plays the clip on the actuator of the project, as long as nobody wants more")
{
    EditorBench bench({test::shipped("lra-175"), test::shipped("erm-coin")});
    bench.session.actuators.setProfile("lra-175");
    const auto& outputs = bench.session.outputs;
    REQUIRE(outputs.outputs().size() == 1);
    CHECK(outputs.outputs()[0] == editor::HapticOutput{});
    const PreviewRow row = outputs.row(bench.session.actuators);
    CHECK(row.profiles.at(0) == bench.session.actuators.profile());
    CHECK_FALSE(row.pan);
    CHECK(find<editor::LevelMeter>(bench.view, "Output") != nullptr);
    CHECK(find<editor::LevelMeter>(bench.view, "Output 2") == nullptr);
}

TEST_CASE("Outputs are added side by side, keep within their bounds, and have a meter each")
{
    EditorBench bench({test::shipped("lra-175"), test::shipped("erm-coin")});
    bench.openDemo("drums_tabla_pattern");
    auto& outputs = bench.session.outputs;
    outputs.add();
    outputs.add();
    REQUIRE(outputs.outputs().size() == 3);
    CHECK(outputs.outputs()[1].channel == 3);
    CHECK(outputs.outputs()[1].place == 0.5);
    CHECK(outputs.outputs()[2].place == 1.0);
    auto list = outputs.outputs();
    list[1].actuator = "erm-coin";
    list[1].gain = 20.0;
    list[1].delay = 9.0;
    list[2].actuator = editor::HapticOutputs::plainDrive;
    list[0].place = 0.25;
    outputs.setOutputs(list);
    CHECK(outputs.outputs()[1].gain == 0.0);
    CHECK(outputs.outputs()[1].delay == editor::HapticOutputs::longestDelay);
    const PreviewRow row = outputs.row(bench.session.actuators);
    CHECK(row.profiles.at(1)->technology == Technology::erm);
    CHECK(row.profiles.at(2) == nullptr);
    CHECK(row.places == std::vector<double>{0.25, 0.5, 1.0});
    for (int i = 1; i <= 3; ++i)
        CHECK(get<editor::LevelMeter>(bench.view, "Output " + juce::String(i)).getHeight() > 15);
    outputs.add();
    CHECK(outputs.outputs()[0].place == 0.25); // set by hand: it stays
    for (int i = 0; i < 10; ++i)
        outputs.add();
    CHECK(outputs.outputs().size() == 8);
    for (int i = 0; i < 10; ++i)
        outputs.removeLast();
    CHECK(outputs.outputs().size() == 1);
}

TEST_CASE("The sheet of haptic outputs sets channel, actuator, gain, delay and place of each")
{
    EditorBench bench({test::shipped("lra-175"), test::shipped("erm-coin")});
    auto& outputs = bench.session.outputs;
    bench.view.showSheet(std::make_unique<editor::OutputsSheet>(outputs, bench.session.actuators,
                                                                juce::StringArray{"a", "b", "c", "d"}));
    auto& sheet = *bench.view.sheet();
    get<juce::TextButton>(sheet, "Add output").onClick();
    REQUIRE(outputs.outputs().size() == 2);
    auto& channel = get<juce::ComboBox>(sheet, "Channel of output 2");
    CHECK(channel.getText() == "4  d");
    channel.setSelectedItemIndex(2, juce::sendNotificationSync);
    CHECK(outputs.outputs()[1].channel == 1);
    get<juce::ComboBox>(sheet, "Actuator of output 2").setSelectedItemIndex(3, juce::sendNotificationSync);
    CHECK(outputs.outputs()[1].actuator == "erm-coin");
    get<juce::ComboBox>(sheet, "Actuator of output 2").setSelectedItemIndex(0, juce::sendNotificationSync);
    CHECK(outputs.outputs()[1].actuator.empty());
    get<juce::Slider>(sheet, "Gain of output 2").setValue(-6.0, juce::sendNotificationSync);
    get<juce::Slider>(sheet, "Delay of output 2").setValue(12.0, juce::sendNotificationSync);
    CHECK_FALSE(get<juce::Slider>(sheet, "Position of output 2").isEnabled()); // nothing is panned
    outputs.setPan(PanLaw::constantPower);
    CHECK(get<juce::Slider>(sheet, "Position of output 2").isEnabled());
    get<juce::Slider>(sheet, "Position of output 2").setValue(40.0, juce::sendNotificationSync);
    CHECK(outputs.outputs()[1].gain == -6.0);
    CHECK(outputs.outputs()[1].delay == Approx(0.012));
    CHECK(outputs.outputs()[1].place == Approx(0.4));
    // Keys reach all of it, from left to right.
    for (const char* title : {"Channel of output", "Actuator of output", "Gain of output", "Delay of output"})
        for (int i = 1; i <= 2; ++i)
            CHECK(get<juce::Component>(sheet, juce::String(title) + " " + juce::String(i)).getWantsKeyboardFocus());
    get<juce::TextButton>(sheet, "Remove last output").onClick();
    CHECK(outputs.outputs().size() == 1);
}

TEST_CASE("Live controls go to the player, stay out of the clip and are reset together")
{
    EditorBench bench;
    bench.openDemo("drums_tabla_pattern");
    const Clip before = bench.clip();
    auto& transport = bench.session.transport;
    auto* page = bench.view.sidePanel().getTabContentComponent(3);
    REQUIRE(page != nullptr);
    get<juce::Slider>(*page, "Gain").setValue(-6.0, juce::sendNotificationSync);
    get<juce::Slider>(*page, "Speed").setValue(2.0, juce::sendNotificationSync);
    get<juce::Slider>(*page, "Pitch").setValue(3.0, juce::sendNotificationSync);
    get<juce::Slider>(*page, "Intensity").setValue(40.0, juce::sendNotificationSync);
    CHECK(transport.controls().gain == Approx(0.501187));
    CHECK(transport.controls().speed == Approx(2.0));
    CHECK(transport.controls().transposition == 3.0);
    CHECK(transport.controls().intensity == Approx(0.4));
    CHECK(bench.clip() == before);
    CHECK_FALSE(get<juce::Slider>(*page, "Position").isEnabled());
    bench.session.outputs.add();
    get<juce::ComboBox>(*page, "Pan").setSelectedItemIndex(1, juce::sendNotificationSync);
    CHECK(bench.session.outputs.pan() == PanLaw::constantPower);
    CHECK(get<juce::Slider>(*page, "Position").isEnabled());
    get<juce::Slider>(*page, "Position").setValue(100.0, juce::sendNotificationSync);
    CHECK(transport.controls().pan == 1.0);
    get<juce::TextButton>(*page, "Reset live controls").onClick();
    CHECK(transport.controls().gain == 1.0);
    CHECK(transport.controls().pan == 0.5);
    CHECK(get<juce::Slider>(*page, "Gain").getValue() == 0.0);
}

TEST_CASE("A button that is on looks so without its colours, on dark and on light ground")
{
    EditorBench bench;
    juce::TextButton button("Clips");
    button.setSize(80, 26);
    for (const bool dark : {true, false})
    {
        CAPTURE(dark);
        editor::Look look;
        look.setDark(dark);
        button.setLookAndFeel(&look);
        const auto brightness = [&](bool on)
        {
            button.setToggleState(on, juce::dontSendNotification);
            const auto picture = button.createComponentSnapshot(button.getLocalBounds(), true, 1.0f);
            return picture.getPixelAt(10, 13).getPerceivedBrightness();
        };
        CHECK(std::abs(brightness(true) - brightness(false)) > 0.4f);
        const auto& palette = look.palette();
        CHECK(std::abs(palette.text.getPerceivedBrightness() - palette.card.getPerceivedBrightness()) > 0.5f);
        button.setLookAndFeel(nullptr);
    }
}

TEST_CASE("A further output gets a channel that is free, or none, and plays where it is shown to")
{
    EditorBench bench({test::shipped("lra-175")});
    bench.openDemo("drums_tabla_pattern");
    auto& outputs = bench.session.outputs;
    outputs.setDevice(std::vector<bool>(4, true), 0); // the sound is on 1 and 2
    CHECK(outputs.channelOf(0) == 2);
    outputs.add();
    CHECK(outputs.channelOf(1) == 3);
    outputs.add();
    CHECK(outputs.outputs()[2].channel == -1);
    CHECK(outputs.channelOf(2) == -1);
    CHECK(outputs.playingCount() == 2);
    CHECK_FALSE(get<editor::LevelMeter>(bench.view, "Output 3").isEnabled());
    CHECK(get<editor::LevelMeter>(bench.view, "Output 2").isEnabled());
    CHECK(bench.view.statusBar().playsOn().startsWith("Plays on 2 of 3 outputs"));

    // One that was set on another device is told from those that play.
    auto list = outputs.outputs();
    list[2].channel = 6;
    outputs.setOutputs(list);
    CHECK(outputs.channelOf(2) == -1); // not the last one, which the second has
    bench.view.showSheet(std::make_unique<editor::OutputsSheet>(outputs, bench.session.actuators,
                                                                juce::StringArray{"a", "b", "c", "d"}));
    auto& sheet = *bench.view.sheet();
    CHECK(get<juce::ComboBox>(sheet, "Channel of output 3").getText() == "7  not on this device");
    CHECK(get<juce::Label>(sheet, "Note").getText().startsWith("Output 3 does not play."));
    get<juce::ComboBox>(sheet, "Channel of output 3").setSelectedItemIndex(2, juce::sendNotificationSync);
    CHECK(outputs.channelOf(2) == 1);
    CHECK(get<editor::LevelMeter>(bench.view, "Output 3").isEnabled());
    CHECK(get<juce::Label>(sheet, "Note").getText().startsWith("All outputs play"));

    // Channels that are switched off play nothing; the only output of a small device is its last.
    outputs.setDevice(std::vector<bool>{true, true, true, false});
    CHECK(outputs.channelOf(1) == -1);
    outputs.setOutputs({editor::HapticOutput{}});
    outputs.setDevice(std::vector<bool>{true, true});
    CHECK(outputs.channelOf(0) == 1);
    bench.view.showSheet(nullptr);
}

TEST_CASE("Without a device Play says so, offers to reconnect and does not pretend to play")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    editor::Session session{{}, {test::shipped("lra-175")}};
    int asked = 0;
    bool elsewhere = false;
    editor::HostServices around;
    around.reconnect = [&]
    {
        ++asked;
        session.outputs.setDevice(std::vector<bool>(4, true));
        return true;
    };
    around.playsElsewhere = [&]
    {
        return elsewhere;
    };
    editor::EditorView view{session, around};
    view.setBounds(0, 0, 1280, 800);
    auto imported = editor::importFile(test::demoSound("knock_wood_bridge"), {});
    REQUIRE(imported);
    session.sounds.add(std::move(*imported));
    auto& button = get<juce::TextButton>(view.statusBar(), "Reconnect");
    CHECK_FALSE(button.isVisible());
    session.outputs.setDevice(std::vector<bool>());
    CHECK(button.isVisible());
    CHECK(view.statusBar().playsOn() == "No audio device: nothing plays");
    view.doCommand(editor::playOrPause);
    CHECK_FALSE(session.transport.isPlaying());
    CHECK(get<editor::IconButton>(view, "Play/pause").icon() == editor::Icon::play);
    REQUIRE(view.question() != nullptr);
    CHECK(view.question()->getTitle() == "Nothing to play on");
    test::answer(*view.question(), "Reconnect");
    CHECK(asked == 1);
    REQUIRE(test::pumpUntil([&] { return view.question() == nullptr; }));
    CHECK_FALSE(button.isVisible());
    CHECK(view.statusBar().playsOn().startsWith("Plays on"));
    view.doCommand(editor::playOrPause);
    CHECK(session.transport.isPlaying());
    session.transport.stop();

    // A controller or a phone is something to play on.
    session.outputs.setDevice(std::vector<bool>());
    elsewhere = true;
    view.doCommand(editor::playOrPause);
    CHECK(session.transport.isPlaying());
    CHECK(view.statusBar().playsOn() == "No audio device: only controllers and phones play");
    session.transport.stop();
    elsewhere = false;
    // The scene page asks in front of itself, and the start page's preview, too.
    REQUIRE(view.doCommand(editor::editScene));
    auto* page = dynamic_cast<editor::SceneSheet*>(view.sheet());
    REQUIRE(page != nullptr);
    page->parts().add(session.model.activeId(), 0.0);
    get<juce::TextButton>(*page, "Play").onClick();
    CHECK(view.question() != view.sheet());
    CHECK(view.question()->getTitle() == "Nothing to play on");
    CHECK_FALSE(session.player.isPlaying());
    view.question()->onClose();
    REQUIRE(test::pumpUntil([&] { return view.question() == view.sheet(); }));
    view.showSheet(nullptr);
    session.model.newProject();
    session.filePreview.play(test::demoSound("knock_wood_bridge"));
    CHECK(session.filePreview.file().empty());
    CHECK(view.question() != nullptr);
    view.showSheet(nullptr);
}

TEST_CASE("Presets of the outputs are settings files that bring all rows and the pan back")
{
    const TempFolder folder;
    EditorBench bench({test::shipped("lra-175"), test::shipped("erm-coin")});
    auto& outputs = bench.session.outputs;
    outputs.setPan(PanLaw::delay);
    outputs.setOutputs(
        {{2, "", -3.5, 0.0, 0.0}, {3, "erm-coin", 0.0, 0.012, 0.75}, {-1, "plain drive", 0.0, 0.0, 1.0}});
    const auto wanted = outputs.outputs();
    const auto open = [&]
    {
        bench.view.showSheet(std::make_unique<editor::OutputsSheet>(bench.view, juce::StringArray{"a", "b", "c", "d"},
                                                                    folder / "presets"));
        return dynamic_cast<editor::OutputsSheet*>(bench.view.sheet());
    };
    auto* sheet = open();
    REQUIRE(sheet != nullptr);
    sheet->presets()->saveAs("band");
    outputs.setPan(std::nullopt);
    outputs.setOutputs({{0, "lra-175", 0.0, 0.0, 0.0}});
    sheet = open();
    auto& box = get<juce::ComboBox>(*sheet, "Preset");
    int item = 0;
    for (int i = 0; i < box.getNumItems(); ++i)
        if (box.getItemText(i) == "band")
            item = box.getItemId(i);
    REQUIRE(item != 0);
    box.setSelectedId(item, juce::sendNotificationSync);
    CHECK(outputs.outputs() == wanted);
    CHECK(outputs.pan() == PanLaw::delay);
    // It is a settings file, and one of the analysis, or a broken one, changes nothing.
    CHECK(readSettingsFile(folder / "presets" / "band.json"));
    for (const char* text :
         {"{}", "no JSON", R"({"format": "pacini.settings", "version": 1, "encode": {"bands": 5}})",
          R"({"format": "pacini.settings", "version": 1, "outputs": []})",
          R"({"format": "pacini.settings", "version": 1, "pan": "left", "outputs": [{"channel": 1}]})",
          R"({"format": "pacini.settings", "version": 1, "outputs": [{"channel": -4}]})",
          R"({"format": "pacini.settings", "version": 1, "outputs": [{"channel": 1, "gain": 200}]})",
          R"({"format": "pacini.settings", "version": 2, "outputs": [{"channel": 1}]})"})
    {
        CAPTURE(text);
        put(folder / "other.json", text);
        sheet->presets()->open(folder / "other.json");
        REQUIRE(bench.view.question() != bench.view.sheet());
        CHECK(bench.view.question()->getTitle() == "other.json not opened");
        CHECK(outputs.outputs() == wanted);
        sheet = open();
    }
}
