// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Editing session: one editor without its window, as the parts that its views share.

#include "editor/clip/session/FilePreview.h"
#include "editor/clip/session/Tapping.h"
#include "editor/clip/session/Transport.h"
#include "editor/clip/session/ViewState.h"

#include <utility>
#include <vector>

namespace pacini::editor
{

/// Each part follows those before it, and before any view does. [message]
struct Session
{
    explicit Session(const EditorModel::Folders& folders, std::vector<NamedProfile> profiles)
        : model(folders), actuators(model, std::move(profiles))
    {
        subscriptions.on({&sounds.replaced}, [this] { viewState.fit(); });
        model.findPlace = [this]
        {
            return WorkPlace{model.activeId(), transport.playhead(), clipSelection.timeRange(), viewState.part()};
        };
        model.goToPlace = [this](const WorkPlace& place)
        {
            clipSelection.setTimeRange(place.range);
            if (place.view)
                viewState.showRange(*place.view);
            transport.setPlayhead(place.playhead);
        };
    }
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    ~Session()
    {
        model.keepPlace();
        model.findPlace = nullptr;
        model.goToPlace = nullptr;
    }

    EditorModel model;
    ProjectSounds sounds{model};
    Actuators actuators;
    HapticOutputs outputs;
    ClipSelection clipSelection{model};
    ViewState viewState{model};
    ClipPlayer player; ///< runs in the callback of a device
    Transport transport{model, sounds, actuators, outputs, clipSelection, player};
    Tapping tapping{model, transport};
    FilePreview filePreview{model, actuators, outputs, player};

private:
    Subscriptions subscriptions;
};

} // namespace pacini::editor
