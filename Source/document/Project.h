#pragma once

// Project: clips, sounds, groups, notes and profile, as a plain value. Its large parts are immutable and shared, so
// that a copy is cheap and may go to any thread.

#include "document/AudioReference.h"
#include "document/Reapply.h"

#include <pacini/actuator/Profile.h>
#include <pacini/actuator/Strength.h>
#include <pacini/analysis/EncoderParams.h>
#include <pacini/clip/Curve.h>
#include <pacini/synthesis/Scene.h>
#include <pacini/texture/Texture.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pacini
{

/// A clip of a project with its sources: an analysis of a sound, and the edits over it.
struct ClipItem
{
    int id = 0;        ///< in its project, from 1
    std::string group; ///< empty: none
    std::string notes;
    std::vector<std::string> tags = {};   ///< words to find it by
    int source = 0;                       ///< id of an AudioReference; 0: none
    EncoderParams encoder;                ///< of the analysis
    std::shared_ptr<const Clip> analysis; ///< without edits; never null
    EditList edits;
    std::vector<UnfittingEdit> unfitting; ///< of `edits`
    std::shared_ptr<const Clip> clip;     ///< the analysis with the edits; never null
};

/// The actuator of the project, and its playback settings.
struct ProjectProfile
{
    std::string name;                   ///< of a shipped profile or a file; empty: none
    std::optional<Profile> embedded;    ///< its content, which counts before the name
    double strength = standardStrength; ///< 0 to 1, see fitActuator; kept when another actuator is chosen
    bool operator==(const ProjectProfile&) const = default;
};

[[nodiscard]] inline bool isStrength(double value) noexcept
{
    return value >= 0.0 && value <= 1.0;
}

/// Breakpoint curve of one parameter of a scene's part, from its start on: levels, pan and delay glide between the
/// points, pitch and stretch step at each.
struct SceneCurve
{
    SceneParameter parameter = SceneParameter::pan;
    Curve points; ///< s from the part's start; at least one
    bool operator==(const SceneCurve&) const = default;
};

/// A clip of the project in the scene.
struct ScenePart
{
    int clip = 0;        ///< its id; a part whose clip is gone stays, and is not played; of a texture: how long it is
    int track = 0;       ///< from 0: where it is shown
    ScenePlay play = {}; ///< how it plays, but for its clip; a loop that is longer than the clip repeats all of it
    std::vector<SceneCurve> curves = {};
    bool operator==(const ScenePart&) const = default;
};

/// A texture that a part can play instead of its clip. Immutable: projects share it, as they do clips.
struct SceneTexture
{
    std::shared_ptr<const Texture> content; ///< never null
    [[nodiscard]] bool operator==(const SceneTexture& other) const
    {
        return content == other.content || *content == *other.content;
    }
};

/// Clips of the project on tracks, which play together; see sceneOf().
struct ProjectScene
{
    std::string name;
    double duration = 0.0; ///< s; 0: until its last part ends
    double gain = 0.0;     ///< dB
    int actuators = 1;     ///< 1 to 16
    PanLaw panLaw = PanLaw::constantPower;
    double panDelay = 0.01; ///< s, of the far end, for panning by delay
    std::vector<ScenePart> parts;
    std::vector<SceneTexture> textures = {}; ///< of parts, by index
    bool operator==(const ProjectScene&) const = default;
};

struct Project
{
    std::string notes;
    std::vector<AudioReference> sources;
    std::vector<std::shared_ptr<const ClipItem>> clips;
    std::vector<std::string> groups; ///< in the order in which they are shown
    ProjectProfile profile;
    ProjectScene scene;

    [[nodiscard]] std::shared_ptr<const ClipItem> find(int id) const
    {
        for (const auto& item : clips)
            if (item->id == id)
                return item;
        return nullptr;
    }

    [[nodiscard]] const AudioReference* findSource(int id) const
    {
        for (const AudioReference& source : sources)
            if (source.id == id)
                return &source;
        return nullptr;
    }
};

[[nodiscard]] inline bool operator==(const ClipItem& a, const ClipItem& b)
{
    const auto same = [](const auto& x, const auto& y)
    {
        return x == y || *x == *y;
    };
    if (a.edits.size() != b.edits.size())
        return false;
    const auto editsOfA = a.edits.whole();
    const auto editsOfB = b.edits.whole();
    for (std::size_t i = 0; i < editsOfA.size(); ++i)
        if (!same(editsOfA[i], editsOfB[i]))
            return false;
    return a.id == b.id && a.group == b.group && a.notes == b.notes && a.tags == b.tags && a.source == b.source &&
           a.encoder == b.encoder && a.unfitting == b.unfitting && same(a.analysis, b.analysis) && same(a.clip, b.clip);
}

[[nodiscard]] inline bool operator==(const Project& a, const Project& b)
{
    if (a.clips.size() != b.clips.size())
        return false;
    for (std::size_t i = 0; i < a.clips.size(); ++i)
        if (a.clips[i] != b.clips[i] && !(*a.clips[i] == *b.clips[i]))
            return false;
    return a.notes == b.notes && a.sources == b.sources && a.groups == b.groups && a.profile == b.profile &&
           a.scene == b.scene;
}

} // namespace pacini
