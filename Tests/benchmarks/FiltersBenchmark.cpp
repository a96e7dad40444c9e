#include "BenchmarkSound.h"
#include "cli/bench/ZeroPhaseBank.h"

#include <pacini/filters/BiquadCascade.h>
#include <pacini/filters/FilterBank.h>
#include <pacini/filters/RationalDecimator.h>

#include <benchmark/benchmark.h>

#include <span>

namespace pacini::benchmarks
{

void biquadCascade(benchmark::State& state)
{
    BiquadCascadeParams params;
    for (std::int64_t i = 0; i < state.range(0); ++i)
        params.pushBack(
            {.type = BiquadType::peak, .frequency = Hertz(50.0 * static_cast<double>(i + 1)), .gain = Decibels(6.0)});
    const auto in = strokes(1.0, 48000.0);
    std::vector<float> out(in.size());
    BiquadCascade cascade;
    cascade.prepare({48000.0, in.size()});
    cascade.setParams(params);
    for (auto _ : state)
    {
        cascade.process(in, out);
        benchmark::DoNotOptimize(out.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(in.size()));
}
BENCHMARK(biquadCascade)->Arg(1)->Arg(4)->Arg(16);

void filterBank(benchmark::State& state)
{
    const auto in = strokes(1.0, 4000.0);
    FilterBank bank;
    bank.setParams({.bands = static_cast<std::size_t>(state.range(0))});
    bank.prepare({4000.0, in.size()});
    std::vector<std::vector<float>> bands(bank.bands(), std::vector<float>(in.size()));
    const std::vector<std::span<float>> outs(bands.begin(), bands.end());
    for (auto _ : state)
    {
        bank.process(in, outs);
        benchmark::DoNotOptimize(bands.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(in.size()));
}
BENCHMARK(filterBank)->Arg(6)->Arg(12)->Arg(24);

void zeroPhaseBank(benchmark::State& state)
{
    const auto in = strokes(10.0, 4000.0);
    cli::ZeroPhaseBankParams params;
    params.layout.bands = static_cast<std::size_t>(state.range(0));
    params.method = state.range(1) == 0 ? cli::ZeroPhaseMethod::raisedCosine : cli::ZeroPhaseMethod::forwardBackward;
    for (auto _ : state)
        benchmark::DoNotOptimize(cli::splitZeroPhase(in, 4000.0, params));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(in.size()));
}
BENCHMARK(zeroPhaseBank)->ArgNames({"bands", "forwardBackward"})->ArgsProduct({{6, 12, 24}, {0, 1}});

void rationalDecimator(benchmark::State& state)
{
    const auto rate = static_cast<int>(state.range(0));
    const auto in = strokes(1.0, rate);
    RationalDecimator decimator(rate, 4000);
    std::vector<float> out;
    for (auto _ : state)
    {
        out.clear();
        decimator.push(in, out);
        benchmark::DoNotOptimize(out.data());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(in.size()));
}
BENCHMARK(rationalDecimator)->Arg(44100)->Arg(48000)->Arg(96000);

} // namespace pacini::benchmarks
