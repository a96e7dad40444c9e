// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Groups of parameters, for hosts that show them so.

#include <span>
#include <string_view>

namespace pacini::plugin
{

struct ParameterGroup
{
    std::string_view symbol, name;
    std::span<const std::string_view> ids; ///< beginnings of the ids of its parameters
};

[[nodiscard]] std::span<const ParameterGroup> parameterGroups() noexcept;

/// The group of a parameter: that with the longest of the beginnings.
[[nodiscard]] const ParameterGroup& groupOf(std::string_view id) noexcept;

} // namespace pacini::plugin
