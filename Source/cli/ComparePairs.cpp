#include "cli/ComparePairs.h"

#include "io/ClipFile.h"

#include <map>
#include <set>
#include <system_error>
#include <utility>

namespace pacini::cli
{

namespace fs = std::filesystem;

namespace
{
using FilesByStem = std::map<std::string, std::vector<fs::path>>;

std::string stemOf(const InputFile& file)
{
    return fs::path(file.relative).replace_extension().generic_string();
}

FilesByStem byStem(const InputFiles& found)
{
    FilesByStem files;
    for (const InputFile& file : found.files)
        files[stemOf(file)].push_back(file.path);
    return files;
}

/// The one file of this stem.
Result<fs::path> counterpart(const FilesByStem& files, const std::string& stem, const std::string& folder)
{
    const auto found = files.find(stem);
    if (found == files.end())
        return Error{ErrorCode::invalidData, "", "has no counterpart " + stem + ".* in " + folder};
    if (found->second.size() > 1)
        return Error{ErrorCode::invalidData, "",
                     "has two counterparts, " + found->second[0].string() + " and " + found->second[1].string() +
                         "; remove one of them"};
    return found->second.front();
}

/// Adds the clips of a folder where no sound has their name: a sound that was rendered from a clip is compared.
void addClips(InputFiles& sounds, const std::string& folder)
{
    const FilesByStem rendered = byStem(sounds);
    for (InputFile& clip : findInputs({folder}, clipFileExtensions()).files)
        if (!rendered.contains(stemOf(clip)))
            sounds.files.push_back(std::move(clip));
}
} // namespace

Result<ComparePairs> pairFiles(const std::string& reference, const std::string& candidate, const std::string& events)
{
    std::error_code ignored;
    const auto isFolder = [&](const std::string& path)
    {
        return fs::is_directory(path, ignored);
    };
    const bool folders = isFolder(reference);
    for (const std::string& other : {candidate, events})
        if (!other.empty() && isFolder(other) != folders)
            return Error{ErrorCode::invalidArgument, "",
                         folders ? reference + " is a folder and " + other + " is not; name two files or two folders"
                                 : other + " is a folder and " + reference + " is not; name two files or two folders"};
    ComparePairs result;
    if (!folders)
    {
        result.pairs.push_back({fs::path(reference).filename(), reference, candidate, events});
        return result;
    }

    const InputFiles references = findInputs({reference}, audioExtensions());
    InputFiles candidates = findInputs({candidate}, audioExtensions());
    addClips(candidates, candidate);
    const InputFiles clips = events.empty() ? InputFiles{} : findInputs({events}, clipFileExtensions());
    for (const InputFiles* found : {&references, &std::as_const(candidates), &clips})
        for (const InputFailure& failure : found->failures)
            result.failures.push_back({failure, failure.path.generic_string()});
    const FilesByStem candidatesByStem = byStem(candidates);
    const FilesByStem clipsByStem = byStem(clips);
    std::set<std::string> used;
    for (const InputFile& file : references.files)
    {
        const std::string stem = stemOf(file);
        used.insert(stem);
        const auto match = counterpart(candidatesByStem, stem, candidate);
        const auto clip = events.empty() ? Result<fs::path>(fs::path()) : counterpart(clipsByStem, stem, events);
        if (match && clip)
            result.pairs.push_back({file.relative, file.path, *match, *clip});
        else
            result.failures.push_back(
                {{file.path, match ? clip.error() : match.error()}, file.relative.generic_string()});
    }
    for (const InputFile& file : candidates.files)
        if (!used.contains(stemOf(file)))
            result.leftOver.push_back(file.path);
    return result;
}

} // namespace pacini::cli
