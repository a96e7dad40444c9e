#include "support/Catch.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/actuator/Strength.h>
#include <pacini/realtime/TranslatorDesign.h>
#include <pacini/realtime/TranslatorMeters.h>
#include <pacini/realtime/TranslatorPresets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
TranslatorSetup designSetup(Technology technology, double low, double high, int polyphony = 64)
{
    TranslatorSetup setup;
    setup.maxBoost = Decibels(0.0);
    Profile& profile = setup.profile.emplace();
    profile.technology = technology;
    profile.range = {low, high, 60.0};
    profile.polyphony = polyphony;
    return setup;
}

std::string reasonFor(const TranslatorPlan& plan, const std::string& what)
{
    std::string reasons;
    for (const TranslatorSaving& saving : plan)
        if (saving.what == what)
            reasons += (reasons.empty() ? "" : " / ") + saving.reason;
    return reasons;
}

std::size_t shownBands(const TranslatorDesign& design)
{
    return static_cast<std::size_t>(
        std::count_if(design.bands.begin(), design.bands.end(), [](const TranslatorBand& band) { return band.shown; }));
}
} // namespace

TEST_CASE("the inner rate is 6 kHz or a little more, never 12", "[realtime]")
{
    CHECK(translatorFactor(2000.0) == 1);
    CHECK(translatorFactor(11999.0) == 1);
    CHECK(translatorFactor(12000.0) == 2);
    CHECK(translatorFactor(44100.0) == 7);
    CHECK(translatorFactor(48000.0) == 8);
    CHECK(translatorFactor(768000.0) == 128);
    CHECK(translatorFactor(0.0) == 1);
    CHECK(translatorFactor(std::numeric_limits<double>::quiet_NaN()) == 1);
    CHECK(translatorFactor(1e12) == 1666);
    CHECK(highestInnerRate == 12000.0);
    for (double fs = 2000.0; fs < 800000.0; fs *= 1.01)
    {
        const double inner = fs / static_cast<double>(translatorFactor(fs));
        CHECK(inner < highestInnerRate);
        CHECK((inner >= 6000.0 || fs < 6000.0));
    }
}

TEST_CASE("without an actuator the whole range is played as it is", "[realtime]")
{
    const TranslatorDesign design = designTranslator({}, 44100.0);
    CHECK(design.innerRate == 6300.0);
    CHECK(design.layout == designBandLayout({}));
    REQUIRE(design.bands.size() == 6);
    for (std::size_t k = 0; k < 6; ++k)
    {
        CHECK(design.bands[k].low == design.layout.lowerEdge(k));
        CHECK(design.bands[k].centre == design.layout.centres[k]);
        CHECK(design.bands[k].high == design.layout.upperEdge(k));
        CHECK(design.bands[k].rumble == (design.layout.centres[k].value < 100.0));
        CHECK(design.bands[k].shown);
        CHECK(reasonFor(design.plan, "bands[" + std::to_string(k) + "].carrier") ==
              "the actuator plays the band's own signal");
    }
    CHECK(design.anyDirect);
    CHECK_FALSE(design.frequencies);
    CHECK(design.lowest == 5.0);
    CHECK(design.highest == 2000.0);
    CHECK(design.voices == maxTranslatorBands);
    CHECK(maxTranslatorBands == 12);
    CHECK_FALSE(design.motor);
    CHECK(design.motorBurst == 0.0);
    CHECK(design.levels.isIdentity());
    CHECK(design.pulses == PulseParams{});
    CHECK(design.filter.sections.empty());
    CHECK(design.scale == 1.0);
    CHECK_FALSE(design.protection);
    CHECK(design.brightFrequency == 200.0);
    CHECK(design.feltRange == 60.0);
    CHECK(design.plan.size() == 8);
    CHECK(reasonFor(design.plan, "adaptation") == "no actuator is known");
    CHECK(reasonFor(design.plan, "protection") == "no actuator is known");
    CHECK(TranslatorSetup{}.maxBoost == Decibels(6.0));
    // What an inner rate of 2 kHz can carry: 0.4 of it.
    const TranslatorDesign slow = designTranslator({}, 2000.0);
    CHECK(slow.innerRate == 2000.0);
    CHECK(slow.highest == 800.0);
    CHECK(TranslatorDesign{}.innerRate == 6000.0);
}

