// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Rest in silence: when a chain of signal processing may pause, and the frames to make up for on waking.

#include <pacini/actuator/ProtectionParams.h>
#include <pacini/realtime/TranslatorDesign.h>
#include <pacini/realtime/TranslatorSetup.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

namespace pacini::plugin
{

/// Seconds of silence after which nothing of a translation moves by more than 1e-7 of full drive. Filters, envelopes,
/// gates and glides need less than 2 s; the mass of an actuator rings for longer when it is hardly damped: e^-17 is
/// 4e-8. Coils cool for minutes, but need no work for that (Translator::pass).
[[nodiscard]] inline double restSeconds(const TranslatorSetup& setup)
{
    constexpr double folds = 17.0;
    double seconds = 2.0;
    if (!setup.profile)
        return seconds;
    const ProtectionParams limits = protectionParams(*setup.profile, Seconds(0.0));
    if (limits.excursion)
        seconds =
            std::max(seconds, folds * limits.excursion->q / (std::numbers::pi * limits.excursion->frequency.value));
    return seconds;
}

/// Frames after which all grids of a translator and of the row of channels stand as they do now: groups of its
/// decimator, phases of the high samples (two inner frames each), its control hops, chords of 32 frames.
[[nodiscard]] inline std::size_t gridFrames(double sampleRate) noexcept
{
    const std::size_t factor = translatorFactor(sampleRate);
    return std::lcm(factor * std::lcm<std::size_t>(8, 2 * factor), std::size_t(32));
}

/// Counts still frames. After enough of them the chain rests: whole turns of its grids are skipped, since a still state
/// is the same after a turn. The rest of a turn is made up for on waking.
class SilenceWatch
{
public:
    static constexpr float stillness = 1e-7f; ///< -140 dB re full drive

    /// A turn longer than `longestTurn` would take too long to be made up for: then there is no rest.
    void prepare(double sampleRate) noexcept
    {
        constexpr std::size_t longestTurn = 2048;
        turn = gridFrames(sampleRate);
        possible = turn <= longestTurn;
        reset();
    }
    void reset() noexcept
    {
        still = owed = 0;
        skipped = 0.0;
        asleep = false;
    }

    [[nodiscard]] bool resting() const noexcept { return asleep; }

    /// Records processed frames: whether all were still, and the number of still frames needed to rest.
    void worked(std::size_t frames, bool wasStill, std::size_t needed) noexcept
    {
        still = wasStill ? still + frames : 0;
        asleep = possible && still > needed;
    }
    /// Records skipped frames.
    void rested(std::size_t frames) noexcept
    {
        owed = (owed + frames) % turn;
        skipped += static_cast<double>(frames);
    }

    /// Frames of silence: those that passed in whole turns, and those to work at when the rest ends.
    struct Debt
    {
        double passed = 0.0;
        std::size_t owed = 0;
    };

    /// Ends the rest, if there is one.
    [[nodiscard]] Debt wake() noexcept
    {
        const Debt debt{skipped - static_cast<double>(owed), owed};
        reset();
        return debt;
    }

private:
    std::size_t turn = 32;
    std::size_t still = 0, owed = 0;
    double skipped = 0.0; // all of the rest
    bool possible = true, asleep = false;
};

} // namespace pacini::plugin
