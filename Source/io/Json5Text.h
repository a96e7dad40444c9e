#pragma once

// Converter of JSON5, a JSON with comments and fewer quotes, to strict JSON.

#include <pacini/foundation/Result.h>

#include <cstddef>
#include <string>
#include <string_view>

namespace pacini
{

/// The strict JSON (RFC 8259) of a JSON5 text (json5.org, version 1.0.0): comments go, names get quotes, strings double
/// ones, trailing commas go, numbers are written in decimal. Infinity and NaN, which JSON cannot say, are refused.
/// Errors: invalidData with `line 3, column 17` of the JSON5 text (columns count characters) for wrong syntax,
/// ill-formed UTF-8, a number of more than 400 characters or 16 hexadecimal digits; tooLarge for more than
/// `maximumBytes` or deeper than deepestJson. Time and memory grow with the length of the text.
[[nodiscard]] Result<std::string> jsonFromJson5(std::string_view text, std::size_t maximumBytes);

} // namespace pacini
