#include "cli/ProgramFolder.h"
#include "cli/bench/Bench.h"
#include "cli/bench/Timed.h"
#include "io/ProfileFile.h"
#include "io/ShippedProfiles.h"

#include <pacini/actuator/FeltModel.h>
#include <pacini/analysis/EncodeSound.h>
#include <pacini/evaluate/Hts.h>
#include <pacini/evaluate/HtsAnalyzer.h>
#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini::cli
{

namespace
{
constexpr double actuatorsExcerpt = 10.0; // s of each sound

/// Ways to play a clip on an actuator.
std::vector<std::pair<std::string, CompileParams>> ways()
{
    CompileParams asItIs, unflattened, adapted, strong;
    asItIs.adapt = false;
    unflattened.adaptation.maxBoost = 0_dB;
    strong.adaptation.maxBoost = 12_dB;
    return {{"as it is", asItIs}, {"not flattened", unflattened}, {"adapted", adapted}, {"boost 12 dB", strong}};
}

/// The drive signal at 48 kHz, with the protection.
std::vector<float> drive(const Clip& clip, const Profile& profile, const CompileParams& params)
{
    Scene scene;
    scene.clips = {clip};
    scene.plays.resize(1);
    auto plan = compilePlan(scene, &profile, params);
    if (!plan)
        return {};
    ScenePlayer player(std::move(*plan));
    std::vector<float> signal(static_cast<std::size_t>(player.totalFrames()));
    const std::span<float> all(signal);
    player.process(std::span(&all, 1));
    return signal;
}

/// What the skin gets, m/s^2; the drive itself where the profile has no body.
std::vector<float> felt(std::vector<float> signal, const Profile& profile)
{
    const auto params = feltModelParams(profile);
    if (!params)
        return signal;
    constexpr std::size_t blockFrames = 4096;
    FeltModel model;
    model.prepare({48000.0, blockFrames});
    model.setParams(*params);
    model.reset();
    for (std::size_t i = 0; i < signal.size(); i += blockFrames)
    {
        const auto part = std::span(signal).subspan(i, std::min(blockFrames, signal.size() - i));
        model.process(part, part);
    }
    return signal;
}

double levelOf(const std::vector<float>& signal)
{
    double energy = 0.0;
    for (const float v : signal)
        energy += static_cast<double>(v) * static_cast<double>(v);
    return 10.0 * std::log10(std::max(energy / static_cast<double>(std::max<std::size_t>(signal.size(), 1)), 1e-12));
}

void measureActuators(const BenchSound& sound, const BenchSettings& settings, BenchTable& rows)
{
    HtsAnalyzer analyzer;
    const auto mono = sound.beginning(actuatorsExcerpt);
    const auto source = htsSourceFeatures(analyzer, mono, sound.sampleRate);
    if (!source)
        return;
    EncoderParams bands; // HTS hears nothing of what lies above the range of touch
    bands.audible = 0.0;
    Encoder encoder{bands};
    const Clip clip = encodePrecisely(encoder, {sound.sampleRate, 1}, SoundParts(mono, 1)).value();
    for (const ShippedProfile& shipped : shippedProfiles(programFolder()))
    {
        const auto profile = readProfile(shipped.path);
        if (!profile)
            continue;
        for (const auto& [name, params] : ways())
        {
            const auto run = timed(settings.repeats, [&, &way = params] { return drive(clip, *profile, way); });
            const auto acceleration = felt(run.result, *profile);
            const auto features = htsCandidateFeatures(analyzer, std::span<const float>(acceleration), 48000);
            if (!features)
                continue;
            const HtsScore score = compare(*source, *features, HtsMode::translation);
            rows.add({sound.name, shipped.name, name, clip.duration, run.seconds, score.score, 100.0 * score.wide,
                      100.0 * score.band, 100.0 * score.spectrum, 100.0 * score.event, levelOf(acceleration)});
        }
    }
}
} // namespace

Bench actuatorsBench()
{
    Bench bench{
        "actuators",
        "Actuators: what adapting a clip gains on each shipped profile",
        "The clip that the encoder makes of the bands of each sound (first 10 s, --audible 0) is played at 48 kHz on "
        "every shipped profile, "
        "with its protection: as it is; adapted without flattening; adapted (the default: the inverse of the "
        "resonance raises the drive by at most 6 dB); and with 12 dB. HTS and its parts compare the sound with the "
        "acceleration at the skin that the profile's body model predicts (with the drive where there is none). "
        "Level is the felt acceleration in dB below or above 1 m/s^2 RMS: flattening trades some for likeness.",
        columnsOf({"profile", "played"}, {summed("duration", "s"),
                                          summed("seconds", "s"),
                                          {"HTS", ""},
                                          {"wide", "%"},
                                          {"band", "%"},
                                          {"spectrum", "%"},
                                          {"events", "%"},
                                          {"level", "dB"},
                                          {"timesRealTime", "", Reduction::ratio, "duration", "seconds"}}),
        {{"", "Likeness against felt level", "played", "level", "HTS", "profile", {}, {}, false}},
        {},
        measureActuators};
    bench.needsProfiles = true;
    return bench;
}

} // namespace pacini::cli
