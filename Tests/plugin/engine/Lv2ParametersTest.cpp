// The description of the parameters for LV2 hosts.

#include "plugin/engine/Lv2Parameters.h"

#include "plugin/engine/PluginProcessor.h"
#include "support/Catch.h"

#include <pacini/realtime/TranslatorPresets.h>

#include <string>

using namespace pacini;
using namespace pacini::plugin;

namespace
{
constexpr std::string_view head = "@prefix plug:  <urn:pacini:translator:> .\n\n";
constexpr std::string_view tail =
    "<urn:pacini:translator>\n\tdoap:name \"Ends. with \\\" . and plug:x a lv2:Parameter\" ;\n"
    "\tlv2:port [ lv2:default 1.0 ; ] .\n";

/// As JUCE writes it.
std::string statement(const std::string& id)
{
    return "plug:" + id +
           "\n\ta lv2:Parameter ;\n\trdfs:label \"A. B\" ;\n\tlv2:default 0.5 ;\n\tlv2:scalePoint [\n"
           "\t\trdfs:label \"Mix\" ;\n\t\trdf:value 0.5 ;\n\t] .\n\n";
}

std::string written()
{
    std::string text(head);
    for (const ParameterRow& row : parameterTable)
        text += statement(row.id);
    return text.append(tail);
}
} // namespace

TEST_CASE("For LV2, choices stand on the values that the plugin takes for them")
{
    const auto described = describeLv2Parameters(written());
    REQUIRE(described);
    const std::string& text = *described;
    CHECK(text.starts_with(head));
    CHECK(text.find(tail) != text.npos); // what is no parameter stays as it is
    for (const ParameterRow& row : parameterTable)
    {
        CAPTURE(row.id);
        const auto begin = text.find("plug:" + std::string(row.id) + "\n\ta lv2:Parameter ;");
        REQUIRE(begin != text.npos);
        CHECK(text.find("plug:" + std::string(row.id) + "\n", begin + 1) == text.npos);
        const std::string own = text.substr(begin, text.find(" .\n", begin) - begin);
        CHECK(own.find("rdf:value 0.5000") == own.npos);
        for (std::size_t i = 0; i < row.choices.size(); ++i)
            CHECK((own.find("[ rdfs:label \"" + std::string(row.choices[i]) + "\" ; rdf:value " + std::to_string(i) +
                            ".0000 ]") != own.npos) == !hasNoActuator(row.choices[i]));
        const auto number = [](double value)
        {
            const std::string digits = std::to_string(value);
            return digits.substr(0, digits.find('.') + 5);
        };
        CHECK(own.find("lv2:minimum " + number(row.low)) != own.npos);
        CHECK(own.find("lv2:maximum " + number(row.high)) != own.npos);
        CHECK(own.find("lv2:default " + number(row.standard)) != own.npos);
    }
    CHECK(*describeLv2Parameters(text) == text);
}

TEST_CASE(
    "For LV2, parameters have groups, ports the names of what they carry, and no page is named that does not exist")
{
    const auto described = describeLv2Parameters(
        written() +
        "<urn:pacini:translator>\n\tdoap:maintainer [\n\t\tfoaf:homepage <https://pacini.example> ;\n"
        "\t\tfoaf:mbox <> ;\n\t] ;\n\tlv2:port [ lv2:name \"Audio In 3\" ] , [ lv2:name \"Audio Out 3\" ] .\n");
    REQUIRE(described);
    const std::string& text = *described;
    const auto groupOf = [&](const std::string& id)
    {
        const std::string before = "pg:group plug:group_";
        const auto at = text.find(before, text.find("plug:" + id + "\n")) + before.size();
        return text.substr(at, text.find(' ', at) - at);
    };
    CHECK(groupOf("source") == "sound");
    CHECK(groupOf("profile") == "actuator");
    CHECK(groupOf("transientMute") == "layers");
    CHECK(groupOf("transientSharpness") == "events");
    CHECK(groupOf("gateRelease") == "gate");
    CHECK(groupOf("places") == "panning");
    CHECK(groupOf("place8") == "channels");
    CHECK(groupOf("actuator2") == "channels");
    for (const ParameterRow& row : parameterTable)
        CHECK(text.find("plug:group_" + groupOf(row.id) + "\n\ta pg:Group ;") != text.npos);
    CHECK(text.find("lv2:name \"Sidechain\"") != text.npos);
    CHECK(text.find("lv2:name \"Haptic\"") != text.npos);
    for (const char* gone : {"Audio In", "Audio Out", "homepage", "mbox"})
        CHECK(text.find(gone) == text.npos);
    CHECK(*describeLv2Parameters(text) == text);
}

TEST_CASE("A description for LV2 that lacks a parameter or has one too many is refused")
{
    CHECK(describeLv2Parameters(std::string(head).append(tail)).error().where == parameterTable[0].id);
    CHECK(describeLv2Parameters(written() + statement("other")).error().where == "other");
    CHECK_FALSE(describeLv2Parameters(""));
}

TEST_CASE("For LV2, the window states what LV2 knows, and the rest stays")
{
    const std::string data = "\tlv2:extensionData\n\t\tui:idleInterface ,\n\t\topts:interface ,\n";
    const std::string feature = "\t\tui:resize ;\n\n\tlv2:optionalFeature\n\t\tui:resize ,\n";
    const std::string options = "\t\topts:options ;\n";
    const std::string described =
        describeLv2Window(data + "\t\tui:noUserResize ,\n" + feature + "\t\topts:interface ,\n" + options);
    CHECK(described == data + feature + options);
    CHECK(describeLv2Window(described) == described);
}

TEST_CASE("In LV2, the host's switch and the parameter bypass for themselves, and a preset always sets its values")
{
    juce::AudioProcessor::setTypeOfNextNewPlugin(juce::AudioProcessor::wrapperType_LV2);
    PluginProcessor plugin;
    juce::AudioProcessor::setTypeOfNextNewPlugin(juce::AudioProcessor::wrapperType_Undefined);
    CHECK(plugin.getBypassParameter() == nullptr); // or JUCE writes the host's switch over it in every block
    CHECK(PluginProcessor().getBypassParameter() != nullptr);

    plugin.setRateAndBufferSizeDetails(48000.0, 512);
    plugin.prepareToPlay(48000.0, 512);
    juce::AudioBuffer<float> buffer(3, 512);
    juce::MidiBuffer midi;
    for (const bool bypassed : {true, false})
    {
        buffer.clear();
        if (bypassed)
            plugin.processBlockBypassed(buffer, midi);
        else
            plugin.processBlock(buffer, midi);
        CHECK(plugin.isBypassedByHost() == bypassed);
    }

    plugin.parameter(ParameterId::attack).setPlainNotifyingHost(77.0);
    plugin.setCurrentProgram(plugin.getCurrentProgram());
    CHECK(plugin.values().translator() == translatorPresets()[0].params);
}
