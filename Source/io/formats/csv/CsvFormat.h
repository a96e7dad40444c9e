#pragma once

// Clips as comma-separated tables, for spreadsheets and scripts.

#include "io/formats/ClipFormat.h"

namespace pacini
{

[[nodiscard]] bool isCsv(std::string_view bytes);

/// Reads a table whose first line names its columns: `time` (s) and any of `envelope`, `centroid`, `amplitude L C H`
/// and `pitch L C H` (a band from L to H Hz with its centre at C), `noise L H`, `event` and `sharpness`; plain
/// `amplitude` and `frequency` are a band at 150 Hz. Cells may be empty; a row may have only a time, which makes the
/// clip longer. Lines end with LF or CRLF; `;` and tabs separate too; lines that start with `#` are skipped. Unknown
/// columns are left out with a warning. Errors: invalidData with a place such as `line 12, column 3`.
[[nodiscard]] Result<ImportedClip> readCsv(std::string_view bytes);

/// Writes all curves and events of the clip as they are; names, markers and parameters are lost.
[[nodiscard]] Result<ExportedClip> writeCsv(const Clip& clip, const ExportParams& params);

} // namespace pacini
