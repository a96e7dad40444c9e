#include "cli/Process.h"

#include "io/TemporaryFiles.h"

#if !defined(_WIN32)
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>
#endif

namespace pacini::cli
{

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
    removeTemporariesOnSignals();
}

} // namespace pacini::cli
