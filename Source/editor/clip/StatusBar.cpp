// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/StatusBar.h"

#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <array>
#include <utility>

namespace pacini::editor
{

StatusBar::StatusBar(Session& shared, std::function<juce::StringArray()> outputNames)
    : session(shared), names(std::move(outputNames))
{
    setTitle("Status");
    subscriptions.on({&session.model.contentChanged, &session.model.projectChanged, &session.transport.changed,
                      &session.actuators.changed, &session.actuators.listChanged, &session.actuators.usualChanged,
                      &session.outputs.changed},
                     [this] { follow(); });
    follow();
}

void StatusBar::setSteps(const FirstSteps& wanted)
{
    done = wanted;
    follow();
}

void StatusBar::setExported()
{
    done.exported = true;
    repaint();
}

void StatusBar::follow()
{
    done.chosen = done.chosen || session.model.clip() != nullptr;
    done.shaped = done.shaped || session.model.document().canUndo();
    setDescription(playsOn());
    repaint();
}

juce::String StatusBar::playsOn() const
{
    const auto& outputs = session.outputs.outputs();
    const auto profile = session.actuators.profile();
    const juce::String what = profile ? toText(profile->name) : tr("no actuator");
    if (session.transport.heard() == Heard::sound)
        return tr("Plays the sound only");
    if (outputs.size() > 1)
        return tr("Plays on {0} outputs, {1}", {juce::String(static_cast<int>(outputs.size())), what});
    const int channel = outputs.front().channel;
    if (channel < 0)
        return tr("Haptic output is off");
    const auto all = names ? names() : juce::StringArray();
    const juce::String where = all.isEmpty()          ? tr("output {0}", {juce::String(channel + 1)})
                               : channel < all.size() ? all[channel]
                                                      : all[all.size() - 1];
    return profile ? tr("Plays on {0}, {1}", {what, where}) : tr("Plays on {0}, {1}", {where, what});
}

void StatusBar::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.fillAll(p.card);
    g.setColour(p.line);
    g.fillRect(getLocalBounds().removeFromTop(1));
    auto area = getLocalBounds().reduced(12, 0);
    g.setFont(smallFont());
    g.setColour(p.dim);
    g.drawText(session.model.clip() ? playsOn() + toText("  ·  ") + tr("Space plays") : playsOn(), area,
               juce::Justification::centredRight, true);
    if (done.all())
        return;
    const std::array<std::pair<bool, juce::String>, 3> steps{
        {{done.chosen, tr("Choose a sound")}, {done.shaped, tr("Shape it")}, {done.exported, tr("Export it")}}};
    bool next = true;
    for (std::size_t i = 0; i < steps.size(); ++i)
    {
        const auto& [isDone, text] = steps[i];
        const juce::String words = (isDone ? toText("✓ ") : juce::String(static_cast<int>(i) + 1) + " ") + text;
        // The step that comes next stands out, by weight and not by colour alone.
        const bool now = next && !isDone;
        next = next && isDone;
        g.setFont(now ? smallFont().boldened() : smallFont());
        g.setColour(now ? p.text : p.dim);
        const int width = g.getCurrentFont().getStringWidth(words) + 3 * grid;
        g.drawText(words, area.removeFromLeft(width), juce::Justification::centredLeft, true);
    }
}

} // namespace pacini::editor
