// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Streams of a CLAP host, which take and give as much at a time as they like.

#include "plugin/clap/Clap.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace pacini::plugin
{

/// Writes all of it. False where the stream fails, or takes no more.
bool writeAll(const clap_ostream_t& stream, std::string_view bytes);

/// Reads up to the end. None where the stream fails, or has more than `most` bytes.
[[nodiscard]] std::optional<std::string> readAll(const clap_istream_t& stream, std::size_t most);

/// The extension `clap.state`: the same bytes as in the other formats.
[[nodiscard]] const clap_plugin_state_t& stateExtension() noexcept;

} // namespace pacini::plugin
