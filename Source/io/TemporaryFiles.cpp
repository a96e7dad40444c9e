#include "io/TemporaryFiles.h"

#include "io/Fingerprint.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <memory>
#include <mutex>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#if defined(_WIN32)
#include <io.h>
#include <windows.h>
#else
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
using Char = std::filesystem::path::value_type;

// A signal handler may neither lock nor allocate: a name is a heap block that belongs to whoever takes it off the list.
std::array<std::atomic<const Char*>, 512> names{};

constexpr std::size_t endingDigits = 4; ///< of the computer, and as many of the number

void appendDigits(std::string& text, unsigned number)
{
    for (std::size_t i = 0; i < endingDigits; ++i)
        text += "0123456789abcdef"[(number >> (4 * i)) & 15u];
}

/// Four digits, the same for all processes on this computer.
std::string digitsOfHere()
{
    std::string text;
    Fingerprint name;
#if !defined(_WIN32)
    std::array<char, 256> host{};
    if (::gethostname(host.data(), host.size() - 1) == 0)
        name.add(std::string_view(host.data()));
#endif
    appendDigits(text, static_cast<unsigned>(name.value()));
    return text;
}

constexpr std::string_view mark = ".pacini-";
constexpr std::string_view extension = ".tmp";

/// The digits in the name of a temporary, `.NAME.pacini-XXXXXXXX.tmp`, four in those of earlier versions; empty
/// for any other name.
std::string digitsIn(std::string_view name)
{
    if (!name.starts_with('.') || !name.ends_with(extension))
        return {};
    name.remove_suffix(extension.size());
    const auto at = name.rfind(mark);
    if (at == std::string_view::npos || at < 2)
        return {};
    const auto digits = name.substr(at + mark.size());
    const bool ours = (digits.size() == endingDigits || digits.size() == 2 * endingDigits) &&
                      digits.find_first_not_of("0123456789abcdef") == std::string_view::npos;
    return ours ? std::string(digits) : std::string();
}

/// Removes `path` unless a process keeps it.
void removeUnlessKept(const fs::path& path)
{
#if defined(_WIN32)
    std::error_code ignored;
    fs::remove(path, ignored); // refused while it is open
#else
    const int file = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0)
        return;
    // Removed while it is locked: its maker, if there is one, sees that (keepTemporary).
    struct stat status = {};
    if (::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 1 &&
        status.st_uid == ::geteuid() && ::flock(file, LOCK_EX | LOCK_NB) == 0)
        ::unlink(path.c_str());
    ::close(file);
#endif
}

#if defined(_WIN32)
/// Whether the file goes when it is closed, as it is at the end of a process, however that ends.
bool removeAtTheEnd(std::FILE* file, bool remove) noexcept
{
    FILE_DISPOSITION_INFO wanted{};
    wanted.DeleteFile = remove ? TRUE : FALSE;
    const auto handle = reinterpret_cast<HANDLE>(_get_osfhandle(_fileno(file)));
    return SetFileInformationByHandle(handle, FileDispositionInfo, &wanted, sizeof wanted) != 0;
}
#else
static_assert(std::atomic<const Char*>::is_always_lock_free);
static_assert(std::atomic<bool>::is_always_lock_free);

std::atomic<bool> ending = false;

/// The process is about to end by a signal.
void waitForTheEnd() noexcept
{
    for (;;)
        ::pause();
}

extern "C" void removeTemporaries(int signal)
{
    // A second signal may come to another thread, which must not end the program while files are being removed.
    if (ending.exchange(true))
        waitForTheEnd();
    for (auto& name : names)
        if (const Char* taken = name.exchange(nullptr))
            ::unlink(taken);
    struct sigaction usual = {};
    usual.sa_handler = SIG_DFL;
    sigemptyset(&usual.sa_mask);
    ::sigaction(signal, &usual, nullptr);
    ::raise(signal); // held back until this returns
}
#endif
} // namespace

TemporaryEntry::TemporaryEntry(const std::filesystem::path& temporary)
{
    const auto& text = temporary.native();
    auto copy = std::make_unique<Char[]>(text.size() + 1);
    std::copy(text.begin(), text.end(), copy.get());
    for (auto& name : names)
    {
        const Char* nothing = nullptr;
        if (name.compare_exchange_strong(nothing, copy.get()))
        {
            copy.release();
            place = &name;
#if !defined(_WIN32)
            if (ending.load())
                waitForTheEnd(); // what is made now would stay
#endif
            return;
        }
    }
}

TemporaryEntry::TemporaryEntry(TemporaryEntry&& other) noexcept : place(std::exchange(other.place, nullptr)) {}

TemporaryEntry::~TemporaryEntry()
{
    if (place != nullptr)
        delete[] place->exchange(nullptr);
}

std::string temporaryEnding(unsigned number)
{
    static const std::string here = digitsOfHere();
    std::string text = std::string(mark) + here;
    appendDigits(text, number);
    return text + std::string(extension);
}

bool keepTemporary(std::FILE* temporary) noexcept
{
#if defined(_WIN32)
    static_cast<void>(removeAtTheEnd(temporary, true)); // where that cannot be, it may stay as one of a killed program
    return true;
#else
    // Where locks do not work, nobody can take this one for stale either.
    struct stat status = {};
    return (::flock(::fileno(temporary), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) &&
           ::fstat(::fileno(temporary), &status) == 0 && status.st_nlink > 0;
#endif
}

TemporaryMark::TemporaryMark([[maybe_unused]] std::FILE* temporary) noexcept
{
#if defined(_WIN32)
    if (temporary != nullptr)
        static_cast<void>(removeAtTheEnd(temporary, false));
#else
    file = ::fcntl(::fileno(temporary), F_DUPFD_CLOEXEC, 0);
#endif
}

TemporaryMark::~TemporaryMark()
{
#if !defined(_WIN32)
    if (file >= 0)
        ::close(file);
#endif
}

void removeStaleTemporaries(const fs::path& folder)
{
    static std::mutex mutex;
    static std::set<fs::path> done;
    std::error_code error;
    const fs::path key = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error);
    {
        const std::lock_guard lock(mutex);
        if (error || !done.insert(key).second)
            return;
    }
    const std::string here = digitsOfHere();
    const auto longAgo = fs::file_time_type::clock::now() - std::chrono::hours(24);
    fs::directory_iterator entry(key, error);
    while (!error && entry != fs::directory_iterator())
    {
        const auto digits = digitsIn(entry->path().filename().string());
        const bool madeHere = digits.size() > endingDigits && digits.starts_with(here);
        std::error_code unknown;
        if (!digits.empty() && entry->symlink_status(unknown).type() == fs::file_type::regular &&
            (madeHere || entry->last_write_time(unknown) < longAgo))
            removeUnlessKept(entry->path());
        entry.increment(error);
    }
}

void removeTemporariesOnSignals() noexcept
{
#if !defined(_WIN32)
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    {
        struct sigaction before = {};
        if (sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN)
            continue;
        struct sigaction action = {};
        action.sa_handler = removeTemporaries;
        sigemptyset(&action.sa_mask);
        for (const int other : {SIGINT, SIGTERM, SIGHUP}) // none comes in between in this thread
            sigaddset(&action.sa_mask, other);
        sigaction(signal, &action, nullptr);
    }
#endif
}

} // namespace pacini
