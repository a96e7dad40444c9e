#include "document/Document.h"

#include "document/EditLayer.h"
#include "document/EditsBetween.h"
#include "document/ItemEdits.h"
#include "document/OperationCheck.h"
#include "document/ProjectJson.h"
#include "document/ProjectScene.h"
#include "io/AtomicFile.h"
#include "io/FoundMarkers.h"
#include "io/InputFile.h"

#include <pacini/clip/edits/TimeEdits.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
/// Puts `item` in the place of the clip with its id; false where there is none.
bool replaceClip(Project& project, ClipItem item)
{
    for (auto& place : project.clips)
        if (place->id == item.id)
        {
            place = std::make_shared<const ClipItem>(std::move(item));
            return true;
        }
    return false;
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
} // namespace

Document::Document(Project project, fs::path path, bool saved)
    : content(std::move(project)), file(std::move(path)), history(content), savedState(saved ? history.id() : 0)
{
    countIds();
}

Result<Document> Document::open(const fs::path& path)
{
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error).lexically_normal();
    const auto text = readWholeFile(absolute, largestProjectText);
    if (!text)
        return text.error();
    auto read = readProjectJson(*text, absolute.parent_path());
    if (!read)
        return read.error();
    return Document(std::move(read->project), absolute, true);
}

Result<Document> Document::recover(const fs::path& recoveryFile)
{
    const auto text = readWholeFile(recoveryFile, largestProjectText);
    if (!text)
        return text.error();
    auto read = readProjectJson(*text, recoveryFile.parent_path());
    if (!read)
        return read.error();
    const std::string path = read->recovery ? read->recovery->path : "";
    return Document(std::move(read->project), fs::path(std::u8string(path.begin(), path.end())), false);
}

Result<void> Document::save()
{
    if (file.empty())
        return Error{ErrorCode::invalidArgument, "", "the project has not been saved yet; choose a file"};
    return saveAs(file);
}

Result<void> Document::saveAs(const fs::path& path)
{
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error).lexically_normal();
    ProjectTextOptions options;
    options.folder = absolute.parent_path();
    if (auto written = writeFileAtomically(absolute, std::string_view(projectJson(content, options))); !written)
        return written.error();
    file = absolute;
    savedState = history.id();
    return {};
}

void Document::commit(std::string name, Project project, Gesture gesture)
{
    const bool continues = gesture != 0 && gesture == openGesture && history.canUndo() && !history.canRedo();
    if (!continues)
        beforeGesture = gesture != 0 ? content : Project{};
    content = std::move(project);
    countIds();
    if (continues)
        history.replaceNewest(content);
    else
        history.push(std::move(name), content);
    openGesture = gesture;
}

void Document::amend(const std::shared_ptr<const ClipItem>& added, const std::function<void(Project&)>& change)
{
    const auto both = [&](Project& project)
    {
        change(project);
        if (added)
            project.clips.push_back(added);
    };
    both(content);
    if (openGesture != 0)
        both(beforeGesture);
    countIds();
    history.amend(content, added, change);
}

/// After every change: each state was the current one once.
void Document::countIds()
{
    for (const auto& item : content.clips)
        nextClipId = std::max(nextClipId, item->id + 1);
    for (const AudioReference& source : content.sources)
        nextSourceId = std::max(nextSourceId, source.id + 1);
}

void Document::setProjectNotes(std::string notes, std::string name)
{
    Project next = content;
    next.notes = std::move(notes);
    commit(std::move(name), std::move(next));
}

void Document::setGroups(std::vector<std::string> groups, std::string name)
{
    Project next = content;
    next.groups = std::move(groups);
    commit(std::move(name), std::move(next));
}

void Document::renameGroup(const std::string& from, const std::string& to, std::string name)
{
    Project next = content;
    const bool known = to.empty() || std::find(next.groups.begin(), next.groups.end(), to) != next.groups.end();
    if (known)
        std::erase(next.groups, from);
    else
        std::replace(next.groups.begin(), next.groups.end(), from, to);
    for (auto& place : next.clips)
        if (place->group == from)
        {
            auto item = std::make_shared<ClipItem>(*place);
            item->group = to;
            place = std::move(item);
        }
    commit(std::move(name), std::move(next));
}

Result<void> Document::setProfile(ProjectProfile profile)
{
    if (!isStrength(profile.strength))
        return Error{ErrorCode::invalidArgument, "strength", "must be 0 to 1"};
    if (profile.embedded)
        if (auto valid = validate(*profile.embedded); !valid)
            return valid.error();
    if (profile != content.profile)
        amend(nullptr, [&](Project& project) { project.profile = profile; });
    return {};
}

