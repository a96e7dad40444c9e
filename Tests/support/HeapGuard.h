#pragma once

// Counts heap traffic between two points, to prove that real-time code makes none.

#include <cstddef>

namespace pacini::test
{

/// While alive, every operator new and delete of this thread is counted.
class HeapGuard
{
public:
    HeapGuard();
    ~HeapGuard();
    HeapGuard(const HeapGuard&) = delete;
    HeapGuard& operator=(const HeapGuard&) = delete;

    /// Allocations and releases since construction.
    [[nodiscard]] std::size_t traffic() const;

private:
    std::size_t start;
};

} // namespace pacini::test
