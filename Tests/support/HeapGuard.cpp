#include "HeapGuard.h"

#include <cstdlib>
#include <new>

namespace
{
thread_local std::size_t operations = 0;

void* allocate(std::size_t size)
{
    ++operations;
    return std::malloc(size == 0 ? 1 : size);
}

void* allocateAligned(std::size_t size, std::align_val_t alignment)
{
    ++operations;
    const auto a = static_cast<std::size_t>(alignment);
    return std::aligned_alloc(a, ((size == 0 ? 1 : size) + a - 1) / a * a);
}

void* orThrow(void* memory)
{
    if (memory == nullptr)
        throw std::bad_alloc();
    return memory;
}

void release(void* memory)
{
    ++operations;
    std::free(memory);
}
} // namespace

// The whole family is replaced, the nothrow and aligned forms too.
void* operator new(std::size_t n)
{
    return orThrow(allocate(n));
}
void* operator new[](std::size_t n)
{
    return orThrow(allocate(n));
}
void* operator new(std::size_t n, const std::nothrow_t&) noexcept
{
    return allocate(n);
}
void* operator new[](std::size_t n, const std::nothrow_t&) noexcept
{
    return allocate(n);
}
void* operator new(std::size_t n, std::align_val_t a)
{
    return orThrow(allocateAligned(n, a));
}
void* operator new[](std::size_t n, std::align_val_t a)
{
    return orThrow(allocateAligned(n, a));
}
void* operator new(std::size_t n, std::align_val_t a, const std::nothrow_t&) noexcept
{
    return allocateAligned(n, a);
}
void* operator new[](std::size_t n, std::align_val_t a, const std::nothrow_t&) noexcept
{
    return allocateAligned(n, a);
}
void operator delete(void* p) noexcept
{
    release(p);
}
void operator delete[](void* p) noexcept
{
    release(p);
}
void operator delete(void* p, std::size_t) noexcept
{
    release(p);
}
void operator delete[](void* p, std::size_t) noexcept
{
    release(p);
}
void operator delete(void* p, const std::nothrow_t&) noexcept
{
    release(p);
}
void operator delete[](void* p, const std::nothrow_t&) noexcept
{
    release(p);
}
void operator delete(void* p, std::align_val_t) noexcept
{
    release(p);
}
void operator delete[](void* p, std::align_val_t) noexcept
{
    release(p);
}
void operator delete(void* p, std::size_t, std::align_val_t) noexcept
{
    release(p);
}
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept
{
    release(p);
}
void operator delete(void* p, std::align_val_t, const std::nothrow_t&) noexcept
{
    release(p);
}
void operator delete[](void* p, std::align_val_t, const std::nothrow_t&) noexcept
{
    release(p);
}

namespace pacini::test
{
HeapGuard::HeapGuard() : start(operations) {}
HeapGuard::~HeapGuard() = default;
std::size_t HeapGuard::traffic() const
{
    return operations - start;
}
} // namespace pacini::test
