// The sound device of the editor, which goes away and comes back, without any real one.

#include "app/editor/PreviewDevices.h"

#include "app/editor/MeasureDevice.h"
#include "editor/Bench.h"
#include "editor/DeviceSettings.h"
#include "editor/Pump.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// What all devices of a test share: whether the interface is plugged in, and what it last put out.
struct Plug
{
    bool in = true;
    int channels = 4;
    bool dead = false; ///< pulled: it still says that it plays, and calls nobody
    std::vector<float> peaks = std::vector<float>(8, 0.0f);
    int opened = 0;
    int blocks = 0; ///< that were played
};

class FakeDevice final : public juce::AudioIODevice, private juce::Timer
{
public:
    explicit FakeDevice(Plug& shared) : AudioIODevice("Interface", "Fake"), plug(shared) { ++plug.opened; }
    ~FakeDevice() override { close(); }

    juce::StringArray getOutputChannelNames() override
    {
        juce::StringArray names;
        for (int c = 0; c < plug.channels; ++c)
            names.add("Out " + juce::String(c + 1));
        return names;
    }
    juce::StringArray getInputChannelNames() override { return {"In 1"}; }
    juce::Array<double> getAvailableSampleRates() override { return {48000.0}; }
    juce::Array<int> getAvailableBufferSizes() override { return {480}; }
    int getDefaultBufferSize() override { return 480; }
    juce::String open(const juce::BigInteger&, const juce::BigInteger& outputs, double, int) override
    {
        active = outputs;
        active.setRange(plug.channels, 256, false);
        isOn = plug.in;
        return plug.in ? "" : "is not there";
    }
    void close() override
    {
        stop();
        isOn = false;
    }
    bool isOpen() override { return isOn; }
    void start(juce::AudioIODeviceCallback* wanted) override
    {
        callback = wanted;
        callback->audioDeviceAboutToStart(this);
        startTimer(10);
    }
    void stop() override
    {
        stopTimer();
        if (auto* before = std::exchange(callback, nullptr))
            before->audioDeviceStopped();
    }
    bool isPlaying() override { return callback != nullptr; }
    juce::String getLastError() override { return {}; }
    int getCurrentBufferSizeSamples() override { return 480; }
    double getCurrentSampleRate() override { return 48000.0; }
    int getCurrentBitDepth() override { return 24; }
    juce::BigInteger getActiveOutputChannels() const override { return active; }
    juce::BigInteger getActiveInputChannels() const override { return {}; }
    int getOutputLatencyInSamples() override { return 0; }
    int getInputLatencyInSamples() override { return 0; }

private:
    void timerCallback() override
    {
        if (plug.dead || callback == nullptr)
            return;
        const int count = active.countNumberOfSetBits();
        juce::AudioBuffer<float> block(std::max(count, 1), 480);
        block.clear();
        callback->audioDeviceIOCallbackWithContext(nullptr, 0, block.getArrayOfWritePointers(), count, 480, {});
        ++plug.blocks;
        for (int place = 0, channel = 0; channel < plug.channels; ++channel)
            if (active[channel])
                plug.peaks[static_cast<std::size_t>(channel)] =
                    std::max(plug.peaks[static_cast<std::size_t>(channel)], block.getMagnitude(place++, 0, 480));
    }

    Plug& plug;
    juce::AudioIODeviceCallback* callback = nullptr;
    juce::BigInteger active;
    bool isOn = false;
};

class FakeType final : public juce::AudioIODeviceType
{
public:
    explicit FakeType(Plug& shared) : AudioIODeviceType("Fake"), plug(shared) {}
    void scanForDevices() override { found = plug.in; }
    juce::StringArray getDeviceNames(bool) const override
    {
        return found ? juce::StringArray("Interface") : juce::StringArray();
    }
    int getDefaultDeviceIndex(bool) const override { return 0; }
    int getIndexOfDevice(juce::AudioIODevice* device, bool) const override { return device != nullptr ? 0 : -1; }
    bool hasSeparateInputsAndOutputs() const override { return true; }
    juce::AudioIODevice* createDevice(const juce::String& output, const juce::String& input) override
    {
        return output.isEmpty() && input.isEmpty() ? nullptr : new FakeDevice(plug);
    }

private:
    Plug& plug;
    bool found = false;
};

/// A kind of device of which there is none.
class EmptyType final : public juce::AudioIODeviceType
{
public:
    EmptyType() : AudioIODeviceType("Empty") {}
    void scanForDevices() override {}
    juce::StringArray getDeviceNames(bool) const override { return {}; }
    int getDefaultDeviceIndex(bool) const override { return 0; }
    int getIndexOfDevice(juce::AudioIODevice*, bool) const override { return -1; }
    bool hasSeparateInputsAndOutputs() const override { return true; }
    juce::AudioIODevice* createDevice(const juce::String&, const juce::String&) override { return nullptr; }
};

