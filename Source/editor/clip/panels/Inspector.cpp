// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/panels/Inspector.h"

#include "document/KeepShare.h"
#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/lanes/LaneText.h"
#include "editor/clip/session/ClipSteps.h"
#include "editor/clip/session/StepText.h"

#include <pacini/foundation/Units.h>

#include <cmath>

namespace pacini::editor
{

namespace
{
/// "0.250 to 1.500 s".
juce::String stretchText(TimeRange range)
{
    return tr("{0} to {1} s", {numberText(range.from, 3), numberText(range.to, 3)});
}

constexpr int inspectorRowHeight = 3 * grid;
constexpr int inspectorPreferredHeight = 75 * grid;
constexpr int fadeRow = inspectorRowHeight + 4 + grid;

/// Whether words for the fades are too long for two buttons side by side in the usual width of the panel.
bool fadesAreStacked()
{
    constexpr int half = 11 * grid;
    return std::max(usualFont().getStringWidth(tr("Fade in")), usualFont().getStringWidth(tr("Fade out"))) > half;
}

/// The first thing selected.
struct FirstThing
{
    double time = 0.0;
    double value = 0.0;
    bool hertz = false;
    std::optional<double> sharpness;
};

std::optional<FirstThing> firstOf(const Selection& selection, const Clip& clip)
{
    if (!selection.lanes.empty())
    {
        const LaneSelection& part = selection.lanes.front();
        const Breakpoint p = (*curveOf(clip, part.lane))[part.points.front()];
        return FirstThing{p.time, p.value, isFrequency(part.lane.kind), {}};
    }
    if (!selection.transients.empty())
    {
        const Transient& event = clip.transients[selection.transients.front()];
        return FirstThing{event.time, event.amplitude, false, event.sharpness};
    }
    return std::nullopt;
}
} // namespace

Inspector::Inspector(EditorView& shown)
    : view(shown),
      model(shown.session().model),
      clipSelection(shown.session().clipSelection),
      fadeInButton("Fade in"),
      fadeOutButton("Fade out"),
      reverseButton("Reverse clip")
{
    setTitle("Inspector");
    const auto label = [this](juce::Label& one, const juce::String& text)
    {
        prepareLabel(one, text, smallFont());
        addAndMakeVisible(one);
    };
    label(timeLabel, "Time");
    label(valueLabel, "Level");
    label(sharpLabel, "Sharpness");
    label(gainLabel, "Gain");
    label(keepLabel, "Keep points");
    for (juce::Label* text : {&scopeText, &cost, &facts})
    {
        label(*text, {});
        text->setAccessible(true);
        text->setJustificationType(juce::Justification::topLeft);
    }
    prepareFields();
    prepareSliders();
    const auto button = [this](juce::TextButton& one, Command command, const juce::String& help)
    {
        prepareButton(one, help, [this, command] { view.doCommand(command); });
        addAndMakeVisible(one);
    };
    button(fadeInButton, fadeIn, "Fades in over the selection, the time range or the clip");
    button(fadeOutButton, fadeOut, "Fades out over the selection, the time range or the clip");
    button(reverseButton, reverse, "Reverses the whole clip");
    setSize(200, inspectorPreferredHeight + (fadesAreStacked() ? fadeRow : 0));
    addChildComponent(chip);
    subscriptions.on({&model.contentChanged, &clipSelection.changed, &clipSelection.rangeChanged},
                     [this] { showSelection(); });
    subscriptions.on({&model.contentChanged}, [this] { showFacts(); });
    lookAndFeelChanged();
    showSelection();
    showFacts();
}

/// What is typed there moves the first thing selected, and the others with it.
void Inspector::prepareFields()
{
    const auto field = [this](juce::Label& one, const juce::String& title, const juce::String& help)
    {
        one.setEditable(true, true, true);
        one.setTitle(title);
        one.setTooltip(help);
        one.setFont(usualFont());
        one.setJustificationType(juce::Justification::centred);
        one.setWantsKeyboardFocus(true);
        addAndMakeVisible(one);
    };
    field(timeField, "Selection time", "Time of the first selected item in s; the others move along");
    field(valueField, "Selection value",
          "Level in dB or frequency in Hz of the first selected item; the others scale along");
    field(sharpField, "Selection sharpness",
          "Sharpness of the first selected event, 0 % dull to 100 % crisp; the others follow");
    const auto moves = [this](juce::Label& typed, SelectionStep step, auto moveOf)
    {
        typed.onTextChange = [this, &typed, step, moveOf]
        {
            const auto clip = model.clip();
            const auto first = clip ? firstOf(clipSelection.selected(), *clip) : std::nullopt;
            const std::optional<SelectionMove> move =
                first ? moveOf(*first, withDecimalPoint(typed.getText()).getDoubleValue()) : std::nullopt;
            if (move)
                clipSelection.setEdited(stepName(step, clipSelection.selected()),
                                        moveSelected(*clip, clipSelection.selected(), *move));
        };
    };
    moves(timeField, SelectionStep::move,
          [](const FirstThing& first, double time) { return std::optional(SelectionMove{.time = time - first.time}); });
    moves(valueField, SelectionStep::setValue,
          [](const FirstThing& first, double number)
          {
              SelectionMove move;
              if (first.hertz)
                  move.frequencyFactor = number > 0.0 && first.value > 0.0 ? number / first.value : 1.0;
              else if (first.value > 0.0)
                  move.amplitudeFactor = Decibels(number).gain() / first.value;
              else
                  move.amplitudeOffset = Decibels(number).gain();
              return std::optional(move);
          });
    moves(sharpField, SelectionStep::setSharpness,
          [](const FirstThing& first, double percent)
          {
              return first.sharpness ? std::optional(SelectionMove{.sharpness = 0.01 * percent - *first.sharpness})
                                     : std::nullopt;
          });
}

void Inspector::prepareSliders()
{
    const auto slider = [this](juce::Slider& one, double rest, const juce::String& title, const juce::String& help)
    {
        one.setSliderStyle(juce::Slider::LinearHorizontal);
        one.setTextBoxStyle(juce::Slider::TextBoxRight, false, 8 * grid, inspectorRowHeight);
        one.setTitle(title);
        one.setTooltip(help);
        one.setWantsKeyboardFocus(true);
        one.setDoubleClickReturnValue(true, rest);
        one.onDragStart = [this]
        {
            gesture = model.beginGesture();
        };
        one.onDragEnd = [this, &one, rest]
        {
            gesture = 0;
            one.setValue(rest, juce::dontSendNotification);
        };
        addAndMakeVisible(one);
    };
    slider(gain, 0.0, "Gain",
           "Changes the level of the selection, the time range or the clip in dB; springs back to 0");
    gain.setRange(-24.0, 24.0, 0.1);
    gain.setTextValueSuffix(" dB");
    gain.setNumDecimalPlacesToDisplay(1);
    gain.onValueChange = [this]
    {
        gainMoved();
    };
    slider(keep, 100.0, "Points kept", "Reduces the curves to this percentage of their points");
    keep.setRange(2.0, 100.0, 1.0);
    keep.setTextValueSuffix(" %");
    keep.setValue(100.0, juce::dontSendNotification);
    keep.onValueChange = [this]
    {
        simplifyMoved();
    };
}

void Inspector::lookAndFeelChanged()
{
    const Palette& p = paletteFor(*this);
    for (juce::Label* one : {&timeField, &valueField, &sharpField})
    {
        one->setColour(juce::Label::backgroundColourId, one->isEnabled() ? p.well : juce::Colours::transparentBlack);
        one->setColour(juce::Label::textColourId, p.text);
    }
    for (juce::Label* one : {&scopeText, &cost, &facts, &timeLabel, &valueLabel, &sharpLabel, &gainLabel, &keepLabel})
        one->setColour(juce::Label::textColourId, p.dim);
}

void Inspector::showSelection()
{
    const auto clip = model.clip();
    const Selection& selection = clipSelection.selected();
    const auto first = clip ? firstOf(selection, *clip) : std::nullopt;
    const auto set = [](juce::Label& label, juce::Label& field, bool shown, const juce::String& text)
    {
        label.setEnabled(shown);
        field.setEnabled(shown);
        if (!field.isBeingEdited())
            field.setText(shown ? text : toText("–"), juce::dontSendNotification);
        field.setColour(juce::Label::backgroundColourId,
                        shown ? paletteFor(field).well : juce::Colours::transparentBlack);
    };
    set(timeLabel, timeField, first.has_value(), first ? numberText(first->time, 4) + " s" : "");
    const bool hertz = first.has_value() && first->hertz;
    const double value = first.has_value() ? first->value : 0.0;
    valueLabel.setText(tr(hertz ? "Frequency" : "Level"), juce::dontSendNotification);
    set(valueLabel, valueField, first.has_value(), hertz ? hertzText(value) : amplitudeText(value));
    const bool sharp = first && first->sharpness;
    set(sharpLabel, sharpField, sharp,
        sharp ? juce::String(juce::roundToInt(100.0 * *first->sharpness)) + " %" : juce::String());
    juce::String scope;
    const auto count = static_cast<int>(selectedCount(selection));
    if (count > 0)
    {
        const auto range = *timeOf(selection, *clip);
        scope = counted(selectedCount(selection), "{0} point selected", "{0} points selected");
        if (count > 1)
            scope << "\n" << tr("{0}, their lanes", {stretchText(range)});
    }
    else if (const auto& range = clipSelection.timeRange())
        scope = tr("Range {0},", {stretchText(*range)}) + "\n" + tr("all lanes");
    else
        scope = tr("Nothing selected:") + "\n" + tr("edits apply to the whole clip");
    scopeText.setText(scope, juce::dontSendNotification);
}

void Inspector::showFacts()
{
    const auto clip = model.clip();
    if (!clip)
        return;
    juce::String text;
    text << numberText(clip->duration, 2) << " s, " << counted(clip->bands.size(), "{0} band", "{0} bands") << "\n"
         << counted(breakpointCount(*clip), "{0} point", "{0} points") << ", "
         << counted(clip->transients.size(), "{0} event", "{0} events");
    if (const auto item = model.item(); item && !item->unfitting.empty())
        text << "\n" << counted(item->unfitting.size(), "{0} unapplied edit", "{0} unapplied edits");
    facts.setText(text, juce::dontSendNotification);
    chip.show(*clip,
              [this]
              {
                  const auto dragged = model.clip();
                  const auto written = dragged ? writeForDragging(*dragged) : Result<juce::File>(juce::File());
                  if (!written)
                      model.onError("Cannot drag the clip", toText(written.error().text()));
                  return written ? *written : juce::File();
              });
}

std::vector<Lane> Inspector::scopeLanes() const
{
    const auto clip = model.clip();
    const EditScope scope = clipSelection.scope();
    return scope.allLanes ? lanesOf(*clip) : scope.lanes;
}

void Inspector::gainMoved()
{
    const bool single = gesture == 0; // typed, or by keys
    if (model.clip() && gain.getValue() != 0.0)
        editClip(model, "Gain", GainEdit{clipSelection.scope(), gain.getValue()},
                 single ? model.beginGesture() : gesture);
    if (single)
        gain.setValue(0.0, juce::dontSendNotification);
}

void Inspector::simplifyMoved()
{
    if (!model.clip())
        return;
    const bool single = gesture == 0;
    const Gesture own = single ? model.beginGesture() : gesture;
    const auto start = gestureStart(model, own);
    const auto lanes = scopeLanes();
    auto simplified = keepShare(*start, lanes, keep.getValue() / 100.0);
    if (!simplified)
        return cost.setText(translateMessage(juce::String(simplified.error().text())), juce::dontSendNotification);
    const SimplifyCost& found = simplified->cost;
    juce::String text;
    text << tr("{0} to {1} points",
               {juce::String(static_cast<int>(found.before)), juce::String(static_cast<int>(found.after))})
         << "\n"
         << tr("Max. error {0} % of full drive", {numberText(100.0 * found.amplitudeError, 2)});
    if (found.frequencyError > 0.0)
        text << ", " << numberText(found.frequencyError, 1) << " Hz";
    cost.setText(text, juce::dontSendNotification);
    clipSelection.setEdited("Simplify", {std::move(simplified->clip), {}}, own);
    if (single)
        keep.setValue(100.0, juce::dontSendNotification);
}

void Inspector::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.background);
    drawCard(g, selectionCard, "Selection", p);
    drawCard(g, levelCard, "Level", p);
    drawCard(g, simplifyCard, "Simplify", p);
    drawCard(g, factsCard, "Clip", p);
}

