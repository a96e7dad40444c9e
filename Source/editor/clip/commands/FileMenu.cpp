// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/Text.h"
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/sheets/ExportSheet.h"

#include <algorithm>
#include <memory>
#include <utility>

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
    menu.addItem(tr("Clear list"), [&recent] { (void)recent.clear(); });
    return menu;
}

/// A place with some room on both sides, and the playhead at it.
void showPlace(Session& session, double time, double duration)
{
    constexpr double room = 0.25; // s
    const double end = session.model.duration();
    session.transport.setPlayhead(std::clamp(time, 0.0, end));
    session.viewState.showRange({std::max(0.0, time - room), std::min(end, time + duration + room)});
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
    const auto anyClip = hasClip(view.session());
    Menu menu("File");
    menu.add(newProject, "New project", "Starts an empty project",
             [&view] { view.files().whenSaved([&view] { view.session().model.newProject(); }); }, {}, {ctrl('n')});
    menu.add(openFile, "Open...", "Opens sounds, clips of any supported format, and projects",
             [&view] { view.files().askWhatToOpen(); }, {}, {ctrl('o')});
    menu.add(openFolder, "Open folder...", "Adds all sounds and clips in a folder and its subfolders",
             [&view] { view.files().askWhatFolder(); }, {}, {ctrlShift('o')});
    menu.addMenu(
        openRecent, "Recent projects", "Opens a recent project", [&view] { return recentProjects(view); },
        [&view] { return !view.session().model.recentFiles().files().empty(); });
    menu.addMenu(
        openDemo, "Open a demo sound", "Opens a sound that comes with Pacini", [&view] { return demoSounds(view); },
        [&view] { return !view.hostServices().demoSounds.empty(); },
        [&view] { view.files().open({view.hostServices().demoSounds.front()}); });
    menu.add(
        openSample, "Open the sample project",
        "Opens three clips with edits, groups, markers and notes to experiment with, as a new project",
        [&view] { view.files().openSample(); }, [&view] { return view.files().hasSample(); });
    menu.addLine();
    menu.add(save, "Save project", "Saves the project", [&view] { view.files().save(); }, anyClip, {ctrl('s')});
    menu.add(saveAs, "Save project as...", "Saves the project under a new name", [&view] { view.files().saveAs(); },
             anyClip, {ctrlShift('s')});
    menu.addLine();
    menu.add(exportClips, "Export...", "Exports clips to any supported format",
             [&view]
             {
                 auto sheet =
                     std::make_unique<ExportSheet>(view.session().model, view.session().actuators, view.lastExport);
                 sheet->onPlace = [&session = view.session()](int clip, double time, double duration)
                 {
                     if (clip != session.model.activeId())
                         session.model.show(clip);
                     showPlace(session, time, duration);
                 };
                 view.showSheet(std::move(sheet));
             },
             anyClip, {ctrl('e')});
    menu.addLine();
    menu.add(
        stopWork, "Cancel import", "Cancels opening and analysis of the remaining files",
        [&view] { view.session().sounds.stopWork(); }, [&view] { return view.session().sounds.workNow().has_value(); },
        {juce::KeyPress(juce::KeyPress::escapeKey)});
    if (view.hostServices().quit)
    {
        menu.addLine();
        menu.add(quit, "Quit", "Quits the editor", [&view] { view.hostServices().quit(); }, {}, {ctrl('q')});
    }
    return menu;
}

} // namespace pacini::editor
