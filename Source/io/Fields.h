#pragma once

// Field lists: the vocabulary in which the entries of a JSON document are listed, once for its reader and its writer.
//
// A list of fields is a function of a value and a visitor that names all entries of the value in the order of the
// file: visitor.number("time", point.time, Need::required). Visitors: FieldsHandler reads long documents (clips,
// scenes) as their text comes, FieldsReader small ones (profiles, projects, sweeps) from a tree, FieldsWriter writes
// both.

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace pacini
{

/// A name in the file for one value of an enumeration.
template <typename E>
struct Choice
{
    std::string_view name;
    E value;
};

/// The name of `value` in a file.
template <typename E, typename Choices>
[[nodiscard]] constexpr std::string_view nameOf(E value, const Choices& choices) noexcept
{
    for (const auto& choice : choices)
        if (choice.value == value)
            return choice.name;
    return {};
}

/// The value of that name; none for other names.
template <typename E, std::size_t count>
[[nodiscard]] constexpr std::optional<E> valueOf(std::string_view name, const std::array<Choice<E>, count>& choices)
{
    for (const auto& choice : choices)
        if (choice.name == name)
            return choice.value;
    return std::nullopt;
}

/// Name and version of a document, as in its entries `format` and `version`.
struct DocumentFormat
{
    std::string_view name;
    int version;
    std::string_view noun = {}; ///< "a clip", for messages
    bool whole = false;         ///< a version with a fraction is none rather than a newer one
};

/// Whether an entry is required; other missing entries keep the default of their struct.
enum class Need
{
    required,
    usual,   ///< may be missing, but is always written
    optional ///< an object or a list that is not written when it equals its default, or a number when it is 0
};

/// Whether a visitor fills the values that it is shown.
template <typename Visitor>
inline constexpr bool isReader = requires
{
    Visitor::reads;
};

/// Numbers that are needed alike: name, value, name, value and so on.
template <typename Visitor, typename Number, typename... Rest>
void visitNumbers(Visitor& visitor, Need need, const char* name, Number& value, Rest&... rest)
{
    visitor.number(name, value, need);
    if constexpr (sizeof...(rest) > 0)
        visitNumbers(visitor, need, rest...);
}

} // namespace pacini
