#pragma once

// The entries of a scene in JSON: names, what each may be and where it goes.

#include "io/SceneJson.h"

#include <pacini/synthesis/Scene.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

namespace pacini::sceneJson
{

/// A clip or a play that the text names by index or in words; resolved when all of it is known.
using Reference = std::variant<double, std::string>;

struct DraftClip
{
    std::string file;
    std::optional<Clip> embedded;
};

struct DraftPlay
{
    ScenePlay play;
    Reference clip;
    bool loopsAll = false;
};

struct DraftChange
{
    SceneChange change;
    Reference play;
};

/// The scene as it grows; `scene` has no clips, plays and changes yet.
struct Draft
{
    Scene scene;
    std::vector<DraftClip> clips;
    std::vector<DraftPlay> plays;
    std::vector<DraftChange> changes;
};

struct ObjectRules;

/// One named entry of an object. A store that is null refuses that kind of value, one that returns false this value.
struct Member
{
    std::string_view name;
    std::string_view needed; ///< what it must be, for messages
    bool required = false;
    bool (*number)(Draft&, double) = nullptr;
    bool (*text)(Draft&, std::string&) = nullptr;
    bool (*truth)(Draft&, bool) = nullptr;
    const ObjectRules* object = nullptr;
    const ObjectRules* list = nullptr; ///< rules of each object in the list
    bool clip = false;                 ///< the object is a clip's document
};

/// The entries that an object may have. Others are ignored.
struct ObjectRules
{
    std::span<const Member> members;
    bool (*begin)(Draft&) = nullptr;              ///< appends an object to its list; false when it is full
    void (*text)(Draft&, std::string&) = nullptr; ///< appends a text to the list where that may be
    std::string_view full = {};
};

/// Finds one of the names of an enumeration, in the order of its values.
template <typename E, std::size_t n>
bool chosen(const std::string& text, const std::array<std::string_view, n>& names, E& value)
{
    for (std::size_t i = 0; i < n; ++i)
        if (names[i] == text)
        {
            value = static_cast<E>(i);
            return true;
        }
    return false;
}

template <typename Integer>
bool whole(double v, double lowest, double highest, Integer& value)
{
    if (!(v >= lowest && v <= highest && std::trunc(v) == v))
        return false;
    value = static_cast<Integer>(v);
    return true;
}

inline constexpr std::array<std::string_view, 3> panLaws = {"constantPower", "delay", "both"};
inline constexpr std::array<std::string_view, 4> parameters = {"gain", "pan", "transposition", "stretch"};
inline constexpr std::array<std::string_view, 2> variationScopes = {"breakpoint", "band"};

/// Numbers are doubles, which hold whole numbers up to here; larger seeds are texts.
inline constexpr std::uint64_t largestNumberSeed = std::uint64_t(1) << 53;

// The format, from the inside out.

inline constexpr Member clipMembers[] = {
    {.name = "file",
     .needed = "a file name in quotes",
     .text =
         [](Draft& d, std::string& v)
     {
         d.clips.back().file = std::move(v);
         return !d.clips.back().file.empty();
     }},
    {.name = "clip", .needed = "a clip in braces", .clip = true},
};
inline constexpr ObjectRules clip{clipMembers,
                                  [](Draft& d)
                                  {
                                      d.clips.emplace_back();
                                      return d.clips.size() <= limits::sceneClips;
                                  },
                                  [](Draft& d, std::string& v) { d.clips.back().file = std::move(v); },
                                  "is beyond the 10000 clips that a scene may have"};

inline constexpr Member variationMembers[] = {
    {.name = "amount",
     .needed = "a number",
     .number =
         [](Draft& d, double v)
     {
         d.plays.back().play.variation.amount = v;
         return true;
     }},
    {.name = "scope",
     .needed = "\"breakpoint\" or \"band\"",
     .text =
         [](Draft& d, std::string& v)
     {
         return chosen(v, variationScopes, d.plays.back().play.variation.scope);
     }},
    {.name = "seed",
     .needed = "a whole number from 0 to 2^53, or the digits of a larger one in quotes",
     .number = [](Draft& d, double v)
     { return whole(v, 0.0, static_cast<double>(largestNumberSeed), d.plays.back().play.variation.seed); },
     .text =
         [](Draft& d, std::string& v)
     {
         const auto [end, failure] = std::from_chars(v.data(), v.data() + v.size(), d.plays.back().play.variation.seed);
         return failure == std::errc() && end == v.data() + v.size();
     }},
};
inline constexpr ObjectRules variation{variationMembers};

/// A member of a play that is just a number.
template <double ScenePlay::*member>
constexpr Member playNumber(std::string_view name)
{
    return {.name = name,
            .needed = "a number",
            .number = [](Draft& d, double v)
            {
                d.plays.back().play.*member = v;
                return true;
            }};
}

inline constexpr Member playMembers[] = {
    {.name = "name",
     .needed = "a text in quotes",
     .text =
         [](Draft& d, std::string& v)
     {
         d.plays.back().play.name = std::move(v);
         return true;
     }},
    {.name = "clip",
     .needed = "the index, the file or the name of a clip",
     .required = true,
     .number =
         [](Draft& d, double v)
     {
         d.plays.back().clip = v;
         return true;
     },
     .text =
         [](Draft& d, std::string& v)
     {
         d.plays.back().clip = std::move(v);
         return true;
     }},
    playNumber<&ScenePlay::start>("start"),
    {.name = "loop",
     .needed = "a number of seconds, or true for the whole clip",
     .number =
         [](Draft& d, double v)
     {
         d.plays.back().play.loop = v;
         return true;
     },
     .truth =
         [](Draft& d, bool v)
     {
         d.plays.back().loopsAll = v;
         return true;
     }},
    {.name = "passes",
     .needed = "a whole number from 0 to 1000000000",
     .number =
         [](Draft& d, double v)
     {
         return whole(v, 0.0, 1e9, d.plays.back().play.passes);
     }},
    playNumber<&ScenePlay::gain>("gain"),
    playNumber<&ScenePlay::pan>("pan"),
    playNumber<&ScenePlay::transposition>("transposition"),
    playNumber<&ScenePlay::stretch>("stretch"),
    {.name = "priority",
     .needed = "a whole number of at most 10 digits",
     .number =
         [](Draft& d, double v)
     {
         using Int = std::numeric_limits<int>;
         return whole(v, Int::min(), Int::max(), d.plays.back().play.priority);
     }},
    {.name = "variation",
     .needed = "a number, or an object with amount, scope and seed",
     .number =
         [](Draft& d, double v)
     {
         d.plays.back().play.variation.amount = v;
         return true;
     },
     .object = &variation},
};
inline constexpr ObjectRules play{playMembers,
                                  [](Draft& d)
                                  {
                                      d.plays.emplace_back();
                                      return d.plays.size() <= limits::plays;
                                  },
                                  nullptr, "is beyond the 10000 plays that a scene may have"};

/// A member of a change that is just a number.
template <double SceneChange::*member>
constexpr Member changeNumber(std::string_view name, bool required)
{
    return {.name = name,
            .needed = "a number",
            .required = required,
            .number = [](Draft& d, double v)
            {
                d.changes.back().change.*member = v;
                return true;
            }};
}

inline constexpr Member changeMembers[] = {
    changeNumber<&SceneChange::time>("time", true),
    {.name = "play",
     .needed = "the index or the name of a play",
     .required = true,
     .number =
         [](Draft& d, double v)
     {
         d.changes.back().play = v;
         return true;
     },
     .text =
         [](Draft& d, std::string& v)
     {
         d.changes.back().play = std::move(v);
         return true;
     }},
    {.name = "parameter",
     .needed = "\"gain\", \"pan\", \"transposition\" or \"stretch\"",
     .required = true,
     .text =
         [](Draft& d, std::string& v)
     {
         return chosen(v, parameters, d.changes.back().change.parameter);
     }},
    changeNumber<&SceneChange::value>("value", true),
    changeNumber<&SceneChange::glide>("glide", false),
};
inline constexpr ObjectRules change{changeMembers,
                                    [](Draft& d)
                                    {
                                        d.changes.emplace_back();
                                        return d.changes.size() <= limits::sceneChanges;
                                    },
                                    nullptr, "is beyond the 1000000 changes that a scene may have"};

/// A member of the scene that is just a number.
template <double Scene::*member>
constexpr Member sceneNumber(std::string_view name)
{
    return {.name = name,
            .needed = "a number",
            .number = [](Draft& d, double v)
            {
                d.scene.*member = v;
                return true;
            }};
}

inline constexpr Member sceneMembers[] = {
    // The reader checks these two by itself.
    {.name = "format",
     .needed = "a text in quotes",
     .required = true,
     .text =
         [](Draft&, std::string&)
     {
         return true;
     }},
    {.name = "version",
     .needed = "a whole number",
     .required = true,
     .number =
         [](Draft&, double)
     {
         return true;
     }},
    {.name = "name",
     .needed = "a text in quotes",
     .text =
         [](Draft& d, std::string& v)
     {
         d.scene.name = std::move(v);
         return true;
     }},
    sceneNumber<&Scene::duration>("duration"),
    sceneNumber<&Scene::gain>("gain"),
    {.name = "actuators",
     .needed = "a whole number from 1 to 16",
     .number =
         [](Draft& d, double v)
     {
         return whole(v, 1.0, limits::actuators, d.scene.actuators);
     }},
    {.name = "panLaw",
     .needed = "\"constantPower\", \"delay\" or \"both\"",
     .text =
         [](Draft& d, std::string& v)
     {
         return chosen(v, panLaws, d.scene.panLaw);
     }},
    sceneNumber<&Scene::panDelay>("panDelay"),
    {.name = "clips", .needed = "a list in brackets", .list = &clip},
    {.name = "plays", .needed = "a list in brackets", .list = &play},
    {.name = "changes", .needed = "a list in brackets", .list = &change},
};
inline constexpr ObjectRules sceneRules{sceneMembers};
inline constexpr const Member& formatMember = sceneMembers[0];
inline constexpr const Member& versionMember = sceneMembers[1];

} // namespace pacini::sceneJson
