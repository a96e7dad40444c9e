#pragma once

// Playback position in a clip whose speed and pitch change.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace pacini
{

/// A straight piece of the clip's way through time.
struct ClockPiece
{
    double from = 0.0;  ///< frame of the output where it begins
    double clip = 0.0;  ///< frame of the clip that is played there
    double rate = 1.0;  ///< frames of the clip per frame, above 0
    double pitch = 1.0; ///< factor of every frequency

    bool operator==(const ClockPiece&) const = default;
    [[nodiscard]] double clipAt(double frame) const noexcept { return clip + (frame - from) * rate; }
    [[nodiscard]] double frameOf(double clipFrame) const noexcept { return from + (clipFrame - clip) / rate; }
};

/// Time map of a play. Maps frames of the output to frames of the clip: a chain of straight pieces, so that positions
/// are products and not sums that drift. Changes may be written down in advance and made while playing; both are exact
/// to a fraction of a frame. Real-time safe after construction.
class PlayClock
{
public:
    static constexpr std::size_t liveChanges = 64; ///< remembered at a time; they are forgotten when they have passed

    /// Rate and pitch 1 from frame 0 on, with room for `scheduled` changes.
    explicit PlayClock(std::size_t scheduled = 0)
    {
        pieces.reserve(1 + scheduled + liveChanges);
        pieces.push_back({});
    }

    /// Changes the rate of the clip to `rate` and the scale of its frequencies to `pitch` from frame `from` on. A
    /// change before a recorded one takes effect right after that instead, because time runs forward. Without room the
    /// last change is replaced. [audio]
    void change(double from, double rate, double pitch) noexcept
    {
        assert(rate > 0.0 && pitch > 0.0);
        const ClockPiece last = pieces.back();
        const double at = std::max(from, last.from);
        const ClockPiece next{at, last.clipAt(at), rate, pitch};
        if (at == last.from || pieces.size() == pieces.capacity())
            pieces.back() = next;
        else
            pieces.push_back(next);
    }

    /// Back to rate and pitch 1 from frame 0 on.
    void reset() noexcept
    {
        pieces.clear();
        pieces.push_back({});
    }

    /// Takes back changes after `frame`. [audio]
    void dropAfter(double frame) noexcept
    {
        while (pieces.size() > 1 && pieces.back().from > frame)
            pieces.pop_back();
    }

    /// Forgets pieces that end before `frame`, which makes room for changes. Takes as long as there are pieces. [audio]
    void forgetBefore(double frame) noexcept
    {
        pieces.erase(pieces.begin(), pieces.begin() + static_cast<std::ptrdiff_t>(indexAt(frame)));
    }

    [[nodiscard]] const ClockPiece& pieceAt(double frame) const noexcept { return pieces[indexAt(frame)]; }

    /// First frame after `frame` at which a new piece begins; infinite when there is none.
    [[nodiscard]] double nextChange(double frame) const noexcept
    {
        const std::size_t next = countUntil(&ClockPiece::from, frame);
        return next < pieces.size() ? pieces[next].from : std::numeric_limits<double>::infinity();
    }

    [[nodiscard]] double clipAt(double frame) const noexcept { return pieceAt(frame).clipAt(frame); }

    /// The frame at which the clip gets to `clipFrame`, as far as changes are known.
    [[nodiscard]] double frameOf(double clipFrame) const noexcept
    {
        return pieces[std::max<std::size_t>(countUntil(&ClockPiece::clip, clipFrame), 1) - 1].frameOf(clipFrame);
    }

    /// Whether the clip runs as it is, from the start and as far as changes are known.
    [[nodiscard]] bool untouched() const noexcept { return pieces.size() == 1 && pieces.front() == ClockPiece{}; }

private:
    /// Returns the number of pieces that begin at `value` or before, of the output or the clip: both grow from piece to
    /// piece.
    [[nodiscard]] std::size_t countUntil(double ClockPiece::*member, double value) const noexcept
    {
        const auto next = std::upper_bound(pieces.begin(), pieces.end(), value,
                                           [member](double v, const ClockPiece& piece) { return v < piece.*member; });
        return static_cast<std::size_t>(next - pieces.begin());
    }

    /// Returns the piece at `frame`; the first one for earlier frames.
    [[nodiscard]] std::size_t indexAt(double frame) const noexcept
    {
        return std::max<std::size_t>(countUntil(&ClockPiece::from, frame), 1) - 1;
    }

    std::vector<ClockPiece> pieces; // at least one
};

} // namespace pacini
