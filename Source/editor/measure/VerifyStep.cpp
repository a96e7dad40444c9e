// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/measure/VerifyStep.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Translation.h"
#include "editor/measure/ResponseStep.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{
constexpr int meterRow = 20;
}

VerifyStep::VerifyStep(MeasurementController& wanted, StepServices& around)
    : control(wanted, true),
      controller(wanted),
      services(around),
      tolerance("Tolerance", "Max. deviation from the mean to pass, ± dB"),
      saveSweep(toText("Save sweep…")),
      openRecording(toText("Open…")),
      again("Start over")
{
    prepareSlider(tolerance.control, 0.5, 6.0, 0.1, "dB", 1);
    tolerance.control.onValueChange = [this]
    {
        controller.setTolerance(tolerance.control.getValue());
    };
    saveSweep.setTitle("Save the equalised sweep");
    prepareButton(saveSweep, "Saves the equalised sweep as a sound file for another player",
                  [this] { services.saveSweep(true); });
    openRecording.setTitle("Open a recording of the equalised sweep");
    prepareButton(openRecording, "Opens an equalised sweep recorded elsewhere",
                  [this]
                  {
                      services.askForFile("Open a recording of the equalised sweep", "*.wav;*.flac", false, {},
                                          [this](const juce::File& file)
                                          { controller.readRecording(pathOf(file), true); });
                  });
    again.setTitle("Start verification over");
    prepareButton(again, "Removes all equalised sweeps", [this] { controller.dropVerifications(); });
    addAll(*this, {&control, &meters[0], &meters[1], &meters[2], &tolerance, &saveSweep, &openRecording, &again, &facts,
                   &notes, &plot});
    refresh();
}

void VerifyStep::refresh()
{
    const ActuatorMeasurement& work = controller.measurement();
    control.refresh();
    nameMeters(meters, controller);
    tolerance.control.setValue(work.tolerance(), juce::dontSendNotification);
    const bool free = controller.activity() == MeasurementController::Activity::none && work.equalizer() != nullptr;
    saveSweep.setEnabled(free);
    openRecording.setEnabled(free);
    again.setEnabled(free && !work.verifications().empty());

    ResponsePlot::Content curves;
    curves.axisName = levelUnit(work);
    curves.empty = tr("No equaliser yet");
    std::vector<Note> lines;
    FactTable::Facts list;
    if (!controller.verifyProblem().empty())
        lines.push_back({controller.verifyProblem(), Note::Kind::warning});
    else if (!work.problem(MeasureStep::verify).empty())
        lines.push_back({work.problem(MeasureStep::verify), Note::Kind::warning});
    const MeasuredResponse* response = work.response();
    const FittedEqualizer* fitted = work.equalizer();
    if (response != nullptr && fitted != nullptr)
    {
        curves.curves.push_back({tr("before"), response->average.response, ResponsePlot::Role::before});
        curves.range = std::pair(fitted->lowFrequency, fitted->highFrequency);
        if (const VerifiedResponse* verified = work.verified())
        {
            const Linearity& after = verified->linearity;
            if (work.verifications().size() > 1)
                for (const auto& one : work.verifications())
                    curves.curves.push_back({tr("sweeps"), one->measurement.response(), ResponsePlot::Role::single});
            curves.curves.push_back({tr("equalised"), verified->after, ResponsePlot::Role::result});
            curves.band = std::pair(after.level - after.tolerance, after.level + after.tolerance);
            list = {{tr("Mean deviation"), numberText(after.meanDeviation, 2) + " dB"},
                    {tr("before"), numberText(verified->before.meanDeviation, 2) + " dB"},
                    {tr("Worst"), worstText(after)},
                    {tr("before"), worstText(verified->before)},
                    {tr("Sweeps"), juce::String(static_cast<int>(work.verifications().size()))},
                    {tr("Level"), numberText(work.verifications().back()->level, 1) + " dB"}};
            for (const LinearityOutlier& outlier : after.outliers)
                lines.push_back({tr("Off by up to {0} dB from {1} to {2} Hz.",
                                    {numberText(outlier.deviation, 1), numberText(outlier.lowFrequency, 0),
                                     numberText(outlier.highFrequency, 0)})
                                     .toStdString(),
                                 Note::Kind::warning});
            for (const std::string& note : verified->notes)
                lines.push_back({note, Note::Kind::warning});
        }
        else if (lines.empty())
            lines.push_back({"Sweep again with the equaliser to measure its real effect. If it would exceed full "
                             "scale, the sweep is lowered accordingly."});
    }
    facts.show(std::move(list));
    notes.show(std::move(lines));
    plot.show(std::move(curves));
    resized();
    repaint();
}

void VerifyStep::tick()
{
    control.tick();
    feedMeters(meters, controller);
}

juce::Rectangle<int> VerifyStep::verdictArea() const
{
    const int further = std::max(0, static_cast<int>(controller.wiring().inputs.size()) - 1);
    return insideOfCard(getLocalBounds().removeFromLeft(stepSide))
        .withTrimmedTop(19 * grid + further * meterRow)
        .withHeight(4 * grid);
}

void VerifyStep::paint(juce::Graphics& g)
{
    drawSideAndPlot(g, *this, "Verification");
    if (const VerifiedResponse* verified = controller.measurement().verified())
    {
        const Palette& p = paletteFor(*this);
        const bool passed = verified->linearity.passed();
        const auto place = verdictArea().toFloat();
        g.setColour((passed ? p.accent : p.warning).withAlpha(0.2f));
        g.fillRoundedRectangle(place, 4.0f);
        g.setColour(passed ? p.accent : p.warning);
        g.drawRoundedRectangle(place.reduced(0.5f), 4.0f, 1.0f);
        g.setColour(p.text);
        g.setFont(usualFont());
        g.drawText(tr(toText(passed ? "Passed: flat within ±{0} dB" : "Failed: not flat within ±{0} dB"),
                      {numberText(verified->linearity.tolerance, 1)}),
                   place, juce::Justification::centred, true);
    }
}

void VerifyStep::resized()
{
    auto area = getLocalBounds();
    auto side = insideOfCard(area.removeFromLeft(stepSide));
    control.setBounds(side.removeFromTop(stepRow + stepGap + 3 * grid));
    side.removeFromTop(stepGap);
    for (auto& meter : meters)
        if (meter.isVisible())
            meter.setBounds(side.removeFromTop(meterRow));
    side.removeFromTop(stepGap);
    tolerance.setBounds(side.removeFromTop(stepRow));
    side.setTop(verdictArea().getBottom() + grid);
    facts.setBounds(side.removeFromTop(facts.wantedHeight()));
    again.setBounds(side.removeFromBottom(stepRow));
    side.removeFromBottom(stepGap);
    auto row = side.removeFromBottom(stepRow);
    saveSweep.setBounds(row.removeFromLeft((row.getWidth() - grid) / 2));
    row.removeFromLeft(grid);
    openRecording.setBounds(row);
    side.removeFromBottom(grid / 2);
    notes.setBounds(side.expanded(grid, 0));
    area.removeFromLeft(grid);
    plot.setBounds(area.reduced(grid, grid));
}

} // namespace pacini::editor
