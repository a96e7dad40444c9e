#pragma once

// Input files of a command, and the paths of its results.

#include "io/AudioExtensions.h"

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
/// `extensions` (lower case, with dot) count. Hidden files and records of conversions are passed over in folders. `-`
/// is standard input.
[[nodiscard]] InputFiles findInputs(const std::vector<std::string>& named, const std::vector<std::string>& extensions);

/// Whether `output`, which is not empty, is or is to be a folder.
[[nodiscard]] bool namesFolder(const std::string& output);

/// Naming of results.
struct OutputNames
{
    std::string given;     ///< file or folder that the user named; may be empty
    std::string extension; ///< of results in a folder of their own
    std::string beside;    ///< of results in the folder of their inputs
};

/// Path of one result.
struct OutputPlace
{
    std::filesystem::path path;
    bool named = false; ///< the user named this very file
};

/// Returns the path of the result for `input`: beside it without a given output; in the given folder, if it is one,
/// ends in a slash or several inputs were named; else the given path itself. Creates folders as needed, if
/// `makeFolders`. Errors: io.
[[nodiscard]] Result<OutputPlace> outputFor(const InputFile& input, const OutputNames& names, bool several,
                                            bool makeFolders = true);

/// Checks that `output` can receive the results for these inputs, with or without a JSON report on standard output.
/// Errors: invalidArgument, with advice.
[[nodiscard]] Result<void> checkOutput(const InputFiles& inputs, const std::string& output, bool json);

} // namespace pacini::cli