void Inspector::resized()
{
    auto area = getLocalBounds().reduced(grid);
    const auto card = [&](juce::Rectangle<int>& place, int height)
    {
        place = area.removeFromTop(height);
        area.removeFromTop(grid);
        return insideOfCard(place);
    };
    int labelWidth = 9 * grid;
    for (const juce::Label* label : {&timeLabel, &valueLabel, &sharpLabel})
        labelWidth = std::max(labelWidth, smallFont().getStringWidth(label->getText()) + grid);
    const auto row = [labelWidth](juce::Rectangle<int>& inside, juce::Label& label, juce::Component& field)
    {
        auto line = inside.removeFromTop(inspectorRowHeight);
        label.setBounds(line.removeFromLeft(labelWidth));
        field.setBounds(line);
        inside.removeFromTop(grid / 2);
    };
    auto inside = card(selectionCard, 20 * grid);
    scopeText.setBounds(inside.removeFromTop(4 * grid));
    inside.removeFromTop(grid / 2);
    row(inside, timeLabel, timeField);
    row(inside, valueLabel, valueField);
    row(inside, sharpLabel, sharpField);
    const bool stacked = fadesAreStacked();
    inside = card(levelCard, 20 * grid + (stacked ? fadeRow : 0));
    gainLabel.setBounds(inside.removeFromTop(2 * grid));
    gain.setBounds(inside.removeFromTop(inspectorRowHeight + 4));
    inside.removeFromTop(grid);
    auto line = inside.removeFromTop(inspectorRowHeight + 4);
    fadeInButton.setBounds(stacked ? line : line.removeFromLeft((line.getWidth() - grid) / 2));
    if (stacked)
    {
        inside.removeFromTop(grid);
        line = inside.removeFromTop(inspectorRowHeight + 4);
    }
    else
        line.removeFromLeft(grid);
    fadeOutButton.setBounds(line);
    inside.removeFromTop(grid);
    reverseButton.setBounds(inside.removeFromTop(inspectorRowHeight + 4));
    inside = card(simplifyCard, 14 * grid);
    keepLabel.setBounds(inside.removeFromTop(2 * grid));
    keep.setBounds(inside.removeFromTop(inspectorRowHeight + 4));
    cost.setBounds(inside);
    inside = card(factsCard, 16 * grid);
    chip.setBounds(inside.removeFromBottom(4 * grid));
    facts.setBounds(inside);
}

} // namespace pacini::editor
