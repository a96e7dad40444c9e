// SPDX-License-Identifier: GPL-3.0-or-later

// The clip editor as a program of its own.

#include "app/CommandLine.h"
#include "app/Display.h"
#include "app/OpenDevice.h"
#include "app/editor/DemoFiles.h"
#include "app/editor/EditorSettings.h"
#include "app/editor/EditorWindow.h"
#include "app/editor/PreviewDevices.h"
#include "app/editor/StudyWindow.h"
#include "editor/LanguageProblem.h"
#include "editor/Text.h"
#include "editor/Translation.h"
#include "io/ProfileFile.h"
#include "io/ShippedProfiles.h"
#include "io/SoundLibraryCall.h"
#include "study/StudyFile.h"
#include "study/StudyResults.h"

#include <juce_audio_utils/juce_audio_utils.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>

namespace pacini::app
{

namespace
{
using editor::pathOf;

/// Adds the profiles that were measured before; a file that is none is left out.
void addOwnProfiles(std::vector<NamedProfile>& profiles, const juce::File& folder)
{
    auto files = folder.findChildFiles(juce::File::findFiles, false, "*.json");
    files.sort();
    for (const auto& file : files)
        if (auto profile = readProfile(pathOf(file)))
            profiles.push_back({file.getFileNameWithoutExtension().toStdString(),
                                std::make_shared<const Profile>(std::move(profile).value()), true});
}

/// Beside the settings, where projects find their sounds the next time too; without these where it does not stay.
std::vector<std::filesystem::path> demoSounds(const juce::File* settings)
{
    if (settings != nullptr)
        if (auto found = putDemoFiles(settings->getChildFile("demo")); !found.empty())
            return found;
    return putDemoFiles(juce::File::getSpecialLocation(juce::File::tempDirectory).getChildFile("pacini-demo"));
}

std::string languageCodes()
{
    return editor::languages().joinIntoString(", ").toStdString();
}
} // namespace

class EditorApplication final : public juce::JUCEApplication, private juce::Timer
{
public:
    const juce::String getApplicationName() override { return "Pacini Editor"; }
    const juce::String getApplicationVersion() override { return PACINI_VERSION; }
    bool moreThanOneInstanceAllowed() override { return true; }

    void initialise(const juce::String&) override
    {
        muteSoundLibraries();
        Options options;
        if (const auto code = readOptions(options))
        {
            setApplicationReturnValue(*code);
            return quit();
        }
        if (!hasDisplay("PaciniEditor"))
        {
            setApplicationReturnValue(1);
            return quit();
        }
        const auto absolute = [](const std::string& name)
        {
            return pathOf(juce::File::getCurrentWorkingDirectory().getChildFile(editor::toText(name)));
        };
        std::vector<std::filesystem::path> files;
        for (const std::string& name : options.names)
            files.push_back(absolute(name));
        const auto home = settingsFolder();
        editor::EditorModel::Folders folders;
        auto profiles = builtInProfiles();
        if (!options.fresh)
        {
            home.createDirectory();
            settings = std::make_unique<EditorSettings>(home);
            folders = {pathOf(home.getChildFile("recovery")), pathOf(home.getChildFile("recent.json"))};
            addOwnProfiles(profiles, profileFolder(home));
        }
        const auto language = !options.language.empty() ? editor::toText(options.language)
                              : settings                ? settings->language()
                                                        : juce::String("en");
        if (!options.study.empty())
        {
            editor::useLanguage(language);
            editor::tellLanguageProblem("PaciniEditor");
            return runStudyAlone(absolute(options.study), editor::toText(options.deviceType), options.fullScreen,
                                 std::move(profiles));
        }
        session = std::make_unique<editor::Session>(folders, std::move(profiles));
        openDevices(editor::toText(options.deviceType));
        editor::useLanguage(language);
        editor::tellLanguageProblem("PaciniEditor");
        window = std::make_unique<EditorWindow>(*session, *rig, hostServices(home, options));
        auto& view = window->view();
        const bool firstRun = settings && settings->isFirstRun();
        if (settings)
            settings->apply(view);
        else
            view.setDark(editor::systemIsDark());
        window->open(settings ? settings->window() : juce::String());
        view.grabKeyboardFocus();
        if (!files.empty())
            view.files().open(files);
        else if (firstRun)
            view.doCommand(editor::openSample);
        view.files().offerRecovery();
        if (settings)
            startTimer(keepInterval);
    }

    /// The study alone, without the editor.
    void runStudyAlone(const std::filesystem::path& named, const juce::String& deviceType, bool fullScreen,
                       std::vector<NamedProfile> profiles)
    {
        studyDevices = std::make_unique<juce::AudioDeviceManager>();
        constexpr int mostChannels = 256;
        const auto saved = settings ? settings->devices() : nullptr;
        if (const auto error = openDevice(*studyDevices, 0, mostChannels, saved.get(), deviceType); error.isNotEmpty())
            juce::Logger::writeToLog("Pacini: no sound device: " + error);
        const auto opened = openStudy(named, *studyDevices, std::move(profiles), [] { quit(); });
        if (!opened)
        {
            std::cerr << "PaciniEditor: " << study::studyFileOf(named).string() << ": " << opened.error().text()
                      << '\n';
            setApplicationReturnValue(1);
            return quit();
        }
        if (fullScreen)
            studyWindow->setFullScreen(true);
    }

