#pragma once

// Random actuators driven as hard as can be on every way that a drive takes, and what that does to them by an
// integration of its own.

#include "actuator/Witness.h"

#include <pacini/actuator/OutputFilter.h>
#include <pacini/actuator/Protection.h>
#include <pacini/foundation/Random.h>
#include <pacini/realtime/Translator.h>
#include <pacini/synthesis/CompilePlan.h>
#include <pacini/synthesis/ScenePlayer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace pacini::test
{

/// A random actuator and how it is driven.
struct LimitCase
{
    enum class Way
    {
        stage, ///< the protection alone, by an adversary who sees the mass
        scene, ///< plan, decoder, output filter and all
        live   ///< the translator
    };
    Way way = Way::stage;
    Profile profile;
    double fs = 48000.0;
    std::size_t frames = 0;
    double swing = 67.0; ///< Hz at which it is driven: its resonance, held or worn
};

/// Overdrive of 1 to 10, limits from half to three times the worst that the rated drive can do. Resonance, rate and
/// length are chosen so that the mass has the time to gather way.
inline LimitCase randomLimitCase(Random& random)
{
    const auto wide = [&](double low, double high)
    {
        return low * std::pow(high / low, random.uniform());
    };
    const auto chance = [&](double share)
    {
        return random.uniform() < share;
    };
    constexpr std::array rates{8000.0, 16000.0, 22050.0, 44100.0, 48000.0, 96000.0, 192000.0, 384000.0, 768000.0};
    constexpr std::size_t sceneRates = 7;
    LimitCase result;
    const double dice = random.uniform();
    result.way = dice < 0.5 ? LimitCase::Way::stage : dice < 0.8 ? LimitCase::Way::scene : LimitCase::Way::live;
    const std::size_t count = result.way == LimitCase::Way::scene ? sceneRates : rates.size();
    const bool audio = result.way != LimitCase::Way::stage;
    result.fs = audio && chance(0.7) ? 8000.0 : rates[random.next() % count];
    Profile& profile = result.profile;
    profile.technology = chance(0.1) ? Technology::erm : static_cast<Technology>(1 + random.next() % 5);
    const double q = chance(0.7) ? wide(1.0, 60.0) : wide(0.05, 1000.0);
    const double highest = std::min(20000.0, audio ? 2000.0 : 0.3 * result.fs);
    const double lowest = std::clamp(q * result.fs / 3000.0, 5.0, 0.7 * highest);
    profile.resonance = {wide(lowest, highest), q};
    profile.range.lowFrequency = std::clamp(profile.resonance.frequency * wide(0.02, 1.0), 1.0, 10000.0);
    profile.range.highFrequency =
        std::clamp(profile.resonance.frequency * wide(1.01, 20.0), profile.range.lowFrequency * 1.01, 20000.0);
    profile.range.dynamicRange = random.uniform(10.0, 100.0);
    profile.response = {wide(1e-3, 0.1), wide(1e-3, 0.1)};
    profile.polyphony = chance(0.5) ? 1 : static_cast<int>(random.next() % 65);
    profile.frequencyMapping = static_cast<FrequencyMapping>(random.next() % 3);
    ActuatorDrive& drive = profile.drive;
    drive.overdrive = chance(0.1) ? 1.0 : random.uniform(1.0, 10.0);
    const double build = q * result.fs / (std::numbers::pi * profile.resonance.frequency);
    result.frames = static_cast<std::size_t>(std::clamp(4.0 * build, audio ? 1000.0 : 500.0, 5000.0));
    const auto limit = [&](double rated)
    {
        return rated * random.uniform(0.5, 3.0);
    };
    if (chance(0.85))
    {
        // The worst of a drive within +-1: each half swing adds 1 + overshoot, whose sum is a geometric series.
        drive.excursion = wide(1e-6, 1e-3);
        const double zeta = 0.5 / q;
        const double overshoot = zeta < 1.0 ? std::exp(-std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta)) : 0.0;
        drive.maxExcursion = std::min(0.1, limit(*drive.excursion * (1.0 + overshoot) / (1.0 - overshoot)));
    }
    if (chance(0.75))
    {
        drive.impedance = wide(1.0, 100.0);
        drive.maxVoltageRms = wide(0.1, 30.0);
        const double rated = *drive.maxVoltageRms * *drive.maxVoltageRms / *drive.impedance;
        drive.maxPower = std::min(1000.0, limit(profile.technology == Technology::erm ? rated : 2.0 * rated));
        const double seconds = static_cast<double>(result.frames) / result.fs;
        drive.thermalTime = chance(0.8) ? std::max(0.01, seconds * wide(0.02, 2.0)) : wide(0.01, 100.0);
    }
    if (chance(0.2))
        for (std::uint64_t i = 1 + random.next() % 3; i > 0; --i)
        {
            EqualizerSection section;
            section.type = static_cast<EqualizerType>(random.next() % 4);
            section.frequency = std::clamp(profile.resonance.frequency * wide(0.3, 3.0), 1.0, 20000.0);
            section.gain = random.uniform(-20.0, 30.0);
            section.q = wide(0.3, 20.0);
            profile.equalizer.pushBack(section);
        }
    if (chance(0.1))
        profile.body = BodyParams{};
    else if (chance(0.6))
        wear(profile, random);
    if (profile.body)
    {
        // Mostly the force that the stated travel needs.
        const double w0 = 2.0 * std::numbers::pi * profile.resonance.frequency;
        const double stated = profile.body->movingMass * w0 * w0 * drive.excursion.value_or(1e-4);
        profile.body->force = std::clamp(stated * (chance(0.8) ? 1.0 : wide(0.5, 2.0)), 1e-6, 1e3);
    }
    result.swing = profile.body && chance(0.6)
                       ? std::min(loadedResonance(*profile.body, profile.resonance).frequency, 0.4 * result.fs)
                       : profile.resonance.frequency;
    if (chance(0.3))
        profile.transient = {static_cast<TransientShape>(random.next() % 3),
                             std::clamp(profile.resonance.frequency, 1.0, 2000.0), wide(0.5, 20.0)};
    return result;
}

