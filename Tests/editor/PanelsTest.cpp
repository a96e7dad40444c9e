// The pages Analysis and Project without a screen.

#include "editor/Bench.h"
#include "editor/Pump.h"
#include "editor/Text.h"
#include "editor/clip/panels/AnalysisPanel.h"
#include "editor/clip/panels/PlayPanel.h"
#include "editor/clip/panels/ProjectPanel.h"
#include "editor/clip/session/ClipSteps.h"
#include "io/AudioWriter.h"
#include "io/EncoderPresets.h"
#include "io/FinishedClip.h"
#include "support/TempFolder.h"

#include <cmath>
#include <numbers>

using namespace pacini;
using namespace pacini::test;

namespace
{
bool analysed(const editor::Session& session)
{
    return !session.sounds.workNow();
}

/// Both pages open beside two demo sounds.
struct Pages : EditorBench
{
    editor::AnalysisPanel analysis{view};
    editor::ProjectPanel project{view};

    Pages()
    {
        analysis.setSize(240, 640);
        project.setSize(240, 640);
        openDemo("knock_wood_bridge");
    }

    [[nodiscard]] std::vector<std::string> names()
    {
        std::vector<std::string> all;
        for (const auto& row : project.clips().rows())
            all.push_back(row.clip == 0 ? "[" + row.group + "]" : session.model.document().clip(row.clip)->clip->name);
        return all;
    }
};
using Names = std::vector<std::string>;
} // namespace

TEST_CASE("Knobs of the analysis run it again after a pause as one step, the hand edits stay, undo shows the old knobs")
{
    Pages pages;
    auto& session = pages.session;
    Clip edited = pages.clip();
    edited.transients.front().amplitude = 0.25;
    REQUIRE(editor::setClip(session.model, "Softer", edited));
    auto& bands = get<juce::Slider>(pages.analysis, "Bands");
    REQUIRE(bands.isEnabled());
    CHECK(bands.getValue() == 12.0);
    // Several moves, one step.
    for (const double value : {13.0, 15.0, 20.0})
        bands.setValue(value, juce::sendNotificationSync);
    CHECK(pages.clip().bands.size() == 12);
    REQUIRE(pumpUntil([&] { return pages.clip().bands.size() == 20; }));
    CHECK(pages.clip().transients.front().amplitude == Approx(0.25));
    CHECK(session.model.item()->encoder.bands == 20);
    CHECK(session.model.document().steps().undoName() == "Analysis");
    CHECK(session.model.item()->clip->name == "knock_wood_bridge");
    session.model.undo();
    CHECK(pages.clip() == edited);
    CHECK(bands.getValue() == 12.0);
    CHECK(session.model.document().steps().undoName() == "Softer");
}

TEST_CASE("Version A is shown with the settings of its analysis, and is taken back with them")
{
    Pages pages;
    auto& session = pages.session;
    auto& bands = get<juce::Slider>(pages.analysis, "Bands");
    const auto first = *session.model.item();
    session.model.keepVersion();
    bands.setValue(20.0, juce::sendNotificationSync);
    REQUIRE(pumpUntil([&] { return pages.clip().bands.size() == 20; }));
    session.model.setComparing(true);
    CHECK(pages.clip().bands.size() == 12);
    CHECK(bands.getValue() == 12.0);
    CHECK_FALSE(bands.isEnabled());
    session.model.setComparing(false);
    CHECK(bands.getValue() == 20.0);
    CHECK(bands.isEnabled());
    editor::takeVersion(session.model);
    CHECK(*session.model.item() == first);
    CHECK(bands.getValue() == 12.0);
    session.model.undo();
    CHECK(bands.getValue() == 20.0);
    CHECK(pages.clip().bands.size() == 20);
}

