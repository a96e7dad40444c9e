#include "document/Document.h"
#include "document/EditLayer.h"
#include "document/EditsBetween.h"
#include "document/ItemEdits.h"
#include "document/OperationCheck.h"

#include <algorithm>
#include <utility>

// The hand edits of an open project.

namespace pacini
{

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
    for (auto& place : next.clips)
        if (place->id == id)
            place = std::make_shared<const ClipItem>(std::move(item));
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

Result<void> Document::reanalyse(int id, std::string name, const EncoderParams& encoder, Clip analysis,
                                 std::optional<AudioReference> sound)
{
    const auto old = clip(id);
    if (!old)
        return noSuchClip(id);
    if (auto valid = validate(analysis); !valid)
        return valid.error();
    if (auto valid = validate(encoder); !valid)
        return valid.error();
    Project next = content;
    ClipItem item = *old;
    item.encoder = encoder;
    if (sound)
        item.source = placeSound(next, std::move(*sound));
    putReapplied(item, reapply(*old->analysis, analysis, listOf(old->edits)));
    item.analysis = std::make_shared<const Clip>(std::move(analysis));
    for (auto& place : next.clips)
        if (place == old)
            place = std::make_shared<const ClipItem>(std::move(item));
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
