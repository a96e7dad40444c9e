// SPDX-License-Identifier: GPL-3.0-or-later
#include "plugin/engine/PluginProcessor.h"

#include "io/ProfileFile.h"
#include "io/ShippedProfiles.h"

#include <pacini/actuator/ActuatorFit.h>
#include <pacini/realtime/TranslatorPresets.h>

#include <algorithm>
#include <chrono>
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

TranslatorSetup setupOf(const std::optional<Profile>& profile, double strength)
{
    TranslatorSetup setup;
    setup.profile = profile;
    setup.strength = strength;
    return setup;
}
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
    history = std::make_unique<EditHistory>(
        std::vector<juce::AudioProcessorParameter*>(table.begin(), table.end()), [this] { return values(); },
        [this](EditStep step)
        {
            step.presetBefore = step.presetAfter = presetChoice();
            addStep(std::move(step));
        });
    for (ChannelActuator& actuator : actuators)
        actuator.profile = builtInProfile(0);
    appliedStrength = parameter(ParameterId::strength).value();
    engine.setSetup(0, setupOf(actuators[0].profile, appliedStrength));
    engine.setClips(&clips);
    setLatencySamples(static_cast<int>(engine.latencyFrames())); // some hosts ask before they tell their rate
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
        engine.prepare(newRate, static_cast<std::size_t>(std::max(getMainBusNumInputChannels(), 1)),
                       static_cast<std::size_t>(std::max(getChannelCountOfBus(false, hapticBus), 1)));
    }
    clips.prepare(newRate);
    padOutput.prepare(newRate);
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
    const auto begin = std::chrono::steady_clock::now();
    bypassedByHost.store(bypassed, std::memory_order_relaxed);
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
                    std::span<float* const>(haptic).first(haptics), static_cast<std::size_t>(buffer.getNumSamples()),
                    isNonRealtime() ? nullptr : padOutput.drive()},
                   heardValues(), bypassed);
    const std::chrono::duration<double> worked = std::chrono::steady_clock::now() - begin;
    noteLoad(worked.count(), static_cast<double>(buffer.getNumSamples()) / engine.sampleRate());
}

/// The mean of about the last second.
void PluginProcessor::noteLoad(double worked, double available) noexcept
{
    if (!(available > 0.0))
        return;
    const double share = std::min(available, 1.0);
    const double before = meanLoad.load(std::memory_order_relaxed);
    meanLoad.store(before + share * (worked / available - before), std::memory_order_relaxed);
}

ParameterValues PluginProcessor::values() const noexcept
{
    ParameterValues result;
    for (const TableParameter* each : table)
        result.set(each->row().parameter, each->value());
    return result;
}

ParameterValues PluginProcessor::heardValues() const noexcept
{
    ParameterValues result;
    for (const TableParameter* each : table)
        result.set(each->row().parameter, each->heard());
    return result;
}

void PluginProcessor::setValues(const ParameterValues& wanted)
{
    for (TableParameter* each : table)
        each->setPlainNotifyingHost(wanted[each->row().parameter]);
}

bool PluginProcessor::followsFirst(std::size_t channel) const noexcept
{
    return channel > 0 && parameter(channelParameter(channel, ChannelSetting::actuator)).value() < 0.5;
}

std::size_t PluginProcessor::wantedSlot(std::size_t channel) const noexcept
{
    const double first = parameter(ParameterId::profile).value();
    if (channel == 0 || followsFirst(channel))
        return static_cast<std::size_t>(first + 0.5);
    return static_cast<std::size_t>(parameter(channelParameter(channel, ChannelSetting::actuator)).value() - 0.5);
}

/// Hands the chosen actuators and the strength to the translators. [worker], [message]
void PluginProcessor::catchUp()
{
    const juce::ScopedLock lock(setupLock);
    const double strength = parameter(ParameterId::strength).value();
    const bool strengthMoved = strength != appliedStrength;
    appliedStrength = strength;
    for (std::size_t c = 0; c < actuators.size(); ++c)
        adoptActuator(c, strengthMoved);
}

