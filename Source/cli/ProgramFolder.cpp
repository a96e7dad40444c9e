#include "cli/ProgramFolder.h"

#include <cstdint>
#include <system_error>

#if defined(_WIN32)
#include <windows.h>
#elif defined(__APPLE__)
#include <mach-o/dyld.h>
#endif

namespace pacini::cli
{

std::filesystem::path programFolder()
{
    std::error_code error;
    std::filesystem::path program;
#if defined(_WIN32)
    wchar_t name[32768];
    if (GetModuleFileNameW(nullptr, name, 32768) > 0)
        program = name;
#elif defined(__APPLE__)
    char name[4096];
    std::uint32_t size = sizeof(name);
    if (_NSGetExecutablePath(name, &size) == 0)
        program = name;
#else
    program = std::filesystem::read_symlink("/proc/self/exe", error);
#endif
    return program.empty() ? std::filesystem::current_path(error) : program.parent_path();
}

} // namespace pacini::cli
