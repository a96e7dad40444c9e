#include "document/Amendments.h"

#include "document/ProjectEdits.h"
#include "document/ProjectScene.h"

#include <memory>
#include <utility>
#include <vector>

namespace pacini
{

namespace
{
/// A clip that is its own analysis.
std::shared_ptr<ClipItem> newItem(int id, Clip clip)
{
    auto item = std::make_shared<ClipItem>();
    item->id = id;
    item->clip = item->analysis = std::make_shared<const Clip>(std::move(clip));
    return item;
}
} // namespace

Result<int> addClip(Document& document, Clip clip)
{
    if (auto valid = validate(clip); !valid)
        return valid.error();
    const int id = document.steps().newIds().clip;
    document.amend({newItem(id, std::move(clip))}, [](Project&) {});
    return id;
}

Result<int> addSound(Document& document, AudioReference sound, const EncoderParams& encoder, Clip analysis)
{
    if (auto valid = validate(analysis); !valid)
        return valid.error();
    if (auto valid = validate(encoder); !valid)
        return valid.error();
    const NewIds ids = document.steps().newIds();
    const auto item = newItem(ids.clip, std::move(analysis));
    item->encoder = encoder;
    sound.id = ids.source;
    if (const AudioReference* known = sameSound(document.project(), sound))
        sound = *known;
    item->source = sound.id;
    document.amend({item},
                   [&](Project& project)
                   {
                       if (project.findSource(sound.id) == nullptr)
                           project.sources.push_back(sound);
                   });
    return ids.clip;
}

Result<void> setProfile(Document& document, const ProjectProfile& profile)
{
    if (!isStrength(profile.strength))
        return Error{ErrorCode::invalidArgument, "strength", "must be 0 to 1"};
    if (profile.embedded)
        if (auto valid = validate(*profile.embedded); !valid)
            return valid.error();
    if (profile != document.project().profile)
        document.amend({}, [&](Project& project) { project.profile = profile; });
    return {};
}

Result<void> openScene(Document& document, const Scene& scene, const std::string& group, std::string name)
{
    if (auto valid = validate(scene); !valid)
        return valid;
    std::vector<std::shared_ptr<const ClipItem>> items;
    std::vector<int> ids;
    int id = document.steps().newIds().clip;
    for (const Clip& clip : scene.clips)
    {
        auto item = newItem(id, clip);
        item->group = group;
        ids.push_back(id++);
        items.push_back(std::move(item));
    }
    const auto put = [&, made = projectSceneOf(scene, ids)](Project& project)
    {
        addGroup(project, group);
        project.scene = made;
    };
    if (document.project().scene.parts.empty())
    {
        document.amend(items, put);
        return {};
    }
    Project next = document.project();
    next.clips.insert(next.clips.end(), items.begin(), items.end());
    put(next);
    return document.commit(std::move(name), std::move(next));
}

} // namespace pacini
