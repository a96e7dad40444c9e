// The CLAP plugin on its audio thread, and what it reports to the host. Tests/hosts/check_clap.py tries the rest.

#include "plugin/clap/ClapParameters.h"
#include "plugin/clap/ClapPlugin.h"
#include "plugin/clap/ClapState.h"
#include "plugin/clap/ParameterReports.h"
#include "plugin/engine/Rig.h"
#include "support/HeapGuard.h"

#include <array>
#include <cstring>
#include <vector>

using namespace pacini;
using namespace pacini::test;
using plugin::ParameterId;

namespace
{
constexpr clap_plugin_descriptor_t clapDescription{CLAP_VERSION_INIT, "test", "Test", "", "", "", "", "1", "", nullptr};

/// A host without any extension.
constexpr clap_host_t plainHost{CLAP_VERSION_INIT,
                                nullptr,
                                "Test",
                                "",
                                "",
                                "1",
                                [](const clap_host_t*, const char*) -> const void* { return nullptr; },
                                [](const clap_host_t*) {},
                                [](const clap_host_t*) {},
                                [](const clap_host_t*) {
                                }};

/// A list for the plugin that takes no memory.
template <typename Event>
clap_input_events_t listOf(const std::vector<Event>& events)
{
    return {const_cast<std::vector<Event>*>(&events),
            [](const clap_input_events_t* list)
            { return static_cast<std::uint32_t>(static_cast<const std::vector<Event>*>(list->ctx)->size()); },
            [](const clap_input_events_t* list, std::uint32_t index)
            {
                return &(*static_cast<const std::vector<Event>*>(list->ctx))[index].header;
            }};
}

struct Sent
{
    std::uint16_t type;
    clap_id id;
    double value;
    bool operator==(const Sent&) const = default;
};

/// What the plugin sends to a host that takes `most` events.
struct Received
{
    std::vector<Sent> events;
    std::size_t most = 1000;
    clap_output_events_t list{this, [](const clap_output_events_t* to, const clap_event_header_t* event)
                              {
                                  auto& received = *static_cast<Received*>(to->ctx);
                                  if (received.events.size() >= received.most)
                                      return false;
                                  const auto& value = reinterpret_cast<const clap_event_param_value_t&>(*event);
                                  const bool isValue = event->type == CLAP_EVENT_PARAM_VALUE;
                                  const auto& gesture = reinterpret_cast<const clap_event_param_gesture_t&>(*event);
                                  received.events.push_back({event->type, isValue ? value.param_id : gesture.param_id,
                                                             isValue ? value.value : 0.0});
                                  return true;
                              }};
    Received() = default;
    Received(const Received&) = delete;
    Received& operator=(const Received&) = delete;
};

clap_event_param_value_t event(ParameterId parameter, double value, std::uint32_t time, std::uint16_t type)
{
    clap_event_param_value_t made{};
    made.header = {sizeof made, time, CLAP_CORE_EVENT_SPACE_ID, type, 0};
    made.param_id = plugin::clapIdOf(plugin::rowOf(parameter));
    made.value = value;
    return made;
}
} // namespace

TEST_CASE("A CLAP host's blocks make no heap traffic, with events for every parameter in every block")
{
    const juce::ScopedJuceInitialiser_GUI messages;
    const clap_plugin_t* plugin = plugin::ClapPlugin::make(plainHost, clapDescription);
    REQUIRE(plugin->init(plugin));
    REQUIRE(plugin->activate(plugin, 48000.0, 1, 4096));
    REQUIRE(plugin->start_processing(plugin));

    const auto sound = liveSound(4096, 3);
    std::array<std::vector<float>, 3> in{sound, sound, sound}, out{sound, sound, sound};
    std::array<float*, 3> ins{in[0].data(), in[1].data(), in[2].data()};
    std::array<float*, 3> outs{out[0].data(), out[1].data(), out[2].data()};
    const std::array<clap_audio_buffer_t, 2> inputs{
        {{ins.data(), nullptr, 2, 0, 0}, {ins.data() + 2, nullptr, 1, 0, 0}}};
    std::array<clap_audio_buffer_t, 2> outputs{{{outs.data(), nullptr, 2, 0, 0}, {outs.data() + 2, nullptr, 1, 0, 0}}};

    Random random(7);
    std::vector<clap_event_param_value_t> events;
    Received received;
    received.events.reserve(100);
    std::size_t traffic = 0;
    for (int block = 0; block < 60; ++block)
    {
        events.clear();
        for (const plugin::ParameterRow& row : plugin::parameterTable)
            events.push_back(event(row.parameter, row.low + random.uniform() * (row.high - row.low),
                                   static_cast<std::uint32_t>(random.uniform() * 4096.0),
                                   block % 2 == 0 ? CLAP_EVENT_PARAM_VALUE : CLAP_EVENT_PARAM_MOD));
        const clap_input_events_t list = listOf(events);
        const clap_process_t process{-1, 4096, nullptr, inputs.data(), outputs.data(), 2, 2, &list, &received.list};
        const HeapGuard guard;
        CHECK(plugin->process(plugin, &process) == CLAP_PROCESS_CONTINUE);
        if (block % 20 == 19)
            plugin->reset(plugin);
        plugin::paramsExtension().flush(plugin, &list, &received.list);
        traffic += guard.traffic();
        for (const auto& channel : out)
            for (const float y : channel)
                REQUIRE(std::isfinite(y));
    }
    CHECK(traffic == 0);
    CHECK(received.events.empty());
    plugin->stop_processing(plugin);
    plugin->deactivate(plugin);
    plugin->destroy(plugin);
}

