// Presets of the user.

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
} // namespace

TEST_CASE("Presets that were saved are listed by name, with all live parameters, and can be deleted")
{
    const TempFolder folder;
    const UserPresets presets(folder / "not" / "there yet");
    CHECK(presets.list().presets.empty());
    CHECK(presets.list().broken.empty());
    REQUIRE(presets.save("Rain on a tent", turned(1), false));
    REQUIRE(presets.save("\xc3\x84rger", turned(2), false));
    REQUIRE(presets.save("Bass", turned(3), false));
    const auto listing = presets.list();
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
    CHECK(presets.list().presets.size() == 2);
}

TEST_CASE("A preset is written over another one only where that is wanted, and as a whole")
{
    const TempFolder folder;
    const UserPresets presets(folder / "presets");
    REQUIRE(presets.save("Bass", turned(1), false));
    CHECK_FALSE(presets.save("Bass", turned(2), false));
    CHECK(presets.list().presets[0].params == turned(1));
    REQUIRE(presets.save("Bass", turned(2), true));
    CHECK(presets.list().presets[0].params == turned(2));
    int files = 0;
    for (const auto& file : std::filesystem::directory_iterator(presets.folder()))
        files += file.path().filename() == "Bass.json" ? 1 : 100; // no temporary is left
    CHECK(files == 1);
}

TEST_CASE("Names that are no names of files are refused")
{
    const TempFolder folder;
    const UserPresets presets(folder / "presets");
    for (const char* name : {"", ".", "..", "../up", "a/b", "a\\b", "c:d", "what?", "tab\there", ".hidden", " x", "x ",
                             "x.", "con", "NUL", "Com1", "aux.x"})
    {
        CAPTURE(name);
        CHECK_FALSE(presets.save(name, {}, true));
        CHECK_FALSE(presets.remove(name));
        CHECK_FALSE(presets.exists(name));
    }
    CHECK_FALSE(presets.save(std::string(UserPresets::longestName + 1, 'x'), {}, true));
    CHECK(presets.save(std::string(UserPresets::longestName, 'x'), {}, true).ok());
    CHECK_FALSE(std::filesystem::exists(folder / "up.json"));
}

TEST_CASE("Files that are no presets are named and left out")
{
    const TempFolder folder;
    const UserPresets presets(folder / "presets");
    REQUIRE(presets.save("good", turned(1), false));
    const auto at = [&](const char* name)
    {
        return presets.folder() / name;
    };
    put(at("cut.json"), bytesOf(at("good.json")).substr(0, 60));
    put(at("empty.json"), "");
    put(at("newer.json"), R"({"format": "pacini.plugin", "version": 2})");
    put(at("other.json"), R"({"format": "pacini.clip", "version": 1})");
    put(at("wrong.json"), R"({"format": "pacini.plugin", "version": 1, "parameters": {"attack": "long"}})");
    put(at("large.json"), std::string(UserPresets::largestFile + 1, ' '));
    put(at("deep.json"), std::string(200000, '['));
    std::filesystem::create_directory(at("folder.json"));
    put(at("notes.txt"), "no preset at all");
    const auto listing = presets.list();
    REQUIRE(listing.presets.size() == 1);
    CHECK(listing.presets[0].name == "good");
    CHECK(listing.broken.size() == 8);
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
        for (const UserPreset& preset : presets.list().presets)
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
