#pragma once

// Names of files that hold sounds, for folders and file dialogs.

#include <string>
#include <vector>

namespace pacini
{

/// Extensions of the files in which sounds are looked for, in lower case with their dot: sounds, and films whose sound
/// is read. A file of another name is a sound, too, where it is named itself: so are recordings named .ts, as
/// TypeScript is, and .iff, as pictures are.
[[nodiscard]] inline const std::vector<std::string>& audioExtensions()
{
    static const std::vector<std::string> extensions = {
        ".wav",  ".wave", ".aif",  ".aiff", ".aifc", ".flac", ".ogg",  ".oga", ".opus", ".mp3", ".caf",  ".w64",
        ".rf64", ".bwf",  ".au",   ".snd",  ".mp4",  ".m4v",  ".mov",  ".mkv", ".webm", ".avi", ".m4a",  ".mka",
        ".aac",  ".ac3",  ".3gp",  ".mpg",  ".m2ts", ".wma",  ".wmv",  ".asf", ".flv",  ".ogv", ".spx",  ".wv",
        ".ape",  ".tta",  ".amr",  ".dts",  ".eac3", ".mts",  ".mpeg", ".vob", ".mp2",  ".m4b", ".adts", ".ismv",
        ".3g2",  ".voc",  ".nist", ".avr",  ".8svx", ".paf",  ".sds",  ".wve", ".pvf"};
    return extensions;
}

} // namespace pacini
