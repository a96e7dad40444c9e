// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/StandaloneWindow.h"

#include "app/DevicePage.h"
#include "editor/Translation.h"

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
        plugin.addComponentListener(this);
        setSize(plugin.getWidth(), plugin.getHeight() + barHeight);
    }

    ~Content() override
    {
        plugin.removeComponentListener(this);
        bar.setLookAndFeel(nullptr);
    }

    bool keyPressed(const juce::KeyPress& key) override { return plugin.keyPressed(key); }

    void resized() override
    {
        auto area = getLocalBounds();
        bar.setBounds(area.removeFromTop(barHeight));
        plugin.setBounds(area);
    }

private:
    void componentMovedOrResized(juce::Component&, bool, bool) override
    {
        if (plugin.getWidth() != getWidth() || plugin.getHeight() + barHeight != getHeight())
            setSize(plugin.getWidth(), plugin.getHeight() + barHeight);
    }

    void showDevices()
    {
        auto page = std::make_unique<DevicePage>(rig.devices());
        page->setSize(560, 520);
        page->setLookAndFeel(&plugin.getLookAndFeel());
        juce::DialogWindow::LaunchOptions options;
        options.content.setOwned(page.release());
        options.dialogTitle = editor::tr("Audio devices");
        options.dialogBackgroundColour = editor::paletteFor(plugin).background;
        options.useNativeTitleBar = true;
        options.resizable = false;
        options.componentToCentreAround = this;
        options.launchAsync();
    }

    AudioDevices& rig;
    plugin::PluginWindow plugin;
    RoutingBar bar;
};

StandaloneWindow::StandaloneWindow(plugin::Plugin& processor, AudioDevices& rig)
    : DocumentWindow("Pacini", juce::Colours::black, DocumentWindow::allButtons)
{
    setUsingNativeTitleBar(true);
    setContentOwned(new Content(processor, rig), true);
    setResizable(true, false);
    setResizeLimits(936, 608 + barHeight, 2400, 1700);
    centreWithSize(getWidth(), getHeight());
    setVisible(true);
}

StandaloneWindow::~StandaloneWindow() = default;

void StandaloneWindow::closeButtonPressed()
{
    juce::JUCEApplication::getInstance()->systemRequestedQuit();
}

} // namespace pacini::app
