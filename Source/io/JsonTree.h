#pragma once

// Tree parser of small JSON documents, as strict as that of clips.

#include "io/JsonText.h"

#include <pacini/foundation/Result.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini
{

/// Puts the values that parseJson() finds into a tree.
class JsonTreeBuilder : public JsonHandler
{
public:
    /// The library says that its null cannot fail, and makes it by a constructor that may.
    JsonTreeBuilder() noexcept(false) = default;

    nlohmann::json root;

    bool openObject() override { return open(nlohmann::json::object()); }
    bool openList() override { return open(nlohmann::json::array()); }
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
    nlohmann::json* put(nlohmann::json value)
    {
        if (parents.empty())
            return &(root = std::move(value));
        nlohmann::json& parent = *parents.back();
        if (parent.is_object())
            return &(parent[nextKey] = std::move(value));
        parent.push_back(std::move(value));
        return &parent.back();
    }
    bool add(nlohmann::json value)
    {
        put(std::move(value));
        return true;
    }
    bool open(nlohmann::json value)
    {
        parents.push_back(put(std::move(value)));
        return true;
    }

    std::vector<nlohmann::json*> parents;
    std::string nextKey;
};

/// The tree of `text`; for documents that are small and looked up by name. Errors as in parseJson(), and invalidData
/// with its path for a name that an object has twice.
[[nodiscard]] Result<nlohmann::json> readJsonTree(std::string_view text, std::size_t maximumBytes);

/// The same for a document that must be an object; for others invalidData with `otherwise`.
[[nodiscard]] Result<nlohmann::json> readJsonObject(std::string_view text, std::size_t maximumBytes,
                                                    std::string_view otherwise);

} // namespace pacini
