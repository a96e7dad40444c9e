#pragma once

// The sweeps of a measurement through an equalizer, to verify it.

#include <pacini/actuator/Equalizer.h>
#include <pacini/linearize/SweepSchedule.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

struct EqualizedSweep
{
    std::vector<float> signal;
    double peak = 0.0; ///< the largest magnitude; above 1 it would be cut off
};

/// makeSweepSignal(params) through `sections`; as it is without any. Errors: those of makeSweepSignal().
[[nodiscard]] inline Result<EqualizedSweep> makeEqualizedSweep(const SweepParams& params,
                                                               const EqualizerSections& sections)
{
    constexpr std::size_t blockFrames = 4096;
    auto made = makeSweepSignal(params);
    if (!made)
        return made.error();
    EqualizedSweep sweep{std::move(made).value(), 0.0};
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
    return sweep;
}

} // namespace pacini
