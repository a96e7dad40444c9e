// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/panels/PlayPanel.h"

#include "editor/Controls.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"

#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr int playRowHeight = 3 * grid;
constexpr int playPreferredHeight = 56 * grid;
constexpr int playLabelWidth = 9 * grid;
constexpr int playNumberWidth = 8 * grid;
constexpr double leastDecibels = CharacterSettings::leastGain, mostDecibels = CharacterSettings::mostGain;
constexpr int noPan = 1; // menus know no item 0; the laws follow
constexpr int neutral = 1;
constexpr int playPresets = 4 * grid; // the row of the presets
} // namespace

PlayPanel::PlayPanel(EditorView& view)
    : transport(view.session().transport),
      outputs(view.session().outputs),
      own(view, view.hostServices().characterPresetFolder),
      resetButton("Reset")
{
    setTitle("Play");
    own.settings = [this]
    {
        return characterSettings(character());
    };
    own.load = [this](const std::filesystem::path& file, const juce::String& name) -> Result<void>
    {
        const auto read = readCharacterSettings(file);
        if (!read)
            return read.error();
        setCharacter(*read);
        if (name.isNotEmpty())
            lastOwn.emplace(name, character());
        showPreset();
        return {};
    };
    own.onSaved = [this](const juce::String& name)
    {
        fillPresets();
        if (name.isNotEmpty())
            lastOwn.emplace(name, character());
        showPreset();
    };
    own.onRenamed = [this](const juce::String& old, const juce::String& name)
    {
        fillPresets();
        if (lastOwn && lastOwn->first == old)
            lastOwn->first = name;
        if (lastOwn && lastOwn->first.isEmpty())
            lastOwn.reset();
        showPreset();
    };
    prepareLabel(presetLabel, "Preset", smallFont());
    presetLabel.setBorderSize({});
    preset.setTitle("Preset");
    preset.setTooltip("Presets of gain, intensity, pitch and speed: settings files");
    fillPresets();
    preset.onChange = [this]
    {
        const int chosen = preset.getSelectedId();
        showPreset(); // until it is chosen; what saves and loads is no preset
        if (chosen > 0 && !own.choose(chosen))
            setCharacter({});
    };
    addAll(*this, {&presetLabel, &preset});
    prepare(gain, "Gain", "Haptic gain in dB, within the actuator's limits", {leastDecibels, mostDecibels}, 0.5, 0.0,
            " dB");
    prepare(intensity, "Intensity", "Strength of the haptics", {0.0, 100.0}, 1.0, 100.0, " %");
    prepare(pitch, "Pitch", "Transposes all pitches by semitones", {-24.0, 24.0}, 0.5, 0.0, " st");
    prepare(speed, "Speed", "Playback speed; haptic pitches stay, those of the sound follow", {0.25, 4.0}, 0.01, 1.0,
            {});
    speed.slider.setSkewFactorFromMidPoint(1.0);
    prepare(position, "Position", "Position of the clip across the haptic outputs", {0.0, 100.0}, 1.0, 50.0, " %");
    prepareLabel(panLabel, "Pan", smallFont());
    panLabel.setBorderSize({});
    pan.setTitle("Pan");
    pan.setTooltip("Panning by the position: off, by levels, by delays or by both");
    pan.addItem("Off", noPan);
    pan.addItem("Levels", noPan + 1 + static_cast<int>(PanLaw::constantPower));
    pan.addItem("Delays", noPan + 1 + static_cast<int>(PanLaw::delay));
    pan.addItem("Both", noPan + 1 + static_cast<int>(PanLaw::both));
    pan.onChange = [this]
    {
        const int chosen = pan.getSelectedId() - noPan - 1;
        outputs.setPan(chosen < 0 ? std::nullopt : std::optional(static_cast<PanLaw>(chosen)));
    };
    resetButton.setTitle("Reset live controls");
    prepareButton(resetButton, "Resets all live controls, so that the clip plays unchanged",
                  [this] { transport.setControls({}); });
    note.setFont(smallFont());
    note.setBorderSize({});
    note.setJustificationType(juce::Justification::topLeft);
    note.setText("Takes effect at once; the clip is not changed.", juce::dontSendNotification);
    note.setTitle("Live");
    addAll(*this, {&resetButton, &note, &panLabel, &pan, &position.label, &position.slider});
    setSize(200, playPreferredHeight);
    subscriptions.on({&transport.controlsChanged, &outputs.changed}, [this] { show(); });
    show();
}

void PlayPanel::prepare(Row& row, const juce::String& name, const juce::String& help, juce::Range<double> range,
                        double step, double rest, const juce::String& unit)
{
    prepareLabel(row.label, name, smallFont());
    row.label.setBorderSize({});
    juce::Slider& slider = row.slider;
    slider.setSliderStyle(juce::Slider::LinearHorizontal);
    slider.setTextBoxStyle(juce::Slider::TextBoxRight, false, playNumberWidth, playRowHeight);
    slider.setTitle(name);
    slider.setTooltip(help);
    slider.setRange(range, step);
    slider.setTextValueSuffix(unit);
    slider.setDoubleClickReturnValue(true, rest);
    slider.setWantsKeyboardFocus(true);
    slider.onValueChange = [this]
    {
        set();
    };
    addAndMakeVisible(row.label);
    addAndMakeVisible(slider);
}

