// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/Session.h"

#include "editor/Text.h"

#include <pacini/clip/edits/TimeEdits.h>

#include <algorithm>

namespace pacini::editor
{

Session::Session(const Folders& folders, std::vector<NamedProfile> profiles)
    : recoveryFolder(folders.recovery), recent(folders.recentList), shelf(std::move(profiles))
{
    if (!recoveryFolder.empty())
        autosave = std::make_unique<Autosave>(recoveryFolder);
}

Session::~Session()
{
    unanalysed.reset();
    importer.stop();
    if (again)
        again->stopped = true;
    // What was not saved can be restored the next time.
    if (autosave)
        autosave->flush();
}

void Session::report(const std::string& title, const Error& error)
{
    if (onError)
        onError(toText(title), toText(error.text()));
}

bool Session::take(Result<void> result)
{
    if (!result)
        report("That is not possible", result.error());
    return result.ok();
}

void Session::changed(unsigned what)
{
    listeners.call(what);
}

// The project.

void Session::openFiles(const std::vector<std::filesystem::path>& files)
{
    std::vector<std::filesystem::path> others;
    for (const auto& file : files)
        if (file.extension() == ".pacini")
        {
            if (auto opened = openProject(file); !opened)
                report(file.filename().string() + " was not opened", opened.error());
        }
        else
            others.push_back(file);
    importer.add(others);
}

Result<int> Session::insert(Imported imported)
{
    Result<int> id = 0;
    if (imported.sound)
    {
        id = open->addSound("Add " + imported.clip.name, imported.reference, imported.encoder, imported.clip);
        if (id)
            sounds[open->clip(*id)->source] = imported.sound;
    }
    else
        id = open->addClip("Add " + imported.clip.name, imported.clip);
    if (id)
    {
        follow();
        changed(project);
    }
    return id;
}

void Session::add(Imported imported)
{
    const auto id = insert(std::move(imported));
    if (!id)
        return report("Not added", id.error());
    show(*id);
}

void Session::take(Document document)
{
    player.stop();
    unanalysed.reset();
    importer.stop();
    if (again)
        again->stopped = true;
    again.reset();
    ++generation;
    *open = std::move(document);
    preview = nullptr;
    comparing = false;
    versions.clear();
    sounds.clear();
    missing.clear();
    active = 0;
    selectionNow = {};
    rangeNow.reset();
    auditionNow = {};
    startTime = 0.0;
    if (!isEmpty())
        active = open->project().clips.front()->id;
    player.setProfile(profile());
    checkSounds();
    loadSound();
    follow();
    fit();
    changed(project | content | selection | range | sound | playback | work);
}

void Session::newProject()
{
    take(Document{});
}

Result<void> Session::openProject(const std::filesystem::path& file)
{
    auto opened = Document::open(file);
    if (!opened)
        return opened.error();
    take(std::move(opened).value());
    (void)recent.add(file);
    return {};
}

void Session::openProject(Project made)
{
    take(Document(std::move(made)));
}

Result<void> Session::recover(const Recoverable& entry)
{
    auto recovered = Document::recover(entry.file);
    if (!recovered)
        return recovered.error();
    take(std::move(recovered).value());
    if (autosave)
        autosave->flush();
    discardRecoverable(entry);
    return {};
}

Result<void> Session::save()
{
    auto saved = open->save();
    if (saved)
        (void)recent.add(open->path());
    follow();
    changed(project);
    return saved;
}

Result<void> Session::saveAs(const std::filesystem::path& file)
{
    auto saved = open->saveAs(file);
    if (saved)
        (void)recent.add(open->path());
    follow();
    changed(project);
    return saved;
}

void Session::discardAutosave()
{
    if (autosave)
        autosave->discard();
}

std::vector<Recoverable> Session::recoverable() const
{
    return recoveryFolder.empty() ? std::vector<Recoverable>{} : listRecoverable(recoveryFolder);
}

// The clip that is shown.

std::shared_ptr<const Clip> Session::clip() const
{
    if (preview)
        return preview;
    if (comparing)
        return keptVersion();
    const auto shown = item();
    return shown ? shown->clip : nullptr;
}

std::shared_ptr<const Sound> Session::soundOfClip() const
{
    if (unanalysed)
        return unanalysed;
    const auto shown = item();
    const auto found = shown ? sounds.find(shown->source) : sounds.end();
    return found != sounds.end() ? found->second : nullptr;
}

double Session::duration() const
{
    if (const auto now = clip())
        return now->duration;
    return unanalysed ? unanalysed->duration() : 0.0;
}

void Session::show(int clipId)
{
    // A sound that becomes a clip stays as it is seen.
    const bool stays = unanalysed && open->clip(clipId) && open->clip(clipId)->analysis->duration == duration();
    if (clipId != active)
    {
        player.stop();
        comparing = false;
        active = clipId;
        selectionNow = {};
        rangeNow.reset();
        auditionNow = {};
        startTime = 0.0;
    }
    unanalysed.reset();
    loadSound();
    follow();
    if (!stays)
        fit();
    changed(project | content | selection | range | sound | playback);
}

/// After any change of the document.
void Session::follow()
{
    std::erase_if(versions, [this](const auto& kept) { return !open->clip(kept.first); });
    comparing = comparing && keptVersion() != nullptr;
    if (!item() && !isEmpty() && !unanalysed)
        active = open->project().clips.front()->id;
    if (const auto now = clip())
    {
        selectionNow = withinClip(selectionNow, *now);
        if (rangeNow)
        {
            rangeNow = withinClip(*rangeNow, now->duration);
            if (rangeNow->to <= rangeNow->from)
                rangeNow.reset();
        }
    }
    else
        selectionNow = {};
    if (autosave)
    {
        const auto failure = autosave->lastError();
        if (failure && !autosaveFailed)
            report("Autosave does not work at the moment. Save the project", *failure);
        autosaveFailed = failure.has_value();
        autosave->update(open->snapshot());
    }
    sendPlayback();
}

} // namespace pacini::editor
