// SPDX-License-Identifier: GPL-3.0-or-later

// The plugin as a program of its own.

#include "app/AudioDevices.h"
#include "app/Display.h"
#include "app/Settings.h"
#include "app/StandaloneWindow.h"
#include "editor/LanguageProblem.h"
#include "editor/Translation.h"
#include "io/SoundLibraryCall.h"

#include <juce_audio_utils/juce_audio_utils.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace pacini::app
{

class Application final : public juce::JUCEApplication, private juce::Timer
{
public:
    const juce::String getApplicationName() override { return "Pacini"; }
    const juce::String getApplicationVersion() override { return JucePlugin_VersionString; }
    bool moreThanOneInstanceAllowed() override { return true; }

    void initialise(const juce::String&) override
    {
        muteSoundLibraries();
        if (const auto code = readCommandLine(choices, getCommandLineParameterArray()))
        {
            setApplicationReturnValue(*code);
            return quit();
        }
        if (!hasDisplay("Pacini"))
        {
            setApplicationReturnValue(1);
            return quit();
        }
        if (!choices.fresh)
            settings = std::make_unique<juce::PropertiesFile>(settingsOptions());
        editor::useLanguage({});
        editor::tellLanguageProblem("Pacini");
        processor = std::make_unique<plugin::Plugin>();
        processor->pad().setStopsOnCrash(true); // the signals are ours
        rig = std::make_unique<AudioDevices>(*processor);
        Routing routing;
        std::unique_ptr<juce::XmlElement> devices;
        if (settings)
        {
            routing = routingOf(*settings);
            devices = settings->getXmlValue("devices");
            juce::MemoryOutputStream state;
            if (juce::Base64::convertFromBase64(state, settings->getValue("state")))
                processor->setStateInformation(state.getData(), static_cast<int>(state.getDataSize()));
        }
        if (choices.controller)
            processor->pad().choose(*choices.controller);
        if (choices.testSignal)
            routing.input = InputChoice::test;
        if (!choices.hapticOutputs.empty())
        {
            routing.hapticChannels = static_cast<int>(choices.hapticOutputs.size());
            std::copy(choices.hapticOutputs.begin(), choices.hapticOutputs.end(), routing.hapticOutputs.begin());
        }
        routing.mainOutput = choices.soundOutput.value_or(routing.mainOutput);
        rig->setRouting(routing);
        if (const auto error = rig->open(devices.get(), choices.deviceType); error.isNotEmpty())
            juce::Logger::writeToLog("Pacini: no sound device: " + error);
        if (choices.file != juce::File())
            if (const auto played = rig->play(choices.file); !played)
                juce::Logger::writeToLog("Pacini: " + juce::String(played.error().text()));
        window = std::make_unique<StandaloneWindow>(*processor, *rig);
        if (settings)
            startTimer(keepInterval);
    }

    void shutdown() override
    {
        stopTimer();
        keepSettings();
        window.reset();
        rig.reset();
        processor.reset();
    }

    void systemRequestedQuit() override { quit(); }

private:
    static constexpr int keepInterval = 2000; ///< ms

    /// A program that is killed, or ends with the session of the desktop, does not come to shutdown(). Only what has
    /// changed is written.
    void timerCallback() override { keepSettings(); }
    void keepSettings()
    {
        if (!settings || !rig)
            return;
        remember(*settings, rig->routing());
        if (const auto devices = rig->devices().createStateXml())
            settings->setValue("devices", devices.get());
        juce::MemoryBlock state;
        processor->getStateInformation(state);
        if (state != keptState)
            settings->setValue("state", juce::Base64::toBase64(state.getData(), state.getSize()));
        keptState = std::move(state);
        settings->saveIfNeeded();
    }

    static juce::PropertiesFile::Options settingsOptions()
    {
        juce::PropertiesFile::Options options;
        options.applicationName = "Pacini";
        options.filenameSuffix = ".settings";
        options.osxLibrarySubFolder = "Application Support";
#if JUCE_LINUX || JUCE_BSD
        options.folderName = "~/.config";
#endif
        return options;
    }

    CommandLineChoices choices;
    std::unique_ptr<juce::PropertiesFile> settings;
    juce::MemoryBlock keptState;
    std::unique_ptr<plugin::Plugin> processor;
    std::unique_ptr<AudioDevices> rig;
    std::unique_ptr<StandaloneWindow> window;
};

} // namespace pacini::app

/// What JUCE's entry point calls; it owns the result.
juce::JUCEApplicationBase* juce_CreateApplication();
juce::JUCEApplicationBase* juce_CreateApplication()
{
    return new pacini::app::Application();
}
