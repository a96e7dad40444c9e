#pragma once

// Where readers find what is wrong.

#include "Catch.h"

#include <pacini/foundation/Result.h>

#include <string>

namespace pacini::test
{

/// The place in the error of a result that must be one, with a message.
template <typename Value>
std::string refusedAt(const Result<Value>& result)
{
    REQUIRE_FALSE(result.ok());
    CHECK_FALSE(result.error().message.empty());
    return result.error().where;
}

} // namespace pacini::test
