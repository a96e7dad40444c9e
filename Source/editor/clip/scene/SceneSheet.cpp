// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/scene/SceneSheet.h"

#include "editor/Controls.h"
#include "editor/FileQuestion.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/session/Sound.h"
#include "editor/clip/sheets/OverwriteQuestion.h"
#include "io/SceneFile.h"

#include <pacini/synthesis/CompileParams.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace pacini::editor
{

namespace
{
constexpr int wholeWindow = 4000; // more than any has
constexpr int controlHeight = 30;

/// Parameter of a part that is offered, and whether a clip and a texture have it.
struct Offered
{
    SceneParameter parameter;
    const char* name;
    bool ofClip, ofTexture;
};
constexpr std::array<Offered, 10> offered{{{SceneParameter::pan, "Position", true, true},
                                           {SceneParameter::gain, "Gain", true, true},
                                           {SceneParameter::speed, "Speed", false, true},
                                           {SceneParameter::force, "Force", false, true},
                                           {SceneParameter::transposition, "Pitch", true, false},
                                           {SceneParameter::stretch, "Stretch", true, true},
                                           {SceneParameter::delay, "Delay", true, true},
                                           {SceneParameter::tones, "Tones", true, true},
                                           {SceneParameter::events, "Events", true, false},
                                           {SceneParameter::noise, "Noise", true, true}}};
constexpr int idOf(SceneParameter parameter)
{
    return 1 + static_cast<int>(parameter);
}
constexpr int mostRepeats = 100;
constexpr int mostWarnings = 12; // lines of a message
} // namespace

juce::String forecastText(std::size_t parts, const SceneForecast& scene)
{
    const bool differs = scene.error > CompileParams().tolerance;
    if (scene.leftOut.empty() && scene.bands == 0 && !differs)
        return counted(parts, "{0} clip, felt", "{0} clips, all felt");
    juce::StringArray changes;
    if (!scene.leftOut.empty())
        changes.add(counted(scene.leftOut.size(), "{0} clip left out", "{0} clips left out"));
    if (scene.bands > 0)
        changes.add(counted(scene.bands, "{0} band skipped", "{0} bands skipped"));
    changes.add(differs ? tr("error {0} dB", {numberText(scene.error, 1)}) : tr("no difference that is felt"));
    return counted(parts, "{0} clip", "{0} clips") + "; " + changes.joinIntoString(", ");
}

SceneSheet::SceneSheet(Session& shared)
    : Sheet("Scene", wholeWindow, wholeWindow),
      session(shared),
      selection(shared.model),
      line(shared.model, selection),
      curve(shared.model, selection),
      playButton("Play"),
      removeButton("Remove"),
      removeCurveButton("Remove curve"),
      fitButton("Fit"),
      openButton(toText("Open scene…")),
      exportButton(toText("Export scene…"))
{
    const auto label = [this](juce::Label& one, const juce::String& text)
    {
        prepareLabel(one, text, smallFont());
        addAndMakeVisible(one);
    };
    label(clipsLabel, "Add clip");
    label(actuatorsLabel, "Actuators");
    label(lawLabel, "Panning");
    label(parameterLabel, "Curve");
    label(valueLabel, "Value");
    label(priorityLabel, "Priority");
    label(repeatsLabel, "Repeats");
    label(note, {});
    note.setAccessible(true);
    prepareChoices();
    prepareSliders();
    for (juce::TextButton* button :
         {&playButton, &removeButton, &removeCurveButton, &fitButton, &openButton, &exportButton})
        button->setTitle(button->getButtonText());
    makePrimary(playButton);
    prepareButton(playButton, "Plays the scene on the haptic outputs from the cursor on, or stops (Space)",
                  [this] { plays ? stop() : play(); });
    prepareButton(removeButton, "Removes the selected clip from the scene (Delete)",
                  [this] { selection.removeSelected(); });
    prepareButton(removeCurveButton, "Plays the value instead of the curve", [this] { curve.removeCurve(); });
    prepareButton(fitButton, "Shows the whole scene", [this] { line.fit(); });
    prepareButton(openButton, "Opens a scene file with its clips in place of this scene", [this] { openScene(); });
    prepareButton(exportButton, "Writes a scene file with all clips, for pacini render and the game library",
                  [this] { exportScene(); });
    addAll(*this, {&line, &clips, &actuators, &law, &playButton, &removeButton, &fitButton, &parameter, &value,
                   &priority, &repeats, &removeCurveButton, &curve, &openButton, &exportButton});
    setAnswers({{"Close", {}}});
    subscriptions.on({&session.model.projectChanged, &session.actuators.changed},
                     [this]
                     {
                         fillClips();
                         follow();
                         plan();
                     });
    subscriptions.on({&selection.changed}, [this] { follow(); });
    fillClips();
    follow();
    plan();
}

void SceneSheet::prepareChoices()
{
    clips.setTitle("Add clip");
    clips.setTooltip("Adds a clip of the project at the cursor");
    clips.setTextWhenNothingSelected(tr("Choose a clip"));
    clips.onChange = [this]
    {
        if (const int id = clips.getSelectedId(); id > 0)
            selection.add(id, line.cursor());
        clips.setSelectedId(0, juce::dontSendNotification);
    };
    actuators.setTitle("Actuators");
    actuators.setTooltip("Number of actuators in the row from pan 0 to pan 1");
    for (int i = 1; i <= limits::actuators; ++i)
        actuators.addItem(juce::String(i), i);
    actuators.onChange = [this]
    {
        selection.edit("Actuators of scene",
                       [this](ProjectScene& scene) { scene.actuators = actuators.getSelectedId(); });
    };
    law.setTitle("Panning");
    law.setTooltip("How the position moves over the actuators");
    law.addItemList({"By level", "By delay", "Both"}, 1);
    law.onChange = [this]
    {
        selection.edit("Panning of scene",
                       [this](ProjectScene& scene) { scene.panLaw = static_cast<PanLaw>(law.getSelectedId() - 1); });
    };
    parameter.setTitle("Curve");
    parameter.setTooltip("Parameter that the curve changes while the clip plays");
    parameter.onChange = [this]
    {
        if (const int id = parameter.getSelectedId(); id > 0)
            curve.show(static_cast<SceneParameter>(id - 1));
        follow();
    };
}

void SceneSheet::prepareSliders()
{
    value.setTitle("Value");
    value.setTooltip("Of the whole clip, where it has no curve");
    value.setSliderStyle(juce::Slider::LinearHorizontal);
    value.setTextBoxStyle(juce::Slider::TextBoxRight, false, 9 * grid, 3 * grid);
    value.onDragStart = [this]
    {
        sliding = selection.beginGesture();
    };
    value.onDragEnd = [this]
    {
        sliding = 0;
    };
    value.onValueChange = [this]
    {
        selection.editPart(
            "Change in scene", [this](ScenePart& part) { valueOf(part.play, curve.parameter()) = value.getValue(); },
            sliding);
    };
    priority.setTitle("Priority");
    priority.setTooltip("0 is kept longest when an actuator has too few voices");
    priority.setSliderStyle(juce::Slider::LinearHorizontal);
    priority.setTextBoxStyle(juce::Slider::TextBoxRight, false, 5 * grid, 3 * grid);
    priority.setRange(0.0, 10.0, 1.0);
    priority.onValueChange = [this]
    {
        selection.editPart("Priority in scene",
                           [this](ScenePart& part) { part.play.priority = juce::roundToInt(priority.getValue()); });
    };
    repeats.setTitle("Repeats");
    repeats.setTooltip("Number of passes of the clip; 0 repeats it until the scene ends");
    repeats.setSliderStyle(juce::Slider::IncDecButtons);
    repeats.setRange(0.0, mostRepeats, 1.0);
    repeats.setValue(1.0, juce::dontSendNotification);
    repeats.setTextBoxStyle(juce::Slider::TextBoxLeft, false, 5 * grid, 3 * grid);
    repeats.onValueChange = [this]
    {
        setRepeats(juce::roundToInt(repeats.getValue()));
    };
}

SceneSheet::~SceneSheet()
{
    subscriptions = {};
    if (std::exchange(plays, false))
        session.transport.takePlayer();
}

void SceneSheet::fillClips()
{
    clips.clear(juce::dontSendNotification);
    for (const auto& item : session.model.document().project().clips)
        clips.addItem(item->clip->name.empty() ? tr("Clip {0}", {juce::String(item->id)}) : toText(item->clip->name),
                      item->id);
}

/// Those that the selected part has: a clip's or a texture's. One that it does not have leaves the lane.
void SceneSheet::fillParameters()
{
    const ScenePart* part = selection.part();
    const bool isTexture = part != nullptr && part->play.texture;
    juce::Array<int> wanted, there;
    for (const Offered& one : offered)
        if (isTexture ? one.ofTexture : one.ofClip)
            wanted.add(idOf(one.parameter));
    for (int i = 0; i < parameter.getNumItems(); ++i)
        there.add(parameter.getItemId(i));
    if (there != wanted)
    {
        parameter.clear(juce::dontSendNotification);
        for (const Offered& one : offered)
            if (wanted.contains(idOf(one.parameter)))
                parameter.addItem(tr(one.name), idOf(one.parameter));
        if (!wanted.contains(idOf(curve.parameter())))
            curve.show(isTexture ? SceneParameter::speed : SceneParameter::pan);
    }
    parameter.setSelectedId(idOf(curve.parameter()), juce::dontSendNotification);
}

void SceneSheet::follow()
{
    fillParameters();
    const ProjectScene& scene = selection.scene();
    actuators.setSelectedId(scene.actuators, juce::dontSendNotification);
    playButton.setEnabled(!scene.parts.empty());
    law.setSelectedId(1 + static_cast<int>(scene.panLaw), juce::dontSendNotification);
    law.setEnabled(scene.actuators > 1);
    exportButton.setEnabled(!scene.parts.empty());
    const ScenePart* part = selection.part();
    const SceneRange range = sceneRangeOf(curve.parameter());
    const bool curved =
        part != nullptr && std::any_of(part->curves.begin(), part->curves.end(),
                                       [this](const SceneCurve& one) { return one.parameter == curve.parameter(); });
    value.setRange(range.low, range.high, 0.01);
    for (Slider* slider : {&value, &priority, &repeats})
        slider->showNone(part == nullptr);
    value.setTextValueSuffix(range.unit);
    value.setDoubleClickReturnValue(true, range.usual);
    if (part != nullptr)
    {
        value.setValue(valueOf(part->play, curve.parameter()), juce::dontSendNotification);
        priority.setRange(std::min(0, part->play.priority), std::max(10, part->play.priority), 1.0);
        priority.setValue(part->play.priority, juce::dontSendNotification);
        const int passes = part->play.loop == 0.0 ? 1 : static_cast<int>(part->play.passes);
        repeats.setRange(0.0, std::max(mostRepeats, passes), 1.0);
        repeats.setValue(passes, juce::dontSendNotification);
    }
    value.setEnabled(part != nullptr && !curved);
    priority.setEnabled(part != nullptr);
    repeats.setEnabled(part != nullptr);
    removeButton.setEnabled(part != nullptr);
    removeCurveButton.setEnabled(curved);
}

/// What is left out of the scene, and why: found out in the background.
void SceneSheet::plan()
{
    const auto profile = session.actuators.profile();
    jobs.run([built = sceneOf(session.model.document().project()),
              profile = profile ? std::optional(*profile) : std::nullopt, strength = session.actuators.strength()]
             { return forecast(built, profile ? &*profile : nullptr, strength); },
             [this, number = ++planned, parts = selection.scene().parts.size()](Result<SceneForecast> found)
             {
                 if (number != planned)
                     return;
                 const SceneForecast scene = found ? std::move(*found) : SceneForecast{};
                 duration = scene.duration;
                 if (duration <= 0.0)
                     stop();
                 else if (plays)
                     isTimerRunning() ? session.player.set(playback()) : begin();
                 note.setText(found && parts == 0 ? tr("No clips yet")
                              : found             ? forecastText(parts, scene)
                                                  : translateMessage(toText(found.error().text())),
                              juce::dontSendNotification);
                 line.showLeftOut(scene.leftOut);
             });
}

void SceneSheet::play()
{
    if (selection.scene().parts.empty() || !session.outputs.readyToPlay())
        return;
    plays = true;
    playButton.setButtonText(tr("Stop"));
    if (duration > 0.0) // else when it has been planned
        begin();
}

/// On the haptic outputs, from the cursor on.
void SceneSheet::begin()
{
    session.transport.lendPlayer();
    session.player.set(playback());
    session.player.play(line.cursor() < duration ? line.cursor() : 0.0);
    startTimerHz(30);
}

Playback SceneSheet::playback() const
{
    auto scene = std::make_shared<const Scene>(sceneOf(session.model.document().project()).scene);
    return scenePlayback(std::move(scene), duration);
}

void SceneSheet::stop()
{
    if (!std::exchange(plays, false))
        return;
    stopTimer();
    line.showPlayhead(-1.0);
    playButton.setButtonText(tr("Play"));
    session.transport.takePlayer();
}

void SceneSheet::timerCallback()
{
    if (!session.player.isPlaying())
        return stop();
    line.showPlayhead(session.player.position());
}

bool SceneSheet::keyPressed(const juce::KeyPress& key)
{
    if (key == juce::KeyPress::spaceKey)
    {
        playButton.onClick();
        return true;
    }
    if (key == juce::KeyPress::returnKey)
        return true; // it would close a page where it means nothing
    return Sheet::keyPressed(key);
}

/// A part of a clip that is repeated stays that part; else it is all of it.
void SceneSheet::setRepeats(int passes)
{
    selection.editPart(
        "Repeats in scene",
        [passes](ScenePart& part)
        {
            part.play.loop = passes == 1 ? 0.0 : part.play.loop == 0.0 ? limits::duration : part.play.loop;
            part.play.passes = passes == 1 ? 0 : static_cast<std::size_t>(passes);
        });
}

namespace
{
/// Where scenes are looked for first: beside the project.
juce::File folderOf(const EditorModel& model)
{
    const auto& path = model.document().path();
    return path.empty() ? documentsFolder() : juce::File(pathText(path.parent_path()));
}
} // namespace

void SceneSheet::openScene()
{
    using Browser = juce::FileBrowserComponent;
    chooser = std::make_unique<juce::FileChooser>(tr("Open scene"), folderOf(session.model), "*.json");
    askForFiles(*chooser, Browser::openMode | Browser::canSelectFiles,
                [this](const juce::FileChooser& done)
                {
                    if (done.getResult() != juce::File())
                        read(pathOf(done.getResult()));
                });
}

void SceneSheet::read(const std::filesystem::path& file)
{
    jobs.run([file] { return readFile(file); },
             [this, file](Result<Imported> imported)
             {
                 Result<void> done = imported ? Result<void>() : Result<void>(imported.error());
                 if (done && !imported->scene)
                     done = Error{ErrorCode::invalidData, "", "is not a scene"};
                 if (done)
                     done = session.model.openScene(*imported->scene, file.stem().string());
                 if (!done)
                     note.setText(tr("{0} not opened: {1}",
                                     {pathText(file.filename()), translateMessage(toText(done.error().text()))}),
                                  juce::dontSendNotification);
                 else
                     line.fit();
                 if (!done || imported->warnings.empty())
                     return;
                 juce::StringArray lines;
                 for (const auto& warning : imported->warnings)
                     if (lines.size() < mostWarnings)
                         lines.add(translateMessage(toText(warning)));
                 question.show(std::make_unique<MessageSheet>(tr("Imported with losses"), lines.joinIntoString("\n"),
                                                              std::vector<Answer>{{"Close", {}}}));
             });
}

void SceneSheet::exportScene()
{
    using Browser = juce::FileBrowserComponent;
    const auto& path = session.model.document().path();
    const juce::File folder = folderOf(session.model);
    const juce::String name = path.empty() ? tr("Untitled") : pathText(path.stem());
    chooser =
        std::make_unique<juce::FileChooser>(tr("Export scene"), folder.getChildFile(name + ".scene.json"), "*.json");
    askForFiles(*chooser, Browser::saveMode | Browser::canSelectFiles,
                [this](const juce::FileChooser& done)
                {
                    if (done.getResult() != juce::File())
                        write(pathOf(done.getResult()));
                });
}

void SceneSheet::write(const std::filesystem::path& file)
{
    const auto failed = [this](const Error& error)
    {
        note.setText(tr("Not exported: {0}", {translateMessage(toText(error.text()))}), juce::dontSendNotification);
    };
    const auto writeIt = [this, file, failed]
    {
        const auto written = writeScene(file, sceneOf(session.model.document().project()).scene);
        if (!written)
            return failed(written.error());
        note.setText(tr("Written: {0}", {pathText(file.filename())}), juce::dontSendNotification);
        if (session.model.onWritten)
            session.model.onWritten({file});
    };
    const auto ask = [this](std::unique_ptr<Sheet> asked)
    {
        question.show(std::move(asked));
    };
    writeAfterAsking({file}, filesOf(session.model.document()), writeIt, ask, failed);
}

namespace
{
struct Placed
{
    juce::Component* one;
    int width;
    bool staysWithNext = false; ///< a name, which is on the line of what it names
};

/// Puts controls side by side, on as many lines as they need. Returns the lines; with `measureOnly` nothing moves.
int placeInLines(const std::vector<Placed>& all, juce::Rectangle<int> area, bool measureOnly)
{
    int x = 0, line = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        const bool pair = all[i].staysWithNext && i + 1 < all.size();
        const int needs = all[i].width + (pair ? grid + all[i + 1].width : 0);
        if (x > 0 && x + needs > area.getWidth())
        {
            x = 0;
            ++line;
        }
        if (!measureOnly)
            all[i].one->setBounds(area.getX() + x, area.getY() + line * controlHeight + 1,
                                  std::min(all[i].width, area.getWidth() - x), controlHeight - 2);
        x += all[i].width + grid;
    }
    return line + 1;
}
} // namespace

