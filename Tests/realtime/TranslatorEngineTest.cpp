#include "support/ActuatorOf.h"
#include "support/Catch.h"
#include "support/Pinned.h"

#include <pacini/foundation/Random.h>
#include <pacini/realtime/TranslatorEngine.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
/// Frames at the inner rate and the peaks of the full band beside them.
struct EngineSound
{
    std::vector<float> frames, peaks;
};

/// 1.2 s of what a translator may hear: a low and a high tone that rise, a chord, clicks at several distances, dull and
/// bright ones, a noise, a sound far above full scale, one near the gate, and silence between and behind them.
EngineSound engineSound(double fs)
{
    const auto length = static_cast<std::size_t>(1.2 * fs);
    EngineSound sound{std::vector<float>(length), std::vector<float>(length)};
    Random random(21);
    const double turn = 2.0 * std::numbers::pi;
    for (std::size_t n = 0; n < length; ++n)
    {
        const double t = static_cast<double>(n) / fs;
        double x = 0.0, bright = 0.0;
        if (t < 0.15)
            x = 0.6 * (t / 0.15) * std::sin(turn * 45.0 * t) + 0.2 * std::sin(turn * 230.0 * t);
        else if (t < 0.30)
            x = 0.3 * std::sin(turn * (80.0 + 800.0 * (t - 0.15)) * t) + 0.15 * std::sin(turn * 700.0 * t + 1.0);
        else if (t >= 0.40 && t < 0.70)
        {
            // Clicks 40, 25 and 15 ms apart, every second one bright.
            for (const double at : {0.40, 0.44, 0.48, 0.52, 0.545, 0.57, 0.60, 0.615, 0.63, 0.645})
                if (t >= at && t < at + 0.008)
                {
                    const bool isBright = static_cast<int>(std::lround(at * 1000.0)) % 10 != 0;
                    const double decay = std::exp(-(t - at) / 0.0015);
                    x += (isBright ? 0.05 : 0.8) * decay * std::sin(turn * 180.0 * (t - at) + 0.5);
                    bright = std::max(bright, 0.7 * decay);
                }
        }
        else if (t >= 0.70 && t < 0.80)
            x = 0.4 * random.uniform(-1.0, 1.0);
        else if (t >= 0.80 && t < 0.85)
            x = 3.0 * std::sin(turn * 110.0 * t);
        else if (t >= 0.85 && t < 0.95)
            x = 0.0003 * std::sin(turn * 150.0 * t);
        else if (t >= 1.02 && t < 1.10)
            x = 0.5 * std::sin(turn * 95.0 * t) + 0.3 * std::sin(turn * 130.0 * t);
        sound.frames[n] = static_cast<float>(x);
        sound.peaks[n] = static_cast<float>(std::max(bright, 1.1 * std::abs(x)));
    }
    return sound;
}

/// What the engine plays of the sound in pieces, which must not matter, and, at the end, frame and size of each event
/// and the power of each band every 50 ms.
struct EngineResult
{
    std::vector<double> drive, events, powers, limiter;
};

EngineResult engineResult(const TranslatorSetup& setup, const TranslatorParams& params, double fs = 6000.0,
                          const std::function<void(TranslatorEngine&, std::size_t)>& between = {})
{
    const TranslatorDesign design = designTranslator(setup, fs);
    TranslatorEngine engine;
    engine.adopt(design);
    engine.setParams(params);
    engine.reset();
    const EngineSound sound = engineSound(fs);
    std::vector<float> out(sound.frames.size());
    EngineResult result;
    const auto onEvent = [&](std::uint64_t frame, double level)
    {
        result.events.push_back(static_cast<double>(frame));
        result.events.push_back(level);
    };
    std::size_t done = 0, piece = 0;
    while (done < out.size())
    {
        if (between)
            between(engine, done);
        const std::size_t n =
            std::min<std::size_t>(std::array<std::size_t, 4>{5, 64, 1, 133}[piece++ % 4], out.size() - done);
        engine.process(std::span(sound.frames).subspan(done, n), std::span(sound.peaks).subspan(done, n), {},
                       std::span(out).subspan(done, n), onEvent);
        done += n;
        if (piece % 16 == 0)
        {
            for (std::size_t k = 0; k < design.bands.size(); ++k)
                result.powers.push_back(engine.bandPower(k));
            result.limiter.push_back(engine.takeLimiterGain());
        }
    }
    result.drive.assign(out.begin(), out.end());
    return result;
}