/// Sounds that are hard on a resonance: tones and squares on it, bursts timed by it, sweeps over it, beats, noise,
/// steps.
inline std::vector<float> hardSound(Random& random, const LimitCase& limitCase, double level)
{
    const double f0 = limitCase.swing;
    const double w = 2.0 * std::numbers::pi / limitCase.fs;
    const auto kind = random.next() % 8;
    const double detuned = f0 * random.uniform(0.9, 1.1);
    const double length = std::max(2.0, limitCase.fs / f0 * std::floor(random.uniform(1.0, 40.0)));
    const double share = random.uniform(0.1, 0.9);
    std::vector<float> x(limitCase.frames);
    for (std::size_t n = 0; n < x.size(); ++n)
    {
        const auto t = static_cast<double>(n);
        const double tone = std::sin(w * f0 * t);
        const double part = t / static_cast<double>(x.size());
        const double y = kind == 0   ? tone
                         : kind == 1 ? std::copysign(1.0, tone)
                         : kind == 2 ? (std::fmod(t, length) < share * length ? tone : 0.0)
                         : kind == 3 ? std::sin(w * f0 * t * (0.5 + 0.5 * part))
                         : kind == 4 ? 0.5 * (tone + std::sin(w * detuned * t))
                         : kind == 5 ? random.uniform(-1.0, 1.0)
                         : kind == 6 ? std::copysign(1.0, std::sin(w * detuned * t + 0.5 * share))
                                     : (std::fmod(t, length) < share * length ? 1.0 : -1.0);
        x[n] = static_cast<float>(level * y);
    }
    return x;
}

