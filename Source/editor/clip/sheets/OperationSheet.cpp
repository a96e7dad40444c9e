// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/sheets/OperationSheet.h"

#include "document/EditLayer.h"
#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/session/ClipSteps.h"

#include <algorithm>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr int sheetWidth = 56 * grid;
constexpr int operationRowHeight = 4 * grid;
constexpr int textHeight = 3 * grid;
constexpr int around = 14 * grid; // title, answers and margins
constexpr int operationLabelWidth = 11 * grid;
constexpr int numberWidth = 10 * grid;
constexpr int unitWidth = 14 * grid;
constexpr std::size_t quickPoints = 20000; // of an edit on the message thread
} // namespace

/// A name, a slider, a number and its unit with the range; or a name and choices.
class OperationSheet::Row final : public juce::Component, private juce::KeyListener
{
public:
    Row(const OperationField& of, double first) : field(of)
    {
        prepareLabel(name, field.name, usualFont());
        addAndMakeVisible(name);
        if (!field.choices.empty())
        {
            choice.setTitle(field.name);
            choice.setTooltip(field.help);
            choice.addKeyListener(this);
            for (std::size_t i = 0; i < field.choices.size(); ++i)
                choice.addItem(tr(toText(field.choices[i])), 1 + static_cast<int>(i));
            choice.setSelectedId(1 + juce::roundToInt(first), juce::dontSendNotification);
            choice.onChange = [this]
            {
                changed();
            };
            addAndMakeVisible(choice);
            return;
        }
        unit.setText(tr("{0}, {1} to {2}", {tr(toText(field.unit)), numberText(field.low, shortDecimals(field.low)),
                                            numberText(field.high, shortDecimals(field.high))}),
                     juce::dontSendNotification);
        unit.setFont(smallFont());
        unit.setAccessible(false);
        addAndMakeVisible(unit);
        slider.setSliderStyle(juce::Slider::LinearHorizontal);
        slider.setTextBoxStyle(juce::Slider::NoTextBox, true, 0, 0);
        slider.setRange(field.low, field.high, std::pow(10.0, -field.decimals));
        slider.setValue(first, juce::dontSendNotification);
        slider.setTitle(tr("{0} slider", {tr(field.name)}));
        slider.setTooltip(field.help);
        slider.setWantsKeyboardFocus(false);
        slider.onValueChange = [this]
        {
            number.setText(numberText(slider.getValue(), field.decimals), false);
            changed();
        };
        addAndMakeVisible(slider);
        number.setTitle(tr(field.name) + ", " + tr(toText(field.unit)));
        number.setTooltip(field.help);
        number.setFont(usualFont());
        number.setIndents(grid, 7);
        number.setSelectAllWhenFocused(true);
        number.setText(numberText(first, field.decimals), false);
        number.addKeyListener(this);
        number.onTextChange = [this]
        {
            slider.setValue(value(), juce::dontSendNotification);
            changed();
        };
        number.onReturnKey = [this]
        {
            onReturn();
        };
        number.onEscapeKey = [this]
        {
            onEscape();
        };
        addAndMakeVisible(number);
    }

    std::function<void()> onChange, onReturn, onEscape, onSpace;

    [[nodiscard]] double value() const
    {
        if (!field.choices.empty())
            return choice.getSelectedId() - 1.0;
        const double typed = withDecimalPoint(number.getText()).getDoubleValue();
        return std::isfinite(typed) ? std::clamp(typed, field.low, field.high) : field.value;
    }

    void set(double wanted)
    {
        if (!field.choices.empty())
            return choice.setSelectedId(1 + juce::roundToInt(wanted), juce::dontSendNotification);
        number.setText(numberText(wanted, field.decimals), false);
        slider.setValue(value(), juce::dontSendNotification);
    }

    [[nodiscard]] juce::Component& input()
    {
        return field.choices.empty() ? static_cast<juce::Component&>(number) : choice;
    }

