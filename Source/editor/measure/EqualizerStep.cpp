// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/measure/EqualizerStep.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Translation.h"
#include "editor/measure/ResponseStep.h"

#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr int automatic = 100; // of the menu; the others are numbers of sections
constexpr int maxSections = 8;

const char* nameOf(EqualizerType type)
{
    switch (type)
    {
    case EqualizerType::peak:
        return "Peak";
    case EqualizerType::lowShelf:
        return "Low shelf";
    case EqualizerType::highShelf:
        return "High shelf";
    case EqualizerType::highpass:
        break;
    }
    return "High-pass";
}
} // namespace

EqualizerStep::EqualizerStep(MeasurementController& wanted)
    : sections("Sections", "Max. number of equaliser sections; automatic: as few as needed to be flat within 1 dB"),
      boost("Max. boost", "Max. boost of any frequency, dB; the rest is lowered instead"),
      low("Flat from", "Start of the flattened range, Hz"),
      high("Flat to", "End of the flattened range, Hz"),
      controller(wanted)
{
    sections.control.addItem("Automatic", automatic);
    for (int i = 1; i <= maxSections; ++i)
        sections.control.addItem(juce::String(i), i);
    prepareSlider(boost.control, 0.0, 24.0, 0.5, "dB", 1);
    prepareSlider(low.control, 5.0, 400.0, 1.0, "Hz", 0);
    prepareSlider(high.control, 100.0, 2000.0, 1.0, "Hz", 0);
    low.control.setSkewFactorFromMidPoint(50.0);
    high.control.setSkewFactorFromMidPoint(500.0);
    const auto take = [this]
    {
        takeWish();
    };
    sections.control.onChange = take;
    for (auto* one : {&boost, &low, &high})
        one->control.onValueChange = take;
    scroll.setViewedComponent(&table, false);
    scroll.setScrollBarsShown(true, false);
    addAll(*this, {&sections, &boost, &low, &high, &facts, &scroll, &notes, &plot});
    refresh();
}

void EqualizerStep::takeWish()
{
    EqualizerRequest request = controller.measurement().request();
    const int chosen = sections.control.getSelectedId();
    request.sections = chosen == automatic ? std::nullopt : std::optional(chosen);
    request.maxBoost = boost.control.getValue();
    // The ends follow what is measured until they are moved.
    if (const MeasuredResponse* response = controller.measurement().response())
    {
        const FrequencyRange& felt = response->findings.features.felt;
        if (request.lowFrequency > 0.0 || std::abs(low.control.getValue() - std::round(felt.low)) > 0.5)
            request.lowFrequency = low.control.getValue();
        if (request.highFrequency > 0.0 || std::abs(high.control.getValue() - std::round(felt.high)) > 0.5)
            request.highFrequency = high.control.getValue();
    }
    controller.setRequest(request);
}

