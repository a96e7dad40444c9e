// SPDX-License-Identifier: GPL-3.0-or-later
// How the plugin finds sndfile.dll: in its own folder, where Windows does not look for what a plugin needs, when the
// first sound is read. Without it the plugin works, and reading a sound is an error that names the file.

// clang-format off
#include <windows.h>
#include <delayimp.h> // takes the types of the one before it
// clang-format on

#include <string>
#include <string_view>

namespace
{

HMODULE ownModule()
{
    HMODULE module = nullptr;
    GetModuleHandleExW(GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT,
                       reinterpret_cast<LPCWSTR>(&ownModule), &module);
    return module;
}

HMODULE loadFromOwnFolder()
{
    std::wstring path(32768, L'\0');
    path.resize(GetModuleFileNameW(ownModule(), path.data(), static_cast<DWORD>(path.size())));
    path.erase(path.find_last_of(L'\\') + 1);
    return LoadLibraryExW((path + L"sndfile.dll").c_str(), nullptr, LOAD_WITH_ALTERED_SEARCH_PATH);
}

/// What sf_open_virtual() and others that give a pointer return when they fail.
INT_PTR WINAPI nothing()
{
    return 0;
}

/// What sf_strerror() returns then.
INT_PTR WINAPI whatIsMissing()
{
    return reinterpret_cast<INT_PTR>("sndfile.dll is missing in the folder of the plugin: install Pacini again");
}

FARPROC WINAPI findLibrary(unsigned when, PDelayLoadInfo /*wanted*/)
{
    return when == dliNotePreLoadLibrary ? reinterpret_cast<FARPROC>(loadFromOwnFolder()) : nullptr;
}

FARPROC WINAPI standIn(unsigned when, PDelayLoadInfo wanted)
{
    if (when == dliFailLoadLib)
        return reinterpret_cast<FARPROC>(ownModule());
    const bool asksWhy = when == dliFailGetProc && wanted->dlp.fImportByName &&
                         std::string_view(wanted->dlp.szProcName).starts_with("sf_strerror");
    return asksWhy ? &whatIsMissing : &nothing;
}

} // namespace

extern "C" PfnDliHook __pfnDliNotifyHook2;
extern "C" PfnDliHook __pfnDliFailureHook2;
PfnDliHook __pfnDliNotifyHook2 = &findLibrary;
PfnDliHook __pfnDliFailureHook2 = &standIn;
