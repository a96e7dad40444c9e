// Presets of the user.

#include "io/SettingsFile.h"
#include "plugin/engine/Rig.h"
#include "support/TempFolder.h"

#include <filesystem>

using namespace pacini;
using namespace pacini::test;
using namespace pacini::plugin;

namespace
{
TranslatorParams turned(std::uint64_t seed)
{
    ParameterValues values;
    Random random(seed);
    for (const ParameterRow& row : parameterTable)
        values.set(row.parameter, row.unit == ParameterUnit::toggle ? static_cast<double>(random.next() % 2)
                                                                    : random.uniform(row.low, row.high));
    return values.translator();
}
/// With values that no step and no rounding gives, and each at a limit now and then.
TranslatorParams anyParams(std::uint64_t seed)
{
    TranslatorParams params;
    Random random(seed);
    for (const auto& parameter : translatorParameters)
        parameter.set(params, parameter.kind == ParameterKind::truth ? static_cast<double>(random.next() % 2)
                              : random.next() % 8 == 0               ? parameter.range.lowest
                              : random.next() % 8 == 0
                                  ? parameter.range.highest
                                  : random.uniform(parameter.range.lowest, parameter.range.highest));
    return params;
}

Result<void> save(const SettingsPresets& presets, const std::string& name, const TranslatorParams& params, bool replace)
{
    return presets.save(name, liveSettings(params), replace);
}

/// As versions wrote them before presets were settings files.
std::string earlierPreset(const TranslatorParams& params)
{
    PluginState state;
    state.values.setTranslator(params);
    auto text = nlohmann::json::parse(stateText(state));
    auto& named = text["parameters"];
    for (const ParameterRow& row : parameterTable)
        if (!isOfTranslator(row) || row.parameter == ParameterId::bypass)
            named.erase(row.id);
    text.erase("program");
    return text.dump(2);
}
} // namespace

TEST_CASE("A preset holds all live parameters exactly, and the command's settings are the same file")
{
    const TempFolder folder;
    const SettingsPresets presets(folder / "presets");
    for (std::uint64_t seed = 1; seed <= 200; ++seed)
    {
        const TranslatorParams params = anyParams(seed);
        REQUIRE(save(presets, "any", params, true));
        const auto listing = presetsIn(presets);
        REQUIRE(listing.presets.size() == 1);
        REQUIRE(listing.presets[0].params == params);
        // What the command reads, every key of it known.
        ReadWarnings strict(true);
        const auto settings = readSettingsFile(presets.pathOf("any"), &strict);
        REQUIRE(settings);
        REQUIRE(settings->playback.live == params);
        // And what it writes, here beside other parts and with values left out.
        auto document = playbackSettingsJson(settings->playback);
        document["encode"] = {{"bands", 8}};
        document["live"].erase("attack");
        put(presets.pathOf("any"), document.dump());
        TranslatorParams usual = params;
        usual.attack = TranslatorParams().attack;
        REQUIRE(presetsIn(presets).presets.at(0).params == usual);
    }
}

TEST_CASE("Presets of earlier versions are read, stay as they are, and are settings once they are saved again")
{
    const TempFolder folder;
    const SettingsPresets presets(folder.path());
    const std::string earlier = earlierPreset(turned(5));
    put(folder / "Old.json", earlier);
    auto listing = presetsIn(presets);
    REQUIRE(listing.presets.size() == 1);
    CHECK(listing.presets[0].params == turned(5));
    CHECK(bytesOf(folder / "Old.json") == earlier);
    // Before sound above touch had a parameter of its own, nothing of it was felt by its loudness.
    put(folder / "Older.json", R"({"format": "pacini.plugin", "version": 1, "parameters": {"attack": 3}})");
    listing = presetsIn(presets);
    REQUIRE(listing.presets.size() == 2);
    CHECK(listing.presets[1].params.attack == 3.0);
    CHECK(listing.presets[1].params.audible == 0.0);
    REQUIRE(save(presets, "Old", listing.presets[0].params, true));
    CHECK(readSettingsFile(folder / "Old.json")->playback.live == turned(5));
    CHECK(presetsIn(presets).presets.at(0).params == turned(5));
}

TEST_CASE("The editor takes gain and pitch of a preset of the plugin")
{
    const TempFolder folder;
    const SettingsPresets presets(folder.path());
    TranslatorParams params;
    params.intensity = -7.5;
    params.transposition = 3.25;
    REQUIRE(save(presets, "low", params, true));
    CHECK(*readCharacterSettings(presets.pathOf("low")) == CharacterSettings{-7.5, 1.0, 3.25, 1.0});
    params.intensity = 24.0;
    params.transposition = -48.0;
    REQUIRE(save(presets, "wide", params, true));
    const auto wide = readCharacterSettings(presets.pathOf("wide"));
    CHECK(*wide == CharacterSettings{CharacterSettings::mostGain, 1.0, -CharacterSettings::mostTransposition, 1.0});
}

TEST_CASE("Presets that were saved are listed by name, with all live parameters, and can be deleted")
{
    const TempFolder folder;
    const SettingsPresets presets(folder / "not" / "there yet");
    CHECK(presetsIn(presets).presets.empty());
    CHECK(presetsIn(presets).broken.empty());
    REQUIRE(save(presets, "Rain on a tent", turned(1), false));
    REQUIRE(save(presets, "\xc3\x84rger", turned(2), false));
    REQUIRE(save(presets, "Bass", turned(3), false));
    const auto listing = presetsIn(presets);
    REQUIRE(listing.presets.size() == 3);
    CHECK(listing.presets[0].name == "Bass");
    CHECK(listing.presets[0].params == turned(3));
    CHECK(listing.presets[1].name == "Rain on a tent");
    CHECK(listing.presets[1].params == turned(1));
    CHECK(listing.presets[2].name == "\xc3\x84rger");
    CHECK(presets.exists("Bass"));
    REQUIRE(presets.remove("Bass"));
    CHECK_FALSE(presets.exists("Bass"));
    CHECK_FALSE(presets.remove("Bass"));
    CHECK(presetsIn(presets).presets.size() == 2);
}

