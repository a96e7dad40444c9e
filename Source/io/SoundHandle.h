#pragma once

// RAII handle and error messages of libsndfile, for the reader and the writer of audio files.

#include <sndfile.h>

#include <memory>
#include <string>

namespace pacini
{

/// While it lives, its thread is inside libsndfile, whose MP3 part prints on stderr; the owner of stderr can query this
/// and drop the output.
class SoundLibraryCall
{
public:
    SoundLibraryCall() noexcept { ++depth; }
    ~SoundLibraryCall() { --depth; }
    SoundLibraryCall(const SoundLibraryCall&) = delete;
    SoundLibraryCall& operator=(const SoundLibraryCall&) = delete;

    [[nodiscard]] static bool isActive() noexcept { return depth > 0; }

private:
    static inline thread_local int depth = 0;
};

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