TEST_CASE("a design has at most twelve bands and at least one", "[realtime]")
{
    TranslatorSetup setup;
    for (const auto& [asked, had] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 1}, {12, 12}, {13, 12}, {32, 12}})
    {
        setup.bands.bands = asked;
        const TranslatorDesign design = designTranslator(setup, 48000.0);
        CHECK(design.bands.size() == had);
        CHECK(design.layout.bands() == had);
    }
}

TEST_CASE("bands whose centre the actuator reaches are shown, those at its very ends too", "[realtime]")
{
    const auto layout = designBandLayout({});
    for (std::size_t first = 0; first < 6; ++first)
        for (std::size_t last = first + 1; last < 6; ++last)
        {
            const double low = layout.centres[first].value, high = layout.centres[last].value;
            const TranslatorDesign at = designTranslator(designSetup(Technology::vca, low, high), 48000.0);
            const TranslatorDesign within =
                designTranslator(designSetup(Technology::vca, low * 1.001, high * 0.999), 48000.0);
            CHECK(at.lowest == low);
            CHECK(at.highest == high);
            CHECK(at.pulses.lowest == low);
            CHECK(at.pulses.highest == high);
            CHECK(shownBands(at) == last - first + 1);
            CHECK(shownBands(within) == last - first - 1);
            for (std::size_t k = 0; k < 6; ++k)
            {
                CHECK(at.bands[k].shown == (k >= first && k <= last));
                const std::string name = "bands[" + std::to_string(k) + "].";
                CHECK(reasonFor(at.plan, name + (at.bands[k].shown ? "direct" : "carrier")).empty());
                if (!at.bands[k].shown)
                    CHECK(reasonFor(at.plan, name + "direct") == "lies outside the actuator's range");
            }
            CHECK(within.anyDirect == (last - first > 1));
            // A tone of 200 Hz for what is too high, where the bands above 320 Hz are shown.
            const bool brightShown = last == 5 && first <= 3;
            CHECK(at.brightFrequency == (brightShown ? std::max(200.0, low) : 0.0));
            CHECK(reasonFor(at.plan, "brightness") ==
                  (brightShown ? "" : "high bands are moved into the actuator's range"));
        }
}

TEST_CASE("fewer voices than bands leave carriers only, within 320 Hz", "[realtime]")
{
    const TranslatorDesign few = designTranslator(designSetup(Technology::vca, 40.0, 900.0, 5), 48000.0);
    CHECK(few.voices == 5);
    CHECK(few.highest == 320.0);
    CHECK(few.lowest == 40.0);
    CHECK(shownBands(few) == 0);
    CHECK_FALSE(few.anyDirect);
    CHECK(few.brightFrequency == 0.0);
    CHECK(reasonFor(few.plan, "bands[3].direct") == "the actuator has too few voices");
    const TranslatorDesign enough = designTranslator(designSetup(Technology::vca, 40.0, 1001.0, 6), 48000.0);
    CHECK(enough.voices == 6);
    CHECK(enough.highest == 1001.0);
    CHECK(shownBands(enough) == 5);
    CHECK(designTranslator(designSetup(Technology::vca, 40.0, 900.0, 0), 48000.0).voices == 1);
    CHECK(designTranslator(designSetup(Technology::vca, 400.0, 900.0, 1), 48000.0).highest == 400.0);
    CHECK(designTranslator(designSetup(Technology::vca, 40.0, 250.0, 1), 48000.0).highest == 250.0);
    // A range above what the inner rate can carry ends there.
    const TranslatorDesign high = designTranslator(designSetup(Technology::piezo, 4000.0, 8000.0), 48000.0);
    CHECK(high.highest == Approx(0.4 * 6000.0));
    CHECK(high.lowest == Approx(0.4 * 6000.0));
}

