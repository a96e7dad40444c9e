#pragma once

// JSON clips, Pacini's own format to read and edit (see ClipJson.h).

#include "io/formats/ClipFormat.h"

namespace pacini
{

/// Whether a text starts as JSON, be it UTF-16, which is refused by the reader.
[[nodiscard]] bool looksLikeJson(std::string_view bytes);

/// Whether it also says that it is a clip of Pacini: its format is the first thing that one says.
[[nodiscard]] bool isClipJson(std::string_view bytes);

/// Errors: those of readClipJson().
[[nodiscard]] Result<ImportedClip> readClipJsonFile(std::string_view bytes, bool strict);

void streamClipJson(Clip clip, const ClipFormat::PieceSink& sink);

} // namespace pacini
