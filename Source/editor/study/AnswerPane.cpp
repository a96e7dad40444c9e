// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/study/AnswerPane.h"

#include "editor/Controls.h"
#include "editor/LineBreaks.h"
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
    setToggleState(isLit, juce::dontSendNotification);
}

void LargeButton::paintButton(juce::Graphics& g, bool over, bool down)
{
    getLookAndFeel().drawButtonBackground(g, *this, {}, over, down);
    g.setColour(buttonTextColour(*this));
    g.setFont(isTool ? participantFont().withHeight(17.0f) : participantFont());
    g.drawFittedText(getButtonText(), getLocalBounds().reduced(grid, 2), juce::Justification::centred, 2, 1.0f);
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
    styled.append(withLineBreaks(content, font, static_cast<float>(width)), font, colour);
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
    const Palette& palette = paletteFor(*this);
    layoutFor(getWidth(), dim ? palette.dim : palette.text).draw(g, getLocalBounds().toFloat());
}

std::unique_ptr<juce::AccessibilityHandler> Paragraph::createAccessibilityHandler()
{
    return std::make_unique<juce::AccessibilityHandler>(*this, juce::AccessibilityRole::staticText);
}

namespace
{
constexpr float scaleLabels = 28.0f; // height

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

    bool given = false;     ///< the participant has set it
    bool isLabelled = true; ///< else a scale below has the labels

