#pragma once

// The events of a clip's JSON -> Clip.

#include "io/ClipJson.h"
#include "io/ClipJsonRules.h"
#include "io/JsonText.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

namespace pacini::clipJson
{

inline std::string_view neededKind(Kind kind)
{
    switch (kind)
    {
    case Kind::number:
        return "a number";
    case Kind::integer:
        return "a whole number";
    case Kind::text:
        return "a text in quotes";
    case Kind::object:
        return "an object in braces";
    case Kind::list:
        return "a list in brackets";
    }
    return {};
}

/// Follows the rules of ClipJsonRules.h through the events of a document: of a whole text, or of a clip inside another.
class Handler final : public JsonHandler
{
public:
    Draft draft;

    bool openObject() override
    {
        if (ignored > 0 || pending.unknown)
            return ignoreContainer();
        if (levels.empty())
            return enter(clipRules);
        const Level& top = levels.back();
        if (top.isList)
        {
            if (top.rules == &band && draft.clip.bands.size() == limits::bands)
                return stop(ErrorCode::tooLarge, "is beyond the 256 bands that a clip may have");
            top.rules->begin(draft);
            return enter(*top.rules);
        }
        if (top.rules == &encoder || pending.member->kind != Kind::object)
            return wrongKind("an object");
        return enter(*pending.member->inside);
    }

    bool openList() override
    {
        if (ignored > 0 || pending.unknown)
            return ignoreContainer();
        if (levels.empty() || levels.back().isList || levels.back().rules == &encoder ||
            pending.member->kind != Kind::list)
            return wrongKind("a list");
        if (pending.member->enter != nullptr)
            pending.member->enter(draft);
        levels.push_back({pending.member->inside, 0, true});
        return true;
    }

    bool close() override
    {
        if (ignored > 0)
        {
            --ignored;
            return true;
        }
        const Level closed = levels.back();
        levels.pop_back();
        if (closed.isList)
            return true;
        for (std::size_t i = 0; i < closed.rules->members.size(); ++i)
        {
            const Member& member = closed.rules->members[i];
            if (member.required && (closed.seen >> i & 1u) == 0)
                return stop(ErrorCode::invalidData, "is missing", fmt::format(".{}", member.name));
        }
        return true;
    }

    bool key(std::string_view name) override
    {
        if (ignored > 0)
            return true;
        Level& top = levels.back();
        pending = {};
        if (top.rules == &encoder)
        {
            if (!encoderNames.emplace(name).second)
                return givenTwice();
            draft.clip.encoder.push_back({std::string(name), 0.0});
            return true;
        }
        for (std::size_t i = 0; i < top.rules->members.size(); ++i)
        {
            if (top.rules->members[i].name != name)
                continue;
            if ((top.seen >> i & 1u) != 0)
                return givenTwice();
            top.seen |= std::uint32_t(1) << i;
            pending.member = &top.rules->members[i];
            return true;
        }
        pending.unknown = true;
        doubtKey(name, top.rules->members);
        return true;
    }

    bool number(double value) override
    {
        return scalar(
            "a number", [&] { return storeNumber(value); }, value);
    }
    bool text(std::string& value) override
    {
        return scalar(
            "a text", [&] { return storeText(value); }, value);
    }
    bool truth(bool value) override
    {
        return scalar(
            "true or false", [&] { return wrongKind("true or false"); }, value);
    }
    bool null() override
    {
        if (ignoreScalar())
            return true;
        return wrongKind("null");
    }

private:
    struct Level
    {
        const ObjectRules* rules = nullptr; ///< of this object, or of the objects in this list
        std::uint32_t seen = 0;             ///< bit i: member i was given
        bool isList = false;
    };

    /// The key that waits for its value.
    struct Pending
    {
        const Member* member = nullptr;
        bool unknown = false;
    };

    std::vector<Level> levels;
    Pending pending;
    std::size_t ignored = 0; ///< open objects and lists of unknown keys
    std::unordered_set<std::string> encoderNames;

    bool enter(const ObjectRules& rules)
    {
        levels.push_back({&rules, 0, false});
        return true;
    }

    bool ignoreContainer()
    {
        pending.unknown = false;
        ++ignored;
        return true;
    }

    bool ignoreScalar() { return ignored > 0 || std::exchange(pending.unknown, false); }

    template <typename Store, typename Value>
    bool scalar(std::string_view kind, Store store, Value& value)
    {
        if (ignoreScalar())
            return true;
        if (levels.empty() || levels.back().isList)
            return wrongKind(kind);
        if (levels.back().rules != &encoder)
            return store();
        draft.clip.encoder.back().value = value;
        return true;
    }

    bool storeNumber(double value)
    {
        const Member& member = *pending.member;
        if (&member == &versionMember)
            return checkVersion(value);
        using Int = std::numeric_limits<int>;
        if (member.kind == Kind::integer && !(std::trunc(value) == value && value >= Int::min() && value <= Int::max()))
            return stop(ErrorCode::invalidData,
                        fmt::format("is {}; a whole number of at most 10 digits is needed", value));
        if (member.storeNumber == nullptr)
            return wrongKind("a number");
        member.storeNumber(draft, value);
        return true;
    }

    bool storeText(std::string& value)
    {
        const Member& member = *pending.member;
        if (member.storeText == nullptr)
            return wrongKind("a text");
        if (&member == &formatMember && value != clipFormatName)
            return stop(ErrorCode::invalidData,
                        fmt::format("is \"{}\"; a clip has \"{}\" here", shownText(value), clipFormatName));
        member.storeText(draft, value);
        return true;
    }

    bool checkVersion(double value)
    {
        if (value == clipFormatVersion)
            return true;
        if (value > clipFormatVersion && std::trunc(value) == value)
            return stop(ErrorCode::unsupportedVersion,
                        fmt::format("was written by a newer version ({}) of the format; this program reads version {}",
                                    value, clipFormatVersion));
        return stop(ErrorCode::invalidData,
                    fmt::format("is {}, which is no version of the format; this program reads version {}", value,
                                clipFormatVersion));
    }

    bool givenTwice() { return stop(ErrorCode::invalidData, "is given twice; keep one of the two"); }

    bool wrongKind(std::string_view found)
    {
        std::string_view needed = "an object in braces"; // the document itself and what lists hold
        if (!levels.empty() && !levels.back().isList)
            needed =
                levels.back().rules == &encoder ? "a number, a text, true or false" : neededKind(pending.member->kind);
        return stop(ErrorCode::invalidData, fmt::format("is {}; {} is needed", found, needed));
    }
};

} // namespace pacini::clipJson