void EqualizerStep::refresh()
{
    const ActuatorMeasurement& work = controller.measurement();
    const EqualizerRequest& request = work.request();
    const auto quietly = juce::dontSendNotification;
    sections.control.setSelectedId(request.sections.value_or(automatic), quietly);
    boost.control.setValue(request.maxBoost, quietly);
    const bool free = !controller.isPlaying();
    for (juce::Component* one : std::initializer_list<juce::Component*>{&sections, &boost, &low, &high})
        one->setEnabled(free && work.response() != nullptr);
    const MeasuredResponse* response = work.response();
    if (response == nullptr)
    {
        ResponsePlot::Content nothing;
        nothing.empty = tr("No response yet");
        plot.show(std::move(nothing));
        return;
    }
    const FrequencyRange& felt = response->findings.features.felt;
    low.control.setValue(request.lowFrequency > 0.0 ? request.lowFrequency : std::round(felt.low), quietly);
    high.control.setValue(request.highFrequency > 0.0 ? request.highFrequency : std::round(felt.high), quietly);

    std::vector<Note> lines;
    const FittedEqualizer* fitted = work.equalizer();
    if (fitted == nullptr)
    {
        const std::string problem = work.problem(MeasureStep::equalizer);
        if (!problem.empty())
        {
            lines.push_back({problem, Note::Kind::warning});
            facts.show({});
            table.show({});
        }
        notes.show(std::move(lines));
        return; // what was shown stays until the next one is there
    }
    ResponsePlot::Content curves;
    curves.axisName = levelUnit(work);
    curves.curves = {{tr("measured"), response->average.response, ResponsePlot::Role::before},
                     {tr("equalised"), fitted->predicted, ResponsePlot::Role::result}};
    curves.range = std::pair(fitted->lowFrequency, fitted->highFrequency);
    curves.band = std::pair(fitted->predictedLinearity.level - 1.0, fitted->predictedLinearity.level + 1.0);
    plot.show(std::move(curves));

    FactTable::Facts list;
    for (const EqualizerSection& section : fitted->fit.sections)
        list.push_back({tr(nameOf(section.type)), numberText(section.frequency, section.frequency < 100.0 ? 1 : 0) +
                                                      " Hz  " + signedText(section.gain, 1) + " dB  Q " +
                                                      numberText(section.q, 2)});
    table.show(std::move(list));
    const Linearity& linearity = fitted->predictedLinearity;
    FactTable::Facts effects{{tr("Mean deviation"), numberText(linearity.meanDeviation, 2) + " dB"},
                             {tr("Worst"), worstText(linearity)},
                             {tr("Coil power"), signedText(fitted->cost.powerChange, 1) + " dB"}};
    if (fitted->cost.power)
        effects.push_back({tr("At full drive"), numberText(*fitted->cost.power, 2) + " W"});
    effects.push_back({tr("Max. travel"), tr("{0} dB at {1} Hz", {signedText(fitted->cost.excursionChange, 1),
                                                                  numberText(fitted->cost.excursionFrequency, 0)})});
    if (fitted->cost.excursion)
        effects.push_back({tr("Of the limit"), numberText(100.0 * *fitted->cost.excursion, 0) + " %"});
    facts.show(std::move(effects));
    if (std::abs(linearity.worstDeviation) > 1.0)
        lines.push_back({"Not flat within 1 dB: allow more sections or more boost, or flatten a smaller range.",
                         Note::Kind::warning});
    const auto& drive = work.base().drive;
    if (fitted->cost.power && drive.maxPower && *fitted->cost.power > *drive.maxPower)
        lines.push_back({tr("At full drive the coil exceeds its {0} W continuous rating; the protection will reduce "
                            "it. Use less boost.",
                            {numberText(*drive.maxPower, 2)})
                             .toStdString(),
                         Note::Kind::warning});
    notes.show(std::move(lines));
    resized();
}

void EqualizerStep::paint(juce::Graphics& g)
{
    drawSideAndPlot(g, *this, "Equaliser");
}

void EqualizerStep::resized()
{
    auto area = getLocalBounds();
    auto side = insideOfCard(area.removeFromLeft(stepSide));
    for (juce::Component* one : std::initializer_list<juce::Component*>{&sections, &boost, &low, &high})
    {
        one->setBounds(side.removeFromTop(stepRow));
        side.removeFromTop(stepGap);
    }
    side.removeFromTop(grid / 2);
    facts.setBounds(side.removeFromTop(facts.wantedHeight()));
    side.removeFromTop(grid / 2);
    if (!notes.shown().empty())
        notes.setBounds(side.removeFromBottom(8 * grid).expanded(grid, 0));
    else
        notes.setBounds({});
    scroll.setBounds(side);
    const bool scrolls = table.wantedHeight() > side.getHeight();
    table.setSize(side.getWidth() - (scrolls ? scroll.getScrollBarThickness() : 0), table.wantedHeight());
    area.removeFromLeft(grid);
    plot.setBounds(area.reduced(grid, grid));
}

} // namespace pacini::editor
