// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/StandaloneWindow.h"

#include "app/DevicePage.h"
#include "app/WindowPlace.h"
#include "editor/FocusEntry.h"
#include "editor/Theme.h"
#include "editor/Translation.h"

#include <cstdlib>

namespace pacini::app
{

namespace
{
constexpr int barHeight = 5 * editor::grid + 2;
}

/// Bar and plugin, one look.
class StandaloneWindow::Content final : public juce::Component, private juce::ComponentListener
{
public:
    Content(plugin::Plugin& processor, AudioDevices& wanted) : rig(wanted), plugin(processor), bar(wanted)
    {
        bar.setLookAndFeel(&plugin.getLookAndFeel());
        plugin.onThemeChange = [this]
        {
            bar.sendLookAndFeelChange();
            bar.repaint();
        };
        bar.onDevices = [this]
        {
            showDevices();
        };
        editor::translateTexts(bar);
        addAndMakeVisible(bar);
        addAndMakeVisible(plugin);
        plugin.setResizable(true, false); // the window has borders of its own
        plugin.onScaleChange = [this]
        {
            limitWindow();
        };
        plugin.addComponentListener(this);
        setSize(wantedSize().x, wantedSize().y);
    }

    /// The least size of the window depends on the scale, which gives way to a screen that has no room for it.
    void limitWindow()
    {
        const auto& displays = juce::Desktop::getInstance().getDisplays();
        const auto* display = displays.getDisplayForRect(getScreenBounds());
        if (display == nullptr)
            display = displays.getPrimaryDisplay();
        if (display != nullptr)
        {
            const float chosen = plugin.scaleFactor() / byScreen;
            const float fits = scaleThatFits(
                display->userArea, {chosen * static_cast<float>(plugin::PluginWindow::leastWidth),
                                    chosen * static_cast<float>(plugin::PluginWindow::leastHeight + barHeight)});
            if (std::abs(fits - byScreen) > 0.005f)
            {
                byScreen = fits;
                return plugin.setScaleFactor(fits); // which comes back here
            }
        }
        auto* window = findParentComponentOfClass<juce::ResizableWindow>();
        if (window == nullptr)
            return;
        window->setResizeLimits(scaled(plugin::PluginWindow::leastWidth),
                                scaled(plugin::PluginWindow::leastHeight + barHeight), 4800, 3400);
        // It grows to the right and down: its menus would leave the screen.
        if (display != nullptr && !window->isFullScreen())
            window->setBounds(insideOf(display->userArea, window->getBounds()));
    }

    ~Content() override
    {
        plugin.removeComponentListener(this);
        bar.setLookAndFeel(nullptr);
    }

    bool keyPressed(const juce::KeyPress& key) override { return plugin.keyPressed(key); }

    void resized() override
    {
        // Both are placed before they are scaled.
        bar.setTransform(plugin.getTransform());
        auto area = getLocalBounds().toFloat().transformedBy(plugin.getTransform().inverted()).toNearestInt();
        bar.setBounds(area.removeFromTop(barHeight));
        plugin.setBounds(area);
    }

private:
    void componentMovedOrResized(juce::Component&, bool, bool) override
    {
        const auto wanted = wantedSize();
        if (std::abs(wanted.x - getWidth()) > 1 || std::abs(wanted.y - getHeight()) > 1) // beyond rounding
            setSize(wanted.x, wanted.y);
        else
            resized();
    }

    [[nodiscard]] int scaled(int length) const
    {
        return juce::roundToInt(static_cast<float>(length) * plugin.scaleFactor());
    }
    [[nodiscard]] juce::Point<int> wantedSize() const
    {
        return {scaled(plugin.getWidth()), scaled(plugin.getHeight() + barHeight)};
    }

    void showDevices()
    {
        auto page = std::make_unique<DevicePage>(rig.devices());
        page->setSize(560, 520);
        page->setLookAndFeel(&plugin.getLookAndFeel());
        editor::translateTexts(*page);
        juce::DialogWindow::LaunchOptions options;
        options.content.setOwned(page.release());
        options.dialogTitle = editor::tr("Audio devices");
        options.dialogBackgroundColour = editor::paletteFor(plugin).card;
        options.useNativeTitleBar = true;
        options.resizable = false;
        options.componentToCentreAround = this;
        options.launchAsync();
    }

    AudioDevices& rig;
    plugin::PluginWindow plugin;
    editor::DefaultLook defaultLook{plugin.getLookAndFeel()};
    RoutingBar bar;
    float byScreen = 1.0f; ///< how much less than chosen all is drawn
};

StandaloneWindow::StandaloneWindow(plugin::Plugin& processor, AudioDevices& rig)
    : DocumentWindow("Pacini", juce::Colours::black, DocumentWindow::allButtons)
{
    setUsingNativeTitleBar(true);
    auto* const content = new Content(processor, rig);
    setContentOwned(content, true);
    setResizable(true, false);
    content->limitWindow();
    centreWithSize(getWidth(), getHeight());
    if (const auto* display = juce::Desktop::getInstance().getDisplays().getDisplayForRect(getBounds()))
        setBounds(insideOf(display->userArea, getBounds()));
    setVisible(true);
}

StandaloneWindow::~StandaloneWindow() = default;

void StandaloneWindow::closeButtonPressed()
{
    juce::JUCEApplication::getInstance()->systemRequestedQuit();
}

bool StandaloneWindow::keyPressed(const juce::KeyPress& key)
{
    // As the program starts the window itself has the keyboard, and what is inside hears nothing.
    return hasKeyboardFocus(false) && (editor::enterByTab(*this, key) || getContentComponent()->keyPressed(key));
}

} // namespace pacini::app
