// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/editor/MeasureDevice.h"

#include "app/ChannelPlaces.h"
#include "editor/Translation.h"

#include <algorithm>
#include <span>

namespace pacini::app
{

namespace
{
constexpr const char* otherWay =
    "Or measure with any player and recorder: save the sweep, play it and open the recording.";

/// The channels that the device really carries.
std::vector<std::string> activeNames(const juce::StringArray& names, const juce::BigInteger& active)
{
    std::vector<std::string> result;
    for (int c = 0; c < names.size(); ++c)
        if (active[c])
            result.push_back((juce::String(c + 1) + "  " + names[c]).toStdString());
    return result;
}
} // namespace

MeasureDevice::MeasureDevice(juce::AudioDeviceManager& wanted, const editor::HapticOutputs* hapticOutputs)
    : manager(wanted), haptic(hapticOutputs)
{
    for (auto& input : inputs)
        input.store(-1);
}

MeasureDevice::~MeasureDevice()
{
    setOpen(false);
}

void MeasureDevice::setOpen(bool open)
{
    if (open == opened)
        return;
    opened = open;
    if (!open)
    {
        manager.removeAudioCallback(this);
        if (manager.getCurrentAudioDevice() != nullptr)
            manager.setAudioDeviceSetup(before, true);
        return;
    }
    before = manager.getAudioDeviceSetup();
    auto setup = before;
    if (auto* type = manager.getCurrentDeviceTypeObject(); type != nullptr && setup.inputDeviceName.isEmpty())
    {
        // The same device for both, where it has inputs: one clock.
        const auto names = type->getDeviceNames(true);
        setup.inputDeviceName =
            names.contains(setup.outputDeviceName) ? setup.outputDeviceName : names[type->getDefaultDeviceIndex(true)];
    }
    constexpr int maxChannels = 64;
    setup.useDefaultInputChannels = false;
    setup.inputChannels.setRange(0, maxChannels, true);
    if (manager.getCurrentAudioDevice() != nullptr)
        openingError = manager.setAudioDeviceSetup(setup, true);
    manager.addAudioCallback(this);
}

RigPorts MeasureDevice::ports()
{
    RigPorts ports;
    const auto problem = [](const char* what, std::initializer_list<juce::String> values)
    {
        return (editor::tr(what, values) + " " + editor::tr(otherWay)).toStdString();
    };
    auto* device = manager.getCurrentAudioDevice();
    if (device == nullptr)
    {
        ports.name = editor::tr("No audio device").toStdString();
        ports.problem = problem("No audio device is open. Choose one under 'Audio devices'.", {});
        return ports;
    }
    const juce::String name = device->getName();
    ports.name = name.toStdString();
    ports.sampleRate = device->getCurrentSampleRate();
    ports.outputs = activeNames(device->getOutputChannelNames(), device->getActiveOutputChannels());
    if (const int channel = haptic != nullptr ? haptic->channelOf(0) : -1; channel >= 0)
    {
        const auto places = channelPlaces(device->getActiveOutputChannels());
        ports.expectedOutput = static_cast<std::size_t>(std::max(0, places[static_cast<std::size_t>(channel)]));
    }
    ports.inputs = activeNames(device->getInputChannelNames(), device->getActiveInputChannels());
    if (ports.outputs.empty())
        ports.problem = problem("'{0}' has no outputs. Choose another one under 'Audio devices'.", {name});
    else if (ports.inputs.empty())
        ports.problem = openingError.isEmpty()
                            ? problem("'{0}' has no inputs. Choose a device with an input for the sensor under 'Audio "
                                      "devices'.",
                                      {name})
                            : problem("'{0}' has no inputs ({1}). Choose a device with an input for the sensor under "
                                      "'Audio devices'.",
                                      {name, openingError});
    return ports;
}

void MeasureDevice::wire(const RigWiring& wiring)
{
    output.store(static_cast<int>(wiring.output));
    secondOutput.store(wiring.secondOutput ? static_cast<int>(*wiring.secondOutput) : -1);
    for (std::size_t i = 0; i < maxInputs; ++i)
        inputs[i].store(i < wiring.inputs.size() ? static_cast<int>(wiring.inputs[i]) : -1);
}

Result<void> MeasureDevice::start(std::vector<float> signal)
{
    auto* device = manager.getCurrentAudioDevice();
    if (device == nullptr)
        return Error{ErrorCode::io, "", ports().problem};
    const auto used = std::count_if(inputs.begin(), inputs.end(), [](const auto& input) { return input.load() >= 0; });
    // The callback must not run while room is made for the recording.
    manager.removeAudioCallback(this);
    auto prepared =
        callback.sweeps().prepare(std::move(signal), device->getCurrentSampleRate(), static_cast<std::size_t>(used));
    manager.addAudioCallback(this);
    if (!prepared)
        return prepared;
    interrupted.store(false);
    running = true;
    callback.sweeps().start();
    return {};
}

void MeasureDevice::stop()
{
    running = false;
    callback.sweeps().stop();
}

RigState MeasureDevice::state() const
{
    if (!running)
        return RigState::idle;
    if (callback.sweeps().state() == PlayAndRecordState::finished)
        return RigState::finished;
    return interrupted.load() ? RigState::lost : RigState::playing;
}

std::vector<std::vector<float>> MeasureDevice::takeRecording()
{
    const auto recorded = callback.sweeps().recording();
    std::vector<std::vector<float>> channels(recorded.begin(), recorded.end());
    stop();
    return channels;
}

void MeasureDevice::audioDeviceAboutToStart(juce::AudioIODevice* device)
{
    callback.prepare(device->getCurrentSampleRate());
    interrupted.store(true);
}

void MeasureDevice::audioDeviceIOCallbackWithContext(const float* const* in, int ins, float* const* out, int outs,
                                                     int frames, const juce::AudioIODeviceCallbackContext&)
{
    const auto count = static_cast<std::size_t>(frames);
    for (int c = 0; c < outs; ++c)
        if (out[c] != nullptr)
            juce::FloatVectorOperations::clear(out[c], frames);
    const int to = output.load();
    if (to < 0 || to >= outs || out[to] == nullptr)
        return;
    std::array<std::span<const float>, maxInputs> heard;
    std::size_t used = 0;
    for (const auto& input : inputs)
        if (const int c = input.load(); c >= 0 && c < ins && in[c] != nullptr)
            heard[used++] = {in[c], count};
    callback.process(std::span(heard).first(used), {out[to], count});
    if (const int second = secondOutput.load(); second >= 0 && second < outs && second != to && out[second] != nullptr)
        juce::FloatVectorOperations::copy(out[second], out[to], frames);
}

} // namespace pacini::app
