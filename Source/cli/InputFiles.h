#pragma once

// Which files a command works on, and what its results are called.

#include <pacini/foundation/Result.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pacini::cli
{

/// One file to work on. `relative` is its path below the folder that the user named, or just its name.
struct InputFile
{
    std::filesystem::path path;
    std::filesystem::path relative;
};

/// An input that could not even be looked at.
struct InputFailure
{
    std::filesystem::path path;
    Error error;
};

struct InputFiles
{
    std::vector<InputFile> files; ///< in the order given; folders sorted by name
    std::vector<InputFailure> failures;
    bool several = false; ///< more than one path, or a folder, was named
};

/// Resolves files and folders, each file once; of a folder (with all below it) the files whose extension is in
/// `extensions` (lower case, with dot) count. Hidden files are passed over in folders, never when named.
[[nodiscard]] InputFiles findInputs(const std::vector<std::string>& named, const std::vector<std::string>& extensions);

/// The extensions of audio files that are looked for in folders.
[[nodiscard]] const std::vector<std::string>& audioExtensions();

/// The extensions of clips.
[[nodiscard]] const std::vector<std::string>& clipExtensions();

/// Where the result for `input` goes: beside it without `output`; into the folder `output` when it is one, ends in a
/// slash or several inputs were named; else to `output` itself. The extension is `extension` except in the last case.
/// Folders are made as needed, if `makeFolders`. Errors: io.
[[nodiscard]] Result<std::filesystem::path> outputFor(const InputFile& input, const std::string& output, bool several,
                                                      const std::string& extension, bool makeFolders = true);

/// The same for all ways of naming one file, whether it exists or not.
[[nodiscard]] std::filesystem::path sameFileKey(const std::filesystem::path& path);

/// The extension in lower case.
[[nodiscard]] std::string lowerExtension(const std::filesystem::path& path);

} // namespace pacini::cli