void pinEngine(const std::string& name, const EngineResult& result)
{
    // The quiet parts count as well as the loud ones.
    const std::size_t third = result.drive.size() / 3;
    const std::span<const double> drive(result.drive);
    checkPinned("realtime/engine, " + name + ", beginning", drive.first(third), 3e-6);
    checkPinned("realtime/engine, " + name + ", middle", drive.subspan(third, third), 3e-6);
    checkPinned("realtime/engine, " + name + ", end", drive.subspan(2 * third), 3e-6);
    checkPinned("realtime/engine, " + name + ", events", result.events, 1e-6);
    checkPinned("realtime/engine, " + name + ", powers", result.powers, 1e-6);
    checkPinned("realtime/engine, " + name + ", limiter", result.limiter, 1e-6);
}

TranslatorSetup engineSetup(Technology technology, double low, double high, double range, int polyphony)
{
    TranslatorSetup setup;
    setup.strength = 0.0;
    Profile& profile =
        setup.profile.emplace(test::actuatorOf(technology, {std::sqrt(low * high), 6.0}, {low, high, range}));
    profile.polyphony = polyphony;
    return setup;
}

TranslatorParams carrierParams()
{
    return {.direct = 0.0};
}
} // namespace

TEST_CASE("the engine without an actuator plays what it played before", "[realtime]")
{
    pinEngine("plain", engineResult({}, {}));
    TranslatorParams half;
    half.direct = 0.4;
    half.rumble.level = 4.0;
    half.texture.level = -5.0;
    half.transients.level = 6.0;
    half.inputGain = 3.0;
    half.intensity = -4.0;
    half.brightness = 3.0;
    half.attack = 15.0;
    half.release = 60.0;
    pinEngine("half direct", engineResult({}, half, 7350.0));
    TranslatorParams sharp;
    sharp.transientSensitivity = 0.8;
    sharp.transientSharpness = 0.6;
    sharp.gateThreshold = -40.0;
    sharp.gateRelease = 20.0;
    sharp.rumble.muted = true;
    pinEngine("sharp events", engineResult({}, sharp));
    TranslatorParams dull;
    dull.transientSensitivity = 0.2;
    dull.transientSharpness = -0.7;
    dull.texture.muted = true;
    dull.brightness = -60.0;
    dull.transients.level = 12.0;
    pinEngine("dull events", engineResult({}, dull));
}

TEST_CASE("the engine's carriers play what they played before", "[realtime]")
{
    pinEngine("carriers", engineResult({}, carrierParams()));
    TranslatorParams up = carrierParams();
    up.transposition = 7.0;
    up.direct = 1.0;
    up.rumble.level = -6.0;
    pinEngine("transposed", engineResult({}, up));
    TranslatorSetup twelve;
    twelve.bands = {.bands = 12, .low = Hertz(40.0), .high = Hertz(900.0), .kind = BandLayoutKind::tiled};
    pinEngine("twelve bands", engineResult(twelve, carrierParams(), 8000.0));
    TranslatorSetup linear;
    linear.bands = {.bands = 3, .low = Hertz(20.0), .high = Hertz(500.0), .spacing = BandSpacing::linear};
    pinEngine("linear bands", engineResult(linear, carrierParams()));
}

TEST_CASE("the engine with few voices plays what it played before", "[realtime]")
{
    pinEngine("one voice", engineResult(engineSetup(Technology::lra, 150.0, 190.0, 40.0, 1), {}));
    pinEngine("two voices", engineResult(engineSetup(Technology::vca, 60.0, 300.0, 50.0, 2), {}));
    TranslatorParams params;
    params.transposition = -3.0;
    params.release = 200.0;
    params.texture.level = 5.0;
    auto shifted = engineSetup(Technology::vca, 80.0, 200.0, 25.0, 3);
    shifted.profile->frequencyMapping = FrequencyMapping::rescale;
    shifted.bands.bands = 8;
    pinEngine("three voices", engineResult(shifted, params));
}

TEST_CASE("the engine with an actuator of any waveform plays what it played before", "[realtime]")
{
    auto guarded = engineSetup(Technology::vca, 50.0, 400.0, 30.0, 64);
    guarded.profile->drive.excursion = 0.0006;
    guarded.profile->drive.maxExcursion = 0.001;
    guarded.profile->drive.overdrive = 1.5;
    guarded.profile->transient = {TransientShape::sine, 90.0, 1.5};
    TranslatorParams params;
    params.direct = 0.7;
    pinEngine("guarded", engineResult(guarded, params));
    auto equalised = engineSetup(Technology::vca, 100.0, 250.0, 45.0, 64);
    equalised.profile->equalizer = {{EqualizerType::peak, 150.0, -8.0, 3.0, 1},
                                    {EqualizerType::peak, 5000.0, 3.0, 9.0, 1}};
    equalised.profile->transient = {TransientShape::square, 120.0, 1.0};
    equalised.maxBoost = Decibels(0.0);
    pinEngine("equalised", engineResult(equalised, {}));
}

