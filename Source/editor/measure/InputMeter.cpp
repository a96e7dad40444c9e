// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/measure/InputMeter.h"

#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>
#include <cmath>

namespace pacini::editor
{

namespace
{
constexpr int nameWidth = 14 * grid;
constexpr int valueWidth = 7 * grid;
constexpr int lampWidth = 5 * grid;
constexpr float fall = 1.0f;  // dB for each call
constexpr int holdCalls = 60; // 2 s
constexpr float overload = 0.999f;
constexpr float close = -6.0f; // dB, from where on the bar warns
} // namespace

InputMeter::InputMeter()
{
    setTooltip(
        "Input level in dB re full scale, with a 2 s peak hold. The lamp stays lit after clipping; click to reset");
    reset();
}

void InputMeter::setName(const juce::String& wanted)
{
    juce::Component::setName(wanted);
    setTitle(tr("Level of {0}", {wanted}));
    repaint();
}

void InputMeter::reset()
{
    held = level;
    clipped = false;
    repaint();
}

juce::Rectangle<int> InputMeter::bar() const
{
    return getLocalBounds()
        .withTrimmedLeft(nameWidth)
        .withTrimmedRight(valueWidth + lampWidth)
        .withSizeKeepingCentre(std::max(1, getWidth() - nameWidth - valueWidth - lampWidth), grid);
}

int InputMeter::pixelOf(float decibels) const
{
    const float share = (std::clamp(decibels, least, 0.0f) - least) / -least;
    return bar().getX() + static_cast<int>(std::lround(share * static_cast<float>(bar().getWidth())));
}

void InputMeter::show(float peak)
{
    const int pixelBefore = pixelOf(level), heldBefore = pixelOf(held);
    const bool clippedBefore = clipped;
    const float heard = peak > 0.0f ? std::max(least, 20.0f * std::log10(std::min(peak, 10.0f))) : least;
    level = std::max(heard, level - fall);
    clipped = clipped || peak >= overload;
    if (heard >= held)
    {
        held = heard;
        holding = holdCalls;
    }
    else if (holding > 0)
        --holding;
    else
        held = std::max(level, held - fall);
    const juce::String now = held > least ? numberText(held, 1) + " dB" : toText("–");
    if (pixelOf(level) == pixelBefore && pixelOf(held) == heldBefore && clipped == clippedBefore && now == text)
        return;
    text = now;
    repaint();
}

void InputMeter::paint(juce::Graphics& g)
{
    const Palette& p = paletteFor(*this);
    g.setFont(smallFont());
    g.setColour(p.dim);
    g.drawText(getName(), getLocalBounds().withWidth(nameWidth - grid), juce::Justification::centredLeft, true);
    const auto area = bar();
    g.setColour(p.well);
    g.fillRoundedRectangle(area.toFloat(), 3.0f);
    if (level > least)
    {
        g.setColour(level > close ? p.warning : p.accent);
        g.fillRoundedRectangle(area.withRight(std::max(area.getX() + 2, pixelOf(level))).toFloat(), 3.0f);
    }
    if (held > least)
    {
        g.setColour(p.text);
        g.fillRect(pixelOf(held) - 1, area.getY() - 2, 2, area.getHeight() + 4);
    }
    auto right = getLocalBounds().removeFromRight(valueWidth + lampWidth);
    g.setColour(p.text);
    g.drawText(text, right.removeFromLeft(valueWidth), juce::Justification::centredRight, false);
    const auto lamp = right.reduced(grid / 2, 0).withSizeKeepingCentre(lampWidth - grid, 2 * grid).toFloat();
    g.setColour(clipped ? p.warning : p.well);
    g.fillRoundedRectangle(lamp, 3.0f);
    g.setColour(clipped ? p.card : p.dim);
    g.drawText(tr("CLIP"), lamp, juce::Justification::centred, false);
}

void nameMeters(InputMeters& meters, const MeasurementController& controller)
{
    const auto& wired = controller.wiring().inputs;
    for (std::size_t i = 0; i < meters.size(); ++i)
    {
        meters[i].setVisible(i < wired.size());
        if (i < wired.size())
            meters[i].setName(tr(toText(controller.ports().inputs[wired[i]])));
    }
}

void feedMeters(InputMeters& meters, MeasurementController& controller)
{
    for (std::size_t i = 0; i < controller.wiring().inputs.size(); ++i)
        meters[i].show(controller.takePeak(i));
}

std::unique_ptr<juce::AccessibilityHandler> InputMeter::createAccessibilityHandler()
{
    class Value final : public juce::AccessibilityTextValueInterface
    {
    public:
        explicit Value(const InputMeter& shown) : meter(shown) {}
        bool isReadOnly() const override { return true; }
        juce::String getCurrentValueAsString() const override
        {
            return meter.clipped ? tr("{0}, has clipped", {meter.text}) : meter.text;
        }
        void setValueAsString(const juce::String&) override {}

    private:
        const InputMeter& meter;
    };
    return std::make_unique<juce::AccessibilityHandler>(
        *this, juce::AccessibilityRole::staticText, juce::AccessibilityActions(),
        juce::AccessibilityHandler::Interfaces{std::make_unique<Value>(*this)});
}

} // namespace pacini::editor
