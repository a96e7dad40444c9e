// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/Toolbar.h"

#include "editor/ActuatorItem.h"
#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <pacini/actuator/Strength.h>

namespace pacini::editor
{

namespace
{
constexpr int plainDrive = 1; // menus know no item 0; profiles follow
constexpr int fromFile = 100000;
constexpr int strengthNumber = 5 * grid;
constexpr int sliderWidth = space::leastTrack + strengthNumber + 3 * grid; // with the thumb at both ends
constexpr int iconWidth = 34, playWidth = 52;
constexpr int leastHeard = 76, mostHeard = 140, leastLabel = 28;
constexpr int leastMenus = 240;   // of the three menus together: with less, the zoom is left out
constexpr int leastChoices = 300; // of the three menus together: with less, labels are left out

juce::String clockText(double seconds)
{
    const int minutes = static_cast<int>(seconds / 60.0);
    const double rest = seconds - 60.0 * minutes;
    return juce::String(minutes) + ":" + (rest < 10.0 ? "0" : "") + numberText(rest, 2);
}
} // namespace

Toolbar::Toolbar(EditorModel& project, Actuators& profiles, Transport& playing)
    : model(project), actuators(profiles), transport(playing)
{
    setTitle("Toolbar");
    const auto button = [this](juce::Button& one, Command command, const juce::String& title, const juce::String& help)
    {
        one.setTitle(title);
        prepareButton(one, help,
                      [this, command]
                      {
                          if (onCommand)
                              onCommand(command);
                      });
        addAndMakeVisible(one);
    };
    button(startButton, toStart, "Go to start", "Moves the playhead to the start (Home)");
    button(playButton, playOrPause, "Play/pause", "Plays from the playhead, or pauses (Space)");
    button(loopButton, loop, "Loop", "Repeats the time range or the whole clip (Ctrl+L)");
    makePrimary(playButton);
    button(zoomOutButton, zoomOut, "Zoom out", "Zooms out (-)");
    button(zoomInButton, zoomIn, "Zoom in", "Zooms in (+)");
    button(fitButton, editor::fit, "Fit clip", "Shows the whole clip (0)");
    time.setFont(usualFont());
    time.setJustificationType(juce::Justification::centred);
    time.setTitle("Playhead");
    time.setTooltip("Playhead and clip length, minutes:seconds");
    addAndMakeVisible(time);

    const auto choice = [this](auto& box, juce::Label& label, const juce::String& name, const juce::String& help)
    {
        prepareLabel(label, name, smallFont());
        box.setTitle(name);
        box.setTooltip(help);
        addAndMakeVisible(label);
        addAndMakeVisible(box);
    };
    choice(clips, clipLabel, "Clip", "The clip being edited");
    choice(heard, heardLabel, "Monitor", "What plays: the drive signal, the sound, or both");
    choice(profile, profileLabel, "Actuator", "The actuator the drive signal is made for; its limits are respected");
    heard.addItem("Haptic", 1 + static_cast<int>(Heard::haptic));
    heard.addItem("Sound", 1 + static_cast<int>(Heard::sound));
    heard.addItem("Both", 1 + static_cast<int>(Heard::both));
    heard.onChange = [this]
    {
        transport.setHeard(static_cast<Heard>(heard.getSelectedId() - 1));
    };
    fillProfiles();
    profile.onChange = [this]
    {
        if (profile.getSelectedId() == fromFile)
        {
            showState();
            if (onCommand)
                onCommand(loadProfile);
            return;
        }
        const int chosen = profile.getSelectedId() - plainDrive - 1;
        actuators.setProfile(chosen < 0 ? std::string() : actuators.profiles()[static_cast<std::size_t>(chosen)].name);
    };
    choice(
        strength, strengthLabel, "Strength",
        "Fidelity versus strength: 0 % is as faithful as possible, 100 % plays everything at the actuator's resonance");
    strength.setSliderStyle(juce::Slider::LinearHorizontal);
    strength.setTextBoxStyle(juce::Slider::TextBoxRight, false, strengthNumber, 3 * grid);
    strength.setRange(0.0, 100.0, 1.0);
    strength.setTextValueSuffix(" %");
    strength.setDoubleClickReturnValue(true, 100.0 * standardStrength);
    strength.setWantsKeyboardFocus(true);
    strength.onValueChange = [this]
    {
        actuators.setStrength(0.01 * strength.getValue());
    };
    clips.onChange = [this]
    {
        if (clips.getSelectedId() > 0)
            model.show(clips.getSelectedId());
    };
    subscriptions.on({&model.projectChanged}, [this] { fillClips(); });
    subscriptions.on({&actuators.listChanged}, [this] { fillProfiles(); });
    subscriptions.on({&model.contentChanged, &model.projectChanged, &transport.changed, &transport.loopChanged,
                      &actuators.changed, &actuators.listChanged},
                     [this] { showState(); });
    fillClips();
    showState();
    startTimerHz(30);
}

void Toolbar::fillClips()
{
    const auto& items = model.document().project().clips;
    bool same = clips.getNumItems() == static_cast<int>(items.size());
    for (std::size_t i = 0; same && i < items.size(); ++i)
        same = clips.getItemId(static_cast<int>(i)) == items[i]->id &&
               clips.getItemText(static_cast<int>(i)) == toText(items[i]->clip->name);
    if (!same)
    {
        clips.clear(juce::dontSendNotification);
        for (const auto& item : items)
            clips.addItem(item->clip->name.empty() ? tr("Clip {0}", {juce::String(item->id)})
                                                   : toText(item->clip->name),
                          item->id);
    }
    clips.setSelectedId(model.activeId(), juce::dontSendNotification);
    clips.setTextWhenNothingSelected(tr(model.isShowingUnanalysed() ? "Analysing" : "No clip"));
    clips.setEnabled(!items.empty());
}

void Toolbar::fillProfiles()
{
    profile.clear(juce::dontSendNotification);
    profile.addItem(tr("No actuator"), plainDrive);
    for (std::size_t i = 0; i < actuators.profiles().size(); ++i)
    {
        const NamedProfile& entry = actuators.profiles()[i];
        addActuator(profile, *entry.profile, plainDrive + 1 + static_cast<int>(i));
    }
    profile.addSeparator();
    profile.addItem(tr("Load profile...").replace("...", toText("…")), fromFile);
}

void Toolbar::showState()
{
    loopButton.setToggleState(transport.isLooping(), juce::dontSendNotification);
    heard.setSelectedId(1 + static_cast<int>(transport.heard()), juce::dontSendNotification);
    int chosen = plainDrive;
    for (std::size_t i = 0; i < actuators.profiles().size(); ++i)
        if (actuators.profiles()[i].name == actuators.profileName())
            chosen = plainDrive + 1 + static_cast<int>(i);
    profile.setSelectedId(chosen, juce::dontSendNotification);
    strength.setValue(100.0 * actuators.strength(), juce::dontSendNotification);
    strength.setEnabled(actuators.strengthMatters());
    strengthLabel.setEnabled(strength.isEnabled());
    const bool any = model.clip() != nullptr;
    for (juce::Component* one : std::initializer_list<juce::Component*>{&startButton, &playButton, &loopButton,
                                                                        &zoomOutButton, &zoomInButton, &fitButton})
        one->setEnabled(any);
    showTime();
}

void Toolbar::showTime()
{
    const auto clip = model.clip();
    time.setText(clip ? clockText(transport.playhead()) + " / " + clockText(clip->duration)
                      : juce::String("-:-- / -:--"),
                 juce::dontSendNotification);
    playButton.setIcon(transport.isPlaying() ? Icon::pause : Icon::play);
}

void Toolbar::paint(juce::Graphics& g)
{
    g.fillAll(paletteFor(*this).card);
    g.setColour(paletteFor(*this).line);
    g.fillRect(getLocalBounds().removeFromBottom(1));
}

void Toolbar::resized()
{
    auto area = getLocalBounds().reduced(grid, 6);
    const auto put = [&](juce::Component& one, int width, int after)
    {
        one.setBounds(area.removeFromLeft(width));
        area.removeFromLeft(after);
    };
    put(startButton, iconWidth, 4);
    put(playButton, playWidth, 4);
    put(loopButton, iconWidth, grid);
    put(time, smallFont().getStringWidth("00:00.00 / 00:00.00") + 3 * grid, grid);
    // Menus have a name to show; the zoom has keys and a menu as well.
    const int leastClips = std::max(104, usualFont().getStringWidth(tr("No clip")) + 5 * grid);
    const int menusNeed =
        leastHeard + leastClips + smallFont().getStringWidth(profile.getItemText(0)) + 4 * grid; // "No actuator"
    const bool narrow =
        area.getWidth() - 3 * (iconWidth + 4) - sliderWidth - 2 * grid < std::max(leastMenus, menusNeed);
    for (juce::Component* one : std::initializer_list<juce::Component*>{&zoomOutButton, &zoomInButton, &fitButton})
        one->setVisible(!narrow);
    if (!narrow)
    {
        put(zoomOutButton, iconWidth, 4);
        put(zoomInButton, iconWidth, 4);
        put(fitButton, iconWidth, 2 * grid);
    }
    const auto widthOf = [](const juce::Label& label)
    {
        return std::max(leastLabel, label.getFont().getStringWidth(label.getText()) + 2);
    };
    int rest = area.getWidth() - sliderWidth - 3 * grid;
    int labels = 4 * 4;
    for (const juce::Label* label : {&clipLabel, &heardLabel, &profileLabel, &strengthLabel})
        labels += widthOf(*label);
    const bool labelled = rest - labels >= std::max(leastChoices, menusNeed);
    rest = std::max(leastHeard, labelled ? rest - labels : rest);
    const int heardNow = std::clamp(rest * 22 / 100, leastHeard, mostHeard);
    // Names of clips are cut before those of actuators are.
    const int actuatorNeeds = std::min(boxWidth(profile), space::widestBox);
    const int clipsNow = std::clamp(rest - heardNow - actuatorNeeds, leastClips,
                                    std::max(leastClips, std::min(space::widestBox, (rest - heardNow) * 2 / 5)));
    const auto putLabel = [&](juce::Label& label)
    {
        label.setVisible(labelled);
        if (labelled)
            put(label, widthOf(label), 4);
    };
    putLabel(clipLabel);
    put(clips, clipsNow, grid);
    putLabel(heardLabel);
    put(heard, heardNow, grid);
    putLabel(profileLabel);
    put(profile, std::min(space::widestBox, rest - heardNow - clipsNow), grid);
    putLabel(strengthLabel);
    put(strength, sliderWidth, 0);
}

} // namespace pacini::editor
