// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Entry of the plugin, for JUCE's wrappers.

namespace pacini::plugin
{

class PluginProcessor;

/// The plugin that a wrapper made last on this thread, and owns; null before the first one.
[[nodiscard]] PluginProcessor* newestPlugin() noexcept;

} // namespace pacini::plugin
