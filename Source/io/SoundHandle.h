#pragma once

// RAII handle and error messages of libsndfile, for the reader and the writer of audio files.

#include "io/SoundLibraryCall.h"

#include <sndfile.h>

#include <memory>
#include <string>

namespace pacini
{

struct SoundCloser
{
    void operator()(SNDFILE* sound) const noexcept
    {
        const SoundLibraryCall inside;
        sf_close(sound);
    }
};

/// An open libsndfile file, closed at the end of its life.
using SoundHandle = std::unique_ptr<SNDFILE, SoundCloser>;

/// Why `sound` (null: opening) failed, in our style: one lower-case sentence without full stop.
[[nodiscard]] std::string soundError(SNDFILE* sound);

} // namespace pacini
