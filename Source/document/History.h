#pragma once

// Undo history without a limit.

#include "document/ClipSnapshot.h"
#include "document/Project.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// Ids for what is new in a project.
struct NewIds
{
    int clip = 1;
    int source = 1;
};

/// All states of a project, each with the name of the step that led to it. A step takes memory only for its changes:
/// states share clips in chunks.
class History
{
public:
    explicit History(const Project& first) { states.push_back({"", nextId++, freeze(first)}); }

    /// A new state; those that could be redone are gone.
    void push(std::string name, const Project& project)
    {
        states.resize(position + 1);
        states.push_back({std::move(name), nextId++, freeze(project)});
        ++position;
    }

    /// Puts `project` in place of the newest state: the same step, further on. Precondition: canUndo(), !canRedo().
    void replaceNewest(const Project& project)
    {
        states.back().project = freeze(project);
        states.back().id = nextId++;
    }

    /// What is no step: `change` is made to every state (without its clips), and the last `added` clips of `now` put
    /// behind the clips of each. `now` is the current project with both; its other clips are those of the current
    /// state.
    void amend(const Project& now, std::size_t added, const std::function<void(Project&)>& change)
    {
        ProjectSnapshot current = freeze(now);
        const auto last = static_cast<std::ptrdiff_t>(added);
        for (State& state : states)
        {
            change(state.project.bare);
            state.project.clips.insert(state.project.clips.end(), current.clips.end() - last, current.clips.end());
            state.id = nextId++;
        }
        states[position].project = std::move(current);
    }

    [[nodiscard]] bool canUndo() const noexcept { return position > 0; }
    [[nodiscard]] bool canRedo() const noexcept { return position + 1 < states.size(); }

    /// States there are, and which is the current one (0 is the first).
    [[nodiscard]] std::size_t size() const noexcept { return states.size(); }
    [[nodiscard]] std::size_t current() const noexcept { return position; }

    /// The name of the step that led to a state; empty for the first.
    [[nodiscard]] const std::string& name(std::size_t state) const { return states[state].name; }

    /// The names of the steps that undo and redo would take; empty: there is none.
    [[nodiscard]] std::string undoName() const { return canUndo() ? name(position) : ""; }
    [[nodiscard]] std::string redoName() const { return canRedo() ? name(position + 1) : ""; }

    /// Ids above those of all states that there are or have been.
    [[nodiscard]] const NewIds& newIds() const noexcept { return ids; }

    /// A number that no other state of this history has or has had.
    [[nodiscard]] std::uint64_t id() const noexcept { return states[position].id; }

    /// Makes a state the current one and returns its project; clips that are as they were stay the same objects.
    [[nodiscard]] Project goTo(std::size_t state)
    {
        position = state;
        return restore(states[position].project);
    }

    /// What the clips of a state cost beside those of the state before, in bytes.
    [[nodiscard]] std::size_t bytes(std::size_t state) const
    {
        std::size_t sum = 0;
        for (const auto& item : states[state].project.clips)
        {
            const ItemSnapshot* before = nullptr;
            if (state > 0)
                for (const auto& other : states[state - 1].project.clips)
                    if (other->bare.id == item->bare.id)
                        before = other.get();
            if (before != item.get())
                sum += item->clip.bytesBeside(before != nullptr ? before->clip : ClipSnapshot{}) +
                       item->bare.edits.bytesBeside(before != nullptr ? before->bare.edits : EditList{});
        }
        return sum;
    }

private:
    struct ItemSnapshot
    {
        ClipItem bare; ///< without its clip
        ClipSnapshot clip;
    };

    struct ProjectSnapshot
    {
        Project bare; ///< without its clips
        std::vector<std::shared_ptr<const ItemSnapshot>> clips;
    };

    struct State
    {
        std::string name;
        std::uint64_t id = 0;
        ProjectSnapshot project;
    };

    ProjectSnapshot freeze(const Project& project)
    {
        ProjectSnapshot frozen{project, {}};
        frozen.bare.clips.clear();
        decltype(live) now;
        for (const AudioReference& source : project.sources)
            ids.source = std::max(ids.source, source.id + 1);
        for (const auto& item : project.clips)
        {
            ids.clip = std::max(ids.clip, item->id + 1);
            std::shared_ptr<const ItemSnapshot> kept;
            const ItemSnapshot* before = nullptr;
            for (const auto& [known, itsFrozen] : live)
            {
                if (known == item)
                    kept = itsFrozen;
                if (known->id == item->id)
                    before = itsFrozen.get();
            }
            if (!kept)
            {
                auto made = std::make_shared<ItemSnapshot>();
                made->bare = *item;
                made->bare.clip = nullptr;
                made->clip = ClipSnapshot(*item->clip, before != nullptr ? &before->clip : nullptr);
                kept = std::move(made);
            }
            now.emplace_back(item, kept);
            frozen.clips.push_back(std::move(kept));
        }
        live = std::move(now);
        return frozen;
    }

    Project restore(const ProjectSnapshot& frozen)
    {
        Project project = frozen.bare;
        decltype(live) now;
        for (const auto& item : frozen.clips)
        {
            std::shared_ptr<const ClipItem> found;
            for (const auto& [known, itsFrozen] : live)
                if (itsFrozen == item)
                    found = known;
            if (!found)
            {
                auto made = std::make_shared<ClipItem>(item->bare);
                made->clip = std::make_shared<const Clip>(item->clip.restore());
                found = std::move(made);
            }
            now.emplace_back(found, item);
            project.clips.push_back(std::move(found));
        }
        live = std::move(now);
        return project;
    }

    std::vector<State> states;
    std::size_t position = 0;
    std::uint64_t nextId = 1;
    NewIds ids;
    std::vector<std::pair<std::shared_ptr<const ClipItem>, std::shared_ptr<const ItemSnapshot>>>
        live; ///< of the current state
};

} // namespace pacini
