#pragma once

// Small JSON documents that are one object of fields.

#include "io/FieldsReader.h"
#include "io/JsonTree.h"
#include "io/ReadWarnings.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace pacini
{

/// A kind of document.
struct DocumentKind
{
    std::string_view what; ///< "a profile"
    std::string_view format;
    int version;
    std::size_t largest; ///< bytes
};

/// Reads a document: `visit(value, reader)` visits its fields. Errors as in readJsonObject() and FieldsReader. What the
/// value must be beyond that, the caller checks.
template <typename Value, typename Visit>
[[nodiscard]] Result<Value> readDocument(std::string_view text, const DocumentKind& kind, ReadWarnings* warnings,
                                         Visit visit)
{
    const auto document =
        readJsonObject(text, kind.largest, "is not " + std::string(kind.what) + ", as it is not a JSON object");
    if (!document)
        return document.error();
    FieldsReader reader(*document, warnings);
    reader.format(kind.format, kind.version);
    Value value{};
    visit(value, reader);
    reader.finish();
    if (reader.error)
        return *reader.error;
    return value;
}

/// The value, or what validate() says against it.
template <typename Value>
[[nodiscard]] Result<Value> validated(Result<Value> value)
{
    if (value)
        if (auto valid = validate(*value); !valid)
            return valid.error();
    return value;
}

} // namespace pacini