struct DeviceBench : EditorBench
{
    Plug plug;
    std::unique_ptr<app::PreviewDevices> rig;
    int lost = 0, found = 0;

    explicit DeviceBench(bool pluggedIn = true) : EditorBench({shipped("lra-175")})
    {
        plug.in = pluggedIn;
        rig = std::make_unique<app::PreviewDevices>(session.player, session.outputs);
        rig->devices().addAudioDeviceType(std::make_unique<FakeType>(plug));
        rig->onLost = [this]
        {
            ++lost;
            session.transport.stop();
        };
        rig->onFound = [this]
        {
            ++found;
        };
        (void)rig->open(nullptr, {});
        openDemo("drums_tabla_pattern");
    }
    ~DeviceBench() { rig.reset(); }

    /// Plays for a while: what came out of each channel.
    std::vector<float> played()
    {
        std::fill(plug.peaks.begin(), plug.peaks.end(), 0.0f);
        session.transport.setPlayhead(0.0);
        session.transport.play();
        (void)pumpUntil([&] { return plug.peaks[2] > 0.01f; }, 5.0);
        pumpFor(0.3);
        session.transport.stop();
        pumpFor(0.1);
        return plug.peaks;
    }
};
} // namespace

TEST_CASE("Play stops when the device goes away, and plays again by itself once it is back", "[devices]")
{
    DeviceBench bench;
    REQUIRE(pumpUntil([&] { return bench.session.outputs.hasDevice(); }));
    auto& transport = bench.session.transport;
    transport.play();
    REQUIRE(pumpUntil([&] { return transport.playhead() > 0.05; }));
    const int opened = bench.plug.opened;
    // Pulled out while it plays: nobody says so.
    bench.plug.dead = true;
    bench.plug.in = false;
    REQUIRE(pumpUntil([&] { return bench.lost == 1; }, 10.0));
    CHECK_FALSE(transport.isPlaying());
    CHECK_FALSE(bench.session.outputs.hasDevice());
    CHECK(bench.view.statusBar().playsOn() == "No audio device: nothing plays");
    transport.play();
    CHECK_FALSE(transport.isPlaying());
    bench.view.showSheet(nullptr);
    CHECK_FALSE(bench.rig->reconnect());
    // And back again: it is there without a word.
    bench.plug.dead = false;
    bench.plug.in = true;
    REQUIRE(pumpUntil([&] { return bench.found >= 1 && bench.session.outputs.hasDevice(); }, 15.0));
    CHECK(bench.plug.opened > opened);
    CHECK(bench.played()[2] > 0.01f);
}

TEST_CASE("A device that comes after the start is used, and Reconnect need not wait for it", "[devices]")
{
    DeviceBench bench(false);
    pumpFor(0.3);
    CHECK_FALSE(bench.session.outputs.hasDevice());
    CHECK(bench.lost == 0);
    bench.plug.in = true;
    CHECK(bench.rig->reconnect());
    CHECK(bench.session.outputs.hasDevice());
    CHECK(bench.played()[2] > 0.01f);
}

TEST_CASE("Who has chosen no device is left without one until Reconnect", "[devices]")
{
    DeviceBench bench;
    REQUIRE(pumpUntil([&] { return bench.session.outputs.hasDevice(); }));
    auto none = bench.rig->devices().getAudioDeviceSetup();
    none.outputDeviceName = none.inputDeviceName = {};
    (void)bench.rig->devices().setAudioDeviceSetup(none, true);
    REQUIRE(pumpUntil([&] { return !bench.session.outputs.hasDevice(); }, 5.0));
    CHECK_FALSE(bench.rig->isLookingForDevice());
    const int opened = bench.plug.opened;
    pumpFor(2.5);
    CHECK(bench.plug.opened == opened);
    CHECK(bench.rig->reconnect());
}

TEST_CASE("A kind of device that has none stays chosen, and no device is called lost", "[devices]")
{
    DeviceBench bench;
    REQUIRE(pumpUntil([&] { return bench.session.outputs.hasDevice(); }));
    auto& manager = bench.rig->devices();
    manager.addAudioDeviceType(std::make_unique<EmptyType>());
    manager.setCurrentAudioDeviceType("Empty", true);
    REQUIRE(pumpUntil([&] { return !bench.session.outputs.hasDevice(); }, 5.0));
    CHECK_FALSE(bench.rig->isLookingForDevice()); // so nothing is said of a device that is gone
    pumpFor(2.5);
    CHECK(manager.getCurrentAudioDeviceType() == "Empty");
    manager.setCurrentAudioDeviceType("Fake", true);
    CHECK(pumpUntil([&] { return bench.session.outputs.hasDevice(); }, 5.0));
}

