// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/measure/ResponseStep.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Translation.h"

#include <algorithm>

namespace pacini::editor
{

juce::String levelUnit(const ActuatorMeasurement& work)
{
    return work.settings().calibrated ? tr(toText("dB re 1 m/s² at full drive")) : tr("dB, relative");
}

ResponseStep::ResponseStep(MeasurementController& wanted) : controller(wanted)
{
    addAll(*this, {&facts, &notes, &plot, &distortion});
    refresh();
}

void ResponseStep::refresh()
{
    const ActuatorMeasurement& work = controller.measurement();
    ResponsePlot::Content curves, harmonics;
    harmonics.unit = ResponsePlot::Unit::percent;
    harmonics.axisName = tr("distortion");
    curves.axisName = levelUnit(work);
    curves.empty = translateMessage(toText(work.problem(MeasureStep::response)));
    if (curves.empty.isEmpty())
        curves.empty = tr(toText("Computing the response…"));
    std::vector<Note> lines;
    if (const MeasuredResponse* response = work.response())
    {
        const auto& placements = work.placements();
        const ResponseFeatures& features = response->findings.features;
        const bool several = placements.size() > 1;
        const SweepMeasurement& measured = placements.front()->measurement;
        const LevelMeasurement& level = measured.levels[measured.main];
        curves.curves.push_back({tr("noise"), level.noise, ResponsePlot::Role::noise});
        for (std::size_t i = 0; several && i < placements.size(); ++i)
        {
            const bool out = response->findings.outliers.contains(i);
            curves.curves.push_back({tr(out ? "left out" : "placements"), placements[i]->measurement.response(),
                                     out ? ResponsePlot::Role::leftOut : ResponsePlot::Role::single});
        }
        curves.curves.push_back({tr(several ? "average" : "response"), response->average.response});
        curves.range = std::pair(features.felt.low, features.felt.high);
        curves.marker = features.resonance.frequency;
        harmonics.curves.push_back({tr("all harmonics"), {level.response.frequency, level.distortion}});
        harmonics.range = curves.range;

        FactTable::Facts list{
            {tr("Placements"),
             tr(response->findings.outliers.empty() ? "{0}" : "{0} of {1}",
                {juce::String(static_cast<int>(placements.size() - response->findings.outliers.size())),
                 juce::String(static_cast<int>(placements.size()))})},
            {tr("Resonance"), numberText(features.resonance.frequency, 1) + " Hz"},
            {"Q", numberText(features.resonance.q, 2)},
            {tr("Usable range"),
             tr("{0} to {1} Hz", {numberText(features.felt.low, 0), numberText(features.felt.high, 0)})},
            {tr("Flat within 3 dB"),
             features.even.high > features.even.low
                 ? tr("{0} to {1} Hz", {numberText(features.even.low, 0), numberText(features.even.high, 0)})
                 : tr("none")},
            {tr("Plateau"), numberText(features.plateau, 1) + " dB"}};
        if (response->findings.times)
            list.push_back(
                {tr("Rise and fall"), tr("{0} and {1} ms", {numberText(1e3 * response->findings.times->riseTime, 0),
                                                            numberText(1e3 * response->findings.times->fallTime, 0)})});
        list.push_back({tr("Distortion"), tr("at most {0} %", {numberText(response->findings.distortion, 1)})});
        if (const auto& drift = measured.driftPpm)
            list.push_back({tr("Clock drift"), signedText(*drift, 1) + " ppm"});
        list.push_back({tr("Latency"), numberText(1e3 * measured.latency, 1) + " ms"});
        facts.show(std::move(list));
        for (const std::string& note : response->notes)
            lines.push_back({note, Note::Kind::warning});
        if (lines.empty())
            lines.push_back({"No problems found. The usable range is where the response is within 20 dB of its peak."});
    }
    else
    {
        facts.show({});
        if (!work.problem(MeasureStep::response).empty())
            lines.push_back({work.problem(MeasureStep::response), Note::Kind::warning});
    }
    notes.show(std::move(lines));
    plot.show(std::move(curves));
    distortion.show(std::move(harmonics));
    resized();
}

void ResponseStep::paint(juce::Graphics& g)
{
    drawSideAndPlot(g, *this, "Actuator");
}

void ResponseStep::resized()
{
    auto area = getLocalBounds();
    auto side = insideOfCard(area.removeFromLeft(stepSide));
    facts.setBounds(side.removeFromTop(facts.wantedHeight()));
    side.removeFromTop(grid);
    notes.setBounds(side.expanded(grid, 0));
    area.removeFromLeft(grid);
    area.reduce(grid, grid);
    distortion.setBounds(area.removeFromBottom(std::max(15 * grid, area.getHeight() / 4)));
    area.removeFromBottom(grid / 2);
    plot.setBounds(area);
}

} // namespace pacini::editor
