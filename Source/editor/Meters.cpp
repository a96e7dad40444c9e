// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/Meters.h"

#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr int labelHeight = 2 * grid;
constexpr int barHeight = grid;
} // namespace

LevelMeter::LevelMeter(const juce::String& name, const juce::String& help, Scale wanted)
    : title(name), scale(wanted), level(wanted.low), text(juce::String::fromUTF8("–"))
{
    setTitle(name);
    setDescription(help);
    setHelpText(help);
    setTooltip(help);
    setInterceptsMouseClicks(true, false);
}

int LevelMeter::pixelOf(float decibels) const noexcept
{
    const float share = (juce::jlimit(scale.low, scale.high, decibels) - scale.low) / (scale.high - scale.low);
    return static_cast<int>(std::lround(share * static_cast<float>(getWidth())));
}

void LevelMeter::show(double decibels)
{
    const auto heard = static_cast<float>(std::isfinite(decibels) ? decibels : static_cast<double>(scale.low) - 1.0);
    level = std::max({heard, level - scale.fall, scale.low - 1.0f});
    const bool silent = level < scale.low;
    const juce::String shown =
        silent ? juce::String::fromUTF8("–")
               : (scale.sign && level > 0.05f ? "+" : "") + numberText(static_cast<double>(level), 1) + " dB";
    const int to = pixelOf(level);
    if (to == pixel && shown == text)
        return;
    pixel = to;
    text = shown;
    repaint();
}

void LevelMeter::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    auto area = getLocalBounds();
    const auto labels = area.removeFromTop(labelHeight);
    g.setFont(smallFont());
    g.setColour(p.dim);
    g.drawText(tr(title), labels, juce::Justification::centredLeft, true);
    g.setColour(p.text);
    g.drawText(text, labels, juce::Justification::centredRight, false);
    const auto bar = area.removeFromTop(barHeight).toFloat();
    g.setColour(p.well);
    g.fillRoundedRectangle(bar, 3.0f);
    const auto from = static_cast<float>(pixelOf(scale.from));
    const auto to = static_cast<float>(pixelOf(level));
    if (level >= scale.low && std::abs(to - from) >= 1.0f)
    {
        g.setColour(level > scale.warnAbove ? p.warning : (level < scale.from ? p.dim : p.accent));
        g.fillRoundedRectangle({std::min(from, to), bar.getY(), std::abs(to - from), bar.getHeight()}, 3.0f);
    }
    if (scale.from > scale.low)
    {
        g.setColour(p.dim);
        g.fillRect(juce::Rectangle<float>(from - 0.5f, bar.getY() - 2.0f, 1.0f, bar.getHeight() + 4.0f));
    }
}

std::unique_ptr<juce::AccessibilityHandler> LevelMeter::createAccessibilityHandler()
{
    class Value final : public juce::AccessibilityTextValueInterface
    {
    public:
        explicit Value(const LevelMeter& shown) : meter(shown) {}
        bool isReadOnly() const override { return true; }
        juce::String getCurrentValueAsString() const override { return meter.text; }
        void setValueAsString(const juce::String&) override {}

    private:
        const LevelMeter& meter;
    };
    return std::make_unique<juce::AccessibilityHandler>(
        *this, juce::AccessibilityRole::staticText, juce::AccessibilityActions(),
        juce::AccessibilityHandler::Interfaces{std::make_unique<Value>(*this)});
}

EventLamp::EventLamp()
{
    setTitle("Events");
    setDescription("Lights up at every event in the sound");
}

void EventLamp::show(unsigned events, double level)
{
    const int before = glow;
    if (begun && events != counted)
        glow = 4 + static_cast<int>(std::lround(6.0 * std::clamp(level, 0.0, 1.0)));
    else if (glow > 0)
        --glow;
    counted = events;
    begun = true;
    if (glow != before)
        repaint();
}

void EventLamp::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    const auto lamp = getLocalBounds().toFloat().withSizeKeepingCentre(12.0f, 12.0f);
    g.setColour(p.well);
    g.fillEllipse(lamp);
    g.setColour(p.event.withAlpha(0.1f * static_cast<float>(glow)));
    g.fillEllipse(lamp);
    g.setColour(p.line);
    g.drawEllipse(lamp, 1.0f);
}

} // namespace pacini::editor
