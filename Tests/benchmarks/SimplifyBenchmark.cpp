#include "BenchmarkSound.h"

#include <pacini/analysis/methods/MethodCurves.h>
#include <pacini/simplify/Simplify.h>

#include <benchmark/benchmark.h>

namespace pacini::benchmarks
{

/// The envelope of two seconds of strokes at 1 kHz.
Curve envelope()
{
    EnvelopeTrack track({}, 4000.0);
    track.push(strokes(2.0, 4000.0));
    return track.curve();
}

void simplifyToCount(benchmark::State& state, SimplifyMethod method)
{
    const Curve dense = envelope();
    SimplifyParams params;
    params.method = method;
    params.count = static_cast<std::size_t>(2 * state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(simplify(dense, params));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(dense.size()));
}

void simplifyToBound(benchmark::State& state, SimplifyMethod method)
{
    const Curve dense = envelope();
    SimplifyParams params;
    params.method = method;
    params.maxError = 0.01 * static_cast<double>(state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(simplify(dense, params));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(dense.size()));
}

void refitValues(benchmark::State& state)
{
    const Curve dense = envelope();
    const Curve curve = curveOf(dense, douglasPeuckerToCount(dense, 40));
    for (auto _ : state)
        benchmark::DoNotOptimize(refit(dense, curve));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(dense.size()));
}
BENCHMARK(refitValues);

// Points per second, and bounds in per cent of full drive.
#define PACINI_SIMPLIFIER(method)                                                                                      \
    BENCHMARK_CAPTURE(simplifyToCount, method, SimplifyMethod::method)->Arg(5)->Arg(20);                               \
    BENCHMARK_CAPTURE(simplifyToBound, method, SimplifyMethod::method)->Arg(1)->Arg(5)
PACINI_SIMPLIFIER(visvalingam);
PACINI_SIMPLIFIER(douglasPeucker);
PACINI_SIMPLIFIER(optimal);
PACINI_SIMPLIFIER(streaming);
PACINI_SIMPLIFIER(lagrangian);
#undef PACINI_SIMPLIFIER

} // namespace pacini::benchmarks
