#include "document/Document.h"
#include "document/EditLayer.h"
#include "document/ItemEdits.h"

#include <pacini/clip/edits/TimeEdits.h>

#include <algorithm>
#include <utility>

// The clips of an open project: added, removed, moved and named.

namespace pacini
{

int Document::nextClipId() const
{
    int id = 1;
    for (const auto& item : content.clips)
        id = std::max(id, item->id + 1);
    return id;
}

Result<int> Document::addClip(std::string name, Clip clip)
{
    if (auto valid = validate(clip); !valid)
        return valid.error();
    ClipItem item;
    item.id = nextClipId();
    item.clip = item.analysis = std::make_shared<const Clip>(std::move(clip));
    Project next = content;
    const int id = item.id;
    next.clips.push_back(std::make_shared<const ClipItem>(std::move(item)));
    commit(std::move(name), std::move(next));
    return id;
}

Result<int> Document::addSound(std::string name, AudioReference sound, const EncoderParams& encoder, Clip analysis)
{
    if (auto valid = validate(analysis); !valid)
        return valid.error();
    if (auto valid = validate(encoder); !valid)
        return valid.error();
    Project next = content;
    ClipItem item;
    item.id = nextClipId();
    item.source = placeSound(next, std::move(sound));
    item.encoder = encoder;
    item.clip = item.analysis = std::make_shared<const Clip>(std::move(analysis));
    const int id = item.id;
    next.clips.push_back(std::make_shared<const ClipItem>(std::move(item)));
    commit(std::move(name), std::move(next));
    return id;
}

Result<void> Document::replaceItem(ClipItem item, std::string name)
{
    Project next = content;
    for (auto& place : next.clips)
        if (place->id == item.id)
        {
            place = std::make_shared<const ClipItem>(std::move(item));
            commit(std::move(name), std::move(next));
            return {};
        }
    return noSuchClip(item.id);
}

Result<int> Document::duplicateClip(int id, std::string name)
{
    const auto old = clip(id);
    if (!old)
        return noSuchClip(id);
    ClipItem item = *old;
    item.id = nextClipId();
    const int added = item.id;
    Project next = content;
    const auto place = std::find(next.clips.begin(), next.clips.end(), old);
    next.clips.insert(place + 1, std::make_shared<const ClipItem>(std::move(item)));
    commit(std::move(name), std::move(next));
    return added;
}

Result<void> Document::removeClip(int id, std::string name)
{
    if (!clip(id))
        return noSuchClip(id);
    Project next = content;
    std::erase_if(next.clips, [&](const auto& item) { return item->id == id; });
    commit(std::move(name), std::move(next));
    return {};
}

Result<void> Document::moveClip(int id, std::size_t index, std::string name)
{
    const auto moved = clip(id);
    if (!moved)
        return noSuchClip(id);
    Project next = content;
    std::erase(next.clips, moved);
    const std::size_t place = std::min(index, next.clips.size());
    next.clips.insert(next.clips.begin() + static_cast<std::ptrdiff_t>(place), moved);
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
    const int added = nextClipId();
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

Result<void> Document::setGroup(int id, std::string group, std::string name)
{
    const auto old = clip(id);
    if (!old)
        return noSuchClip(id);
    ClipItem item = *old;
    item.group = std::move(group);
    return replaceItem(std::move(item), std::move(name));
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

} // namespace pacini
