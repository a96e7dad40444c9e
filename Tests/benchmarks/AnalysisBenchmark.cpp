#include "BenchmarkSound.h"

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/EnvelopeFollower.h>
#include <pacini/analysis/OnsetDetector.h>

#include <benchmark/benchmark.h>

namespace pacini::benchmarks
{

void envelopeFollower(benchmark::State& state)
{
    const auto in = strokes(1.0, 48000.0);
    std::vector<float> out(in.size());
    EnvelopeFollower follower;
    follower.prepare({48000.0, in.size()});
    for (auto _ : state)
    {
        follower.process(in, out);
        benchmark::DoNotOptimize(out.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(in.size()));
}
BENCHMARK(envelopeFollower);

void bandAnalysis(benchmark::State& state)
{
    const auto in = strokes(10.0, analysisRate);
    BandAnalysis analysis(
        {tiledBands(static_cast<std::size_t>(state.range(0)), 30.0, 1000.0, BandSpacing::logarithmic)});
    const std::span<const float> channels[] = {in};
    for (auto _ : state)
    {
        analysis.reset(1);
        analysis.push(channels);
        benchmark::DoNotOptimize(analysis.finish());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(in.size()));
}
BENCHMARK(bandAnalysis)->Arg(6)->Arg(12)->Arg(24);

void onsetDetection(benchmark::State& state)
{
    const auto in = strokes(10.0, 48000.0);
    for (auto _ : state)
        benchmark::DoNotOptimize(detectOnsets(in, 1, 48000.0));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(in.size()));
}
BENCHMARK(onsetDetection);

void encoder(benchmark::State& state)
{
    const auto in = strokes(10.0, 48000.0);
    Encoder encoder{EncoderParams{}};
    for (auto _ : state)
    {
        encoder.start(48000, 1);
        encoder.push(in);
        benchmark::DoNotOptimize(encoder.finish());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(in.size()));
}
BENCHMARK(encoder);

void encoderForOneSound(benchmark::State& state)
{
    const auto in = strokes(1.0, 48000.0);
    for (auto _ : state)
    {
        Encoder encoder{EncoderParams{}};
        encoder.start(48000, 1);
        encoder.push(in);
        benchmark::DoNotOptimize(encoder.finish());
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(in.size()));
}
BENCHMARK(encoderForOneSound);

} // namespace pacini::benchmarks
