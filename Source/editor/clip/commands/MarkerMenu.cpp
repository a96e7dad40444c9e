// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/MarkerEdits.h"
#include "editor/Text.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/session/ClipSteps.h"
#include "editor/clip/session/Snapping.h"
#include "editor/clip/sheets/NameSheet.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{
/// The marker that the playhead stands on.
std::optional<std::size_t> markerHere(const Session& session)
{
    const auto clip = session.model.clip();
    return clip ? markerNear(clip->markers, session.transport.playhead(),
                             snapReach * session.viewState.axis().secondsPerPixel)
                : std::nullopt;
}

void setMarkers(Session& session, const char* name, std::vector<Marker> markers)
{
    editClip(session.model, name, MarkersEdit{std::move(markers)});
}

void addHere(Session& session)
{
    const auto clip = session.model.clip();
    const double here = std::clamp(session.transport.playhead(), 0.0, clip->duration);
    setMarkers(session, "Add marker", withMarker(clip->markers, {here, freeMarkerName(clip->markers)}));
}

void rename(EditorView& view)
{
    Session& session = view.session();
    const auto index = *markerHere(session);
    const std::string now = session.model.clip()->markers[index].name;
    view.showSheet(std::make_unique<NameSheet>("Rename marker", "Name", toText(now),
                                               [&session, index](const juce::String& name)
                                               {
                                                   const auto clip = session.model.clip();
                                                   setMarkers(session, "Rename marker",
                                                              renamedMarker(clip->markers, index, name.toStdString()));
                                               }));
}

void go(Session& session, const std::optional<double>& time)
{
    if (time)
        session.transport.setPlayhead(*time);
}
} // namespace

Menu markerMenu(EditorView& view)
{
    Session& session = view.session();
    const auto onMarker = [&session]
    {
        return markerHere(session).has_value();
    };
    const auto anyMarker = [&session]
    {
        return session.model.clip() && !session.model.clip()->markers.empty();
    };
    using Key = juce::KeyPress;
    Menu menu("Marker");
    menu.add(addMarker, "Add marker", "Adds a marker at the playhead, also during playback",
             [&session] { addHere(session); }, hasClip(session), {Key('m')});
    menu.add(renameMarker, "Rename marker...", "Renames the marker at the playhead", [&view] { rename(view); },
             onMarker, {Key(Key::F2Key)});
    menu.add(
        deleteMarker, "Delete marker", "Deletes the marker at the playhead",
        [&session]
        { setMarkers(session, "Delete marker", withoutMarker(session.model.clip()->markers, *markerHere(session))); },
        onMarker, {Key('m', juce::ModifierKeys::shiftModifier, 0)});
    menu.addLine();
    menu.add(nextMarker, "Next marker", "Moves the playhead to the next marker",
             [&session] { go(session, markerAfter(session.model.clip()->markers, session.transport.playhead())); },
             anyMarker, {ctrlShift(Key::rightKey)});
    menu.add(markerBack, "Previous marker", "Moves the playhead to the previous marker",
             [&session] { go(session, markerBefore(session.model.clip()->markers, session.transport.playhead())); },
             anyMarker, {ctrlShift(Key::leftKey)});
    return menu;
}

} // namespace pacini::editor