TEST_CASE("Presets set all knobs, own settings have no preset, reset goes back to the usual ones")
{
    Pages pages;
    auto& preset = get<juce::ComboBox>(pages.analysis, "Preset");
    CHECK(preset.getText() == "As recorded");
    preset.setSelectedId(2, juce::sendNotificationSync);
    CHECK(pages.analysis.params() == encoderPresets()[1].params);
    pages.analysis.carryOut();
    REQUIRE(pumpUntil([&] { return analysed(pages.session); }));
    CHECK(pages.session.model.item()->encoder == encoderPresets()[1].params);
    get<juce::Slider>(pages.analysis, "Detail").setValue(33.0, juce::sendNotificationSync);
    CHECK(preset.getSelectedId() == 0);
    CHECK(preset.getText() == "Custom");
    // The ends of the bands never cross.
    get<juce::Slider>(pages.analysis, "Lowest").setValue(900.0, juce::sendNotificationSync);
    get<juce::Slider>(pages.analysis, "Highest").setValue(200.0, juce::sendNotificationSync);
    CHECK(validate(pages.analysis.params()));
    CHECK(pages.analysis.params().highFrequency == 200.0);
    CHECK(pages.analysis.params().lowFrequency < 200.0);
    for (auto* child : pages.analysis.getChildren())
        if (auto* button = dynamic_cast<juce::TextButton*>(child);
            button != nullptr && button->getButtonText() == "Reset")
            button->onClick();
    CHECK(pages.analysis.params() == EncoderParams{});
}

TEST_CASE("A clip without a sound cannot be analysed, and says why")
{
    Pages pages;
    Clip clip = pages.clip();
    clip.name = "drawn";
    pages.session.sounds.add({{}, nullptr, {}, clip, {}});
    CHECK_FALSE(get<juce::Slider>(pages.analysis, "Bands").isEnabled());
    CHECK_FALSE(get<juce::ComboBox>(pages.analysis, "Preset").isEnabled());
    CHECK(get<juce::Label>(pages.analysis, "Source sound").getText().contains("no source sound"));
    CHECK_FALSE(get<juce::ToggleButton>(pages.project, "Embed the sound in the project").isEnabled());
}

TEST_CASE("Edits that found no place are listed with their reasons, shown where they are, and removed")
{
    Pages pages;
    auto& session = pages.session;
    // An edit of the highest band, which the lower range does not have.
    Clip edited = pages.clip();
    edited.bands.back().amplitude = {{0.0, 0.2}, {0.1, 0.9}, {edited.duration, 0.1}};
    REQUIRE(editor::setClip(session.model, "Draw", edited));
    EncoderParams low;
    low.highFrequency = 200.0;
    low.bands = 4;
    session.sounds.reanalyse(low);
    REQUIRE(pumpUntil([&] { return analysed(session); }));
    REQUIRE(session.model.item()->unfitting.size() == 1);
    auto& list = get<juce::ListBox>(pages.analysis, "Unapplied edits");
    CHECK(list.isVisible());
    REQUIRE(list.getModel()->getNumRows() == 1);
    CHECK(list.getModel()->getNameForRow(0).contains(juce::String(session.model.item()->unfitting[0].reason)));
    session.viewState.showRange({0.3, 0.31});
    list.getModel()->returnKeyPressed(0);
    CHECK(session.viewState.axis().visible(session.viewState.viewWidth()).from < 0.01);
    list.getModel()->deleteKeyPressed(0);
    REQUIRE(pumpUntil([&] { return session.model.item()->unfitting.empty(); }));
    CHECK(session.model.item()->edits.size() == 0);
    CHECK_FALSE(list.isVisible());
    session.model.undo();
    CHECK(session.model.item()->unfitting.size() == 1);
}

TEST_CASE("Another sound comes under the edits of a clip, which keeps its name; a clip is no sound")
{
    TempFolder folder;
    std::vector<float> samples(48000);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] =
            static_cast<float>(0.5 * std::sin(2.0 * std::numbers::pi * 150.0 * static_cast<double>(i) / 48000.0));
    REQUIRE(writeAudio(folder / "tone.wav", samples, {.sampleRate = 48000}));
    Pages pages;
    auto& session = pages.session;
    const Clip before = pages.clip();
    REQUIRE(editor::editClip(session.model, "Gain", GainEdit{{}, -6.0}));
    session.sounds.replaceSound(folder / "tone.wav");
    REQUIRE(pumpUntil([&] { return analysed(session); }));
    CHECK(pages.clip().duration == Approx(1.0));
    CHECK(pages.clip().name == before.name);
    CHECK(session.model.document().steps().undoName() == "Replace sound");
    REQUIRE(session.sounds.soundOfClip() != nullptr);
    CHECK(session.sounds.soundOfClip()->audio.duration() == Approx(1.0));
    const Clip& analysis = *session.model.item()->analysis;
    const Clip imported = editor::importFile(folder / "tone.wav", session.model.item()->encoder)->clip;
    const Clip expected = finishClip(imported, {before.name, imported.source.file}); // sealed with its name
    CHECK(analysis == expected);
    REQUIRE(pages.clip().envelope.size() == analysis.envelope.size());
    for (std::size_t i = 0; i < analysis.envelope.size(); ++i)
        CHECK(pages.clip().envelope[i].value == Approx(analysis.envelope[i].value * std::pow(10.0, -6.0 / 20.0)));
    session.model.undo();
    session.model.undo();
    CHECK(pages.clip() == before);
    CHECK(session.sounds.soundOfClip()->audio.duration() == Approx(before.duration));
    juce::String told;
    session.model.onError = [&](const juce::String&, const juce::String& text)
    {
        told = text;
    };
    put(folder / "clip.json", "{}");
    session.sounds.replaceSound(folder / "clip.json");
    REQUIRE(pumpUntil([&] { return analysed(session); }));
    CHECK(told.isNotEmpty());
    CHECK(pages.clip() == before);
}