/// Those of the channels before it are adopted already.
void PluginProcessor::adoptActuator(std::size_t channel, bool strengthMoved)
{
    ChannelActuator& actuator = actuators[channel];
    const std::size_t slot = wantedSlot(channel);
    std::size_t plays = followsFirst(channel) ? 0 : channel;
    for (std::size_t c = 0; c < channel && plays == channel && slot != ownProfileSlot; ++c)
        if (actuators[c].slot == slot && actuators[c].plays == c)
            plays = c;
    if (plays != channel)
    {
        actuator.slot = slot;
        actuator.profile = actuators[plays].profile;
        actuator.trades = actuators[plays].trades;
        if (actuator.plays != plays)
            engine.share(channel, plays);
        actuator.plays = plays;
        return;
    }
    const bool sameActuator = slot == actuator.slot && actuator.plays == channel && !actuator.stale;
    if (sameActuator && !(strengthMoved && actuator.trades))
        return; // each new set-up fades out and in
    if (!sameActuator)
    {
        actuator.slot = slot;
        actuator.plays = channel;
        actuator.stale = false;
        actuator.profile = slot == ownProfileSlot ? actuator.own : builtInProfile(slot);
        actuator.trades = actuator.profile && tradesStrength(*actuator.profile);
    }
    engine.setSetup(channel, setupOf(actuator.profile, appliedStrength));
}

PluginSettings PluginProcessor::settingsNow()
{
    PluginSettings settings;
    {
        const juce::ScopedLock lock(setupLock);
        catchUp();
        settings.profile = actuators[0].profile;
        for (std::size_t c = 1; c < actuators.size(); ++c)
            if (!followsFirst(c))
                settings.furtherProfiles[c - 1] = actuators[c].profile;
    }
    settings.values = values();
    settings.preset = presetChoice();
    return settings;
}

void PluginProcessor::getStateInformation(juce::MemoryBlock& block)
{
    PluginState state;
    static_cast<PluginSettings&>(state) = settingsNow();
    {
        const juce::ScopedLock lock(setupLock);
        state.side = sideNow;
        state.other = otherSide;
    }
    state.clips = clips.text();
    state.windowWidth = windowWidth.load();
    state.windowHeight = windowHeight.load();
    state.keepsCaptures = keepsCaptures();
    state.controller = padOutput.status().name;
    const std::string text = stateText(state);
    block.replaceAll(text.data(), text.size());
}

void PluginProcessor::setStateInformation(const void* data, int size)
{
    if (data != nullptr && size > 0)
        restoreState({static_cast<const char*>(data), static_cast<std::size_t>(size)});
}

bool PluginProcessor::restoreState(std::string_view text)
{
    auto read = readState(text);
    if (!read)
    {
        say("Session settings not used: " + juce::String(read.error().text()));
        return false;
    }
    PluginState& state = read->state;
    juce::String noted = read->note;
    if (const auto note = restoreActuators(state); note.isNotEmpty())
        noted += (noted.isEmpty() ? "" : "; ") + note;
    setValues(state.values); // the host may wait for another thread of ours here: no lock
    catchUp();
    {
        const juce::ScopedLock lock(setupLock);
        sideNow = state.side;
        otherSide = state.other;
        for (StepList& list : edits)
            list.clear();
    }
    setPreset(state.preset);
    setKeepsCaptures(state.keepsCaptures);
    padOutput.choose(state.controller);
    if (state.windowWidth > 0 && state.windowHeight > 0)
        setWindowSize(state.windowWidth, state.windowHeight);
    if (const auto restored = clips.setText(state.clips); !restored)
        noted += (noted.isEmpty() ? "" : "; ") + juce::String("cannot read the session's clips: ") +
                 juce::String(restored.error().text());
    say(noted);
    updateHostDisplay(ChangeDetails().withProgramChanged(true));
    return true;
}

