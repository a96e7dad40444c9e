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
    const auto anyClip = [&session]
    {
        return session.model.clip() != nullptr;
    };
    const auto fade = [&](Command id, const char* name, const char* help, FadeDirection direction, FadeShape shape)
    {
        return Action{.id = id,
                      .name = name,
                      .help = help,
                      .run =
                          [&session, name, direction, shape] {
                              session.model.edit(name, FadeEdit{session.clipSelection.scope(), direction, shape});
                          },
                      .can = anyClip,
                      .lineBefore = id == fadeIn};
    };
    using Key = juce::KeyPress;
    return {"Shape",
            {
                {.id = changeGain,
                 .name = "Gain...",
                 .help = "Louder or softer by a number of dB: the selection, the time range or the clip",
                 .run = asking(view, gainOperation, false),
                 .can = anyClip,
                 .keys = {ctrl('g')}},
                fade(fadeIn, "Fade in", "Fades in over the selection, the time range or the clip", FadeDirection::in,
                     FadeShape::linear),
                fade(fadeOut, "Fade out", "Fades out over the selection, the time range or the clip",
                     FadeDirection::out, FadeShape::linear),
                fade(fadeInSmoothly, "Fade in smoothly", "Fades in with a soft begin and end", FadeDirection::in,
                     FadeShape::smooth),
                fade(fadeOutSmoothly, "Fade out smoothly", "Fades out with a soft begin and end", FadeDirection::out,
                     FadeShape::smooth),
                {.id = invertCurves,
                 .name = "Invert",
                 .help = "Turns levels, frequencies and sharpness upside down",
                 .run = [&session] { session.model.edit("Invert", InvertEdit{session.clipSelection.scope()}); },
                 .can = anyClip,
                 .keys = {ctrl('i')},
                 .lineBefore = true},
                {.id = quantise,
                 .name = "Quantise...",
                 .help = "Moves times towards a grid of seconds or beats",
                 .run = asking(view, quantiseOperation, true),
                 .can = anyClip,
                 .keys = {Key('q')}},
                {.id = humanise,
                 .name = "Humanise...",
                 .help = "Changes times, levels and pitches a little at random",
                 .run = asking(view, humaniseOperation, true),
                 .can = anyClip,
                 .keys = {ctrl('h')}},
                {.id = thinOut,
                 .name = "Thin transients...",
                 .help = "Removes transients that are too close to stronger ones, or too weak",
                 .run = asking(view, thinOperation, true),
                 .can =
                     [&session]
                 {
                     return session.model.clip() && !session.model.clip()->transients.empty();
                 }},
            }};
}

} // namespace pacini::editor
