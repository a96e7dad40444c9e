// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// File dialogs of the editor: what to open, whether to save, what to restore.

#include "editor/clip/session/Jobs.h"
#include "editor/clip/session/Session.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace pacini::editor
{

class EditorView;

/// [message]
class ProjectFiles
{
public:
    explicit ProjectFiles(EditorView& shown) : view(shown) {}

    /// Sounds, clips and projects. A project takes the place of the open one, which the user is asked to save; and so
    /// does a new one for sounds and clips that are opened while the sample is.
    void open(const std::vector<std::filesystem::path>& files);
    void askWhatToOpen();
    /// The project beside the demo sounds, as one that was never saved.
    void openSample();
    [[nodiscard]] bool hasSample() const;
    void askWhatFolder();
    /// One sound; `start` is where to look first, a file or a folder.
    void askForSound(const juce::String& title, const std::filesystem::path& start,
                     std::function<void(const std::filesystem::path&)> chosen);
    /// A profile of an actuator, which the project has from then on.
    void askForProfile();
    void askForStudy();
    /// A study whose report is written, in the background, and opened in the browser.
    void askForStudyReport();
    void askForFolder(const juce::String& title, const std::filesystem::path& start,
                      std::function<void(const std::filesystem::path&)> chosen);
    /// A settings file (pacini.settings).
    void askForSettings(std::function<void(const std::filesystem::path&)> chosen);
    /// Says which sounds are missing, and offers to find them.
    void tellMissing(const std::vector<AudioReference>& missing);

    /// Does `next` when the project is saved, or need not be; asks the user if so. Not at all when the user says no.
    void whenSaved(std::function<void()> next);
    /// To its file, or where the user says; then `next`, if it was done.
    void save(const std::function<void()>& next = {});
    void saveAs(const std::function<void()>& next = {});
    /// To that file, after a question where another one stands there.
    void saveTo(const std::filesystem::path& file, const std::function<void()>& next = {});

    /// Offers what an earlier run has left.
    void offerRecovery();

private:
    enum class Purpose
    {
        opening,
        openingFolder,
        openingSound,
        openingJson,
        saving
    };
    void choose(const juce::String& title, Purpose purpose,
                const std::function<void(const juce::Array<juce::File>&)>& chosen,
                const std::filesystem::path& wantedStart = {});
    /// Nothing is done without a choice.
    void chooseOne(const juce::String& title, Purpose purpose, std::function<void(const std::filesystem::path&)> chosen,
                   const std::filesystem::path& wantedStart = {});
    void finishSaving(const Result<void>& saved, const std::filesystem::path& file, const std::function<void()>& next);

    EditorView& view;
    std::unique_ptr<juce::FileChooser> chooser;
    Jobs jobs; ///< reports of studies
};

} // namespace pacini::editor
