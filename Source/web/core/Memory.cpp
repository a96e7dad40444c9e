// Memory for data from JavaScript: exports of every module.

#include <cstdint>
#include <cstdlib>

extern "C"
{
    /// Aligned for any type; null where there is none.
    [[clang::export_name("allocate")]] void* paciniAllocate(std::uint32_t bytes)
    {
        return std::malloc(bytes == 0 ? 1 : bytes);
    }

    [[clang::export_name("release")]] void paciniRelease(void* memory)
    {
        std::free(memory);
    }
}