TEST_CASE("Clips are chosen, renamed, duplicated, moved, grouped and removed in the list, and all of it is undone")
{
    Pages pages;
    auto& session = pages.session;
    auto& list = pages.project.clips();
    pages.openDemo("drums_tabla_pattern");
    CHECK(pages.names() == Names{"knock_wood_bridge", "drums_tabla_pattern"});
    CHECK(list.chosenRow() == 1);
    list.choose(0);
    CHECK(session.model.item()->clip->name == "knock_wood_bridge");
    const Project before = session.model.document().project();
    list.rename(0, "  Knock  ");
    list.rename(0, "");
    list.duplicate(0);
    CHECK(pages.names() == Names{"Knock", "Knock", "drums_tabla_pattern"});
    CHECK(list.chosenRow() == 1);
    list.rename(1, "Second");
    list.move(1, 3);
    CHECK(pages.names() == Names{"Knock", "drums_tabla_pattern", "Second"});
    CHECK(list.chosenRow() == 2);
    list.addGroup(0);
    CHECK(pages.names() == Names{"drums_tabla_pattern", "Second", "[Group]", "Knock"});
    CHECK(list.chosenRow() == 1);
    list.choose(2);
    list.rename(2, "Doors");
    CHECK(list.chosenRow() == 2);
    list.setGroup(0, "Doors");
    CHECK(pages.names() == Names{"Second", "[Doors]", "Knock", "drums_tabla_pattern"});
    list.choose(2);
    list.move(2, 1);
    CHECK(pages.names() == Names{"Second", "Knock", "[Doors]", "drums_tabla_pattern"});
    CHECK(list.chosenRow() == 1);
    list.move(1, 3);
    CHECK(list.chosenRow() == 2);
    list.remove(1);
    CHECK(pages.names() == Names{"Knock", "drums_tabla_pattern", "Second"});
    list.remove(0);
    CHECK(pages.names() == Names{"drums_tabla_pattern", "Second"});
    while (session.model.document().project().clips.size() != 2 || !(session.model.document().project() == before))
    {
        REQUIRE(session.model.document().steps().canUndo());
        session.model.undo();
    }
}

