// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/sheets/PreferencesSheet.h"

namespace pacini::editor
{

namespace
{
constexpr double zoomStep = 1.5;
constexpr int laneStep = 16; // pixels
constexpr double scaleStep = 0.25;

juce::PopupMenu snapChoices(Session& session)
{
    juce::PopupMenu menu;
    const auto add = [&](const char* name, bool SnapTargets::*target)
    {
        menu.addItem(name, true, session.viewState.snapTargets().*target,
                     [&session, target]
                     {
                         SnapTargets wanted = session.viewState.snapTargets();
                         wanted.*target = !(wanted.*target);
                         session.viewState.setSnapTargets(wanted);
                     });
    };
    add("Transients", &SnapTargets::transients);
    add("Markers", &SnapTargets::markers);
    add("Playhead", &SnapTargets::playhead);
    add("Lines of the ruler", &SnapTargets::grid);
    return menu;
}
} // namespace

Menu viewMenu(EditorView& view)
{
    Session& session = view.session();
    const auto anyClip = hasClip(session);
    const auto taller = [&session](int pixels)
    {
        session.viewState.setLaneHeight(session.viewState.laneHeight() + pixels);
    };
    // An option, and the value that an action gives it.
    const auto has = [&session](auto ViewOptions::*option, auto value)
    {
        return [&session, option, value]
        {
            return session.viewState.viewOptions().*option == value;
        };
    };
    const auto give = [&session](auto ViewOptions::*option, auto value)
    {
        return [&session, option, value]
        {
            ViewOptions wanted = session.viewState.viewOptions();
            wanted.*option = value;
            session.viewState.setViewOptions(wanted);
        };
    };
    const auto change = [&session](bool ViewOptions::*option)
    {
        return [&session, option]
        {
            ViewOptions wanted = session.viewState.viewOptions();
            wanted.*option = !(wanted.*option);
            session.viewState.setViewOptions(wanted);
        };
    };
    using Key = juce::KeyPress;
    Menu menu("View");
    menu.add(zoomIn, "Zoom in", "Shows less time", [&view] { view.clipView().zoomAtPlayhead(zoomStep); }, anyClip,
             {Key('+'), Key('='), Key('+', juce::ModifierKeys::shiftModifier, 0)});
    menu.add(zoomOut, "Zoom out", "Shows more time", [&view] { view.clipView().zoomAtPlayhead(1.0 / zoomStep); },
             anyClip, {Key('-')});
    menu.add(fit, "Fit clip", "Shows the whole clip", [&session] { session.viewState.fit(); }, anyClip, {Key('0')});
    menu.add(
        zoomToRange, "Zoom to range", "Shows the time range, or the selection",
        [&session]
        {
            session.viewState.showRange(session.clipSelection.timeRange().value_or(
                timeOf(session.clipSelection.selected(), *session.model.clip()).value_or(TimeRange{})));
        },
        [&session] {
            return session.model.clip() &&
                   (session.clipSelection.timeRange() || !isEmpty(session.clipSelection.selected()));
        },
        {Key('r')});
    menu.addLine();
    menu.add(tallerLanes, "Taller lanes", "Makes lanes taller", [taller] { taller(laneStep); }, anyClip, {ctrl('+')});
    menu.add(lowerLanes, "Lower lanes", "Makes lanes lower", [taller] { taller(-laneStep); }, anyClip, {ctrl('-')});
    menu.addSwitch(
        decibels, "Levels in dB", "Levels on a scale of decibels, or linear",
        [&session] { session.viewState.setAmplitudesInDecibels(!session.viewState.amplitudesInDecibels()); },
        [&session] { return session.viewState.amplitudesInDecibels(); });
    menu.addLine();
    menu.addSwitch(
        draw, "Draw curves", "A drag in a lane draws its curve; with the key held, as long as that",
        [&view] { view.switchDrawing(); }, [&session] { return session.viewState.isDrawing(); },
        {Key(EditorView::drawKeyCode)}, anyClip);
    menu.addSwitch(
        snap, "Snap", "Dragging snaps to what is near; with Alt it does not",
        [&session]
        {
            SnapTargets wanted = session.viewState.snapTargets();
            wanted.on = !wanted.on;
            session.viewState.setSnapTargets(wanted);
        },
        [&session] { return session.viewState.snapTargets().on; }, {Key('n')});
    menu.addMenu(
        snapTo, "Snap to", "Dragging snaps to these", [&session] { return snapChoices(session); },
        [&session] { return session.viewState.snapTargets().on; });
    menu.addLine();
    menu.addSwitch(showWaveform, "Waveform", "Shows the sound as its waveform",
                   give(&ViewOptions::sound, SoundView::waveform), has(&ViewOptions::sound, SoundView::waveform),
                   {alt('1')});
    menu.addSwitch(showSpectrum, "Spectrogram", "Shows the sound as its frequencies over time",
                   give(&ViewOptions::sound, SoundView::spectrum), has(&ViewOptions::sound, SoundView::spectrum),
                   {alt('2')});
    menu.addSwitch(showBoth, "Waveform over spectrogram", "Shows both over each other",
                   give(&ViewOptions::sound, SoundView::both), has(&ViewOptions::sound, SoundView::both), {alt('3')});
    menu.addSwitch(wholeSpectrum, "All frequencies of the spectrogram",
                   "Up to half the sample rate, or to 2 kHz, which is all that can be felt",
                   change(&ViewOptions::wholeSpectrum), has(&ViewOptions::wholeSpectrum, true));
    menu.addSwitch(showActuator, "What the actuator plays",
                   "Shows the drive of the actuator and what is lost, below the lanes", change(&ViewOptions::actuator),
                   has(&ViewOptions::actuator, true), {alt('4')});
    menu.addLine();
    menu.addSwitch(followOff, "Do not follow the playhead", "The view stays while playing",
                   give(&ViewOptions::follow, Follow::off), has(&ViewOptions::follow, Follow::off));
    menu.addSwitch(followPage, "Turn pages with the playhead", "The view turns when the playhead leaves it",
                   give(&ViewOptions::follow, Follow::page), has(&ViewOptions::follow, Follow::page));
    menu.addSwitch(followSmooth, "Keep the playhead in the middle", "The view moves along while playing",
                   give(&ViewOptions::follow, Follow::smooth), has(&ViewOptions::follow, Follow::smooth));
    menu.addLine();
    menu.addSwitch(
        lightLook, "Light colours", "Dark text on light ground", [&view] { view.setDark(!view.isDark()); },
        [&view] { return !view.isDark(); });
    menu.add(largerInterface, "Larger interface", "Everything larger, to twice the size",
             [&view] { view.setScale(view.scale() + scaleStep); }, {},
             {ctrlShift('+'), ctrlShift('='), ctrlShift('*')});
    menu.add(smallerInterface, "Smaller interface", "Everything smaller, to three quarters",
             [&view] { view.setScale(view.scale() - scaleStep); }, {}, {ctrlShift('-'), ctrlShift('_')});
    menu.addLine();
    menu.add(preferences, "Preferences...", "How the editor looks and behaves",
             [&view] { view.showSheet(std::make_unique<PreferencesSheet>(view)); }, {}, {ctrl(',')});
    if (view.hostServices().showDevices)
    {
        menu.addLine();
        menu.add(soundDevices, "Sound devices...", "Chooses the device and its outputs",
                 [&view] { view.hostServices().showDevices(); });
    }
    return menu;
}

} // namespace pacini::editor
