// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/StatusBar.h"

#include "editor/ActuatorItem.h"
#include "editor/Controls.h"
#include "editor/Icons.h"
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
    reconnectButton.setButtonText("Reconnect");
    reconnectButton.setTitle("Reconnect");
    prepareButton(reconnectButton, "Looks for an audio device again",
                  [this]
                  {
                      if (onReconnect)
                          onReconnect();
                  });
    addChildComponent(reconnectButton);
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
    done.shaped = done.shaped || session.model.document().steps().canUndo();
    setDescription(playsOn());
    reconnectButton.setVisible(!session.outputs.hasDevice() && onReconnect);
    resized();
    repaint();
}

juce::String StatusBar::playsOn() const
{
    const auto& outputs = session.outputs.outputs();
    if (!session.outputs.hasDevice())
        return tr(session.outputs.canPlay() ? "No audio device: only controllers and phones play"
                                            : "No audio device: nothing plays");
    const auto profile = session.actuators.profile();
    const juce::String what = profile ? actuatorText(*profile) : tr("no actuator");
    if (session.transport.heard() == Heard::sound)
        return tr("Plays the sound only");
    const auto number = [](std::size_t count)
    {
        return juce::String(static_cast<int>(count));
    };
    const std::size_t playing = session.outputs.playingCount();
    if (outputs.size() > 1 && playing < outputs.size())
        return tr("Plays on {0} of {1} outputs, {2}", {number(playing), number(outputs.size()), what});
    if (outputs.size() > 1)
        return tr("Plays on {0} outputs, {1}", {number(outputs.size()), what});
    const int channel = session.outputs.channelOf(0);
    if (channel < 0)
        return tr("Haptic output is off");
    const auto all = names ? names() : juce::StringArray();
    const juce::String where = channel < all.size() ? all[channel]
                               : all.isEmpty()      ? tr("output {0}", {juce::String(channel + 1)})
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
    if (reconnectButton.isVisible())
        area.removeFromRight(reconnectButton.getWidth() + grid);
    g.setColour(session.outputs.hasDevice() ? p.dim : p.warning);
    g.drawText(session.model.clip() && session.outputs.canPlay() ? playsOn() + toText("  ·  ") + tr("Space plays")
                                                                 : playsOn(),
               area, juce::Justification::centredRight, true);
    if (done.all())
        return;
    const std::array<std::pair<bool, juce::String>, 3> steps{
        {{done.chosen, tr("Choose a sound")}, {done.shaped, tr("Shape it")}, {done.exported, tr("Export it")}}};
    bool next = true;
    for (std::size_t i = 0; i < steps.size(); ++i)
    {
        const auto& [isDone, text] = steps[i];
        const juce::String words = juce::String(static_cast<int>(i) + 1) + " " + text;
        // The step that comes next stands out, by weight and not by colour alone.
        const bool now = next && !isDone;
        next = next && isDone;
        g.setFont(now ? smallFont().boldened() : smallFont());
        g.setColour(now ? p.text : p.dim);
        if (isDone)
            drawIcon(g, Icon::tick, area.removeFromLeft(12).toFloat());
        const juce::String& shown = isDone ? text : words;
        area.removeFromLeft(isDone ? 4 : 0);
        const int width = g.getCurrentFont().getStringWidth(shown) + 3 * grid;
        g.drawText(shown, area.removeFromLeft(width), juce::Justification::centredLeft, true);
    }
}

void StatusBar::resized()
{
    reconnectButton.setBounds(getLocalBounds().reduced(12, 2).removeFromRight(13 * grid));
}

} // namespace pacini::editor
