#include "BenchmarkSound.h"

#include <pacini/synthesis/CarrierBank.h>
#include <pacini/synthesis/Decoder.h>

#include <benchmark/benchmark.h>

namespace pacini::benchmarks
{

void carrierBank(benchmark::State& state)
{
    const bool glides = state.range(1) != 0;
    std::vector<Carrier> carriers(static_cast<std::size_t>(state.range(0)));
    for (std::size_t k = 0; k < carriers.size(); ++k)
    {
        const double f = 0.002 * static_cast<double>(k + 1);
        for (double t = 0.0; t < 48000.0; t += 800.0)
        {
            carriers[k].amplitude.push_back({t, 0.5});
            carriers[k].frequency.push_back({t, glides ? f * (1.0 + 1e-6 * t) : f});
        }
    }
    CarrierBank bank(carriers);
    std::vector<double> re(64), im(64);
    for (auto _ : state)
    {
        bank.reset();
        for (int i = 0; i < 750; ++i)
            bank.process(re, im);
        benchmark::DoNotOptimize(im.data());
    }
    state.SetItemsProcessed(state.iterations() * 48000 * state.range(0));
}
BENCHMARK(carrierBank)->ArgNames({"carriers", "glides"})->ArgsProduct({{1, 12}, {0, 1}});

void decoder(benchmark::State& state)
{
    DecoderParams params;
    params.fullRate = state.range(0) != 0;
    params.followEnvelope = state.range(1) != 0;
    const Clip clip = strokesClip();
    Decoder decoder(clip, params);
    std::vector<float> block(512);
    const std::int64_t blocks = decoder.totalFrames() / 512;
    for (auto _ : state)
    {
        decoder.reset();
        for (std::int64_t i = 0; i < blocks; ++i)
            decoder.process(block);
        benchmark::DoNotOptimize(block.data());
    }
    state.SetItemsProcessed(state.iterations() * blocks * 512);
}
BENCHMARK(decoder)->ArgNames({"fullRate", "levelled"})->ArgsProduct({{0, 1}, {0, 1}});

void decoderMaking(benchmark::State& state)
{
    const Clip clip = strokesClip();
    for (auto _ : state)
        benchmark::DoNotOptimize(std::make_unique<Decoder>(clip, DecoderParams{}));
}
BENCHMARK(decoderMaking);

} // namespace pacini::benchmarks
