#pragma once

// Text helpers that readers and writers of other programs' formats share.

#include "io/JsonText.h"
#include "io/formats/ClipFormat.h"

#include <pacini/clip/Clip.h>
#include <pacini/foundation/Result.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pacini
{

/// Longer files are refused: an hour of dense keyframes is a tenth of it.
inline constexpr std::size_t largestForeignText = std::size_t(64) << 20;

/// `bytes` without a byte order mark of UTF-8, which some editors put first; a warning says so. Errors: invalidData
/// for UTF-16, tooLarge.
[[nodiscard]] Result<std::string_view> foreignText(std::string_view bytes, std::vector<std::string>& warnings);

/// The tree of a JSON file. Errors: as in foreignText() and readJsonTree().
[[nodiscard]] Result<nlohmann::json> readForeignTree(std::string_view bytes, std::vector<std::string>& warnings);

/// Result of `read(tree, clip)` for a JSON file; `read` fills the clip and its warnings, and returns an error or
/// nothing. Errors: those of readForeignTree(), `read` and validate().
template <typename Read>
[[nodiscard]] Result<ImportedClip> importForeign(std::string_view bytes, Read read)
{
    ImportedClip imported;
    const auto tree = readForeignTree(bytes, imported.warnings);
    if (!tree)
        return tree.error();
    if (std::optional<Error> error = read(*tree, imported))
        return *std::move(error);
    if (auto valid = validate(imported.clip); !valid)
        return valid.error();
    return imported;
}

/// The first characters of `text` that have `most` bytes or fewer.
[[nodiscard]] std::string_view wholeCharacters(std::string_view text, std::size_t most);

/// `name` as that of a clip: whole characters up to half of what all its texts may have.
[[nodiscard]] std::string importedName(std::string_view name);

/// A name for code made of `text`: letters, digits and underscores in snake case, not starting with a digit; `clip`
/// when nothing is left.
[[nodiscard]] std::string identifierOf(std::string_view text);

/// `wanted` when it says something, else the clip's own name, else that of its sound, else `clip`.
[[nodiscard]] std::string nameOfClip(const Clip& clip, std::string_view wanted);

/// `list` of numbers, `write(x)` each, in lines of `perLine` after `indent`.
template <typename List, typename Write>
[[nodiscard]] std::string numbersInLines(const List& list, std::size_t perLine, Write write,
                                         std::string_view indent = "    ")
{
    std::string text;
    std::size_t i = 0;
    for (const auto& value : list)
    {
        if (i > 0)
            text += i % perLine == 0 ? "," : ", ";
        if (i % perLine == 0)
            text.append("\n").append(indent);
        text += write(value);
        ++i;
    }
    return text;
}

} // namespace pacini
