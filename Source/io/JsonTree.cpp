#include "io/JsonTree.h"

#include <utility>

namespace pacini
{

Result<nlohmann::json> readJsonTree(std::string_view text, std::size_t maximumBytes)
{
    JsonTreeBuilder tree;
    if (auto parsed = parseJson(text, tree, maximumBytes); !parsed)
        return parsed.error();
    return std::move(tree.root);
}

Result<nlohmann::json> readJsonObject(std::string_view text, std::size_t maximumBytes, std::string_view otherwise)
{
    auto tree = readJsonTree(text, maximumBytes);
    if (tree && !tree->is_object())
        return Error{ErrorCode::invalidData, "", std::string(otherwise)};
    return tree;
}

} // namespace pacini
