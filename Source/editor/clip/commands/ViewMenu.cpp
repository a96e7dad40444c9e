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
    const auto anyClip = [&session]
    {
        return session.model.clip() != nullptr;
    };
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
    Menu menu{"View", {}};
    menu.actions = {
        {.id = zoomIn,
         .name = "Zoom in",
         .help = "Shows less time",
         .run = [&view] { view.clipView().zoomAtPlayhead(zoomStep); },
         .can = anyClip,
         .keys = {Key('+'), Key('='), Key('+', juce::ModifierKeys::shiftModifier, 0)}},
        {.id = zoomOut,
         .name = "Zoom out",
         .help = "Shows more time",
         .run = [&view] { view.clipView().zoomAtPlayhead(1.0 / zoomStep); },
         .can = anyClip,
         .keys = {Key('-')}},
        {.id = fit,
         .name = "Fit clip",
         .help = "Shows the whole clip",
         .run = [&session] { session.viewState.fit(); },
         .can = anyClip,
         .keys = {Key('0')}},
        {.id = zoomToRange,
         .name = "Zoom to range",
         .help = "Shows the time range, or the selection",
         .run =
             [&session]
         {
             session.viewState.showRange(session.clipSelection.timeRange().value_or(
                 timeOf(session.clipSelection.selected(), *session.model.clip()).value_or(TimeRange{})));
         },
         .can =
             [&session] {
                 return session.model.clip() &&
                        (session.clipSelection.timeRange() || !isEmpty(session.clipSelection.selected()));
             },
         .keys = {Key('r')}},
        {.id = tallerLanes,
         .name = "Taller lanes",
         .help = "Makes lanes taller",
         .run = [taller] { taller(laneStep); },
         .can = anyClip,
         .keys = {ctrl('+')},
         .lineBefore = true},
        {.id = lowerLanes,
         .name = "Lower lanes",
         .help = "Makes lanes lower",
         .run = [taller] { taller(-laneStep); },
         .can = anyClip,
         .keys = {ctrl('-')}},
        {.id = decibels,
         .name = "Levels in dB",
         .help = "Levels on a scale of decibels, or linear",
         .run = [&session] { session.viewState.setAmplitudesInDecibels(!session.viewState.amplitudesInDecibels()); },
         .on =
             [&session]
         {
             return session.viewState.amplitudesInDecibels();
         }},
        {.id = draw,
         .name = "Draw curves",
         .help = "A drag in a lane draws its curve; with the key held, as long as that",
         .run = [&view] { view.switchDrawing(); },
         .can = anyClip,
         .on = [&session] { return session.viewState.isDrawing(); },
         .keys = {Key(EditorView::drawKeyCode)},
         .lineBefore = true},
        {.id = snap,
         .name = "Snap",
         .help = "Dragging snaps to what is near; with Alt it does not",
         .run =
             [&session]
         {
             SnapTargets wanted = session.viewState.snapTargets();
             wanted.on = !wanted.on;
             session.viewState.setSnapTargets(wanted);
         },
         .on = [&session] { return session.viewState.snapTargets().on; },
         .keys = {Key('n')}},
        {.id = snapTo,
         .name = "Snap to",
         .help = "Dragging snaps to these",
         .can = [&session] { return session.viewState.snapTargets().on; },
         .choices =
             [&session]
         {
             return snapChoices(session);
         }},
        {.id = showWaveform,
         .name = "Waveform",
         .help = "Shows the sound as its waveform",
         .run = give(&ViewOptions::sound, SoundView::waveform),
         .on = has(&ViewOptions::sound, SoundView::waveform),
         .keys = {alt('1')},
         .lineBefore = true},
        {.id = showSpectrum,
         .name = "Spectrogram",
         .help = "Shows the sound as its frequencies over time",
         .run = give(&ViewOptions::sound, SoundView::spectrum),
         .on = has(&ViewOptions::sound, SoundView::spectrum),
         .keys = {alt('2')}},
        {.id = showBoth,
         .name = "Waveform over spectrogram",
         .help = "Shows both over each other",
         .run = give(&ViewOptions::sound, SoundView::both),
         .on = has(&ViewOptions::sound, SoundView::both),
         .keys = {alt('3')}},
        {.id = wholeSpectrum,
         .name = "All frequencies of the spectrogram",
         .help = "Up to half the sample rate, or to 2 kHz, which is all that can be felt",
         .run = change(&ViewOptions::wholeSpectrum),
         .on = has(&ViewOptions::wholeSpectrum, true)},
        {.id = showActuator,
         .name = "What the actuator plays",
         .help = "Shows the drive of the actuator and what is lost, below the lanes",
         .run = change(&ViewOptions::actuator),
         .on = has(&ViewOptions::actuator, true),
         .keys = {alt('4')}},
        {.id = followOff,
         .name = "Do not follow the playhead",
         .help = "The view stays while playing",
         .run = give(&ViewOptions::follow, Follow::off),
         .on = has(&ViewOptions::follow, Follow::off),
         .lineBefore = true},
        {.id = followPage,
         .name = "Turn pages with the playhead",
         .help = "The view turns when the playhead leaves it",
         .run = give(&ViewOptions::follow, Follow::page),
         .on = has(&ViewOptions::follow, Follow::page)},
        {.id = followSmooth,
         .name = "Keep the playhead in the middle",
         .help = "The view moves along while playing",
         .run = give(&ViewOptions::follow, Follow::smooth),
         .on = has(&ViewOptions::follow, Follow::smooth)},
        {.id = lightLook,
         .name = "Light colours",
         .help = "Dark text on light ground",
         .run = [&view] { view.setDark(!view.isDark()); },
         .on = [&view] { return !view.isDark(); },
         .lineBefore = true},
        {.id = largerInterface,
         .name = "Larger interface",
         .help = "Everything larger, to twice the size",
         .run = [&view] { view.setScale(view.scale() + scaleStep); },
         .keys = {ctrlShift('+')}},
        {.id = smallerInterface,
         .name = "Smaller interface",
         .help = "Everything smaller, to three quarters",
         .run = [&view] { view.setScale(view.scale() - scaleStep); },
         .keys = {ctrlShift('-')}},
    };
    menu.actions.push_back({.id = preferences,
                            .name = "Preferences...",
                            .help = "How the editor looks and behaves",
                            .run = [&view] { view.showSheet(std::make_unique<PreferencesSheet>(view)); },
                            .keys = {ctrl(',')},
                            .lineBefore = true});
    if (view.hostServices().showDevices)
        menu.actions.push_back({.id = soundDevices,
                                .name = "Sound devices...",
                                .help = "Chooses the device and its outputs",
                                .run = [&view] { view.hostServices().showDevices(); },
                                .lineBefore = true});
    return menu;
}

} // namespace pacini::editor
