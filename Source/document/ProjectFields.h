#pragma once

// Field lists of a project in JSON, for its reader and its writer.

#include "document/EditFields.h"
#include "document/Project.h"
#include "document/ProjectJson.h"
#include "io/Fields.h"
#include "io/ParameterFields.h"
#include "io/ProfileFields.h"
#include "io/SceneFields.h"
#include "io/TextureFields.h"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace pacini::projectFields
{

/// A whole number within the range of a double.
template <typename Number, typename Visitor>
void visitCount(Number& value, const char* name, double lowest, double highest, Visitor& visitor)
{
    double number = static_cast<double>(value);
    visitor.number(name, number, Need::usual);
    if constexpr (isReader<Visitor>)
    {
        if (number == std::floor(number) && number >= lowest && number <= highest)
            value = static_cast<Number>(number);
        else
            visitor.fail(name, "must be a whole number within its range");
    }
}

template <typename Params, typename Visitor>
void visitEncoder(Params& params, Visitor& visitor)
{
    if constexpr (isReader<Visitor>)
    {
        params.audible = 0.0; // before there was such a field, nothing of it was felt
        params.heard = HeardRole::instead;
    }
    visitParameters(encoderParameters, params, visitor);
}

template <typename Chosen, typename Visitor>
void visitProfile(Chosen& chosen, Visitor& visitor)
{
    visitor.text("name", chosen.name);
    visitor.optionalObject("content", chosen.embedded,
                           [&](auto& content) { profileFields::visitFields(content, visitor); });
    if constexpr (isReader<Visitor>)
        if (!chosen.name.empty() || chosen.embedded)
            chosen.strength = 0.0; // before there was such a field, actuators were played as flat as can be
    visitor.number("strength", chosen.strength, Need::usual);
}

/// The texture of a play by its index, and how it moves; nothing of a play that has none.
template <typename Play, typename Visitor>
void visitTexture(Play& play, Visitor& visitor)
{
    constexpr double none = -1.0;
    double index = play.texture ? static_cast<double>(*play.texture) : none;
    if constexpr (isReader<Visitor>)
    {
        visitor.number("texture", index, Need::optional);
        if (index == std::floor(index) && index >= 0.0 && index < static_cast<double>(limits::sceneTextures))
            play.texture = static_cast<std::size_t>(index);
        else if (index != none)
            visitor.fail("texture", "must be the index of one of the scene's textures");
    }
    else if (play.texture)
        visitor.number("texture", index, Need::required);
    sceneFields::visitMovement(play, visitor);
}

template <typename Play, typename Visitor>
void visitPlay(Play& play, Visitor& visitor)
{
    visitor.optionalText("name", play.name);
    visitor.number("start", play.start, Need::usual);
    visitor.number("loop", play.loop, Need::usual);
    visitCount(play.passes, "passes", 0.0, 1e9, visitor);
    sceneFields::levelFields(play, visitor);
    visitTexture(play, visitor);
    visitCount(play.priority, "priority", std::numeric_limits<int>::min(), std::numeric_limits<int>::max(), visitor);
    visitor.object("variation", play.variation, Need::optional,
                   [&](auto& variation)
                   {
                       visitor.number("amount", variation.amount, Need::required);
                       visitor.choice("scope", variation.scope, sceneFields::variationScopes, Need::required);
                       visitWhole(variation.seed, "seed", visitor);
                   });
}

template <typename Scene, typename Visitor>
void visitScene(Scene& scene, Visitor& visitor)
{
    visitor.optionalText("name", scene.name);
    visitor.number("duration", scene.duration, Need::usual);
    visitor.number("gain", scene.gain, Need::usual);
    visitor.integer("actuators", scene.actuators, "must be a whole number");
    visitor.choice("panLaw", scene.panLaw, sceneFields::panLaws, Need::usual);
    visitor.number("panDelay", scene.panDelay, Need::usual);
    visitor.list("textures", scene.textures, limits::sceneTextures, "textures",
                 [&](auto& texture)
                 {
                     if constexpr (isReader<Visitor>)
                     {
                         auto read = std::make_shared<Texture>();
                         textureFields::content(*read, visitor);
                         texture.content = std::move(read);
                     }
                     else
                         textureFields::content(*texture.content, visitor);
                 });
    visitor.list("parts", scene.parts, limits::plays, "parts",
                 [&](auto& part)
                 {
                     visitor.integer("clipId", part.clip, "must be a whole number");
                     visitor.integer("track", part.track, "must be a whole number");
                     visitPlay(part.play, visitor);
                     visitor.list("curves", part.curves, most, "curves",
                                  [&](auto& curve)
                                  {
                                      visitor.choice("parameter", curve.parameter, sceneFields::parameters,
                                                     Need::required);
                                      visitor.list("points", curve.points, limits::sceneChanges, "points",
                                                   [&](auto& point)
                                                   {
                                                       visitor.number("time", point.time, Need::required);
                                                       visitor.number("value", point.value, Need::required);
                                                   });
                                  });
                 });
}

} // namespace pacini::projectFields
