#pragma once

// Small JSON documents as trees, read as strictly as clips are.

#include <pacini/foundation/Result.h>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string_view>

namespace pacini
{

/// The tree of `text`; for documents that are small and looked up by name. Errors as in parseJson(), and invalidData
/// with its path for a name that an object has twice.
[[nodiscard]] Result<nlohmann::json> readJsonTree(std::string_view text, std::size_t maximumBytes);

} // namespace pacini
