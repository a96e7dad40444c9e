#include "cli/Process.h"

#include "io/SoundHandle.h"
#include "io/TemporaryFiles.h"

#include <cstdio>

#if !defined(_WIN32)
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>
#endif

namespace pacini::cli
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

/// Lets all of stderr through but what libsndfile's codecs say of files on which they choke: it names their own sources
/// and nothing that would help, and the reader reports these files anyway. The calls that print run in the thread that
/// reads, so no other thread's messages are held up.
void leaveOutSoundLibraries() noexcept
{
    if (std::FILE* filtered = ::fopencookie(nullptr, "w", {nullptr, writeUnlessFromSoundLibrary, nullptr, nullptr}))
    {
        std::setvbuf(filtered, nullptr, _IONBF, 0);
        stderr = filtered; // a variable in the GNU C library, as its manual says
    }
}
} // namespace
#endif

void prepareProcess() noexcept
{
#if !defined(_WIN32)
    // Opening takes the lowest free number, so going upwards fills each gap. What is printed on a stream that was
    // closed must fail: stdout gets a stand-in for reading only.
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0)
            static_cast<void>(::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY));
    ::signal(SIGXFSZ, SIG_IGN);
    ::signal(SIGPIPE, SIG_IGN);
#endif
#if defined(__GLIBC__)
    leaveOutSoundLibraries();
#endif
    removeTemporariesOnSignals();
}

} // namespace pacini::cli
