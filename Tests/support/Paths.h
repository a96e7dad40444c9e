#pragma once

// Where the sources, the tests and the command under test lie. Defined in a file of their own, so that no other object
// file depends on the folder of the checkout: a compiler cache then serves every checkout.

#include <filesystem>

namespace pacini
{

// The top of the repository.
std::filesystem::path sourceFolder();

// Its folder `Tests`.
std::filesystem::path testFolder();

// The program `pacini` that was built beside the tests; empty in test programs that do not run it.
std::filesystem::path paciniCommand();

} // namespace pacini
