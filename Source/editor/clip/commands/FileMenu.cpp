// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/Text.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/sheets/ExportSheet.h"

namespace pacini::editor
{

namespace
{
juce::PopupMenu recentProjects(EditorView& view)
{
    juce::PopupMenu menu;
    RecentFiles& recent = view.session().model.recentFiles();
    for (const auto& file : recent.files())
        menu.addItem(pathText(file), RecentFiles::exists(file), false, [&view, file] { view.files().open({file}); });
    menu.addSeparator();
    menu.addItem("Forget them", [&recent] { (void)recent.clear(); });
    return menu;
}

juce::PopupMenu demoSounds(EditorView& view)
{
    juce::PopupMenu menu;
    for (const auto& file : view.hostServices().demoSounds)
        menu.addItem(pathText(file.stem()).replaceCharacter('_', ' '), [&view, file] { view.files().open({file}); });
    return menu;
}
} // namespace

Menu fileMenu(EditorView& view)
{
    const auto anyClip = [&view]
    {
        return view.session().model.clip() != nullptr;
    };
    Menu menu{"File", {}};
    menu.actions = {
        {.id = newProject,
         .name = "New project",
         .help = "Begins an empty project",
         .run = [&view] { view.files().whenSaved([&view] { view.session().model.newProject(); }); },
         .keys = {ctrl('n')}},
        {.id = openFile,
         .name = "Open...",
         .help = "Opens sounds, clips of all known formats and projects",
         .run = [&view] { view.files().askWhatToOpen(); },
         .keys = {ctrl('o')}},
        {.id = openFolder,
         .name = "Open folder...",
         .help = "Adds every sound and clip in a folder, and in the folders inside it",
         .run = [&view] { view.files().askWhatFolder(); },
         .keys = {ctrlShift('o')}},
        {.id = openRecent,
         .name = "Recent projects",
         .help = "Opens a project that was open before",
         .can = [&view] { return !view.session().model.recentFiles().files().empty(); },
         .choices =
             [&view]
         {
             return recentProjects(view);
         }},
        {.id = openDemo,
         .name = "Open a demo sound",
         .help = "Opens one of the sounds that come with Pacini",
         .run = [&view] { view.files().open({view.hostServices().demoSounds.front()}); },
         .can = [&view] { return !view.hostServices().demoSounds.empty(); },
         .choices =
             [&view]
         {
             return demoSounds(view);
         }},
        {.id = openSample,
         .name = "Open the sample project",
         .help = "Three clips with hand edits, groups, markers and notes, to try things on; it opens as a new project",
         .run = [&view] { view.files().openSample(); },
         .can =
             [&view]
         {
             return view.files().hasSample();
         }},
        {.id = save,
         .name = "Save project",
         .help = "Writes the project to its file",
         .run = [&view] { view.files().save(); },
         .can = anyClip,
         .keys = {ctrl('s')},
         .lineBefore = true},
        {.id = saveAs,
         .name = "Save project as...",
         .help = "Writes the project to another file",
         .run = [&view] { view.files().saveAs(); },
         .can = anyClip,
         .keys = {ctrlShift('s')}},
        {.id = exportClips,
         .name = "Export...",
         .help = "Writes clips for use elsewhere, in any format",
         .run = [&view]
         { view.showSheet(std::make_unique<ExportSheet>(view.session().model, view.session().actuators)); },
         .can = anyClip,
         .keys = {ctrl('e')},
         .lineBefore = true},
    };
    menu.actions.push_back({.id = stopWork,
                            .name = "Stop opening and analysing",
                            .help = "Skips files that are not opened and analysed yet",
                            .run = [&view] { view.session().sounds.stopWork(); },
                            .can = [&view] { return view.session().sounds.workNow().has_value(); },
                            .keys = {juce::KeyPress(juce::KeyPress::escapeKey)},
                            .lineBefore = true});
    if (view.hostServices().quit)
        menu.actions.push_back({.id = quit,
                                .name = "Quit",
                                .help = "Closes the program",
                                .run = [&view] { view.hostServices().quit(); },
                                .keys = {ctrl('q')},
                                .lineBefore = true});
    return menu;
}

} // namespace pacini::editor
