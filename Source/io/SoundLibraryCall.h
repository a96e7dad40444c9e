#pragma once

// What libsndfile's codecs print on stderr, and how it is dropped.

namespace pacini
{

/// While it lives, its thread is inside libsndfile, whose MP3 part prints on stderr; muteSoundLibraries() drops that.
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

/// Lets all that the C library's stderr is given through but what libsndfile's codecs say of files on which they choke:
/// they name their own sources and nothing that would help, and the reader reports these files anyway. For the start of
/// programs and of modules that are never unloaded; the second call does nothing. No effect beside other C libraries
/// than GNU's.
void muteSoundLibraries() noexcept;

} // namespace pacini
