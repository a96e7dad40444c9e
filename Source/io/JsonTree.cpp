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

} // namespace pacini
