#include "io/ProfileFields.h"
#include "io/ProfileJson.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>

namespace pacini
{

namespace
{
using profileFields::Need;

/// Builds the text: entries of the profile and elements of lists on lines of their own, other objects on one line.
class Writer
{
public:
    std::string output = "{";

    void text(const char* name, std::string_view value)
    {
        key(name);
        string(value);
    }

    void number(const char* name, double value, Need)
    {
        key(name);
        // Minus zero would come back as an integer zero.
        fmt::format_to(std::back_inserter(output), "{}", value == 0.0 ? 0.0 : value);
    }

    void integer(const char* name, int value, const char* = nullptr) { number(name, value, Need::required); }

    void optionalNumber(const char* name, const std::optional<double>& value)
    {
        if (value)
            number(name, *value, Need::required);
    }

    template <typename E, typename Choices>
    void choice(const char* name, E value, const Choices& choices, Need)
    {
        key(name);
        string(profileFields::nameOf(value, choices));
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
    void list(const char* name, const List& values, const char*, Fields fields)
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

    void sources(const char* name, const ProfileSources& values)
    {
        if (values.empty())
            return;
        key(name);
        output += '{';
        for (const ProfileSource& source : values)
        {
            output += &source == values.data() ? "\n    " : ",\n    ";
            string(source.path);
            output += ": ";
            string(source.text);
        }
        output += "\n  }";
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
        using nlohmann::json;
        output += json(value).dump(-1, ' ', false, json::error_handler_t::replace);
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

    bool first = true;
    int depth = 0; ///< braces that are open inside those of the profile
};
} // namespace

std::string profileJson(const Profile& profile)
{
    Writer writer;
    writer.text("format", profileFormatName);
    writer.integer("version", profileFormatVersion);
    profileFields::visitFields(profile, writer);
    return std::move(writer.output) + "\n}\n";
}

} // namespace pacini
