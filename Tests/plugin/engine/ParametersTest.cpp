// The table of parameters, and values as text.

#include "io/ProfileFile.h"
#include "io/ShippedProfiles.h"
#include "plugin/engine/ParameterText.h"
#include "plugin/engine/Rig.h"
#include "support/Paths.h"

#include <pacini/realtime/Translator.h>
#include <pacini/realtime/TranslatorPresets.h>

#include <filesystem>
#include <set>

using namespace pacini;
using namespace pacini::test;
using namespace pacini::plugin;

TEST_CASE("Every value has a text that reads back as what the text says")
{
    Random random(1);
    for (const ParameterRow& row : parameterTable)
        for (int i = 0; i <= 200; ++i)
        {
            CAPTURE(row.id);
            const double normal = i <= 100 ? 0.01 * i : random.uniform();
            const double value = valueAt(row, normal);
            const std::string text = textOf(row, value);
            CAPTURE(value, text);
            const auto read = valueOf(row, text);
            REQUIRE(read);
            CHECK(textOf(row, *read) == text);
            CHECK(*read == Approx(value).margin(0.5 * (row.unit == ParameterUnit::percent ? 0.0101 : 1.001)));
            CHECK(normalOf(row, value) == Approx(normalOf(row, valueAt(row, normalOf(row, value)))).margin(1e-12));
        }
}

TEST_CASE("Texts are read as people type them")
{
    const auto read = [](ParameterId id, const char* text)
    {
        return valueOf(rowOf(id), text);
    };
    CHECK(read(ParameterId::intensity, "-12") == -12.0);
    CHECK(read(ParameterId::intensity, " -12,5 dB ") == -12.5);
    CHECK(read(ParameterId::intensity, "\xE2\x88\x92 3 dB") == std::nullopt);
    CHECK(read(ParameterId::intensity, "\xE2\x88\x92"
                                       "3 dB") == -3.0);
    CHECK(read(ParameterId::intensity, "-inf") == -60.0);
    CHECK(read(ParameterId::intensity, "24 dB") == 24.0);
    CHECK(read(ParameterId::intensity, "100 dB") == std::nullopt);
    CHECK(read(ParameterId::outputChannel, "17") == std::nullopt);
    CHECK(read(ParameterId::profile, "32") == std::nullopt);
    CHECK(read(ParameterId::intensity, "3 ms") == std::nullopt);
    CHECK(read(ParameterId::intensity, "loud") == std::nullopt);
    CHECK(read(ParameterId::intensity, "") == std::nullopt);
    CHECK(read(ParameterId::intensity, "nan") == std::nullopt);
    CHECK(read(ParameterId::release, "0.5 s") == 500.0);
    CHECK(read(ParameterId::release, "80ms") == 80.0);
    CHECK(read(ParameterId::direct, "50") == 0.5);
    CHECK(read(ParameterId::direct, "50 %") == 0.5);
    CHECK(read(ParameterId::bypass, "on") == 1.0);
    CHECK(read(ParameterId::bypass, "0") == 0.0);
    CHECK(read(ParameterId::source, "side") == 1.0);
    CHECK(read(ParameterId::source, "2") == 2.0);
    CHECK(read(ParameterId::profile, "lra 235 hz") == 4.0);
    CHECK(read(ParameterId::profile, "From file") == 31.0);
    CHECK(textOf(rowOf(ParameterId::transposition), -0.001) == "0.00 st");
    CHECK(textOf(rowOf(ParameterId::release), 99.96) == "100 ms");
}

TEST_CASE("What is no value of a parameter, or beyond its range, is refused: the value stays")
{
    PluginProcessor plugin;
    for (const ParameterRow& row : parameterTable)
        for (const float normal : {0.0f, 0.3f, 1.0f})
        {
            auto& parameter = plugin.parameter(row.parameter);
            parameter.setValue(normal);
            for (const char* text : {"abc", "", " ", "1e9", "-1e9", "1e", "123456", "-123456", "nan", "inf",
                                     "12 parsecs", "1 2", "--", "0x10", "%"})
            {
                CAPTURE(row.id, normal, text);
                CHECK(parameter.getValueForText(text) == parameter.getValue());
            }
        }
}

