#pragma once

// Batch export: clips of a project into a folder, in one format.

#include "io/formats/ClipFormat.h"

#include <pacini/actuator/Profile.h>
#include <pacini/clip/Clip.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// A format that an export can choose.
struct ExportFormat
{
    std::string name;      ///< of a ClipFormat, or `wav`
    std::string title;     ///< for people
    std::string extension; ///< with dot
    bool rendered = false; ///< samples, whose rate can be chosen
};

/// All formats: Pacini's two, rendered WAV, then every foreign one that can be written.
[[nodiscard]] const std::vector<ExportFormat>& exportFormats();

/// What a format keeps of any clip, in a sentence or two.
[[nodiscard]] std::string_view whatIsKept(std::string_view format);

struct ExportChoice
{
    std::string format = "json";            ///< name of an ExportFormat
    std::optional<int> sampleRate;          ///< Hz, of rendered formats; none: the rate of the clip's sound, or 8 kHz
    std::shared_ptr<const Profile> profile; ///< null: none
    std::filesystem::path folder;           ///< existing
    std::filesystem::path file;             ///< of a single clip, in `folder`; empty: the clip's name
};

struct ExportReport
{
    std::string clip; ///< its name
    std::vector<std::filesystem::path> files;
    std::vector<FormatLoss> losses;
};

/// The file name that a clip gets: its name without what file systems refuse, and the extension; of a drive signal not
/// that of the recording, which the clip has its name from.
[[nodiscard]] std::string exportName(const Clip& clip, const ExportFormat& format);

/// What exporting would lose, without writing anything. Errors: those of the format. [worker]
[[nodiscard]] Result<std::vector<FormatLoss>> exportLosses(const Clip& clip, const ExportChoice& choice);

/// Writes every clip; names that several clips share get numbers. Errors: invalidArgument (no such format), those of
/// the format and of writing, with the clip's name where there are several; what was written before stays. [worker]
[[nodiscard]] Result<std::vector<ExportReport>> exportClips(const std::vector<std::shared_ptr<const Clip>>& clips,
                                                            const ExportChoice& choice);

} // namespace pacini