TEST_CASE("Each haptic output plays on the channel that is shown, a third one on an interface of four, too",
          "[devices]")
{
    DeviceBench bench;
    REQUIRE(pumpUntil([&] { return bench.session.outputs.hasDevice(); }));
    auto& outputs = bench.session.outputs;
    bench.session.transport.setHeard(editor::Heard::haptic);
    outputs.add();
    outputs.add();
    CHECK(outputs.channelOf(2) == -1); // taken: the sound and two outputs have all four
    auto peaks = bench.played();
    CHECK(peaks[2] > 0.01f);
    CHECK(peaks[3] > 0.01f);
    CHECK(peaks[0] == 0.0f);
    auto list = outputs.outputs();
    list[2].channel = 0;
    outputs.setOutputs(list);
    CHECK(outputs.channelOf(2) == 0);
    peaks = bench.played();
    CHECK(peaks[0] > 0.01f);
    CHECK(peaks[1] == 0.0f);
    // Without its second channel the others play where they did.
    auto setup = bench.rig->devices().getAudioDeviceSetup();
    setup.useDefaultOutputChannels = false;
    setup.outputChannels.setRange(0, 256, false);
    for (const int channel : {0, 2, 3})
        setup.outputChannels.setBit(channel);
    REQUIRE(bench.rig->devices().setAudioDeviceSetup(setup, true).isEmpty());
    REQUIRE(pumpUntil([&] { return outputs.hasDevice() && outputs.channelOf(0) == 2; }));
    list[0].gain = editor::HapticOutputs::leastGain;
    outputs.setOutputs(list);
    const int blocks = bench.plug.blocks;
    REQUIRE(pumpUntil([&] { return bench.plug.blocks > blocks + 5; }, 5.0)); // the gain fades over a block
    std::fill(bench.plug.peaks.begin(), bench.plug.peaks.end(), 0.0f);
    bench.session.transport.setPlayhead(0.0);
    bench.session.transport.play();
    CHECK(pumpUntil([&] { return bench.plug.peaks[3] > 0.01f; }, 5.0));
    CHECK(bench.plug.peaks[2] < 0.002f);
    CHECK(bench.plug.peaks[1] == 0.0f);
    bench.session.transport.stop();
}

TEST_CASE("The sweep of a measurement goes to the first haptic output, not to the sound", "[devices][measure]")
{
    DeviceBench bench;
    REQUIRE(pumpUntil([&] { return bench.session.outputs.hasDevice(); }));
    app::MeasureDevice rig(bench.rig->devices(), &bench.session.outputs);
    CHECK(rig.ports().expectedOutput == 2);
    auto list = bench.session.outputs.outputs();
    list[0].channel = 3;
    bench.session.outputs.setOutputs(list);
    CHECK(rig.ports().expectedOutput == 3);
}

TEST_CASE("The audio device is chosen by boxes and ticks of our own, and a channel goes by the space bar", "[devices]")
{
    DeviceBench bench;
    REQUIRE(pumpUntil([&] { return bench.session.outputs.hasDevice(); }));
    auto& devices = bench.rig->devices();
    editor::DeviceSettings settings(devices);
    settings.setSize(640, 400);
    CHECK(get<juce::ComboBox>(settings, "Output device").getText() == "Interface");
    CHECK(get<juce::ComboBox>(settings, "Sample rate").getText() == "48000 Hz");
    CHECK(get<juce::ComboBox>(settings, "Buffer").getText() == "480 samples (10.0 ms)");
    auto& channels = get<editor::ChannelList>(settings, "Output channels");
    REQUIRE(channels.getNumRows() == 4);
    CHECK(channels.getNameForRow(2) == "3  Out 3");
    REQUIRE(devices.getCurrentAudioDevice()->getActiveOutputChannels()[3]);
    get<juce::ListBox>(channels, "Output channels").selectRow(3);
    CHECK(static_cast<juce::Component&>(channels).keyPressed(juce::KeyPress(juce::KeyPress::spaceKey)));
    REQUIRE(devices.getCurrentAudioDevice() != nullptr);
    CHECK_FALSE(devices.getCurrentAudioDevice()->getActiveOutputChannels()[3]);
    CHECK(devices.getCurrentAudioDevice()->getActiveOutputChannels()[2]);
    for (juce::Component* one : settings.getChildren())
    {
        CAPTURE(one->getTitle());
        CHECK(settings.getLocalBounds().contains(one->getBounds()));
        if (dynamic_cast<juce::ComboBox*>(one) != nullptr)
            CHECK(one->getWidth() <= editor::space::widestBox);
        for (juce::Component* other : settings.getChildren())
            if (other != one && one->getWidth() > 0)
                CHECK_FALSE(one->getBounds().intersects(other->getBounds()));
    }
    get<juce::ComboBox>(settings, "Output device").setSelectedId(1, juce::sendNotificationSync); // none
    CHECK(devices.getAudioDeviceSetup().outputDeviceName.isEmpty());
}
