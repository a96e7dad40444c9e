#include "support/ActuatorOf.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"
#include "support/RandomProfile.h"

#include <pacini/realtime/Translator.h>
#include <pacini/realtime/TranslatorPresets.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <thread>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
Profile narrowLra()
{
    Profile profile = test::actuatorOf(Technology::lra, {175.0, 10.0}, {150.0, 190.0, 40.0});
    profile.polyphony = 1;
    return profile;
}

bool has(const TranslatorPlan& plan, const std::string& what)
{
    return std::any_of(plan.begin(), plan.end(), [&](const TranslatorSaving& s) { return s.what == what; });
}

/// A translator for an actuator with a resonance to flatten and limits to keep.
struct GuardedTranslator : Translator
{
    GuardedTranslator()
    {
        TranslatorSetup wanted;
        Profile profile = test::actuatorOf(Technology::vca, {67.0, 4.0}, {40.0, 400.0, 50.0});
        profile.drive = {8.0, 1.0, 0.05, {}, 0.001, 0.0006}; // ohm, V, W, s, m, m
        wanted.profile = profile;
        setSetup(wanted);
    }
};

/// One voice for all.
struct NarrowTranslator : Translator
{
    NarrowTranslator()
    {
        TranslatorSetup wanted;
        wanted.profile = narrowLra();
        setSetup(wanted);
    }
};

double shareWithin(const std::vector<float>& x, double low, double high, double fs)
{
    // Energy by a plain sum over frequencies of a whole number of periods each.
    const auto part = std::span<const float>(x).last(static_cast<std::size_t>(fs));
    double inside = 0.0, all = 0.0;
    for (double f = 5.0; f < 1500.0; f += 1.0)
    {
        const double power = std::norm(spectrumAt(part, f, fs));
        all += power;
        if (f >= low && f <= high)
            inside += power;
    }
    return inside / all;
}
} // namespace

TEST_CASE("the translator keeps the contract of blocks with a profile, limits and all", "[realtime]")
{
    checkBlockContract<GuardedTranslator>(TranslatorParams{}, {.bound = 1.0});
    checkBlockContract<NarrowTranslator>(TranslatorParams{}, {.bound = 1.0});
}

TEST_CASE("an actuator of one voice gets one tone within its range", "[realtime]")
{
    const double fs = 8000.0;
    TranslatorSetup setup;
    setup.profile = narrowLra();
    setup.maxBoost = 0_dB;
    TranslatorParams params;
    params.transients.muted = true;
    for (double f : {50.0, 90.0, 300.0, 700.0})
    {
        CAPTURE(f);
        Translator translator;
        translator.setSetup(setup);
        translator.prepare({fs, 256});
        translator.setParams(params);
        const auto out = runInBlocks(translator, sine(24000, f, fs, 0.5), 256);
        CHECK(shareWithin(out, 145.0, 195.0, fs) > 0.99);
        CHECK(std::abs(rms(std::span<const float>(out).last(8000)) * std::numbers::sqrt2 / 0.5 - 1.0) < 0.2);
    }
}

TEST_CASE("a motor gets a voltage that follows the sound's strength", "[realtime]")
{
    const double fs = 8000.0;
    TranslatorSetup setup;
    Profile motor;
    motor.technology = Technology::erm;
    motor.polyphony = 0;
    motor.range = {133.0, 200.0, 60.0};
    motor.response = {0.05, 0.05};
    motor.drive.overdrive = 1.25;
    setup.profile = motor;
    Translator translator;
    translator.setSetup(setup);
    translator.prepare({fs, 256});
    auto in = sine(16000, 120.0, fs, 0.8);
    std::fill(in.begin() + 8000, in.end(), 0.0f);
    const auto out = runInBlocks(translator, in, 256);
    // sqrt(strength) / overdrive while it sounds, braked, then at rest.
    for (std::size_t n = 4000; n < 8000; ++n)
        REQUIRE(std::abs(static_cast<double>(out[n]) - std::sqrt(0.8) / 1.25) < 0.12);
    CHECK(*std::min_element(out.begin() + 8000, out.end()) < 0.0f);
    for (std::size_t n = 14000; n < 16000; ++n)
        REQUIRE(out[n] == 0.0f);
}