TEST_CASE("the engine with a motor plays what it played before", "[realtime]")
{
    auto motor = engineSetup(Technology::erm, 120.0, 200.0, 30.0, 0);
    motor.profile->response = {0.04, 0.06};
    motor.profile->drive.overdrive = 1.4;
    pinEngine("motor", engineResult(motor, {}));
    TranslatorParams quiet;
    quiet.texture.level = -8.0;
    quiet.rumble.level = 2.0;
    quiet.transients.level = 8.0;
    quiet.transientSensitivity = 0.7;
    pinEngine("motor of other levels", engineResult(motor, quiet, 11025.0));
}

TEST_CASE("the engine plays parameters that change as before", "[realtime]")
{
    TranslatorParams other;
    other.intensity = -9.0;
    other.inputGain = 4.0;
    other.rumble.level = 6.0;
    other.direct = 0.2;
    other.transposition = 4.0;
    other.brightness = 5.0;
    other.gateThreshold = -30.0;
    pinEngine("changing", engineResult({}, {}, 6000.0,
                                       [&](TranslatorEngine& engine, std::size_t done)
                                       { engine.setParams(done / 900 % 2 == 0 ? TranslatorParams{} : other); }));
}

TEST_CASE("a reset engine is a new one", "[realtime]")
{
    for (const bool motor : {false, true})
    {
        TranslatorSetup setup;
        if (motor)
            setup = engineSetup(Technology::erm, 120.0, 200.0, 30.0, 0);
        const TranslatorDesign design = designTranslator(setup, 6000.0);
        const EngineSound sound = engineSound(6000.0);
        TranslatorParams params = carrierParams();
        params.direct = 0.5;
        const auto run = [&](TranslatorEngine& engine, std::size_t frames)
        {
            std::vector<double> heard;
            std::vector<float> out(frames);
            const auto onEvent = [&](std::uint64_t frame, double level)
            {
                heard.push_back(static_cast<double>(frame));
                heard.push_back(level);
            };
            engine.process(std::span(sound.frames).first(frames), std::span(sound.peaks).first(frames), {}, out,
                           onEvent);
            heard.insert(heard.end(), out.begin(), out.end());
            for (std::size_t k = 0; k < design.bands.size(); ++k)
                heard.push_back(engine.bandPower(k));
            heard.push_back(engine.takeLimiterGain());
            return heard;
        };
        TranslatorEngine fresh;
        fresh.adopt(design);
        fresh.setParams(params);
        fresh.reset();
        const auto expected = run(fresh, 5000);
        for (const std::size_t frames : {1003u, 2600u, 5200u})
        {
            CAPTURE(motor, frames);
            TranslatorEngine engine;
            engine.adopt(design);
            engine.setParams(params);
            (void)run(engine, frames);
            engine.reset();
            CHECK(engine.bandPower(0) == 0.0);
            CHECK(run(engine, 5000) == expected);
        }
    }
}

TEST_CASE("an engine that takes another design begins with the gains that belong to it", "[realtime]")
{
    // Of a motor everything is played directly, of the others as much as the parameters say.
    const TranslatorDesign motor = designTranslator(engineSetup(Technology::erm, 120.0, 200.0, 30.0, 0), 6000.0);
    TranslatorSetup wide;
    wide.bands = {.bands = 5, .low = Hertz(40.0), .high = Hertz(700.0)};
    const TranslatorDesign plain = designTranslator({}, 6000.0), other = designTranslator(wide, 6000.0);
    TranslatorParams params;
    params.direct = 0.4;
    params.rumble.level = 6.0;
    params.texture.level = -6.0;
    params.brightness = 3.0;
    params.transients.muted = true; // what is an event depends on what came before
    const EngineSound sound = engineSound(6000.0);
    const auto play = [&](TranslatorEngine& engine)
    {
        const std::size_t begin = 4200, frames = 2400; // noise at first, of all that is heard
        std::vector<float> out(frames);
        engine.process(std::span(sound.frames).subspan(begin, frames), std::span(sound.peaks).subspan(begin, frames),
                       {}, out, [](std::uint64_t, double) {});
        return out;
    };
    for (const TranslatorDesign* before : {&motor, &other})
    {
        CAPTURE(before == &motor);
        TranslatorEngine fresh;
        fresh.setParams(params);
        fresh.adopt(plain);
        fresh.reset();
        TranslatorEngine engine;
        engine.setParams(params);
        engine.adopt(*before);
        std::vector<float> silence(40 * controlHop), out(silence.size());
        engine.process(silence, silence, {}, out, [](std::uint64_t, double) {});
        engine.adopt(plain);
        CHECK(play(engine) == play(fresh));
    }
}

