#include "io/formats/ForeignText.h"

#include "io/JsonTree.h"
#include "io/TextMark.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pacini
{

Result<std::string_view> foreignText(std::string_view bytes, std::vector<std::string>& warnings)
{
    if (bytes.size() > largestForeignText)
        return Error{ErrorCode::tooLarge, "", "is longer than 64 MiB"};
    auto text = utf8Text(bytes);
    if (text && text->size() < bytes.size())
        warnings.push_back("line 1, column 1: the byte order mark is ignored");
    return text;
}

Result<nlohmann::json> readForeignTree(std::string_view bytes, std::vector<std::string>& warnings)
{
    const auto text = foreignText(bytes, warnings);
    if (!text)
        return text.error();
    auto tree = readJsonTree(*text, largestForeignText);
    if (tree && !tree->is_object())
        return Error{ErrorCode::invalidData, "", "is not an object in braces"};
    return tree;
}

std::string_view wholeCharacters(std::string_view text, std::size_t most)
{
    std::size_t bytes = std::min(text.size(), most);
    while (bytes > 0 && bytes < text.size() && (static_cast<unsigned char>(text[bytes]) & 0xC0u) == 0x80u)
        --bytes;
    return text.substr(0, bytes);
}

std::string importedName(std::string_view name)
{
    return std::string(wholeCharacters(name, limits::text / 2));
}

std::string identifierOf(std::string_view text)
{
    std::string name;
    for (const char c : text)
    {
        const bool upper = c >= 'A' && c <= 'Z';
        const bool digit = c >= '0' && c <= '9';
        if (upper || digit || (c >= 'a' && c <= 'z'))
            name += upper ? static_cast<char>(c - 'A' + 'a') : c;
        else if (!name.empty() && name.back() != '_')
            name += '_';
    }
    while (!name.empty() && name.back() == '_')
        name.pop_back();
    if (name.empty())
        return "clip";
    return name.front() >= '0' && name.front() <= '9' ? "clip_" + name : name;
}

std::string nameOfClip(const Clip& clip, std::string_view wanted)
{
    for (const std::string_view name : {wanted, std::string_view(clip.name), std::string_view(clip.source.file)})
        if (!name.empty())
            return std::string(name);
    return "clip";
}

} // namespace pacini
