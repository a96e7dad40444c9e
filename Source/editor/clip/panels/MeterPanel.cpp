// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/panels/MeterPanel.h"

#include "editor/Controls.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <pacini/foundation/Units.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pacini::editor
{

namespace
{
constexpr int rate = 30;            // Hz
constexpr int fallCalls = 5 * rate; // until all bars are down
constexpr double leastShown = 0.05; // dB
constexpr int meterHeight = 30;
} // namespace

MeterPanel::MeterPanel(const Actuators& profiles, const HapticOutputs& hapticOutputs, const Transport& playing,
                       ClipPlayer& played)
    : actuators(profiles),
      outputs(hapticOutputs),
      transport(playing),
      player(played),
      reduction("Gain reduction", "Gain reduction by the actuator's protection, dB",
                {.low = 0.0f, .high = 24.0f, .from = 0.0f, .warnAbove = 6.0f}),
      felt("Above touch threshold", "Drive level above the touch threshold of the chosen actuator, dB",
           {.low = -20.0f, .high = 70.0f, .from = 0.0f, .sign = true})
{
    setTitle("Meters");
    setOpaque(true);
    addAll(*this, {&reduction, &felt});
    makeLevels();
    felt.show(-std::numeric_limits<double>::infinity());
    subscriptions.on({&transport.changed, &actuators.changed}, [this] { follow(); });
    subscriptions.on({&outputs.changed},
                     [this]
                     {
                         makeLevels();
                         follow();
                     });
    follow();
}

int MeterPanel::wantedHeight() const noexcept
{
    return (static_cast<int>(levels.size()) + 2) * meterHeight + 12;
}

void MeterPanel::makeLevels()
{
    const std::size_t wanted = outputs.outputs().size();
    if (levels.size() == wanted)
        return;
    levels.clear();
    for (std::size_t i = 0; i < wanted; ++i)
    {
        const juce::String name =
            wanted == 1 ? tr("Output") : tr("Output") + " " + juce::String(static_cast<int>(i) + 1);
        levels.push_back(
            std::make_unique<LevelMeter>(name, tr("Peak of the drive signal in dB; 0 dB is full drive"),
                                         LevelMeter::Scale{.low = -60.0f, .high = 0.0f, .warnAbove = -0.1f}));
        addAndMakeVisible(*levels.back());
    }
    resized();
}

void MeterPanel::follow()
{
    for (std::size_t i = 0; i < levels.size(); ++i)
    {
        // One that plays nowhere looks so.
        const bool plays = outputs.channelOf(i) >= 0;
        levels[i]->setEnabled(plays);
        levels[i]->setAlpha(plays ? 1.0f : 0.45f);
    }
    felt.setEnabled(actuators.profile() != nullptr);
    felt.setAlpha(felt.isEnabled() ? 1.0f : 0.45f);
    if (transport.isPlaying() && !isTimerRunning())
    {
        quiet = 0;
        startTimerHz(rate);
    }
}

void MeterPanel::timerCallback()
{
    double most = 0.0, taken = 0.0;
    for (std::size_t i = 0; i < levels.size(); ++i)
    {
        const auto reading = player.takeMeters(i);
        // What is behind the protection is turned down by the gain of its output.
        const double gain = outputs.outputs()[i].gain;
        if (outputs.hasDevice() && outputs.channelOf(i) < 0)
        {
            levels[i]->show(-std::numeric_limits<double>::infinity());
            continue;
        }
        levels[i]->show(gain <= HapticOutputs::leastGain ? -std::numeric_limits<double>::infinity()
                                                         : Decibels::fromGain(reading.peak).value + gain);
        most = std::max(most, reading.peak);
        taken = std::max(taken, reading.gainReduction);
    }
    const double level = Decibels::fromGain(most).value;
    const auto profile = actuators.profile();
    reduction.show(taken > leastShown ? taken : -1.0);
    felt.show(profile ? level + profile->range.dynamicRange : -std::numeric_limits<double>::infinity());
    quiet = transport.isPlaying() ? 0 : quiet + 1;
    if (quiet > fallCalls)
        stopTimer();
}

void MeterPanel::paint(juce::Graphics& g)
{
    g.fillAll(paletteFor(*this).card);
    g.setColour(paletteFor(*this).line);
    g.fillRect(getLocalBounds().removeFromTop(1));
}

void MeterPanel::resized()
{
    auto area = getLocalBounds().reduced(12, 6);
    const int row = area.getHeight() / (static_cast<int>(levels.size()) + 2);
    for (const auto& level : levels)
        level->setBounds(area.removeFromTop(row));
    reduction.setBounds(area.removeFromTop(row));
    felt.setBounds(area.removeFromTop(row));
}

} // namespace pacini::editor
