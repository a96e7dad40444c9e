// What sessions keep.

#include "io/ProfileFile.h"
#include "io/ShippedProfiles.h"
#include "plugin/engine/Rig.h"
#include "support/Paths.h"
#include "support/RandomProfile.h"
#include "support/TempFolder.h"

#include <pacini/actuator/Strength.h>

#include <filesystem>

using namespace pacini;
using namespace pacini::test;
using namespace pacini::plugin;

namespace
{
std::string saved(PluginProcessor& plugin)
{
    juce::MemoryBlock block;
    plugin.getStateInformation(block);
    return {static_cast<const char*>(block.getData()), block.getSize()};
}

void load(PluginProcessor& plugin, const std::string& text)
{
    plugin.setStateInformation(text.data(), static_cast<int>(text.size()));
}

/// A plugin with every parameter somewhere.
std::unique_ptr<PluginProcessor> turned(std::uint64_t seed)
{
    auto plugin = std::make_unique<PluginProcessor>();
    Random random(seed);
    for (const ParameterRow& row : parameterTable)
        plugin->parameter(row.parameter).setValueNotifyingHost(static_cast<float>(random.uniform()));
    plugin->parameter(ParameterId::profile).setPlainNotifyingHost(static_cast<double>(random.next() % 12));
    return plugin;
}

const std::filesystem::path fixture = testFolder() / "plugin" / "engine" / "state-v1.json";
} // namespace

TEST_CASE("A state brings every parameter, the actuator, the program and the size of the window back")
{
    for (std::uint64_t seed = 1; seed < 20; ++seed)
    {
        const auto first = turned(seed);
        first->setWindowSize(1000, 700);
        PluginProcessor second;
        const std::string text = saved(*first);
        load(second, text);
        CHECK(saved(second) == text);
        CHECK(second.values() == first->values());
        CHECK(second.actuatorName() == first->actuatorName());
        CHECK(second.windowSize() == juce::Point<int>(1000, 700));
        CHECK(second.note().isEmpty());
    }
}

TEST_CASE("An actuator from a file is kept by its content")
{
    const TempFolder folder;
    auto profile = randomProfile(4);
    profile.name = "bench rig 7";
    profile.shortName.clear();
    REQUIRE(writeProfile(folder / "own.json", profile));
    PluginProcessor first;
    REQUIRE(first.loadActuator(juce::File((folder / "own.json").string())));
    CHECK(first.actuatorName() == "bench rig 7");
    CHECK(first.values().index(ParameterId::profile) == ownProfileSlot);
    const std::string text = saved(first);
    std::filesystem::remove(folder / "own.json");

    PluginProcessor second;
    load(second, text);
    CHECK(second.actuatorName() == "bench rig 7");
    CHECK(saved(second) == text);
    const auto state = readState(text);
    REQUIRE(state);
    CHECK(state->state.profile == profile);
    CHECK_FALSE(first.loadActuator(juce::File((folder / "missing.json").string())));
    CHECK(first.actuatorName() == "bench rig 7");
}

TEST_CASE("A session keeps its actuator although the shipped one has changed since")
{
    auto older = builtInProfile(1);
    REQUIRE(older);
    older->range.highFrequency -= 100.0;
    PluginState state;
    state.values.set(ParameterId::profile, 1.0);
    state.profile = older;
    PluginProcessor plugin;
    load(plugin, stateText(state));
    CHECK(plugin.values().index(ParameterId::profile) == ownProfileSlot);
    CHECK(plugin.note().isNotEmpty());
    const auto read = readState(saved(plugin));
    REQUIRE(read);
    CHECK(read->state.profile == older);
}

TEST_CASE("The states of version 1 load for ever")
{
    PluginProcessor plugin;
    load(plugin, bytesOf(fixture));
    CHECK(plugin.note().isEmpty());
    const auto values = plugin.values();
    CHECK(values[ParameterId::source] == 2.0);
    CHECK(values[ParameterId::sourceMix] == Approx(0.25));
    CHECK(values[ParameterId::outputMode] == 3.0);
    CHECK(values[ParameterId::outputChannel] == 7.0);
    CHECK(values[ParameterId::inputGain] == Approx(6.5));
    CHECK(values[ParameterId::intensity] == Approx(-3.25));
    CHECK(values[ParameterId::rumbleLevel] == Approx(2.0));
    CHECK(values.isOn(ParameterId::rumbleMute));
    CHECK(values[ParameterId::textureLevel] == Approx(-12.0));
    CHECK(values[ParameterId::transientLevel] == Approx(4.5));
    CHECK(values[ParameterId::brightness] == Approx(-20.0));
    CHECK(values[ParameterId::transposition] == Approx(-7.0));
    CHECK(values[ParameterId::direct] == Approx(0.75));
    CHECK(values[ParameterId::attack] == Approx(12.0));
    CHECK(values[ParameterId::release] == Approx(150.0));
    CHECK(values[ParameterId::transientSensitivity] == Approx(0.6));
    CHECK(values[ParameterId::transientSharpness] == Approx(-0.3));
    CHECK(values[ParameterId::gateThreshold] == Approx(-60.0));
    CHECK(values[ParameterId::gateRelease] == Approx(90.0));
    CHECK(values[ParameterId::audible] == 0.0);
    CHECK(values[ParameterId::strength] == 0.0); // and not the default
    CHECK(plugin.actuatorName() == "Bench actuator");
    CHECK(plugin.getCurrentProgram() == 2);
}

