// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/measure/SweepStep.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Translation.h"

#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr int playHeight = 25 * grid;
} // namespace

SweepControl::SweepControl(MeasurementController& wanted, bool throughEqualizer)
    : controller(wanted), verifying(throughEqualizer)
{
    button.onClick = [this]
    {
        if (controller.isPlaying())
            controller.stop();
        else if (verifying)
            controller.verify();
        else
            controller.sweep();
    };
    bar.setTitle("Sweep progress");
    addAndMakeVisible(button);
    addAndMakeVisible(bar);
    refresh();
}

bool SweepControl::isMine() const
{
    return controller.activity() ==
           (verifying ? MeasurementController::Activity::verifying : MeasurementController::Activity::sweeping);
}

void SweepControl::refresh()
{
    const bool analysing = controller.activity() == MeasurementController::Activity::analysing;
    button.setButtonText(tr(isMine() ? "Stop" : verifying ? "Sweep with equaliser" : "Sweep"));
    button.setTitle(button.getButtonText());
    button.setTooltip(tr(isMine() ? "Stops the sweep and discards it"
                                  : "Plays the sweep through the actuator and records the sensor"));
    button.setEnabled(
        isMine() || (controller.activity() == MeasurementController::Activity::none && controller.obstacle().empty()));
    if (analysing)
    {
        progress = -1.0;
        bar.setTextToDisplay(tr(toText("Analysing…")));
    }
    bar.setVisible(isMine() || analysing);
    tick();
}

void SweepControl::tick()
{
    if (!isMine())
        return;
    progress = controller.progress();
    bar.setTextToDisplay(tr("{0} s left", {juce::String(static_cast<int>(std::ceil(controller.secondsLeft())))}));
}

void SweepControl::resized()
{
    auto area = getLocalBounds();
    button.setBounds(area.removeFromLeft(verifying ? area.getWidth() : 14 * grid).removeFromTop(stepRow));
    if (verifying)
        bar.setBounds(getLocalBounds().withTrimmedTop(stepRow + stepGap).withHeight(3 * grid));
    else
        bar.setBounds(area.withTrimmedLeft(grid).withHeight(stepRow).reduced(0, grid / 2));
}

SweepStep::SweepStep(MeasurementController& wanted)
    : control(wanted, false),
      controller(wanted),
      name("Name", "Name of the next placement: who wears it, or how it is attached")
{
    name.control.setFont(usualFont());
    name.control.setIndents(grid, 7);
    name.control.onTextChange = [this]
    {
        controller.setNextPlacementName(name.control.getText().toStdString());
    };
    scroll.setViewedComponent(&list, false);
    scroll.setScrollBarsShown(true, false);
    list.setTitle("Placements");
    addAll(*this, {&name, &control, &meters[0], &meters[1], &meters[2], &scroll, &notes});
    refresh();
}

void SweepStep::refresh()
{
    nameMeters(meters, controller);
    if (!name.control.hasKeyboardFocus(true) || name.control.getText().isEmpty())
        name.control.setText(toText(controller.nextPlacementName()), false);
    name.setEnabled(!controller.isPlaying());
    control.refresh();

    const ActuatorMeasurement& work = controller.measurement();
    rows.clear();
    const MeasuredResponse* response = work.response();
    for (std::size_t i = 0; i < work.placements().size(); ++i)
    {
        const Placement& placement = *work.placements()[i];
        auto row = std::make_unique<Row>();
        juce::String text = toText(placement.name) + "   " + numberText(placement.level, 1) + " dB";
        if (response != nullptr && i < response->average.offsets.size() && work.placements().size() > 1)
        {
            const double offset = response->average.offsets[i];
            text << ", " << tr("{0} dB from average", {signedText(offset, 1)});
            if (response->findings.outliers.contains(i))
                text << ", " << tr("left out");
        }
        if (!placement.notes.empty())
            text << ", " << counted(placement.notes.size(), "{0} note", "{0} notes");
        row->name.setText(text, juce::dontSendNotification);
        row->name.setFont(usualFont());
        row->name.setTooltip(
            translateMessage(toText(placement.notes.empty() ? std::string() : placement.notes.front())));
        row->drop.setButtonText(tr("Remove"));
        row->drop.setTitle(tr("Remove: {0}", {toText(placement.name)}));
        row->drop.setEnabled(controller.activity() == MeasurementController::Activity::none);
        prepareButton(row->drop, tr("Removes this placement and recomputes the response"),
                      [safe = juce::Component::SafePointer<SweepStep>(this), i]
                      {
                          // Dropping removes this very button.
                          juce::MessageManager::callAsync(
                              [safe, i]
                              {
                                  if (safe)
                                      safe->controller.dropPlacement(i);
                              });
                      });
        list.addAndMakeVisible(row->name);
        list.addAndMakeVisible(row->drop);
        rows.push_back(std::move(row));
    }

    std::vector<Note> lines;
    if (!controller.sweepProblem().empty())
        lines.push_back({controller.sweepProblem(), Note::Kind::warning});
    else if (const auto obstacle = controller.obstacle(); !obstacle.empty())
        lines.push_back({obstacle, Note::Kind::warning});
    else if (!work.placements().empty())
    {
        for (const std::string& note : work.placements().back()->notes)
            lines.push_back({note, Note::Kind::warning});
        lines.push_back({"Move the actuator to another wearer, or reattach it, and sweep again: several placements "
                         "make the result more reliable. Or continue with Response."});
    }
    else
        lines.push_back({"Keep still during the sweep. It starts low and quiet and rises in pitch."});
    notes.show(std::move(lines));
    resized();
    repaint();
}

void SweepStep::tick()
{
    control.tick();
    feedMeters(meters, controller);
}

juce::Rectangle<int> SweepStep::playCard() const
{
    return getLocalBounds().withHeight(playHeight);
}

juce::Rectangle<int> SweepStep::listCard() const
{
    return getLocalBounds().withTrimmedTop(playHeight + grid);
}

void SweepStep::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    drawCard(g, playCard(), "Next placement", p);
    const auto inside = drawCard(g, listCard(), "Placements", p);
    if (!rows.empty())
        return;
    g.setColour(p.dim);
    g.setFont(usualFont());
    g.drawText(tr("None yet"), inside.withHeight(stepRow), juce::Justification::centredLeft, true);
}

void SweepStep::resized()
{
    auto area = insideOfCard(playCard());
    auto left = area.removeFromLeft(area.getWidth() / 2 - grid);
    area.removeFromLeft(2 * grid);
    name.setBounds(left.removeFromTop(stepRow));
    left.removeFromTop(grid);
    control.setBounds(left.removeFromTop(stepRow));
    left.removeFromTop(grid);
    for (auto& meter : meters)
        meter.setBounds(left.removeFromTop(20));
    notes.setBounds(area);
    auto inside = insideOfCard(listCard());
    scroll.setBounds(inside);
    list.setSize(inside.getWidth() - scroll.getScrollBarThickness(), static_cast<int>(rows.size()) * (stepRow + 2));
    auto lines = list.getLocalBounds();
    for (auto& row : rows)
    {
        auto line = lines.removeFromTop(stepRow);
        lines.removeFromTop(2);
        row->drop.setBounds(line.removeFromRight(9 * grid));
        row->name.setBounds(line);
    }
}

} // namespace pacini::editor
