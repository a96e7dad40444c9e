// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/ProjectFiles.h"

#include "document/FolderFiles.h"
#include "document/ProjectJson.h"
#include "editor/Text.h"
#include "editor/clip/EditorView.h"
#include "io/InputFile.h"

#include <algorithm>

namespace pacini::editor
{

namespace
{
juce::String readablePattern()
{
    juce::String pattern = "*.pacini";
    for (const auto& extension : openableExtensions())
        pattern << ";*" << extension;
    return pattern;
}

bool isProject(const std::filesystem::path& file)
{
    return file.extension() == ".pacini";
}
} // namespace

void ProjectFiles::open(const std::vector<std::filesystem::path>& files)
{
    const auto openThem = [&session = view.session(), files]
    {
        session.sounds.openFiles(files);
    };
    if (std::any_of(files.begin(), files.end(), isProject))
        whenSaved(openThem);
    else
        openThem();
}

namespace
{
std::filesystem::path sampleProject(EditorView& view)
{
    const auto& demos = view.hostServices().demoSounds;
    return demos.empty() ? std::filesystem::path() : demos.front().parent_path() / "sample.pacini";
}
} // namespace

bool ProjectFiles::hasSample() const
{
    std::error_code error;
    const auto file = sampleProject(view);
    return !file.empty() && std::filesystem::exists(file, error);
}

void ProjectFiles::openSample()
{
    whenSaved(
        [this]
        {
            Session& session = view.session();
            const auto file = sampleProject(view);
            const auto text = readWholeFile(file, largestProjectText);
            auto read = text ? readProjectJson(*text, file.parent_path()) : Result<ReadProject>(text.error());
            if (read)
                session.model.openProject(std::move(read->project));
            else
                session.model.onError("The sample project was not opened", toText(read.error().text()));
        });
}

void ProjectFiles::askWhatToOpen()
{
    choose("Open sounds, clips or a project", Purpose::opening,
           [this](const juce::Array<juce::File>& chosen)
           {
               std::vector<std::filesystem::path> files;
               for (const auto& file : chosen)
                   files.push_back(pathOf(file));
               open(files);
           });
}

void ProjectFiles::askWhatFolder()
{
    choose("Open all sounds and clips of a folder", Purpose::openingFolder,
           [this](const juce::Array<juce::File>& chosen)
           {
               if (!chosen.isEmpty())
                   open({pathOf(chosen[0])});
           });
}

void ProjectFiles::askForSound(const juce::String& title, const std::filesystem::path& start,
                               std::function<void(const std::filesystem::path&)> chosen)
{
    choose(
        title, Purpose::openingSound,
        [chosen = std::move(chosen)](const juce::Array<juce::File>& files)
        {
            if (!files.isEmpty())
                chosen(pathOf(files[0]));
        },
        start);
}

void ProjectFiles::tellMissing(const std::vector<AudioReference>& missing)
{
    constexpr std::size_t maxNames = 6;
    juce::StringArray names;
    for (std::size_t i = 0; i < std::min(missing.size(), maxNames); ++i)
        names.add(pathText(missing[i].path));
    if (missing.size() > maxNames)
        names.add("and " + juce::String(static_cast<int>(missing.size() - maxNames)) + " more");
    const auto find = [this, start = missing.front().path]
    {
        askForSound("Find " + pathText(start.filename()), start,
                    [&session = view.session()](const std::filesystem::path& file)
                    { session.sounds.findSounds(file); });
    };
    const bool one = missing.size() == 1;
    view.showMessage(std::make_unique<MessageSheet>(
        one ? "A sound is missing" : juce::String(static_cast<int>(missing.size())) + " sounds are missing",
        "The clips can be edited, played and exported without " + juce::String(one ? "it" : "them") +
            "; only analysing again needs " + (one ? "it" : "them") + ".\n\n" + names.joinIntoString("\n"),
        std::vector<Sheet::Answer>{{(one ? "Find it" : "Find them") + toText("…"), find}, {"Go on without", {}}}));
}

void ProjectFiles::whenSaved(std::function<void()> next)
{
    Session& session = view.session();
    if (!session.model.document().isDirty() || session.model.isEmpty())
        return next();
    const auto& path = session.model.document().path();
    view.showSheet(
        std::make_unique<MessageSheet>("Save the changes?",
                                       (path.empty() ? juce::String("This project has never been saved.")
                                                     : pathText(path.filename()) + " has changes that are not saved.") +
                                           " Without saving they are lost.",
                                       std::vector<Sheet::Answer>{{"Save",
                                                                   [this, next]
                                                                   {
                                                                       save(next);
                                                                   }},
                                                                  // Until another project is open what is
                                                                  // autosaved stays: opening may fail.
                                                                  {"Don't save", next},
                                                                  {"Cancel", {}}}));
}

void ProjectFiles::finishSaving(const Result<void>& saved, const std::filesystem::path& file,
                                const std::function<void()>& next)
{
    if (saved)
    {
        if (next)
            next();
        return;
    }
    const auto elsewhere = [this, next]
    {
        saveAs(next);
    };
    view.showMessage(std::make_unique<MessageSheet>(
        "Not saved",
        pathText(file) + "\n" + toText(saved.error().text()) +
            "\n\nThe project is still open with all changes. Make room, or save it in another place.",
        std::vector<Sheet::Answer>{{"Save as" + toText("…"), elsewhere}, {"Close", {}}}));
}

void ProjectFiles::save(std::function<void()> next)
{
    if (view.session().model.document().path().empty())
        return saveAs(std::move(next));
    finishSaving(view.session().model.save(), view.session().model.document().path(), next);
}

void ProjectFiles::saveAs(std::function<void()> next)
{
    choose("Save the project", Purpose::saving,
           [this, next](const juce::Array<juce::File>& chosen)
           {
               if (chosen.isEmpty())
                   return;
               const auto file = pathOf(chosen[0].withFileExtension("pacini"));
               finishSaving(view.session().model.saveAs(file), file, next);
           });
}

void ProjectFiles::choose(const juce::String& title, Purpose purpose,
                          std::function<void(const juce::Array<juce::File>&)> chosen,
                          const std::filesystem::path& wantedStart)
{
    const bool saving = purpose == Purpose::saving;
    const auto& path = view.session().model.document().path();
    juce::File start =
        path.empty() ? juce::File::getSpecialLocation(juce::File::userDocumentsDirectory) : juce::File(pathText(path));
    if (saving && path.empty())
        start = start.getChildFile("Untitled.pacini");
    if (!wantedStart.empty())
        start = juce::File(pathText(wantedStart));
    // The folder may be gone, too.
    while (!saving && !start.exists() && start != start.getParentDirectory())
        start = start.getParentDirectory();
    chooser = std::make_unique<juce::FileChooser>(title, start, saving ? juce::String("*.pacini") : readablePattern());
    using Browser = juce::FileBrowserComponent;
    const int flags = [purpose]() -> int
    {
        switch (purpose)
        {
        case Purpose::saving:
            return Browser::canSelectFiles | Browser::saveMode | Browser::warnAboutOverwriting;
        case Purpose::openingFolder:
            return Browser::canSelectDirectories | Browser::openMode;
        case Purpose::openingSound:
            return Browser::canSelectFiles | Browser::openMode;
        case Purpose::opening:
            break;
        }
        return Browser::canSelectFiles | Browser::openMode | Browser::canSelectMultipleItems;
    }();
    chooser->launchAsync(flags, [chosen](const juce::FileChooser& done) { chosen(done.getResults()); });
}

void ProjectFiles::offerRecovery()
{
    Session& session = view.session();
    const auto found = session.model.recoverable();
    const auto usable =
        std::find_if(found.begin(), found.end(), [](const Recoverable& entry) { return !entry.problem; });
    if (usable == found.end())
        return;
    juce::StringArray names;
    for (const auto& name : usable->clips)
        names.add(toText(name));
    const juce::Time when(static_cast<juce::int64>(usable->time * 1000.0));
    const auto restore = [this, &session, entry = *usable]
    {
        whenSaved(
            [&session, entry]
            {
                if (const auto done = session.model.recover(entry); !done)
                    session.model.onError("Not restored", toText(done.error().text()));
            });
    };
    view.showMessage(std::make_unique<MessageSheet>(
        "Restore unsaved work?",
        "Pacini did not end properly. Changes of " +
            (usable->project.empty() ? juce::String("a project that was never saved")
                                     : pathText(usable->project.filename())) +
            " from " + when.toString(true, true, false) + " can be restored. Clips: " + names.joinIntoString(", "),
        std::vector<Sheet::Answer>{{"Restore", restore},
                                   {"Discard",
                                    [this, entry = *usable]
                                    {
                                        discardRecoverable(entry);
                                        offerRecovery(); // of another program that did not end properly
                                    }},
                                   {"Later", {}}}));
}

} // namespace pacini::editor
