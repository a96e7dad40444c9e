#pragma once

// The picture of an address that phones read, as squares.

#include <cstddef>
#include <string>
#include <vector>

namespace pacini::phone
{

/// Rows of modules, true for dark, without the quiet border of 4 that they need around them.
using QrModules = std::vector<std::vector<bool>>;

/// ISO/IEC 18004 with medium error correction; empty where Pacini was built without a library for it. [any]
[[nodiscard]] QrModules qrModules(const std::string& text);

/// For terminals, two rows of modules a line, with the border; light on dark unless that is `inverted`. [any]
[[nodiscard]] std::string qrText(const QrModules& modules, bool inverted = false);

/// As an SVG with the border, dark on white; empty for no modules. [any]
[[nodiscard]] std::string qrSvg(const QrModules& modules);

} // namespace pacini::phone