TEST_CASE("a motor has one voice, no bands of its own and a burst of 12 ms at least", "[realtime]")
{
    auto setup = designSetup(Technology::erm, 120.0, 200.0, 3);
    setup.profile->response = {0.005, 0.005};
    const TranslatorDesign quick = designTranslator(setup, 48000.0);
    CHECK(quick.motor.has_value());
    CHECK(quick.motorBurst == 0.012);
    CHECK(quick.voices == 1);
    CHECK(shownBands(quick) == 0);
    CHECK(quick.anyDirect);
    CHECK(quick.filter.sections.empty());
    CHECK(reasonFor(quick.plan, "flattening") == "a motor has no resonance to flatten");
    setup.profile->response = {0.05, 0.02};
    CHECK(designTranslator(setup, 48000.0).motorBurst == 0.05);
    setup.profile->drive.excursion = 1e-3;
    setup.profile->drive.maxExcursion = 1e-3;
    CHECK_FALSE(designTranslator(setup, 48000.0).protection.has_value());
    setup.profile->drive = {};
    setup.profile->drive.impedance = 30.0;
    setup.profile->drive.maxVoltageRms = 3.0;
    setup.profile->drive.maxPower = 0.1;
    const TranslatorDesign hot = designTranslator(setup, 48000.0);
    REQUIRE(hot.protection.has_value());
    CHECK(hot.protection->boundsAlone);
    CHECK_FALSE(hot.protection->excursion.has_value());
    CHECK(hot.protection->heat.has_value());
    CHECK(reasonFor(hot.plan, "protection").empty());
}

TEST_CASE("what a profile says of its drive is in the design", "[realtime]")
{
    auto setup = designSetup(Technology::vca, 40.0, 1000.0);
    setup.profile->range.dynamicRange = 30.0;
    setup.profile->drive.overdrive = 1.6;
    setup.profile->equalizer = {{EqualizerType::peak, 5000.0, 2.0, 8.0, 2}, {EqualizerType::peak, 200.0, -9.0, 2.0, 2}};
    const TranslatorDesign design = designTranslator(setup, 48000.0);
    CHECK(design.scale == 1.0 / 1.6);
    CHECK(design.feltRange == 30.0);
    CHECK_FALSE(design.levels.isIdentity());
    // 35 dB of a sound in 30 of the actuator.
    CHECK(design.levels(1.0) == Approx(1.0));
    CHECK(design.levels(0.1) == Approx(std::pow(0.1, 30.0 / 35.0)).epsilon(1e-6));
    CHECK(design.filter.sections.size() == 1);
    CHECK(Decibels::fromGain(std::abs(design.filter.response(200_Hz, design.innerRate))).value ==
          Approx(-9.0).epsilon(1e-6));
    CHECK(reasonFor(design.plan, "equalizer[0]") == "is flat in the actuator's range");
    CHECK(reasonFor(design.plan, "equalizer[1]").empty());
    CHECK(reasonFor(design.plan, "flattening") == "the equaliser flattens the actuator");
    CHECK(reasonFor(design.plan, "dynamicRange").empty());
    setup.profile->range.dynamicRange = 35.0;
    const TranslatorDesign whole = designTranslator(setup, 48000.0);
    CHECK(whole.levels.isIdentity());
    CHECK(reasonFor(whole.plan, "dynamicRange") == "the actuator covers the whole range of touch");
    // Of an unknown actuator only its drive counts.
    setup.profile->technology = Technology::pcm;
    setup.profile->range.dynamicRange = 20.0;
    const TranslatorDesign unknown = designTranslator(setup, 48000.0);
    CHECK(unknown.scale == 1.0 / 1.6);
    CHECK(unknown.feltRange == 20.0);
    CHECK(unknown.levels.isIdentity());
    CHECK(unknown.filter.sections.empty());
    CHECK_FALSE(unknown.frequencies);
    CHECK(reasonFor(unknown.plan, "adaptation") == "no actuator is known");
    CHECK(reasonFor(unknown.plan, "dynamicRange").empty());
}

