#include "io/SoundHandle.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

#if defined(__GLIBC__)
#include <unistd.h>
#endif

namespace pacini
{

#if defined(__GLIBC__)
namespace
{
ssize_t writeUnlessFromSoundLibrary(void*, const char* bytes, size_t size)
{
    if (SoundLibraryCall::isActive())
        return static_cast<ssize_t>(size);
    for (size_t done = 0; done < size;)
    {
        const ssize_t written = ::write(STDERR_FILENO, bytes + done, size - done);
        if (written <= 0)
            return 0; // means failure to the C library
        done += static_cast<size_t>(written);
    }
    return static_cast<ssize_t>(size);
}
} // namespace

// The calls that print run in the thread that reads, so no other thread's messages are held up.
void muteSoundLibraries() noexcept
{
    [[maybe_unused]] static const bool done = []
    {
        std::FILE* const filtered =
            ::fopencookie(nullptr, "w", {nullptr, writeUnlessFromSoundLibrary, nullptr, nullptr});
        if (filtered == nullptr)
            return false;
        std::setvbuf(filtered, nullptr, _IONBF, 0);
        stderr = filtered; // a variable in the GNU C library, as its manual says
        return true;
    }();
}
#else
void muteSoundLibraries() noexcept {}
#endif

std::string soundError(SNDFILE* sound)
{
    std::string text(sf_strerror(sound));
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && (text.back() == '.' || text.back() == ' '))
        text.pop_back();
    // A second capital letter means an abbreviation, which stays.
    if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])))
        text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    return text;
}

} // namespace pacini
