#pragma once

// JSON look-up for the readers of foreign formats: entries by name, each wrong one with its place.

#include "io/JsonText.h"

#include <pacini/foundation/ParseNumber.h>
#include <pacini/foundation/Result.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

namespace pacini
{

/// An entry of a document and its path. Lookups on an entry that is missing or of the wrong type remember the first
/// error and give an empty entry, so that a reader can go on and look once.
class JsonEntry
{
public:
    JsonEntry(const nlohmann::json* json, std::string path, std::optional<Error>& firstError)
        : value(json), where(std::move(path)), error(&firstError)
    {
    }

    [[nodiscard]] bool exists() const noexcept { return value != nullptr; }
    [[nodiscard]] bool isText() const noexcept { return value != nullptr && value->is_string(); }
    [[nodiscard]] const std::string& path() const noexcept { return where; }

    void fail(std::string message, ErrorCode code = ErrorCode::invalidData) const
    {
        if (!*error)
            *error = Error{code, where, std::move(message)};
    }

    /// The member of an object; missing ones and null are empty entries.
    [[nodiscard]] JsonEntry optional(std::string_view name) const
    {
        JsonEntry entry = member(name);
        if (entry.value != nullptr && entry.value->is_null())
            entry.value = nullptr;
        return entry;
    }

    /// The member of an object, which must be there.
    [[nodiscard]] JsonEntry required(std::string_view name) const
    {
        JsonEntry entry = member(name);
        if (!entry.exists())
            entry.fail("is missing");
        return entry;
    }

    /// Calls visit(element) for each element of a list, until there is an error.
    template <typename Visit>
    void forEach(Visit visit) const
    {
        if (value == nullptr)
            return;
        if (!value->is_array())
            return fail("must be a list in brackets");
        for (std::size_t i = 0; i < value->size() && !*error; ++i)
            visit(JsonEntry(&(*value)[i], fmt::format("{}[{}]", where, i), *error), i);
    }

    /// Elements of a list; 0 for anything else.
    [[nodiscard]] std::size_t size() const noexcept
    {
        return value != nullptr && value->is_array() ? value->size() : 0;
    }

    [[nodiscard]] double number(double otherwise = 0.0) const
    {
        if (value == nullptr)
            return otherwise;
        if (value->is_number())
            return value->get<double>();
        fail("must be a number");
        return otherwise;
    }

    /// The same, also of a number in quotes.
    [[nodiscard]] double numberOrText() const
    {
        if (!isText())
            return number();
        const auto read = parseNumber(value->get_ref<const std::string&>());
        if (!read || !std::isfinite(*read))
            fail("must be a number");
        return read.value_or(0.0);
    }

    [[nodiscard]] std::string text() const
    {
        if (value == nullptr)
            return {};
        if (value->is_string())
            return value->get<std::string>();
        fail("must be a text in quotes");
        return {};
    }

private:
    [[nodiscard]] JsonEntry member(std::string_view name) const
    {
        const std::string path = where.empty() ? std::string(name) : fmt::format("{}.{}", where, name);
        if (value == nullptr)
            return {nullptr, path, *error};
        if (!value->is_object())
        {
            fail("must be an object in braces");
            return {nullptr, path, *error};
        }
        const auto found = value->find(name);
        return {found == value->end() ? nullptr : &*found, path, *error};
    }

    const nlohmann::json* value;
    std::string where;
    std::optional<Error>* error;
};

} // namespace pacini