TEST_CASE("flattening widens the range that an actuator reaches", "[realtime]")
{
    auto setup = designSetup(Technology::lra, 140.0, 200.0);
    setup.profile->resonance = {167.0, 12.0};
    setup.maxBoost = Decibels(12.0);
    setup.strength = 0.0;
    const auto flattening = flatteningOf(*setup.profile, setup.maxBoost);
    REQUIRE(flattening.has_value());
    const double ratio = std::exp2(flattening->octaves);
    CHECK(ratio > 1.0);
    const TranslatorDesign design = designTranslator(setup, 48000.0);
    CHECK(design.lowest == Approx(140.0 / ratio));
    CHECK(design.highest == Approx(200.0 * ratio));
    CHECK(design.pulses.lowest == design.lowest);
    CHECK(design.pulses.highest == design.highest);
    CHECK_FALSE(design.filter.sections.empty());
    CHECK(reasonFor(design.plan, "flattening").empty());
    // It ends at 1 Hz and 20 kHz.
    setup.profile->range = {1.0, 20000.0, 60.0};
    const TranslatorDesign all = designTranslator(setup, 48000.0);
    CHECK(all.lowest == 1.0);
    CHECK(all.pulses.highest == 20000.0);
}

TEST_CASE("strength draws what is played in to the resonance", "[realtime]")
{
    auto setup = designSetup(Technology::lra, 140.0, 200.0);
    setup.profile->resonance = {167.0, 12.0};
    setup.maxBoost = Decibels(6.0);
    double lowest = 0.0;
    double highest = 1e9;
    double gain = 0.0;
    for (const double strength : {0.0, 0.2, standardStrength, 0.7, 1.0})
    {
        CAPTURE(strength);
        setup.strength = strength;
        const TranslatorDesign design = designTranslator(setup, 48000.0);
        CHECK(design.lowest > lowest);
        CHECK(design.highest < highest);
        const double atResonance = std::abs(design.filter.response(167_Hz, design.innerRate));
        CHECK(atResonance > gain);
        CHECK(design.frequencies->operator()(60.0) == design.lowest);
        lowest = design.lowest;
        highest = design.highest;
        gain = atResonance;
    }
    CHECK(lowest == Approx(167.0 / (1.0 + 1.0 / 24.0)).margin(0.6)); // half of 1 / Q below
    CHECK(gain == Approx(1.0).epsilon(0.01));
    CHECK(TranslatorSetup{}.strength == 0.4);
}

TEST_CASE("the plan of parameters names what is muted or off", "[realtime]")
{
    const TranslatorDesign design = designTranslator({}, 48000.0);
    constexpr TranslatorParams everything{.audible = 1.0};
    TranslatorParams params = everything;
    CHECK(translatorPlan(design, params) == design.plan);
    params.rumble.muted = true;
    CHECK(reasonFor(translatorPlan(design, params), "rumble") == "is muted");
    params = everything;
    params.texture.muted = true;
    CHECK(reasonFor(translatorPlan(design, params), "texture") == "is muted");
    params = everything;
    params.transients.muted = true;
    CHECK(reasonFor(translatorPlan(design, params), "transients") == "are muted");
    params = everything;
    params.brightness = -60.0;
    CHECK(reasonFor(translatorPlan(design, params), "brightness") == "is off");
    params.brightness = -59.9;
    CHECK(translatorPlan(design, params).size() == design.plan.size());
    CHECK(lowestBrightness == -60.0);
    params.audible = 0.0;
    CHECK(reasonFor(translatorPlan(design, params), "audible") == "is off");
}

