#pragma once

// SHA-256 fingerprints of files, the same as `sha256sum` prints.

#include <string>
#include <string_view>

namespace pacini
{

/// The SHA-256 of `bytes` as 64 hexadecimal digits (FIPS 180-4, "Secure Hash Standard", 2015, section 6.2).
[[nodiscard]] std::string sha256(std::string_view bytes);

} // namespace pacini