    /// The width that the name needs; all rows of a sheet have the same.
    [[nodiscard]] int nameWidth(int most) const { return labelsWidth({&name}, operationLabelWidth, most); }
    void setNameWidth(int width)
    {
        labelWidth = width;
        resized();
    }

    const OperationField field;

private:
    void changed()
    {
        if (onChange)
            onChange();
    }

    [[nodiscard]] int shortDecimals(double limit) const { return limit == std::round(limit) ? 0 : field.decimals; }

    using juce::Component::keyPressed;
    bool keyPressed(const juce::KeyPress& key, juce::Component*) override
    {
        using K = juce::KeyPress;
        if (key.getKeyCode() == K::spaceKey)
            onSpace();
        else if (!field.choices.empty() && key.getKeyCode() == K::returnKey)
            onReturn(); // not the list
        else if (field.choices.empty() && (key.getKeyCode() == K::upKey || key.getKeyCode() == K::downKey))
        {
            const double step = std::max(slider.getInterval(), (field.high - field.low) / 100.0);
            slider.setValue(slider.getValue() + (key.getKeyCode() == K::upKey ? step : -step),
                            juce::sendNotificationSync);
        }
        else
            return false;
        return true;
    }

    void resized() override
    {
        auto area = getLocalBounds();
        name.setBounds(area.removeFromLeft(labelWidth));
        if (!field.choices.empty())
            return choice.setBounds(area);
        unit.setBounds(area.removeFromRight(unitWidth).withTrimmedLeft(grid / 2));
        number.setBounds(area.removeFromRight(numberWidth));
        area.removeFromRight(grid);
        slider.setBounds(area);
        number.applyColourToAllText(paletteFor(*this).text);
    }

    int labelWidth = operationLabelWidth;
    juce::Label name, unit;
    Slider slider;
    juce::TextEditor number;
    juce::ComboBox choice;
};

Result<MadeClip> Operation::madeOf(const Clip& clip, const OperationValues& values) const
{
    if (makeClip)
        return makeClip(clip, values);
    auto edited = applyEdit(clip, make(values));
    if (!edited)
        return edited.error();
    return MadeClip{std::move(edited).value()};
}

OperationSheet::OperationSheet(EditorView& shown, Operation wanted, std::shared_ptr<OperationValues> last)
    : Sheet(wanted.name, sheetWidth,
            around + (wanted.makeClip ? 4 : 2) * textHeight +
                static_cast<int>(wanted.fields.size()) * (operationRowHeight + grid)),
      view(shown),
      model(shown.session().model),
      clipSelection(shown.session().clipSelection),
      operation(std::move(wanted)),
      remembered(std::move(last)),
      start(model.item()->clip)
{
    model.setComparing(false);
    for (const OperationField& field : operation.fields)
        now.push_back(field.value);
    if (remembered && remembered->size() == now.size())
        for (std::size_t i = 0; i < now.size(); ++i)
            now[i] = std::clamp((*remembered)[i], operation.fields[i].low,
                                operation.fields[i].choices.empty()
                                    ? operation.fields[i].high
                                    : static_cast<double>(operation.fields[i].choices.size()) - 1.0);
    problem.setJustificationType(juce::Justification::topLeft);
    for (juce::Label* label : {&scopeLabel, &problem})
    {
        label->setFont(smallFont());
        addAndMakeVisible(label);
    }
    scopeLabel.setText(scopeText(), juce::dontSendNotification);
    for (std::size_t i = 0; i < operation.fields.size(); ++i)
    {
        auto row = std::make_unique<Row>(operation.fields[i], now[i]);
        row->onChange = [this]
        {
            valueChanged();
        };
        row->onReturn = [this]
        {
            apply();
        };
        row->onEscape = [this]
        {
            close();
        };
        row->onSpace = [this]
        {
            view.doCommand(playOrPause);
        };
        addAndMakeVisible(*row);
        rows.push_back(std::move(row));
    }
    setAnswers({{"Apply", {}}, {"Cancel", {}}});
    setUsualAnswer([this] { apply(); });
    standAside();
    valueChanged();
}

