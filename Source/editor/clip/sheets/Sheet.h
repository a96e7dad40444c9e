// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Base class of the dialogs inside the window: they work the same in a program and in a plugin.

#include "editor/clip/commands/Command.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>
#include <memory>
#include <vector>

namespace pacini::editor
{

/// A panel in the middle of a darkened window. Escape closes it; the keyboard stays inside.
class Sheet : public juce::Component
{
public:
    Sheet(const juce::String& title, int width, int height);

    std::function<void()> onClose;                    ///< removes it
    std::function<bool(const juce::KeyPress&)> onKey; ///< of one of commands(); whether it was

    /// What keys of the window do in it too: a sheet that edits the project can undo and save.
    [[nodiscard]] virtual std::vector<Command> commands() const { return {}; }

    void paint(juce::Graphics& g) override;
    void resized() override;
    bool keyPressed(const juce::KeyPress& key) override;
    /// When it is shown.
    void takeFocus();

    /// The first button is the usual answer (Return); one without an action closes only.
    struct Answer
    {
        juce::String text;
        std::function<void()> chosen; ///< may be empty
    };
    void setAnswers(std::vector<Answer> answers);

protected:
    /// The usual answer does this and leaves the sheet open.
    void setUsualAnswer(std::function<void()> answer) { usual = std::move(answer); }

    /// Where the content goes, without title and answers.
    [[nodiscard]] juce::Rectangle<int> inside() const;
    virtual void layOut(juce::Rectangle<int>) {}
    /// What has the keyboard at first; null: the usual answer.
    virtual juce::Component* firstFocus() { return nullptr; }
    /// Whether the usual answer may be given now.
    void setAnswerEnabled(bool enabled);
    void close();
    /// The height of what is inside. The top stays where the full height has it, so that no field moves when there is
    /// less to show below.
    void setContentHeight(int height);
    /// It stands at the right below and darkens nothing: what it changes is seen behind it.
    void standAside();

private:
    [[nodiscard]] juce::Rectangle<int> panel() const;

    int wantedWidth, wantedHeight, shownHeight;
    bool aside = false;
    std::vector<Answer> choices;
    std::function<void()> usual;
    std::vector<std::unique_ptr<juce::TextButton>> buttons;
};

/// Dialog with a text and answers.
class MessageSheet final : public Sheet
{
public:
    MessageSheet(const juce::String& title, const juce::String& text, std::vector<Answer> answers);

private:
    void layOut(juce::Rectangle<int> area) override;
    juce::TextEditor words;
};

} // namespace pacini::editor
