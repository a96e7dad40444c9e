#include "io/ClipJsonHandler.h"
#include "io/ClipShelf.h"
#include "io/SceneJson.h"
#include "io/SceneJsonRules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace pacini
{

namespace
{
using namespace sceneJson;

/// Follows the rules through the events of a document; hands those of embedded clips on.
class SceneHandler final : public JsonHandler
{
public:
    Draft draft;

    bool openObject() override
    {
        if (embedded)
            return passOn([](JsonHandler& clip) { return clip.openObject(); }, 1);
        if (ignoreContainer())
            return true;
        if (levels.empty())
            return enter(sceneRules, false);
        const Level& top = levels.back();
        if (top.isList)
            return add(*top.rules) && enter(*top.rules, false);
        if (pending->clip)
        {
            embedded.emplace();
            embedded->setWarnings(warnings);
            return passOn([](JsonHandler& clip) { return clip.openObject(); }, 1);
        }
        return pending->object != nullptr ? enter(*pending->object, false) : wrong("an object");
    }

    bool openList() override
    {
        if (embedded)
            return passOn([](JsonHandler& clip) { return clip.openList(); }, 1);
        if (ignoreContainer())
            return true;
        if (levels.empty() || levels.back().isList || pending->list == nullptr)
            return wrong("a list");
        return enter(*pending->list, true);
    }

    bool close() override
    {
        if (embedded)
            return passOn([](JsonHandler& clip) { return clip.close(); }, -1);
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
            if (const Member& member = closed.rules->members[i]; member.required && (closed.seen >> i & 1u) == 0)
                return stop(ErrorCode::invalidData, "is missing", fmt::format(".{}", member.name));
        if (closed.rules == &clip && draft.clips.back().file.empty() == !draft.clips.back().embedded)
            return stop(ErrorCode::invalidData, "needs either a \"file\" or a \"clip\"");
        return true;
    }

    bool key(std::string_view name) override
    {
        if (embedded)
        {
            const bool goesOn = passOn([&](JsonHandler& clip) { return clip.key(name); });
            doubtAs(*embedded);
            return goesOn;
        }
        if (ignored > 0)
            return true;
        Level& top = levels.back();
        pending = nullptr;
        for (std::size_t i = 0; i < top.rules->members.size(); ++i)
        {
            if (top.rules->members[i].name != name)
                continue;
            if ((top.seen >> i & 1u) != 0)
                return stop(ErrorCode::invalidData, "is given twice; keep one of the two");
            top.seen |= std::uint32_t(1) << i;
            pending = &top.rules->members[i];
        }
        if (pending == nullptr)
            doubtKey(name, top.rules->members);
        return true;
    }

    bool number(double value) override
    {
        if (embedded)
            return passOn([&](JsonHandler& clip) { return clip.number(value); });
        if (ignoreScalar())
            return true;
        if (pending == &versionMember && inObject())
            return checkVersion(value);
        return store(&Member::number, value, "a number", [&] { return fmt::format("{}", value); });
    }

    bool text(std::string& value) override
    {
        if (embedded)
            return passOn([&](JsonHandler& clip) { return clip.text(value); });
        if (ignoreScalar())
            return true;
        if (!levels.empty() && levels.back().isList && levels.back().rules->text != nullptr)
        {
            if (value.empty())
                return stop(ErrorCode::invalidData, "is empty; a file name is needed");
            const ObjectRules& rules = *levels.back().rules;
            if (!add(rules))
                return false;
            rules.text(draft, value);
            return true;
        }
        if (pending == &formatMember && inObject() && value != sceneFormatName)
            return stop(ErrorCode::invalidData,
                        fmt::format("is \"{}\"; a scene has \"{}\" here", shownText(value), sceneFormatName));
        const std::string shown = shownText(value);
        return store(&Member::text, value, "a text", [&] { return fmt::format("\"{}\"", shown); });
    }

    bool truth(bool value) override
    {
        if (embedded)
            return passOn([&](JsonHandler& clip) { return clip.truth(value); });
        if (ignoreScalar())
            return true;
        return store(&Member::truth, value, "true or false", [&] { return std::string(value ? "true" : "false"); });
    }

    bool null() override
    {
        if (embedded)
            return passOn([](JsonHandler& clip) { return clip.null(); });
        return ignoreScalar() || wrong("null");
    }

private:
    struct Level
    {
        const ObjectRules* rules = nullptr; ///< of this object, or of the objects in this list
        std::uint32_t seen = 0;             ///< bit i: member i was given
        bool isList = false;
    };

    std::vector<Level> levels;
    const Member* pending = nullptr; ///< the key that waits for its value; null: unknown
    std::size_t ignored = 0;         ///< open objects and lists of unknown keys
    std::optional<clipJson::Handler> embedded;
    int embeddedDepth = 0;

    [[nodiscard]] bool inObject() const { return !levels.empty() && !levels.back().isList; }

    bool enter(const ObjectRules& rules, bool isList)
    {
        levels.push_back({&rules, 0, isList});
        return true;
    }

    bool add(const ObjectRules& rules)
    {
        return rules.begin(draft) || stop(ErrorCode::tooLarge, std::string(rules.full));
    }

    bool ignoreContainer()
    {
        if (ignored == 0 && !(inObject() && pending == nullptr))
            return false;
        ++ignored;
        return true;
    }
    [[nodiscard]] bool ignoreScalar() const { return ignored > 0 || (inObject() && pending == nullptr); }

    /// An event of an embedded clip, which is complete when its object closes.
    template <typename Event>
    bool passOn(Event&& event, int deeper = 0)
    {
        if (!event(*embedded))
            return stop(embedded->reason().code, embedded->reason().message, embedded->reason().where);
        embeddedDepth += deeper;
        if (embeddedDepth > 0)
            return true;
        Clip done = std::move(embedded->draft.clip);
        embedded.reset();
        if (const auto valid = validate(done); !valid)
            return stop(valid.error().code, valid.error().message,
                        valid.error().where.empty() ? "" : "." + valid.error().where);
        draft.clips.back().embedded = std::move(done);
        return true;
    }

    template <typename Store, typename Value, typename Show>
    bool store(Store Member::*storeMember, Value& value, std::string_view kind, Show&& show)
    {
        if (!inObject() || pending->*storeMember == nullptr)
            return wrong(kind);
        return (pending->*storeMember)(draft, value) || wrong(show());
    }

    bool checkVersion(double value)
    {
        if (value == sceneFormatVersion)
            return true;
        if (value > sceneFormatVersion)
            return stop(ErrorCode::unsupportedVersion,
                        fmt::format("was written by a newer version ({}) of the format; this program reads version {}",
                                    value, sceneFormatVersion));
        return stop(ErrorCode::invalidData, fmt::format("is {}, which is no version of the format", value));
    }

    bool wrong(std::string_view found)
    {
        std::string_view needed = "an object in braces"; // the document itself and what lists hold
        if (inObject())
            needed = pending->needed;
        else if (!levels.empty() && levels.back().rules == &clip)
            needed = "a file name in quotes or an object in braces";
        return stop(ErrorCode::invalidData, fmt::format("is {}; {} is needed", found, needed));
    }
};

Result<Scene> resolve(Draft draft, const ClipLoader& load)
{
    Scene scene = std::move(draft.scene);
    ClipShelf shelf(scene, load);
    if (auto added = shelf.addAll(draft.clips); !added)
        return added.error();
    Names names;
    for (std::size_t i = 0; i < draft.plays.size(); ++i)
    {
        ScenePlay& play = draft.plays[i].play;
        const auto index = shelf.find(draft.plays[i].clip, detail::indexed("plays", i) + ".clip");
        if (!index)
            return index.error();
        play.clip = *index;
        if (draft.plays[i].loopsAll)
            play.loop = scene.clips[*index].duration;
        names.add(play.name, i);
        scene.plays.push_back(std::move(play));
    }
    for (std::size_t i = 0; i < draft.changes.size(); ++i)
    {
        SceneChange& change = draft.changes[i].change;
        const std::string where = detail::indexed("changes", i) + ".play";
        if (const auto* number = std::get_if<double>(&draft.changes[i].play))
        {
            if (scene.plays.empty() || !whole(*number, 0.0, static_cast<double>(scene.plays.size() - 1), change.play))
                return Error{ErrorCode::invalidData, where,
                             fmt::format("is {}; the scene has {} plays, counted from 0", *number, scene.plays.size())};
        }
        else
        {
            const auto& name = std::get<std::string>(draft.changes[i].play);
            const auto index = names.find(name);
            if (!index || *index == Names::several)
                return Error{ErrorCode::invalidData, where,
                             fmt::format("is \"{}\", which {} called; give a play's name or its index", shownText(name),
                                         index ? "several plays are" : "no play is")};
            change.play = *index;
        }
        scene.changes.push_back(change);
    }
    if (auto valid = validate(scene); !valid)
        return valid.error();
    return scene;
}
} // namespace

Result<Scene> readSceneJson(std::string_view text, const ClipLoader& load, ReadWarnings* warnings)
{
    SceneHandler handler;
    if (auto parsed = parseJson(text, handler, largestSceneText, warnings); !parsed)
        return parsed.error();
    return resolve(std::move(handler.draft), load);
}

} // namespace pacini
