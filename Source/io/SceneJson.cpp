#include "io/SceneJson.h"

#include "io/FieldsHandler.h"
#include "io/FieldsWriter.h"
#include "io/JsonText.h"
#include "io/SceneFields.h"

#include <pacini/clip/Clip.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace pacini
{

namespace
{
/// A file name fit for an error message: all of it, control characters as '?'.
std::string onOneLine(std::string name)
{
    std::replace_if(
        name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, '?');
    return name;
}

/// Names and their indices.
class Names
{
public:
    static constexpr std::size_t several = SIZE_MAX;

    void add(const std::string& name, std::size_t index)
    {
        if (name.empty())
            return;
        const auto [entry, first] = indices.emplace(name, index);
        if (!first && entry->second != index)
            entry->second = several;
    }
    [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const
    {
        const auto entry = indices.find(name);
        return entry == indices.end() ? std::nullopt : std::optional(entry->second);
    }

private:
    std::map<std::string, std::size_t> indices;
};

/// A number as an index into `size` elements, if it is one.
std::optional<std::size_t> indexOf(double number, std::size_t size)
{
    if (!(number >= 0.0 && number < static_cast<double>(size) && std::trunc(number) == number))
        return std::nullopt;
    return static_cast<std::size_t>(number);
}

/// Puts the clips of a draft into its scene and finds those that are named.
class SceneClips
{
public:
    SceneClips(Scene& sceneToFill, const ClipLoader& clipLoader) : scene(sceneToFill), load(clipLoader) {}

    Result<void> addAll(std::vector<sceneFields::DraftClip>& drafts)
    {
        for (std::size_t i = 0; i < drafts.size(); ++i)
        {
            const std::string where = detail::indexed("clips", i);
            if (drafts[i].embedded)
            {
                listed.push_back(scene.clips.size());
                if (auto added = add(std::move(*drafts[i].embedded), where); !added)
                    return added;
            }
            else
            {
                const auto index = fileIndex(drafts[i].file, where, "");
                if (!index)
                    return index.error();
                listed.push_back(*index);
            }
        }
        return {};
    }

    Result<std::size_t> find(const sceneFields::Reference& reference, const std::string& where)
    {
        if (const auto* number = std::get_if<double>(&reference))
        {
            if (const auto index = indexOf(*number, listed.size()))
                return listed[*index];
            return Error{ErrorCode::invalidData, where,
                         fmt::format("is {}, but the scene has {} clips, counted from 0", *number, listed.size())};
        }
        const auto& name = std::get<std::string>(reference);
        for (const Names* names : {&files, &fileNames, &clipNames})
            if (const auto index = names->find(name))
            {
                if (*index == Names::several)
                    return Error{
                        ErrorCode::invalidData, where,
                        fmt::format("is \"{}\", the name of several clips; give the index of one", shownText(name))};
                return *index;
            }
        return fileIndex(name, where, "is not one of the scene's clips, and as a file it ");
    }

private:
    Result<void> add(Clip&& newcomer, const std::string& where)
    {
        points += breakpointCount(newcomer) + newcomer.transients.size();
        if (points > limits::points)
            return Error{ErrorCode::tooLarge, where, "brings the scene beyond 50000000 points in all clips together"};
        clipNames.add(newcomer.name, scene.clips.size());
        scene.clips.push_back(std::move(newcomer));
        return {};
    }

    /// The index of a file's clip, which is read when it is not there yet. `prefix` comes before what is wrong with it.
    Result<std::size_t> fileIndex(const std::string& file, const std::string& where, const std::string& prefix)
    {
        const std::filesystem::path path(file);
        const std::string normal = path.lexically_normal().string();
        const auto known = files.find(normal);
        const std::size_t index = known.value_or(scene.clips.size());
        if (!known)
        {
            auto read = load(file);
            if (!read)
                return Error{read.error().code, where, onOneLine(file) + ": " + prefix + read.error().text()};
            if (auto added = add(std::move(*read), where); !added)
                return added.error();
        }
        files.add(normal, index);
        files.add(file, index);
        fileNames.add(path.filename().string(), index);
        return index;
    }

    Scene& scene;
    const ClipLoader& load;
    std::vector<std::size_t> listed; // for each entry of the list its clip in the scene
    Names files, fileNames, clipNames;
    std::size_t points = 0;
};

/// Puts the textures of a draft into its scene and finds those that are named.
class SceneTextures
{
public:
    SceneTextures(Scene& sceneToFill, const TextureLoader& textureLoader) : scene(sceneToFill), load(textureLoader) {}

    Result<void> addAll(std::vector<sceneFields::DraftTexture>& drafts)
    {
        for (std::size_t i = 0; i < drafts.size(); ++i)
            if (drafts[i].embedded)
            {
                names.add(drafts[i].embedded->name, scene.textures.size());
                scene.textures.push_back(std::move(*drafts[i].embedded));
            }
            else if (auto added = addFile(drafts[i].file, detail::indexed("textures", i), ""); !added)
                return added.error();
        return {};
    }

    Result<std::size_t> find(const sceneFields::Reference& reference, const std::string& where)
    {
        if (const auto* number = std::get_if<double>(&reference))
        {
            if (const auto index = indexOf(*number, scene.textures.size()))
                return *index;
            return Error{
                ErrorCode::invalidData, where,
                fmt::format("is {}, but the scene has {} textures, counted from 0", *number, scene.textures.size())};
        }
        const auto& name = std::get<std::string>(reference);
        for (const Names* list : {&files, &names})
            if (const auto index = list->find(name))
            {
                if (*index == Names::several)
                    return Error{
                        ErrorCode::invalidData, where,
                        fmt::format("is \"{}\", the name of several textures; give the index of one", shownText(name))};
                return *index;
            }
        return addFile(name, where, "is not one of the scene's textures, and as a file it ");
    }

private:
    Result<std::size_t> addFile(const std::string& file, const std::string& where, const std::string& prefix)
    {
        if (!load)
            return Error{ErrorCode::invalidData, where,
                         onOneLine(file) + ": texture files are not read here; embed it"};
        auto read = load(file);
        if (!read)
            return Error{read.error().code, where, onOneLine(file) + ": " + prefix + read.error().text()};
        const std::size_t index = scene.textures.size();
        files.add(file, index);
        files.add(std::filesystem::path(file).filename().string(), index);
        names.add(read->name, index);
        scene.textures.push_back(std::move(*read));
        return index;
    }

    Scene& scene;
    const TextureLoader& load;
    Names files, names;
};

Result<Scene> resolve(sceneFields::Draft draft, const ClipLoader& load, const TextureLoader& loadTexture)
{
    Scene scene = std::move(static_cast<Scene&>(draft));
    SceneClips clips(scene, load);
    if (auto added = clips.addAll(draft.clips); !added)
        return added.error();
    SceneTextures textures(scene, loadTexture);
    if (auto added = textures.addAll(draft.textures); !added)
        return added.error();
    Names names;
    for (std::size_t i = 0; i < draft.plays.size(); ++i)
    {
        const sceneFields::DraftPlay& named = draft.plays[i];
        ScenePlay& play = scene.plays.emplace_back(named);
        const std::string where = detail::indexed("plays", i);
        if (named.texture)
        {
            const auto texture = textures.find(*named.texture, where + ".texture");
            if (!texture)
                return texture.error();
            play.texture = *texture;
        }
        auto index = Result<std::size_t>(scene.clips.size());
        if (named.clip)
            index = clips.find(*named.clip, where + ".clip");
        else
        {
            Clip silent;
            silent.name = scene.textures[*play.texture].name;
            silent.duration = named.duration;
            scene.clips.push_back(std::move(silent));
        }
        if (!index)
            return index.error();
        play.clip = *index;
        if (named.loopsAll)
            play.loop = scene.clips[*index].duration;
        names.add(play.name, i);
    }
    for (std::size_t i = 0; i < draft.changes.size(); ++i)
    {
        const sceneFields::DraftChange& change = draft.changes[i];
        const auto wrong = [&](std::string message)
        {
            return Error{ErrorCode::invalidData, detail::indexed("changes", i) + ".play", std::move(message)};
        };
        std::optional<std::size_t> index;
        if (const auto* number = std::get_if<double>(&change.play))
        {
            index = indexOf(*number, scene.plays.size());
            if (!index)
                return wrong(
                    fmt::format("is {}, but the scene has {} plays, counted from 0", *number, scene.plays.size()));
        }
        else
        {
            const auto& name = std::get<std::string>(change.play);
            index = names.find(name);
            if (!index || *index == Names::several)
                return wrong(fmt::format("is \"{}\", which {} called; give a play's name or its index", shownText(name),
                                         index ? "several plays are" : "no play is"));
        }
        scene.changes.push_back(change);
        scene.changes.back().play = *index;
    }
    if (auto valid = validate(scene); !valid)
        return valid.error();
    return scene;
}
} // namespace

Result<Scene> readSceneJson(std::string_view text, const ClipLoader& load, ReadWarnings* warnings,
                            const TextureLoader& loadTexture)
{
    sceneFields::Draft draft;
    FieldsHandler handler(draft, sceneFields::document);
    if (auto parsed = parseJson(text, handler, largestSceneText, warnings); !parsed)
        return parsed.error();
    return resolve(std::move(draft), load, loadTexture);
}

std::string writeSceneJson(const Scene& scene)
{
    FieldsWriter writer(FieldsWriter::Layout::lines);
    sceneFields::document(scene, writer);
    return std::move(writer).document();
}

} // namespace pacini
