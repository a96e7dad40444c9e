// SPDX-License-Identifier: GPL-3.0-or-later

// Entry of the LV2: that of JUCE's wrapper, and answers to hosts that ask for values (patch:Get), which it leaves out.

#include "plugin/engine/PluginProcessor.h"
#include "plugin/window/PluginEntry.h"

#include <juce_audio_processors/format_types/juce_LV2Common.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <string>
#include <utility>

#undef lv2_descriptor // which, in this program, is that of JUCE's wrapper

/// The entry of JUCE's wrapper.
extern "C" const LV2_Descriptor* juceLv2Descriptor(std::uint32_t index);

namespace pacini::plugin
{

namespace
{
/// What is known of an instance beside JUCE's own, whose address hosts hand to the window.
struct Instance
{
    std::atomic<LV2_Handle> handle{nullptr}; ///< null: free for another one
    PluginProcessor* processor = nullptr;
    std::uint32_t inputPort = 0;
    const LV2_Atom_Sequence* input = nullptr;
    LV2_URID object = 0, urid = 0, get = 0, property = 0;
    std::array<LV2_URID, parameterCount> parameters{};
    Instance* next = nullptr;
};

/// All instances of the process. Found without a lock, so that the audio thread may: none is freed before the end.
class Instances
{
public:
    Instances() = default;
    Instances(const Instances&) = delete;
    Instances& operator=(const Instances&) = delete;
    ~Instances()
    {
        for (Instance* each = first.load(); each != nullptr;)
            delete std::exchange(each, each->next);
    }

    [[nodiscard]] Instance* find(LV2_Handle handle) const noexcept
    {
        Instance* each = first.load(std::memory_order_acquire);
        while (each != nullptr && each->handle.load(std::memory_order_acquire) != handle)
            each = each->next;
        return each;
    }

    void add(LV2_Handle handle, PluginProcessor& processor, const LV2_URID_Map& map)
    {
        const std::lock_guard lock(adding);
        Instance* place = find(nullptr);
        const bool fresh = place == nullptr;
        if (fresh)
            place = new Instance;
        const auto idOf = [&map](const std::string& uri)
        {
            return map.map(map.handle, uri.c_str());
        };
        place->processor = &processor;
        place->input = nullptr;
        place->inputPort =
            static_cast<std::uint32_t>(processor.getTotalNumInputChannels() + processor.getTotalNumOutputChannels());
        place->object = idOf(LV2_ATOM__Object);
        place->urid = idOf(LV2_ATOM__URID);
        place->get = idOf(LV2_PATCH__Get);
        place->property = idOf(LV2_PATCH__property);
        for (const ParameterRow& row : parameterTable)
            place->parameters[static_cast<std::size_t>(row.parameter)] =
                idOf(JucePlugin_LV2URI ":" + std::string(row.id));
        place->handle.store(handle, std::memory_order_release);
        if (!fresh)
            return;
        place->next = first.load();
        first.store(place, std::memory_order_release);
    }

private:
    std::atomic<Instance*> first{nullptr};
    std::mutex adding;
};

Instances& instances()
{
    static Instances all;
    return all;
}

/// Lets JUCE's wrapper send the value of `parameter`, as if it had changed, or of all of them for 0. [audio]
void tell(const Instance& instance, LV2_URID parameter)
{
    for (std::size_t i = 0; i < parameterCount; ++i)
        if (parameter == 0 || parameter == instance.parameters[i])
        {
            TableParameter& told = instance.processor->parameter(static_cast<ParameterId>(i));
            told.sendValueChangedMessageToListeners(told.getValue());
        }
}

/// [audio]
void answer(const Instance& instance)
{
    if (instance.input == nullptr)
        return;
    LV2_ATOM_SEQUENCE_FOREACH(instance.input, event)
    {
        const auto* message = reinterpret_cast<const LV2_Atom_Object*>(&event->body);
        if (event->body.type != instance.object || message->body.otype != instance.get)
            continue;
        LV2_URID asked = 0;
        LV2_ATOM_OBJECT_FOREACH(message, part)
        if (part->key == instance.property && part->value.type == instance.urid)
            asked = reinterpret_cast<const LV2_Atom_URID*>(&part->value)->body;
        tell(instance, asked);
    }
}

LV2_Handle instantiate(const LV2_Descriptor*, double rate, const char* folder, const LV2_Feature* const* features)
{
    const LV2_Descriptor* juces = juceLv2Descriptor(0);
    const LV2_Handle made = juces->instantiate(juces, rate, folder, features);
    for (; made != nullptr && *features != nullptr; ++features)
        if (std::strcmp((*features)->URI, LV2_URID__map) == 0)
            instances().add(made, *newestPlugin(), *static_cast<const LV2_URID_Map*>((*features)->data));
    return made;
}

void connect(LV2_Handle handle, std::uint32_t port, void* data)
{
    if (Instance* instance = instances().find(handle); instance != nullptr && port == instance->inputPort)
        instance->input = static_cast<const LV2_Atom_Sequence*>(data);
    juceLv2Descriptor(0)->connect_port(handle, port, data);
}

void run(LV2_Handle handle, std::uint32_t frames)
{
    if (const Instance* instance = instances().find(handle))
        answer(*instance);
    juceLv2Descriptor(0)->run(handle, frames);
}

void cleanUp(LV2_Handle handle)
{
    if (Instance* instance = instances().find(handle))
        instance->handle.store(nullptr, std::memory_order_release);
    juceLv2Descriptor(0)->cleanup(handle);
}
} // namespace

} // namespace pacini::plugin

LV2_SYMBOL_EXPORT const LV2_Descriptor* lv2_descriptor(std::uint32_t index)
{
    if (index != 0)
        return nullptr;
    static const LV2_Descriptor ours = []
    {
        LV2_Descriptor descriptor = *juceLv2Descriptor(0);
        descriptor.instantiate = pacini::plugin::instantiate;
        descriptor.connect_port = pacini::plugin::connect;
        descriptor.run = pacini::plugin::run;
        descriptor.cleanup = pacini::plugin::cleanUp;
        return descriptor;
    }();
    return &ours;
}