TEST_CASE("Lists of hosts have the short names of the profiles")
{
    const auto& names = rowOf(ParameterId::profile).choices;
    for (std::size_t slot = 0; !profileNameOf(slot).empty(); ++slot)
    {
        CAPTURE(slot);
        CHECK(names[slot] == shortNameOf(*builtInProfile(slot)));
    }
}

TEST_CASE("Lists of hosts say where a slot has no actuator")
{
    for (std::size_t slot = 0; slot < profileSlots; ++slot)
    {
        CAPTURE(slot);
        const auto& first = rowOf(ParameterId::profile).choices;
        const auto& second = rowOf(channelParameter(1, ChannelSetting::actuator)).choices;
        CHECK(first[slot] == second[slot + 1]);
        CHECK(hasNoActuator(first[slot]) == (slot != ownProfileSlot && profileNameOf(slot).empty()));
    }
    Rig rig({.main = 1, .sidechain = 0});
    const auto sound = std::vector<std::vector<float>>{liveSound(24000, 5)};
    const auto driveOf = [&](double slot)
    {
        rig.set(ParameterId::profile, slot);
        rig.plugin.prepareToPlay(48000.0, 512);
        return rig.run(sound).haptic[0];
    };
    CHECK(driveOf(20.0) == driveOf(0.0)); // flat, as the text says
    rig.set(ParameterId::profile, 20.0);
    rig.plugin.prepareToPlay(48000.0, 512);
    CHECK(rig.plugin.actuatorName() == "No actuator (flat)");
}

TEST_CASE("Normalised values survive exactly, discrete ones snap")
{
    PluginProcessor plugin;
    Random random(2);
    for (const ParameterRow& row : parameterTable)
    {
        CAPTURE(row.id);
        auto& parameter = plugin.parameter(row.parameter);
        CHECK(parameter.getParameterID() == row.id);
        CHECK(parameter.getVersionHint() == row.since);
        CHECK(parameter.getValue() == parameter.getDefaultValue());
        CHECK(parameter.value() == Approx(row.standard));
        for (int i = 0; i < 50; ++i)
        {
            const auto normal = static_cast<float>(random.uniform());
            parameter.setValue(normal);
            if (parameter.isDiscrete())
                CHECK(std::abs(parameter.getValue() - normal) <=
                      0.5001f / static_cast<float>(parameter.getNumSteps() - 1));
            else
                CHECK(parameter.getValue() == normal);
            const auto text = parameter.getText(parameter.getValue(), 0);
            CHECK(parameter.getText(parameter.getValueForText(text), 0) == text);
        }
        parameter.setValue(-1.0f);
        CHECK(parameter.getValue() == 0.0f);
        parameter.setValue(2.0f);
        CHECK(parameter.getValue() == 1.0f);
        CHECK(parameter.getText(0.5f, 3).length() <= 3);
    }
}

TEST_CASE("The ids of released parameters never change")
{
    std::vector<std::string> ids;
    std::set<std::string> unique;
    for (const ParameterRow& row : parameterTable)
        unique.insert(ids.emplace_back(row.id));
    CHECK(unique.size() == parameterCount);
    const std::set<std::string> first{
        "source",      "sourceMix",      "outputMode",           "outputChannel",      "profile",
        "inputGain",   "intensity",      "rumbleLevel",          "rumbleMute",         "textureLevel",
        "textureMute", "transientLevel", "transientMute",        "transposition",      "direct",
        "attack",      "release",        "transientSensitivity", "transientSharpness", "gateThreshold",
        "gateRelease", "bypass"};
    CHECK(std::includes(unique.begin(), unique.end(), first.begin(), first.end()));
}

TEST_CASE("The defaults of the table are those of the translator")
{
    CHECK(ParameterValues().translator() == TranslatorParams());
    CHECK(ParameterValues()[ParameterId::strength] == TranslatorSetup().strength);
}

