#include "cli/ProgramFolder.h"
#include "cli/bench/Bench.h"
#include "cli/bench/Timed.h"
#include "io/ProfileFile.h"
#include "io/ShippedProfiles.h"

#include <pacini/actuator/FeltModel.h>
#include <pacini/actuator/Profile.h>
#include <pacini/analysis/EncodeSound.h>
#include <pacini/evaluate/Hts.h>
#include <pacini/evaluate/HtsAnalyzer.h>
#include <pacini/evaluate/match/MatchParts.h>
#include <pacini/foundation/Units.h>
#include <pacini/synthesis/RenderScene.h>

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

/// A way to play a clip on an actuator.
struct Way
{
    std::string name;
    RenderParams params;
};

/// As it is, not flattened, and the trade of strength for likeness; with `sweep` in small steps, at other boosts too.
std::vector<Way> ways(bool sweep)
{
    RenderParams asItIs, unflattened;
    asItIs.compile.adapt = false;
    unflattened.compile.adaptation.maxBoost = 0_dB;
    std::vector<Way> all{{"as it is", asItIs}, {"not flattened", unflattened}, {"adapted", {}}};
    const auto add = [&](double boost, double strength)
    {
        RenderParams params;
        params.compile.adaptation.maxBoost = Decibels(boost);
        params.compile.adaptation.strength = strength;
        std::string name = fmt::format("strength {:g}", strength);
        if (params.compile.adaptation.maxBoost != AdaptationParams{}.maxBoost)
            name += fmt::format(", boost {:g} dB", boost);
        all.push_back({std::move(name), params});
    };
    if (sweep)
        for (const double boost : {3.0, 6.0, 12.0, 18.0})
            for (int tenth = 0; tenth <= 10; ++tenth)
                add(boost, 0.1 * tenth);
    else
        for (const double strength : {0.0, 0.2, 0.6, 0.8, 1.0})
            add(AdaptationParams{}.maxBoost.value, strength);
    return all;
}

/// The part of a clip's energy, %, that its bands have where the actuator needs least drive: in the half-power band of
/// its resonance.
double shareOnResonance(const RenderPlan& plan, const Profile& profile)
{
    constexpr double step = 0.005; // s
    const Resonance worn = profile.body ? loadedResonance(*profile.body, profile.resonance) : profile.resonance;
    auto [low, high] = detail::halfPowerBand(worn);
    low *= 1.0 - 1e-6; // its ends are part of it
    high *= 1.0 + 1e-6;
    double within = 0.0, whole = 0.0;
    for (const PlannedPlay& play : plan.plays)
        for (const Band& band : play.clip.bands)
        {
            CurveReader amplitude(band.amplitude), pitch(band.pitch);
            for (double t = 0.0; t < play.clip.duration; t += step)
            {
                const double a = amplitude.at(t);
                const double f = band.pitch.empty() ? band.centreFrequency : pitch.at(t);
                whole += a * a;
                within += f >= low && f <= high ? a * a : 0.0;
            }
        }
    return whole > 0.0 ? 100.0 * within / whole : 0.0;
}

/// The drive signal of a plan, with the protection.
std::vector<float> drive(RenderPlan plan, const RenderParams& params)
{
    RenderMemory memory;
    return renderPlan(std::move(plan), params, memory) ? std::move(memory.samples) : std::vector<float>();
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
    return Decibels::fromPower(std::max(energy / static_cast<double>(std::max<std::size_t>(signal.size(), 1)), 1e-12))
        .value;
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
    const auto heard = heardTrack(mono, sound.sampleRate);
    if (!heard)
        return;
    TouchAnalyzer touch;
    const Scene scene = sceneOf(clip);
    const auto flatPlan = planScene(scene, nullptr, {});
    if (!flatPlan)
        return;
    const double flat = timed(settings.repeats, [&] { return drive(*flatPlan, {}); }).seconds;
    for (const ShippedProfile& shipped : shippedProfiles(programFolder()))
    {
        const auto profile = readProfile(shipped.path);
        if (!profile)
            continue;
        for (const Way& way : ways(settings.sweep))
        {
            const auto plan = planScene(scene, &*profile, way.params);
            if (!plan)
                continue;
            const auto run = timed(settings.repeats, [&] { return renderScene(scene, &*profile, way.params).value(); });
            const double rendering = timed(settings.repeats, [&] { return drive(*plan, way.params); }).seconds;
            const auto acceleration = felt(run.result.samples, *profile);
            const std::span<const float> skin(acceleration);
            const auto features = htsCandidateFeatures(analyzer, skin, 48000);
            const auto track = touchTrack(touch, skin, 48000);
            if (!features || !track)
                continue;
            const HtsScore score = compare(*source, *features, HtsMode::translation);
            rows.add({sound.name, shipped.name, way.name, clip.duration, run.seconds, rendering, flat, score.score,
                      100.0 * score.wide, 100.0 * score.band, 100.0 * score.spectrum, 100.0 * score.event,
                      predictedMatch(matchParts(*heard, *track)), shareOnResonance(*plan, *profile),
                      levelOf(acceleration)});
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
        "with its protection: as it is; adapted without flattening; adapted (the default); and with other strengths, "
        "from as flat as can be (0) to all of it on the resonance (1). HTS with its parts and the predicted match "
        "compare the sound with the acceleration at the skin that the profile's body model predicts (with the drive "
        "where there is none). On resonance is the part of the energy of the clip's bands that is played where the "
        "actuator needs least drive, in the half-power band of its resonance. Level is the felt acceleration in dB "
        "below or above 1 m/s^2 RMS: strength trades likeness for it. Times real time is planning and rendering; "
        "rendering is that without the plan, and of flat how fast it is beside the same clip without a profile (1 = as "
        "fast). --sweep also takes small steps of strength and "
        "other boosts.",
        columnsOf({"profile", "played"}, {summed("duration", "s"),
                                          summed("seconds", "s"),
                                          summed("renderSeconds", "s"),
                                          summed("flatSeconds", "s"),
                                          {"HTS", ""},
                                          {"wide", "%"},
                                          {"band", "%"},
                                          {"spectrum", "%"},
                                          {"events", "%"},
                                          {"match", ""},
                                          {"onResonance", "%"},
                                          {"level", "dB"},
                                          {"timesRealTime", "", Reduction::ratio, "duration", "seconds"},
                                          {"rendering", "", Reduction::ratio, "duration", "renderSeconds"},
                                          {"ofFlat", "", Reduction::ratio, "flatSeconds", "renderSeconds"}}),
        {{"", "Likeness against felt level", "profile", "level", "HTS", "played"},
         {"match", "Predicted match against felt level", "profile", "level", "match", "played"}},
        {},
        measureActuators};
    bench.needsProfiles = true;
    return bench;
}

} // namespace pacini::cli
