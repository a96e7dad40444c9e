#pragma once

// Commands to an engine, and the order in which they are carried out.

#include <pacini/runtime/LiveControl.h>
#include <pacini/runtime/PlayContent.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pacini
{

/// One command, for a frame of the output.
struct LiveCommand
{
    enum class Kind
    {
        start,   ///< `play` begins
        replace, ///< `content` takes the place of what plays
        stop,    ///< fades out within `glide` and ends
        pause,   ///< fades out within `glide` and waits
        resume,
        set,      ///< `control` of a play
        setGroup, ///< `control` of a group: gain and levels of roles are faders of its own, the rest is set in all
                  ///< plays that it has now
        stopGroup,
        setActuator, ///< gain of actuator `slot`, 0 to 1
        setBudget    ///< `value`: see EngineBudget
    };
    std::int64_t frame = 0;     ///< of the output; what has passed is now
    std::uint64_t sequence = 0; ///< among commands for one frame
    Kind kind = Kind::start;
    LiveControl control = LiveControl::gain;
    std::uint32_t slot = 0; ///< of the play, the group or the actuator
    std::uint32_t generation = 0;
    double value = 0.0;
    std::size_t glide = 0; ///< frames
    LivePlay* play = nullptr;
    PlayContent* content = nullptr;
};

/// Commands that wait for their frame, in a heap of fixed size. [audio]
class CommandSchedule
{
public:
    explicit CommandSchedule(std::size_t capacity) { heap.reserve(capacity); }

    [[nodiscard]] bool full() const noexcept { return heap.size() == heap.capacity(); }
    [[nodiscard]] bool empty() const noexcept { return heap.empty(); }

    /// Not when it is full.
    void push(const LiveCommand& command) noexcept
    {
        heap.push_back(command);
        std::push_heap(heap.begin(), heap.end(), later);
    }

    /// The next one; there must be one.
    [[nodiscard]] const LiveCommand& next() const noexcept { return heap.front(); }

    void pop() noexcept
    {
        std::pop_heap(heap.begin(), heap.end(), later);
        heap.pop_back();
    }

private:
    static bool later(const LiveCommand& a, const LiveCommand& b) noexcept
    {
        return a.frame != b.frame ? a.frame > b.frame : a.sequence > b.sequence;
    }

    std::vector<LiveCommand> heap;
};

} // namespace pacini