Result<void> Document::setSound(AudioReference sound, std::string name)
{
    std::vector<AudioReference> one;
    one.push_back(std::move(sound));
    return setSounds(std::move(one), std::move(name));
}

Result<void> Document::setSounds(std::vector<AudioReference> sounds, std::string name)
{
    Project next = content;
    for (AudioReference& sound : sounds)
    {
        const auto known = std::find_if(next.sources.begin(), next.sources.end(),
                                        [&](const AudioReference& one) { return one.id == sound.id; });
        if (known == next.sources.end())
            return Error{ErrorCode::invalidArgument, "sound", "is not one of the project's sounds"};
        *known = std::move(sound);
    }
    commit(std::move(name), std::move(next));
    return {};
}

void Document::goTo(std::size_t state)
{
    openGesture = 0;
    content = history.goTo(std::min(state, history.size() - 1));
}

bool Document::undo()
{
    if (!canUndo())
        return false;
    goTo(history.current() - 1);
    return true;
}

bool Document::redo()
{
    if (!canRedo())
        return false;
    goTo(history.current() + 1);
    return true;
}

// Clips.

Result<int> Document::addClip(Clip clip)
{
    if (auto valid = validate(clip); !valid)
        return valid.error();
    auto item = std::make_shared<ClipItem>();
    item->id = nextClipId;
    item->clip = item->analysis = std::make_shared<const Clip>(std::move(clip));
    amend(item, [](Project&) {});
    return item->id;
}

Result<int> Document::addSound(AudioReference sound, const EncoderParams& encoder, Clip analysis)
{
    if (auto valid = validate(analysis); !valid)
        return valid.error();
    if (auto valid = validate(encoder); !valid)
        return valid.error();
    auto item = std::make_shared<ClipItem>();
    item->id = nextClipId;
    item->encoder = encoder;
    item->clip = item->analysis = std::make_shared<const Clip>(std::move(analysis));
    sound.id = nextSourceId;
    if (const AudioReference* known = sameSound(content, sound))
        sound = *known;
    item->source = sound.id;
    amend(item,
          [&](Project& project)
          {
              if (project.findSource(sound.id) == nullptr)
                  project.sources.push_back(sound);
          });
    return item->id;
}

Result<void> Document::replaceItem(ClipItem item, std::string name)
{
    Project next = content;
    const int id = item.id;
    if (!replaceClip(next, std::move(item)))
        return noSuchClip(id);
    commit(std::move(name), std::move(next));
    return {};
}

Result<int> Document::duplicateClip(int id, std::string name)
{
    const auto old = clip(id);
    if (!old)
        return noSuchClip(id);
    ClipItem item = *old;
    item.id = nextClipId;
    const int added = item.id;
    Project next = content;
    const auto place = std::find(next.clips.begin(), next.clips.end(), old);
    next.clips.insert(place + 1, std::make_shared<const ClipItem>(std::move(item)));
    commit(std::move(name), std::move(next));
    return added;
}

Result<void> Document::removeClip(int id, std::string name)
{
    return removeClips(std::span(&id, 1), std::move(name));
}

Result<void> Document::removeClips(std::span<const int> ids, std::string name)
{
    for (const int id : ids)
        if (!clip(id))
            return noSuchClip(id);
    Project next = content;
    std::erase_if(next.clips,
                  [&](const auto& item) { return std::find(ids.begin(), ids.end(), item->id) != ids.end(); });
    commit(std::move(name), std::move(next));
    return {};
}

Result<void> Document::placeClip(int id, std::size_t index, std::string group, std::string name)
{
    const auto old = clip(id);
    if (!old)
        return noSuchClip(id);
    Project next = content;
    if (!group.empty() && std::find(next.groups.begin(), next.groups.end(), group) == next.groups.end())
        next.groups.push_back(group);
    auto moved = std::make_shared<ClipItem>(*old);
    moved->group = std::move(group);
    std::erase(next.clips, old);
    const std::size_t place = std::min(index, next.clips.size());
    next.clips.insert(next.clips.begin() + static_cast<std::ptrdiff_t>(place), std::move(moved));
    commit(std::move(name), std::move(next));
    return {};
}

