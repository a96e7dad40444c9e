#pragma once

// The last stage before the converter: no drive leaves it that the actuator does not bear.

#include <pacini/actuator/CoilHeat.h>
#include <pacini/actuator/ExcursionGuard.h>
#include <pacini/actuator/LimiterGain.h>
#include <pacini/actuator/ProtectionParams.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

/// What the protection did in its last call. The reasons are those for which the gain is reduced now or was in the
/// call.
struct ProtectionMeter
{
    double gainReduction = 0.0;    ///< dB, the largest of the smooth gain
    bool level = false;            ///< the drive comes near full scale
    bool excursion = false;        ///< the moving mass comes near the end of its travel
    bool heat = false;             ///< the coil comes near its limit
    std::size_t guardedFrames = 0; ///< on which a hard bound had to act after the gain
    bool operator==(const ProtectionMeter&) const = default;
};

/// For every input the output stays within +-1, the modelled mass within its travel, the modelled coil below its power.
///
/// - A first-order high-pass takes out the input's mean.
/// - One smooth gain answers the worst of three levels, each relative to its limit (see LimiterGain): the drive itself,
///   the peak that it would cause in the resonator, its heat. The signal waits for the look-ahead.
/// - Hard bounds on the single sample follow, which hold for any input (see ExcursionGuard, CoilHeat). They come last:
///   each of them also bears any smaller drive of the same sign, so that they do not undo each other, and nothing after
///   them changes the drive but its rounding to float, towards 0.
/// - What a limiter cuts from one side of an uneven waveform is a mean again. A filter behind the bounds would break
///   them, so the second high-pass runs around them: the integral of the output is taken from the limiter's input.
///   It stays bounded (the limiter keeps signs, so the output always leads it back), and with it the sum of all
///   output: the mean over any time T falls as 1/T.
///
/// Both high-passes lie at a tenth of the range's low end, at most 5 Hz: together 0.09 dB at that low end. Signals 1 dB
/// below all limits pass otherwise unchanged. Input beyond +-100 counts as +-100.
class Protection
{
public:
    using Params = ProtectionParams;

    static constexpr double maxLookAhead = 0.001; ///< s
    static constexpr double largestInput = 100.0;

    void prepare(const ProcessSpec& spec)
    {
        fs = spec.sampleRate;
        const auto frames = static_cast<std::size_t>(maxLookAhead * fs);
        delay.assign(frames + 1, 0.0);
        gain.prepare(frames);
        setParams(current);
        reset();
    }

    /// Limits may move while the block runs; a state beyond a limit that was just narrowed decays into it. A limit that
    /// was not there before takes the mass to be at rest, the coil to be cold. A changed look-ahead starts again from
    /// silence in the delay.
    void setParams(const Params& params) noexcept
    {
        if (!current.excursion)
            excursion.reset();
        if (!current.heat)
            heat.reset();
        current = params;
        const double low = clampTo(params.lowFrequency.value, 1.0, 20000.0);
        if (params.excursion)
            excursion.design(*params.excursion, fs);
        if (params.heat)
            heat.design(*params.heat, fs);
        leak = -std::expm1(-2.0 * std::numbers::pi * std::min(0.1 * low, 5.0) / fs);
        const double seconds = clampTo(params.lookAhead.value, 0.0, maxLookAhead);
        const auto frames = std::min(static_cast<std::size_t>(seconds * fs), delay.size() - 1);
        if (frames != latency)
        {
            latency = frames;
            std::fill(delay.begin(), delay.end(), 0.0);
            position = 0;
        }
        gain.design(latency, static_cast<std::size_t>(clampTo(0.5 / low, 0.002, 0.05) * fs), fs);
    }

    void reset() noexcept
    {
        excursion.reset();
        heat.reset();
        gain.reset();
        std::fill(delay.begin(), delay.end(), 0.0);
        position = 0;
        inputMean = outputSum = 0.0;
        smallestGain = 1.0;
        lastCall = {};
    }

    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        lastCall.gainReduction = 0.0;
        lastCall.guardedFrames = 0;
        if (smallestGain == 1.0)
            lastCall = {};
        smallestGain = 1.0;
        const auto flush = [this]
        {
            excursion.flush();
            heat.flush();
            flushTiny(inputMean);
            flushTiny(outputSum);
        };
        forEachSample(
            in, out, [this](double x) { return tick(x); }, flush);
        lastCall.gainReduction = -20.0 * std::log10(smallestGain);
    }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return latency; }

    /// What happened in the last call of process(); of the thread that calls it.
    [[nodiscard]] const ProtectionMeter& meter() const noexcept { return lastCall; }

    /// The largest gain reduction in the last call of process(), dB.
    [[nodiscard]] double gainReduction() const noexcept { return lastCall.gainReduction; }

private:
    double tick(double x) noexcept
    {
        const double input = clampTo(x, -largestInput, largestInput) - inputMean;
        inputMean += leak * input;

        const double g = gain.tick(measure(input));
        smallestGain = std::min(smallestGain, g);

        delay[position] = input;
        position = position == latency ? 0 : position + 1;
        const double drive = bounded(g * (delay[position] - outputSum));
        outputSum += leak * drive;
        return drive;
    }

    /// The square of the worst level over its limit.
    double measure(double wanted) noexcept
    {
        double worst = wanted * wanted;
        lastCall.level |= worst > SoftKnee::startSquared;
        if (current.excursion)
        {
            const double ratio = excursion.measure(wanted);
            lastCall.excursion |= ratio > SoftKnee::startSquared;
            worst = std::max(worst, ratio);
        }
        if (current.heat)
        {
            const double ratio = heat.measure(wanted);
            lastCall.heat |= ratio > SoftKnee::startSquared;
            worst = std::max(worst, ratio);
        }
        return worst;
    }

    /// The drive nearest to `wanted` within all bounds, as the float that leaves the block.
    double bounded(double wanted) noexcept
    {
        double drive = clampTo(wanted, -1.0, 1.0);
        if (current.heat)
            drive = heat.admit(drive);
        if (current.excursion)
            drive = excursion.admit(drive);
        if (std::abs(wanted - drive) > 1e-6)
            ++lastCall.guardedFrames;
        float sample = toSample(drive);
        if (std::abs(static_cast<double>(sample)) > std::abs(drive))
            sample = std::nextafter(sample, 0.0f);
        drive = static_cast<double>(sample);
        if (current.heat)
            heat.advance(drive);
        if (current.excursion)
            excursion.advance(drive);
        return drive;
    }

    double fs = ProcessSpec{}.sampleRate;
    Params current;
    ExcursionGuard excursion;
    CoilHeat heat;
    LimiterGain gain;
    std::vector<double> delay = std::vector<double>(1, 0.0);
    std::size_t latency = 0;
    std::size_t position = 0;
    double leak = 0.0;
    double inputMean = 0.0;
    double outputSum = 0.0; ///< times leak
    double smallestGain = 1.0;
    ProtectionMeter lastCall;
};

static_assert(DspBlock<Protection>);

} // namespace pacini