/// For values that are to be set; what is to be said of it.
juce::String PluginProcessor::restoreActuators(PluginSettings& settings)
{
    juce::String noted;
    const juce::ScopedLock lock(setupLock);
    for (std::size_t c = 0; c < actuators.size(); ++c)
        if (const auto note =
                restoreActuator(settings.values, c, c == 0 ? settings.profile : settings.furtherProfiles[c - 1]))
            noted += (noted.isEmpty() ? "" : "; ") + *note;
    return noted;
}

/// A session keeps the actuator that it was made with; says so where that is not the one that is built in.
std::optional<juce::String> PluginProcessor::restoreActuator(ParameterValues& values, std::size_t channel,
                                                             const std::optional<Profile>& profile)
{
    const ParameterId id = channelParameter(channel, ChannelSetting::actuator);
    const std::size_t first = channel == 0 ? 0 : 1; // the number of slot 0
    std::optional<juce::String> note;
    if (values.index(id) < first)
        return note;
    const std::size_t slot = values.index(id) - first;
    if (profile && slot != ownProfileSlot && profile != builtInProfile(slot))
    {
        values.set(id, static_cast<double>(ownProfileSlot + first));
        note = channel == 0 ? juce::String("using the session's own version of the actuator")
                            : "using the session's own version of actuator " + juce::String(channel + 1);
    }
    if (values.index(id) == ownProfileSlot + first)
    {
        actuators[channel].stale = actuators[channel].own != profile;
        actuators[channel].own = profile;
    }
    return note;
}

int PluginProcessor::getNumPrograms()
{
    return static_cast<int>(translatorPresets().size());
}

void PluginProcessor::setCurrentProgram(int index)
{
    // Some hosts set the current one time and again; LV2 does so only when a preset is loaded.
    if (index != program.load() || wrapperType == wrapperType_LV2)
        applyProgram(index);
}

void PluginProcessor::applyProgram(int index)
{
    if (index < 0 || index >= getNumPrograms())
        return;
    program.store(index); // hosts may come here from any thread
    isUserPreset.store(false);
    ParameterValues wanted = values();
    wanted.setTranslator(translatorPresets()[static_cast<std::size_t>(index)].params);
    setValues(wanted);
}

// Edits.

/// As the user's own hand would: hosts record it.
void PluginProcessor::setAsGestures(const ParameterValues& wanted)
{
    const EditHistory::Pause pause(*history);
    for (TableParameter* each : table)
    {
        const double value = wanted[each->row().parameter];
        if (value == each->value())
            continue;
        each->beginChangeGesture();
        each->setPlainNotifyingHost(value);
        each->endChangeGesture();
    }
}

void PluginProcessor::edit(const ParameterValues& wanted, const PresetChoice& preset)
{
    EditStep step = EditHistory::stepBetween(values(), wanted);
    step.presetBefore = presetChoice();
    step.presetAfter = preset;
    setPreset(preset);
    setAsGestures(wanted);
    addStep(std::move(step));
    updateHostDisplay(ChangeDetails().withProgramChanged(true));
}

void PluginProcessor::chooseProgram(int index)
{
    if (index < 0 || index >= getNumPrograms())
        return;
    ParameterValues wanted = values();
    wanted.setTranslator(translatorPresets()[static_cast<std::size_t>(index)].params);
    edit(wanted, {index, {}});
}

void PluginProcessor::choosePreset(const UserPreset& preset)
{
    ParameterValues wanted = values();
    wanted.setTranslator(preset.params);
    edit(wanted, {program.load(), preset.name});
}

void PluginProcessor::noteSavedPreset(const std::string& name)
{
    edit(values(), {program.load(), name});
}

PresetChoice PluginProcessor::presetChoice() const
{
    const juce::ScopedLock lock(setupLock);
    return {program.load(), isUserPreset.load() ? userPreset : std::string()};
}

void PluginProcessor::setPreset(const PresetChoice& wanted)
{
    const juce::ScopedLock lock(setupLock);
    program.store(juce::jlimit(0, getNumPrograms() - 1, wanted.program));
    userPreset = wanted.user;
    isUserPreset.store(!userPreset.empty());
}