/// The protection under a bang-bang drive that an adversary who sees the mass, held or worn, chooses: with the
/// velocity, which is the worst that a drive within bounds can do, or against it for a while to gather way; now and
/// then a hard sound instead.
template <typename Mass>
Strain strainOfStage(const LimitCase& limitCase, Random& random)
{
    Protection protection;
    protection.prepare({limitCase.fs, 64});
    const double lookAhead = random.uniform() < 0.7 ? 0.0 : random.uniform(0.0, 1e-3);
    protection.setParams(protectionParams(limitCase.profile, Seconds(lookAhead)));
    protection.reset();
    Witness<Mass> witness(limitCase.profile, limitCase.fs);
    const double level = random.uniform() < 0.5 ? 1.0 : std::pow(10.0, random.uniform(-0.3, 2.0));
    if (random.uniform() < 0.4)
    {
        auto x = hardSound(random, limitCase, level);
        for (std::size_t i = 0; i < x.size(); i += 64)
        {
            const auto block = std::span(x).subspan(i, std::min<std::size_t>(64, x.size() - i));
            protection.process(block, block);
        }
        witness.hold(x);
        return witness.strain();
    }
    const auto turn = static_cast<std::size_t>(random.uniform(0.3, 1.5) * static_cast<double>(limitCase.frames));
    const bool seesWorn = witness.movingAsWorn() != nullptr && limitCase.swing != limitCase.profile.resonance.frequency;
    for (std::size_t n = 0; n < limitCase.frames; ++n)
    {
        const bool along = n % (turn + 1) < turn * 3 / 4;
        const auto pushed = [along](const auto& mass)
        {
            return along ? mass.velocity() : mass.displacement();
        };
        const double way = seesWorn ? pushed(*witness.movingAsWorn()) : pushed(witness.moving());
        auto u = static_cast<float>(way < 0.0 ? -level : level);
        protection.process(std::span(&u, 1), std::span(&u, 1));
        witness.hold(u);
    }
    return witness.strain();
}

/// A clip around the resonance: full amplitudes, tones, bursts, sweeps and beats, events and noise.
inline Clip hardClip(Random& random, const LimitCase& limitCase)
{
    const double f0 = limitCase.swing;
    Clip clip;
    clip.duration = static_cast<double>(limitCase.frames) / limitCase.fs;
    const double end = clip.duration;
    const auto band = [&](double f, Curve amplitude, Curve pitch)
    {
        clip.bands.push_back({f / 1.3, f, f * 1.3, 0, std::move(amplitude), std::move(pitch)});
    };
    const auto kind = random.next() % 6;
    if (kind == 0 || kind == 4)
        band(f0, {{0.0, 1.0}, {end, 1.0}}, {{0.0, f0}, {end, f0}});
    if (kind == 1)
        band(f0, {{0.0, 1.0}, {end, 1.0}}, {{0.0, 0.6 * f0}, {end, 1.4 * f0}});
    if (kind == 2)
    {
        Curve bursts;
        const double length = std::max(end / 20.0, random.uniform(1.0, 30.0) / f0);
        for (double t = 0.0; t + length < end && bursts.size() < 60; t += length)
        {
            const double level = bursts.size() % 4 < 2 ? 1.0 : 0.0;
            bursts.push_back({t, level});
            bursts.push_back({t + 0.9 * length, level});
        }
        band(f0, std::move(bursts), {{0.0, f0}, {end, f0}});
    }
    if (kind == 3)
        for (const double f : {f0, f0 * random.uniform(0.9, 1.1)})
            band(f, {{0.0, 1.0}, {end, 1.0}}, {{0.0, f}, {end, f}});
    if (kind >= 4)
        for (double t = 0.0; t < end && clip.transients.size() < 50; t += std::max(end / 40.0, 1.0 / f0))
            clip.transients.push_back({t, random.uniform(0.5, 2.0), random.uniform()});
    if (random.uniform() < 0.2)
        clip.noise.push_back({f0 / 1.3, f0 * 1.3, {{0.0, 0.5}, {end, 0.5}}});
    return clip;
}

