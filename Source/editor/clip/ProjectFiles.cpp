// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/ProjectFiles.h"

#include "document/FolderFiles.h"
#include "document/ProjectJson.h"
#include "editor/FileQuestion.h"
#include "editor/Text.h"
#include "editor/Translation.h"
#include "editor/clip/EditorView.h"
#include "editor/clip/sheets/OverwriteQuestion.h"
#include "editor/study/StudyMaking.h"
#include "io/InputFile.h"
#include "io/ProfileFile.h"

#include <algorithm>
#include <utility>

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
    else if (view.session().model.isSample())
        whenSaved(
            [&model = view.session().model, openThem]
            {
                model.newProject();
                openThem();
            });
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
                session.model.openSample(std::move(read->project));
            else
                session.model.onError("Sample project not opened", toText(read.error().text()));
        });
}

void ProjectFiles::askWhatToOpen()
{
    choose(tr("Open sounds, clips or a project"), Purpose::opening,
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
    chooseOne(tr("Open all sounds and clips in a folder"), Purpose::openingFolder,
              [this](const std::filesystem::path& folder) { open({folder}); });
}

void ProjectFiles::askForSound(const juce::String& title, const std::filesystem::path& start,
                               std::function<void(const std::filesystem::path&)> chosen)
{
    chooseOne(title, Purpose::openingSound, std::move(chosen), start);
}

void ProjectFiles::tellMissing(const std::vector<AudioReference>& missing)
{
    constexpr std::size_t maxNames = 6;
    juce::StringArray names;
    for (std::size_t i = 0; i < std::min(missing.size(), maxNames); ++i)
        names.add(pathText(missing[i].path));
    if (missing.size() > maxNames)
        names.add(tr("and {0} more", {juce::String(static_cast<int>(missing.size() - maxNames))}));
    const auto find = [this, start = missing.front().path]
    {
        askForSound(tr("Locate {0}", {pathText(start.filename())}), start,
                    [&session = view.session()](const std::filesystem::path& file)
                    { session.sounds.findSounds(file); });
    };
    view.showMessage(std::make_unique<MessageSheet>(
        counted(missing.size(), "A sound is missing", "{0} sounds are missing"),
        tr("The clips can still be edited, played and exported; only re-analysis needs the sound.") + "\n\n" +
            names.joinIntoString("\n"),
        std::vector<Sheet::Answer>{{toText("Locate…"), find}, {"Continue without", {}}}));
}

void ProjectFiles::whenSaved(std::function<void()> next)
{
    Session& session = view.session();
    if (!session.model.document().isDirty() || session.model.isEmpty())
        return next();
    const auto& path = session.model.document().path();
    view.showSheet(std::make_unique<MessageSheet>(
        "Save the changes?",
        path.empty() ? tr("This project has never been saved. Unsaved changes will be lost.")
                     : tr("{0} has unsaved changes. They will be lost if you don't save.", {pathText(path.filename())}),
        std::vector<Sheet::Answer>{{"Save",
                                    [this, next]
                                    {
                                        save(next);
                                    }},
                                   // Until another project is open what is autosaved stays: opening may fail.
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
    view.ask(std::make_unique<MessageSheet>(
        "Not saved",
        pathText(file) + "\n" + translateMessage(toText(saved.error().text())) + "\n\n" +
            tr("The project is still open with all changes. Free some space or save it elsewhere."),
        std::vector<Sheet::Answer>{{toText("Save as…"), elsewhere}, {"Close", {}}}));
}

void ProjectFiles::save(const std::function<void()>& next)
{
    if (view.session().model.document().path().empty())
        return saveAs(next);
    finishSaving(view.session().model.save(), view.session().model.document().path(), next);
}

void ProjectFiles::saveAs(const std::function<void()>& next)
{
    choose(tr("Save project as"), Purpose::saving,
           [this, next](const juce::Array<juce::File>& chosen)
           {
               if (chosen.isEmpty())
                   return;
               saveTo(pathOf(chosen[0].withFileExtension("pacini")), next);
           });
}

void ProjectFiles::saveTo(const std::filesystem::path& file, const std::function<void()>& next)
{
    const auto write = [this, file, next]
    {
        finishSaving(view.session().model.saveAs(file), file, next);
    };
    ProjectFileSet needed = filesOf(view.session().model.document());
    if (!needed.project.empty() && isSameFile(std::exchange(needed.project, {}), file))
        return write();
    writeAfterAsking(
        {file}, needed, write, [this](std::unique_ptr<Sheet> asked) { view.ask(std::move(asked)); },
        [this, file, next](const Error& error) { finishSaving(Result<void>(error), file, next); });
}

void ProjectFiles::choose(const juce::String& title, Purpose purpose,
                          const std::function<void(const juce::Array<juce::File>&)>& chosen,
                          const std::filesystem::path& wantedStart)
{
    const bool saving = purpose == Purpose::saving;
    const auto& path = view.session().model.document().path();
    juce::File start = path.empty() ? documentsFolder() : juce::File(pathText(path));
    if (saving && path.empty())
        start = start.getChildFile(tr("Untitled") + ".pacini");
    if (!wantedStart.empty())
        start = juce::File(pathText(wantedStart));
    // The folder may be gone, too.
    while (!saving && !start.exists() && start != start.getParentDirectory())
        start = start.getParentDirectory();
    chooser = std::make_unique<juce::FileChooser>(title, start,
                                                  saving                            ? juce::String("*.pacini")
                                                  : purpose == Purpose::openingJson ? juce::String("*.json")
                                                                                    : readablePattern());
    using Browser = juce::FileBrowserComponent;
    const int flags = [purpose]() -> int
    {
        switch (purpose)
        {
        case Purpose::saving:
            return Browser::canSelectFiles | Browser::saveMode; // saveTo() asks
        case Purpose::openingFolder:
            return Browser::canSelectDirectories | Browser::openMode;
        case Purpose::openingSound:
        case Purpose::openingJson:
            return Browser::canSelectFiles | Browser::openMode;
        case Purpose::opening:
            break;
        }
        return Browser::canSelectFiles | Browser::openMode | Browser::canSelectMultipleItems;
    }();
    askForFiles(*chooser, flags, [chosen](const juce::FileChooser& done) { chosen(done.getResults()); });
}

void ProjectFiles::chooseOne(const juce::String& title, Purpose purpose,
                             std::function<void(const std::filesystem::path&)> chosen,
                             const std::filesystem::path& wantedStart)
{
    choose(
        title, purpose,
        [chosen = std::move(chosen)](const juce::Array<juce::File>& files)
        {
            if (!files.isEmpty())
                chosen(pathOf(files[0]));
        },
        wantedStart);
}

void ProjectFiles::askForProfile()
{
    chooseOne(tr("Load the profile of an actuator"), Purpose::openingJson,
              [this](const std::filesystem::path& file)
              {
                  auto read = readProfile(file);
                  if (!read)
                      return view.session().model.report(
                          tr("{0} not opened", {pathText(file.filename())}).toStdString(), read.error());
                  view.session().actuators.addProfile(
                      {file.stem().string(), std::make_shared<const Profile>(std::move(read).value()), true}, true);
              });
}

void ProjectFiles::askForStudy()
{
    chooseOne(tr("Run a study"), Purpose::openingJson,
              [this](const std::filesystem::path& file) { view.hostServices().runStudy(file); });
}

void ProjectFiles::askForStudyReport()
{
    chooseOne(tr("Report of a study"), Purpose::openingJson,
              [this](const std::filesystem::path& file)
              {
                  auto& model = view.session().model;
                  if (model.onNotice)
                      model.onNotice(tr(toText("Writing the report…")));
                  jobs.run([file] { return reportStudy(file); },
                           [&model](const Result<std::filesystem::path>& page)
                           {
                               if (!page)
                                   return model.report("No report", page.error());
                               if (model.onWritten)
                                   model.onWritten({*page});
                               juce::URL(juce::File(pathText(*page))).launchInDefaultBrowser();
                           });
              });
}

void ProjectFiles::askForFolder(const juce::String& title, const std::filesystem::path& start,
                                std::function<void(const std::filesystem::path&)> chosen)
{
    chooseOne(title, Purpose::openingFolder, std::move(chosen), start);
}

void ProjectFiles::askForSettings(std::function<void(const std::filesystem::path&)> chosen)
{
    chooseOne(tr("Load settings"), Purpose::openingJson, std::move(chosen));
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
        tr("Pacini did not quit properly. {0}, last autosaved {1}, can be restored. Clips: {2}",
           {usable->project.empty() ? tr("Unsaved project") : pathText(usable->project.filename()),
            when.toString(true, true, false), names.joinIntoString(", ")}),
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
