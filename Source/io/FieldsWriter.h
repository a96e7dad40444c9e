#pragma once

// Writes a value as a JSON document by the table of its entries.

#include "io/Fields.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pacini
{

/// Builds the text: entries of the document and elements of lists on lines of their own, other objects on one line.
class FieldsWriter
{
public:
    /// Starts a document with its format and version.
    FieldsWriter(std::string_view format, int version)
    {
        text("format", format);
        integer("version", version);
    }

    /// The finished document.
    [[nodiscard]] std::string document() && { return std::move(output) + "\n}\n"; }

    void text(const char* name, std::string_view value)
    {
        key(name);
        string(value);
    }

    void optionalText(const char* name, std::string_view value)
    {
        if (!value.empty())
            text(name, value);
    }

    void number(const char* name, double value, Need)
    {
        key(name);
        // Minus zero would come back as an integer zero.
        fmt::format_to(std::back_inserter(output), "{}", value == 0.0 ? 0.0 : value);
    }

    void integer(const char* name, int value, const char* = nullptr) { number(name, value, Need::required); }

    void truth(const char* name, bool value)
    {
        key(name);
        output += value ? "true" : "false";
    }

    /// A value that is JSON already.
    void json(const char* name, std::string_view value)
    {
        key(name);
        output += value;
    }

    void optionalNumber(const char* name, const std::optional<double>& value)
    {
        if (value)
            number(name, *value, Need::required);
    }

    template <typename E, typename Choices>
    void choice(const char* name, E value, const Choices& choices, Need)
    {
        key(name);
        string(nameOf(value, choices));
    }

    template <typename T, typename Fields>
    void object(const char* name, const T& value, Need need, Fields fields)
    {
        if (need == Need::optional && value == T{})
            return;
        key(name);
        braces([&] { fields(value); });
    }

    template <typename T, typename Fields>
    void optionalObject(const char* name, const std::optional<T>& value, Fields fields)
    {
        if (!value)
            return;
        key(name);
        braces([&] { fields(*value); });
    }

    template <typename List, typename Fields>
    void list(const char* name, const List& values, std::size_t, const char*, Fields fields)
    {
        if (values.empty())
            return;
        key(name);
        output += '[';
        for (const auto& value : values)
        {
            output += &value == &*values.begin() ? "" : ",";
            lineBreak(depth + 2);
            braces([&] { fields(value); });
        }
        lineBreak(depth + 1);
        output += ']';
    }

    void numbers(const char* name, const std::vector<double>& values, std::size_t)
    {
        key(name);
        output += fmt::format("[{}]", fmt::join(values, ", "));
    }

    template <typename Texts>
    void texts(const char* name, const Texts& values)
    {
        if (values.empty())
            return;
        key(name);
        output += '{';
        bool isFirst = true;
        for (const auto& [inner, value] : values)
        {
            output += std::exchange(isFirst, false) ? "" : ",";
            lineBreak(depth + 2);
            string(inner);
            output += ": ";
            string(value);
        }
        lineBreak(depth + 1);
        output += '}';
    }

private:
    void key(const char* name)
    {
        output += first ? "" : ",";
        if (depth > 0)
            output += ' ';
        else
            lineBreak(1);
        first = false;
        string(name);
        output += ": ";
    }

    void string(std::string_view value)
    {
        using Json = nlohmann::json;
        output += Json(value).dump(-1, ' ', false, Json::error_handler_t::replace);
    }

    template <typename Fields>
    void braces(Fields fields)
    {
        output += '{';
        ++depth;
        first = true;
        fields();
        first = false;
        --depth;
        output += " }";
    }

    void lineBreak(int steps)
    {
        output += '\n';
        output.append(2 * static_cast<std::size_t>(steps), ' ');
    }

    std::string output = "{";
    bool first = true;
    int depth = 0; ///< braces that are open inside those of the document
};

} // namespace pacini
