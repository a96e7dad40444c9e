// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Errors of the connection to the X server that the plugin's windows use.

namespace pacini::plugin
{

/// Ignores errors of JUCE's connection to the X server, which otherwise go to the host's handler: toolkits end the
/// program there. They cannot be avoided, since the windows around ours are the host's: JUCE asks for the parents of
/// the window that has the focus (XWindowSystem::isParentWindowOf), which may be closed by the time that the server
/// answers.
///
/// The connection has a handler of its own (XESetWireToError), which Xlib asks before that of the process, so nothing
/// changes for the host's connections, whatever handlers are set and restored there, and nothing is left when JUCE
/// closes its connection. To be called before a window is made; as often as one likes; does nothing on other systems.
/// [message]
void ignoreDisplayErrors();

} // namespace pacini::plugin