bool PluginProcessor::canUndo() const
{
    const juce::ScopedLock lock(setupLock);
    return edits[static_cast<std::size_t>(sideNow)].canUndo();
}

bool PluginProcessor::canRedo() const
{
    const juce::ScopedLock lock(setupLock);
    return edits[static_cast<std::size_t>(sideNow)].canRedo();
}

void PluginProcessor::addStep(EditStep step)
{
    const juce::ScopedLock lock(setupLock);
    edits[static_cast<std::size_t>(sideNow)].add(std::move(step));
}

void PluginProcessor::undo()
{
    EditStep step;
    {
        const juce::ScopedLock lock(setupLock);
        if (const EditStep* last = edits[static_cast<std::size_t>(sideNow)].undo())
            step = *last;
        else
            return;
    }
    replay(step, false);
}

void PluginProcessor::redo()
{
    EditStep step;
    {
        const juce::ScopedLock lock(setupLock);
        if (const EditStep* next = edits[static_cast<std::size_t>(sideNow)].redo())
            step = *next;
        else
            return;
    }
    replay(step, true);
}

void PluginProcessor::replay(const EditStep& step, bool forwards)
{
    ParameterValues wanted = values();
    for (const EditStep::Change& change : step.changes)
        wanted.set(change.parameter, forwards ? change.after : change.before);
    setPreset(forwards ? step.presetAfter : step.presetBefore);
    setAsGestures(wanted);
    catchUp();
    updateHostDisplay(ChangeDetails().withProgramChanged(true));
}

Side PluginProcessor::side() const
{
    const juce::ScopedLock lock(setupLock);
    return sideNow;
}

void PluginProcessor::chooseSide(Side wanted)
{
    if (wanted == side())
        return;
    const PluginSettings left = settingsNow();
    PluginSettings entered = left; // the first time
    {
        const juce::ScopedLock lock(setupLock);
        if (otherSide)
            entered = *otherSide;
        otherSide = left;
        sideNow = wanted;
    }
    entered.values.set(ParameterId::bypass, left.values[ParameterId::bypass]);
    say(restoreActuators(entered));
    setPreset(entered.preset);
    setAsGestures(entered.values);
    catchUp();
    updateHostDisplay(ChangeDetails().withProgramChanged(true));
}

void PluginProcessor::copyToOtherSide()
{
    const PluginSettings now = settingsNow();
    const juce::ScopedLock lock(setupLock);
    const PluginSettings before = otherSide.value_or(now);
    EditStep step = EditHistory::stepBetween(before.values, now.values);
    step.presetBefore = before.preset;
    step.presetAfter = now.preset;
    edits[static_cast<std::size_t>(otherOf(sideNow))].add(std::move(step));
    otherSide = now;
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

double PluginProcessor::gainReduction(std::size_t channel) const
{
    return engine.readMeters(channel).gainReduction;
}

juce::String PluginProcessor::actuatorName(std::size_t channel) const
{
    const juce::ScopedLock lock(setupLock);
    const auto& profile = actuators[channel].profile;
    return profile ? juce::String::fromUTF8(shortNameOf(*profile).c_str())
                   : juce::String(noActuator.data(), noActuator.size());
}

bool PluginProcessor::strengthMatters() const
{
    const juce::ScopedLock lock(setupLock);
    return std::any_of(actuators.begin(), actuators.end(), [](const ChannelActuator& each) { return each.trades; });
}

Result<void> PluginProcessor::loadActuator(const juce::File& file, std::size_t channel)
{
    auto profile = readProfile(file.getFullPathName().toStdString());
    if (!profile)
        return profile.error();
    {
        const juce::ScopedLock lock(setupLock);
        actuators[channel].own = std::move(profile).value();
        actuators[channel].stale = true;
    }
    parameter(channelParameter(channel, ChannelSetting::actuator))
        .setPlainNotifyingHost(static_cast<double>(ownProfileSlot + (channel == 0 ? 0 : 1)));
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
