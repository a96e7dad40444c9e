// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/window/DisplayErrors.h"

#include <juce_core/juce_core.h>

#if JUCE_LINUX || JUCE_BSD
// X's headers are among those of JUCE with this.
#define JUCE_GUI_BASICS_INCLUDE_XHEADERS 1
#include <juce_gui_basics/juce_gui_basics.h>

extern "C"
{
    /// False: the error goes to no other handler.
    static Bool ignoreError(::Display*, XErrorEvent*, void*)
    {
        return False;
    }
}
#endif

namespace pacini::plugin
{

void ignoreDisplayErrors()
{
#if JUCE_LINUX || JUCE_BSD
    ::Display* const display = juce::XWindowSystem::getInstance()->getDisplay();
    if (display == nullptr)
        return;
    // Xlib.h does not declare it, and JUCE loads Xlib rather than being linked with it.
    using Handler = Bool (*)(::Display*, XErrorEvent*, void*);
    using SetHandler = Handler (*)(::Display*, int, Handler);
    juce::DynamicLibrary xlib("libX11.so.6");
    if (const auto setHandler = reinterpret_cast<SetHandler>(xlib.getFunction("XESetWireToError")))
        for (int code = Success + 1; code <= BadImplementation; ++code) // those of the core protocol
            setHandler(display, code, ignoreError);
#endif
}

} // namespace pacini::plugin
