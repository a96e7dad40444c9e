#pragma once

// Shared libraries that are opened when they are wanted, so that no command waits for them at its start.

#include <dlfcn.h>

namespace pacini::live
{

/// Functions of a shared library. Derived classes look them up; `isThere` tells whether all were found.
class OpenedLibrary
{
public:
    explicit OpenedLibrary(const char* name) : handle(::dlopen(name, RTLD_NOW | RTLD_LOCAL)), isThere(handle != nullptr)
    {
    }

    template <typename Function>
    void find(Function& function, const char* name)
    {
        void* const found = handle != nullptr ? ::dlsym(handle, name) : nullptr;
        function = reinterpret_cast<Function>(found);
        isThere = isThere && found != nullptr;
    }

private:
    void* handle;

public:
    bool isThere;
};

/// The library of that class, opened by the first call.
template <typename Library>
const Library& openedLibrary()
{
    static const Library library;
    return library;
}

} // namespace pacini::live