Result<int> Document::splitClipAt(int id, double time, std::string name)
{
    const auto old = clip(id);
    if (!old)
        return noSuchClip(id);
    const double at = clampTo(time, 0.0, old->clip->duration);
    const auto part = [&](int itsId, TimeRange range) -> Result<std::shared_ptr<const ClipItem>>
    {
        ClipItem item = *old;
        item.id = itsId;
        EditOperation trim = TrimEdit{range};
        auto trimmed = applyEdit(*old->clip, trim);
        if (!trimmed)
            return trimmed.error();
        std::vector<Edit> edits;
        edits.push_back(anchored(std::move(trim), *old->clip));
        item.edits = withEdits(item.edits, std::move(edits));
        item.clip = std::make_shared<const Clip>(std::move(trimmed).value());
        return std::shared_ptr<const ClipItem>(std::make_shared<const ClipItem>(std::move(item)));
    };
    const int added = nextClipId;
    const auto left = part(id, {0.0, at});
    const auto right = part(added, {at, old->clip->duration});
    if (!left || !right)
        return left ? right.error() : left.error();
    Project next = content;
    const auto place = std::find(next.clips.begin(), next.clips.end(), old);
    *place = *left;
    next.clips.insert(place + 1, *right);
    commit(std::move(name), std::move(next));
    return added;
}

Result<void> Document::joinClip(int id, int other, std::string name)
{
    const auto first = clip(id);
    const auto second = clip(other);
    if (!first || !second || id == other)
        return noSuchClip(first ? other : id);
    EditOperation join = InsertEdit{first->clip->duration, second->clip};
    auto joined = applyEdit(*first->clip, join);
    if (!joined)
        return joined.error();
    std::vector<Edit> edits;
    edits.push_back(anchored(std::move(join), *first->clip));
    ClipItem item = *first;
    item.edits = withEdits(item.edits, std::move(edits));
    item.clip = std::make_shared<const Clip>(std::move(joined).value());
    Project next = content;
    std::replace(next.clips.begin(), next.clips.end(), first,
                 std::shared_ptr<const ClipItem>(std::make_shared<const ClipItem>(std::move(item))));
    std::erase(next.clips, second);
    commit(std::move(name), std::move(next));
    return {};
}

Result<void> Document::setGroup(std::span<const int> ids, const std::string& group, std::string name)
{
    Project next = content;
    if (!group.empty() && std::find(next.groups.begin(), next.groups.end(), group) == next.groups.end())
        next.groups.push_back(group);
    for (const int id : ids)
    {
        const auto found =
            std::find_if(next.clips.begin(), next.clips.end(), [id](const auto& item) { return item->id == id; });
        if (found == next.clips.end())
            return noSuchClip(id);
        auto moved = std::make_shared<ClipItem>(**found);
        moved->group = group;
        *found = std::move(moved);
    }
    commit(std::move(name), std::move(next));
    return {};
}

Result<void> Document::openScene(const Scene& scene, const std::string& group, std::string name)
{
    if (auto valid = validate(scene); !valid)
        return valid;
    std::vector<std::shared_ptr<const ClipItem>> items;
    std::vector<int> ids;
    for (const Clip& clip : scene.clips)
    {
        auto item = std::make_shared<ClipItem>();
        item->id = nextClipId + static_cast<int>(items.size());
        item->group = group;
        item->clip = item->analysis = std::make_shared<const Clip>(clip);
        ids.push_back(item->id);
        items.push_back(std::move(item));
    }
    const auto put = [&, made = projectSceneOf(scene, ids)](Project& project)
    {
        if (!group.empty() && std::find(project.groups.begin(), project.groups.end(), group) == project.groups.end())
            project.groups.push_back(group);
        project.scene = made;
    };
    if (content.scene.parts.empty())
    {
        for (const auto& item : items)
            amend(item, [](Project&) {});
        amend(nullptr, put);
        return {};
    }
    Project next = content;
    next.clips.insert(next.clips.end(), items.begin(), items.end());
    put(next);
    commit(std::move(name), std::move(next));
    return {};
}

Result<void> Document::setScene(ProjectScene scene, std::string name, Gesture gesture)
{
    if (auto valid = validate(scene); !valid)
        return valid;
    Project next = gesture != 0 && gesture == openGesture ? beforeGesture : content;
    next.scene = std::move(scene);
    commit(std::move(name), std::move(next), gesture);
    return {};
}

Result<void> Document::setNotes(int id, std::string notes, std::string name)
{
    const auto old = clip(id);
    if (!old)
        return noSuchClip(id);
    ClipItem item = *old;
    item.notes = std::move(notes);
    return replaceItem(std::move(item), std::move(name));
}

Result<void> Document::setTags(const std::vector<int>& ids, const std::vector<std::string>& tags, std::string name)
{
    Project next = content;
    for (const int id : ids)
    {
        const auto old = clip(id);
        if (!old)
            return noSuchClip(id);
        ClipItem item = *old;
        item.tags = tags;
        replaceClip(next, std::move(item));
    }
    commit(std::move(name), std::move(next));
    return {};
}

// Hand edits.

