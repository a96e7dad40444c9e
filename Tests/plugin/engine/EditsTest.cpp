// Undo and redo, the sides A and B.

#include "io/ProfileFile.h"
#include "plugin/engine/Rig.h"
#include "support/HeapGuard.h"
#include "support/RandomProfile.h"
#include "support/TempFolder.h"

#include <pacini/realtime/TranslatorPresets.h>

using namespace pacini;
using namespace pacini::test;
using namespace pacini::plugin;

namespace
{
/// As a knob does: one gesture with many values.
void drag(PluginProcessor& plugin, ParameterId id, std::initializer_list<float> places)
{
    auto& parameter = plugin.parameter(id);
    parameter.beginChangeGesture();
    for (const float place : places)
        parameter.setValueNotifyingHost(place);
    parameter.endChangeGesture();
}

std::string stateOf(PluginProcessor& plugin)
{
    juce::MemoryBlock block;
    plugin.getStateInformation(block);
    return {static_cast<const char*>(block.getData()), block.getSize()};
}
} // namespace

TEST_CASE("A gesture is one step, which undo takes back and redo does again")
{
    PluginProcessor plugin;
    CHECK_FALSE(plugin.canUndo());
    CHECK_FALSE(plugin.canRedo());
    const auto first = plugin.values();
    drag(plugin, ParameterId::attack, {0.2f, 0.3f, 0.4f, 0.5f});
    const auto second = plugin.values();
    drag(plugin, ParameterId::rumbleMute, {1.0f});
    const auto third = plugin.values();
    plugin.undo();
    CHECK(plugin.values() == second);
    plugin.undo();
    CHECK(plugin.values() == first);
    CHECK_FALSE(plugin.canUndo());
    plugin.undo();
    CHECK(plugin.values() == first);
    plugin.redo();
    plugin.redo();
    plugin.redo();
    CHECK(plugin.values() == third);
    CHECK_FALSE(plugin.canRedo());
    plugin.undo();
    drag(plugin, ParameterId::intensity, {0.9f}); // another way from here
    CHECK_FALSE(plugin.canRedo());
    plugin.undo();
    plugin.undo();
    CHECK(plugin.values() == first);
}

TEST_CASE("A gesture that changes nothing is no step, and the oldest of many steps are forgotten")
{
    PluginProcessor plugin;
    const float place = plugin.parameter(ParameterId::attack).getValue();
    drag(plugin, ParameterId::attack, {0.9f, place});
    CHECK_FALSE(plugin.canUndo());
    for (std::size_t i = 0; i < StepList::mostSteps + 50; ++i)
        drag(plugin, i % 2 == 0 ? ParameterId::attack : ParameterId::release, {0.001f * static_cast<float>(i + 1)});
    std::size_t steps = 0;
    for (; plugin.canUndo(); ++steps)
        plugin.undo();
    CHECK(steps == StepList::mostSteps);
    CHECK(plugin.parameter(ParameterId::attack).getValue() == Approx(0.049).margin(1e-3)); // values have four decimals
}

TEST_CASE("Notches of the wheel on one knob are one step; what takes its time, or is switched, is one each")
{
    PluginProcessor plugin;
    const auto first = plugin.values();
    for (const float place : {0.50f, 0.51f, 0.52f, 0.53f})
        drag(plugin, ParameterId::attack, {place});
    for (const float on : {1.0f, 0.0f, 1.0f})
        drag(plugin, ParameterId::rumbleMute, {on});
    for (int i = 0; i < 3; ++i)
    {
        plugin.undo();
        CHECK(plugin.parameter(ParameterId::attack).getValue() == Approx(0.53f));
    }
    plugin.undo();
    CHECK(plugin.values() == first);
    StepList steps;
    EditStep step;
    step.instant = true;
    for (const std::uint32_t at : {4294967000u, 100u, 700u, 1100u}) // the clock wraps
    {
        step.milliseconds = at;
        step.changes = {{ParameterId::attack, 0.0, static_cast<double>(at)}};
        steps.add(step);
    }
    CHECK(steps.undo() != nullptr);
    CHECK(steps.undo() != nullptr);
    CHECK_FALSE(steps.canUndo());
}

TEST_CASE("Automation by the host makes no steps, allocates nothing, and is no part of a gesture beside it")
{
    PluginProcessor plugin;
    for (int i = 0; i < 100; ++i) // as wrappers do
    {
        auto& parameter = plugin.parameter(ParameterId::intensity);
        const HeapGuard guard;
        parameter.setValue(0.01f * static_cast<float>(i));
        parameter.sendValueChangedMessageToListeners(parameter.getValue());
        CHECK(guard.traffic() == 0);
    }
    CHECK_FALSE(plugin.canUndo());
    plugin.parameter(ParameterId::attack).beginChangeGesture();
    plugin.parameter(ParameterId::attack).setValueNotifyingHost(0.7f);
    plugin.parameter(ParameterId::intensity).setValue(0.25f);
    plugin.parameter(ParameterId::attack).endChangeGesture();
    plugin.undo();
    CHECK(plugin.values()[ParameterId::attack] == rowOf(ParameterId::attack).standard);
    CHECK(plugin.parameter(ParameterId::intensity).getValue() == 0.25f);
}

