#pragma once

// What reading and writing share of libsndfile.

#include <sndfile.h>

#include <memory>
#include <string>

namespace pacini
{

struct SoundCloser
{
    void operator()(SNDFILE* sound) const noexcept { sf_close(sound); }
};

/// An open libsndfile file, closed at the end of its life.
using SoundHandle = std::unique_ptr<SNDFILE, SoundCloser>;

/// Why `sound` (null: opening) failed, in our style: one lower-case sentence without full stop.
[[nodiscard]] std::string soundError(SNDFILE* sound);

} // namespace pacini