std::shared_ptr<const Clip> Document::gestureStart(int id, Gesture gesture) const
{
    const bool continues = gesture != 0 && gesture == openGesture;
    const auto item = (continues ? beforeGesture : content).find(id);
    return item ? item->clip : nullptr;
}

Result<void> Document::change(int id, std::string name, std::vector<Edit> edits, Clip edited, Gesture gesture)
{
    const bool continues = gesture != 0 && gesture == openGesture;
    const Project& start = continues ? beforeGesture : content;
    ClipItem item = *start.find(id);
    item.edits = withEdits(item.edits, std::move(edits));
    item.clip = std::make_shared<const Clip>(std::move(edited));
    Project next = start;
    replaceClip(next, std::move(item));
    commit(std::move(name), std::move(next), gesture);
    return {};
}

Result<void> Document::edit(int id, std::string name, EditOperation operation, Gesture gesture)
{
    const auto start = gestureStart(id, gesture);
    if (!start)
        return noSuchClip(id);
    if (auto wrong = checkOperation(operation))
        return *wrong;
    auto edited = applyEdit(*start, operation);
    if (!edited)
        return edited.error();
    std::vector<Edit> edits;
    edits.push_back(anchored(std::move(operation), *start));
    return change(id, std::move(name), std::move(edits), std::move(edited).value(), gesture);
}

Result<void> Document::setClip(int id, std::string name, Clip edited, Gesture gesture)
{
    const auto start = gestureStart(id, gesture);
    if (!start)
        return noSuchClip(id);
    if (auto valid = validate(edited); !valid)
        return valid.error();
    std::vector<Edit> edits;
    for (EditOperation& operation : editsBetween(*start, edited))
        edits.push_back(anchored(std::move(operation), *start));
    if (edits.empty() && (gesture == 0 || gesture != openGesture))
        return {};
    return change(id, std::move(name), std::move(edits), std::move(edited), gesture);
}

Result<void> Document::setClip(int id, std::string name, EditOperation first, Clip edited)
{
    const auto start = clip(id);
    if (!start)
        return noSuchClip(id);
    if (auto wrong = checkOperation(first))
        return *wrong;
    if (auto valid = validate(edited); !valid)
        return valid.error();
    const auto between = applyEdit(*start->clip, first);
    if (!between)
        return between.error();
    std::vector<Edit> edits;
    edits.push_back(anchored(std::move(first), *start->clip));
    for (EditOperation& operation : editsBetween(*between, edited))
        edits.push_back(anchored(std::move(operation), *between));
    return change(id, std::move(name), std::move(edits), std::move(edited), 0);
}

Result<void> Document::restoreClip(ClipItem item, std::string name)
{
    if (content.findSource(item.source) == nullptr)
        item.source = 0;
    return replaceItem(std::move(item), std::move(name));
}

Result<void> Document::reanalyse(int id, std::string name, const EncoderParams& encoder, Clip analysis,
                                 std::optional<AudioReference> sound)
{
    std::vector<Reanalysis> one;
    one.push_back({id, std::move(analysis), std::move(sound)});
    return reanalyse(std::move(one), std::move(name), encoder);
}

Result<void> Document::reanalyse(std::vector<Reanalysis> clips, std::string name, const EncoderParams& encoder)
{
    if (auto valid = validate(encoder); !valid)
        return valid.error();
    Project next = content;
    int newSource = nextSourceId;
    for (Reanalysis& one : clips)
    {
        const auto old = clip(one.id);
        if (!old)
            return noSuchClip(one.id);
        if (auto valid = validate(one.analysis); !valid)
            return valid.error();
        ClipItem item = *old;
        item.encoder = encoder;
        if (!one.sound)
            keepMarkers(one.analysis, *old->analysis);
        if (one.sound)
        {
            one.sound->id = newSource++;
            item.source = placeSound(next, std::move(*one.sound));
        }
        putReapplied(item, reapply(*old->analysis, one.analysis, listOf(old->edits)));
        item.analysis = std::make_shared<const Clip>(std::move(one.analysis));
        replaceClip(next, std::move(item));
    }
    commit(std::move(name), std::move(next));
    return {};
}

Result<void> Document::removeEdits(int id, std::string name, const std::vector<std::size_t>& edits)
{
    const auto old = clip(id);
    if (!old)
        return noSuchClip(id);
    std::vector<Edit> kept;
    const auto all = listOf(old->edits);
    for (std::size_t i = 0; i < all.size(); ++i)
        if (!std::binary_search(edits.begin(), edits.end(), i))
            kept.push_back(all[i]);
    ClipItem item = *old;
    putReapplied(item, reapply(*old->analysis, *old->analysis, kept));
    return replaceItem(std::move(item), std::move(name));
}

} // namespace pacini
