#include "cli/bench/Bench.h"
#include "cli/bench/Timed.h"

#include <pacini/analysis/EncodeSound.h>
#include <pacini/foundation/Random.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/RenderScene.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
constexpr double scenesExcerpt = 5.0; // s of each sound
constexpr std::size_t playCount = 64;

/// Plays that begin within a second of each other, each at its own pitch and with its own variation. `audible` of them
/// are at most 12 dB down; of the others one in eight comes after the end and the rest are 70 to 100 dB down.
Scene crowd(const Clip& clip, std::size_t audible)
{
    Random random(64);
    Scene scene;
    scene.clips = {clip};
    scene.duration = clip.duration + 1.0;
    for (std::size_t i = 0; i < playCount; ++i)
    {
        ScenePlay play;
        play.start = random.uniform(0.0, 1.0);
        play.transposition = random.uniform(-6.0, 6.0);
        play.variation = {0.3, VariationScope::band, i};
        play.gain = random.uniform(-12.0, 0.0);
        if (i >= audible)
        {
            if (i % 8 == 7)
                play.start += scene.duration;
            else
                play.gain = random.uniform(-100.0, -70.0);
        }
        scene.plays.push_back(play);
    }
    return scene;
}

/// A scene as `pacini render` plays it; no samples where it cannot be.
RenderedScene rendered(const Scene& scene, const CompileParams& compile)
{
    RenderParams params;
    params.compile = compile;
    auto result = renderScene(scene, nullptr, params);
    return result ? std::move(*result) : RenderedScene();
}

/// The energy of the difference, dB below that of the whole.
double errorOf(const std::vector<float>& found, const std::vector<float>& whole)
{
    double energy = 0.0, difference = 0.0;
    for (std::size_t i = 0; i < whole.size(); ++i)
    {
        const double d = static_cast<double>(found[i]) - static_cast<double>(whole[i]);
        energy += static_cast<double>(whole[i]) * static_cast<double>(whole[i]);
        difference += d * d;
    }
    return difference > 0.0 ? Decibels::fromPower(difference / energy).value : -std::numeric_limits<double>::infinity();
}

/// Nothing to take a mean of where nothing is lost.
BenchCell levelCell(double value)
{
    return std::isfinite(value) ? BenchCell(value) : BenchCell();
}

void measureScenes(const BenchSound& sound, const BenchSettings& settings, BenchTable& rows)
{
    Encoder encoder{EncoderParams{}};
    const Clip clip =
        encodePrecisely(encoder, {sound.sampleRate, 1}, SoundParts(sound.beginning(scenesExcerpt), 1)).value();
    if (clip.bands.empty())
        return;
    for (const std::size_t audible : {std::size_t(1), std::size_t(8), std::size_t(32), std::size_t(64)})
    {
        const Scene scene = crowd(clip, audible);
        const std::string key = fmt::format("{} of {}", audible, playCount);
        CompileParams params;
        params.leaveOut = false;
        const auto whole = timed(settings.repeats, [&] { return rendered(scene, params); });
        if (whole.result.samples.empty())
            return;
        rows.add({sound.name, key, "everything", scene.duration, whole.seconds, whole.seconds,
                  static_cast<double>(playCount), BenchCell(), BenchCell(), BenchCell(), BenchCell()});
        params.leaveOut = true;
        for (const double tolerance : {-80.0, -60.0, -40.0})
        {
            params.tolerance = tolerance;
            const auto run = timed(settings.repeats, [&] { return rendered(scene, params); });
            const double error = errorOf(run.result.samples, whole.result.samples);
            const double predicted = run.result.report.predictedError;
            rows.add({sound.name, key, fmt::format("{:.0f} dB", tolerance), scene.duration, run.seconds, whole.seconds,
                      static_cast<double>(run.result.report.keptPlays), levelCell(predicted), levelCell(error),
                      errorShare(-error), error <= predicted && predicted <= tolerance ? 100.0 : 0.0});
        }
    }
}
} // namespace

Bench scenesBench()
{
    return {
        "scenes",
        "Scenes: what leaving out saves and costs",
        "64 plays of the clip that the encoder makes of each sound (first 5 s), each transposed and varied by "
        "itself, begin within a second; some are audible, of the others one in eight comes after the end of the "
        "scene and the rest are 70 to 100 dB down. The tolerance is what leaving out may cost all together; time "
        "is that of the plan and of 48 kHz output. Errors are energies below the scene's with everything; bounds "
        "hold where the measured error is at most the predicted one and that at most the tolerance. Most of these "
        "scenes "
        "exceed full drive, so the errors are those behind the limiter.",
        columnsOf({"audible", "tolerance"}, {summed("duration", "s"),
                                             summed("seconds", "s"),
                                             summed("everythingSeconds", "s"),
                                             {"plays", ""},
                                             {"predicted", "dB"},
                                             {"measured", "dB"},
                                             {"error", "%"},
                                             {"boundsHold", "%"},
                                             {"timesRealTime", "", Reduction::ratio, "duration", "seconds"},
                                             {"time", "ms/s", Reduction::ratio, "seconds", "duration", 1000.0},
                                             {"timesFaster", "", Reduction::ratio, "everythingSeconds", "seconds"}}),
        {{"", "Error of leaving out against time", "audible", "time", "error", "tolerance"}},
        {},
        measureScenes};
}

} // namespace pacini::cli
