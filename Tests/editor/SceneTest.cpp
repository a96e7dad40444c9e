// The scene page without a screen.

#include "document/Amendments.h"
#include "editor/Bench.h"
#include "editor/Pump.h"
#include "editor/clip/scene/SceneSheet.h"
#include "io/SceneFile.h"
#include "support/RandomScene.h"
#include "support/TempFolder.h"

#include <chrono>
#include <fstream>
#include <limits>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// The page over a project of two clips.
struct ScenePage : EditorBench
{
    editor::SceneSheet* sheet = nullptr;
    int first = 0, second = 0;

    ScenePage() : EditorBench({shipped("lra-175")})
    {
        openDemo("knock_wood_bridge");
        first = session.model.activeId();
        openDemo("impact_boom");
        second = session.model.activeId();
        REQUIRE(view.doCommand(editor::editScene));
        sheet = dynamic_cast<editor::SceneSheet*>(view.sheet());
        REQUIRE(sheet != nullptr);
    }
    [[nodiscard]] const ProjectScene& scene() const { return session.model.document().project().scene; }
    [[nodiscard]] juce::Point<float> middleOf(std::size_t part) const
    {
        return sheet->timeline().areaOf(part).getCentre().toFloat();
    }
};
} // namespace

TEST_CASE("Clips are added to the scene, moved by mouse and keys, each as one step, and removed")
{
    ScenePage page;
    auto& parts = page.sheet->parts();
    auto& line = page.sheet->timeline();
    parts.add(page.first, 0.0);
    parts.add(page.second, 0.0);
    REQUIRE(page.scene().parts.size() == 2);
    CHECK(page.scene().parts[0].track == 0);
    CHECK(page.scene().parts[1].track == 1); // the first is in its way
    const std::size_t steps = page.session.model.document().steps().size();
    Mouse(line).dragFromTo(page.middleOf(1), page.middleOf(1) + juce::Point<float>(203.0f, 50.0f), 8);
    CHECK(page.scene().parts[1].play.start > 0.1);
    CHECK(page.scene().parts[1].track == 2);
    CHECK(page.session.model.document().steps().size() == steps + 1);
    const double before = page.scene().parts[1].play.start;
    CHECK(line.keyPressed(juce::KeyPress(juce::KeyPress::rightKey)));
    CHECK(page.scene().parts[1].play.start == Approx(before + 0.01));
    CHECK(line.keyPressed(juce::KeyPress(juce::KeyPress::upKey)));
    CHECK(page.scene().parts[1].track == 1);
    CHECK(line.keyPressed(juce::KeyPress(juce::KeyPress::deleteKey)));
    CHECK(page.scene().parts.size() == 1);
    page.session.model.undo();
    CHECK(page.scene().parts.size() == 2);
}

TEST_CASE("A part snaps to the end of another, and Alt leaves it where it is")
{
    ScenePage page;
    auto& parts = page.sheet->parts();
    parts.add(page.first, 0.0);
    parts.add(page.second, 0.0);
    const double end = page.session.model.document().clip(page.first)->clip->duration;
    auto& line = page.sheet->timeline();
    const auto edge = static_cast<float>(line.areaOf(0).getRight());
    Mouse(line).dragFromTo(page.middleOf(1), page.middleOf(1) + juce::Point<float>(edge + 4.0f, 0.0f), 6);
    CHECK(page.scene().parts[1].play.start == Approx(end).margin(1e-9));
    page.session.model.undo();
    Mouse(line, juce::ModifierKeys::altModifier)
        .dragFromTo(page.middleOf(1), page.middleOf(1) + juce::Point<float>(edge + 4.0f, 0.0f), 6);
    CHECK(page.scene().parts[1].play.start != Approx(end).margin(1e-9));
}

