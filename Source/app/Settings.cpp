// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/Settings.h"

#include "app/CommandLine.h"
#include "editor/Text.h"

namespace pacini::app
{

namespace
{
juce::String hapticKey(int channel)
{
    return "hapticOutput" + juce::String(channel + 1);
}
} // namespace

std::optional<int> readCommandLine(CommandLineChoices& choices, const juce::StringArray& arguments)
{
    // Installed it has another name than where it is built.
    const auto name = juce::File::getSpecialLocation(juce::File::currentExecutableFile).getFileNameWithoutExtension();
    CLI::App options("Pacini: sound to touch, live. A window with the plugin, and its routing to the sound devices.",
                     name.toStdString());
    std::string deviceType, file;
    std::vector<int> hapticOutputs;
    int soundOutput = -1;
    options.add_flag("--fresh", choices.fresh, "Start with the default settings, and leave the saved ones as they are");
    options.add_flag("--test-signal", choices.testSignal, "Listen to a test signal");
    options.add_option("--play", file, "Listen to a sound file")->type_name("FILE");
    options.add_option("--device-type", deviceType, "Kind of sound device, such as ALSA or JACK")->type_name("TYPE");
    const CLI::Range channels(0, 1024);
    options
        .add_option("--haptic-output", hapticOutputs,
                    "Output of the haptic signal, from 1; 0: none. For several actuators one of each: 3,4,7")
        ->type_name("N")
        ->delimiter(',')
        ->expected(1, static_cast<int>(plugin::maxHapticChannels))
        ->check(channels);
    options.add_option("--sound-output", soundOutput, "First output of the sound, from 1; 0: none")
        ->type_name("N")
        ->check(channels);
    std::string controller;
    auto* const named = options.add_option(
        "--controller", controller, "Game controller that plays along, by its name in 'pacini devices'; empty: none");
    named->type_name("NAME");
    if (const auto code = readCommandLine(options, JucePlugin_VersionString, arguments))
        return code;
    choices.deviceType = editor::toText(deviceType);
    if (!file.empty())
        choices.file = juce::File::getCurrentWorkingDirectory().getChildFile(editor::toText(file));
    for (const int output : hapticOutputs)
        choices.hapticOutputs.push_back(output - 1);
    if (named->count() > 0)
        choices.controller = controller;
    if (soundOutput >= 0)
        choices.soundOutput = soundOutput - 1;
    return std::nullopt;
}

Routing routingOf(juce::PropertiesFile& settings)
{
    Routing routing;
    routing.input = static_cast<InputChoice>(juce::jlimit(0, 2, settings.getIntValue("input", 0)));
    routing.mainInput = settings.getIntValue("mainInput", routing.mainInput);
    routing.sidechainInput = settings.getIntValue("sidechainInput", routing.sidechainInput);
    routing.mainOutput = settings.getIntValue("mainOutput", routing.mainOutput);
    // Before there were several actuators, the channels lay side by side.
    constexpr int most = static_cast<int>(plugin::maxHapticChannels);
    routing.hapticChannels = juce::jlimit(1, most, settings.getIntValue("hapticChannels", routing.hapticChannels));
    const int first = settings.getIntValue("hapticOutput", routing.hapticOutputs[0]);
    for (int c = 0; c < routing.hapticChannels; ++c)
        routing.hapticOutputs[static_cast<std::size_t>(c)] =
            settings.getIntValue(hapticKey(c), first < 0 ? -1 : first + c);
    return routing;
}

void remember(juce::PropertiesFile& settings, const Routing& routing)
{
    settings.setValue("input", static_cast<int>(routing.input));
    settings.setValue("mainInput", routing.mainInput);
    settings.setValue("sidechainInput", routing.sidechainInput);
    settings.setValue("mainOutput", routing.mainOutput);
    settings.setValue("hapticChannels", routing.hapticChannels);
    for (int c = 0; c < routing.hapticChannels; ++c)
        settings.setValue(hapticKey(c), routing.hapticOutputs[static_cast<std::size_t>(c)]);
}

} // namespace pacini::app
