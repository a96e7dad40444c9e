#include "cli/bench/Bench.h"

#include <pacini/analysis/EncodeSound.h>
#include <pacini/foundation/Random.h>
#include <pacini/foundation/Units.h>
#include <pacini/runtime/Engine.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
constexpr double runtimeExcerpt = 5.0; // s of each sound
constexpr double runtimeRate = 48000.0;
constexpr std::size_t runtimePlays = 48;
constexpr std::size_t runtimeBlock = 512;
constexpr std::size_t runtimeBlocks = 564; // some 6 s

using Clips = std::vector<std::shared_ptr<const LoadedClip>>;

/// The same sound with few bands and with many: what costs more need not bring more.
Clips runtimeClips(const BenchSound& sound)
{
    Clips clips;
    for (const int bands : {2, 6, 12})
    {
        EncoderParams params;
        params.bands = bands;
        Encoder encoder(params);
        const auto clip =
            encodePrecisely(encoder, {sound.sampleRate, 1}, SoundParts(sound.beginning(runtimeExcerpt), 1));
        if (!clip || clip->bands.empty())
            return {};
        const auto loaded = LoadedClip::ofClip(*clip);
        if (!loaded)
            return {};
        clips.push_back(*loaded);
    }
    return clips;
}

struct RuntimeRun
{
    std::vector<std::vector<float>> out;
    double mean = 0.0, slow = 0.0; ///< us of a block, and what 99 of 100 do not exceed
    EngineMeters meters;
};

/// Plays that loop without end within a budget; the least times of several runs count.
RuntimeRun runtimeRun(const Clips& clips, std::size_t actuators, double budget, int repeats)
{
    using Clock = std::chrono::steady_clock;
    RuntimeRun best;
    for (int i = 0; i < std::max(repeats, 1); ++i)
    {
        EngineParams params;
        params.sampleRate = runtimeRate;
        params.actuators.resize(actuators);
        params.budget.nanosecondsPerFrame = budget;
        auto engine = Engine::make(params);
        if (!engine)
            return best;
        Random random(48);
        for (std::size_t p = 0; p < runtimePlays; ++p)
        {
            PlaySettings settings;
            const auto& clip = clips[p % clips.size()];
            settings.loop = clip->duration();
            settings.from = random.uniform(0.0, settings.loop);
            settings.controls.transposition = random.uniform(-6.0, 6.0);
            settings.controls.pan = random.uniform(0.0, 1.0);
            settings.controls.gain = 0.1 * Decibels(random.uniform(-40.0, 0.0)).gain();
            settings.variation.amount = 0.3;
            settings.variation.seed = p;
            if (!(*engine)->play(clip, settings))
                return best;
        }
        std::vector<std::vector<float>> out(actuators, std::vector<float>(runtimeBlock * runtimeBlocks));
        std::vector<double> times;
        for (std::size_t b = 0; b < runtimeBlocks; ++b)
        {
            std::vector<std::span<float>> part;
            for (auto& channel : out)
                part.push_back(std::span(channel).subspan(b * runtimeBlock, runtimeBlock));
            const auto start = Clock::now();
            (*engine)->render(part);
            times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - start).count());
        }
        double mean = 0.0;
        for (const double time : times)
            mean += time / static_cast<double>(times.size());
        const auto slow = times.begin() + static_cast<std::ptrdiff_t>(times.size() * 99 / 100);
        std::nth_element(times.begin(), slow, times.end());
        best.mean = i == 0 ? mean : std::min(best.mean, mean);
        best.slow = i == 0 ? *slow : std::min(best.slow, *slow);
        best.out = std::move(out);
        best.meters = (*engine)->meters();
    }
    return best;
}

/// The energy of the difference, dB below that of the whole.
double runtimeError(const RuntimeRun& found, const RuntimeRun& whole)
{
    double energy = 1e-30, difference = 0.0;
    for (std::size_t a = 0; a < whole.out.size(); ++a)
        for (std::size_t i = 0; i < whole.out[a].size(); ++i)
        {
            const double x = static_cast<double>(whole.out[a][i]), d = static_cast<double>(found.out[a][i]) - x;
            energy += x * x;
            difference += d * d;
        }
    return Decibels::fromPower(difference / energy).value;
}

void measureRuntime(const BenchSound& sound, const BenchSettings& settings, BenchTable& rows)
{
    const Clips clips = runtimeClips(sound);
    if (clips.empty())
        return;
    for (const std::size_t actuators : {std::size_t(1), std::size_t(4)})
    {
        const RuntimeRun whole = runtimeRun(clips, actuators, 0.0, settings.repeats);
        if (whole.out.empty())
            return;
        for (const int share : {100, 75, 50, 25, 12, 6, 3})
        {
            const RuntimeRun run =
                share == 100 ? whole : runtimeRun(clips, actuators, 0.01 * share * whole.meters.cost, settings.repeats);
            const bool lossless = run.meters.leftOut == 0;
            const double error = lossless ? 0.0 : runtimeError(run, whole);
            rows.add({sound.name, std::to_string(actuators), fmt::format("{} %", share),
                      static_cast<double>(run.meters.leftOut),
                      1e-3 * run.meters.cost * static_cast<double>(runtimeBlock), run.mean, run.slow,
                      lossless ? BenchCell() : BenchCell(run.meters.leftOutError),
                      lossless ? BenchCell() : BenchCell(error), lossless ? 0.0 : errorShare(-error)});
        }
    }
}
} // namespace

Bench runtimeBench()
{
    return {
        "runtime",
        "Engine: error against time of a budget",
        "48 plays that loop without end, of clips that the encoder makes of each sound (first 5 s) with 2, 6 and 12 "
        "bands, each at its own gain (40 dB apart at most), pan and pitch, for 6 s at 48 kHz in blocks of 512 frames. "
        "The budget is a share of the predicted cost of everything. Times are of a block: predicted, its mean and what "
        "99 of 100 do not exceed, the least of several runs. Errors are energies of what is left out, below all: as "
        "the "
        "engine predicts them and as the difference from the output with everything has them.",
        columnsOf({"actuators", "budget"}, {{"leftOut", "plays"},
                                            {"predicted", "us"},
                                            {"measured", "us"},
                                            {"p99", "us"},
                                            {"predictedError", "dB"},
                                            {"measuredError", "dB"},
                                            {"error", "%"},
                                            {"timeRatio", "", Reduction::ratio, "predicted", "measured"}}),
        {{"", "Error of leaving out against time", "actuators", "measured", "error", "budget"}},
        {},
        measureRuntime};
}

} // namespace pacini::cli
