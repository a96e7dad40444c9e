// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/EditorModel.h"

#include "document/Amendments.h"
#include "editor/Text.h"
#include "editor/Translation.h"

#include <algorithm>
#include <utility>

namespace pacini::editor
{

EditorModel::EditorModel(const Folders& folders) : recoveryFolder(folders.recovery), recent(folders.recentList)
{
    if (!recoveryFolder.empty())
        autosave = std::make_unique<Autosave>(recoveryFolder);
}

EditorModel::~EditorModel()
{
    // What was not saved can be restored the next time.
    if (autosave)
        autosave->flush();
}

void EditorModel::report(const std::string& title, const Error& error) const
{
    if (onError)
        onError(translateMessage(toText(title)), translateMessage(toText(error.text())));
}

// The project.

WorkPlace EditorModel::placeNow() const
{
    WorkPlace place = findPlace ? findPlace() : WorkPlace{};
    place.clip = unanalysed ? beforeUnanalysed : active;
    return place;
}

void EditorModel::keepPlace()
{
    if (!open->path().empty())
        (void)recent.setPlace(open->path(), placeNow());
}

void EditorModel::take(Document document, const WorkPlace& place)
{
    keepPlace();
    unanalysed.reset();
    sample = false;
    *open = std::move(document);
    preview = nullptr;
    comparing = false;
    versions.clear();
    const bool known = open->clip(place.clip) != nullptr;
    active = known ? place.clip : isEmpty() ? 0 : open->project().clips.front()->id;
    opened.emit();
    follow(-1);
    contentChanged.emit();
    projectChanged.emit();
    if (known && goToPlace)
        goToPlace(place);
}

void EditorModel::newProject()
{
    take(Document{});
}

Result<void> EditorModel::openProject(const std::filesystem::path& file)
{
    auto read = Document::open(file);
    if (!read)
        return read.error();
    const WorkPlace place = recent.placeOf(file);
    take(std::move(read).value(), place);
    (void)recent.add(file);
    return {};
}

void EditorModel::openProject(Project made)
{
    take(Document(std::move(made)));
}

void EditorModel::openSample(Project made)
{
    openProject(std::move(made));
    sample = true;
}

Result<void> EditorModel::recover(const Recoverable& entry)
{
    auto recovered = Document::recover(entry.file);
    if (!recovered)
        return recovered.error();
    take(std::move(recovered).value(), entry.place);
    if (autosave)
    {
        autosaveNow();
        autosave->flush();
    }
    // Where it could not be written anew, the old file is all there is.
    if (autosave && !autosave->lastError())
        discardRecoverable(entry);
    return {};
}

Result<void> EditorModel::saved(Result<void> result)
{
    if (result)
    {
        sample = false;
        (void)recent.add(open->path());
    }
    follow(active);
    projectChanged.emit();
    return result;
}

Result<void> EditorModel::save()
{
    return saved(open->save());
}

Result<void> EditorModel::saveAs(const std::filesystem::path& file)
{
    return saved(open->saveAs(file));
}

void EditorModel::discardAutosave()
{
    if (autosave)
        autosave->discard();
}

std::vector<Recoverable> EditorModel::recoverable() const
{
    return recoveryFolder.empty() ? std::vector<Recoverable>{} : listRecoverable(recoveryFolder);
}

// What is shown.

std::shared_ptr<const Clip> EditorModel::clip() const
{
    if (preview)
        return preview;
    const auto shown = shownItem();
    return shown ? shown->clip : nullptr;
}

double EditorModel::duration() const
{
    if (const auto now = clip())
        return now->duration;
    return unanalysed ? unanalysed->audio.duration() : 0.0;
}

void EditorModel::show(int clipId)
{
    const int before = std::exchange(active, clipId);
    comparing = comparing && active == before;
    unanalysed.reset();
    follow(before);
    contentChanged.emit();
    projectChanged.emit();
}

void EditorModel::showUnanalysed(std::shared_ptr<const Sound> read)
{
    if (!unanalysed)
        beforeUnanalysed = active;
    unanalysed = std::move(read);
    comparing = false;
    active = 0;
    follow(-1);
    contentChanged.emit();
    projectChanged.emit();
}

void EditorModel::endUnanalysed()
{
    unanalysed.reset();
    const bool there = open->clip(beforeUnanalysed) != nullptr;
    show(there || isEmpty() ? beforeUnanalysed : open->project().clips.front()->id);
}

/// After any change of the document or of what is shown; whether that is another clip than `before`.
bool EditorModel::follow(int before)
{
    std::erase_if(versions, [this](const auto& kept) { return !open->clip(kept.first); });
    comparing = comparing && keptVersion() != nullptr;
    if (!item())
        active = isEmpty() || unanalysed ? 0 : open->project().clips.front()->id;
    if (autosave)
    {
        const auto failure = autosave->lastError();
        if (failure && !autosaveFailed)
            report("Autosave failed. Save the project now", *failure);
        autosaveFailed = failure.has_value();
    }
    if (active != before)
        shownChanged.emit();
    if (autosave)
        autosaveNow(); // with the place in the clip that is shown by now
    return active != before;
}

void EditorModel::autosaveNow()
{
    DocumentSnapshot snapshot = open->snapshot();
    snapshot.place = placeNow();
    autosave->update(std::move(snapshot));
}

void EditorModel::documentChanged()
{
    follow(active);
    contentChanged.emit();
    projectChanged.emit();
}

// Previews and versions.

void EditorModel::setPreview(std::shared_ptr<const Clip> wanted)
{
    if (!wanted && !preview)
        return;
    if (!preview)
        setComparing(false);
    preview = std::move(wanted);
    contentChanged.emit();
}

void EditorModel::keepVersion()
{
    const auto shown = item();
    if (!shown || preview)
        return;
    versions[active] = shown;
    setComparing(false);
    versionChanged.emit();
}

std::shared_ptr<const ClipItem> EditorModel::keptVersion() const
{
    const auto found = versions.find(active);
    return found != versions.end() ? found->second : nullptr;
}

std::shared_ptr<const ClipItem> EditorModel::shownItem() const
{
    return comparing && keptVersion() ? keptVersion() : item();
}

void EditorModel::setComparing(bool wanted)
{
    if (wanted == comparing || preview || (wanted && !keptVersion()))
        return;
    comparing = wanted;
    contentChanged.emit();
    versionChanged.emit();
}

/// The kept version is only looked at. Of gestures, which come many times a second, nothing is said.
bool EditorModel::mayEdit(Gesture gesture) const
{
    if (comparing && gesture == 0 && onError)
        onError("This is version A",
                "Version A is for comparison. Press C to return to the clip, or revert to version A.");
    return !comparing;
}

// Edits.

namespace
{
/// The clip to show after a step from one state to another: what the step has changed, `active` wherever it can stay;
/// 0: there is none.
int clipAfterStep(const Project& before, const Project& after, int active)
{
    int changed = 0;
    for (const auto& item : after.clips)
        if (const auto old = before.find(item->id); !old || old->clip != item->clip)
        {
            if (item->id == active)
                return active;
            changed = changed != 0 ? changed : item->id;
        }
    if (changed != 0 || after.find(active) || after.clips.empty())
        return changed != 0 ? changed : after.clips.empty() ? 0 : active;
    // It is gone: what stands in its place now.
    std::size_t place = 0;
    while (place < before.clips.size() && before.clips[place]->id != active)
        ++place;
    return after.clips[std::min(place, after.clips.size() - 1)]->id;
}
} // namespace

void EditorModel::undo()
{
    if (open->steps().canUndo())
        goTo(open->steps().current() - 1);
}

void EditorModel::redo()
{
    if (open->steps().canRedo())
        goTo(open->steps().current() + 1);
}

void EditorModel::goTo(std::size_t state)
{
    setComparing(false);
    const int shown = active;
    const Project before = open->project();
    open->goTo(state);
    if (!unanalysed)
        active = clipAfterStep(before, open->project(), active);
    follow(shown);
    contentChanged.emit();
    projectChanged.emit();
}

bool EditorModel::commit(std::string name, Result<Project> next, Gesture gesture)
{
    return change([&](Document& document) { return document.commit(std::move(name), std::move(next), gesture); });
}

bool EditorModel::change(const std::function<Result<void>(Document&)>& amendment)
{
    if (const auto done = amendment(*open); !done)
    {
        report("Not possible", done.error());
        return false;
    }
    documentChanged();
    return true;
}

Result<int> EditorModel::insert(const std::function<Result<int>(Document&)>& amendment)
{
    auto id = amendment(*open);
    if (!id)
        return id;
    if (follow(active))
        contentChanged.emit();
    projectChanged.emit();
    return id;
}

Result<void> EditorModel::openScene(const Scene& scene, const std::string& group)
{
    if (auto done = pacini::openScene(*open, scene, group, "Open scene"); !done)
        return done;
    documentChanged();
    sceneOpened.emit();
    return {};
}

std::vector<int> EditorModel::selectedClips() const
{
    std::vector<int> there = selectedNow;
    std::erase_if(there, [this](int id) { return !open->clip(id); });
    if (std::find(there.begin(), there.end(), active) == there.end())
        there.assign(active != 0 ? 1 : 0, active);
    return there;
}

} // namespace pacini::editor
