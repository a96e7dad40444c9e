// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/Session.h"

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
        onError(juce::String::fromUTF8(title.c_str()), juce::String::fromUTF8(error.text().c_str()));
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
    busy = "Analysing " + juce::String::fromUTF8(file.filename().string().c_str());
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
            lines.add(juce::String::fromUTF8(warning.c_str()));
        onError("Read with gaps", lines.joinIntoString("\n"));
    }
    show(*id);
}

void Session::take(Document document)
{
    player.stop();
    *open = std::move(document);
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
    const auto temporary = std::filesystem::path(
        juce::File::getSpecialLocation(juce::File::tempDirectory).getFullPathName().toStdString());
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

// Edits.

std::shared_ptr<const Clip> Session::gestureStart(Gesture gesture) const
{
    return open->gestureStart(active, gesture);
}

/// After any change of the document.
void Session::follow()
{
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

bool Session::edit(const char* name, EditOperation operation, Gesture gesture)
{
    const bool done = take(open->edit(active, name, std::move(operation), gesture));
    if (done)
    {
        follow();
        setAxis(axisNow);
        changed(project | content | selection);
    }
    return done;
}

bool Session::setClip(const char* name, Clip edited, Gesture gesture)
{
    return setEdited(name, {std::move(edited), selectionNow}, gesture);
}

bool Session::setEdited(const char* name, EditedClip edited, Gesture gesture)
{
    const bool done = take(open->setClip(active, name, std::move(edited.clip), gesture));
    if (done)
    {
        selectionNow = std::move(edited.selection);
        follow();
        changed(project | content | selection);
    }
    return done;
}

void Session::undo()
{
    const auto before = profileName();
    if (!open->undo())
        return;
    if (before != profileName())
        player.setProfile(profile());
    follow();
    setAxis(axisNow);
    changed(project | content | selection | playback);
}

void Session::redo()
{
    const auto before = profileName();
    if (!open->redo())
        return;
    if (before != profileName())
        player.setProfile(profile());
    follow();
    setAxis(axisNow);
    changed(project | content | selection | playback);
}

void Session::duplicate()
{
    const auto id = open->duplicateClip(active, "Duplicate clip");
    if (!id)
        return report("Not duplicated", id.error());
    show(*id);
}

void Session::removeClip()
{
    if (!take(open->removeClip(active, "Remove clip")))
        return;
    active = 0;
    show(isEmpty() ? 0 : open->project().clips.front()->id);
}

void Session::deleteSelection()
{
    if (const auto now = clip(); now && !pacini::isEmpty(selectionNow))
        setEdited("Delete points", {deleteSelected(*now, selectionNow), {}});
}

EditScope Session::scope() const
{
    const auto now = clip();
    return now ? scopeOf(selectionNow, *now, rangeNow) : EditScope{};
}

void Session::copy()
{
    if (const auto now = clip())
        clipboard = copyFragment(*now, scope());
    changed(selection); // paste may have become possible
}

void Session::cut()
{
    copy();
    if (!pacini::isEmpty(selectionNow))
        deleteSelection();
    else if (rangeNow)
    {
        const auto cutRange = *rangeNow;
        rangeNow.reset();
        edit("Cut", CutEdit{cutRange});
        changed(range);
    }
}

void Session::paste()
{
    const auto now = clip();
    if (!now || !clipboard)
        return;
    auto pasted = pasteFragment(*now, *clipboard, playhead());
    if (!pasted)
        return report("Not pasted", pasted.error());
    setEdited("Paste", {std::move(pasted).value(), {}});
}

// Selection and view.

void Session::select(Selection wanted)
{
    if (wanted == selectionNow)
        return;
    selectionNow = std::move(wanted);
    changed(selection);
}

void Session::setViewWidth(double pixels)
{
    if (pixels == width || pixels <= 0.0)
        return;
    const bool fitted = clip() && axisNow.secondsPerPixel * width >= clip()->duration;
    width = pixels;
    fitted ? fit() : setAxis(axisNow);
}

void Session::setAxis(TimeAxis wanted)
{
    if (const auto now = clip())
    {
        wanted.secondsPerPixel = std::min(wanted.secondsPerPixel, std::max(now->duration, 1e-3) / width * 1.02);
        wanted = wanted.keptInside(now->duration * 1.02, width);
    }
    if (wanted == axisNow)
        return;
    axisNow = wanted;
    changed(view);
}

void Session::zoom(double factor, double x)
{
    setAxis(axisNow.zoomed(factor, x));
}

void Session::fit()
{
    if (const auto now = clip())
        setAxis(TimeAxis::showing({0.0, now->duration * 1.02}, width));
}

void Session::showRange(TimeRange wanted)
{
    if (wanted.to > wanted.from)
        setAxis(TimeAxis::showing(wanted, width));
}

void Session::setAmplitudesInDecibels(bool wanted)
{
    decibels = wanted;
    changed(look);
}

void Session::setLaneHeight(int wanted)
{
    laneSize = std::clamp(wanted, 32, 160);
    changed(look);
}

// Playback.

void Session::sendPlayback()
{
    Playback wanted;
    wanted.source = hear != Heard::haptic;
    wanted.haptic = hear != Heard::sound;
    if (looping && clip())
        wanted.loop = rangeNow.value_or(TimeRange{0.0, clip()->duration});
    wanted.a = clip();
    wanted.audition = auditionNow;
    player.set(std::move(wanted));
}

void Session::setTimeRange(std::optional<TimeRange> wanted)
{
    if (wanted && clip())
        wanted = withinClip(*wanted, clip()->duration);
    if (wanted && wanted->to <= wanted->from)
        wanted.reset();
    if (wanted == rangeNow)
        return;
    rangeNow = wanted;
    sendPlayback();
    changed(range);
}

void Session::setLooping(bool wanted)
{
    looping = wanted;
    sendPlayback();
    changed(range);
}

void Session::setHeard(Heard wanted)
{
    hear = wanted;
    sendPlayback();
    changed(playback);
}

void Session::setAudition(Audition wanted)
{
    auditionNow = std::move(wanted);
    sendPlayback();
    changed(playback);
}

void Session::setProfile(const std::string& name)
{
    if (name == profileName())
        return;
    ProjectProfile wanted;
    wanted.name = name;
    if (!take(open->setProfile(std::move(wanted), "Choose actuator")))
        return;
    player.setProfile(profile());
    follow();
    changed(project | playback);
}

std::shared_ptr<const Profile> Session::profile() const
{
    const ProjectProfile& chosen = open->project().profile;
    if (chosen.embedded)
        return std::make_shared<const Profile>(*chosen.embedded);
    for (const NamedProfile& entry : shelf)
        if (entry.name == chosen.name)
            return entry.profile;
    return nullptr;
}

void Session::play()
{
    const auto now = clip();
    if (!now)
        return;
    if (startTime >= now->duration - 1e-3)
        startTime = 0.0;
    if (looping && rangeNow && (startTime < rangeNow->from || startTime >= rangeNow->to))
        startTime = rangeNow->from;
    player.play(startTime);
    changed(playback);
}

void Session::stop()
{
    player.stop();
    changed(playback);
}

double Session::playhead() const
{
    return player.isPlaying() ? player.position() : startTime;
}

void Session::setPlayhead(double time)
{
    startTime = clip() ? std::clamp(time, 0.0, clip()->duration) : 0.0;
    if (player.isPlaying())
        player.play(startTime);
    changed(playback);
}

} // namespace pacini::editor