TEST_CASE("A preset is written over another one only where that is wanted, and as a whole")
{
    const TempFolder folder;
    const SettingsPresets presets(folder / "presets");
    REQUIRE(save(presets, "Bass", turned(1), false));
    CHECK_FALSE(save(presets, "Bass", turned(2), false));
    CHECK(presetsIn(presets).presets.at(0).params == turned(1));
    REQUIRE(save(presets, "Bass", turned(2), true));
    CHECK(presetsIn(presets).presets.at(0).params == turned(2));
    int files = 0;
    for (const auto& file : std::filesystem::directory_iterator(presets.folder()))
        files += file.path().filename() == "Bass.json" ? 1 : 100; // no temporary is left
    CHECK(files == 1);
}

TEST_CASE("Names that are no names of files are refused")
{
    const TempFolder folder;
    const SettingsPresets presets(folder / "presets");
    for (const char* name : {"", ".", "..", "../up", "a/b", "a\\b", "c:d", "what?", "tab\there", ".hidden", " x", "x ",
                             "x.", "con", "NUL", "Com1", "aux.x"})
    {
        CAPTURE(name);
        CHECK_FALSE(save(presets, name, {}, true));
        CHECK_FALSE(presets.remove(name));
        CHECK_FALSE(presets.exists(name));
        CHECK_FALSE(presets.text(name));
        CHECK_FALSE(presets.rename("Bass", name));
        CHECK_FALSE(presets.rename(name, "Other"));
    }
    CHECK_FALSE(save(presets, std::string(SettingsPresets::longestName + 1, 'x'), {}, true));
    CHECK(save(presets, std::string(SettingsPresets::longestName, 'x'), {}, true).ok());
    CHECK_FALSE(std::filesystem::exists(folder / "up.json"));
}

TEST_CASE("Files that are no presets are named and left out")
{
    const TempFolder folder;
    const SettingsPresets presets(folder / "presets");
    REQUIRE(save(presets, "good", turned(1), false));
    const auto at = [&](const char* name)
    {
        return presets.folder() / name;
    };
    put(at("cut.json"), bytesOf(at("good.json")).substr(0, 60));
    put(at("empty.json"), "");
    put(at("newer.json"), R"({"format": "pacini.plugin", "version": 2})");
    put(at("other.json"), R"({"format": "pacini.clip", "version": 1})");
    put(at("wrong.json"), R"({"format": "pacini.plugin", "version": 1, "parameters": {"attack": "long"}})");
    put(at("large.json"), std::string(largestSettingsText + 1, ' '));
    put(at("analysis.json"), R"({"format": "pacini.settings", "version": 1, "encode": {"bands": 8}})");
    put(at("range.json"), R"({"format": "pacini.settings", "version": 1, "live": {"attack": 201}})");
    put(at("con.json"), liveSettings({}));
    put(at(".hidden.json"), "no preset at all");
    put(at("deep.json"), std::string(200000, '['));
    std::filesystem::create_directory(at("folder.json"));
    put(at("notes.txt"), "no preset at all");
    const auto listing = presetsIn(presets);
    REQUIRE(listing.presets.size() == 1);
    CHECK(listing.presets[0].name == "good");
    CHECK(listing.broken.size() == 11);
    for (const Error& error : listing.broken)
    {
        CHECK(error.where.ends_with(".json"));
        CHECK_FALSE(error.message.empty());
    }
    Random random(7);
    const std::string whole = bytesOf(at("good.json"));
    for (int i = 0; i < 300; ++i)
    {
        std::string bad = whole;
        bad[random.next() % bad.size()] = static_cast<char>(random.next());
        put(at("good.json"), bad);
        for (const UserPreset& preset : presetsIn(presets).presets)
        {
            ParameterValues values;
            values.setTranslator(preset.params);
            REQUIRE(values.translator() == preset.params); // within all ranges
        }
    }
}

TEST_CASE("A preset of the user is a step, leaves actuator and routing as they are, and is named by the session")
{
    PluginProcessor plugin;
    plugin.parameter(ParameterId::profile).setPlainNotifyingHost(3.0);
    plugin.parameter(ParameterId::strength).setPlainNotifyingHost(0.9);
    const auto before = plugin.values();
    plugin.choosePreset({"Bass", turned(1)});
    CHECK(plugin.values().translator().attack == Approx(turned(1).attack).margin(1e-3));
    CHECK(plugin.values().index(ParameterId::profile) == 3);
    CHECK(plugin.values()[ParameterId::strength] == before[ParameterId::strength]);
    CHECK(plugin.presetChoice().user == "Bass");
    juce::MemoryBlock block;
    plugin.getStateInformation(block);
    PluginProcessor other;
    other.setStateInformation(block.getData(), static_cast<int>(block.getSize()));
    CHECK(other.presetChoice().user == "Bass");
    plugin.undo();
    CHECK(plugin.values() == before);
    CHECK(plugin.presetChoice().user.empty());
    plugin.redo();
    CHECK(plugin.presetChoice().user == "Bass");
    plugin.applyProgram(2); // by the host
    CHECK(plugin.presetChoice() == PresetChoice{2, {}});
}
