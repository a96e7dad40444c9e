// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/EditorSettings.h"

#include "editor/Text.h"
#include "editor/Theme.h"

#include <utility>

namespace pacini::app
{

namespace
{
using editor::SoundView;

/// The first has no number: so it was kept when there was only one.
juce::String hapticKey(std::size_t output, const char* what)
{
    return juce::String("haptic") + (output == 0 ? juce::String() : juce::String(static_cast<int>(output) + 1)) + what;
}

/// Calls `visit(name, value)` for all that a user can choose about the view.
template <typename Visit>
void forAll(editor::ViewOptions& view, SnapTargets& snap, Visit&& visit)
{
    visit("wholeSpectrum", view.wholeSpectrum);
    visit("actuatorRows", view.actuator);
    visit("technicalTerms", view.technicalTerms);
    visit("reducedMotion", view.reducedMotion);
    visit("spokenStatus", view.spoken);
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

void EditorSettings::apply(PreviewDevices& rig, editor::HapticOutputs& outputs) const
{
    rig.soundTrim().setLevel(file.getDoubleValue("soundLevel", 1.0));
    rig.soundTrim().setDelay(file.getDoubleValue("soundDelay", 0.0));
    rig.setSoundOutput(file.getIntValue("soundOutput", 0));
    std::vector<editor::HapticOutput> list(static_cast<std::size_t>(
        juce::jlimit(1, static_cast<int>(outputs.most), file.getIntValue("hapticOutputs", 1))));
    for (std::size_t i = 0; i < list.size(); ++i)
    {
        editor::HapticOutput& output = list[i];
        output.channel = file.getIntValue(hapticKey(i, "Output"), 2 + static_cast<int>(i));
        output.actuator = file.getValue(hapticKey(i, "Actuator")).toStdString();
        output.gain = juce::Decibels::gainToDecibels(file.getDoubleValue(hapticKey(i, "Level"), 1.0),
                                                     editor::HapticOutputs::leastGain);
        output.delay = file.getDoubleValue(hapticKey(i, "Delay"), 0.0);
        output.place = file.getDoubleValue(hapticKey(i, "Place"), RowPlaces::placeOf(i, list.size()));
    }
    outputs.setOutputs(std::move(list));
    const int law = file.getIntValue("hapticPan", -1);
    outputs.setPan(law >= 0 && law <= static_cast<int>(PanLaw::both) ? std::optional(static_cast<PanLaw>(law))
                                                                     : std::nullopt);
}

void EditorSettings::apply(editor::EditorView& view) const
{
    editor::ViewState& viewState = view.session().viewState;
    view.session().actuators.setUsual(file.getValue("usualActuator").toStdString());
    view.statusBar().setSteps({file.getBoolValue("hasChosen", false), file.getBoolValue("hasShaped", false),
                               file.getBoolValue("hasExported", false)});
    view.setDark(file.getBoolValue("dark", editor::systemIsDark()));
    view.setScale(file.getDoubleValue("scale", 1.0));
    if (const auto keys = file.getXmlValue("keys"))
        view.menus().restoreKeys(*keys);
    view.setSideWidth(file.getIntValue("sideWidth", editor::EditorView::usualSideWidth));
    view.showSide(file.getBoolValue("sidePanel", true));
    viewState.setAmplitudesInDecibels(file.getBoolValue("decibels", true));
    view.lastExport = {file.getValue("exportFormat").toStdString(),
                       file.getIntValue("exportRate", 0),
                       editor::pathOf(file.getValue("exportFolder")),
                       {},
                       false};
    for (const auto& name : juce::StringArray::fromTokens(file.getValue("exportAlso"), " ", {}))
        view.lastExport.also.push_back(name.toStdString());
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
    file.setValue("usualActuator", juce::String(view.session().actuators.usual()));
    file.setValue("hasChosen", view.statusBar().steps().chosen);
    file.setValue("hasShaped", view.statusBar().steps().shaped);
    file.setValue("hasExported", view.statusBar().steps().exported);
    if (file.containsKey("dark") || view.isDark() != editor::systemIsDark()) // else the system's theme is followed
        file.setValue("dark", view.isDark());
    file.setValue("scale", view.scale());
    if (const auto keys = view.menus().changedKeys())
        file.setValue("keys", keys.get());
    else
        file.removeValue("keys");
    file.setValue("sideWidth", view.sideWidth());
    file.setValue("sidePanel", view.isSideShown());
    file.setValue("decibels", viewState.amplitudesInDecibels());
    file.setValue("laneHeight", viewState.laneHeight());
    file.setValue("exportFormat", editor::toText(view.lastExport.format));
    juce::StringArray also;
    for (const auto& name : view.lastExport.also)
        also.add(editor::toText(name));
    file.setValue("exportAlso", also.joinIntoString(" "));
    file.setValue("exportRate", view.lastExport.sampleRate);
    file.setValue("exportFolder", editor::pathText(view.lastExport.folder));
    editor::ViewOptions options = viewState.viewOptions();
    SnapTargets snap = viewState.snapTargets();
    forAll(options, snap, [this](const char* name, bool& value) { file.setValue(name, value); });
    file.setValue("soundView", static_cast<int>(options.sound));
    file.setValue("follow", static_cast<int>(options.follow));
    file.setValue("window", windowState);
    file.setValue("soundOutput", rig.soundOutput());
    file.setValue("soundLevel", rig.soundTrim().levelNow());
    file.setValue("soundDelay", rig.soundTrim().delayNow());
    const editor::HapticOutputs& outputs = view.session().outputs;
    file.setValue("hapticOutputs", static_cast<int>(outputs.outputs().size()));
    for (std::size_t i = 0; i < outputs.outputs().size(); ++i)
    {
        const editor::HapticOutput& output = outputs.outputs()[i];
        file.setValue(hapticKey(i, "Output"), output.channel);
        file.setValue(hapticKey(i, "Actuator"), juce::String(output.actuator));
        file.setValue(hapticKey(i, "Level"),
                      juce::Decibels::decibelsToGain(output.gain, editor::HapticOutputs::leastGain));
        file.setValue(hapticKey(i, "Delay"), output.delay);
        file.setValue(hapticKey(i, "Place"), output.place);
    }
    file.setValue("hapticPan", outputs.pan() ? static_cast<int>(*outputs.pan()) : -1);
    if (const auto devices = rig.devices().createStateXml())
        file.setValue("devices", devices.get());
    file.saveIfNeeded();
}

} // namespace pacini::app
