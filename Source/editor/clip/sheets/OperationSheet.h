// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Dialog for the arguments of an edit, with a live preview on the clip.

#include "editor/clip/session/ClipSelection.h"
#include "editor/clip/session/Jobs.h"
#include "editor/clip/sheets/Sheet.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pacini::editor
{

class EditorView;

/// One value for each field; of a choice the index.
using OperationValues = std::vector<double>;

/// An argument: a number, or one of some choices.
struct OperationField
{
    const char* name = "";
    const char* unit = "";
    const char* help = "";
    double low = 0.0;
    double high = 1.0;
    double value = 0.0; ///< at first
    int decimals = 0;
    std::vector<std::string> choices = {};                   ///< empty: a number
    std::function<bool(const OperationValues&)> counts = {}; ///< empty: always
};

/// What an operation makes of a clip.
struct MadeClip
{
    Clip clip;
    std::string doubt = {}; ///< what the user should know of it; empty: nothing
};

struct Operation
{
    const char* name = "";  ///< of the sheet and of the step of undo
    bool wholeClip = false; ///< else for the scope, see Session::scope()
    std::vector<OperationField> fields;
    std::function<EditOperation(const OperationValues&)> make;
    /// In place of `make`, for what is no edit of its own: the clip that it makes is kept.
    std::function<Result<MadeClip>(const Clip&, const OperationValues&)> makeClip = {};

    [[nodiscard]] Result<MadeClip> madeOf(const Clip& clip, const OperationValues& values) const;
};

/// While it is open, the view previews the result of the edit; Return applies the edit, Cancel discards it. Space
/// plays, the arrow keys up and down change the focused number.
class OperationSheet final : public Sheet
{
public:
    /// `last`: values to begin with, and where those that were applied are left; null: those of the fields.
    OperationSheet(EditorView& shown, Operation wanted, std::shared_ptr<OperationValues> last);
    ~OperationSheet() override;

    [[nodiscard]] const OperationValues& values() const noexcept { return now; }
    /// As typed into a field.
    void setValue(std::size_t field, double value);
    void apply();

private:
    class Row;

    void layOut(juce::Rectangle<int> area) override;
    juce::Component* firstFocus() override;
    void valueChanged();
    void preview();
    void show(Result<MadeClip> made);
    [[nodiscard]] juce::String scopeText() const;

    EditorView& view;
    EditorModel& model;
    const ClipSelection& clipSelection;
    const Operation operation;
    std::shared_ptr<OperationValues> remembered;
    OperationValues now;
    std::shared_ptr<const Clip> start;
    juce::Label scopeLabel, problem;
    std::vector<std::unique_ptr<Row>> rows;
    bool running = false; ///< a preview is being made
    bool again = false;   ///< and is out of date
    bool possible = true;
    bool changes = true; ///< something is different from before
    Jobs jobs;
};

} // namespace pacini::editor
