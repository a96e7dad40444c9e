// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Audio processor of the plugin, without its window.

#include "document/HostedProject.h"
#include "plugin/engine/EditHistory.h"
#include "plugin/engine/LiveEngine.h"
#include "plugin/engine/PadOutput.h"
#include "plugin/engine/PluginState.h"
#include "plugin/engine/SetupWorker.h"
#include "plugin/engine/TableParameter.h"

#include <juce_audio_processors/juce_audio_processors.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace pacini::plugin
{

/// Main input and output of 1 to 16 channels; a sidechain of up to 8 and a haptic output of 1 to 8 channels, one for
/// each actuator; both are optional. The main output is the main input, delayed by the reported latency, unless the
/// output mode is different.
class PluginProcessor : public juce::AudioProcessor, private SetupWorker::Client
{
public:
    PluginProcessor();
    ~PluginProcessor() override;

    // Sound
    void prepareToPlay(double sampleRate, int maximumBlock) override;
    void releaseResources() override {}
    void reset() override;
    void processBlock(juce::AudioBuffer<float>& buffer, juce::MidiBuffer& midi) override;
    void processBlockBypassed(juce::AudioBuffer<float>& buffer, juce::MidiBuffer& midi) override;
    using AudioProcessor::processBlock;
    using AudioProcessor::processBlockBypassed;
    bool isBusesLayoutSupported(const BusesLayout& layout) const override;
    double getTailLengthSeconds() const override { return 1.0; }

    // Settings
    [[nodiscard]] TableParameter& parameter(ParameterId wanted) const noexcept
    {
        return *table[static_cast<std::size_t>(wanted)];
    }
    [[nodiscard]] ParameterValues values() const noexcept;
    /// The values with their modulation.
    [[nodiscard]] ParameterValues heardValues() const noexcept;
    /// None in LV2, whose wrapper would overwrite it with the host's switch in every block: there it is a second
    /// switch.
    juce::AudioProcessorParameter* getBypassParameter() const override
    {
        return wrapperType == wrapperType_LV2 ? nullptr : &parameter(ParameterId::bypass);
    }
    /// Whether the host bypasses the plugin with its own switch. [any]
    [[nodiscard]] bool isBypassedByHost() const noexcept { return bypassedByHost.load(std::memory_order_relaxed); }
    void getStateInformation(juce::MemoryBlock& block) override;
    void setStateInformation(const void* data, int size) override;
    /// The same; whether the text is a state that can be used. If not, the settings stay, and note() says why.
    bool restoreState(std::string_view text);
    int getNumPrograms() override;
    int getCurrentProgram() override { return program.load(); }
    void setCurrentProgram(int index) override;
    const juce::String getProgramName(int index) override;
    void changeProgramName(int, const juce::String&) override {}
    /// The translator's presets; routing, actuator and bypass stay. Sets the values even of the current one. [message]
    void applyProgram(int index);

    // What the user does in the window: each is a step that can be undone. [message]
    /// A shipped preset, as applyProgram().
    void chooseProgram(int index);
    /// A preset of the user.
    void choosePreset(const UserPreset& preset);
    /// Records that the present values were saved as a preset of this name.
    void noteSavedPreset(const std::string& name);
    [[nodiscard]] PresetChoice presetChoice() const;
    [[nodiscard]] bool canUndo() const;
    [[nodiscard]] bool canRedo() const;
    void undo();
    void redo();
    /// The sides A and B: each has all settings but bypass, and its own steps.
    [[nodiscard]] Side side() const;
    void chooseSide(Side wanted);
    /// Copies the settings in use to the other side, as a step there.
    void copyToOtherSide();

    // Window
    juce::AudioProcessorEditor* createEditor() override { return nullptr; }
    bool hasEditor() const override { return false; }
    /// Whether captured clips keep their sound, in the session. [any]
    [[nodiscard]] bool keepsCaptures() const noexcept { return keepsSounds.load(); }
    void setKeepsCaptures(bool wanted) noexcept { keepsSounds.store(wanted); }
    /// The window size stored in the session; 0 if there is none.
    [[nodiscard]] juce::Point<int> windowSize() const noexcept { return {windowWidth.load(), windowHeight.load()}; }
    void setWindowSize(int width, int height) noexcept;

    /// The clips that are edited in the window.
    [[nodiscard]] HostedProject& project() noexcept { return clips; }

    /// The controller that plays the drive of the first haptic channel, except when the host renders offline.
    [[nodiscard]] PadOutput& pad() noexcept { return padOutput; }
    [[nodiscard]] const PadOutput& pad() const noexcept { return padOutput; }

    // What the window shows. [message], answered without waiting for the audio thread
    [[nodiscard]] TranslatorMeterReading readMeters() const { return engine.readMeters(); }
    /// The largest sample of the source since the last call, linear.
    [[nodiscard]] float takeInputPeak() { return engine.takeInputPeak(); }
    [[nodiscard]] double sampleRate() const { return engine.sampleRate(); }
    /// Delay of the haptic signal against the sound, frames.
    [[nodiscard]] int latency() const { return getLatencySamples(); }
    /// The newest of the source, mono, all finite; at most `captureSeconds`.
    [[nodiscard]] Capture capture(double seconds) const;
    /// Sets the haptic channels that are connected to an output of a device, one bit each. [any]
    void setConnected(unsigned haptics) noexcept { engine.setConnected(haptics); }
    /// The largest sample of a haptic channel that went out since the last call, linear.
    [[nodiscard]] float takePeak(std::size_t channel) { return engine.takePeak(channel); }
    /// Gain reduction by the limiter and protection of a channel's actuator, dB.
    [[nodiscard]] double gainReduction(std::size_t channel) const;
    /// Haptic channels that are played.
    [[nodiscard]] std::size_t channelsInUse() const { return engine.channelsInUse(); }
    /// Recent processor load of this instance: processing time as a share of the duration of its blocks; 1 is a whole
    /// core.
    [[nodiscard]] double load() const noexcept { return meanLoad.load(std::memory_order_relaxed); }
    /// Sets whether the engine may rest in silence (default: yes). [message], while no block is processed
    void setRests(bool wanted) noexcept { engine.setRests(wanted); }
    /// Whether the engine rests. On the thread of processBlock().
    [[nodiscard]] bool resting() const noexcept { return engine.resting(); }
    /// The name of the present actuator of a haptic channel.
    [[nodiscard]] juce::String actuatorName(std::size_t channel = 0) const;
    /// Whether the strength affects any of them.
    [[nodiscard]] bool strengthMatters() const;
    /// Takes the actuator of a haptic channel from a profile file.
    Result<void> loadActuator(const juce::File& file, std::size_t channel = 0);
    /// The unusable parts of the session's state; empty: none.
    [[nodiscard]] juce::String note() const;

    const juce::String getName() const override { return "Pacini"; }
    bool acceptsMidi() const override { return false; }
    bool producesMidi() const override { return false; }

private:
    void process(juce::AudioBuffer<float>& buffer, bool bypassed) noexcept;
    void noteLoad(double worked, double available) noexcept;
    void catchUp() override;
    void setValues(const ParameterValues& wanted);
    void setAsGestures(const ParameterValues& wanted);
    void edit(const ParameterValues& wanted, const PresetChoice& preset);
    void replay(const EditStep& step, bool forwards);
    void setPreset(const PresetChoice& wanted);
    [[nodiscard]] PluginSettings settingsNow();
    [[nodiscard]] juce::String restoreActuators(PluginSettings& settings);
    void addStep(EditStep step);
    void say(const juce::String& text);
    /// The actuator of a haptic channel.
    struct ChannelActuator
    {
        std::size_t slot = 0;           ///< of the profile; of the first channel's for one that follows it
        std::size_t plays = 0;          ///< the channel whose translation it plays
        std::optional<Profile> profile; ///< in that slot
        std::optional<Profile> own;     ///< from a file or a session
        bool stale = false;             ///< `own` is another one now
        bool trades = false;            ///< see tradesStrength()
    };

    [[nodiscard]] bool followsFirst(std::size_t channel) const noexcept;
    [[nodiscard]] std::size_t wantedSlot(std::size_t channel) const noexcept;
    void adoptActuator(std::size_t channel, bool strengthMoved);
    std::optional<juce::String> restoreActuator(ParameterValues& values, std::size_t channel,
                                                const std::optional<Profile>& profile);

    std::array<TableParameter*, parameterCount> table{}; // the base owns them
    HostedProject clips;
    LiveEngine engine;
    PadOutput padOutput;

    /// Guards the members below, and the preparation of the engine. Never taken by the audio thread, except when the
    /// host renders offline.
    mutable juce::CriticalSection setupLock;
    std::array<ChannelActuator, maxHapticChannels> actuators;
    double appliedStrength = 0.0;
    juce::String lastNote;
    Side sideNow = Side::a;
    std::optional<PluginSettings> otherSide; ///< none: the side was never used
    std::string userPreset;                  ///< see PresetChoice; that counts while `isUserPreset`
    std::array<StepList, 2> edits;           ///< of the sides

    std::atomic<int> program{0};
    std::atomic<bool> isUserPreset{false};
    std::atomic<int> windowWidth{0}, windowHeight{0};
    std::atomic<bool> keepsSounds{true};
    std::atomic<bool> bypassedByHost{false};
    std::atomic<double> meanLoad{0.0};
    std::unique_ptr<EditHistory> history;
    juce::SharedResourcePointer<SetupWorker> worker;

    JUCE_DECLARE_NON_COPYABLE_WITH_LEAK_DETECTOR(PluginProcessor)
};

} // namespace pacini::plugin