TEST_CASE("Every shipped profile has a slot with its content, and only those")
{
    std::set<std::string> shelved;
    for (std::size_t slot = 0; slot < profileSlots; ++slot)
    {
        CAPTURE(slot);
        const std::string name(profileNameOf(slot));
        const auto profile = builtInProfile(slot);
        REQUIRE(profile.has_value() == !name.empty());
        if (!profile)
            continue;
        shelved.insert(name + ".json");
        const auto file = readProfile(sourceFolder() / "profiles" / (name + ".json"));
        REQUIRE(file);
        CHECK(*file == *profile);
    }
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(sourceFolder() / "profiles"))
        files.insert(entry.path().filename().string());
    CHECK(shelved == files);
}

TEST_CASE("Strength is that of the translator's set-up, also when it is turned while sound plays offline")
{
    const auto sound = liveSound(48000, 7);
    const auto profile = builtInProfile(3);
    for (const double strength : {0.0, 0.4, 0.7, 1.0})
    {
        CAPTURE(strength);
        Translator translator;
        TranslatorSetup setup;
        setup.profile = profile;
        setup.strength = strength;
        translator.setSetup(setup);
        translator.prepare({48000.0, 512});
        std::vector<float> expected(sound.size());
        translator.process(sound, expected);
        Rig rig({.main = 1, .sidechain = 0});
        rig.set(ParameterId::profile, 3.0);
        rig.set(ParameterId::strength, strength);
        rig.plugin.prepareToPlay(48000.0, 512);
        CHECK(rig.run({sound}).haptic[0] == expected);
    }
    Rig rig({.main = 1, .sidechain = 0});
    rig.plugin.setNonRealtime(true);
    rig.set(ParameterId::profile, 3.0);
    const auto driveAt = [&](double strength)
    {
        rig.set(ParameterId::strength, strength);
        (void)rig.run({sound});
        return rig.run({sound}).haptic[0];
    };
    (void)driveAt(0.5); // what is set before the first frame counts at once, what comes later fades in
    const auto flat = driveAt(0.0), strong = driveAt(1.0), again = driveAt(0.0);
    const auto apart = [](std::vector<float> a, const std::vector<float>& b)
    {
        const double whole = energy(a);
        std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::minus<>());
        return energy(a) / whole;
    };
    CHECK(apart(flat, strong) > 0.5);
    CHECK(apart(flat, again) < 0.01);
}

TEST_CASE("Strength of an actuator that has nothing to trade leaves the drive as it runs")
{
    const auto sound = liveSound(48000, 7);
    for (const double profile : {0.0, 5.0}) // plain signal, motor
    {
        CAPTURE(profile);
        const auto drive = [&](bool turned)
        {
            Rig rig({.main = 1, .sidechain = 0});
            rig.plugin.setNonRealtime(true);
            rig.set(ParameterId::profile, profile);
            (void)rig.run({sound});
            CHECK_FALSE(rig.plugin.strengthMatters());
            return rig
                .run({sound}, {}, {512},
                     [&](std::size_t block)
                     { rig.set(ParameterId::strength, turned ? 0.01 * static_cast<double>(block % 90) : 0.4); })
                .haptic[0];
        };
        CHECK(drive(true) == drive(false));
    }
}

TEST_CASE("Programs set everything but routing, actuator with its strength, and bypass")
{
    PluginProcessor plugin;
    plugin.parameter(ParameterId::source).setPlainNotifyingHost(1.0);
    plugin.parameter(ParameterId::profile).setPlainNotifyingHost(3.0);
    plugin.parameter(ParameterId::strength).setPlainNotifyingHost(0.7);
    plugin.parameter(ParameterId::attack).setPlainNotifyingHost(77.0);
    for (int i = plugin.getNumPrograms() - 1; i >= 0; --i)
    {
        plugin.setCurrentProgram(i);
        CHECK(plugin.getCurrentProgram() == i);
        CHECK(plugin.getProgramName(i).isNotEmpty());
        const auto values = plugin.values();
        CHECK(values[ParameterId::source] == 1.0);
        CHECK(values[ParameterId::profile] == 3.0);
        CHECK(values[ParameterId::strength] == Approx(0.7));
        CHECK(values.translator() == translatorPresets()[static_cast<std::size_t>(i)].params);
    }
    CHECK(plugin.values().translator() == TranslatorParams());
    plugin.setCurrentProgram(-1);
    plugin.setCurrentProgram(1000);
    CHECK(plugin.getCurrentProgram() == 0);
}
