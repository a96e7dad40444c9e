// The window on a display, in a host that ends when X tells it of an error. The test runs on a display of its own.

#include "editor/Pump.h"
#include "plugin/engine/Rig.h"
#include "plugin/window/Plugin.h"

#include <memory>

// Last, since it redefines common words.
#include <X11/Xlib.h>

using namespace pacini;
using namespace pacini::test;

namespace
{
int errors = 0;

int countError(::Display*, XErrorEvent*)
{
    return ++errors;
}
} // namespace

TEST_CASE("A window that the host has closed already is no error for the host", "[.display]")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    ::Display* const host = XOpenDisplay(nullptr);
    REQUIRE(host != nullptr);
    const auto hostHandler = XSetErrorHandler(countError);
    errors = 0;
    RigOf<plugin::Plugin> rig;
    for (int i = 0; i < 3; ++i)
    {
        CAPTURE(i);
        const ::Window around = XCreateSimpleWindow(host, DefaultRootWindow(host), 0, 0, 1200, 800, 0, 0, 0);
        XMapWindow(host, around);
        XSync(host, False);
        const std::unique_ptr<juce::AudioProcessorEditor> window(rig.plugin.createEditor());
        window->addToDesktop(0, reinterpret_cast<void*>(around));
        window->setVisible(true);
        pumpFor(0.1);
        XDestroyWindow(host, around); // and with it, ours
        XSync(host, False);
        window->grabKeyboardFocus();
        window->setBounds(10, 10, 1000, 640);
        window->toFront(true);
        CHECK_FALSE(window->getPeer()->isFocused());
        pumpFor(0.1);
    }
    CHECK(errors == 0);

    XDestroyWindow(host, 1); // the host's own errors are still its own
    XSync(host, False);
    CHECK(errors == 1);
    XSetErrorHandler(hostHandler);
    XCloseDisplay(host);
}
