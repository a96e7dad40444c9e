#pragma once

// Identifiers and states of plays.

#include <pacini/runtime/PlayMaker.h>

#include <atomic>
#include <cstdint>
#include <memory>

namespace pacini
{

/// Identifier of a play: a slot and its use count. Identifiers of ended plays are invalid.
struct PlayId
{
    std::uint32_t slot = 0;
    std::uint32_t generation = 0; ///< 0 = no play
    bool operator==(const PlayId&) const = default;
};

enum class PlayState
{
    ended,   ///< or never there
    waiting, ///< for its frame
    playing,
    paused,
    leftOut ///< there is no time or voice for it
};

struct PlayStatus
{
    PlayState state = PlayState::ended;
    double position = 0.0; ///< s of the clip
};

/// Place of a play: what its thread of commands and its audio thread know of it.
struct PlaySlot
{
    // [message]
    bool used = false;
    std::shared_ptr<const LoadedClip> clip;
    PlaySettings settings;
    // [any]
    std::atomic<std::uint32_t> generation{0};
    std::atomic<PlayState> state{PlayState::ended};
    std::atomic<double> position{0.0};
};

} // namespace pacini
