#pragma once

// Packed clips, Pacini's own small format: quantised and entropy coded (see PackedClip.h).

#include "io/formats/ClipFormat.h"

namespace pacini
{

[[nodiscard]] bool isPackedClip(std::string_view bytes);

/// Errors: those of unpackClip().
[[nodiscard]] Result<ImportedClip> readPackedClip(std::string_view bytes);

/// On the grids that packParamsFor() finds.
void streamPackedClip(Clip clip, const ClipFormat::PieceSink& sink);

} // namespace pacini
