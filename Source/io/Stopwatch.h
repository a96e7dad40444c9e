#pragma once

// Stopwatch that adds up the time of several pieces of work.

#include <chrono>

namespace pacini
{

class Stopwatch
{
public:
    /// Runs `work` and counts its time.
    template <typename Work>
    void run(Work&& work)
    {
        const auto start = std::chrono::steady_clock::now();
        work();
        total += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    /// Subtracts the time of nested work.
    void leaveOut(const Stopwatch& inside) { total -= inside.total; }

    [[nodiscard]] double seconds() const { return total; }

private:
    double total = 0.0;
};

} // namespace pacini