TEST_CASE("A preset that the user chose is one step, one that the host chose is none")
{
    PluginProcessor plugin;
    drag(plugin, ParameterId::attack, {0.6f});
    const auto turned = plugin.values();
    plugin.chooseProgram(2);
    CHECK(plugin.values().translator() == translatorPresets()[2].params);
    plugin.undo();
    CHECK(plugin.values() == turned);
    CHECK(plugin.getCurrentProgram() == 0);
    plugin.redo();
    CHECK(plugin.getCurrentProgram() == 2);
    CHECK(plugin.values().translator() == translatorPresets()[2].params);
    plugin.undo();
    plugin.setCurrentProgram(3);
    CHECK(plugin.canRedo());
    plugin.undo();
    CHECK_FALSE(plugin.canUndo());
}

TEST_CASE("A session that is loaded has no steps of the one before")
{
    PluginProcessor plugin;
    const std::string before = stateOf(plugin);
    drag(plugin, ParameterId::attack, {0.6f});
    plugin.setStateInformation(before.data(), static_cast<int>(before.size()));
    CHECK_FALSE(plugin.canUndo());
    CHECK_FALSE(plugin.canRedo());
}

TEST_CASE("Each side has its own settings, actuator and steps; B begins as A was")
{
    const TempFolder folder;
    auto own = randomProfile(4);
    own.name = "bench rig 7";
    own.shortName.clear();
    REQUIRE(writeProfile(folder / "own.json", own));
    PluginProcessor plugin;
    plugin.chooseProgram(1);
    REQUIRE(plugin.loadActuator(juce::File((folder / "own.json").string())));
    const auto a = plugin.values();
    CHECK(plugin.side() == Side::a);
    plugin.chooseSide(Side::b);
    CHECK(plugin.side() == Side::b);
    CHECK(plugin.values() == a);
    CHECK_FALSE(plugin.canUndo());
    plugin.chooseProgram(4);
    plugin.parameter(ParameterId::profile).setPlainNotifyingHost(3.0);
    drag(plugin, ParameterId::inputGain, {0.8f});
    drag(plugin, ParameterId::bypass, {1.0f});
    const auto b = plugin.values();
    plugin.chooseSide(Side::a);
    auto expected = a;
    expected.set(ParameterId::bypass, 1.0); // which belongs to no side
    CHECK(plugin.values() == expected);
    CHECK(plugin.actuatorName() == "bench rig 7");
    CHECK(plugin.getCurrentProgram() == 1);
    plugin.undo();
    CHECK(plugin.getCurrentProgram() == 0);
    plugin.redo();
    plugin.chooseSide(Side::b);
    CHECK(plugin.values() == b);
    CHECK(plugin.getCurrentProgram() == 4);
    CHECK(plugin.actuatorName() != "bench rig 7");
    // And from A to B.
    plugin.chooseSide(Side::a);
    plugin.copyToOtherSide();
    plugin.chooseSide(Side::b);
    CHECK(plugin.values() == expected);
    CHECK(plugin.actuatorName() == "bench rig 7");
    plugin.undo();
    CHECK(plugin.values()[ParameterId::inputGain] == b[ParameterId::inputGain]);
    CHECK(plugin.getCurrentProgram() == 4);
}

TEST_CASE("A session has both sides; one from before there were sides loads as A")
{
    PluginProcessor first;
    first.chooseProgram(1);
    first.parameter(ParameterId::profile).setPlainNotifyingHost(1.0);
    first.chooseSide(Side::b);
    first.chooseProgram(5);
    first.parameter(ParameterId::profile).setPlainNotifyingHost(3.0);
    const auto b = first.values();
    const std::string text = stateOf(first);
    PluginProcessor second;
    second.setStateInformation(text.data(), static_cast<int>(text.size()));
    CHECK(stateOf(second) == text);
    CHECK(second.side() == Side::b);
    CHECK(second.values() == b);
    second.chooseSide(Side::a);
    CHECK(second.getCurrentProgram() == 1);
    CHECK(second.values().index(ParameterId::profile) == 1);
    CHECK(second.note().isEmpty());

    const std::string old = R"({"format": "pacini.plugin", "version": 1, "parameters": {"attack": 7}, "program": 2})";
    second.setStateInformation(old.data(), static_cast<int>(old.size()));
    CHECK(second.side() == Side::a);
    CHECK(second.values()[ParameterId::attack] == Approx(7.0));
    const auto loaded = second.values();
    second.chooseSide(Side::b);
    CHECK(second.values() == loaded);
    const std::string broken = R"({"format": "pacini.plugin", "version": 1, "side": 7, "otherSide": [1], "preset": 3})";
    second.setStateInformation(broken.data(), static_cast<int>(broken.size()));
    CHECK(second.side() == Side::a);
}
