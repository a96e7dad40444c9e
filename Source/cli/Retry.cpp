#include "cli/Retry.h"

#include "cli/Manifest.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace pacini::cli
{

namespace
{
/// A manifest is a file that others may have written: it can name none but those that only read and encode.
constexpr std::array<std::string_view, 3> retriable{"encode", "render", "compare"};
} // namespace

std::optional<std::vector<std::string>> retriedCommand(const std::vector<std::string>& words)
{
    constexpr std::size_t first = 3; // after pacini manifest retry
    if (words.size() <= first || words[1] != "manifest" || words[2] != "retry" || words[first].starts_with('-'))
        return std::nullopt;
    const auto manifest = readManifest(words[first]);
    if (!manifest || std::find(retriable.begin(), retriable.end(), manifest->command) == retriable.end())
        return std::nullopt;
    std::vector<std::string> line{words.front(), manifest->command};
    line.insert(line.end(), manifest->arguments.begin(), manifest->arguments.end());
    line.push_back("--manifest=" + words[first]);
    line.emplace_back("--retry");
    line.insert(line.end(), words.begin() + first + 1, words.end());
    return line;
}

} // namespace pacini::cli
