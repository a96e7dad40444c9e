#pragma once

// A window that only the program sees: components inside are shown and can have the keyboard, without any screen.

#include <juce_gui_basics/juce_gui_basics.h>

namespace pacini::test
{

/// A peer without a system behind it, which always has the keyboard.
class UnseenPeer final : public juce::ComponentPeer
{
public:
    UnseenPeer(juce::Component& shown, int flags) : juce::ComponentPeer(shown, flags) {}

    void* getNativeHandle() const override { return nullptr; }
    void setVisible(bool) override {}
    void setTitle(const juce::String&) override {}
    void setBounds(const juce::Rectangle<int>& wanted, bool) override { bounds = wanted; }
    juce::Rectangle<int> getBounds() const override { return bounds; }
    juce::Point<float> localToGlobal(juce::Point<float> point) override { return point; }
    juce::Point<float> globalToLocal(juce::Point<float> point) override { return point; }
    using juce::ComponentPeer::globalToLocal;
    using juce::ComponentPeer::localToGlobal;
    void setMinimised(bool) override {}
    bool isMinimised() const override { return false; }
    void setFullScreen(bool) override {}
    bool isFullScreen() const override { return false; }
    void setIcon(const juce::Image&) override {}
    bool contains(juce::Point<int> point, bool) const override { return bounds.withZeroOrigin().contains(point); }
    OptionalBorderSize getFrameSizeIfPresent() const override { return {}; }
    juce::BorderSize<int> getFrameSize() const override { return {}; }
    bool setAlwaysOnTop(bool) override { return true; }
    void toFront(bool) override {}
    void toBehind(juce::ComponentPeer*) override {}
    bool isFocused() const override { return true; }
    void grabFocus() override {}
    void repaint(const juce::Rectangle<int>&) override {}
    void performAnyPendingRepaintsNow() override {}
    void setAlpha(float) override {}
    juce::StringArray getAvailableRenderingEngines() override { return {"none"}; }
    void textInputRequired(juce::Point<int>, juce::TextInputTarget&) override {}

private:
    juce::Rectangle<int> bounds;
};

/// Shows a component, which outlives it.
class ShownWindow final : public juce::Component
{
public:
    explicit ShownWindow(juce::Component& content)
    {
        setSize(content.getWidth(), content.getHeight());
        addAndMakeVisible(content);
        setVisible(true);
        addToDesktop(0);
    }
    ~ShownWindow() override
    {
        giveAwayKeyboardFocus();
        removeFromDesktop();
    }

private:
    juce::ComponentPeer* createNewPeer(int style, void*) override { return new UnseenPeer(*this, style); }
};

} // namespace pacini::test
