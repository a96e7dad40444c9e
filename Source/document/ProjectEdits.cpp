#include "document/ProjectEdits.h"

#include "document/EditLayer.h"
#include "document/EditsBetween.h"
#include "document/OperationCheck.h"
#include "document/ProjectScene.h"
#include "document/Reapply.h"
#include "io/FoundMarkers.h"

#include <pacini/foundation/Clamp.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace pacini
{

namespace
{
Error noSuchClip(int id)
{
    return {ErrorCode::invalidArgument, "clip", "there is no clip " + std::to_string(id) + " in this project"};
}

std::shared_ptr<const ClipItem> shared(ClipItem item)
{
    return std::make_shared<const ClipItem>(std::move(item));
}

/// Lets `change` alter the clip `id`.
template <typename Change>
Result<Project> withItem(Project project, int id, Change change)
{
    for (auto& place : project.clips)
        if (place->id == id)
        {
            ClipItem item = *place;
            change(item);
            place = shared(std::move(item));
            return project;
        }
    return noSuchClip(id);
}

template <typename Change>
Result<Project> withItems(Project project, const std::vector<int>& ids, Change change)
{
    for (const int id : ids)
    {
        auto next = withItem(std::move(project), id, change);
        if (!next)
            return next;
        project = std::move(next).value();
    }
    return project;
}

/// Puts a clip behind another one.
void insertBehind(Project& project, int id, ClipItem added)
{
    const auto place =
        std::find_if(project.clips.begin(), project.clips.end(), [id](const auto& item) { return item->id == id; });
    project.clips.insert(place + 1, shared(std::move(added)));
}

/// A clip with one more edit.
Result<ClipItem> itemWith(const ClipItem& old, EditOperation operation)
{
    auto clip = applyEdit(*old.clip, operation);
    if (!clip)
        return clip.error();
    ClipItem item = old;
    item.edits = item.edits.with(std::make_shared<const Edit>(anchored(std::move(operation), *old.clip)));
    item.clip = std::make_shared<const Clip>(std::move(clip).value());
    return item;
}

Result<Project> replaced(Project project, Result<ClipItem> item)
{
    if (!item)
        return item.error();
    return withItem(std::move(project), item->id, [&](ClipItem& old) { old = std::move(item).value(); });
}

std::vector<Edit> listOf(const EditList& edits)
{
    std::vector<Edit> all;
    for (const auto& edit : edits.whole())
        all.push_back(*edit);
    return all;
}

/// Gives a clip what became of its edits over another analysis; edits that are as they were stay shared.
void putReapplied(ClipItem& item, Reapplied reapplied)
{
    const auto old = item.edits.whole();
    std::vector<std::shared_ptr<const Edit>> edits;
    for (std::size_t i = 0; i < reapplied.edits.size(); ++i)
        edits.push_back(i < old.size() && *old[i] == reapplied.edits[i]
                            ? old[i]
                            : std::make_shared<const Edit>(std::move(reapplied.edits[i])));
    item.edits = EditList::of(edits, item.edits);
    item.unfitting = std::move(reapplied.unfitting);
    item.clip = std::make_shared<const Clip>(std::move(reapplied.clip));
}

/// Gives a new analysis of a sound the markers that the old one had and that it lacks, as far as it has room for them.
void keepMarkers(Clip& analysis, const Clip& old)
{
    if (old.markers.empty())
        return;
    FoundMarkers all{std::move(analysis.markers), {}};
    addMarkers(all, {old.markers, {}}, 0.0);
    std::erase_if(all.markers, [&](const Marker& marker) { return marker.time > analysis.duration; });
    analysis.markers = std::move(all.markers);
}

/// The id of a sound in a project, where it is put with its id if the same is not there yet.
int placeSound(Project& project, AudioReference sound)
{
    if (const AudioReference* known = sameSound(project, sound))
        return known->id;
    project.sources.push_back(std::move(sound));
    return project.sources.back().id;
}
} // namespace

const AudioReference* sameSound(const Project& project, const AudioReference& sound)
{
    for (const AudioReference& known : project.sources)
        if (known.hash == sound.hash && known.path == sound.path)
            return &known;
    return nullptr;
}

void addGroup(Project& project, const std::string& group)
{
    if (!group.empty() && std::find(project.groups.begin(), project.groups.end(), group) == project.groups.end())
        project.groups.push_back(group);
}

Result<Project> withEdit(Project project, int id, EditOperation operation)
{
    const auto old = project.find(id);
    if (!old)
        return noSuchClip(id);
    if (auto wrong = checkOperation(operation))
        return *wrong;
    return replaced(std::move(project), itemWith(*old, std::move(operation)));
}

Result<Project> withClip(Project project, int id, Clip edited, std::optional<EditOperation> first)
{
    const auto old = project.find(id);
    if (!old)
        return noSuchClip(id);
    if (first)
        if (auto wrong = checkOperation(*first))
            return *wrong;
    if (auto valid = validate(edited); !valid)
        return valid.error();
    auto item = first ? itemWith(*old, std::move(*first)) : *old;
    if (!item)
        return item.error();
    const auto before = item->clip;
    for (EditOperation& operation : editsBetween(*before, edited))
        item->edits = item->edits.with(std::make_shared<const Edit>(anchored(std::move(operation), *before)));
    if (item->edits.size() == old->edits.size())
        return project;
    item->clip = std::make_shared<const Clip>(std::move(edited));
    return replaced(std::move(project), std::move(item));
}

Result<Project> withoutEdits(Project project, int id, const std::vector<std::size_t>& edits)
{
    return withItem(std::move(project), id,
                    [&](ClipItem& item)
                    {
                        std::vector<Edit> kept;
                        const auto all = listOf(item.edits);
                        for (std::size_t i = 0; i < all.size(); ++i)
                            if (!std::binary_search(edits.begin(), edits.end(), i))
                                kept.push_back(all[i]);
                        putReapplied(item, reapply(*item.analysis, *item.analysis, kept));
                    });
}

Result<Project> withAnalysis(Project project, const EncoderParams& encoder, Reanalysis one, int newSource)
{
    if (auto valid = validate(encoder); !valid)
        return valid.error();
    const auto old = project.find(one.id);
    if (!old)
        return noSuchClip(one.id);
    if (auto valid = validate(one.analysis); !valid)
        return valid.error();
    ClipItem item = *old;
    item.encoder = encoder;
    if (one.sound)
    {
        one.sound->id = newSource;
        item.source = placeSound(project, std::move(*one.sound));
    }
    else
        keepMarkers(one.analysis, *old->analysis);
    putReapplied(item, reapply(*old->analysis, one.analysis, listOf(old->edits)));
    item.analysis = std::make_shared<const Clip>(std::move(one.analysis));
    return replaced(std::move(project), std::move(item));
}

Result<Project> withAnalyses(Project project, const EncoderParams& encoder, std::vector<Reanalysis> clips,
                             int newSource)
{
    for (Reanalysis& one : clips)
    {
        const bool sound = one.sound.has_value();
        auto next = withAnalysis(std::move(project), encoder, std::move(one), newSource);
        if (!next)
            return next;
        project = std::move(next).value();
        newSource += sound ? 1 : 0;
    }
    return project;
}

Result<Project> withRestored(Project project, ClipItem item)
{
    if (project.findSource(item.source) == nullptr)
        item.source = 0;
    return replaced(std::move(project), std::move(item));
}

Result<Project> withDuplicate(Project project, int id, int added)
{
    const auto old = project.find(id);
    if (!old)
        return noSuchClip(id);
    ClipItem item = *old;
    item.id = added;
    insertBehind(project, id, std::move(item));
    return project;
}

Result<Project> withSplit(Project project, int id, double time, int added)
{
    const auto old = project.find(id);
    if (!old)
        return noSuchClip(id);
    const double at = clampTo(time, 0.0, old->clip->duration);
    auto right = itemWith(*old, TrimEdit{{at, old->clip->duration}});
    auto next = replaced(std::move(project), itemWith(*old, TrimEdit{{0.0, at}}));
    if (!next || !right)
        return next ? right.error() : next.error();
    right->id = added;
    insertBehind(*next, id, std::move(right).value());
    return next;
}

Result<Project> withJoined(Project project, int id, int other)
{
    const auto first = project.find(id);
    const auto second = project.find(other);
    if (!first || !second || id == other)
        return noSuchClip(first ? other : id);
    std::erase(project.clips, second);
    return replaced(std::move(project), itemWith(*first, InsertEdit{first->clip->duration, second->clip}));
}

Result<Project> withoutClips(Project project, const std::vector<int>& ids)
{
    for (const int id : ids)
        if (!project.find(id))
            return noSuchClip(id);
    std::erase_if(project.clips,
                  [&](const auto& item) { return std::find(ids.begin(), ids.end(), item->id) != ids.end(); });
    return project;
}

Result<Project> withPlaced(Project project, int id, std::size_t index, const std::string& group)
{
    auto next = withGroup(std::move(project), {id}, group);
    if (!next)
        return next;
    auto& clips = next->clips;
    const auto moved = next->find(id);
    std::erase(clips, moved);
    clips.insert(clips.begin() + static_cast<std::ptrdiff_t>(std::min(index, clips.size())), moved);
    return next;
}

Result<Project> withGroup(Project project, const std::vector<int>& ids, const std::string& group)
{
    addGroup(project, group);
    return withItems(std::move(project), ids, [&](ClipItem& item) { item.group = group; });
}

Project withGroupRenamed(Project project, const std::string& from, const std::string& to)
{
    auto& groups = project.groups;
    const bool known = to.empty() || std::find(groups.begin(), groups.end(), to) != groups.end();
    if (known)
        std::erase(groups, from);
    else
        std::replace(groups.begin(), groups.end(), from, to);
    for (auto& place : project.clips)
        if (place->group == from)
        {
            ClipItem item = *place;
            item.group = to;
            place = shared(std::move(item));
        }
    return project;
}

Project withGroups(Project project, std::vector<std::string> groups)
{
    project.groups = std::move(groups);
    return project;
}

Result<Project> withNotes(Project project, int id, const std::string& notes)
{
    return withItem(std::move(project), id, [&](ClipItem& item) { item.notes = notes; });
}

Result<Project> withTags(Project project, const std::vector<int>& ids, const std::vector<std::string>& tags)
{
    return withItems(std::move(project), ids, [&](ClipItem& item) { item.tags = tags; });
}

Project withProjectNotes(Project project, std::string notes)
{
    project.notes = std::move(notes);
    return project;
}

Result<Project> withScene(Project project, ProjectScene scene)
{
    if (auto valid = validate(scene); !valid)
        return valid.error();
    project.scene = std::move(scene);
    return project;
}

Result<Project> withSounds(Project project, std::vector<AudioReference> sounds)
{
    for (AudioReference& sound : sounds)
    {
        const auto known = std::find_if(project.sources.begin(), project.sources.end(),
                                        [&](const AudioReference& one) { return one.id == sound.id; });
        if (known == project.sources.end())
            return Error{ErrorCode::invalidArgument, "sound", "is not one of the project's sounds"};
        *known = std::move(sound);
    }
    return project;
}

} // namespace pacini
