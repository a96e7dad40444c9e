// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/measure/StepList.h"

#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

namespace pacini::editor
{

namespace
{
constexpr int rowHeight = 6 * grid;
constexpr int stepSpace = grid / 2;

const char* wordOf(MeasureStepState state)
{
    switch (state)
    {
    case MeasureStepState::locked:
        return "locked";
    case MeasureStepState::working:
        return "computing";
    case MeasureStepState::done:
        return "done";
    case MeasureStepState::failed:
        return "check";
    case MeasureStepState::open:
        break;
    }
    return "to do";
}
} // namespace

juce::String StepList::nameOf(MeasureStep step)
{
    static const std::array<const char*, measureSteps> names{"Set up",    "Sweep",  "Response",
                                                             "Equaliser", "Verify", "Save"};
    return tr(names[static_cast<std::size_t>(step)]);
}

StepList::StepList()
{
    setTitle("Steps");
    for (std::size_t i = 0; i < measureSteps; ++i)
    {
        buttons[i].onClick = [this, i]
        {
            if (onChoose)
                onChoose(static_cast<MeasureStep>(i));
        };
        addAndMakeVisible(buttons[i]);
    }
}

void StepList::show(MeasureStep current, const ActuatorMeasurement& work)
{
    for (std::size_t i = 0; i < measureSteps; ++i)
    {
        const auto step = static_cast<MeasureStep>(i);
        const auto state = work.state(step);
        buttons[i].setButtonText(nameOf(step));
        buttons[i].setTitle(
            tr("Step {0}, {1}, {2}", {juce::String(static_cast<int>(i) + 1), nameOf(step), tr(wordOf(state))}));
        buttons[i].setTooltip(translateMessage(toText(work.whyLocked(step))));
        buttons[i].setEnabled(state != MeasureStepState::locked);
        buttons[i].set(static_cast<int>(i) + 1, state, step == current);
    }
}

void StepList::resized()
{
    auto area = getLocalBounds();
    for (auto& button : buttons)
    {
        button.setBounds(area.removeFromTop(rowHeight));
        area.removeFromTop(stepSpace);
    }
}

void StepList::Row::set(int wantedNumber, MeasureStepState wanted, bool isCurrent)
{
    number = wantedNumber;
    state = wanted;
    current = isCurrent;
    repaint();
}

void StepList::Row::paintButton(juce::Graphics& g, bool over, bool)
{
    const Palette& p = paletteFor(*this);
    const auto area = getLocalBounds().toFloat();
    if (current || over)
    {
        g.setColour(current ? p.card : p.card.withAlpha(0.5f));
        g.fillRoundedRectangle(area, 6.0f);
    }
    if (current)
    {
        g.setColour(p.accent);
        g.fillRoundedRectangle(area.withWidth(3.0f), 1.5f);
    }
    drawFocusRing(g, *this, area);
    const auto disc = area.withWidth(static_cast<float>(rowHeight)).withSizeKeepingCentre(24.0f, 24.0f);
    const bool done = state == MeasureStepState::done, failed = state == MeasureStepState::failed;
    if (done || failed)
    {
        g.setColour(done ? p.accent : p.warning);
        g.fillEllipse(disc);
    }
    else
    {
        g.setColour(state == MeasureStepState::locked ? p.line : p.dim);
        g.drawEllipse(disc.reduced(0.75f), 1.5f);
    }
    g.setFont(smallFont());
    g.setColour(done || failed ? p.card : p.dim);
    if (done)
    {
        juce::Path tick;
        tick.startNewSubPath(disc.getX() + 7.0f, disc.getCentreY());
        tick.lineTo(disc.getX() + 10.5f, disc.getCentreY() + 4.0f);
        tick.lineTo(disc.getX() + 17.0f, disc.getCentreY() - 4.5f);
        g.strokePath(tick, juce::PathStrokeType(2.0f));
    }
    else
        g.drawText(failed ? juce::String("!") : juce::String(number), disc, juce::Justification::centred, false);
    auto words = getLocalBounds().withTrimmedLeft(rowHeight).reduced(0, 6);
    g.setColour(isEnabled() ? p.text : p.dim);
    g.setFont(usualFont());
    g.drawText(getButtonText(), words.removeFromTop(words.getHeight() / 2), juce::Justification::bottomLeft, true);
    g.setColour(failed ? p.warning : p.dim);
    g.setFont(smallFont());
    g.drawText(tr(wordOf(state)), words, juce::Justification::topLeft, true);
}

} // namespace pacini::editor
