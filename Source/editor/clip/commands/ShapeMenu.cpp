// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/commands/Operations.h"

namespace pacini::editor
{

namespace
{
/// Asks for the arguments of an operation of the scope, and keeps them for the next time.
std::function<void()> asking(EditorView& view, Operation (*make)(const ClipSelection&), bool keeps)
{
    auto last = keeps ? std::make_shared<OperationValues>() : nullptr;
    return [&view, make, last]
    {
        view.session().model.setComparing(false);
        view.showSheet(std::make_unique<OperationSheet>(view, make(view.session().clipSelection), last));
    };
}
} // namespace

Menu shapeMenu(EditorView& view)
{
    Session& session = view.session();
    const auto anyClip = hasClip(session);
    using Key = juce::KeyPress;
    Menu menu("Shape");
    const auto fade = [&](Command id, const char* name, const char* help, FadeDirection direction, FadeShape shape)
    {
        menu.add(
            id, name, help,
            [&session, name, direction, shape] {
                session.model.edit(name, FadeEdit{session.clipSelection.scope(), direction, shape});
            },
            anyClip);
    };
    menu.add(changeGain, "Gain...", "Louder or softer by a number of dB: the selection, the time range or the clip",
             asking(view, gainOperation, false), anyClip, {ctrl('g')});
    menu.addLine();
    fade(fadeIn, "Fade in", "Fades in over the selection, the time range or the clip", FadeDirection::in,
         FadeShape::linear);
    fade(fadeOut, "Fade out", "Fades out over the selection, the time range or the clip", FadeDirection::out,
         FadeShape::linear);
    fade(fadeInSmoothly, "Fade in smoothly", "Fades in with a soft begin and end", FadeDirection::in,
         FadeShape::smooth);
    fade(fadeOutSmoothly, "Fade out smoothly", "Fades out with a soft begin and end", FadeDirection::out,
         FadeShape::smooth);
    menu.addLine();
    menu.add(invertCurves, "Invert", "Turns levels, frequencies and sharpness upside down",
             [&session] { session.model.edit("Invert", InvertEdit{session.clipSelection.scope()}); }, anyClip,
             {ctrl('i')});
    menu.add(quantise, "Quantise...", "Moves times towards a grid of seconds or beats",
             asking(view, quantiseOperation, true), anyClip, {Key('q')});
    menu.add(humanise, "Humanise...", "Changes times, levels and pitches a little at random",
             asking(view, humaniseOperation, true), anyClip, {ctrl('h')});
    menu.add(thinOut, "Thin transients...", "Removes transients that are too close to stronger ones, or too weak",
             asking(view, thinOperation, true),
             [&session] { return session.model.clip() && !session.model.clip()->transients.empty(); });
    return menu;
}

} // namespace pacini::editor
