// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/sheets/OutputsSheet.h"

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
        menu.addItem(tr(name), true, session.viewState.snapTargets().*target,
                     [&session, target]
                     {
                         SnapTargets wanted = session.viewState.snapTargets();
                         wanted.*target = !(wanted.*target);
                         session.viewState.setSnapTargets(wanted);
                     });
    };
    add("Events", &SnapTargets::transients);
    add("Markers", &SnapTargets::markers);
    add("Playhead", &SnapTargets::playhead);
    add("Ruler lines", &SnapTargets::grid);
    return menu;
}

/// What is drawn of the sound and the actuator, and how the view follows the playhead.
void addViewOptions(Menu& menu, Session& session)
{
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
    menu.addSwitch(showWaveform, "Waveform", "Shows the waveform of the sound",
                   give(&ViewOptions::sound, SoundView::waveform), has(&ViewOptions::sound, SoundView::waveform),
                   {alt('1')});
    menu.addSwitch(showSpectrum, "Spectrogram", "Shows the spectrogram of the sound",
                   give(&ViewOptions::sound, SoundView::spectrum), has(&ViewOptions::sound, SoundView::spectrum),
                   {alt('2')});
    menu.addSwitch(showBoth, "Waveform over spectrogram", "Draws the waveform over the spectrogram",
                   give(&ViewOptions::sound, SoundView::both), has(&ViewOptions::sound, SoundView::both), {alt('3')});
    menu.addSwitch(wholeSpectrum, "Full-range spectrogram",
                   "Shows the full range instead of up to 2 kHz, the limit of touch",
                   change(&ViewOptions::wholeSpectrum), has(&ViewOptions::wholeSpectrum, true));
    menu.addSwitch(showActuator, "Actuator output", "Shows the actuator's drive and losses below the lanes",
                   change(&ViewOptions::actuator), has(&ViewOptions::actuator, true), {alt('4')});
    menu.addLine();
    menu.addSwitch(followOff, "Don't follow playhead", "Keeps the view still during playback",
                   give(&ViewOptions::follow, Follow::off), has(&ViewOptions::follow, Follow::off));
    menu.addSwitch(followPage, "Follow by page", "Turns the page when the playhead leaves the view",
                   give(&ViewOptions::follow, Follow::page), has(&ViewOptions::follow, Follow::page));
    menu.addSwitch(followSmooth, "Keep playhead centred", "Scrolls continuously during playback",
                   give(&ViewOptions::follow, Follow::smooth), has(&ViewOptions::follow, Follow::smooth));
}
} // namespace

Menu viewMenu(EditorView& view)
{
    Session& session = view.session();
    const auto anyClip = hasClip(session);
    // Lanes that have grown with the window grow on from there.
    const auto taller = [&view, &session](int pixels)
    {
        session.viewState.setLaneHeight(
            (pixels > 0 ? view.clipView().shownLaneHeight() : session.viewState.laneHeight()) + pixels);
    };
    using Key = juce::KeyPress;
    Menu menu("View");
    menu.add(zoomIn, "Zoom in", "Zooms in", [&view] { view.clipView().zoomAtPlayhead(zoomStep); }, anyClip,
             {Key('+'), Key('='), Key('+', juce::ModifierKeys::shiftModifier, 0)});
    menu.add(zoomOut, "Zoom out", "Zooms out", [&view] { view.clipView().zoomAtPlayhead(1.0 / zoomStep); }, anyClip,
             {Key('-')});
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
    menu.add(lowerLanes, "Shorter lanes", "Makes lanes shorter", [taller] { taller(-laneStep); }, anyClip, {ctrl('-')});
    menu.addSwitch(
        decibels, "Levels in dB", "Shows levels in decibels instead of linear",
        [&session] { session.viewState.setAmplitudesInDecibels(!session.viewState.amplitudesInDecibels()); },
        [&session] { return session.viewState.amplitudesInDecibels(); });
    menu.addLine();
    menu.addSwitch(
        draw, "Draw curves", "Drag in a lane to draw its curve; hold the key to draw temporarily",
        [&view] { view.switchDrawing(); }, [&session] { return session.viewState.isDrawing(); },
        {Key(EditorView::drawKeyCode)}, anyClip);
    menu.addSwitch(
        snap, "Snap", "Dragging snaps to nearby targets; hold Alt to bypass",
        [&session]
        {
            SnapTargets wanted = session.viewState.snapTargets();
            wanted.on = !wanted.on;
            session.viewState.setSnapTargets(wanted);
        },
        [&session] { return session.viewState.snapTargets().on; }, {Key('n')});
    menu.addMenu(
        snapTo, "Snap to", "What dragging snaps to", [&session] { return snapChoices(session); },
        [&session] { return session.viewState.snapTargets().on; });
    menu.addLine();
    addViewOptions(menu, session);
    menu.addSwitch(
        showSidePanel, "Side panel", "Shows the pages and meters beside the lanes",
        [&view] { view.showSide(!view.isSideShown()); }, [&view] { return view.isSideShown(); }, {alt('5')});
    menu.addLine();
    menu.add(nextPanel, "Next panel", "Gives the keyboard to the next part of the window",
             [&view] { view.focusPart(1); }, {}, {Key(Key::F6Key)});
    menu.add(previousPanel, "Previous panel", "Gives the keyboard to the previous part of the window",
             [&view] { view.focusPart(-1); }, {}, {Key(Key::F6Key, juce::ModifierKeys::shiftModifier, 0)});
    menu.addLine();
    menu.addSwitch(
        lightLook, "Light theme", "Dark text on a light background", [&view] { view.setDark(!view.isDark()); },
        [&view] { return !view.isDark(); });
    menu.add(largerInterface, "Larger interface", "Enlarges the interface, up to 200 %",
             [&view] { view.setScale(view.scale() + scaleStep); }, {},
             {ctrlShift('+'), ctrlShift('='), ctrlShift('*')});
    menu.add(smallerInterface, "Smaller interface", "Shrinks the interface, down to 75 %",
             [&view] { view.setScale(view.scale() - scaleStep); }, {}, {ctrlShift('-'), ctrlShift('_')});
    menu.addLine();
    if (view.hostServices().showDevices)
    {
        menu.add(soundDevices, "Audio devices...", "Chooses the audio device and its outputs",
                 [&view] { view.hostServices().showDevices(); });
    }
    if (view.hostServices().outputNames)
        menu.add(hapticOutputs, "Haptic outputs...",
                 "Outputs that clips play on: actuator, gain, delay and position of each",
                 [&view]
                 {
                     const HostServices& around = view.hostServices();
                     view.showSheet(
                         std::make_unique<OutputsSheet>(view, around.outputNames(), around.outputPresetFolder));
                 });
    return menu;
}

} // namespace pacini::editor
