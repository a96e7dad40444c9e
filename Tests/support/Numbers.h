#pragma once

// Several values compared at once, such as the defaults of parameters.

#include <vector>

namespace pacini::test
{

using Numbers = std::vector<double>;

/// `values` as numbers; false is 0, true 1.
template <typename... Values>
[[nodiscard]] Numbers asNumbers(Values... values)
{
    return {static_cast<double>(values)...};
}

} // namespace pacini::test
