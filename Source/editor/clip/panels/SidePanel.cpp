// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/panels/SidePanel.h"

#include "editor/Theme.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/panels/AnalysisPanel.h"
#include "editor/clip/panels/Inspector.h"
#include "editor/clip/panels/PlayPanel.h"
#include "editor/clip/panels/ProjectPanel.h"

namespace pacini::editor
{

namespace
{
constexpr int tabHeight = 30;
constexpr int scrollBarWidth = 8;

/// The page fills the available width and has at least its original height.
class Scrolled final : public juce::Viewport
{
public:
    explicit Scrolled(std::unique_ptr<juce::Component> content) : leastHeight(content->getHeight())
    {
        setScrollBarsShown(true, false);
        setScrollBarThickness(scrollBarWidth);
        setWantsKeyboardFocus(false);
        setViewedComponent(content.release(), true);
    }

private:
    void resized() override
    {
        auto* page = getViewedComponent();
        page->setSize(getWidth() - (leastHeight > getHeight() ? scrollBarWidth : 0),
                      std::max(leastHeight, getHeight()));
        Viewport::resized();
    }

    const int leastHeight;
};
} // namespace

SidePanel::SidePanel(EditorView& view) : TabbedComponent(juce::TabbedButtonBar::TabsAtTop)
{
    setTabBarDepth(tabHeight);
    setOutline(0);
    addPage("Edit", std::make_unique<Inspector>(view));
    addPage("Analysis", std::make_unique<AnalysisPanel>(view));
    addPage("Project", std::make_unique<ProjectPanel>(view));
    addPage("Play", std::make_unique<PlayPanel>(view));
}

void SidePanel::addPage(const juce::String& name, std::unique_ptr<juce::Component> content)
{
    addTab(name, juce::Colours::transparentBlack, new Scrolled(std::move(content)), true);
    getTabbedButtonBar().getTabButton(getNumTabs() - 1)->setWantsKeyboardFocus(true);
}

} // namespace pacini::editor