TEST_CASE("A CLAP host hears each gesture from beginning to end, with the last value, and no change of its own")
{
    const juce::ScopedJuceInitialiser_GUI messages;
    plugin::PluginProcessor processor;
    int asked = 0, edited = 0;
    plugin::ParameterReports reports(processor, {[&asked] { ++asked; },
                                                 [&edited]
                                                 {
                                                     ++edited;
                                                 }});
    auto& intensity = processor.parameter(ParameterId::intensity);
    const clap_id id = plugin::clapIdOf(intensity.row());
    const auto sent = [&reports](std::size_t most = 1000)
    {
        Received received;
        received.most = most;
        reports.send(received.list);
        return received.events;
    };
    const Sent begin{CLAP_EVENT_PARAM_GESTURE_BEGIN, id, 0.0}, end{CLAP_EVENT_PARAM_GESTURE_END, id, 0.0};
    const auto valued = [id](double value)
    {
        return Sent{CLAP_EVENT_PARAM_VALUE, id, value};
    };
    CHECK(sent().empty());

    SECTION("Within one block")
    {
        intensity.beginChangeGesture();
        intensity.setPlainNotifyingHost(-3.0);
        intensity.setPlainNotifyingHost(-6.0);
        intensity.endChangeGesture();
        CHECK(asked == 4);
        CHECK(sent() == std::vector<Sent>{begin, valued(-6.0), end});
        CHECK(sent().empty());
    }
    SECTION("Over several, of which one takes the next in")
    {
        intensity.beginChangeGesture();
        CHECK(sent() == std::vector<Sent>{begin});
        intensity.setPlainNotifyingHost(-3.0);
        CHECK(sent() == std::vector<Sent>{valued(-3.0)});
        intensity.endChangeGesture();
        intensity.beginChangeGesture();
        intensity.setPlainNotifyingHost(-9.0);
        CHECK(sent() == std::vector<Sent>{valued(-9.0)});
        intensity.endChangeGesture();
        CHECK(sent() == std::vector<Sent>{end});
    }
    SECTION("What a full host does not take comes later")
    {
        intensity.beginChangeGesture();
        intensity.setPlainNotifyingHost(-6.0);
        intensity.endChangeGesture();
        CHECK(sent(0).empty());
        CHECK(sent(1) == std::vector<Sent>{begin});
        CHECK(sent(1) == std::vector<Sent>{valued(-6.0)});
        CHECK(sent(1) == std::vector<Sent>{end});
        CHECK(sent().empty());
    }
    SECTION("Of what the host does itself, nothing")
    {
        const plugin::ParameterReports::Pause pause(reports);
        intensity.setPlainNotifyingHost(-6.0);
        processor.applyProgram(2);
        const auto list = event(ParameterId::attack, 30.0, 0, CLAP_EVENT_PARAM_VALUE);
        plugin::applyEvent(processor, list.header);
        CHECK(processor.parameter(ParameterId::attack).value() == 30.0);
        CHECK(sent().empty());
        CHECK(asked == 0);
    }
    SECTION("A preset that the user chooses: its values, and that the session changed")
    {
        processor.chooseProgram(2);
        const auto events = sent();
        CHECK(events.size() > 3);
        CHECK(events.size() % 3 == 0);
        CHECK(edited == 1);
    }
}

TEST_CASE("What a CLAP host adds to a value is heard and not kept")
{
    plugin::PluginProcessor processor;
    auto& intensity = processor.parameter(ParameterId::intensity);
    intensity.setPlain(-6.0);
    intensity.setModulation(-3.0);
    CHECK(intensity.value() == -6.0);
    CHECK(intensity.heard() == -9.0);
    CHECK(processor.values()[ParameterId::intensity] == -6.0);
    CHECK(processor.heardValues()[ParameterId::intensity] == -9.0);
    intensity.setModulation(std::numeric_limits<double>::quiet_NaN());
    CHECK(intensity.heard() == -9.0);
    intensity.setModulation(1e9);
    CHECK(intensity.heard() == 24.0);
    intensity.setPlain(std::numeric_limits<double>::infinity());
    CHECK(intensity.value() == -6.0);
}

TEST_CASE("A CLAP host's streams may lie about their sizes")
{
    const clap_ostream_t more{nullptr, [](const clap_ostream_t*, const void*, std::uint64_t size)
                              {
                                  return static_cast<std::int64_t>(size) + 1;
                              }};
    CHECK_FALSE(plugin::writeAll(more, "abc"));
    const clap_ostream_t none{nullptr, [](const clap_ostream_t*, const void*, std::uint64_t)
                              {
                                  return std::int64_t(0);
                              }};
    CHECK_FALSE(plugin::writeAll(none, "abc"));
    CHECK(plugin::writeAll(none, ""));
    const clap_istream_t larger{nullptr, [](const clap_istream_t*, void*, std::uint64_t size)
                                {
                                    return static_cast<std::int64_t>(size) + 1;
                                }};
    CHECK_FALSE(plugin::readAll(larger, 100000).has_value());
    const clap_istream_t endless{nullptr, [](const clap_istream_t*, void* to, std::uint64_t size)
                                 {
                                     std::memset(to, 'a', static_cast<std::size_t>(size));
                                     return static_cast<std::int64_t>(size);
                                 }};
    CHECK_FALSE(plugin::readAll(endless, 100000).has_value());
}
