#include "document/ItemEdits.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

namespace pacini
{

namespace
{
EditList sharedList(std::vector<Edit> edits, const EditList& before)
{
    const auto old = before.whole();
    std::vector<std::shared_ptr<const Edit>> shared;
    for (std::size_t i = 0; i < edits.size(); ++i)
        shared.push_back(i < old.size() && *old[i] == edits[i] ? old[i]
                                                               : std::make_shared<const Edit>(std::move(edits[i])));
    return EditList::of(shared, before);
}
} // namespace

Error noSuchClip(int id)
{
    return {ErrorCode::invalidArgument, "clip", "there is no clip " + std::to_string(id) + " in this project"};
}

EditList withEdits(EditList list, std::vector<Edit> edits)
{
    for (Edit& edit : edits)
        list = list.with(std::make_shared<const Edit>(std::move(edit)));
    return list;
}

std::vector<Edit> listOf(const EditList& edits)
{
    std::vector<Edit> all;
    for (const auto& edit : edits.whole())
        all.push_back(*edit);
    return all;
}

void putReapplied(ClipItem& item, Reapplied reapplied)
{
    item.edits = sharedList(std::move(reapplied.edits), item.edits);
    item.unfitting = std::move(reapplied.unfitting);
    item.clip = std::make_shared<const Clip>(std::move(reapplied.clip));
}

const AudioReference* sameSound(const Project& project, const AudioReference& sound)
{
    for (const AudioReference& known : project.sources)
        if (known.hash == sound.hash && known.path == sound.path)
            return &known;
    return nullptr;
}

int placeSound(Project& project, AudioReference sound)
{
    if (const AudioReference* known = sameSound(project, sound))
        return known->id;
    project.sources.push_back(std::move(sound));
    return project.sources.back().id;
}

} // namespace pacini