TEST_CASE("Several selected clips are grouped, exported and removed in one step each")
{
    Pages pages;
    auto& session = pages.session;
    for (const char* name : {"drums_tabla_pattern", "impact_boom", "click_clock"})
        pages.openDemo(name);
    auto& list = pages.project.clips();
    auto& box = get<juce::ListBox>(list, "Clips of the project");
    box.selectRow(1);
    box.selectRow(2, false, false); // beside the first
    CHECK(session.model.selectedClips().size() == 2);
    const std::size_t steps = session.model.document().steps().size();
    list.setGroup(2, "Doors");
    CHECK(pages.names() == Names{"knock_wood_bridge", "click_clock", "[Doors]", "drums_tabla_pattern", "impact_boom"});
    CHECK(session.model.document().steps().size() == steps + 1);
    CHECK(session.model.selectedClips().size() == 2);
    CHECK(box.getNumSelectedRows() == 2);
    REQUIRE(pages.view.doCommand(editor::exportClips));
    CHECK(find<juce::ToggleButton>(*pages.view.sheet(), "Export all clips")->getToggleState());
    CHECK(find<juce::ToggleButton>(*pages.view.sheet(), "Export all clips")->getButtonText() == "2 selected clips");
    pages.view.showSheet(nullptr);
    get<juce::TextEditor>(pages.project, "Clip tags").setText("doors, Soft,, soft", true);
    CHECK(pumpUntil([&] { return session.model.document().steps().size() == steps + 2; }));
    CHECK(session.model.item()->tags == std::vector<std::string>{"doors", "Soft"});
    list.search("soft");
    CHECK(pages.names() == Names{"drums_tabla_pattern", "impact_boom"});
    list.search("");
    session.model.undo();
    CHECK(session.model.item()->tags.empty());
    box.selectRow(3);
    box.selectRow(4, false, false);
    list.remove(3);
    CHECK(pages.names() == Names{"knock_wood_bridge", "click_clock", "[Doors]"});
    CHECK(session.model.document().steps().size() == steps + 2);
    session.model.undo();
    CHECK(session.model.document().project().clips.size() == 4);
    // Another one than the shown goes, and the list and the recovery follow.
    session.model.show(session.model.document().project().clips.front()->id);
    int told = 0;
    editor::Subscriptions heard;
    heard.on({&session.model.projectChanged}, [&] { ++told; });
    const int other = session.model.document().project().clips.back()->id;
    editor::removeClips(session.model, {other});
    CHECK(told > 0);
    CHECK(list.rows().size() == 4); // three clips and a group
    session.model.undo();
    // What the list shows afterwards is one clip.
    session.model.show(session.model.document().project().clips.front()->id);
    CHECK(session.model.selectedClips().size() == 1);
}

TEST_CASE("Selected clips are analysed with the settings of the shown one, as one step")
{
    Pages pages;
    auto& session = pages.session;
    pages.openDemo("impact_boom");
    pages.openDemo("click_clock");
    CHECK_FALSE(pages.view.doCommand(editor::analyseAlike)); // one is selected
    auto settings = session.model.item()->encoder;
    settings.bands = 5;
    session.sounds.reanalyse(settings);
    REQUIRE(pumpUntil([&] { return analysed(session) && session.model.item()->encoder.bands == 5; }));
    auto& box = get<juce::ListBox>(pages.project.clips(), "Clips of the project");
    box.selectRow(1);
    box.selectRow(2, false, false);
    const std::size_t steps = session.model.document().steps().size();
    const auto first = session.model.document().project().clips[0],
               second = session.model.document().project().clips[1];
    REQUIRE(session.model.activeId() == session.model.document().project().clips[2]->id);
    REQUIRE(pages.view.doCommand(editor::analyseAlike));
    REQUIRE(pumpUntil([&] { return analysed(session); }));
    const auto& clips = session.model.document().project().clips;
    CHECK(clips[0] == first);
    CHECK(clips[1]->encoder.bands == 5);
    CHECK(clips[1]->clip->bands.size() <= 5);
    CHECK(clips[1]->clip->name == second->clip->name);
    CHECK(session.model.document().steps().size() == steps + 1);
    session.model.undo();
    CHECK(session.model.document().project().clips[1]->encoder.bands == second->encoder.bands);
}

TEST_CASE("A file that is typed with the ending of another format is exported in that format")
{
    Pages pages;
    REQUIRE(pages.view.doCommand(editor::exportClips));
    auto& sheet = *pages.view.sheet();
    auto& target = get<juce::TextEditor>(sheet, "Destination file or folder");
    auto& format = get<juce::ComboBox>(sheet, "Format");
    const TempFolder folder;
    target.setText(juce::String((folder / "made.haptic").string()), false);
    target.onTextChange();
    CHECK(format.getText().contains(".haptic"));
    CHECK(target.getText().endsWith("made.haptic"));
    target.onReturnKey();
    CHECK(pumpUntil([&] { return std::filesystem::exists(folder / "made.haptic"); }));
}

