// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/measure/ResponseStep.h"

#include "editor/Controls.h"
#include "editor/Text.h"

#include <algorithm>

namespace pacini::editor
{

juce::String levelUnit(const ActuatorMeasurement& work)
{
    return work.settings().calibrated ? toText("dB re 1 m/s² at full drive") : juce::String("dB, relative");
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
    harmonics.axisName = "distortion";
    curves.axisName = levelUnit(work);
    curves.empty = toText(work.problem(MeasureStep::response));
    if (curves.empty.isEmpty())
        curves.empty = "The response is being computed" + toText("…");
    std::vector<Note> lines;
    if (const MeasuredResponse* response = work.response())
    {
        const auto& placements = work.placements();
        const ResponseFeatures& features = response->findings.features;
        const bool several = placements.size() > 1;
        const SweepMeasurement& measured = placements.front()->measurement;
        const LevelMeasurement& level = measured.levels[measured.main];
        curves.curves.push_back({"noise", level.noise, ResponsePlot::Role::noise});
        for (std::size_t i = 0; several && i < placements.size(); ++i)
        {
            const bool out = response->findings.outliers.contains(i);
            curves.curves.push_back({out ? "left out" : "placements", placements[i]->measurement.response(),
                                     out ? ResponsePlot::Role::leftOut : ResponsePlot::Role::single});
        }
        curves.curves.push_back({several ? "average" : "response", response->average.response});
        curves.range = std::pair(features.felt.low, features.felt.high);
        curves.marker = features.resonance.frequency;
        harmonics.curves.push_back({"all harmonics", {level.response.frequency, level.distortion}});
        harmonics.range = curves.range;

        FactTable::Facts list{
            {"Placements",
             juce::String(static_cast<int>(placements.size() - response->findings.outliers.size())) +
                 (response->findings.outliers.empty() ? juce::String()
                                                      : " of " + juce::String(static_cast<int>(placements.size())))},
            {"Resonance", numberText(features.resonance.frequency, 1) + " Hz"},
            {"Q", numberText(features.resonance.q, 2)},
            {"Usable range", numberText(features.felt.low, 0) + " to " + numberText(features.felt.high, 0) + " Hz"},
            {"Even within 3 dB", features.even.high > features.even.low ? numberText(features.even.low, 0) + " to " +
                                                                              numberText(features.even.high, 0) + " Hz"
                                                                        : juce::String("nowhere")},
            {"Plateau", numberText(features.plateau, 1) + " dB"}};
        if (response->findings.times)
            list.push_back({"Rise and fall", numberText(1e3 * response->findings.times->riseTime, 0) + " and " +
                                                 numberText(1e3 * response->findings.times->fallTime, 0) + " ms"});
        list.push_back({"Distortion", "at most " + numberText(response->findings.distortion, 1) + " %"});
        if (const auto& drift = measured.driftPpm)
            list.push_back({"Clocks", signedText(*drift, 1) + " ppm"});
        list.push_back({"Latency", numberText(1e3 * measured.latency, 1) + " ms"});
        facts.show(std::move(list));
        for (const std::string& note : response->notes)
            lines.push_back({note, Note::Kind::warning});
        if (lines.empty())
            lines.push_back({"Nothing stands out. The usable range reaches from 20 dB below the strongest frequency "
                             "up to there again."});
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
