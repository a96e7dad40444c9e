// The bar of the standalone program, without a device and with one.

#include "app/RoutingBar.h"

#include "editor/Translation.h"
#include "plugin/engine/PluginProcessor.h"
#include "support/Catch.h"

#include <array>
#include <memory>

using namespace pacini;

namespace
{
/// A device that is there and plays nothing.
class SilentDevice final : public juce::AudioIODevice
{
public:
    SilentDevice() : AudioIODevice("silent", "test") {}

    juce::StringArray getOutputChannelNames() override { return {"1", "2", "3", "4"}; }
    juce::StringArray getInputChannelNames() override { return {"1", "2"}; }
    juce::Array<double> getAvailableSampleRates() override { return {48000.0}; }
    juce::Array<int> getAvailableBufferSizes() override { return {256}; }
    int getDefaultBufferSize() override { return 256; }
    juce::String open(const juce::BigInteger&, const juce::BigInteger&, double, int) override
    {
        opened = true;
        return {};
    }
    void close() override { opened = false; }
    bool isOpen() override { return opened; }
    void start(juce::AudioIODeviceCallback* callback) override
    {
        playing = callback;
        if (playing != nullptr)
            playing->audioDeviceAboutToStart(this);
    }
    void stop() override
    {
        if (playing != nullptr)
            playing->audioDeviceStopped();
        playing = nullptr;
    }
    bool isPlaying() override { return playing != nullptr; }
    juce::String getLastError() override { return {}; }
    int getCurrentBufferSizeSamples() override { return 256; }
    double getCurrentSampleRate() override { return 48000.0; }
    int getCurrentBitDepth() override { return 24; }
    juce::BigInteger getActiveOutputChannels() const override { return channels(4); }
    juce::BigInteger getActiveInputChannels() const override { return channels(2); }
    int getOutputLatencyInSamples() override { return 0; }
    int getInputLatencyInSamples() override { return 0; }

private:
    static juce::BigInteger channels(int count)
    {
        juce::BigInteger bits;
        bits.setRange(0, count, true);
        return bits;
    }

    juce::AudioIODeviceCallback* playing = nullptr;
    bool opened = false;
};

/// The kind of device of a machine that has none until one is plugged in.
class OneDevice final : public juce::AudioIODeviceType
{
public:
    OneDevice() : AudioIODeviceType("test") {}
    bool isThere = false;

    void scanForDevices() override {}
    juce::StringArray getDeviceNames(bool) const override
    {
        return isThere ? juce::StringArray("silent") : juce::StringArray();
    }
    int getDefaultDeviceIndex(bool) const override { return 0; }
    int getIndexOfDevice(juce::AudioIODevice* device, bool) const override { return device != nullptr ? 0 : -1; }
    bool hasSeparateInputsAndOutputs() const override { return false; }
    juce::AudioIODevice* createDevice(const juce::String&, const juce::String&) override
    {
        return isThere ? std::make_unique<SilentDevice>().release() : nullptr;
    }
};

const juce::Label* noticeOf(juce::Component& bar)
{
    for (auto* child : bar.getChildren())
        if (auto* label = dynamic_cast<juce::Label*>(child);
            label != nullptr && label->getText().contains("nothing is heard or felt"))
            return label;
    return nullptr;
}

int visibleMenus(juce::Component& bar)
{
    int count = 0;
    for (auto* child : bar.getChildren())
        count += dynamic_cast<juce::ComboBox*>(child) != nullptr && child->isVisible() ? 1 : 0;
    return count;
}
} // namespace

TEST_CASE("Without an audio device the standalone program says so and what to do, and no longer once there is one")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    plugin::PluginProcessor processor;
    app::AudioDevices rig(processor);
    auto type = std::make_unique<OneDevice>();
    OneDevice& kind = *type;
    rig.devices().addAudioDeviceType(std::move(type));
    (void)rig.open(nullptr, {});
    REQUIRE(rig.devices().getCurrentAudioDevice() == nullptr);
    {
        app::RoutingBar bar(rig);
        bar.setSize(960, 44);
        const auto* notice = noticeOf(bar);
        REQUIRE(notice != nullptr);
        CHECK(notice->isVisible());
        CHECK(notice->getFont().getStringWidth(notice->getText()) <= notice->getWidth());
        CHECK(notice->getText().contains("Devices"));
        CHECK(visibleMenus(bar) == 0);

        kind.isThere = true;
        CHECK(rig.devices().initialiseWithDefaultDevices(2, 4).isEmpty());
        REQUIRE(rig.devices().getCurrentAudioDevice() != nullptr);
        rig.devices().dispatchPendingMessages();
        CHECK_FALSE(notice->isVisible());
        CHECK(visibleMenus(bar) == 4);

        rig.devices().closeAudioDevice(); // unplugged
        rig.devices().sendSynchronousChangeMessage();
        CHECK(notice->isVisible());
    }
}
