#pragma once

// Pace of a sound device against the clock of the machine.

#include <algorithm>
#include <chrono>

namespace pacini::live
{

/// Detects a sound device that has gone. The driver of a server that ended asks for blocks, or hands in the last one,
/// as fast as the machine can, and says nothing. A device that plays keeps to the clock but for its buffer: it may be
/// half a second ahead, and catch up ten seconds after a pause of the program.
class DevicePace
{
public:
    using Clock = std::chrono::steady_clock;

    /// Accounts for a block of `seconds` at `now`. Returns whether the device keeps to the clock; false lasts. [audio]
    [[nodiscard]] bool keeps(double seconds, Clock::time_point now) noexcept
    {
        const double passed = begun ? std::chrono::duration<double>(now - last).count() : 0.0;
        begun = true;
        last = now;
        ahead = std::max(ahead - passed, -longestPause);
        const double drift = tolerated * passed; // of the device's clock
        ahead = ahead > 0.0 ? std::max(0.0, ahead - drift) : std::min(0.0, ahead + drift);
        ahead += seconds;
        isKept = isKept && ahead <= largestLead;
        return isKept;
    }

private:
    static constexpr double largestLead = 0.5;   // s
    static constexpr double longestPause = 10.0; // s
    static constexpr double tolerated = 0.02;

    Clock::time_point last{};
    bool begun = false;
    bool isKept = true;
    double ahead = 0.0; // s of sound before the clock
};

} // namespace pacini::live