void PlayPanel::set()
{
    PlayControls wanted = transport.controls();
    const double decibels = gain.slider.getValue();
    wanted.gain = decibels <= leastDecibels ? 0.0 : Decibels(decibels).gain();
    wanted.intensity = 0.01 * intensity.slider.getValue();
    wanted.transposition = pitch.slider.getValue();
    wanted.speed = speed.slider.getValue();
    wanted.pan = 0.01 * position.slider.getValue();
    transport.setControls(wanted);
}

CharacterSettings PlayPanel::character() const
{
    const auto plain = [](double value) // without the rounding of its way over a factor
    {
        return std::round(1e6 * value) / 1e6;
    };
    const PlayControls& now = transport.controls();
    const double decibels = now.gain > 0.0 ? plain(Decibels::fromGain(now.gain).value) : leastDecibels;
    return {std::clamp(decibels, leastDecibels, mostDecibels), plain(now.intensity), plain(now.transposition),
            plain(now.speed)};
}

void PlayPanel::setCharacter(const CharacterSettings& wanted)
{
    PlayControls controls = transport.controls();
    controls.gain = wanted.gain <= leastDecibels ? 0.0 : Decibels(wanted.gain).gain();
    controls.intensity = wanted.intensity;
    controls.transposition = wanted.transposition;
    controls.speed = wanted.speed;
    transport.setControls(controls);
}

void PlayPanel::fillPresets()
{
    preset.clear(juce::dontSendNotification);
    preset.addItem(tr("Neutral"), neutral);
    own.addTo(preset);
}

void PlayPanel::showPreset()
{
    const CharacterSettings now = character();
    preset.setText(now == CharacterSettings()          ? tr("Neutral")
                   : lastOwn && lastOwn->second == now ? lastOwn->first
                                                       : tr("Custom"),
                   juce::dontSendNotification);
}

void PlayPanel::show()
{
    showPreset();
    const PlayControls& now = transport.controls();
    const auto put = [](juce::Slider& slider, double value)
    {
        slider.setValue(value, juce::dontSendNotification);
    };
    put(gain.slider, now.gain > 0.0 ? Decibels::fromGain(now.gain).value : leastDecibels);
    put(intensity.slider, 100.0 * now.intensity);
    put(pitch.slider, now.transposition);
    put(speed.slider, now.speed);
    put(position.slider, 100.0 * now.pan);
    pan.setSelectedId(outputs.pan() ? noPan + 1 + static_cast<int>(*outputs.pan()) : noPan, juce::dontSendNotification);
    const bool several = outputs.outputs().size() > 1;
    pan.setEnabled(several);
    panLabel.setEnabled(several);
    position.slider.setEnabled(several && outputs.pan());
    position.label.setEnabled(position.slider.isEnabled());
}

void PlayPanel::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.background);
    drawCard(g, liveCard, "Live", p);
    drawCard(g, rowCard, "Across outputs", p);
}

void PlayPanel::resized()
{
    auto area = getLocalBounds().reduced(grid);
    liveCard = area.removeFromTop(29 * grid + playPresets);
    area.removeFromTop(grid);
    rowCard = area.removeFromTop(13 * grid);
    auto inside = insideOfCard(liveCard);
    const int boxLabels = labelsWidth({&presetLabel, &panLabel}, playLabelWidth, 12 * grid);
    const int labels =
        labelsWidth({&gain.label, &intensity.label, &pitch.label, &speed.label, &position.label}, boxLabels, 12 * grid);
    const auto named = [](Row& row)
    {
        return NamedSlider{row.label, row.slider, playNumberWidth};
    };
    const bool above = !hasTracks({named(gain)}, labels, inside.getWidth());
    const auto put = [&](juce::Rectangle<int>& from, Row& row)
    {
        // Stacked, a row takes some of the gap to the next as well.
        placeSlider(named(row), labels, from.removeFromTop(playRowHeight + (above ? 4 : 0)), above);
        from.removeFromTop(above ? grid - 4 : grid);
    };
    const auto putBox = [&](juce::Rectangle<int>& from, juce::Label& label, juce::ComboBox& box)
    {
        placeNamed(label, boxLabels, box, from.removeFromTop(playRowHeight));
        from.removeFromTop(grid);
    };
    putBox(inside, presetLabel, preset);
    for (Row* row : {&gain, &intensity, &pitch, &speed})
        put(inside, *row);
    auto line = inside.removeFromTop(playRowHeight + 4);
    resetButton.setBounds(line.removeFromLeft(std::min(buttonWidth(resetButton, 9 * grid), line.getWidth())));
    inside.removeFromTop(grid);
    note.setBounds(inside);
    inside = insideOfCard(rowCard);
    putBox(inside, panLabel, pan);
    put(inside, position);
}

} // namespace pacini::editor
