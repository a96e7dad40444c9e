// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sound file in memory, resampled to the rate at which it is to be played.

#include <pacini/foundation/Result.h>

#include <array>
#include <filesystem>
#include <vector>

namespace pacini::app
{

struct LoadedSound
{
    std::array<std::vector<float>, 2> channels; ///< left and right of one length; mono is in both
    double sampleRate = 0.0;                    ///< Hz

    [[nodiscard]] std::size_t frames() const noexcept { return channels[0].size(); }
};

inline constexpr double longestSound = 1200.0; ///< s; longer files are cut there

/// Reads a sound at a whole rate. Of more than two channels the first two are taken. Errors: those of AudioReader.
[[nodiscard]] Result<LoadedSound> loadSound(const std::filesystem::path& path, double sampleRate);

} // namespace pacini::app