TEST_CASE("Points of a curve are added by mouse and by keys, and the scene file has them")
{
    ScenePage page;
    auto& parts = page.sheet->parts();
    parts.add(page.first, 0.5);
    auto& curve = get<editor::SceneCurveLane>(*page.sheet, "Curve");
    Mouse(curve).doubleClick({20.0f, 20.0f});
    Mouse(curve).doubleClick(
        {static_cast<float>(curve.getWidth()) - 20.0f, static_cast<float>(curve.getHeight()) - 20.0f});
    REQUIRE(page.scene().parts[0].curves.size() == 1);
    CHECK(page.scene().parts[0].curves[0].points.size() == 2);
    CHECK(curve.keyPressed(juce::KeyPress(juce::KeyPress::returnKey)));
    CHECK(page.scene().parts[0].curves[0].points.size() == 3);
    CHECK(curve.keyPressed(juce::KeyPress(juce::KeyPress::deleteKey)));
    CHECK(page.scene().parts[0].curves[0].points.size() == 2);
    const TempFolder folder;
    REQUIRE(writeScene(folder / "made.scene.json", sceneOf(page.session.model.document().project()).scene));
    const auto read = readScene(folder / "made.scene.json");
    REQUIRE(read);
    CHECK(read->plays.size() == 1);
    REQUIRE(read->changes.size() == 1);
    CHECK(read->changes[0].parameter == SceneParameter::pan);
    CHECK(read->changes[0].value < 0.3);
    CHECK(read->plays[0].pan > 0.7);
}

TEST_CASE("A part is repeated, and its length and the file follow")
{
    ScenePage page;
    page.sheet->parts().add(page.first, 0.0);
    const int once = page.sheet->timeline().areaOf(0).getWidth();
    auto& repeats = get<juce::Slider>(*page.sheet, "Repeats");
    CHECK(repeats.getValue() == 1.0);
    repeats.setValue(3.0, juce::sendNotificationSync);
    CHECK(page.scene().parts[0].play.passes == 3);
    CHECK(page.sheet->timeline().areaOf(0).getWidth() == Approx(3 * once).margin(3));
    repeats.setValue(1.0, juce::sendNotificationSync);
    CHECK(page.scene().parts[0].play.loop == 0.0);
}

TEST_CASE("A scene with a texture opens, plays, changes by speed and force, and is written with its texture")
{
    const TempFolder folder;
    const Scene scene = test::texturedScene(7);
    REQUIRE(writeScene(folder / "made.scene.json", scene));
    ScenePage page;
    page.sheet->read(folder / "made.scene.json");
    REQUIRE(pumpUntil([&] { return page.scene().parts.size() == scene.plays.size(); }));
    REQUIRE(page.scene().textures.size() == 2);
    auto& curves = get<juce::ComboBox>(*page.sheet, "Curve");
    const auto offered = [&]
    {
        juce::StringArray names;
        for (int i = 0; i < curves.getNumItems(); ++i)
            names.add(curves.getItemText(i));
        return names;
    };
    page.sheet->parts().select(0);
    CHECK(offered().contains("Pitch"));
    CHECK_FALSE(offered().contains("Speed"));
    const std::size_t texture = scene.plays.size() - 1; // whose force changes
    page.sheet->parts().select(texture);
    CHECK_FALSE(offered().contains("Pitch"));
    REQUIRE(offered().contains("Force"));
    curves.setText("Speed", juce::sendNotificationSync);
    auto& value = get<juce::Slider>(*page.sheet, "Value");
    CHECK(value.getMaximum() == 1.0);
    CHECK(value.getValue() == Approx(scene.plays[texture].speed).margin(0.006));
    value.setValue(0.75, juce::sendNotificationSync);
    CHECK(page.scene().parts[texture].play.speed == 0.75);
    page.sheet->parts().select(0); // a clip has no speed: the lane shows what it has
    CHECK(curves.getText() == "Position");
    page.sheet->write(folder / "written.scene.json");
    REQUIRE(pumpUntil([&] { return page.sheet->summary().startsWith("Written"); }));
    const auto read = readScene(folder / "written.scene.json");
    REQUIRE(read);
    CHECK(read->textures == scene.textures);
    CHECK(read->plays[texture].texture == scene.plays[texture].texture);
    CHECK(read->plays[texture].speed == 0.75);
}

TEST_CASE("What is let pass in a scene file that the page opens is told there, as of files that are dropped")
{
    const TempFolder folder;
    std::ofstream(folder / "odd.scene.json") << R"({"format": "pacini.scene", "version": 1, "colour": 3, "plays": []})";
    ScenePage page;
    page.sheet->read(folder / "odd.scene.json");
    REQUIRE(pumpUntil([&] { return questionOver(*page.sheet) != nullptr; }));
    CHECK(questionOver(*page.sheet)->getTitle() == "Imported with losses");
    CHECK(questionOver(*page.sheet)->getDescription().contains("colour"));
}

