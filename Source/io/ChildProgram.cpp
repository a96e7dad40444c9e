#include "io/ChildProgram.h"

#include "io/FileHandle.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <utility>

#if defined(_WIN32)
#include <io.h>
#include <windows.h>
#else
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ; // NOLINT: POSIX has it in no header
#endif

namespace pacini
{

namespace
{
constexpr std::size_t longestComplaint = 1 << 20; // bytes

/// The start of what a program wrote there.
std::string writtenTo(std::FILE* file)
{
    std::string text(longestComplaint, '\0');
    if (!seekStream(file, 0, SEEK_SET))
        return {};
    text.resize(std::fread(text.data(), 1, text.size(), file));
    return text;
}

#if defined(_WIN32)

class HandleCloser
{
public:
    using pointer = HANDLE;
    void operator()(HANDLE handle) const noexcept { CloseHandle(handle); }
};
using OwnedHandle = std::unique_ptr<HANDLE, HandleCloser>;

std::wstring wide(const std::string& text)
{
    const int size = static_cast<int>(text.size());
    std::wstring result(static_cast<std::size_t>(MultiByteToWideChar(CP_UTF8, 0, text.data(), size, nullptr, 0)),
                        L'\0');
    MultiByteToWideChar(CP_UTF8, 0, text.data(), size, result.data(), static_cast<int>(result.size()));
    return result;
}

/// One argument as the C runtime of the other program takes it from the command line.
std::wstring quoted(const std::wstring& word)
{
    std::wstring result = L"\"";
    std::size_t backslashes = 0; // those before a quotation mark count double
    for (const wchar_t c : word)
    {
        if (c == L'"')
            result.append(backslashes + 1, L'\\');
        backslashes = c == L'\\' ? backslashes + 1 : 0;
        result += c;
    }
    return result.append(backslashes, L'\\') + L'"';
}

/// Where a program is in the folders of PATH, not in the current one; empty when it is in none.
std::wstring placeOf(const std::string& name)
{
    std::wstring folders(32768, L'\0');
    folders.resize(GetEnvironmentVariableW(L"PATH", folders.data(), static_cast<DWORD>(folders.size())));
    std::wstring place(32768, L'\0');
    place.resize(SearchPathW(folders.c_str(), wide(name).c_str(), L".exe", static_cast<DWORD>(place.size()),
                             place.data(), nullptr));
    return place;
}

/// What a child may inherit.
OwnedHandle inheritable(HANDLE handle)
{
    HANDLE copy = nullptr;
    if (!DuplicateHandle(GetCurrentProcess(), handle, GetCurrentProcess(), &copy, 0, TRUE, DUPLICATE_SAME_ACCESS))
        return nullptr;
    return OwnedHandle(copy);
}

HANDLE handleOf(std::FILE* file)
{
    return reinterpret_cast<HANDLE>(_get_osfhandle(_fileno(file)));
}

class RunningProgram final : public ChildProgram
{
public:
    RunningProgram(OwnedHandle started, OwnedHandle reading, FileHandle complaintsTo)
        : process(std::move(started)), output(std::move(reading)), complaints(std::move(complaintsTo))
    {
    }

    ~RunningProgram() override
    {
        TerminateProcess(process.get(), 1);
        WaitForSingleObject(process.get(), INFINITE);
    }

    std::size_t read(std::span<char> bytes) override
    {
        std::size_t done = 0;
        while (done < bytes.size())
        {
            DWORD got = 0;
            const auto most = static_cast<DWORD>(std::min<std::size_t>(bytes.size() - done, 1u << 20));
            if (!ReadFile(output.get(), bytes.data() + done, most, &got, nullptr) || got == 0)
                break;
            done += got;
        }
        return done;
    }

    Ending wait() override
    {
        output.reset();
        WaitForSingleObject(process.get(), INFINITE);
        DWORD code = 1;
        GetExitCodeProcess(process.get(), &code);
        return {code == 0, writtenTo(complaints.get())};
    }

private:
    OwnedHandle process, output;
    FileHandle complaints;
};

Result<std::unique_ptr<ChildProgram>> startProgram(const std::string& name, const std::vector<std::string>& arguments,
                                                   std::FILE* input, FileHandle complaints)
{
    const Error refused{ErrorCode::io, name, "cannot be started; close some programs and try again"};
    const std::wstring place = placeOf(name);
    if (place.empty())
        return std::unique_ptr<ChildProgram>();
    HANDLE ends[2] = {};
    if (!CreatePipe(&ends[0], &ends[1], nullptr, 1 << 16))
        return refused;
    OwnedHandle reading(ends[0]), writing(ends[1]);
    const FileHandle nothing(input == nullptr ? openStream("NUL", "rb") : nullptr);
    const OwnedHandle streams[] = {inheritable(handleOf(input != nullptr ? input : nothing.get())),
                                   inheritable(writing.get()), inheritable(handleOf(complaints.get()))};
    writing.reset();
    // Only these three, not what other threads hand to their own programs.
    HANDLE handed[] = {streams[0].get(), streams[1].get(), streams[2].get()};
    SIZE_T size = 0;
    InitializeProcThreadAttributeList(nullptr, 1, 0, &size);
    std::vector<char> memory(size);
    auto* attributes = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(memory.data());
    if (!InitializeProcThreadAttributeList(attributes, 1, 0, &size) ||
        !UpdateProcThreadAttribute(attributes, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, handed, sizeof handed, nullptr,
                                   nullptr))
        return refused;
    STARTUPINFOEXW startup = {};
    startup.StartupInfo.cb = sizeof startup;
    startup.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
    startup.StartupInfo.hStdInput = handed[0];
    startup.StartupInfo.hStdOutput = handed[1];
    startup.StartupInfo.hStdError = handed[2];
    startup.lpAttributeList = attributes;
    std::wstring line = quoted(place);
    for (const std::string& argument : arguments)
        line += L' ' + quoted(wide(argument));
    PROCESS_INFORMATION started = {};
    const bool runs = CreateProcessW(place.c_str(), line.data(), nullptr, nullptr, TRUE,
                                     EXTENDED_STARTUPINFO_PRESENT | CREATE_NO_WINDOW, nullptr, nullptr,
                                     &startup.StartupInfo, &started) != 0;
    DeleteProcThreadAttributeList(attributes);
    if (!runs)
        return refused;
    CloseHandle(started.hThread);
    return std::unique_ptr<ChildProgram>(
        std::make_unique<RunningProgram>(OwnedHandle(started.hProcess), std::move(reading), std::move(complaints)));
}

#else

/// A number of an open file, closed at the end.
class Descriptor
{
public:
    explicit Descriptor(int opened = -1) noexcept : number(opened) {}
    Descriptor(Descriptor&& other) noexcept : number(std::exchange(other.number, -1)) {}
    Descriptor& operator=(Descriptor&&) = delete;
    ~Descriptor() { close(); }

