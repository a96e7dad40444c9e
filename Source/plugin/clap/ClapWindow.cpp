// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/clap/ClapWindow.h"

#include "plugin/clap/ClapPlugin.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pacini::plugin
{

ClapWindow::~ClapWindow()
{
    close();
}

const char* ClapWindow::windowApi() noexcept
{
#if JUCE_WINDOWS
    return CLAP_WINDOW_API_WIN32;
#elif JUCE_MAC
    return CLAP_WINDOW_API_COCOA;
#else
    return CLAP_WINDOW_API_X11;
#endif
}

bool ClapWindow::supports(const char* api, bool floating) noexcept
{
    return !floating && api != nullptr && std::strcmp(api, windowApi()) == 0;
}

bool ClapWindow::create()
{
    close();
    editor.reset(processor.createEditorIfNeeded());
    if (editor == nullptr)
        return false;
    setOpaque(true);
    addAndMakeVisible(*editor);
    fitEditor();
    editor->addComponentListener(this);
    return true;
}

void ClapWindow::close()
{
    if (editor == nullptr)
        return;
    juce::PopupMenu::dismissAllActiveMenus();
    removeFromDesktop();
    editor->removeComponentListener(this);
    processor.editorBeingDeleted(editor.get());
    editor = nullptr;
}

bool ClapWindow::setScale(double scale)
{
    if (editor == nullptr || !std::isfinite(scale) || scale < 0.25 || scale > 8.0)
        return false;
    editor->setScaleFactor(static_cast<float>(scale));
    fitEditor();
    return true;
}

juce::Point<int> ClapWindow::nearestSize(std::uint32_t width, std::uint32_t height) const
{
    constexpr std::uint32_t most = 1u << 15;
    const auto* limits = editor->getConstrainer();
    const auto least =
        getLocalArea(editor.get(), juce::Rectangle<int>(limits->getMinimumWidth(), limits->getMinimumHeight()));
    const auto largest =
        getLocalArea(editor.get(), juce::Rectangle<int>(limits->getMaximumWidth(), limits->getMaximumHeight()));
    return {juce::jlimit(least.getWidth(), largest.getWidth(), static_cast<int>(std::min(width, most))),
            juce::jlimit(least.getHeight(), largest.getHeight(), static_cast<int>(std::min(height, most)))};
}

bool ClapWindow::setWindowSize(std::uint32_t width, std::uint32_t height)
{
    if (editor == nullptr)
        return false;
    const auto wanted = nearestSize(width, height);
    const juce::ScopedValueSetter<bool> scope(byHost, true);
    setSize(wanted.x, wanted.y);
    return true;
}

bool ClapWindow::setParent(const clap_window_t& parent)
{
    if (editor == nullptr || !supports(parent.api, false))
        return false;
#if JUCE_WINDOWS || JUCE_MAC
    void* const handle = parent.ptr;
#else
    void* const handle = reinterpret_cast<void*>(parent.x11); // as JUCE takes windows of X
#endif
    if (handle == nullptr)
        return false;
    setVisible(false);
    removeFromDesktop();
    setTopLeftPosition(0, 0);
    addToDesktop(0, handle);
    setVisible(true);
    return true;
}

bool ClapWindow::show(bool wanted)
{
    if (editor == nullptr)
        return false;
    setVisible(wanted);
    return true;
}

void ClapWindow::resized()
{
    if (editor == nullptr)
        return;
    const juce::ScopedValueSetter<bool> scope(byHost, true);
    const auto area = editor->getLocalArea(this, getLocalBounds());
    editor->setBoundsConstrained({area.getWidth(), area.getHeight()});
}

/// By its own hand, such as the scale in its menu: the host's window follows.
void ClapWindow::componentMovedOrResized(juce::Component&, bool, bool wasResized)
{
    if (byHost || !wasResized)
        return;
    const auto wanted = getLocalArea(editor.get(), editor->getLocalBounds());
    const auto* asked = extensionOf<clap_host_gui_t>(host, CLAP_EXT_GUI);
    if (asked == nullptr || asked->request_resize == nullptr ||
        asked->request_resize(&host, static_cast<std::uint32_t>(wanted.getWidth()),
                              static_cast<std::uint32_t>(wanted.getHeight())))
        fitEditor();
}

void ClapWindow::fitEditor()
{
    const juce::ScopedValueSetter<bool> scope(byHost, true);
    const auto area = getLocalArea(editor.get(), editor->getLocalBounds());
    setSize(area.getWidth(), area.getHeight());
}

const clap_plugin_gui_t& guiExtension() noexcept
{
    static constexpr clap_plugin_gui_t extension{
        [](const clap_plugin_t*, const char* api, bool floating) { return ClapWindow::supports(api, floating); },
        [](const clap_plugin_t*, const char** api, bool* floating)
        {
            if (api == nullptr || floating == nullptr)
                return false;
            *api = ClapWindow::windowApi();
            *floating = false;
            return true;
        },
        [](const clap_plugin_t* plugin, const char* api, bool floating)
        {
            const juce::MessageManagerLock lock;
            return ClapWindow::supports(api, floating) && ClapPlugin::of(plugin).window().create();
        },
        [](const clap_plugin_t* plugin)
        {
            const juce::MessageManagerLock lock;
            ClapPlugin::of(plugin).window().close();
        },
        [](const clap_plugin_t* plugin, double scale)
        {
            const juce::MessageManagerLock lock;
#if JUCE_MAC
            juce::ignoreUnused(plugin, scale);
            return false; // sizes are logical there
#else
            return ClapPlugin::of(plugin).window().setScale(scale);
#endif
        },
        [](const clap_plugin_t* plugin, std::uint32_t* width, std::uint32_t* height)
        {
            const juce::MessageManagerLock lock;
            const ClapWindow& window = ClapPlugin::of(plugin).window();
            if (!window.exists() || width == nullptr || height == nullptr)
                return false;
            *width = static_cast<std::uint32_t>(window.size().x);
            *height = static_cast<std::uint32_t>(window.size().y);
            return true;
        },
        [](const clap_plugin_t*) { return true; },
        [](const clap_plugin_t*, clap_gui_resize_hints_t* hints)
        {
            if (hints == nullptr)
                return false;
            *hints = {};
            hints->can_resize_horizontally = hints->can_resize_vertically = true;
            return true;
        },
        [](const clap_plugin_t* plugin, std::uint32_t* width, std::uint32_t* height)
        {
            const juce::MessageManagerLock lock;
            const ClapWindow& window = ClapPlugin::of(plugin).window();
            if (!window.exists() || width == nullptr || height == nullptr)
                return false;
            const auto possible = window.nearestSize(*width, *height);
            *width = static_cast<std::uint32_t>(possible.x);
            *height = static_cast<std::uint32_t>(possible.y);
            return true;
        },
        [](const clap_plugin_t* plugin, std::uint32_t width, std::uint32_t height)
        {
            const juce::MessageManagerLock lock;
            return ClapPlugin::of(plugin).window().setWindowSize(width, height);
        },
        [](const clap_plugin_t* plugin, const clap_window_t* parent)
        {
            const juce::MessageManagerLock lock;
            return parent != nullptr && ClapPlugin::of(plugin).window().setParent(*parent);
        },
        [](const clap_plugin_t*, const clap_window_t*) { return false; }, // no floating windows
        [](const clap_plugin_t*, const char*) {},
        [](const clap_plugin_t* plugin)
        {
            const juce::MessageManagerLock lock;
            return ClapPlugin::of(plugin).window().show(true);
        },
        [](const clap_plugin_t* plugin)
        {
            const juce::MessageManagerLock lock;
            return ClapPlugin::of(plugin).window().show(false);
        }};
    return extension;
}

} // namespace pacini::plugin