/// A scene of one to three actuators with live gains, as it is rendered; the silence behind its end counts too.
template <typename Mass>
Strain strainOfScene(const LimitCase& limitCase, Random& random)
{
    Scene scene;
    scene.clips = {hardClip(random, limitCase)};
    scene.gain = random.uniform(0.0, 40.0);
    scene.actuators = random.uniform() < 0.8 ? 1 : 3;
    scene.plays.resize(random.uniform() < 0.8 ? 1 : 2);
    for (ScenePlay& play : scene.plays)
        play.pan = random.uniform();
    CompileParams compile;
    compile.sampleRate = limitCase.fs;
    compile.adapt = random.uniform() < 0.6;
    compile.leaveOut = random.uniform() < 0.5;
    const std::array boosts{0.0, 6.0, 20.0, 40.0};
    compile.adaptation.maxBoost = Decibels(boosts[random.next() % boosts.size()]);
    compile.adaptation.strength = random.uniform();
    auto plan = compilePlan(scene, &limitCase.profile, compile);
    if (!plan)
        return {};
    Profile moved = limitCase.profile;
    if (plan->motor) // it turns, nothing swings
        moved.drive.maxExcursion.reset();
    ScenePlayerParams params;
    params.sampleRate = limitCase.fs;
    params.lookAhead = Seconds(random.uniform() < 0.5 ? 0.001 : random.uniform(0.0, 0.001));
    ScenePlayer player(std::move(*plan), params);
    const std::size_t channels = player.actuators();
    std::vector<Witness<Mass>> witnesses(channels, Witness<Mass>(moved, limitCase.fs));
    constexpr std::size_t blockFrames = 500;
    std::vector<std::vector<float>> samples(channels, std::vector<float>(blockFrames));
    const std::vector<std::span<float>> out(samples.begin(), samples.end());
    for (std::size_t done = 0; done < limitCase.frames + blockFrames; done += blockFrames)
    {
        if (random.uniform() < 0.1)
            player.setGain(0, random.uniform(-10.0, 10.0));
        player.process(out);
        for (std::size_t a = 0; a < channels; ++a)
            witnesses[a].hold(samples[a]);
    }
    Strain worst;
    for (const auto& witness : witnesses)
        worst.add(witness.strain());
    return worst;
}

/// The translator under a hard sound, turned up, bypassed at times, with new set-ups of the same actuator.
template <typename Mass>
Strain strainOfLive(const LimitCase& limitCase, Random& random)
{
    TranslatorSetup setup;
    setup.profile = limitCase.profile;
    setup.bands.bands = 1 + random.next() % 6;
    setup.maxBoost = Decibels(random.uniform() < 0.5 ? 6.0 : 40.0 * random.uniform());
    setup.strength = random.uniform();
    Translator translator;
    translator.setSetup(setup);
    translator.prepare({limitCase.fs, 256});
    TranslatorParams params;
    params.inputGain = random.uniform(0.0, 40.0);
    params.intensity = random.uniform(0.0, 24.0);
    params.bypass = random.uniform() < 0.2;
    translator.setParams(params);
    Profile moved = limitCase.profile;
    if (moved.technology == Technology::erm)
        moved.drive.maxExcursion.reset();
    Witness<Mass> witness(moved, limitCase.fs);
    auto x = hardSound(random, limitCase, std::pow(10.0, random.uniform(-1.0, 0.3)));
    x.resize(x.size() + 500, 0.0f);
    for (std::size_t i = 0; i < x.size(); i += 250)
    {
        const double dice = random.uniform();
        if (dice < 0.05)
        {
            setup.bands.bands = 1 + random.next() % 6;
            translator.setSetup(setup);
        }
        else if (dice < 0.1)
        {
            params.bypass = !params.bypass;
            translator.setParams(params);
        }
        const auto block = std::span(x).subspan(i, std::min<std::size_t>(250, x.size() - i));
        translator.process(block, block);
    }
    witness.hold(x);
    return witness.strain();
}

/// The case of a seed and its strain.
template <typename Mass>
std::pair<LimitCase, Strain> runLimitCase(std::uint64_t seed)
{
    Random random(seed);
    const LimitCase limitCase = randomLimitCase(random);
    switch (limitCase.way)
    {
    case LimitCase::Way::scene:
        return {limitCase, strainOfScene<Mass>(limitCase, random)};
    case LimitCase::Way::live:
        return {limitCase, strainOfLive<Mass>(limitCase, random)};
    case LimitCase::Way::stage:
        break;
    }
    return {limitCase, strainOfStage<Mass>(limitCase, random)};
}

} // namespace pacini::test
