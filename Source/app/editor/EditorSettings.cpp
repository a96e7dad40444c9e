// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/EditorSettings.h"

#include "editor/Text.h"

#include <utility>

namespace pacini::app
{

namespace
{
using editor::SoundView;

/// Calls `visit(name, value)` for all that a user can choose about the view.
template <typename Visit>
void forAll(editor::ViewOptions& view, SnapTargets& snap, Visit&& visit)
{
    visit("wholeSpectrum", view.wholeSpectrum);
    visit("actuatorRows", view.actuator);
    visit("snap", snap.on);
    visit("snapToGrid", snap.grid);
    visit("snapToTransients", snap.transients);
    visit("snapToMarkers", snap.markers);
    visit("snapToPlayhead", snap.playhead);
}
} // namespace

EditorSettings::EditorSettings(const juce::File& folder)
    : file(folder.getChildFile("editor.settings"), juce::PropertiesFile::Options())
{
}

void EditorSettings::apply(PreviewDevices& rig) const
{
    for (auto [name, trim] : {std::pair("sound", &rig.soundTrim()), std::pair("haptic", &rig.hapticTrim())})
    {
        trim->setLevel(file.getDoubleValue(juce::String(name) + "Level", 1.0));
        trim->setDelay(file.getDoubleValue(juce::String(name) + "Delay", 0.0));
    }
    rig.setOutputs({file.getIntValue("soundOutput", 0), file.getIntValue("hapticOutput", 2)});
}

void EditorSettings::apply(editor::EditorView& view) const
{
    editor::ViewState& viewState = view.session().viewState;
    view.setDark(file.getBoolValue("dark", true));
    view.setScale(file.getDoubleValue("scale", 1.0));
    viewState.setAmplitudesInDecibels(file.getBoolValue("decibels", true));
    view.lastExport = {file.getValue("exportFormat").toStdString(), file.getIntValue("exportRate", 0),
                       editor::pathOf(file.getValue("exportFolder"))};
    viewState.setLaneHeight(file.getIntValue("laneHeight", viewState.laneHeight()));
    editor::ViewOptions options = viewState.viewOptions();
    SnapTargets snap = viewState.snapTargets();
    forAll(options, snap, [this](const char* name, bool& value) { value = file.getBoolValue(name, value); });
    options.sound =
        static_cast<SoundView>(juce::jlimit(0, static_cast<int>(SoundView::both), file.getIntValue("soundView", 0)));
    options.follow = static_cast<Follow>(
        juce::jlimit(0, static_cast<int>(Follow::smooth), file.getIntValue("follow", static_cast<int>(Follow::page))));
    viewState.setViewOptions(options);
    viewState.setSnapTargets(snap);
}

void EditorSettings::keep(PreviewDevices& rig, editor::EditorView& view, const juce::String& windowState)
{
    editor::ViewState& viewState = view.session().viewState;
    file.setValue("dark", view.isDark());
    file.setValue("scale", view.scale());
    file.setValue("decibels", viewState.amplitudesInDecibels());
    file.setValue("laneHeight", viewState.laneHeight());
    file.setValue("exportFormat", editor::toText(view.lastExport.format));
    file.setValue("exportRate", view.lastExport.sampleRate);
    file.setValue("exportFolder", editor::pathText(view.lastExport.folder));
    editor::ViewOptions options = viewState.viewOptions();
    SnapTargets snap = viewState.snapTargets();
    forAll(options, snap, [this](const char* name, bool& value) { file.setValue(name, value); });
    file.setValue("soundView", static_cast<int>(options.sound));
    file.setValue("follow", static_cast<int>(options.follow));
    file.setValue("window", windowState);
    file.setValue("soundOutput", rig.outputs().sound);
    file.setValue("hapticOutput", rig.outputs().haptic);
    for (auto [name, trim] : {std::pair("sound", &rig.soundTrim()), std::pair("haptic", &rig.hapticTrim())})
    {
        file.setValue(juce::String(name) + "Level", trim->levelNow());
        file.setValue(juce::String(name) + "Delay", trim->delayNow());
    }
    if (const auto devices = rig.devices().createStateXml())
        file.setValue("devices", devices.get());
    file.saveIfNeeded();
}

} // namespace pacini::app
