// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Selection in the clip that is shown, with its clipboard and the edits that act on it.

#include "document/Paste.h"
#include "document/SelectionEdits.h"
#include "editor/clip/session/EditorModel.h"

#include <optional>
#include <string>

namespace pacini::editor
{

/// Points, transients and the time range, always kept within the clip. [message]
class ClipSelection
{
public:
    explicit ClipSelection(EditorModel& project);

    Signal changed;      ///< points and transients, or whether there is anything to paste
    Signal rangeChanged; ///< the time range

    [[nodiscard]] const Selection& selected() const noexcept { return selectionNow; }
    void select(Selection wanted);
    [[nodiscard]] const std::optional<TimeRange>& timeRange() const noexcept { return rangeNow; }
    void setTimeRange(std::optional<TimeRange> wanted);
    /// The scope of edits of a stretch, see scopeOf().
    [[nodiscard]] EditScope scope() const;

    /// An edited clip with where its selection went. False: told by the project's onError, and nothing has changed.
    bool setEdited(std::string name, EditedClip edited, Gesture gesture = 0);
    /// The same of a clip that `first` was applied to before, in the same step.
    bool setEdited(std::string name, EditOperation first, EditedClip edited);
    void deleteSelection();
    void copy();
    void cut();
    /// At `time`; a single lane that was copied goes into `into`. A clip that is too short becomes longer.
    void paste(double time, const std::optional<Lane>& into = {});
    [[nodiscard]] bool canPaste() const noexcept { return clipboard.has_value(); }

private:
    void reset();
    void follow();
    void put(Selection wanted, std::optional<TimeRange> range);

    EditorModel& model;
    Selection selectionNow;
    std::optional<TimeRange> rangeNow;
    std::optional<Selection> edited;        ///< what the clip that is about to come is selected of
    std::optional<Selection> beforePreview; ///< while there is one
    std::optional<Copied> clipboard;
    Subscriptions subscriptions;
};

} // namespace pacini::editor