    [[nodiscard]] int get() const noexcept { return number; }
    void close() noexcept
    {
        if (number >= 0)
            ::close(std::exchange(number, -1));
    }

private:
    int number;
};

class RunningProgram final : public ChildProgram
{
public:
    RunningProgram(pid_t started, Descriptor reading, FileHandle complaintsTo)
        : process(started), output(std::move(reading)), complaints(std::move(complaintsTo))
    {
    }

    ~RunningProgram() override
    {
        output.close();
        if (process > 0)
        {
            ::kill(process, SIGKILL);
            waitForIt();
        }
    }

    std::size_t read(std::span<char> bytes) override
    {
        std::size_t done = 0;
        while (done < bytes.size())
        {
            const ssize_t got = ::read(output.get(), bytes.data() + done, bytes.size() - done);
            if (got < 0 && errno == EINTR)
                continue;
            if (got <= 0)
                break;
            done += static_cast<std::size_t>(got);
        }
        return done;
    }

    Ending wait() override
    {
        output.close();
        const int status = waitForIt();
        return {WIFEXITED(status) && WEXITSTATUS(status) == 0, writtenTo(complaints.get())};
    }

private:
    /// The status, or 0 where the host of this process does not let it be known.
    int waitForIt() noexcept
    {
        int status = 0;
        while (::waitpid(process, &status, 0) < 0)
            if (errno != EINTR)
            {
                status = 0;
                break;
            }
        process = 0;
        return status;
    }

    pid_t process;
    Descriptor output;
    FileHandle complaints;
};

/// Both ends of a pipe that other children do not inherit; whether there is one.
bool openPipeEnds(int (&ends)[2])
{
#if defined(__linux__)
    return ::pipe2(ends, O_CLOEXEC) == 0;
#else
    return ::pipe(ends) == 0 && ::fcntl(ends[0], F_SETFD, FD_CLOEXEC) == 0 &&
           ::fcntl(ends[1], F_SETFD, FD_CLOEXEC) == 0;
#endif
}

Result<std::unique_ptr<ChildProgram>> startProgram(const std::string& name, const std::vector<std::string>& arguments,
                                                   std::FILE* input, FileHandle complaints)
{
    int ends[2] = {-1, -1};
    if (!openPipeEnds(ends))
        return fileError(errno);
    Descriptor reading(ends[0]);
    const Descriptor writing(ends[1]);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    if (input != nullptr)
        posix_spawn_file_actions_adddup2(&actions, ::fileno(input), STDIN_FILENO);
    else
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, writing.get(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ::fileno(complaints.get()), STDERR_FILENO);

    // Signals act on it as on a program that a person started, whatever this process does with them.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes, &signals);
    sigaddset(&signals, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);

    std::vector<std::string> words{name};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> line;
    for (std::string& word : words)
        line.push_back(word.data());
    line.push_back(nullptr);
    pid_t process = 0;
    const int failed = ::posix_spawnp(&process, name.c_str(), &actions, &attributes, line.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failed == ENOENT || failed == EACCES || failed == ENOTDIR)
        return std::unique_ptr<ChildProgram>();
    if (failed != 0)
        return fileError(failed);
    return std::unique_ptr<ChildProgram>(
        std::make_unique<RunningProgram>(process, std::move(reading), std::move(complaints)));
}

#endif
} // namespace

Result<std::unique_ptr<ChildProgram>> ChildProgram::start(const std::string& name,
                                                          const std::vector<std::string>& arguments, std::FILE* input)
{
    FileHandle complaints(std::tmpfile());
    if (!complaints)
        return fileError(errno);
    return startProgram(name, arguments, input, std::move(complaints));
}

std::string allOutput(ChildProgram& program, std::size_t maximumBytes)
{
    std::string text;
    while (text.size() < maximumBytes)
    {
        const auto before = text.size();
        const auto step = std::min<std::size_t>(maximumBytes - before, 65536);
        text.resize(before + step);
        const auto got = program.read({text.data() + before, step});
        text.resize(before + got);
        if (got < step)
            break;
    }
    return text;
}

} // namespace pacini
