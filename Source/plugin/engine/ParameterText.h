// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Conversion of parameter values: to text as people read and type it, and to 0 to 1 as hosts store it.

#include "plugin/engine/ParameterTable.h"

#include <optional>
#include <string>
#include <string_view>

namespace pacini::plugin
{

/// The place of `value` on the way of a control, 0 to 1; values outside their range count as its ends, NaN as `low`.
[[nodiscard]] double normalOf(const ParameterRow& row, double value) noexcept;

/// The value at a place; whole where only whole ones count. normalOf(valueAt(n)) is n within rounding.
[[nodiscard]] double valueAt(const ParameterRow& row, double normal) noexcept;

/// Returns a text such as `-12.5 dB`, `8.0 ms`, `50 %`, `On`. The same in every language: a decimal point, no thousands
/// separators.
[[nodiscard]] std::string textOf(const ParameterRow& row, double value);

/// Parses typed text: with or without unit, with point or comma, `1.5 s` for 1500 ms, a choice by its name or the
/// beginning of it. None for invalid text or values out of range.
[[nodiscard]] std::optional<double> valueOf(const ParameterRow& row, std::string_view text);

} // namespace pacini::plugin
