// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/EditorView.h"
#include "editor/clip/commands/Action.h"
#include "editor/measure/MeasurePage.h"

#include <memory>

namespace pacini::editor
{

Menu toolsMenu(EditorView& view)
{
    Menu menu("Tools");
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
    return menu;
}

} // namespace pacini::editor