TEST_CASE("the plan names what an actuator does not need", "[realtime]")
{
    Translator translator;
    const auto plain = translator.plan({});
    CHECK(has(plain, "adaptation"));
    CHECK(has(plain, "protection"));
    CHECK(has(plain, "bands[0].carrier"));
    CHECK_FALSE(has(plain, "bands[0].direct"));

    TranslatorSetup setup;
    setup.profile = narrowLra();
    translator.setSetup(setup);
    const auto narrow = translator.plan({});
    CHECK(has(narrow, "bands[0].direct"));
    CHECK_FALSE(has(narrow, "adaptation"));

    setup.profile->drive.excursion = 1e-3;
    setup.profile->drive.maxExcursion = 1e-3;
    translator.setSetup(setup);
    CHECK_FALSE(has(translator.plan({}), "protection"));

    const auto said = [](const Profile& profile)
    {
        TranslatorSetup of;
        of.profile = profile;
        const TranslatorPlan plan = designTranslator(of, 48000.0).plan;
        const auto saving =
            std::find_if(plan.begin(), plan.end(), [](const TranslatorSaving& s) { return s.what == "protection"; });
        return saving == plan.end() ? std::string() : saving->reason;
    };
    Profile bounded = narrowLra();
    CHECK(said(bounded) == "the profile names no limit of travel; the profile names no limit of heat");
    bounded.drive.excursion = 1e-5;
    bounded.drive.maxExcursion = 2e-4;
    CHECK(said(bounded) == "no drive reaches the limit of travel; the profile names no limit of heat");
    bounded.drive.overdrive = 3.0;
    CHECK(said(bounded).empty());

    TranslatorParams muted;
    muted.texture.muted = true;
    CHECK(has(translator.plan(muted), "texture"));
}

TEST_CASE("another actuator comes without a click, and the latency stays", "[realtime]")
{
    const double fs = 48000.0;
    Translator translator;
    translator.prepare({fs, 64});
    TranslatorParams params;
    params.transients.muted = true;
    translator.setParams(params);
    const auto latency = translator.latencyFrames();
    CHECK(1e3 * static_cast<double>(latency) / fs == Approx(1.3).margin(0.05)); // ms, as the pages say
    const auto in = sine(96000, 170.0, fs, 0.4);
    std::vector<float> out(in.size());
    TranslatorSetup lra;
    lra.profile = narrowLra();
    lra.maxBoost = 0_dB;
    for (std::size_t i = 0; i < in.size(); i += 64)
    {
        if (i / 64 % 200 == 100)
            translator.setSetup(i / 64 % 400 == 100 ? lra : TranslatorSetup{});
        translator.process(std::span(in).subspan(i, 64), std::span(out).subspan(i, 64));
        REQUIRE(translator.latencyFrames() == latency);
    }
    double largest = 0.0;
    for (std::size_t n = 4800; n + 1 < out.size(); ++n)
        largest = std::max(largest, std::abs(static_cast<double>(out[n + 1]) - static_cast<double>(out[n])));
    CHECK(largest < 2.0 * 0.4 * 2.0 * std::numbers::pi * 190.0 / fs);
    CHECK(rms(std::span<const float>(out).last(4800)) > 0.2);
}

TEST_CASE("where a sound begins does not decide how strongly an actuator plays it", "[realtime]")
{
    const double fs = 48000.0;
    const auto profileOf = [](double low, double high, int polyphony)
    {
        Profile profile = narrowLra();
        profile.range.lowFrequency = low;
        profile.range.highFrequency = high;
        profile.polyphony = polyphony;
        return profile;
    };
    for (const Profile& profile : {profileOf(150.0, 190.0, 1), profileOf(120.0, 320.0, 2), profileOf(40.0, 280.0, 64)})
        for (const auto& [below, above, level] : {std::array{80.0, 190.0, 0.3},
                                                  {80.0, 190.0, 0.2},
                                                  {400.0, 700.0, 0.2},
                                                  {100.0, 130.0, 0.2},
                                                  {60.0, 300.0, 0.2}})
        {
            double weakest = 1.0, strongest = 0.0;
            for (std::size_t start = 0; start < 10; ++start)
            {
                Translator translator;
                TranslatorSetup setup;
                setup.profile = profile;
                setup.strength = 0.4;
                translator.setSetup(setup);
                translator.prepare({fs, 512});
                std::vector<float> sound(96000), out(sound.size());
                for (std::size_t i = 0; i < sound.size(); ++i)
                {
                    const double turn = 2.0 * std::numbers::pi * static_cast<double>(i + 48 * start) / fs; // by 1 ms
                    sound[i] = static_cast<float>(level * std::sin(below * turn) + 0.2 * std::sin(above * turn));
                }
                translator.process(sound, out);
                const double played = rms(std::span<const float>(out).last(48000));
                weakest = std::min(weakest, played);
                strongest = std::max(strongest, played);
            }
            CAPTURE(profile.range.lowFrequency, below, above, level, weakest, strongest);
            CHECK(weakest > 0.01);
            CHECK(20.0 * std::log10(strongest / weakest) < 0.5);
        }
}