void SceneSheet::layOut(juce::Rectangle<int> area)
{
    const auto name = [](juce::Label& label)
    {
        return Placed{&label, labelsWidth({&label}, 5 * grid, 24 * grid), true};
    };
    const auto button = [](juce::TextButton& one, int least)
    {
        return Placed{&one, buttonWidth(one, least)};
    };
    const auto take = [&area](const std::vector<Placed>& all, bool atFoot)
    {
        const int height = controlHeight * placeInLines(all, area, true);
        placeInLines(all, atFoot ? area.removeFromBottom(height) : area.removeFromTop(height), false);
    };
    take({button(playButton, 9 * grid),
          name(clipsLabel),
          {&clips, 24 * grid},
          button(removeButton, 11 * grid),
          button(fitButton, 7 * grid),
          name(actuatorsLabel),
          {&actuators, 8 * grid},
          name(lawLabel),
          {&law, std::max(14 * grid, boxWidth(law))},
          button(openButton, 15 * grid),
          button(exportButton, 16 * grid)},
         false);
    area.removeFromTop(grid);
    note.setBounds(area.removeFromBottom(3 * grid));
    curve.setBounds(area.removeFromBottom(std::min(15 * grid, area.getHeight() / 4)));
    area.removeFromBottom(grid / 2);
    take({name(parameterLabel),
          {&parameter, std::max(14 * grid, boxWidth(parameter))},
          name(valueLabel),
          {&value, 26 * grid},
          button(removeCurveButton, 16 * grid),
          name(repeatsLabel),
          {&repeats, 11 * grid},
          name(priorityLabel),
          {&priority, 18 * grid}},
         true);
    area.removeFromBottom(grid / 2);
    line.setBounds(area);
}

} // namespace pacini::editor
