// SPDX-License-Identifier: GPL-3.0-or-later
// Plays a sound through the VST3 of Windows or of this machine, as a host without a window does, and writes what its
// last bus puts out. Samples are raw 32-bit floats of one channel at 48 kHz. Built with the headers that JUCE brings.
//
// vst3_render MODULE IN OUT

#include <pluginterfaces/base/ibstream.h>
#include <pluginterfaces/base/ipluginbase.h>
#include <pluginterfaces/vst/ivstaudioprocessor.h>
#include <pluginterfaces/vst/ivstcomponent.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <vector>

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

using namespace Steinberg;

namespace Steinberg::Vst
{
DEF_CLASS_IID(IComponent)
DEF_CLASS_IID(IAudioProcessor)
} // namespace Steinberg::Vst

namespace
{

constexpr int block = 480;

int fail(const char* what)
{
    std::fprintf(stderr, "vst3_render: %s\n", what);
    return 1;
}

IPluginFactory* factoryOf(const char* path)
{
#ifdef _WIN32
    const HMODULE module = LoadLibraryA(path);
    if (!module)
        return nullptr;
    if (auto* init = reinterpret_cast<bool (*)()>(reinterpret_cast<void*>(GetProcAddress(module, "InitDll"))))
        init();
    auto* get = reinterpret_cast<IPluginFactory*(PLUGIN_API*)()>(
        reinterpret_cast<void*>(GetProcAddress(module, "GetPluginFactory")));
#else
    void* module = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!module)
        return nullptr;
    if (auto* init = reinterpret_cast<bool (*)(void*)>(dlsym(module, "ModuleEntry")))
        init(module);
    auto* get = reinterpret_cast<IPluginFactory* (*)()>(dlsym(module, "GetPluginFactory"));
#endif
    return get ? get() : nullptr;
}

/// Buses of one direction, all on; every channel is `sound`, or has room of its own.
struct Buses
{
    Buses(Vst::IComponent& component, Vst::BusDirection direction, float* sound)
    {
        const int32 count = component.getBusCount(Vst::kAudio, direction);
        buffers.resize(static_cast<std::size_t>(count));
        pointers.resize(buffers.size());
        for (int32 b = 0; b < count; ++b)
        {
            Vst::BusInfo info{};
            component.getBusInfo(Vst::kAudio, direction, b, info);
            component.activateBus(Vst::kAudio, direction, b, true);
            auto& channels = pointers[static_cast<std::size_t>(b)];
            for (int32 c = 0; c < info.channelCount; ++c)
                channels.push_back(sound ? sound : rooms.emplace_back(new float[block]{}));
            buffers[static_cast<std::size_t>(b)].numChannels = info.channelCount;
            buffers[static_cast<std::size_t>(b)].channelBuffers32 = channels.data();
        }
    }

    std::vector<Vst::AudioBusBuffers> buffers;
    std::vector<std::vector<float*>> pointers;
    std::vector<float*> rooms; // for as long as the program runs
};

} // namespace

int main(int argc, char** argv)
{
    if (argc != 4)
        return fail("needs MODULE IN OUT");
    IPluginFactory* factory = factoryOf(argv[1]);
    if (!factory)
        return fail("the plugin cannot be loaded");
    Vst::IComponent* component = nullptr;
    for (int32 i = 0; i < factory->countClasses() && !component; ++i)
    {
        PClassInfo info{};
        if (factory->getClassInfo(i, &info) == kResultOk && std::strcmp(info.category, kVstAudioEffectClass) == 0)
            factory->createInstance(info.cid, Vst::IComponent::iid, reinterpret_cast<void**>(&component));
    }
    Vst::IAudioProcessor* processor = nullptr;
    if (!component || component->initialize(nullptr) != kResultOk ||
        component->queryInterface(Vst::IAudioProcessor::iid, reinterpret_cast<void**>(&processor)) != kResultOk)
        return fail("the plugin cannot be made");
    static float sound[block];
    Buses inputs(*component, Vst::kInput, sound), outputs(*component, Vst::kOutput, nullptr);
    Vst::ProcessSetup setup{Vst::kOffline, Vst::kSample32, block, 48000.0};
    if (processor->setupProcessing(setup) != kResultOk || component->setActive(true) != kResultOk ||
        outputs.buffers.empty() || outputs.pointers.back().empty())
        return fail("the plugin does not start");
    processor->setProcessing(true);

    std::ifstream in(argv[2], std::ios::binary);
    std::ofstream out(argv[3], std::ios::binary);
    for (;;)
    {
        in.read(reinterpret_cast<char*>(sound), sizeof(sound));
        const auto frames = static_cast<int32>(in.gcount() / static_cast<std::streamsize>(sizeof(float)));
        if (frames == 0)
            break;
        Vst::ProcessData data{};
        data.processMode = Vst::kOffline;
        data.symbolicSampleSize = Vst::kSample32;
        data.numSamples = frames;
        data.numInputs = static_cast<int32>(inputs.buffers.size());
        data.numOutputs = static_cast<int32>(outputs.buffers.size());
        data.inputs = inputs.buffers.data();
        data.outputs = outputs.buffers.data();
        if (processor->process(data) != kResultOk)
            return fail("the plugin does not process");
        out.write(reinterpret_cast<const char*>(outputs.pointers.back().front()),
                  frames * static_cast<std::streamsize>(sizeof(float)));
    }
    processor->setProcessing(false);
    component->setActive(false);
    component->terminate();
    processor->release();
    component->release();
    return out.flush() ? 0 : fail("the drive cannot be written");
}
