#pragma once

// Sound device of a controller.

#include <optional>
#include <string>

namespace pacini::devices
{

/// ALSA's number of the sound card that belongs to the same USB device as a controller, by its path; nothing where
/// there is none, and on other systems than Linux. [worker]
[[nodiscard]] std::optional<int> soundCardOf(const std::string& path);

} // namespace pacini::devices