TEST_CASE("A scene file opens with its clips, its loops and what changes, and shows its page")
{
    const TempFolder folder;
    Scene scene = test::randomScene(7);
    REQUIRE(writeScene(folder / "made.scene.json", scene));
    ScenePage page;
    page.view.showSheet(nullptr);
    const std::size_t clips = page.session.model.document().project().clips.size();
    page.session.sounds.openFiles({folder / "made.scene.json"});
    REQUIRE(pumpUntil([&] { return !page.session.sounds.workNow() && !page.scene().parts.empty(); }));
    CHECK(page.scene().parts.size() == scene.plays.size());
    CHECK(page.session.model.document().project().clips.size() == clips + scene.clips.size());
    CHECK(pumpUntil([&] { return dynamic_cast<editor::SceneSheet*>(page.view.sheet()) != nullptr; }));
    // What is not one is said.
    editor::SceneSheet other(page.session);
    std::ofstream(folder / "bad.json") << "{\"format\": \"pacini.scene\", \"plays\": [{\"clip\": 3}]}";
    other.read(folder / "bad.json");
    CHECK(pumpUntil([&] { return other.summary().contains("bad.json"); }));
    CHECK(page.scene().parts.size() == scene.plays.size());
}

TEST_CASE("What nobody would feel is said, and shown on the part")
{
    ScenePage page;
    auto& parts = page.sheet->parts();
    parts.add(page.first, 0.0);
    CHECK(pumpUntil([&] { return page.sheet->summary().contains("1 clip"); }));
    parts.add(page.second, 3.0);
    parts.editPart("Softer", [](ScenePart& part) { part.play.gain = -110.0; });
    CHECK(pumpUntil([&] { return page.sheet->summary().contains("1 clip left out"); }));
}

TEST_CASE("The scene plays, and the clip has the player again afterwards")
{
    ScenePage page;
    page.sheet->parts().add(page.first, 0.0);
    auto& button = get<juce::TextButton>(*page.sheet, "Play");
    button.onClick();
    float most = 0.0f;
    const auto hear = [&]
    {
        std::array<float, 256> haptic{}, sound{};
        const std::span<float> drive(haptic), heard(sound);
        page.session.player.process(std::span(&drive, 1), std::span(&heard, 1));
        for (const float sample : haptic)
            most = std::max(most, std::abs(sample));
        return most > 0.05f;
    };
    CHECK(pumpUntil(hear, 20.0));
    // An edit is heard while it plays, and nothing else takes the player.
    page.sheet->parts().add(page.second, 0.5);
    page.session.actuators.setProfile("phone-taptic");
    CHECK(page.session.player.isPlaying());
    most = 0.0f;
    CHECK(pumpUntil(hear, 20.0));
    page.view.showSheet(nullptr);
    CHECK_FALSE(page.session.player.isPlaying());
    page.session.transport.play();
    CHECK(page.session.player.isPlaying());
}

