#pragma once

// Texts with one place changed, for readers that are to find it.

#include "Catch.h"

#include <string>

namespace pacini::test
{

/// `text` with the first `from`, which must be there, replaced.
inline std::string changed(std::string text, const std::string& from, const std::string& to)
{
    const auto at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

} // namespace pacini::test