OperationSheet::~OperationSheet()
{
    model.setPreview(nullptr);
}

juce::Component* OperationSheet::firstFocus()
{
    for (const auto& row : rows)
        if (row->isEnabled())
            return &row->input();
    return nullptr;
}

juce::String OperationSheet::scopeText() const
{
    if (operation.wholeClip)
        return tr("Applies to the whole clip");
    const EditScope scope = clipSelection.scope();
    const auto times = tr("{0} to {1} s", {numberText(scope.range.from, 3), numberText(scope.range.to, 3)});
    if (!scope.allLanes)
        return tr("Applies to the selection: {0}", {times});
    return clipSelection.timeRange() ? tr("Applies to the time range, all lanes: {0}", {times})
                                     : tr("Applies to the whole clip, all lanes");
}

void OperationSheet::setValue(std::size_t field, double value)
{
    rows[field]->set(value);
    valueChanged();
}

void OperationSheet::valueChanged()
{
    for (std::size_t i = 0; i < rows.size(); ++i)
        now[i] = rows[i]->value();
    for (const auto& row : rows)
        row->setEnabled(!row->field.counts || row->field.counts(now));
    preview();
}

void OperationSheet::preview()
{
    std::size_t points = breakpointCount(*start);
    if (operation.make)
    {
        const EditOperation wanted = operation.make(now);
        if (const auto* repeated = std::get_if<RepeatEdit>(&wanted))
            points *= static_cast<std::size_t>(repeated->passes);
    }
    if (points <= quickPoints)
        return show(operation.madeOf(*start, now));
    again = running;
    if (running)
        return;
    running = true;
    jobs.run([from = start, made = operation, values = now] { return made.madeOf(*from, values); },
             [this](Result<MadeClip> made)
             {
                 running = false;
                 show(std::move(made));
                 if (again)
                     preview();
             });
}

void OperationSheet::show(Result<MadeClip> made)
{
    possible = made.ok();
    setAnswerEnabled(possible);
    problem.setText(translateMessage(toText(possible ? made->doubt : made.error().text())), juce::dontSendNotification);
    if (!possible)
        return model.setPreview(nullptr);
    changes = !(made->clip == *start);
    model.setPreview(changes ? std::make_shared<const Clip>(std::move(made->clip)) : nullptr);
}

void OperationSheet::apply()
{
    if (!possible)
        return;
    model.setPreview(nullptr);
    if (remembered)
        *remembered = now;
    // An edit that fails puts its message in place of this sheet.
    const auto wanted = operation;
    const auto values = now;
    const bool any = changes || running;
    EditorModel& target = model;
    close();
    if (!any)
        return;
    if (wanted.make)
        editClip(target, wanted.name, wanted.make(values));
    else if (auto made = wanted.makeClip(*target.clip(), values))
        setClip(target, wanted.name, std::move(made->clip));
    else
        target.report("Not applied", made.error());
}

void OperationSheet::layOut(juce::Rectangle<int> area)
{
    const Palette& p = paletteFor(*this);
    scopeLabel.setColour(juce::Label::textColourId, p.dim);
    problem.setColour(juce::Label::textColourId, p.warning);
    scopeLabel.setBounds(area.removeFromTop(textHeight));
    int labels = operationLabelWidth;
    for (const auto& row : rows)
        labels = std::max(labels, row->nameWidth(area.getWidth() / 2));
    for (const auto& row : rows)
    {
        row->setNameWidth(labels);
        row->setBounds(area.removeFromTop(operationRowHeight));
        area.removeFromTop(grid);
    }
    problem.setBounds(area.removeFromTop((operation.makeClip ? 3 : 1) * textHeight));
}

} // namespace pacini::editor
