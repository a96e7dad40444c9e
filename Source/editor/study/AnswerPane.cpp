// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/study/AnswerPane.h"

#include "editor/Controls.h"
#include "editor/Text.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace pacini::editor
{

juce::Font participantFont()
{
    return usualFont().withHeight(20.0f);
}

juce::Font participantTitleFont()
{
    return titleFont().withHeight(26.0f);
}

void LargeButton::setLit(bool isLit)
{
    if (std::exchange(lit, isLit) != isLit)
        repaint();
}

void LargeButton::paintButton(juce::Graphics& g, bool over, bool down)
{
    const Palette& palette = paletteFor(*this);
    const auto area = getLocalBounds().toFloat().reduced(1.5f);
    g.setColour(lit ? palette.accent : down ? palette.well : over ? palette.line : palette.card);
    g.fillRoundedRectangle(area, 6.0f);
    g.setColour(isEnabled() ? palette.accent : palette.line);
    g.drawRoundedRectangle(area, 6.0f, 1.5f);
    g.setColour(lit ? palette.background : isEnabled() ? palette.text : palette.dim);
    g.setFont(participantFont());
    g.drawFittedText(getButtonText(), getLocalBounds().reduced(8, 2), juce::Justification::centred, 2, 0.8f);
    if (hasKeyboardFocus(true))
        drawFocusRing(g, *this, area);
}

void Paragraph::setText(const juce::String& wanted)
{
    if (std::exchange(content, wanted) == wanted)
        return;
    setTitle(content);
    repaint();
}

juce::TextLayout Paragraph::layoutFor(int width, juce::Colour colour) const
{
    juce::AttributedString styled;
    styled.append(content, font, colour);
    styled.setLineSpacing(4.0f);
    juce::TextLayout layout;
    layout.createLayout(styled, static_cast<float>(width));
    return layout;
}

int Paragraph::heightFor(int width) const
{
    return content.isEmpty() ? 0 : static_cast<int>(std::ceil(layoutFor(width, {}).getHeight())) + grid;
}

void Paragraph::paint(juce::Graphics& g)
{
    layoutFor(getWidth(), paletteFor(*this).text).draw(g, getLocalBounds().toFloat());
}

std::unique_ptr<juce::AccessibilityHandler> Paragraph::createAccessibilityHandler()
{
    return std::make_unique<juce::AccessibilityHandler>(*this, juce::AccessibilityRole::staticText);
}

namespace
{
/// A scale with labels at its ends.
class ScaleSlider final : public Slider
{
public:
    ScaleSlider(const study::RatingScale& scale, const juce::String& language)
        : Slider(juce::Slider::LinearHorizontal, juce::Slider::NoTextBox),
          low(toText(study::inLanguage(scale.lowLabel, language.toStdString()))),
          high(toText(study::inLanguage(scale.highLabel, language.toStdString())))
    {
        const double range = scale.high - scale.low;
        setRange(scale.low, scale.high, scale.step > 0.0 ? scale.step : range / 1000.0);
        setValue(0.5 * (scale.low + scale.high), juce::dontSendNotification);
        setTitle(tr("Rating"));
        setWantsKeyboardFocus(true);
        setColour(juce::Slider::backgroundColourId, juce::Colours::transparentBlack);
    }

    bool given = false; ///< the participant has set it

    void paint(juce::Graphics& g) override
    {
        const Palette& palette = paletteFor(*this);
        auto area = getLocalBounds().toFloat();
        auto labels = area.removeFromBottom(28.0f);
        const float middle = area.getCentreY();
        const auto left = static_cast<float>(getPositionOfValue(getMinimum()));
        const auto right = static_cast<float>(getPositionOfValue(getMaximum()));
        g.setColour(palette.line);
        g.fillRoundedRectangle({left, middle - 3.0f, right - left, 6.0f}, 3.0f);
        constexpr int marks = 11;
        for (int i = 0; i < marks; ++i)
        {
            const float x = left + (right - left) * static_cast<float>(i) / static_cast<float>(marks - 1);
            g.fillRect(juce::Rectangle<float>(x - 0.5f, middle - 10.0f, 1.0f, 20.0f));
        }
        const auto at = static_cast<float>(getPositionOfValue(getValue()));
        g.setColour(given ? palette.accent : palette.dim);
        const juce::Rectangle<float> knob(at - 12.0f, middle - 18.0f, 24.0f, 36.0f);
        g.fillRoundedRectangle(knob, 5.0f);
        g.setColour(palette.text);
        g.setFont(participantFont().withHeight(17.0f));
        const auto half = static_cast<int>(labels.getWidth() / 2.0f);
        const auto text = labels.toNearestInt();
        g.drawText(low, text.withWidth(half), juce::Justification::centredLeft);
        g.drawText(high, text.withTrimmedLeft(half), juce::Justification::centredRight);
        if (hasKeyboardFocus(true))
            drawFocusRing(g, *this, knob.expanded(4.0f));
    }

    bool keyPressed(const juce::KeyPress& key) override
    {
        const double step = std::max(getInterval(), (getMaximum() - getMinimum()) / 20.0);
        const int direction = key == juce::KeyPress::leftKey || key == juce::KeyPress::downKey  ? -1
                              : key == juce::KeyPress::rightKey || key == juce::KeyPress::upKey ? 1
                                                                                                : 0;
        if (direction == 0)
            return false;
        setValue(getValue() + direction * step, juce::sendNotificationSync);
        if (onValueChange)
            onValueChange(); // at an end nothing changes, but it is an answer
        return true;
    }

    void mouseDown(const juce::MouseEvent& event) override
    {
        juce::Slider::mouseDown(event);
        if (onValueChange)
            onValueChange();
    }

    void enablementChanged() override { repaint(); }
    void focusGained(FocusChangeType) override { repaint(); }
    void focusLost(FocusChangeType) override { repaint(); }

private:
    juce::String low, high;
};

/// Rating and similarity: one number.
class RatingPane final : public AnswerPane
{
public:
    RatingPane(const study::RatingScale& scale, const juce::String& language) : slider(scale, language)
    {
        addAndMakeVisible(slider);
        slider.onValueChange = [this]
        {
            slider.given = true;
            slider.repaint();
            if (onChange)
                onChange();
        };
    }
    [[nodiscard]] std::optional<study::Answer> answer() const override
    {
        if (!slider.given)
            return std::nullopt;
        study::Answer answer;
        answer.value = slider.getValue();
        return answer;
    }
    [[nodiscard]] int wantedHeight() const override { return 96; }
    void resized() override { slider.setBounds(getLocalBounds()); }
    void takeFocus() override { slider.grabKeyboardFocus(); }

private:
    ScaleSlider slider;
};

/// Free description.
class WordsPane final : public AnswerPane
{
public:
    WordsPane()
    {
        editor.setMultiLine(true);
        editor.setReturnKeyStartsNewLine(true);
        editor.setTabKeyUsedAsCharacter(false);
        editor.setFont(participantFont());
        editor.setTitle(tr("Description"));
        editor.setInputRestrictions(4000);
        editor.setEscapeAndReturnKeysConsumed(false);
        editor.onTextChange = [this]
        {
            if (onChange)
                onChange();
        };
        addAndMakeVisible(editor);
    }
    [[nodiscard]] std::optional<study::Answer> answer() const override
    {
        study::Answer answer;
        answer.words = editor.getText().trim().toStdString();
        return answer.words.empty() ? std::nullopt : std::optional(answer);
    }
    [[nodiscard]] int wantedHeight() const override { return 180; }
    void resized() override { editor.setBounds(getLocalBounds()); }
    void lookAndFeelChanged() override
    {
        const Palette& palette = paletteFor(*this);
        editor.setColour(juce::TextEditor::outlineColourId, palette.dim);
        editor.setColour(juce::TextEditor::focusedOutlineColourId, palette.accent);
        editor.setColour(juce::TextEditor::textColourId, palette.text);
        editor.applyColourToAllText(palette.text);
    }
    void parentHierarchyChanged() override { lookAndFeelChanged(); }
    void takeFocus() override { editor.grabKeyboardFocus(); }

private:
    juce::TextEditor editor;
};

/// Which interval, or which of two.
class ChoicePane final : public AnswerPane
{
public:
    ChoicePane(int count, bool abx) : isAbx(abx)
    {
        for (int i = 0; i < count; ++i)
        {
            const juce::String text =
                abx ? tr(i == 0 ? "Like the first (1)" : "Like the second (2)") : juce::String(i + 1);
            auto button = std::make_unique<LargeButton>(text);
            button->onClick = [this, i]
            {
                choose(i);
            };
            addAndMakeVisible(*button);
            buttons.push_back(std::move(button));
        }
    }
    [[nodiscard]] std::optional<study::Answer> answer() const override
    {
        if (!chosen)
            return std::nullopt;
        study::Answer answer;
        answer.choice = chosen;
        return answer;
    }
    [[nodiscard]] bool answersAtOnce() const override { return true; }
    void setReady(bool isReady) override { ready = isReady; }
    void showPlaying(std::optional<std::size_t> part) override
    {
        for (std::size_t i = 0; i < buttons.size(); ++i)
            buttons[i]->setLit(!isAbx && part == i);
        if (isAbx && std::exchange(playing, part) != part)
            repaint();
    }
    bool digit(int number) override
    {
        if (number < 1 || number > static_cast<int>(buttons.size()))
            return false;
        choose(number - 1);
        return true;
    }
    [[nodiscard]] int wantedHeight() const override { return isAbx ? 3 * participantRow : 2 * participantRow; }
    void resized() override
    {
        auto area = getLocalBounds();
        if (isAbx)
            area.removeFromTop(participantRow);
        const int count = static_cast<int>(buttons.size()), gap = 2 * grid;
        const int width = (area.getWidth() - (count - 1) * gap) / count;
        for (auto& button : buttons)
        {
            button->setBounds(area.removeFromLeft(width));
            area.removeFromLeft(gap);
        }
    }
    void paint(juce::Graphics& g) override
    {
        if (!isAbx)
            return;
        // The first, the second, and the one that is asked about.
        const Palette& palette = paletteFor(*this);
        auto row = getLocalBounds().removeFromTop(participantRow).reduced(0, grid);
        const int width = row.getWidth() / 3;
        const std::array names{juce::String("1"), juce::String("2"), juce::String("?")};
        g.setFont(participantFont());
        for (std::size_t i = 0; i < names.size(); ++i)
        {
            const auto cell = row.removeFromLeft(width).reduced(grid, 0);
            g.setColour(playing == i ? palette.accent : palette.line);
            g.fillRoundedRectangle(cell.toFloat(), 5.0f);
            g.setColour(playing == i ? palette.background : palette.text);
            g.drawText(names[i], cell, juce::Justification::centred);
        }
    }

private:
    void choose(int which)
    {
        if (!ready)
            return;
        chosen = which;
        if (onChange)
            onChange();
    }

    bool isAbx, ready = false;
    std::vector<std::unique_ptr<LargeButton>> buttons;
    std::optional<int> chosen;
    std::optional<std::size_t> playing;
};

/// Several stimuli on one page, each with a button to play it: rated, put in order, or sorted into heaps.
class PagePane final : public AnswerPane
{
public:
    PagePane(const study::Block& block, std::size_t count, const juce::String& language)
        : task(block.task), order(count)
    {
        std::iota(order.begin(), order.end(), std::size_t(0));
        for (std::size_t i = 0; i < count; ++i)
        {
            Row row;
            row.play =
                std::make_unique<LargeButton>(juce::String::charToString(static_cast<juce::juce_wchar>('A' + i)));
            row.play->setTitle(tr("Play {0}", {row.play->getButtonText()}));
            row.play->onClick = [this, i]
            {
                if (onPlayPart)
                    onPlayPart(i);
            };
            addAndMakeVisible(*row.play);
            if (task == study::Task::multiStimulus)
            {
                row.slider = std::make_unique<ScaleSlider>(block.scale, language);
                row.slider->onValueChange = [this, i]
                {
                    rows[i].slider->given = true;
                    rows[i].slider->repaint();
                    changed();
                };
                addAndMakeVisible(*row.slider);
            }
            else if (task == study::Task::ranking)
            {
                row.up = std::make_unique<LargeButton>(tr("Up"));
                row.down = std::make_unique<LargeButton>(tr("Down"));
                row.up->setTitle(row.play->getButtonText() + ": " + row.up->getButtonText());
                row.down->setTitle(row.play->getButtonText() + ": " + row.down->getButtonText());
                row.up->onClick = [this, i]
                {
                    move(i, -1);
                };
                row.down->onClick = [this, i]
                {
                    move(i, 1);
                };
                addAll(*this, {row.up.get(), row.down.get()});
            }
            else
            {
                row.heap = std::make_unique<juce::ComboBox>(tr("Heap of {0}", {row.play->getButtonText()}));
                for (int h = 1; h <= static_cast<int>(std::min<std::size_t>(count, 9)); ++h)
                    row.heap->addItem(juce::String(h), h);
                row.heap->onChange = [this]
                {
                    changed();
                };
                addAndMakeVisible(*row.heap);
            }
            rows.push_back(std::move(row));
        }
    }

    [[nodiscard]] std::optional<study::Answer> answer() const override
    {
        study::Answer answer;
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            if (rows[i].slider)
            {
                if (!rows[i].slider->given)
                    return std::nullopt;
                answer.values.push_back(rows[i].slider->getValue());
            }
            else if (rows[i].heap)
            {
                if (rows[i].heap->getSelectedId() == 0)
                    return std::nullopt;
                answer.values.push_back(rows[i].heap->getSelectedId());
            }
            else
                answer.values.push_back(1.0 +
                                        static_cast<double>(std::find(order.begin(), order.end(), i) - order.begin()));
        }
        return answer;
    }
    void setReady(bool) override {} // everything can be moved while it is played
    void showPlaying(std::optional<std::size_t> part) override
    {
        for (std::size_t i = 0; i < rows.size(); ++i)
            rows[i].play->setLit(part == i);
    }
    [[nodiscard]] int wantedHeight() const override { return static_cast<int>(rows.size()) * rowHeight(); }
    void resized() override
    {
        for (std::size_t place = 0; place < order.size(); ++place)
        {
            Row& row = rows[order[place]];
            auto area =
                getLocalBounds().withHeight(rowHeight() - grid).translated(0, static_cast<int>(place) * rowHeight());
            row.play->setBounds(area.removeFromLeft(2 * participantRow).withHeight(participantRow - grid));
            area.removeFromLeft(2 * grid);
            if (row.slider)
                row.slider->setBounds(area);
            if (row.up)
            {
                row.up->setBounds(area.removeFromLeft(2 * participantRow));
                area.removeFromLeft(grid);
                row.down->setBounds(area.removeFromLeft(2 * participantRow));
            }
            if (row.heap)
                row.heap->setBounds(area.removeFromLeft(2 * participantRow));
        }
    }

private:
    struct Row
    {
        std::unique_ptr<LargeButton> play, up, down;
        std::unique_ptr<ScaleSlider> slider;
        std::unique_ptr<juce::ComboBox> heap;
    };

    [[nodiscard]] int rowHeight() const { return task == study::Task::multiStimulus ? 80 : participantRow; }
    void changed()
    {
        if (onChange)
            onChange();
    }
    void move(std::size_t stimulus, int by)
    {
        const auto place = std::find(order.begin(), order.end(), stimulus) - order.begin();
        const auto to = place + by;
        if (to < 0 || to >= static_cast<std::ptrdiff_t>(order.size()))
            return;
        std::swap(order[static_cast<std::size_t>(place)], order[static_cast<std::size_t>(to)]);
        resized();
        changed();
    }

    study::Task task;
    std::vector<std::size_t> order; ///< the stimuli from the first place on
    std::vector<Row> rows;
};
} // namespace

std::unique_ptr<AnswerPane> makeAnswerPane(const study::Block& block, std::size_t stimuli, const juce::String& language)
{
    switch (block.task)
    {
    case study::Task::words:
        return std::make_unique<WordsPane>();
    case study::Task::rating:
    case study::Task::similarity:
        return std::make_unique<RatingPane>(block.scale, language);
    case study::Task::abx:
        return std::make_unique<ChoicePane>(2, true);
    case study::Task::forcedChoice:
    case study::Task::staircase:
        return std::make_unique<ChoicePane>(block.intervals, false);
    case study::Task::multiStimulus:
    case study::Task::ranking:
    case study::Task::sorting:
        break;
    }
    return std::make_unique<PagePane>(block, stimuli, language);
}

} // namespace pacini::editor
