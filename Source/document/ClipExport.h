#pragma once

// Batch export: clips of a project into a folder, in one format.

#include "document/FilesInTheWay.h"
#include "io/formats/ClipFormat.h"

#include <pacini/clip/Clip.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace pacini
{

/// All formats that an export can choose: Pacini's two, the rendered drive signal, then every other that is written.
[[nodiscard]] const std::vector<ClipFormat>& exportFormats();

struct ExportChoice
{
    std::string format = "json"; ///< name of one of exportFormats()
    ExportParams params; ///< the rate of the drive signal is that of the clip's sound where none is given, or 8 kHz
    std::filesystem::path folder;               ///< existing
    std::filesystem::path file;                 ///< of a single clip, in `folder`; empty: the clip's name
    std::string mark;                           ///< stands behind each name, before the extension; empty: nothing does
    ProjectFileSet needed;                      ///< never replaced
    Replaceable replaceable = Replaceable::own; ///< `named` once the user has been asked
};

struct ExportReport
{
    std::string clip; ///< its name
    std::vector<std::filesystem::path> files;
    std::vector<FormatLoss> losses;
};

/// The file name that a clip gets: its name without what file systems refuse, and the extension; of a drive signal not
/// that of the recording, which the clip has its name from.
[[nodiscard]] std::string exportName(const Clip& clip, const ClipFormat& format);

/// The same export in further formats: events as each has them, and the name of the format as a mark where another has
/// the same extension. Formats that are named twice, or not known, are passed over.
[[nodiscard]] std::vector<ExportChoice> choicesFor(const ExportChoice& first, const std::vector<std::string>& further);

/// What exporting would lose, without writing anything. Errors: those of the format. [worker]
[[nodiscard]] Result<std::vector<FormatLoss>> exportLosses(const Clip& clip, const ExportChoice& choice);

/// What stands at the places of the files that exportClips() would write. Errors: those of the format and of
/// filesInTheWay(). [worker]
[[nodiscard]] Result<std::vector<StandingFile>> filesInTheWay(const std::vector<std::shared_ptr<const Clip>>& clips,
                                                              const ExportChoice& choice);

/// Writes every clip; names that several clips share get numbers. Errors: invalidArgument (no such format), those of
/// the format, of filesInTheWay(), of mayOverwrite() and of writing, with the clip's name where there are several; what
/// was written before stays. [worker]
[[nodiscard]] Result<std::vector<ExportReport>> exportClips(const std::vector<std::shared_ptr<const Clip>>& clips,
                                                            const ExportChoice& choice);

} // namespace pacini