TEST_CASE("A session from before there was a strength drives its actuator as it did, a new one as the command does")
{
    const auto driveOf = [](const std::function<void(PluginProcessor&)>& prepare)
    {
        Rig rig;
        prepare(rig.plugin);
        rig.plugin.prepareToPlay(48000.0, 512);
        return rig.run(liveSounds(2, 24000, 3)).haptic;
    };
    const auto withStrength = [&](double strength)
    {
        return driveOf(
            [strength](PluginProcessor& plugin)
            {
                plugin.parameter(ParameterId::profile).setPlainNotifyingHost(3.0);
                plugin.parameter(ParameterId::strength).setPlainNotifyingHost(strength);
            });
    };
    const auto before =
        driveOf([](PluginProcessor& plugin)
                { load(plugin, R"({"format": "pacini.plugin", "version": 1, "parameters": {"profile": 3}})"); });
    CHECK(before == withStrength(0.0));
    const auto fresh =
        driveOf([](PluginProcessor& plugin) { plugin.parameter(ParameterId::profile).setPlainNotifyingHost(3.0); });
    CHECK(fresh == withStrength(standardStrength));
    CHECK(fresh != before);
}

TEST_CASE("What is no state changes nothing and is noted")
{
    const auto plugin = turned(3);
    const std::string before = saved(*plugin);
    Random random(8);
    const auto refuses = [&](const std::string& text)
    {
        CAPTURE(text.substr(0, 60));
        load(*plugin, text);
        CHECK(saved(*plugin) == before);
        CHECK(plugin->note().isNotEmpty());
    };
    for (int i = 0; i < 200; ++i)
    {
        std::string noise(random.next() % 300 + 1, '\0');
        for (char& c : noise)
            c = static_cast<char>(random.next());
        refuses(noise);
    }
    const std::string good = saved(*turned(4));
    for (std::size_t length = 1; length < good.size(); length += 7)
        refuses(good.substr(0, length));
    refuses("{}");
    refuses("[]");
    refuses("null");
    refuses("{\"format\": \"pacini.plugin\"}");
    refuses("{\"format\": \"pacini.plugin\", \"version\": 0}");
    refuses("{\"format\": \"pacini.plugin\", \"version\": \"1\"}");
    refuses("{\"format\": \"pacini.clip\", \"version\": 1}");
    refuses(std::string(200000, '['));
    refuses("{\"format\": \"pacini.plugin\", \"version\": 2, \"parameters\": {\"intensity\": 3}}");
    plugin->setStateInformation(nullptr, 0);
    plugin->setStateInformation(good.data(), 0);
    CHECK(saved(*plugin) == before);
}

TEST_CASE("One flipped bit or byte never breaks the plugin")
{
    const std::string good = saved(*turned(4));
    Random random(5);
    const auto plugin = turned(3);
    for (int i = 0; i < 400; ++i)
    {
        std::string bad = good;
        bad[random.next() % bad.size()] = static_cast<char>(random.next());
        load(*plugin, bad);
        for (const ParameterRow& row : parameterTable)
        {
            const double value = plugin->values()[row.parameter];
            REQUIRE(value >= row.low);
            REQUIRE(value <= row.high);
        }
    }
}

TEST_CASE("Of a state with mistakes everything else is used")
{
    PluginProcessor plugin;
    plugin.parameter(ParameterId::attack).setPlainNotifyingHost(50.0);
    load(plugin, R"({"format": "pacini.plugin", "version": 1, "later": [1, 2],
        "parameters": {"intensity": 9, "release": "long", "direct": 1e300, "source": 1.4, "unheard": 3},
        "profile": {"format": "pacini.profile"}})");
    CHECK(plugin.values()[ParameterId::intensity] == Approx(9.0));
    CHECK(plugin.values()[ParameterId::release] == Approx(8.0));
    CHECK(plugin.values()[ParameterId::attack] == Approx(1.0)); // not named: its default
    CHECK(plugin.values()[ParameterId::direct] == 1.0);
    CHECK(plugin.values()[ParameterId::source] == 1.0);
    CHECK(plugin.note().contains("Release"));
    CHECK(plugin.note().contains("actuator"));
}
