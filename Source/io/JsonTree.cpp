#include "io/JsonTree.h"

#include "io/JsonText.h"

#include <string>
#include <utility>
#include <vector>

namespace pacini
{

namespace
{
using Json = nlohmann::json;

class TreeBuilder : public JsonHandler
{
public:
    Json root;

    bool openObject() override { return open(Json::object()); }
    bool openList() override { return open(Json::array()); }
    bool close() override
    {
        // A list may move its elements as it grows, but only after those inside it are complete.
        parents.pop_back();
        return true;
    }
    bool key(std::string_view name) override
    {
        nextKey = name;
        return !parents.back()->contains(nextKey) || stop(ErrorCode::invalidData, "is given twice");
    }
    bool number(double value) override { return add(value); }
    bool text(std::string& value) override { return add(std::move(value)); }
    bool truth(bool value) override { return add(value); }
    bool null() override { return add(nullptr); }

private:
    Json* put(Json value)
    {
        if (parents.empty())
            return &(root = std::move(value));
        Json& parent = *parents.back();
        if (parent.is_object())
            return &(parent[nextKey] = std::move(value));
        parent.push_back(std::move(value));
        return &parent.back();
    }
    bool add(Json value)
    {
        put(std::move(value));
        return true;
    }
    bool open(Json value)
    {
        parents.push_back(put(std::move(value)));
        return true;
    }

    std::vector<Json*> parents;
    std::string nextKey;
};
} // namespace

Result<nlohmann::json> readJsonTree(std::string_view text, std::size_t maximumBytes)
{
    TreeBuilder tree;
    if (auto parsed = parseJson(text, tree, maximumBytes); !parsed)
        return parsed.error();
    return std::move(tree.root);
}

} // namespace pacini
