#pragma once

// Files of annotated onsets, as JSON or plain text.

#include "io/FoundMarkers.h"

#include <pacini/foundation/Result.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// Onset times in seconds, ascending, of one sound or of several.
struct Onsets
{
    std::map<std::string, std::vector<double>> byFile; ///< by the sound's file name, without folders
    std::vector<double> ofAny;                         ///< when the file names no sounds
    bool namesFiles = false;                           ///< byFile is meant, not ofAny

    /// The onsets of a sound: by its file name, else by its name without extension. Null when it is not named.
    [[nodiscard]] const std::vector<double>* find(const std::filesystem::path& sound) const;
};

/// Reads `{"door.wav": [0.12, 0.8], ...}`, a list `[0.12, 0.8]`, or text with one time per line, see forEachTimeLine().
/// Errors: invalidData for other content, with its place, for times below 0 and for UTF-16; those of parseJson.
[[nodiscard]] Result<Onsets> readOnsetText(std::string_view text);

/// The same from a file of at most 64 MB. Errors also: io.
[[nodiscard]] Result<Onsets> readOnsets(const std::filesystem::path& path);

/// The lines of such a text (not JSON) as markers, in order, each called by its label; one without is called by its
/// number. A warning tells how many have an end that
/// is not their start, which markers have no place for. A cue sheet is one, too (see readCueSheet()). Errors: those of
/// readOnsetText().
[[nodiscard]] Result<FoundMarkers> readLabelText(std::string_view text);

/// The same from a file of at most 64 MB. Errors also: io.
[[nodiscard]] Result<FoundMarkers> readLabels(const std::filesystem::path& path);

} // namespace pacini