    void paint(juce::Graphics& g) override
    {
        const Palette& palette = paletteFor(*this);
        auto area = getLocalBounds().toFloat();
        auto labels = area.removeFromBottom(isLabelled ? scaleLabels : 0.0f);
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
        const juce::Rectangle<float> knob(at - 12.0f, middle - 18.0f, 24.0f, 36.0f);
        // What is not set yet is no value in the middle.
        g.setColour(given ? palette.accent : palette.background);
        g.fillRoundedRectangle(knob, 5.0f);
        if (!given)
        {
            g.setColour(palette.dim);
            g.drawRoundedRectangle(knob.reduced(0.75f), 5.0f, 1.5f);
        }
        g.setColour(palette.text);
        g.setFont(participantFont().withHeight(17.0f));
        const auto half = static_cast<int>(labels.getWidth() / 2.0f);
        const auto text = labels.toNearestInt();
        if (isLabelled)
        {
            g.drawText(low, text.withWidth(half), juce::Justification::centredLeft);
            g.drawText(high, text.withTrimmedLeft(half), juce::Justification::centredRight);
        }
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
        Slider::mouseDown(event);
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
        editor.setIndents(grid, grid);
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
    /// `intervals`: the choices are the intervals of the trial, which light up. `firstChoice`: what the first means.
    ChoicePane(const juce::StringArray& captions, bool abx, bool intervals = false, int firstChoice = 0)
        : isAbx(abx), lights(intervals), first(firstChoice)
    {
        for (int i = 0; i < captions.size(); ++i)
        {
            const juce::String& text = captions[i];
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
        answer.choice = first + *chosen;
        return answer;
    }
    [[nodiscard]] bool answersAtOnce() const override { return true; }
    void setReady(bool isReady) override { ready = isReady; }
    void showPlaying(std::optional<std::size_t> part) override
    {
        for (std::size_t i = 0; i < buttons.size(); ++i)
            buttons[i]->setLit(lights && part == i);
        if (isAbx && std::exchange(playing, part) != part)
            repaint();
    }
    bool digit(int number) override
    {
        const int index = number - (first > 0 ? first : 1);
        if (index < 0 || index >= static_cast<int>(buttons.size()))
            return false;
        choose(index);
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
            // A light that tells what plays, and no button.
            const auto light = cell.toFloat().withSizeKeepingCentre(5.0f * grid, 5.0f * grid);
            g.setColour(playing == i ? palette.accent : palette.line);
            if (playing == i)
                g.fillEllipse(light);
            else
                g.drawEllipse(light.reduced(0.75f), 1.5f);
            g.setColour(playing == i ? palette.onAccent : palette.dim);
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

    bool isAbx, lights, ready = false;
    int first = 0;
    std::vector<std::unique_ptr<LargeButton>> buttons;
    std::optional<int> chosen;
    std::optional<std::size_t> playing;
};

/// Which of several events were felt: any of them, marked by buttons.
class EventsPane final : public AnswerPane
{
public:
    explicit EventsPane(const juce::StringArray& events) : marked(static_cast<std::size_t>(events.size()), false)
    {
        for (int i = 0; i < events.size(); ++i)
        {
            auto button = std::make_unique<LargeButton>(events[i] + " (" + juce::String(i + 1) + ")");
            button->onClick = [this, i]
            {
                toggle(static_cast<std::size_t>(i));
            };
            addAndMakeVisible(*button);
            buttons.push_back(std::move(button));
        }
    }
    [[nodiscard]] std::optional<study::Answer> answer() const override
    {
        if (!touched)
            return std::nullopt;
        study::Answer answer;
        int sum = 0;
        for (std::size_t i = 0; i < marked.size(); ++i)
            sum += marked[i] ? 1 << i : 0;
        answer.choice = sum;
        return answer;
    }
    void setReady(bool isReady) override { ready = isReady; }
    bool digit(int number) override
    {
        if (number < 1 || number > static_cast<int>(buttons.size()))
            return false;
        toggle(static_cast<std::size_t>(number) - 1);
        return true;
    }
    [[nodiscard]] int wantedHeight() const override
    {
        return (static_cast<int>(buttons.size()) + perRow - 1) / perRow * (participantRow + grid);
    }
    void resized() override
    {
        const int width = (getWidth() - (perRow - 1) * 2 * grid) / perRow;
        for (int i = 0; i < static_cast<int>(buttons.size()); ++i)
            buttons[static_cast<std::size_t>(i)]->setBounds(
                i % perRow * (width + 2 * grid), i / perRow * (participantRow + grid), width, participantRow);
    }

private:
    static constexpr int perRow = 4;

    void toggle(std::size_t which)
    {
        if (!ready)
            return;
        touched = true;
        marked[which] = !marked[which];
        buttons[which]->setLit(marked[which]);
        buttons[which]->setToggleState(marked[which], juce::dontSendNotification);
        if (onChange)
            onChange();
    }

    bool ready = false, touched = false;
    std::vector<bool> marked;
    std::vector<std::unique_ptr<LargeButton>> buttons;
};

/// A page of questions, each with a field, a box or a scale.
class QuestionnairePane final : public AnswerPane
{
public:
    QuestionnairePane(const study::Block& block, const juce::String& language)
    {
        for (const study::Item& item : block.items)
        {
            auto row = std::make_unique<Row>(item);
            const juce::String question = toText(study::inLanguage(item.question, language.toStdString()));
            row->question.setText(item.optional ? question : question + " *");
            addAndMakeVisible(row->question);
            if (item.kind == study::QuestionKind::choice)
            {
                row->box = std::make_unique<juce::ComboBox>(question);
                row->box->setTitle(question);
                for (std::size_t i = 0; i < item.choices.size(); ++i)
                {
                    const study::ItemChoice& choice = item.choices[i];
                    row->box->addItem(toText(choice.text.empty()
                                                 ? std::string_view(choice.name)
                                                 : study::inLanguage(choice.text, language.toStdString())),
                                      static_cast<int>(i) + 1);
                }
                row->box->onChange = [this]
                {
                    changed();
                };
                addAndMakeVisible(*row->box);
            }
            else if (item.kind == study::QuestionKind::likert)
            {
                row->slider = std::make_unique<ScaleSlider>(item.scale, language);
                row->slider->setTitle(question);
                row->slider->onValueChange = [this, slider = row->slider.get()]
                {
                    slider->given = true;
                    slider->repaint();
                    changed();
                };
                addAndMakeVisible(*row->slider);
            }
            else
            {
                auto field = std::make_unique<PromptField>(question);
                if (item.kind == study::QuestionKind::number)
                    field->showWhenEmpty(juce::String(item.scale.low) + juce::String::fromUTF8("–") +
                                         juce::String(item.scale.high));
                row->field = std::move(field);
                row->field->setTitle(question);
                row->field->setFont(participantFont());
                row->field->setIndents(grid, 0);
                row->field->setJustification(juce::Justification::centredLeft);
                row->field->setSelectAllWhenFocused(true);
                row->field->setInputRestrictions(item.kind == study::QuestionKind::number ? 20 : 1000);
                row->field->setEscapeAndReturnKeysConsumed(false);
                row->field->onTextChange = [this]
                {
                    changed();
                };
                addAndMakeVisible(*row->field);
            }
            rows.push_back(std::move(row));
        }
    }

    [[nodiscard]] std::optional<study::Answer> answer() const override
    {
        study::Answer answer;
        for (const auto& row : rows)
        {
            std::string given = row->answer();
            if (study::problemOf(row->item, given))
                return std::nullopt;
            if (!given.empty())
                answer.items.emplace_back(row->item.name, std::move(given));
        }
        return answer;
    }
    void takeFocus() override
    {
        if (!rows.empty() && rows.front()->control() != nullptr)
            rows.front()->control()->grabKeyboardFocus();
    }
    [[nodiscard]] int wantedHeight() const override
    {
        int height = 0;
        for (const auto& row : rows)
            height += row->height(wantedWidth());
        return height;
    }
    void resized() override
    {
        int y = 0;
        for (const auto& row : rows)
        {
            const int height = row->height(getWidth());
            auto area = juce::Rectangle<int>(0, y, getWidth(), height - 2 * grid);
            row->question.setBounds(area.removeFromTop(row->question.heightFor(getWidth())));
            row->control()->setBounds(row->slider ? area : area.withWidth(std::min(area.getWidth(), 50 * grid)));
            y += height;
        }
    }
    /// The field that is typed into is in sight.
    void focusOfChildComponentChanged(FocusChangeType) override
    {
        auto* viewport = findParentComponentOfClass<juce::Viewport>();
        for (const auto& row : rows)
            if (viewport != nullptr && row->control()->hasKeyboardFocus(true))
            {
                const int top = row->question.getY(), bottom = row->control()->getBottom();
                if (top < viewport->getViewPositionY() || bottom > viewport->getViewPositionY() + viewport->getHeight())
                    viewport->setViewPosition(0, std::max(0, bottom - viewport->getHeight()));
            }
    }
    void lookAndFeelChanged() override
    {
        const Palette& palette = paletteFor(*this);
        for (const auto& row : rows)
            if (row->field)
            {
                row->field->setColour(juce::TextEditor::outlineColourId, palette.dim);
                row->field->setColour(juce::TextEditor::focusedOutlineColourId, palette.accent);
                row->field->setColour(juce::TextEditor::textColourId, palette.text);
                row->field->applyColourToAllText(palette.text);
            }
    }
    void parentHierarchyChanged() override { lookAndFeelChanged(); }

private:
    struct Row
    {
        explicit Row(const study::Item& asked) : item(asked) {}
        study::Item item;
        Paragraph question{participantFont()};
        std::unique_ptr<juce::TextEditor> field;
        std::unique_ptr<juce::ComboBox> box;
        std::unique_ptr<ScaleSlider> slider;

        [[nodiscard]] juce::Component* control() const
        {
            return field ? static_cast<juce::Component*>(field.get())
                   : box ? static_cast<juce::Component*>(box.get())
                         : slider.get();
        }
        [[nodiscard]] int height(int width) const
        {
            return question.heightFor(width) + (slider ? 80 : 5 * grid) + 2 * grid;
        }
        /// As study::problemOf() takes it; decimal commas are points.
        [[nodiscard]] std::string answer() const
        {
            if (field)
            {
                const juce::String text = field->getText().trim();
                return (item.kind == study::QuestionKind::number ? text.replaceCharacter(',', '.') : text)
                    .toStdString();
            }
            if (box)
                return box->getSelectedId() > 0 ? item.choices[static_cast<std::size_t>(box->getSelectedId()) - 1].name
                                                : std::string();
            return slider->given ? juce::String(slider->getValue()).toStdString() : std::string();
        }
    };

    [[nodiscard]] int wantedWidth() const { return getWidth() > 0 ? getWidth() : 700; }
    void changed()
    {
        if (onChange)
            onChange();
    }

    std::vector<std::unique_ptr<Row>> rows;
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
                row.slider->isLabelled = i + 1 == count;
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
        enableMoves();
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
    [[nodiscard]] int wantedHeight() const override
    {
        const int labels = task == study::Task::multiStimulus ? static_cast<int>(scaleLabels) : 0;
        return static_cast<int>(rows.size()) * rowHeight + labels;
    }
    void paint(juce::Graphics& g) override
    {
        if (task != study::Task::ranking)
            return;
        g.setColour(paletteFor(*this).dim);
        g.setFont(participantFont());
        for (int place = 0; place < static_cast<int>(rows.size()); ++place)
            g.drawText(juce::String(place + 1), 0, place * rowHeight, placeWidth, rowHeight - grid,
                       juce::Justification::centredLeft);
    }
    void resized() override
    {
        for (std::size_t place = 0; place < order.size(); ++place)
        {
            Row& row = rows[order[place]];
            auto area =
                getLocalBounds().withHeight(rowHeight - grid).translated(0, static_cast<int>(place) * rowHeight);
            if (row.up)
                area.removeFromLeft(placeWidth);
            row.play->setBounds(area.removeFromLeft(2 * participantRow).withHeight(participantRow - grid));
            area.removeFromLeft(2 * grid);
            if (row.slider)
                row.slider->setBounds(
                    area.withHeight(area.getHeight() + (row.slider->isLabelled ? static_cast<int>(scaleLabels) : 0)));
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

    static constexpr int rowHeight = participantRow;
    static constexpr int placeWidth = 4 * grid; // of the number before a stimulus in its order
    void changed()
    {
        if (onChange)
            onChange();
    }
    /// The first goes no further up, the last no further down; the keyboard stays at the stimulus.
    void enableMoves()
    {
        for (const std::size_t stimulus : order)
        {
            Row& row = rows[stimulus];
            if (!row.up)
                continue;
            const bool first = stimulus == order.front(), last = stimulus == order.back();
            const bool hasFocus = row.up->hasKeyboardFocus(true) || row.down->hasKeyboardFocus(true);
            row.up->setEnabled(!first);
            row.down->setEnabled(!last);
            if (hasFocus && rows.size() > 1 && (first || last))
                (first ? row.down : row.up)->grabKeyboardFocus();
        }
    }
    void move(std::size_t stimulus, int by)
    {
        const auto place = std::find(order.begin(), order.end(), stimulus) - order.begin();
        const auto to = place + by;
        if (to < 0 || to >= static_cast<std::ptrdiff_t>(order.size()))
            return;
        std::swap(order[static_cast<std::size_t>(place)], order[static_cast<std::size_t>(to)]);
        resized();
        enableMoves();
        changed();
    }

    study::Task task;
    std::vector<std::size_t> order; ///< the stimuli from the first place on
    std::vector<Row> rows;
};
} // namespace

juce::StringArray eventNames(const study::Study& study, const study::Block& block, const juce::String& language)
{
    juce::StringArray names;
    for (const std::size_t event : study::eventsOf(study, block))
    {
        const juce::String label = toText(study::inLanguage(study.stimuli[event].label, language.toStdString()));
        names.add(label.isNotEmpty() ? label
                                     : juce::String::charToString(static_cast<juce::juce_wchar>('A' + names.size())));
    }
    return names;
}

std::unique_ptr<AnswerPane> makeAnswerPane(const study::Study& study, const study::Block& block, std::size_t stimuli,
                                           const juce::String& language)
{
    const auto numbers = [](int from, int to)
    {
        juce::StringArray texts;
        for (int i = from; i <= to; ++i)
            texts.add(juce::String(i));
        return texts;
    };
    switch (block.task)
    {
    case study::Task::words:
        return std::make_unique<WordsPane>();
    case study::Task::rating:
    case study::Task::similarity:
    case study::Task::place:
        return std::make_unique<RatingPane>(block.scale, language);
    case study::Task::questionnaire:
        return std::make_unique<QuestionnairePane>(block, language);
    case study::Task::abx:
        return std::make_unique<ChoicePane>(juce::StringArray{tr("Like the first (1)"), tr("Like the second (2)")},
                                            true);
    case study::Task::side:
        return std::make_unique<ChoicePane>(juce::StringArray{tr("Left (1)"), tr("Right (2)")}, false);
    case study::Task::count:
    {
        const std::vector<int> counts = study::countsOf(study, block);
        return std::make_unique<ChoicePane>(numbers(counts.front(), counts.back()), false, false, counts.front());
    }
    case study::Task::which:
        return std::make_unique<EventsPane>(eventNames(study, block, language));
    case study::Task::forcedChoice:
    case study::Task::staircase:
        return std::make_unique<ChoicePane>(numbers(1, block.intervals), false, true);
    case study::Task::multiStimulus:
    case study::Task::ranking:
    case study::Task::sorting:
        break;
    }
    return std::make_unique<PagePane>(block, stimuli, language);
}

} // namespace pacini::editor
