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
    for (const auto& file : files)
        if (file.extension() == ".pacini")
        {
            if (auto opened = openProject(file); !opened)
                report(file.filename().string() + " was not opened", opened.error());
        }
        else
            waiting.push_back(file);
    readNext();
}

void Session::readNext()
{
    if (waiting.empty() || busy.isNotEmpty())
        return;
    const auto file = waiting.front();
    waiting.erase(waiting.begin());
    busy = "Analysing " + pathText(file.filename());
    jobs.run([file] { return importFile(file, EncoderParams{}); },
             [this, file](Result<Imported> read)
             {
                 busy.clear();
                 if (read)
                     add(std::move(read).value());
                 else
                     report(file.filename().string() + " was not opened", read.error());
                 changed(work);
                 readNext();
             });
    changed(work);
}

void Session::add(Imported imported)
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
    if (!id)
        return report("Not added", id.error());
    if (!imported.warnings.empty() && onError)
    {
        juce::StringArray lines;
        for (const auto& warning : imported.warnings)
            lines.add(toText(warning));
        onError("Read with gaps", lines.joinIntoString("\n"));
    }
    show(*id);
}

void Session::take(Document document)
{
    player.stop();
    *open = std::move(document);
    preview = nullptr;
    comparing = false;
    versions.clear();
    sounds.clear();
    active = 0;
    selectionNow = {};
    rangeNow.reset();
    auditionNow = {};
    startTime = 0.0;
    if (!isEmpty())
        active = open->project().clips.front()->id;
    player.setProfile(profile());
    loadSound();
    follow();
    fit();
    changed(project | content | selection | range | sound | playback);
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
    const auto shown = item();
    const auto found = shown ? sounds.find(shown->source) : sounds.end();
    return found != sounds.end() ? found->second : nullptr;
}

void Session::show(int clipId)
{
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
    loadSound();
    follow();
    fit();
    changed(project | content | selection | range | sound | playback);
}

void Session::loadSound()
{
    const auto shown = item();
    const AudioReference* reference = shown ? open->project().findSource(shown->source) : nullptr;
    player.setSound(soundOfClip());
    if (reference == nullptr || sounds.contains(shown->source))
        return;
    const auto folder = open->path().parent_path();
    const auto temporary = pathOf(juce::File::getSpecialLocation(juce::File::tempDirectory));
    jobs.run(
        [reference = *reference, folder, temporary]() -> Result<std::shared_ptr<const Sound>>
        {
            const std::vector<std::filesystem::path> folders = {folder};
            auto audio = loadAudio(reference, folders, temporary);
            if (!audio)
                return audio.error();
            return std::make_shared<const Sound>(std::move(audio).value());
        },
        [this, id = shown->source](Result<std::shared_ptr<const Sound>> read)
        {
            if (!read)
                return report("The sound is missing; the clip can be edited without it", read.error());
            sounds[id] = *read;
            player.setSound(soundOfClip());
            changed(sound);
        });
}

/// After any change of the document.
void Session::follow()
{
    std::erase_if(versions, [this](const auto& kept) { return !open->clip(kept.first); });
    comparing = comparing && keptVersion() != nullptr;
    if (!item() && !isEmpty())
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
        autosave->update(open->snapshot());
    sendPlayback();
}

} // namespace pacini::editor
