#pragma once

// The sweeps of a measurement through an equalizer, to verify it.

#include <pacini/actuator/Equalizer.h>
#include <pacini/linearize/SweepSchedule.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini
{

/// A measuring signal through an equalizer.
struct EqualizedSweep
{
    std::vector<float> signal;
    SweepParams sweep;    ///< the played sweep: as requested, but at levels that fit
    double lowered = 0.0; ///< reduction of its levels from the requested ones, dB, a whole number
    double gain = 0.0;    ///< gain of the signal above the levels in `sweep`, dB, 0 or more
    double peak = 0.0;    ///< the largest magnitude, at most 1
};

/// Returns makeSweepSignal(params) filtered by `sections`. A boost beyond full scale would be clipped and measured as
/// distortion, so all levels are lowered together by the fewest whole dB that make the signal fit. `raised`: a signal
/// below the loudest level is scaled up to it, since an equalizer that lowers nearly everything would otherwise leave
/// it in the noise. Errors: those of makeSweepSignal(); invalidArgument at `levels` if the lowest would have to leave
/// its range.
[[nodiscard]] inline Result<EqualizedSweep> makeEqualizedSweep(const SweepParams& params,
                                                               const EqualizerSections& sections, bool raised = false)
{
    constexpr std::size_t blockFrames = 4096;
    auto made = makeSweepSignal(params);
    if (!made)
        return made.error();
    EqualizedSweep sweep{std::move(made).value(), params, 0.0, 0.0, 0.0};
    if (!sections.empty())
    {
        Equalizer equalizer;
        equalizer.prepare({params.sampleRate, blockFrames});
        equalizer.setParams(sections);
        equalizer.reset();
        for (std::size_t i = 0; i < sweep.signal.size(); i += blockFrames)
        {
            const auto part = std::span(sweep.signal).subspan(i, std::min(blockFrames, sweep.signal.size() - i));
            equalizer.process(part, part);
        }
    }
    for (const float v : sweep.signal)
        sweep.peak = std::max(sweep.peak, static_cast<double>(std::abs(v)));
    const auto scale = [&sweep](double gain)
    {
        for (float& v : sweep.signal)
            v = static_cast<float>(gain * static_cast<double>(v));
        sweep.peak *= gain;
    };
    if (sweep.peak > 1.0)
    {
        sweep.lowered = std::ceil(Decibels::fromGain(sweep.peak).value);
        for (double& level : sweep.sweep.levels)
            level -= sweep.lowered;
        if (!validate(sweep.sweep))
            return Error{ErrorCode::invalidArgument, "levels",
                         "cannot be lowered by the " + std::to_string(std::lround(sweep.lowered)) +
                             " dB by which the equaliser raises the sweep beyond full scale: the lowest would be below "
                             "-80 dB"};
        scale(Decibels(-sweep.lowered).gain());
        return sweep;
    }
    const double wanted = Decibels(*std::max_element(params.levels.begin(), params.levels.end())).gain();
    if (raised && !sections.empty() && sweep.peak > 0.0 && sweep.peak < wanted)
    {
        sweep.gain = Decibels::fromGain(wanted / sweep.peak).value;
        scale(wanted / sweep.peak);
    }
    return sweep;
}

} // namespace pacini