    Result<void> openStudy(const std::filesystem::path& named, juce::AudioDeviceManager& devices,
                           std::vector<NamedProfile> profiles, std::function<void()> whenClosed)
    {
        const std::filesystem::path file = study::studyFileOf(named);
        auto read = study::readStudy(file);
        if (!read)
            return read.error();
        studyWindow = std::make_unique<StudyWindow>(editor::StudyPlace{std::move(*read), file.parent_path()}, devices,
                                                    std::move(profiles), "Pacini " PACINI_VERSION,
                                                    window ? std::optional(window->view().isDark()) : std::nullopt,
                                                    std::move(whenClosed));
        studyWindow->setVisible(true);
        return {};
    }

    void anotherInstanceStarted(const juce::String&) override {}

    void systemRequestedQuit() override
    {
        if (window == nullptr) // every answer of a study is on the disk
            return quit();
        window->view().files().whenSaved([this] { leave(); });
    }

    void shutdown() override
    {
        stopTimer();
        keepSettings();
        studyWindow.reset();
        studyDevices.reset();
        window.reset();
        rig.reset();
        session.reset();
    }

private:
    static constexpr int keepInterval = 1000; ///< ms

    /// A program that is killed, or ends with the session of the desktop, does not come to shutdown(). Only what has
    /// changed is written.
    void timerCallback() override { keepSettings(); }
    void keepSettings()
    {
        if (settings && window)
            settings->keep(*rig, window->view(), window->state());
    }

    struct Options
    {
        bool fresh = false, fullScreen = false;
        std::string deviceType, language, study;
        std::vector<std::string> names;
    };

    /// Reads the command line. The exit code where the program ends with that.
    static std::optional<int> readOptions(Options& options)
    {
        CLI::App app("Pacini Editor: sounds become clips that can be reshaped, felt and exported.", "PaciniEditor");
        app.add_option("files", options.names, "Sounds, clips of any known format, folders of them, or a project")
            ->type_name("FILE");
        app.add_flag("--fresh", options.fresh, "Start with the default settings, and leave the saved ones as they are");
        app.add_option("--device-type", options.deviceType, "Kind of sound device, such as ALSA or JACK")
            ->type_name("TYPE");
        app.add_option("--language", options.language, "Of menus and controls: en or " + languageCodes())
            ->type_name("CODE");
        app.add_option("--study", options.study, "Run a study: its folder or file")->type_name("STUDY");
        app.add_flag("--full-screen", options.fullScreen, "Fill the screen with the study");
        return readCommandLine(app, PACINI_VERSION, getCommandLineParameterArray());
    }

    static juce::File profileFolder(const juce::File& home) { return home.getChildFile("profiles"); }

    void openDevices(const juce::String& deviceType)
    {
        rig = std::make_unique<PreviewDevices>(session->player, session->outputs);
        rig->onLost = [this]
        {
            session->transport.stop();
            session->filePreview.stop();
            if (rig->isLookingForDevice() && session->model.onNotice)
                session->model.onNotice(editor::tr("The audio device is gone. It is used again when it comes back."));
        };
        rig->onFound = [this]
        {
            if (session->model.onNotice)
                session->model.onNotice(editor::tr("The audio device is open"));
        };
        std::unique_ptr<juce::XmlElement> devices;
        if (settings)
        {
            devices = settings->devices();
            settings->apply(*rig, session->outputs);
        }
        if (const auto error = rig->open(devices.get(), deviceType); error.isNotEmpty())
            juce::Logger::writeToLog("Pacini: no sound device: " + error);
    }

    /// What the editor asks of this program.
    editor::HostServices hostServices(const juce::File& home, const Options& options)
    {
        editor::HostServices around;
        around.version = PACINI_VERSION;
        around.demoSounds = demoSounds(settings ? &home : nullptr);
        around.runStudy = [this](const std::filesystem::path& file)
        {
            session->transport.stop();
            const auto opened =
                openStudy(file, rig->devices(), session->actuators.profiles(), [this] { studyWindow.reset(); });
            if (!opened)
                session->model.report(editor::tr("{0} not opened", {editor::pathText(file.filename())}).toStdString(),
                                      opened.error());
        };
        if (settings)
        {
            around.profileFolder = pathOf(profileFolder(home));
            around.presetFolder = pathOf(home.getChildFile("analysis presets"));
            around.outputPresetFolder = pathOf(home.getChildFile("output presets"));
            around.characterPresetFolder = pathOf(home.getChildFile("character presets"));
            around.language =
                options.language.empty() ? settings->language() : editor::toText(options.language); // as it is shown
            around.chooseLanguage = [this](const juce::String& code)
            {
                settings->keepLanguage(code);
            };
        }
        return around;
    }

    static juce::File settingsFolder()
    {
#if JUCE_LINUX || JUCE_BSD
        return juce::File("~/.config").getChildFile("pacini-editor");
#else
        return juce::File::getSpecialLocation(juce::File::userApplicationDataDirectory).getChildFile("Pacini Editor");
#endif
    }

    void leave()
    {
        // The user has decided about what was not saved.
        session->model.discardAutosave();
        quit();
    }

    std::unique_ptr<EditorSettings> settings;
    std::unique_ptr<editor::Session> session;
    std::unique_ptr<PreviewDevices> rig;
    std::unique_ptr<EditorWindow> window;
    std::unique_ptr<juce::AudioDeviceManager> studyDevices; ///< of a study that runs without the editor
    std::unique_ptr<StudyWindow> studyWindow;
};

} // namespace pacini::app

START_JUCE_APPLICATION(pacini::app::EditorApplication)