TEST_CASE("Five hundred clips are searched by words of name, group and notes, and only rows in sight are components")
{
    Pages pages;
    auto& model = pages.session.model;
    Project many;
    for (int i = 0; i < 500; ++i)
    {
        ClipItem item;
        item.id = i + 1;
        Clip clip;
        clip.duration = 1.0;
        clip.name = (i % 5 == 0 ? "door " : "step ") + std::to_string(i);
        item.group = i % 2 == 0 ? "Even" : "";
        item.notes = i == 7 ? "squeaks" : "";
        item.clip = item.analysis = std::make_shared<const Clip>(std::move(clip));
        many.clips.push_back(std::make_shared<const ClipItem>(std::move(item)));
    }
    many.groups = {"Even"};
    model.openProject(std::move(many));
    auto& list = pages.project.clips();
    CHECK(list.rows().size() == 501);
    list.search("door even");
    CHECK(list.rows().size() == 50);
    list.search("squeaks");
    CHECK(pages.names() == Names{"step 7"});
    list.search("nothing");
    CHECK(list.rows().empty());
    list.search("");
    CHECK(list.rows().size() == 501);
    int parts = 0;
    const auto count = [&](auto& self, juce::Component& inside) -> void
    {
        for (auto* child : inside.getChildren())
        {
            ++parts;
            self(self, *child);
        }
    };
    count(count, list);
    CHECK(parts < 100);
}

TEST_CASE("Keys of the list choose, rename and remove")
{
    Pages pages;
    auto& list = pages.project.clips();
    pages.openDemo("drums_tabla_pattern");
    auto& box = get<juce::ListBox>(list, "Clips of the project");
    const auto press = [&](const juce::KeyPress& key)
    {
        return box.keyPressed(key);
    };
    list.choose(1);
    press(juce::KeyPress(juce::KeyPress::upKey));
    CHECK(list.chosenRow() == 0);
    press(juce::KeyPress(juce::KeyPress::returnKey));
    auto& field = get<juce::TextEditor>(list, "Clip name");
    CHECK(field.getText() == "knock_wood_bridge");
    field.setText("Knock");
    field.onReturnKey();
    CHECK(pages.names() == Names{"Knock", "drums_tabla_pattern"});
    CHECK(find<juce::TextEditor>(list, "Clip name") == nullptr);
    press(juce::KeyPress(juce::KeyPress::deleteKey));
    CHECK(pages.names() == Names{"drums_tabla_pattern"});
    pumpFor(0.05);
}

TEST_CASE("Notes of clip and project are steps, each with the clip that they were typed for")
{
    Pages pages;
    auto& session = pages.session;
    pages.openDemo("drums_tabla_pattern");
    auto& ofClip = get<juce::TextEditor>(pages.project, "Clip notes");
    auto& ofProject = get<juce::TextEditor>(pages.project, "Project notes");
    ofClip.setText("slower", true);
    ofProject.setText("for the wristband", true);
    ofClip.onTextChange();
    const int typedFor = session.model.activeId();
    pages.project.clips().choose(0);
    CHECK(session.model.document().clip(typedFor)->notes == "slower");
    CHECK(session.model.document().project().notes == "for the wristband");
    CHECK(session.model.item()->notes.empty());
    CHECK(ofClip.getText().isEmpty());
    CHECK(ofProject.getText() == "for the wristband");
    pages.project.clips().choose(1);
    CHECK(ofClip.getText() == "slower");
    session.model.undo();
    session.model.undo();
    CHECK(ofClip.getText().isEmpty());
    CHECK(ofProject.getText().isEmpty());
}

TEST_CASE("No control of the pages is cut off or lies on another, at any size")
{
    Pages pages;
    for (const int width : {216, 240, 320})
        for (juce::Component* page : std::initializer_list<juce::Component*>{&pages.analysis, &pages.project})
        {
            page->setSize(width, page == &pages.analysis ? 672 : 608);
            const auto& children = page->getChildren();
            for (int i = 0; i < children.size(); ++i)
            {
                if (!children[i]->isVisible())
                    continue;
                INFO(page->getTitle() << " " << children[i]->getTitle() << " " << i);
                CHECK(page->getLocalBounds().contains(children[i]->getBounds()));
                CHECK(children[i]->getWidth() > 0);
                CHECK(children[i]->getHeight() >= 12);
                for (int k = i + 1; k < children.size(); ++k)
                    if (children[k]->isVisible())
                        CHECK_FALSE(children[i]->getBounds().intersects(children[k]->getBounds()));
            }
        }
}

