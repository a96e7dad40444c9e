// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/clip/scene/SceneSheet.h"
#include "editor/measure/MeasurePage.h"
#include "editor/study/NewStudySheet.h"

#include <memory>

namespace pacini::editor
{

Menu toolsMenu(EditorView& view)
{
    Session& session = view.session();
    Menu menu("Tools");
    menu.add(editScene, "Scene...", "Clips of the project that play together, over several actuators",
             [&view, &session] { view.showSheet(std::make_unique<SceneSheet>(session)); }, hasClip(session),
             {ctrlShift('e')});
    menu.add(
        addToScene, "Add clip to scene", "Adds the clip behind the last one of the scene",
        [&session]
        {
            SceneSelection scene(session.model);
            scene.add(session.model.activeId(), sceneEnd(session.model.document().project()));
        },
        hasClip(session));
    menu.addLine();
    menu.add(measureActuator, "Measure an actuator...",
             "Measures an actuator with a sensor, equalises its response and saves a profile",
             [&view, controller = std::make_shared<std::shared_ptr<MeasurementController>>()]
             {
                 if (dynamic_cast<MeasurePage*>(view.sheet()) != nullptr)
                     return; // a controller has one page

                 // Made when it is first needed, and kept: the page may be closed and opened again.
                 const HostServices& around = view.hostServices();
                 if (!*controller)
                     *controller = std::make_shared<MeasurementController>(
                         view.session().actuators, view.session().transport,
                         MeasurementController::HostServices{around.measureRig, around.profileFolder});
                 view.showSheet(std::make_unique<MeasurePage>(*controller, around.showDevices));
             });
    menu.add(loadProfile, "Load profile...", "Adds the profile of an actuator from a file, and chooses it",
             [&view] { view.files().askForProfile(); });
    menu.addLine();
    menu.add(newStudy, "New study...", "Makes a study with people from a template",
             [&view] { view.showSheet(std::make_unique<NewStudySheet>(view)); });
    menu.add(
        runStudy, "Run a study...", "Opens a study (study.json) in a window for the participant",
        [&view] { view.files().askForStudy(); }, [&view] { return view.hostServices().runStudy != nullptr; });
    menu.add(reportOnStudy, "Report of a study...", "Writes the statistics of a study's answers and opens them",
             [&view] { view.files().askForStudyReport(); });
    menu.addLine();
    menu.add(
        feelOnPhone, "Feel on a phone...", "Makes a phone in the same network vibrate along with playback",
        [&view] { view.hostServices().feelOnPhone(); }, [&view] { return view.hostServices().feelOnPhone != nullptr; });
    return menu;
}

} // namespace pacini::editor
