#pragma once

// Timing of a piece of work: its shortest run time and its result, from the same runs.

#include "io/Stopwatch.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace pacini::cli
{

template <typename Result>
struct Timed
{
    Result result;        ///< of the last run
    double seconds = 0.0; ///< of the fastest run
};

/// Runs `work` up to `repeats` times (at least once), but begins no further run after 0.5 s. The least time counts:
/// what else goes on in a computer can only add to it. Errors are then computed from the result, so that nothing of the
/// work can be optimised away and nothing is measured on anything but what was timed.
template <typename Work>
[[nodiscard]] auto timed(int repeats, Work&& work) -> Timed<std::invoke_result_t<Work&>>
{
    constexpr double enough = 0.5; // s
    const auto once = [&work]
    {
        Stopwatch watch;
        Timed<std::invoke_result_t<Work&>> run;
        watch.run([&] { run.result = work(); });
        run.seconds = watch.seconds();
        return run;
    };
    auto best = once();
    double spent = best.seconds;
    for (int i = 1; i < repeats && spent < enough; ++i)
    {
        auto run = once();
        spent += run.seconds;
        best.seconds = std::min(best.seconds, run.seconds);
        best.result = std::move(run.result);
    }
    return best;
}

} // namespace pacini::cli