TEST_CASE(
    "Live controls are kept as presets: settings files that the Play page offers and refuses where they are broken")
{
    const TempFolder folder;
    EditorBench bench;
    editor::HostServices around;
    around.characterPresetFolder = folder / "presets";
    editor::EditorView view(bench.session, around);
    view.setBounds(0, 0, 1280, 800);
    editor::PlayPanel panel(view);
    panel.setSize(240, 480);
    auto& preset = get<juce::ComboBox>(panel, "Preset");
    CHECK(preset.getText() == "Neutral");
    const auto slide = [&](const char* name, double value)
    {
        get<juce::Slider>(panel, name).setValue(value, juce::sendNotificationSync);
    };
    slide("Gain", -6.5);
    slide("Intensity", 70.0);
    slide("Pitch", 7.0);
    slide("Speed", 0.5);
    CHECK(preset.getText() == "Custom");
    panel.saveAs("slow and deep");
    CHECK(preset.getText() == "slow and deep");
    const auto read = readCharacterSettings(folder / "presets" / "slow and deep.json");
    REQUIRE(read);
    CHECK(*read == CharacterSettings{-6.5, 0.7, 7.0, 0.5});
    preset.setSelectedId(1, juce::sendNotificationSync);
    CHECK(bench.session.transport.controls().speed == 1.0);
    CHECK(preset.getText() == "Neutral");
    int own = 0;
    for (int i = 0; i < preset.getNumItems(); ++i)
        if (preset.getItemText(i) == "slow and deep")
            own = preset.getItemId(i);
    REQUIRE(own != 0);
    preset.setSelectedId(own, juce::sendNotificationSync);
    CHECK(bench.session.transport.controls().speed == 0.5);
    CHECK(bench.session.transport.controls().transposition == 7.0);
    CHECK(get<juce::Slider>(panel, "Gain").getValue() == -6.5);
    CHECK(preset.getText() == "slow and deep");

    const auto refused = [&](const std::string& text, const std::string& where)
    {
        put(folder / "broken.json", text);
        const auto broken = readCharacterSettings(folder / "broken.json");
        REQUIRE_FALSE(broken);
        CHECK(broken.error().where == where);
    };
    const std::string head = R"({"format": "pacini.settings", "version": 1)";
    refused("no settings", "line 1, column 2");
    refused(head + "}", "character");
    refused(head + R"(, "character": {"speed": 9}})", "character.speed");
    refused(head + R"(, "character": {"gain": "loud"}})", "character.gain");
    CHECK_FALSE(readCharacterSettings(folder / "not there.json"));
    put(folder / "part.json", head + R"(, "character": {"speed": 2}})");
    const auto part = readCharacterSettings(folder / "part.json");
    REQUIRE(part);
    CHECK(*part == CharacterSettings{0.0, 1.0, 0.0, 2.0});
    // What an old preset of this name has become is told, and nothing changes.
    put(folder / "presets" / "slow and deep.json", "{}");
    preset.setSelectedId(1, juce::sendNotificationSync);
    preset.setSelectedId(own, juce::sendNotificationSync);
    REQUIRE(view.sheet() != nullptr);
    CHECK(bench.session.transport.controls().speed == 1.0);
}

namespace
{
/// The panel of analysis with a folder of own presets, and its box of presets.
struct PresetBench
{
    PresetBench()
    {
        view.setBounds(0, 0, 1280, 800);
        panel.setSize(240, 640);
        bench.openDemo("knock_wood_bridge");
    }

    int idOf(const juce::String& name) const
    {
        for (int i = 0; i < preset.getNumItems(); ++i)
            if (preset.getItemText(i) == name)
                return preset.getItemId(i);
        return 0;
    }

    static editor::HostServices withPresets(const std::filesystem::path& folder)
    {
        editor::HostServices around;
        around.presetFolder = folder;
        return around;
    }

    TempFolder folder;
    EditorBench bench;
    editor::EditorView view{bench.session, withPresets(folder / "presets")};
    editor::AnalysisPanel panel{view};
    juce::ComboBox& preset = get<juce::ComboBox>(panel, "Preset");
};
} // namespace

