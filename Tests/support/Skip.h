#pragma once

// Tests that cannot be made where they run: said aloud, never passed over.

#include <string_view>

namespace pacini::test
{

/// Prints that the rest of the running test is left out, and why; the test itself then returns. Unless something
/// failed, the program ends with 77, which ctest lists as skipped and CI refuses.
void skip(std::string_view why);

} // namespace pacini::test
