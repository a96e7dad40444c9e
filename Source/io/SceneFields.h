#pragma once

// Field lists of a scene in JSON, which its reader and its writer follow.

#include "io/Fields.h"
#include "io/FieldsHandler.h"
#include "io/SceneJson.h"
#include "io/TextureFields.h"
#include "io/formats/json/ClipFields.h"

#include <pacini/synthesis/Scene.h>

#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <variant>
#include <vector>

namespace pacini::sceneFields
{

inline constexpr DocumentFormat format{sceneFormatName, sceneFormatVersion, "a scene"};

/// A clip or a play that the text names by index or in words; resolved when all of it is known.
using Reference = std::variant<double, std::string>;

struct DraftClip
{
    std::string file;
    std::optional<Clip> embedded;
};

struct DraftTexture
{
    std::string file;
    std::optional<Texture> embedded;
};

struct DraftPlay : ScenePlay
{
    std::optional<Reference> clip, texture; ///< instead of the indices of a ScenePlay
    double duration = 0.0;                  ///< s, of a texture without a clip
    bool loopsAll = false;
};

struct DraftChange : SceneChange
{
    Reference play; ///< instead of the index of a SceneChange
};

/// The scene in the form of its text; the fields of Scene are empty.
struct Draft : Scene
{
    std::vector<DraftClip> clips;
    std::vector<DraftTexture> textures;
    std::vector<DraftPlay> plays;
    std::vector<DraftChange> changes;
};

inline constexpr std::array<Choice<PanLaw>, 3> panLaws{
    {{"constantPower", PanLaw::constantPower}, {"delay", PanLaw::delay}, {"both", PanLaw::both}}};
inline constexpr std::array<Choice<SceneParameter>, 10> parameters{{{"gain", SceneParameter::gain},
                                                                    {"pan", SceneParameter::pan},
                                                                    {"delay", SceneParameter::delay},
                                                                    {"transposition", SceneParameter::transposition},
                                                                    {"stretch", SceneParameter::stretch},
                                                                    {"tones", SceneParameter::tones},
                                                                    {"events", SceneParameter::events},
                                                                    {"noise", SceneParameter::noise},
                                                                    {"speed", SceneParameter::speed},
                                                                    {"force", SceneParameter::force}}};
inline constexpr std::array<Choice<VariationScope>, 2> variationScopes{
    {{"breakpoint", VariationScope::breakpoint}, {"band", VariationScope::band}}};

/// Numbers are doubles, which hold whole numbers up to here; larger seeds are texts.
inline constexpr std::uint64_t largestNumberSeed = std::uint64_t(1) << 53;

inline constexpr WholeRange passes{0.0, 1e9, "a whole number from 0 to 1000000000"};
inline constexpr WholeRange priority{anyInt.lowest, anyInt.highest, anyInt.needed};
inline constexpr WholeRange actuators{1.0, limits::actuators, "a whole number from 1 to 16"};

template <typename Target, typename Visitor>
void visitReference(const char* name, Target& target, std::string_view needed, Visitor& visitor)
{
    if constexpr (isReader<Visitor>)
        visitor.scalar(name, target, Need::required, needed, takeAny<double, std::string>);
    else
        visitor.integer(name, target);
}

/// The clip of a play, or its texture, which is then there for `duration`; a scene that is written has both.
template <typename Play, typename Visitor>
void visitContent(Play& play, Visitor& visitor)
{
    if constexpr (isReader<Visitor>)
    {
        const auto take = [](std::optional<Reference>& target, JsonScalar& value)
        {
            return takeAny<double, std::string>(target.emplace(), value);
        };
        visitor.scalar("clip", play.clip, Need::usual, "the index, the file or the name of a clip", take);
        visitor.scalar("texture", play.texture, Need::usual, "the index, the file or the name of a texture", take);
        visitor.number("duration", play.duration, Need::usual);
        visitor.check(
            [&]() -> Result<void>
            {
                if (!play.clip && !play.texture)
                    return Error{ErrorCode::invalidData, ".clip", "is missing"};
                if (play.texture && !play.clip && !(play.duration > 0.0))
                    return Error{ErrorCode::invalidData, ".duration", "is missing; say how long the texture plays, s"};
                if (play.clip && play.duration != 0.0)
                    return Error{ErrorCode::invalidData, ".duration", "is that of the clip; it is for textures only"};
                return {};
            });
    }
    else
    {
        visitor.integer("clip", play.clip);
        if (play.texture)
            visitor.integer("texture", *play.texture);
    }
}

template <typename Play, typename Visitor>
void visitMovement(Play& play, Visitor& visitor)
{
    if (play.texture)
        visitNumbers(visitor, Need::usual, "speed", play.speed, "force", play.force);
}

template <typename Seed, typename Visitor>
void visitSeed(Seed& seed, Visitor& visitor)
{
    if constexpr (isReader<Visitor>)
        visitor.scalar("seed", seed, Need::usual,
                       "a whole number from 0 to 2^53, or the digits of a larger one in quotes",
                       [](Seed& read, JsonScalar& value)
                       {
                           auto* const* text = std::get_if<std::string*>(&value);
                           if (text == nullptr)
                               return takeWhole(value, 0.0, static_cast<double>(largestNumberSeed), read);
                           const char* end = (*text)->data() + (*text)->size();
                           const auto [stop, failure] = std::from_chars((*text)->data(), end, read);
                           return failure == std::errc() && stop == end ? Taken::yes : Taken::wrongValue;
                       });
    else if (seed <= largestNumberSeed)
        visitor.integer("seed", seed);
    else
        visitor.text("seed", std::to_string(seed));
}

template <typename Play, typename Visitor>
void visitLoop(Play& play, Visitor& visitor)
{
    if constexpr (isReader<Visitor>)
        visitor.scalar("loop", play, Need::usual, "a number of seconds, or true for the whole clip",
                       [](Play& read, JsonScalar& value) {
                           return takeAs<double>(value, read.loop) || takeAs<bool>(value, read.loopsAll)
                                      ? Taken::yes
                                      : Taken::wrongKind;
                       });
    else
        visitor.number("loop", play.loop, Need::usual);
}

inline constexpr auto clipEntry = [](auto& clip, auto& visitor)
{
    if constexpr (isReader<std::remove_cvref_t<decltype(visitor)>>)
    {
        const auto takeFile = [](std::string& file, JsonScalar& value)
        {
            return !takeAs<std::string>(value, file) ? Taken::wrongKind : file.empty() ? Taken::wrongValue : Taken::yes;
        };
        visitor.scalar("file", clip.file, Need::optional, "a file name in quotes", takeFile);
        visitor.optionalObject("clip", clip.embedded, clipFields::embedded, "a clip in braces");
        visitor.check(
            [&]() -> Result<void>
            {
                if (clip.file.empty() == !clip.embedded)
                    return Error{ErrorCode::invalidData, "", "needs either \"file\" or \"clip\""};
                return {};
            });
    }
    else
        visitor.object("clip", clip, Need::required, clipFields::document);
};

/// A clip or a texture that is nothing but the name of its file.
inline constexpr auto takeClipFile = [](auto& clip, JsonScalar& value)
{
    return !takeAs<std::string>(value, clip.file) ? Taken::wrongKind : clip.file.empty() ? Taken::noName : Taken::yes;
};

inline constexpr auto textureEntry = [](auto& texture, auto& visitor)
{
    if constexpr (isReader<std::remove_cvref_t<decltype(visitor)>>)
    {
        const auto takeFile = [](std::string& file, JsonScalar& value)
        {
            return !takeAs<std::string>(value, file) ? Taken::wrongKind : file.empty() ? Taken::wrongValue : Taken::yes;
        };
        visitor.scalar("file", texture.file, Need::optional, "a file name in quotes", takeFile);
        visitor.optionalObject("texture", texture.embedded, textureFields::embedded, "a texture in braces");
        visitor.check(
            [&]() -> Result<void>
            {
                if (texture.file.empty() == !texture.embedded)
                    return Error{ErrorCode::invalidData, "", "needs either \"file\" or \"texture\""};
                return {};
            });
    }
    else
        visitor.object("texture", texture, Need::required, textureFields::embedded);
};

inline constexpr auto variationFields = [](auto& variation, auto& visitor)
{
    visitor.number("amount", variation.amount, Need::usual);
    visitor.choice("scope", variation.scope, variationScopes, Need::usual);
    visitSeed(variation.seed, visitor);
};

/// Reads a variation that is given by its amount only.
inline constexpr auto takeAmount = [](auto& variation, JsonScalar& value)
{
    return takeAny<double>(variation.amount, value);
};

/// Parameters of a play that can change while it plays. For projects too.
inline constexpr auto levelFields = [](auto& play, auto& visitor)
{
    visitor.number("gain", play.gain, Need::usual);
    visitor.number("pan", play.pan, Need::usual);
    visitor.number("delay", play.delay, Need::usual);
    visitor.number("transposition", play.transposition, Need::usual);
    visitor.number("stretch", play.stretch, Need::usual);
    visitor.number("tones", play.tones, Need::usual);
    visitor.number("events", play.events, Need::usual);
    visitor.number("noise", play.noise, Need::usual);
};

inline constexpr auto playFields = [](auto& play, auto& visitor)
{
    visitor.text("name", play.name, Need::usual);
    visitContent(play, visitor);
    visitor.number("start", play.start, Need::usual);
    visitLoop(play, visitor);
    visitor.integer("passes", play.passes, passes);
    levelFields(play, visitor);
    visitMovement(play, visitor);
    visitor.integer("priority", play.priority, priority);
    visitor.object("variation", play.variation, Need::usual, variationFields,
                   "a number, or an object with amount, scope and seed", takeAmount);
};

inline constexpr auto changeFields = [](auto& change, auto& visitor)
{
    visitor.number("time", change.time, Need::required);
    visitReference("play", change.play, "the index or the name of a play", visitor);
    visitor.choice("parameter", change.parameter, parameters, Need::required);
    visitor.number("value", change.value, Need::required);
    visitor.number("glide", change.glide, Need::usual);
};

inline constexpr auto document = [](auto& scene, auto& visitor)
{
    visitor.format(format);
    visitor.text("name", scene.name, Need::usual);
    visitor.number("duration", scene.duration, Need::usual);
    visitor.number("gain", scene.gain, Need::usual);
    visitor.integer("actuators", scene.actuators, actuators);
    visitor.choice("panLaw", scene.panLaw, panLaws, Need::usual);
    visitor.number("panDelay", scene.panDelay, Need::usual);
    visitor.list("clips", scene.clips, limits::sceneClips, "clips that a scene may have", clipEntry, Need::usual,
                 "a file name in quotes or an object in braces", takeClipFile);
    visitor.list("textures", scene.textures, limits::sceneTextures, "textures that a scene may have", textureEntry,
                 Need::optional, "a file name in quotes or an object in braces", takeClipFile);
    visitor.rows("plays", scene.plays, limits::plays, "plays that a scene may have", playFields);
    visitor.rows("changes", scene.changes, limits::sceneChanges, "changes that a scene may have", changeFields);
};

} // namespace pacini::sceneFields