TEST_CASE("a gate opens at its threshold, stays open above half of it and for its release, and closes over "
          "another one",
          "[realtime]")
{
    LiveGate gate;
    CHECK(gate.closed());
    gate.setParams(0.5, 4.0);
    CHECK(gate.tick(0.4999) == 0.0);
    CHECK(gate.closed());
    CHECK(gate.tick(0.5) == 1.0);
    CHECK_FALSE(gate.closed());
    for (int i = 0; i < 20; ++i)
        CHECK(gate.tick(0.25) == 1.0);
    for (int i = 0; i < 4; ++i)
        CHECK(gate.tick(0.2499) == 1.0);
    CHECK(gate.tick(0.0) == 0.84375);
    CHECK(gate.tick(0.3) == 0.5); // half of the threshold holds it, but does not open it
    CHECK(gate.tick(0.0) == 0.15625);
    CHECK(gate.tick(0.0) == 0.0);
    CHECK(gate.closed());
    CHECK(gate.tick(0.0) == 0.0);
    CHECK(gate.tick(0.6) == 1.0);
    CHECK(gate.tick(0.0) == 1.0);
    CHECK(gate.tick(0.25) == 1.0); // starts the release anew
    for (int i = 0; i < 4; ++i)
        CHECK(gate.tick(0.0) == 1.0);
    CHECK(gate.tick(0.0) == 0.84375);
    (void)gate.tick(0.7);
    gate.reset();
    CHECK(gate.closed());
    CHECK(gate.tick(0.3) == 0.0);
    LiveGate open; // as constructed
    CHECK(open.tick(0.0) == 1.0);
    LiveGate fresh;
    fresh.setParams(0.1, 1.0);
    CHECK(fresh.tick(0.09) == 0.0);
    CHECK(fresh.tick(0.2) == 1.0);
    CHECK(fresh.tick(0.0) == 1.0);
    CHECK(fresh.tick(0.0) == 0.0);
}

TEST_CASE("a gate whose threshold passes the level opens over a while, and at once where the level passes it",
          "[realtime]")
{
    LiveGate gate;
    gate.setParams(0.5, 4.0, 10.0);
    CHECK(gate.tick(0.3) == 0.0);
    gate.setParams(0.1, 4.0, 10.0);
    for (int i = 1; i <= 10; ++i)
        CHECK(gate.tick(0.3) == Approx(0.01 * i * i * (3.0 - 0.2 * i)));
    CHECK(gate.tick(0.3) == 1.0);
    // The threshold moved in a silence: what comes then is a level that passes it.
    gate.setParams(0.5, 1.0, 10.0);
    for (int i = 0; i < 8; ++i)
        (void)gate.tick(0.0);
    CHECK(gate.closed());
    gate.setParams(0.1, 1.0, 10.0);
    CHECK(gate.tick(0.0) == 0.0);
    CHECK(gate.tick(0.3) == 1.0);
}

TEST_CASE("event pulses begin where they are told, add up, and the fifth takes the place of the first", "[realtime]")
{
    const Pulse pulse{TransientShape::square, 0.05, 20};
    const auto value = [](std::size_t n)
    {
        return n < 10 ? 1.0f : n < 20 ? -1.0f : 0.0f;
    };
    EventPulses pulses;
    CHECK(pulses.silent());
    std::vector<float> out(30, 0.5f);
    pulses.addTo(out);
    CHECK(out == std::vector<float>(30, 0.5f));
    pulses.begin(pulse, 0.5, 3);
    CHECK_FALSE(pulses.silent());
    pulses.addTo(std::span(out).first(8));
    CHECK_FALSE(pulses.silent());
    pulses.begin(pulse, 0.25, 2);
    pulses.addTo(std::span(out).subspan(8, 15)); // the first is over, the second not
    CHECK_FALSE(pulses.silent());
    pulses.addTo(std::span(out).subspan(23));
    CHECK(pulses.silent());
    for (std::size_t n = 0; n < out.size(); ++n)
    {
        CAPTURE(n);
        CHECK(out[n] == 0.5f + (n >= 3 ? 0.5f * value(n - 3) : 0.0f) + (n >= 10 ? 0.25f * value(n - 10) : 0.0f));
    }
    // A wait beyond the call counts as its end.
    std::vector<float> later(24, 0.0f);
    pulses.begin(pulse, 1.0, 99);
    pulses.addTo(std::span(later).first(4));
    pulses.addTo(std::span(later).subspan(4));
    for (std::size_t n = 0; n < later.size(); ++n)
        CHECK(later[n] == (n < 4 ? 0.0f : value(n - 4)));

    EventPulses many;
    for (const double gain : {1.0, 2.0, 4.0, 8.0, 16.0})
        many.begin(pulse, gain, 0);
    std::vector<float> sum(20, 0.0f);
    many.addTo(sum);
    CHECK(sum[0] == 30.0f);
    CHECK(sum[19] == -30.0f);
    CHECK(many.silent());
    many.begin(pulse, 1.0, 0);
    many.reset();
    CHECK(many.silent());
    many.addTo(sum);
    CHECK(sum[0] == 30.0f);
}