TEST_CASE("Own presets are settings files, which the menu offers, asks before it replaces, and the command reads")
{
    PresetBench presets;
    auto& view = presets.view;
    auto& panel = presets.panel;
    auto& preset = presets.preset;
    const auto& folder = presets.folder;
    get<juce::Slider>(panel, "Bands").setValue(7.0, juce::sendNotificationSync);
    const EncoderParams wanted = panel.params();
    panel.saveAs("doors");
    CHECK(preset.getText() == "doors");
    const auto read = readAnalysisSettings(folder / "presets" / "doors.json");
    REQUIRE(read);
    CHECK(read->bands == 7);
    CHECK(presetOf(*read) == presetOf(wanted));
    preset.setSelectedId(1, juce::sendNotificationSync);
    CHECK(panel.params().bands != 7);
    REQUIRE(presets.idOf("doors") != 0);
    preset.setSelectedId(presets.idOf("doors"), juce::sendNotificationSync);
    CHECK(panel.params().bands == 7);
    CHECK(preset.getText() == "doors");
    // One of this name is replaced after a question only; names that are no files are refused.
    get<juce::Slider>(panel, "Bands").setValue(9.0, juce::sendNotificationSync);
    panel.saveAs("doors");
    REQUIRE(view.sheet() != nullptr);
    CHECK(readAnalysisSettings(folder / "presets" / "doors.json")->bands == 7);
    answer(*view.sheet(), "Replace");
    CHECK(readAnalysisSettings(folder / "presets" / "doors.json")->bands == 9);
    view.showSheet(nullptr);
    panel.saveAs("../doors");
    REQUIRE(view.sheet() != nullptr);
    CHECK(view.sheet()->getTitle() == "Preset not saved");
    CHECK_FALSE(std::filesystem::exists(folder / "doors.json"));
}

TEST_CASE("Own presets are renamed and deleted, never over another one")
{
    PresetBench presets;
    auto& view = presets.view;
    auto& panel = presets.panel;
    auto& preset = presets.preset;
    const auto& folder = presets.folder;
    const juce::String manage = editor::toText("Manage presets…");
    CHECK(presets.idOf(manage) == 0); // there are none
    get<juce::Slider>(panel, "Bands").setValue(7.0, juce::sendNotificationSync);
    panel.saveAs("doors");
    get<juce::Slider>(panel, "Bands").setValue(9.0, juce::sendNotificationSync);
    panel.saveAs("floors");
    const auto open = [&]() -> juce::ListBox&
    {
        view.showSheet(nullptr);
        preset.setSelectedId(presets.idOf(manage), juce::sendNotificationSync);
        REQUIRE(view.sheet() != nullptr);
        CHECK(preset.getText() == "floors"); // what is in use stays
        return get<juce::ListBox>(*view.sheet(), "Own presets");
    };
    const auto nameField = [&]() -> juce::TextEditor&
    {
        return get<juce::TextEditor>(view, "Name of the preset");
    };
    open();
    // Another's name is refused, and nothing is lost.
    answer(*view.sheet(), editor::toText("Rename…"));
    CHECK(nameField().getText() == "doors");
    nameField().setText("floors");
    nameField().onReturnKey();
    CHECK(readAnalysisSettings(folder / "presets" / "doors.json")->bands == 7);
    CHECK(readAnalysisSettings(folder / "presets" / "floors.json")->bands == 9);
    // The one in use is shown by its new name.
    open().selectRow(1);
    answer(*view.sheet(), editor::toText("Rename…"));
    nameField().setText("windows");
    nameField().onReturnKey();
    CHECK(preset.getText() == "windows");
    CHECK(presets.idOf("windows") != 0);
    CHECK(presets.idOf("floors") == 0);
    CHECK(readAnalysisSettings(folder / "presets" / "windows.json")->bands == 9);
    CHECK_FALSE(std::filesystem::exists(folder / "presets" / "floors.json"));
    // Deleted after a question; what is set stays.
    view.showSheet(nullptr);
    preset.setSelectedId(presets.idOf(manage), juce::sendNotificationSync);
    get<juce::ListBox>(*view.sheet(), "Own presets").selectRow(1);
    answer(*view.sheet(), editor::toText("Delete…"));
    CHECK(std::filesystem::exists(folder / "presets" / "windows.json"));
    answer(*view.question(), "Delete");
    CHECK_FALSE(std::filesystem::exists(folder / "presets" / "windows.json"));
    CHECK(presets.idOf("windows") == 0);
    CHECK(presets.idOf("doors") != 0);
    CHECK(preset.getText() == "Custom");
    CHECK(panel.params().bands == 9);
}