TEST_CASE("a tone that is played in part by its carrier is as strong as it is, wherever it begins", "[realtime]")
{
    const double fs = 48000.0;
    for (const double direct : {0.0, 0.3, 0.5, 0.8, 1.0})
        for (const double f : {55.0, 75.0, 140.0, 310.0})
            for (std::size_t start = 0; start < 10; ++start)
            {
                CAPTURE(direct, f, start);
                Translator translator;
                translator.prepare({fs, 512});
                TranslatorParams params;
                params.direct = direct;
                params.transients.muted = true;
                translator.setParams(params);
                auto sound = sine(72000, f, fs, 0.3);
                std::fill_n(sound.begin(), 4800 + 48 * start, 0.0f);
                std::vector<float> out(sound.size());
                translator.process(sound, out);
                CHECK(20.0 * std::log10(rms(std::span<const float>(out).last(24000)) / (0.3 / std::numbers::sqrt2)) ==
                      Approx(0.0).margin(0.3));
            }
}

TEST_CASE("a set-up that comes before the first frame counts from it on", "[realtime]")
{
    const double fs = 48000.0;
    const auto in = sine(24000, 170.0, fs, 0.3);
    TranslatorSetup setup;
    setup.profile = narrowLra();
    const auto played = [&](bool late)
    {
        Translator translator;
        if (!late)
            translator.setSetup(setup);
        translator.prepare({fs, 64});
        if (late)
            translator.setSetup(setup);
        std::vector<float> out(in.size());
        translator.process(in, out);
        return out;
    };
    CHECK(played(true) == played(false));
}

TEST_CASE("set-ups, meters and sound may come from three threads", "[realtime]")
{
    Translator translator;
    translator.prepare({48000.0, 64});
    std::atomic<bool> stop{false};
    std::thread audio(
        [&]
        {
            const auto in = noise(64, 8);
            std::vector<float> out(64);
            TranslatorParams params;
            while (!stop.load())
            {
                params.intensity = params.intensity > -1.0 ? params.intensity - 0.01 : 0.0;
                translator.setParams(params);
                translator.process(in, out);
            }
        });
    std::thread display(
        [&]
        {
            while (!stop.load())
                if (translator.meters().read().bands > maxTranslatorBands)
                    stop = true;
        });
    for (std::size_t i = 0; i < 200; ++i)
    {
        TranslatorSetup setup;
        setup.bands.bands = 1 + i % 12;
        translator.setSetup(setup);
        (void)translator.plan({});
    }
    CHECK_FALSE(stop.exchange(true));
    audio.join();
    display.join();
}

TEST_CASE("on any actuator the drive is finite and within full scale", "[realtime]")
{
    Random random(17);
    for (int i = 0; i < 40; ++i)
    {
        CAPTURE(i);
        TranslatorSetup setup;
        setup.profile = randomProfile(static_cast<std::uint64_t>(i));
        setup.bands.bands = 1 + random.next() % 12;
        Translator translator;
        translator.setSetup(setup);
        translator.prepare({8000.0, 256});
        TranslatorParams params;
        params.inputGain = 20.0;
        params.transposition = random.uniform(-12.0, 12.0);
        translator.setParams(params);
        const auto in = noise(8000, 5);
        const auto out = runInBlocks(translator, in, 256);
        REQUIRE(allFinite(out));
        for (float v : out)
            REQUIRE(std::abs(v) <= 1.0f);
    }
}

TEST_CASE("meters show each band, the peak and the distance from the threshold of touch", "[realtime]")
{
    const double fs = 48000.0;
    Translator translator;
    translator.prepare({fs, 256});
    (void)runInBlocks(translator, sine(48000, 120.0, fs, 0.5), 256);
    const auto reading = translator.meters().read();
    REQUIRE(reading.bands == 6);
    const auto loudest = std::max_element(reading.bandLevels.begin(), reading.bandLevels.begin() + 6);
    CHECK(loudest - reading.bandLevels.begin() == 2);
    CHECK(std::abs(*loudest + 6.0) < 3.0);
    CHECK(std::abs(reading.outputPeak - 0.5) < 0.08);
    CHECK(std::abs(reading.overThreshold - 54.0) < 1.5);
    CHECK(reading.gainReduction == 0.0);
    TranslatorParams loud;
    loud.intensity = 12.0;
    translator.setParams(loud);
    (void)runInBlocks(translator, sine(48000, 120.0, fs, 0.9), 256);
    CHECK(translator.meters().read().gainReduction > 6.0);
}

