#include "BenchmarkSound.h"

#include <pacini/foundation/Fft.h>
#include <pacini/foundation/SplitRealFft.h>

#include <benchmark/benchmark.h>

#include <complex>

namespace pacini::benchmarks
{

template <typename Real>
void realFft(benchmark::State& state)
{
    const auto size = static_cast<std::size_t>(state.range(0));
    const auto sound = strokes(1.0, static_cast<double>(size));
    const std::vector<Real> in(sound.begin(), sound.end());
    RealFft<Real> transform(size);
    std::vector<std::complex<Real>> out(transform.bins());
    for (auto _ : state)
    {
        transform.forward(in, out);
        benchmark::DoNotOptimize(out.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK_TEMPLATE(realFft, float)->Arg(512)->Arg(8192);
BENCHMARK_TEMPLATE(realFft, double)->Arg(512)->Arg(8192);

template <typename Real>
void splitRealFft(benchmark::State& state)
{
    const auto size = static_cast<std::size_t>(state.range(0));
    const auto sound = strokes(1.0, static_cast<double>(size));
    const std::vector<Real> in(sound.begin(), sound.end());
    SplitRealFft<Real> transform(size);
    SplitArray<Real> out(transform.bins());
    for (auto _ : state)
    {
        transform.forward(in.data(), out.re.data(), out.im.data());
        benchmark::DoNotOptimize(out.re.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK_TEMPLATE(splitRealFft, float)->Arg(512)->Arg(8192);
BENCHMARK_TEMPLATE(splitRealFft, double)->Arg(512)->Arg(8192);

template <typename Transform>
void fftPlanning(benchmark::State& state)
{
    for (auto _ : state)
        benchmark::DoNotOptimize(Transform(8192));
}
BENCHMARK_TEMPLATE(fftPlanning, RealFft<float>);
BENCHMARK_TEMPLATE(fftPlanning, SplitRealFft<float>);

} // namespace pacini::benchmarks
