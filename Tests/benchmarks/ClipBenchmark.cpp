#include "BenchmarkSound.h"

#include <pacini/clip/PackedClip.h>
#include <pacini/clip/RangeCoder.h>

#include <benchmark/benchmark.h>

namespace pacini::benchmarks
{

constexpr std::int64_t bitCount = 100000;

/// Bits of which one in eight is set.
std::vector<bool> unevenBits()
{
    Random random(2);
    std::vector<bool> bits;
    for (std::int64_t i = 0; i < bitCount; ++i)
        bits.push_back(random.uniform() < 0.125);
    return bits;
}

std::vector<std::byte> written(const std::vector<bool>& bits)
{
    RangeWriter writer;
    AdaptiveBit model;
    for (const bool bit : bits)
        writer.bit(bit, model);
    return writer.finish();
}

void rangeWriter(benchmark::State& state)
{
    const auto bits = unevenBits();
    for (auto _ : state)
        benchmark::DoNotOptimize(written(bits));
    state.SetItemsProcessed(state.iterations() * bitCount);
}
BENCHMARK(rangeWriter);

void rangeReader(benchmark::State& state)
{
    const auto bytes = written(unevenBits());
    for (auto _ : state)
    {
        RangeReader reader(bytes);
        AdaptiveBit model;
        for (std::int64_t i = 0; i < bitCount; ++i)
            benchmark::DoNotOptimize(reader.bit(false, model));
    }
    state.SetItemsProcessed(state.iterations() * bitCount);
}
BENCHMARK(rangeReader);

void packing(benchmark::State& state)
{
    const Clip clip = strokesClip();
    for (auto _ : state)
        benchmark::DoNotOptimize(packClip(clip, packParamsFor(clip)));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(breakpointCount(clip)));
}
BENCHMARK(packing);

void unpacking(benchmark::State& state)
{
    const Clip clip = strokesClip();
    const auto bytes = packClip(clip, packParamsFor(clip));
    for (auto _ : state)
        benchmark::DoNotOptimize(unpackClip(bytes));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(breakpointCount(clip)));
}
BENCHMARK(unpacking);

} // namespace pacini::benchmarks
