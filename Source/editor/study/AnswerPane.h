// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Controls by which a participant answers, one kind for each task.

#include "study/SessionLog.h"
#include "study/Study.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace pacini::editor
{

/// Controls for the answers of a participant. Reveals nothing about the stimulus.
class AnswerPane : public juce::Component
{
public:
    /// The answer so far; nothing while something is missing.
    [[nodiscard]] virtual std::optional<study::Answer> answer() const = 0;

    /// Lights up what plays: the interval of a trial, or the stimulus of a page.
    virtual void showPlaying(std::optional<std::size_t>) {}

    /// Whether answering is possible now.
    virtual void setReady(bool ready) { setEnabled(ready); }

    /// The keyboard speaks to the answer now.
    virtual void takeFocus() {}

    /// A digit key was pressed; whether it meant something.
    virtual bool digit(int) { return false; }

    /// How high it wants to be, at this width.
    [[nodiscard]] virtual int wantedHeight() const = 0;

    /// Whether a choice is the whole answer, without a button to go on.
    [[nodiscard]] virtual bool answersAtOnce() const { return false; }

    std::function<void()> onChange;
    std::function<void(std::size_t)> onPlayPart; ///< of pages
};

/// The pane of a task. `stimuli`: how many there are on a page.
[[nodiscard]] std::unique_ptr<AnswerPane> makeAnswerPane(const study::Study& study, const study::Block& block,
                                                         std::size_t stimuli, const juce::String& language);

/// What participants call the events of a task `which`, in the order of study::eventsOf(): their labels, else letters.
[[nodiscard]] juce::StringArray eventNames(const study::Study& study, const study::Block& block,
                                           const juce::String& language);

/// Sizes of what participants read and touch: larger than an editor's.
[[nodiscard]] juce::Font participantFont();
[[nodiscard]] juce::Font participantTitleFont();
inline constexpr int participantRow = 56; ///< pixels

/// A button of that size.
class LargeButton final : public juce::TextButton
{
public:
    using juce::TextButton::TextButton;
    void paintButton(juce::Graphics& g, bool over, bool down) override;
    void setLit(bool isLit);

    bool isTool = false; ///< of the experimenter, in less type
};

/// A text of several lines, which screen readers read as one.
class Paragraph final : public juce::Component
{
public:
    explicit Paragraph(juce::Font wanted) : font(std::move(wanted)) {}

    void setText(const juce::String& wanted);
    void setDim(bool wanted) { dim = wanted; }
    [[nodiscard]] const juce::String& text() const noexcept { return content; }
    [[nodiscard]] int heightFor(int width) const;
    void paint(juce::Graphics& g) override;
    std::unique_ptr<juce::AccessibilityHandler> createAccessibilityHandler() override;

private:
    [[nodiscard]] juce::TextLayout layoutFor(int width, juce::Colour colour) const;

    juce::Font font;
    bool dim = false;
    juce::String content;
};

} // namespace pacini::editor
