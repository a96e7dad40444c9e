#pragma once

// A loss of a clip as a line for people.

#include "io/formats/ClipFormat.h"

#include <string>

namespace pacini::cli
{

/// Whether errors of this kind are seconds.
[[nodiscard]] bool isTime(LossKind kind);

/// "door.json:    0.250 s  +0.100  frequency    0.25 octaves  ...": where, what, how large and why.
[[nodiscard]] std::string lossLine(const std::string& file, const FormatLoss& loss);

} // namespace pacini::cli
