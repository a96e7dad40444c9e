// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/commands/Operations.h"
#include "editor/clip/session/ClipSteps.h"

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
                editClip(session.model, name, FadeEdit{session.clipSelection.scope(), direction, shape});
            },
            anyClip);
    };
    menu.add(changeGain, "Gain...", "Changes the level of the selection, the time range or the clip",
             asking(view, gainOperation, false), anyClip, {ctrl('g')});
    menu.addLine();
    fade(fadeIn, "Fade in", "Fades in over the selection, the time range or the clip", FadeDirection::in,
         FadeShape::linear);
    fade(fadeOut, "Fade out", "Fades out over the selection, the time range or the clip", FadeDirection::out,
         FadeShape::linear);
    fade(fadeInSmoothly, "Smooth fade in", "Fades in with an S-shaped curve", FadeDirection::in, FadeShape::smooth);
    fade(fadeOutSmoothly, "Smooth fade out", "Fades out with an S-shaped curve", FadeDirection::out, FadeShape::smooth);
    menu.addLine();
    menu.add(invertCurves, "Invert", "Flips levels, frequencies and sharpness upside down",
             [&session] { editClip(session.model, "Invert", InvertEdit{session.clipSelection.scope()}); }, anyClip,
             {ctrl('i')});
    menu.add(quantise, "Quantise...", "Moves points towards a grid in seconds or beats",
             asking(view, quantiseOperation, true), anyClip, {Key('q')});
    menu.add(humanise, "Humanise...", "Varies timing, level and pitch at random", asking(view, humaniseOperation, true),
             anyClip, {ctrl('h')});
    menu.add(thinOut, "Thin events...", "Removes events that are weak or too close to stronger ones",
             asking(view, thinOperation, true),
             [&session] { return session.model.clip() && !session.model.clip()->transients.empty(); });
    return menu;
}

} // namespace pacini::editor
