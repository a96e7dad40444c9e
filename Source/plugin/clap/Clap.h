// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// CLAP's binary interface: its own headers where CMake was given them (PACINI_CLAP_DIR), or our declarations.

#ifdef PACINI_CLAP_HEADERS
#include <clap/clap.h>
#else
#include "plugin/clap/ClapDeclarations.h"
#endif

namespace pacini::plugin
{

/// The host's side of an extension; null if the host has none. Not before the plugin's init().
template <typename Extension>
[[nodiscard]] const Extension* extensionOf(const clap_host_t& host, const char* id) noexcept
{
    return host.get_extension == nullptr ? nullptr : static_cast<const Extension*>(host.get_extension(&host, id));
}

} // namespace pacini::plugin
