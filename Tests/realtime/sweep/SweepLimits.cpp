// Any number of random actuators against their limits: `pacini_sweep_limits COUNT [FIRST_SEED [THREADS]]`. Prints what
// was run and the worst that was found; fails when a limit was passed. The tests run the first thousand.

#include "realtime/LimitSweep.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>

using namespace pacini;
using namespace pacini::test;

namespace
{
struct Tally
{
    std::array<std::size_t, 3> ways{};
    std::size_t pushed = 0; ///< to within a tenth of a limit
    std::size_t passed = 0;
    Strain worst;
    std::uint64_t worstTravelSeed = 0, worstWornSeed = 0, worstHeatSeed = 0;

    void add(std::uint64_t seed, const LimitCase& limitCase, const Strain& strain)
    {
        ++ways[static_cast<std::size_t>(limitCase.way)];
        pushed += strain.worst() > 0.9 ? 1u : 0u;
        if (strain.travel > worst.travel)
            worstTravelSeed = seed;
        if (strain.worn > worst.worn)
            worstWornSeed = seed;
        if (strain.heat > worst.heat)
            worstHeatSeed = seed;
        worst.add(strain);
        if (strain.worst() > Witness<SwingingMass>::tolerance || !(strain.level <= 1.0))
        {
            ++passed;
            std::printf("seed %llu, way %d: travel %.4f, as worn %.4f, heat %.4f, level %.4f\n",
                        static_cast<unsigned long long>(seed), static_cast<int>(limitCase.way), strain.travel,
                        strain.worn, strain.heat, strain.level);
        }
    }
    void print(std::size_t done) const
    {
        std::printf("%zu actuators (%zu by the protection alone, %zu in scenes, %zu live), %zu of them pushed to a "
                    "limit; %zu passed one. Worst travel %.6f (seed %llu), as worn %.6f (seed %llu), heat %.6f (seed "
                    "%llu), level %.6f\n",
                    done, ways[0], ways[1], ways[2], pushed, passed, worst.travel,
                    static_cast<unsigned long long>(worstTravelSeed), worst.worn,
                    static_cast<unsigned long long>(worstWornSeed), worst.heat,
                    static_cast<unsigned long long>(worstHeatSeed), worst.level);
        std::fflush(stdout);
    }
};
} // namespace

int main(int argc, char** argv)
{
    const auto number = [&](int at, unsigned long long usual)
    {
        return argc > at ? std::strtoull(argv[at], nullptr, 10) : usual;
    };
    const std::uint64_t count = number(1, 0), first = number(2, 1);
    const auto threads = static_cast<unsigned>(number(3, std::max(1u, std::thread::hardware_concurrency())));
    if (count == 0 || threads == 0)
    {
        std::fprintf(stderr, "usage: pacini_sweep_limits COUNT [FIRST_SEED [THREADS]]\n");
        return 2;
    }
    std::atomic<std::uint64_t> next{0};
    std::mutex mutex;
    Tally tally;
    std::size_t done = 0;
    const auto work = [&]
    {
        for (std::uint64_t i = next++; i < count; i = next++)
        {
            const auto [limitCase, strain] = runLimitCase<SwingingMass>(first + i);
            const std::scoped_lock lock(mutex);
            tally.add(first + i, limitCase, strain);
            if (++done % 50000 == 0)
                tally.print(done);
        }
    };
    std::vector<std::thread> workers;
    for (unsigned i = 1; i < threads; ++i)
        workers.emplace_back(work);
    work();
    for (std::thread& worker : workers)
        worker.join();
    tally.print(done);
    return tally.passed == 0 ? 0 : 1;
}
