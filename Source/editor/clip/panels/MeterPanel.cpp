// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/panels/MeterPanel.h"

#include "editor/Controls.h"
#include "editor/Theme.h"

#include <cmath>
#include <limits>

namespace pacini::editor
{

namespace
{
constexpr int rate = 30;            // Hz
constexpr int fallCalls = 5 * rate; // until all bars are down
constexpr double leastShown = 0.05; // dB
} // namespace

MeterPanel::MeterPanel(const Actuators& profiles, const Transport& playing, ClipPlayer& played)
    : actuators(profiles),
      transport(playing),
      player(played),
      output("Output", "Peak of the drive signal in dB; 0 dB is full drive",
             {.low = -60.0f, .high = 0.0f, .warnAbove = -0.1f}),
      reduction("Gain reduction", "Gain reduction by the actuator's protection, dB",
                {.low = 0.0f, .high = 24.0f, .from = 0.0f, .warnAbove = 6.0f}),
      felt("Above touch threshold", "Drive level above the touch threshold of the chosen actuator, dB",
           {.low = -20.0f, .high = 70.0f, .from = 0.0f, .sign = true})
{
    setTitle("Meters");
    setOpaque(true);
    addAll(*this, {&output, &reduction, &felt});
    felt.show(-std::numeric_limits<double>::infinity());
    subscriptions.on({&transport.changed, &actuators.changed}, [this] { follow(); });
    follow();
}

void MeterPanel::follow()
{
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
    const auto reading = player.takeMeters();
    const double level = 20.0 * std::log10(reading.peak);
    const auto profile = actuators.profile();
    output.show(level);
    reduction.show(reading.gainReduction > leastShown ? reading.gainReduction : -1.0);
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
    const int row = area.getHeight() / 3;
    output.setBounds(area.removeFromTop(row));
    reduction.setBounds(area.removeFromTop(row));
    felt.setBounds(area.removeFromTop(row));
}

} // namespace pacini::editor