TEST_CASE("live parameters begin with what is documented", "[realtime]")
{
    const TranslatorParams p;
    CHECK(p.inputGain == 0.0);
    CHECK(p.intensity == 0.0);
    CHECK(p.rumble == RoleParams{0.0, false});
    CHECK(p.texture == RoleParams{0.0, false});
    CHECK(p.transients == RoleParams{0.0, false});
    CHECK(test::asNumbers(p.brightness, p.transposition, p.direct, p.attack, p.release) ==
          test::Numbers{-6.0, 0.0, 1.0, 1.0, 8.0});
    CHECK(test::asNumbers(p.audible, p.speech) == test::Numbers{1.0, 1.0});
    CHECK(test::asNumbers(p.transientSensitivity, p.transientSharpness, p.gateThreshold, p.gateRelease, p.bypass) ==
          test::Numbers{0.5, 0.0, -75.0, 60.0, false});
}

TEST_CASE("the shipped presets are what they were when they were chosen", "[realtime]")
{
    for (const TranslatorPreset& preset : translatorPresets())
    {
        const TranslatorParams& p = preset.params;
        CHECK_FALSE(preset.purpose.empty());
        checkPinned("realtime/preset, " + std::string(preset.name),
                    {p.inputGain, p.intensity, p.rumble.level, p.rumble.muted ? 1.0 : 0.0, p.texture.level,
                     p.texture.muted ? 1.0 : 0.0, p.transients.level, p.transients.muted ? 1.0 : 0.0, p.brightness,
                     p.transposition, p.direct, p.attack, p.release, p.transientSensitivity, p.transientSharpness,
                     p.gateThreshold, p.gateRelease, p.bypass ? 1.0 : 0.0});
    }
}

TEST_CASE("meters show what was written last", "[realtime]")
{
    const double silence = -std::numeric_limits<double>::infinity();
    TranslatorMeters meters;
    const auto fresh = meters.read();
    CHECK(test::asNumbers(fresh.bands, fresh.events, fresh.lastEventFrame, fresh.lastEventLevel, fresh.outputPeak,
                          fresh.gainReduction) == test::Numbers{0, 0, 0, 0.0, 0.0, 0.0});
    CHECK(fresh.overThreshold == silence);
    meters.setOutput(1.0, 0.0);
    CHECK(meters.read().overThreshold == Approx(60.0)); // as long as no actuator is known

    meters.setBands(3, 42.0);
    meters.setBand(0, 1.0);
    meters.setBand(1, 0.01);
    meters.setBand(2, 0.0);
    meters.setBand(3, 1.0); // more than there are
    meters.setOutput(0.5, 3.25);
    meters.noteEvent(5000000000u, 0.75);
    meters.noteEvent(6000000000u, 0.25);
    const auto reading = meters.read();
    CHECK(reading.bands == 3);
    CHECK(reading.bandLevels[0] == Approx(0.0).margin(1e-6));
    CHECK(reading.bandLevels[1] == Approx(-20.0).epsilon(1e-6));
    CHECK(reading.bandLevels[2] == silence);
    CHECK(test::asNumbers(reading.bandLevels[3], reading.events, reading.lastEventFrame, reading.lastEventLevel,
                          reading.outputPeak,
                          reading.gainReduction) == test::Numbers{0.0, 2, 6000000000u, 0.25, 0.5, 3.25});
    CHECK(reading.overThreshold == Approx(42.0 - 6.0206).epsilon(1e-5));

    meters.reset();
    const auto after = meters.read();
    CHECK(after.bands == 3); // of the set-up, which stays
    for (std::size_t k = 0; k < 3; ++k)
        CHECK(after.bandLevels[k] == silence);
    CHECK(test::asNumbers(after.events, after.lastEventFrame, after.lastEventLevel, after.outputPeak,
                          after.gainReduction) == test::Numbers{0, 0, 0.0, 0.0, 0.0});
}