TEST_CASE("the meters show the strongest protection of a call", "[realtime]")
{
    const double fs = 48000.0;
    GuardedTranslator translator;
    translator.prepare({fs, 48000});
    TranslatorParams loud;
    loud.intensity = 12.0;
    translator.setParams(loud);
    auto in = sine(96000, 67.0, fs, 0.9);
    std::fill(in.begin() + 48000, in.end(), 0.0f);
    std::vector<float> out(in.size());
    double strongest = 0.0;
    for (std::size_t i = 0; i < in.size(); i += 256)
    {
        translator.process(std::span(in).subspan(i, 256), std::span(out).subspan(i, 256));
        strongest = std::max(strongest, translator.meters().read().gainReduction);
    }
    CHECK(strongest > 6.0);
    CHECK(translator.meters().read().gainReduction < 1.0); // silent for a second
    translator.reset();
    translator.process(in, out); // all of it at once
    CHECK(translator.meters().read().gainReduction == Approx(strongest));
}

TEST_CASE("a design takes the pulses of events from the profile where it names them", "[realtime]")
{
    TranslatorSetup setup;
    setup.maxBoost = 0_dB;
    Profile& profile = setup.profile.emplace();
    profile.technology = Technology::vca;
    profile.range = {40.0, 400.0, 50.0};
    profile.transient.frequency = 123.0;
    profile.transient.cycles = 2.5;
    const auto pulses = [&](TransientShape shape)
    {
        profile.transient.shape = shape;
        return designTranslator(setup, 48000.0).pulses;
    };
    CHECK(pulses(TransientShape::adaptive) == PulseParams{.lowest = 40.0, .highest = 400.0});
    CHECK(pulses(TransientShape::square) == PulseParams{TransientShape::square, 123.0, 2.5, 40.0, 400.0});
    CHECK(pulses(TransientShape::sine) == PulseParams{TransientShape::sine, 123.0, 2.5, 40.0, 400.0});
}

TEST_CASE("bands with centres below 100 Hz are rumble, those from 100 Hz on texture", "[realtime]")
{
    TranslatorSetup setup;
    setup.bands = {.bands = 3, .low = Hertz(100.0), .high = Hertz(400.0)};
    const auto rumbles = [&]
    {
        std::vector<bool> result;
        for (const TranslatorBand& band : designTranslator(setup, 48000.0).bands)
            result.push_back(band.rumble);
        return result;
    };
    REQUIRE(designBandLayout(setup.bands).centres[0].value == 100.0);
    CHECK(rumbles() == std::vector<bool>{false, false, false});
    setup.bands.low = Hertz(99.9);
    CHECK(rumbles() == std::vector<bool>{true, false, false});
    setup.bands.low = Hertz(20.0);
    CHECK(rumbles() == std::vector<bool>{true, true, false});
}

TEST_CASE("a quiet sound behind a loud one is raised into the actuator's range within 60 ms", "[realtime]")
{
    const double fs = 8000.0;
    TranslatorSetup setup;
    setup.maxBoost = 0_dB;
    Profile& profile = setup.profile.emplace();
    profile.technology = Technology::vca;
    profile.range = {40.0, 400.0, 20.0}; // of 35 dB that are felt of a sound
    TranslatorParams params;
    params.transients.muted = true;
    Translator translator;
    translator.setSetup(setup);
    translator.prepare({fs, 256});
    translator.setParams(params);
    auto in = sine(16000, 200.0, fs, 1.0);
    for (std::size_t n = 8000; n < in.size(); ++n)
        in[n] *= 0.05f;
    const auto out = runInBlocks(translator, in, 256);
    const auto levelAt = [&](double seconds)
    {
        const auto begin = static_cast<std::size_t>((1.0 + seconds) * fs);
        return rms(std::span<const float>(out).subspan(begin, 80)) * std::numbers::sqrt2; // two periods
    };
    // A straight line in dB: 0.05, 26 dB below the top, comes 26 * 20 / 35 dB below it.
    CHECK(levelAt(0.9) == Approx(std::pow(0.05, 20.0 / 35.0)).epsilon(0.1));
    // The peak of late is forgotten with 20 ms, which takes it to 0.05 after 60 ms; until then it decides, 5 ms late.
    CHECK(levelAt(0.075) == Approx(levelAt(0.9)).epsilon(0.05));
    CHECK(levelAt(0.025) / levelAt(0.9) ==
          Approx(std::pow(std::exp(-0.025 / 0.020) / 0.05, 20.0 / 35.0 - 1.0)).epsilon(0.1));
}

TEST_CASE("every preset is within its ranges and has a name of its own", "[realtime]")
{
    std::set<std::string_view> names;
    for (const TranslatorPreset& preset : translatorPresets())
    {
        CAPTURE(preset.name);
        CHECK(clamped(preset.params) == preset.params);
        CHECK(names.insert(preset.name).second);
    }
    CHECK(translatorPresets().front().params == TranslatorParams{});
}