TEST_CASE("A scene of forty parts beside five hundred clips is drawn within 16 ms", "[.bench]")
{
    ScenePage page;
    for (int i = 2; i < 500; ++i)
        REQUIRE(page.session.model.insert([&](Document& document) { return addClip(document, page.clip()); }).ok());
    for (int i = 0; i < 40; ++i)
        page.sheet->parts().add(i % 2 == 0 ? page.first : page.second, 0.3 * i);
    auto& line = page.sheet->timeline();
    line.fit();
    juce::Image image(juce::Image::RGB, line.getWidth(), line.getHeight(), true);
    using Clock = std::chrono::steady_clock;
    double most = 0.0;
    for (int i = 0; i < 50; ++i)
    {
        juce::Graphics g(image);
        const auto start = Clock::now();
        line.paint(g);
        most = std::max(most, std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    WARN("40 parts: " << most << " ms at most for a whole frame");
    CHECK(most < 16.0);
}

TEST_CASE("Undo and save work inside the scene page, with the keys as the system tells them")
{
    ScenePage page;
    auto& model = page.session.model;
    page.sheet->parts().add(page.first, 0.0);
    page.sheet->parts().select(0);
    const TempFolder folder;
    REQUIRE(model.saveAs(folder / "scene.pacini"));
    CHECK(page.sheet->timeline().keyPressed(juce::KeyPress(juce::KeyPress::deleteKey)));
    CHECK(page.scene().parts.empty());
    CHECK(model.document().isDirty());
    // X11 has small letters as codes, other systems have capitals.
    for (const int z : {'z', 'Z'})
    {
        CHECK(static_cast<juce::Component*>(page.sheet)
                  ->keyPressed(juce::KeyPress(z, juce::ModifierKeys::ctrlModifier, 0)));
        CHECK(page.scene().parts.size() == 1);
        CHECK(static_cast<juce::Component*>(page.sheet)
                  ->keyPressed(
                      juce::KeyPress(z, juce::ModifierKeys::ctrlModifier | juce::ModifierKeys::shiftModifier, 0)));
        CHECK(page.scene().parts.empty());
    }
    CHECK(static_cast<juce::Component*>(page.sheet)
              ->keyPressed(juce::KeyPress('s', juce::ModifierKeys::ctrlModifier, 0)));
    CHECK_FALSE(model.document().isDirty());
    CHECK(page.view.sheet() == page.sheet);
    // Nothing else of the window.
    const std::size_t steps = model.document().steps().size();
    CHECK(static_cast<juce::Component*>(page.sheet)
              ->keyPressed(juce::KeyPress('e', juce::ModifierKeys::ctrlModifier, 0)));
    CHECK(page.view.sheet() == page.sheet);
    CHECK(model.document().steps().size() == steps);
}

TEST_CASE("Pages and sheets that change the project undo and save; questions and dialogs do not")
{
    EditorBench bench;
    bench.openDemo("knock_wood_bridge");
    auto& model = bench.session.model;
    const TempFolder folder;
    REQUIRE(model.saveAs(folder / "one.pacini"));
    const auto press = [&](int key)
    {
        return bench.view.sheet()->keyPressed(juce::KeyPress(key, juce::ModifierKeys::ctrlModifier, 0));
    };
    bench.view.doCommand(editor::fadeOut);
    REQUIRE(bench.view.doCommand(editor::showHistory));
    press('z');
    CHECK_FALSE(model.document().steps().canUndo());
    press('y');
    CHECK(model.document().isDirty());
    press('s');
    CHECK_FALSE(model.document().isDirty());
    bench.view.showSheet(nullptr);
    bench.view.doCommand(editor::fadeIn);
    REQUIRE(bench.view.doCommand(editor::measureActuator));
    press('s');
    CHECK_FALSE(model.document().isDirty());
    bench.view.showSheet(nullptr);
    REQUIRE(bench.view.doCommand(editor::exportClips));
    press('z');
    CHECK(model.document().steps().canUndo());
    bench.view.showSheet(nullptr);
}

TEST_CASE("Keys on the closed list of clips add none")
{
    ScenePage page;
    auto& list = get<juce::ComboBox>(*page.sheet, "Add clip");
    REQUIRE(list.getNumItems() == 2);
    for (const int key : {juce::KeyPress::downKey, juce::KeyPress::downKey, juce::KeyPress::upKey})
        CHECK(list.keyPressed(juce::KeyPress(key)));
    CHECK(page.scene().parts.empty());
}

TEST_CASE("What is left out of a scene is said in words, without a figure where nothing is felt of it")
{
    SceneForecast all{{}, 0, -std::numeric_limits<double>::infinity(), 1.0};
    CHECK(editor::forecastText(1, all) == "1 clip, felt");
    CHECK(editor::forecastText(2, all) == "2 clips, all felt");
    SceneForecast silent = all;
    silent.bands = 3;
    CHECK(editor::forecastText(2, silent) == "2 clips; 3 bands skipped, no difference that is felt");
    silent.bands = 1;
    silent.leftOut[0] = "why";
    silent.error = -12.34;
    CHECK(editor::forecastText(2, silent) == "2 clips; 1 clip left out, 1 band skipped, error -12.3 dB");
}

TEST_CASE("What belongs to no clip has no number on the scene page")
{
    ScenePage page;
    for (const char* name : {"Value", "Priority", "Repeats"})
    {
        CAPTURE(name);
        auto& slider = get<juce::Slider>(*page.sheet, name);
        CHECK(slider.getTextFromValue(slider.getValue()).startsWith(juce::String::fromUTF8("–")));
    }
    page.sheet->parts().add(page.first, 0.0);
    for (const char* name : {"Value", "Priority", "Repeats"})
    {
        CAPTURE(name);
        auto& slider = get<juce::Slider>(*page.sheet, name);
        CHECK(slider.getTextFromValue(slider.getValue()).containsAnyOf("0123456789"));
    }
}
