// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/engine/PluginProcessor.h"

#include "document/BuiltInProfiles.h"
#include "io/ProfileFile.h"
#include "plugin/engine/ParameterText.h"

#include <pacini/realtime/TranslatorPresets.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace pacini::plugin
{

namespace
{
using Layout = juce::AudioChannelSet;

constexpr int mainBus = 0;
constexpr int sidechainBus = 1;
constexpr int hapticBus = 1;
} // namespace

// The sidechain is there from the start and its silence counts as none: hosts differ in what they hand to a bus that is
// switched off.
PluginProcessor::PluginProcessor()
    : AudioProcessor(BusesProperties()
                         .withInput("Main", Layout::stereo(), true)
                         .withInput("Sidechain", Layout::mono(), true)
                         .withOutput("Main", Layout::stereo(), true)
                         .withOutput("Haptic", Layout::mono(), true))
{
    for (const ParameterRow& row : parameterTable)
    {
        auto made = std::make_unique<TableParameter>(row);
        table[static_cast<std::size_t>(row.parameter)] = made.get();
        addParameter(made.release());
    }
    applied = builtInProfile(0);
    appliedStrength = parameter(ParameterId::strength).value();
    tradesNow = applied && tradesStrength(*applied);
    engine.setSetup(setupNow());
    engine.setClips(&clips);
    worker->add(*this);
}

PluginProcessor::~PluginProcessor()
{
    worker->remove(*this);
}

bool PluginProcessor::isBusesLayoutSupported(const BusesLayout& layout) const
{
    const auto within = [](const Layout& set, std::size_t most)
    {
        return set.size() <= static_cast<int>(most);
    };
    const Layout main = layout.getMainInputChannelSet();
    if (main.isDisabled() || main != layout.getMainOutputChannelSet() || !within(main, maxMainChannels))
        return false;
    return within(layout.getChannelSet(true, sidechainBus), maxSidechainChannels) &&
           within(layout.getChannelSet(false, hapticBus), maxHapticChannels);
}

void PluginProcessor::prepareToPlay(double newRate, int)
{
    {
        const juce::ScopedLock lock(setupLock);
        catchUp();
        engine.prepare(newRate, static_cast<std::size_t>(std::max(getMainBusNumInputChannels(), 1)));
    }
    clips.prepare(newRate);
    setLatencySamples(static_cast<int>(engine.latencyFrames()));
}

void PluginProcessor::reset()
{
    engine.reset();
}

void PluginProcessor::processBlock(juce::AudioBuffer<float>& buffer, juce::MidiBuffer&)
{
    process(buffer, false);
}

void PluginProcessor::processBlockBypassed(juce::AudioBuffer<float>& buffer, juce::MidiBuffer&)
{
    process(buffer, true);
}

void PluginProcessor::process(juce::AudioBuffer<float>& buffer, bool bypassed) noexcept
{
    const juce::ScopedNoDenormals noDenormals;
    // Offline there is time, and no worker thread can keep up.
    if (isNonRealtime())
        catchUp();

    // One buffer holds inputs and outputs: a channel may be the sidechain and the haptic output at once.
    std::array<float*, maxMainChannels> main{};
    std::array<const float*, maxSidechainChannels> sidechain{};
    std::array<float*, maxHapticChannels> haptic{};
    const auto gather = [&](bool isInput, int bus, auto& channels) noexcept -> std::size_t
    {
        if (bus >= getBusCount(isInput))
            return 0;
        const int first = getChannelIndexInProcessBlockBuffer(isInput, bus, 0);
        const int count = std::min(
            {getChannelCountOfBus(isInput, bus), static_cast<int>(channels.size()), buffer.getNumChannels() - first});
        for (int c = 0; c < count; ++c)
            channels[static_cast<std::size_t>(c)] = buffer.getWritePointer(first + c);
        return static_cast<std::size_t>(std::max(count, 0));
    };
    const std::size_t mains = gather(false, mainBus, main);
    const std::size_t sides = gather(true, sidechainBus, sidechain);
    const std::size_t haptics = gather(false, hapticBus, haptic);
    engine.process({std::span<float* const>(main).first(mains), std::span<const float* const>(sidechain).first(sides),
                    std::span<float* const>(haptic).first(haptics), static_cast<std::size_t>(buffer.getNumSamples())},
                   values(), bypassed);
}

ParameterValues PluginProcessor::values() const noexcept
{
    ParameterValues result;
    for (const TableParameter* each : table)
        result.set(each->row().parameter, each->value());
    return result;
}

void PluginProcessor::setValues(const ParameterValues& wanted)
{
    for (TableParameter* each : table)
        each->setPlainNotifyingHost(wanted[each->row().parameter]);
}

std::size_t PluginProcessor::wantedSlot() const noexcept
{
    return static_cast<std::size_t>(parameter(ParameterId::profile).value() + 0.5);
}

TranslatorSetup PluginProcessor::setupNow() const
{
    TranslatorSetup setup;
    setup.profile = applied;
    setup.strength = appliedStrength;
    return setup;
}

/// Hands the chosen actuator and the strength to the translator. [worker], [message]
void PluginProcessor::catchUp()
{
    const juce::ScopedLock lock(setupLock);
    const std::size_t slot = wantedSlot();
    const double strength = parameter(ParameterId::strength).value();
    const bool sameActuator = slot == appliedSlot;
    if (sameActuator && strength == appliedStrength)
        return;
    appliedStrength = strength;
    if (!sameActuator)
    {
        appliedSlot = slot;
        applied = slot == ownProfileSlot ? ownProfile : builtInProfile(slot);
        tradesNow = applied && tradesStrength(*applied);
    }
    else if (!tradesNow)
        return; // each new set-up fades out and in
    engine.setSetup(setupNow());
}

void PluginProcessor::getStateInformation(juce::MemoryBlock& block)
{
    PluginState state;
    {
        const juce::ScopedLock lock(setupLock);
        catchUp();
        state.profile = applied;
    }
    state.values = values();
    state.program = program.load();
    state.clips = clips.text();
    state.windowWidth = windowWidth.load();
    state.windowHeight = windowHeight.load();
    const std::string text = stateText(state);
    block.replaceAll(text.data(), text.size());
}

void PluginProcessor::setStateInformation(const void* data, int size)
{
    if (data == nullptr || size <= 0)
        return;
    auto read = readState({static_cast<const char*>(data), static_cast<std::size_t>(size)});
    if (!read)
    {
        say("The session's settings were not used: " + juce::String(read.error().text()));
        return;
    }
    PluginState& state = read->state;
    juce::String noted = read->note;
    {
        const juce::ScopedLock lock(setupLock);
        const std::size_t slot = state.values.index(ParameterId::profile);
        if (state.profile && slot != ownProfileSlot && state.profile != builtInProfile(slot))
        {
            // A session keeps the actuator that it was made with.
            state.values.set(ParameterId::profile, static_cast<double>(ownProfileSlot));
            noted += (noted.isEmpty() ? "" : "; ") + juce::String("the session's own version of the actuator is used");
        }
        if (state.values.index(ParameterId::profile) == ownProfileSlot)
        {
            if (ownProfile != state.profile)
                appliedSlot = profileSlots; // not what is wanted, whatever it is
            ownProfile = state.profile;
        }
    }
    setValues(state.values); // the host may wait for another thread of ours here: no lock
    catchUp();
    program.store(juce::jlimit(0, getNumPrograms() - 1, state.program));
    if (state.windowWidth > 0 && state.windowHeight > 0)
        setWindowSize(state.windowWidth, state.windowHeight);
    if (const auto restored = clips.setText(state.clips); !restored)
        noted += (noted.isEmpty() ? "" : "; ") + juce::String("the session's clips cannot be read: ") +
                 juce::String(restored.error().text());
    say(noted);
    updateHostDisplay(ChangeDetails().withProgramChanged(true));
}

int PluginProcessor::getNumPrograms()
{
    return static_cast<int>(translatorPresets().size());
}

void PluginProcessor::setCurrentProgram(int index)
{
    if (index != program.load())
        applyProgram(index);
}

void PluginProcessor::applyProgram(int index)
{
    if (index < 0 || index >= getNumPrograms())
        return;
    program.store(index);
    ParameterValues wanted = values();
    wanted.setTranslator(translatorPresets()[static_cast<std::size_t>(index)].params);
    setValues(wanted);
}

const juce::String PluginProcessor::getProgramName(int index)
{
    if (index < 0 || index >= getNumPrograms())
        return {};
    const auto name = translatorPresets()[static_cast<std::size_t>(index)].name;
    return juce::String::fromUTF8(name.data(), static_cast<int>(name.size()));
}

void PluginProcessor::setWindowSize(int width, int height) noexcept
{
    windowWidth.store(width);
    windowHeight.store(height);
}

Capture PluginProcessor::capture(double seconds) const
{
    const juce::ScopedLock lock(setupLock);
    return engine.capture(seconds);
}

juce::String PluginProcessor::actuatorName() const
{
    const juce::ScopedLock lock(setupLock);
    return applied ? juce::String::fromUTF8(applied->name.c_str()) : juce::String("None");
}

bool PluginProcessor::strengthMatters() const
{
    const juce::ScopedLock lock(setupLock);
    return tradesNow;
}

Result<void> PluginProcessor::loadActuator(const juce::File& file)
{
    auto profile = readProfile(file.getFullPathName().toStdString());
    if (!profile)
        return profile.error();
    {
        const juce::ScopedLock lock(setupLock);
        ownProfile = std::move(profile).value();
        appliedSlot = profileSlots;
    }
    parameter(ParameterId::profile).setPlainNotifyingHost(static_cast<double>(ownProfileSlot));
    catchUp();
    return {};
}

juce::String PluginProcessor::note() const
{
    const juce::ScopedLock lock(setupLock);
    return lastNote;
}

void PluginProcessor::say(const juce::String& text)
{
    const juce::ScopedLock lock(setupLock);
    lastNote = text;
}

} // namespace pacini::plugin
