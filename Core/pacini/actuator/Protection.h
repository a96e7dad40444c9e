#pragma once

// Protection limiter, the last stage before the converter: keeps the drive within the limits of the actuator.

#include <pacini/actuator/CoilHeat.h>
#include <pacini/actuator/ExcursionGuard.h>
#include <pacini/actuator/FrameGroup.h>
#include <pacini/actuator/LimiterGain.h>
#include <pacini/actuator/ProtectionParams.h>
#include <pacini/actuator/RunningMean.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Pair.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

/// Report of the last call: gain reduction, and the reasons that applied during the
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

/// For every input the output stays within +-1, the modelled mass within its travel (its base held still and, where a
/// body is known, as it is worn), the modelled coil below its power.
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
///   output: the mean over any time T falls as 1/T, down to what the rounding to float takes, below 1e-7 of the drive.
///
/// Of a direct voltage, such as a motor's, the mean counts and a bound distorts no waveform: bounds alone remain there.
///
/// Both high-passes lie at a tenth of the range's low end, at most 5 Hz: together 0.09 dB at that low end. Signals 1 dB
/// below all limits pass otherwise unchanged. Input beyond +-100 counts as +-100.
///
/// Mostly no limit is near and the gain is 1. Whole groups of frames (see FrameGroup) for which bounds on the level,
/// the mass and the heat prove this leave out gain and guards, which would do nothing, and yield the same numbers.
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
        line.assign(frames + lineRoom, 0.0);
        gain.prepare(frames, static_cast<std::size_t>(longestLimiterHold * fs));
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
        const double leak =
            params.boundsAlone ? 0.0 : -std::expm1(-2.0 * std::numbers::pi * std::min(0.1 * low, 5.0) / fs);
        inputMean.design(leak);
        outputMean.design(leak);
        if (params.boundsAlone)
        {
            inputMean.reset();
            outputMean.reset();
            gain.reset();
        }
        framesIntoGroup = 0;
        const double seconds = clampTo(params.lookAhead.value, 0.0, maxLookAhead);
        const auto frames = std::min(static_cast<std::size_t>(seconds * fs), line.size() - lineRoom);
        if (frames != latency)
        {
            latency = frames;
            std::fill(line.begin(), line.end(), 0.0);
            position = latency;
        }
        gain.design(latency, static_cast<std::size_t>(limiterHold(params.lowFrequency) * fs), fs);
    }

    void reset() noexcept
    {
        excursion.reset();
        heat.reset();
        gain.reset();
        std::fill(line.begin(), line.end(), 0.0);
        position = latency;
        inputMean.reset();
        outputMean.reset();
        framesIntoGroup = 0;
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
        for (std::size_t begin = 0; begin < in.size();)
        {
            const std::size_t frames = stretch(in.size() - begin);
            const std::span<float> to = out.subspan(begin, frames);
            const double peak = take(in.subspan(begin, frames));
            if (!(wholeGroups(frames) && (passFreely(to, peak) || passGuarded(to, peak))))
                for (std::size_t i = 0; i < frames; ++i)
                    to[i] = tick(line[position + i], line[position + i - latency]);
            position += frames;
            framesIntoGroup = (framesIntoGroup + frames) % groupFrames;
            begin += frames;
            flush();
        }
        lastCall.gainReduction = -Decibels::fromGain(smallestGain).value;
    }

    /// Takes that `frames` frames of silence have passed since the last call: the coil has cooled. All else must have
    /// come to rest before.
    void pass(double frames) noexcept { heat.cool(frames); }

    [[nodiscard]] std::size_t latencyFrames() const noexcept { return latency; }

    /// Activity in the last call of process(). For the thread that calls process().
    [[nodiscard]] const ProtectionMeter& meter() const noexcept { return lastCall; }

    /// The largest gain reduction in the last call of process(), dB.
    [[nodiscard]] double gainReduction() const noexcept { return lastCall.gainReduction; }

private:
    static constexpr std::size_t longestStretch = flushInterval;
    static constexpr std::size_t lineRoom = 4 * longestStretch; ///< long enough that the line rarely moves

    /// Returns how many of the next `frames` are processed at once: whole groups if possible.
    [[nodiscard]] std::size_t stretch(std::size_t frames) const noexcept
    {
        if (framesIntoGroup > 0)
            return std::min(frames, groupFrames - framesIntoGroup);
        return frames < groupFrames ? frames : std::min(frames - frames % groupFrames, longestStretch);
    }

    [[nodiscard]] bool wholeGroups(std::size_t frames) const noexcept
    {
        return framesIntoGroup == 0 && frames % groupFrames == 0;
    }

    /// Writes the input without its mean to the end of the delay line and returns its peak. Of whole groups also finds
    /// the free drive, which is played if nothing has to act: the second high-pass runs beside the first.
    double take(std::span<const float> in) noexcept
    {
        if (position + in.size() > line.size())
        {
            std::copy(line.end() - static_cast<std::ptrdiff_t>(line.size() - position + latency),
                      line.begin() + static_cast<std::ptrdiff_t>(position), line.begin());
            position = latency;
        }
        std::array<float, longestStretch> borne;
        if (!areBearable(in))
        {
            std::transform(in.begin(), in.end(), borne.begin(), bearable);
            in = std::span(borne).first(in.size());
        }
        const std::span<double> to = std::span(line).subspan(position, in.size());
        if (wholeGroups(in.size()))
            return highPasses(in, to, std::span<const double>(line).subspan(position - latency, in.size()));
        double peak = 0.0;
        for (std::size_t i = 0; i < in.size(); ++i)
        {
            const auto x = static_cast<double>(in[i]);
            to[i] = x - inputMean.value();
            inputMean.follow(x);
            peak = std::max(peak, std::abs(to[i]));
        }
        return peak;
    }

    /// Whether bearable() changes none of them; by their bits, which are in the order of the magnitudes and need no
    /// branches.
    [[nodiscard]] static bool areBearable(std::span<const float> samples) noexcept
    {
        std::int32_t most = 0;
        for (const float x : samples)
            most = std::max(most, std::bit_cast<std::int32_t>(x) & std::numeric_limits<std::int32_t>::max());
        return most <= std::bit_cast<std::int32_t>(static_cast<float>(largestInput));
    }

    /// The sample within +-largestInput, 0 if it is not finite.
    [[nodiscard]] static float bearable(float sample) noexcept
    {
        constexpr auto largest = static_cast<float>(largestInput);
        const float finite = std::abs(sample) <= std::numeric_limits<float>::max() ? sample : 0.0f;
        const float above = finite > -largest ? finite : -largest;
        return above < largest ? above : largest;
    }

    /// Takes the mean out of whole groups of `in`, into `input`, and the second one out of those that are `delayed`,
    /// which may overlap these: into `freeDrive`. Returns the peak of the first; that of the second is kept.
    double highPasses(std::span<const float> in, std::span<double> input, std::span<const double> delayed) noexcept
    {
        RunningMean mean = inputMean;
        freeMean = outputMean;
        Pair before(mean.value(), freeMean.value());
        Pair peaks(0.0);
        for (std::size_t i = 0; i < input.size(); i += groupFrames)
        {
            std::array<Pair, groupFrames> rest;
            if (latency < groupFrames) // then the second waits for the first, and both for their sums
            {
                FrameGroup x, y;
                for (std::size_t k = 0; k < groupFrames; ++k)
                    x[k] = static_cast<double>(in[i + k]);
                const FrameGroup means = mean.followGroup(x);
                for (std::size_t k = 0; k < groupFrames; ++k)
                    input[i + k] = x[k] - (k == 0 ? before.first() : means[k - 1]);
                y = groupAt(delayed, i);
                const FrameGroup lateMeans = freeMean.followGroup(y);
                for (std::size_t k = 0; k < groupFrames; ++k)
                    rest[k] = Pair(input[i + k], y[k] - (k == 0 ? before.second() : lateMeans[k - 1]));
                before = Pair(means.back(), lateMeans.back());
            }
            else
            {
                std::array<Pair, groupFrames> x;
                for (std::size_t k = 0; k < groupFrames; ++k)
                    x[k] = Pair(static_cast<double>(in[i + k]), delayed[i + k]);
                const auto means = RunningMean::followGroups(mean, freeMean, x);
                for (std::size_t k = 0; k < groupFrames; ++k)
                    rest[k] = x[k] - (k == 0 ? before : means[k - 1]);
                before = means.back();
            }
            for (std::size_t k = 0; k < groupFrames; ++k)
            {
                input[i + k] = rest[k].first();
                freeDrive[i + k] = rest[k].second();
                peaks = larger(magnitude(rest[k]), peaks);
            }
        }
        inputMean = mean;
        freePeak = peaks.second();
        return peaks.first();
    }

    /// tick() for whole groups of frames that stay clear of all limits. Returns false and changes nothing if this is
    /// not certain.
    bool passFreely(std::span<float> out, double wantedPeak) noexcept
    {
        if (!gain.idle() || wantedPeak * wantedPeak > SoftKnee::startSquared || freePeak > 1.0)
            return false;
        const auto wanted = std::span<const double>(line).subspan(position, out.size());
        const auto played = std::span(freeDrive).first(out.size());
        const double peak = freePeak;
        for (double& drive : played)
            drive = inward(drive);

        const CoilHeat heatBefore = heat;
        if (current.heat && !heat.advanceFreely(wanted, played, peak, SoftKnee::startSquared))
            return false;
        if (current.excursion && !excursion.advanceFreely(wanted, wantedPeak, played, peak, SoftKnee::startSquared))
        {
            heat = heatBefore;
            return false;
        }
        outputMean = freeMean;
        for (std::size_t i = 0; i < out.size(); ++i)
            out[i] = static_cast<float>(played[i]);
        return true;
    }

    /// tick() for whole groups of frames that may approach a limit. Computes the gains, then the drives, and the bounds
    /// only if the drives may exceed them. Returns false and changes nothing if a level depends on the drives, as with
    /// heat.
    bool passGuarded(std::span<float> out, double wantedPeak) noexcept
    {
        std::array<double, longestStretch> gainRoom, driveRoom;
        const auto gains = std::span(gainRoom).first(out.size());
        const auto played = std::span(driveRoom).first(out.size());
        const auto delayed = std::span<const double>(line).subspan(position - latency, out.size());
        if (current.boundsAlone)
            std::fill(gains.begin(), gains.end(), 1.0);
        else if (!findGains(wantedPeak, gains))
            return false;

        RunningMean mean = outputMean;
        double peak = 0.0;
        for (std::size_t i = 0; i < out.size(); ++i)
        {
            const double free = delayed[i] - mean.value();
            const double drive = gains[i] * free;
            peak = std::max(peak, std::abs(drive));
            mean.follow(delayed[i], leakOfGain(gains[i]) * free);
            played[i] = inward(drive);
        }
        if (peak <= 1.0 && advanceFreely(played, peak))
        {
            outputMean = mean;
            for (std::size_t i = 0; i < out.size(); ++i)
                out[i] = static_cast<float>(played[i]);
        }
        else
            for (std::size_t i = 0; i < out.size(); ++i)
                out[i] = play(delayed[i], gains[i]);
        return true;
    }

    /// The gains for whole groups of frames of the input; false, without a change, where the heat may matter.
    bool findGains(double wantedPeak, std::span<double> gains) noexcept
    {
        const auto wanted = std::span<const double>(line).subspan(position, gains.size());
        if (current.heat && !heat.measureFreely(wanted, SoftKnee::startSquared))
            return false;
        for (std::size_t i = 0; i < gains.size(); ++i)
            gains[i] = wanted[i] * wanted[i];
        bool matters = wantedPeak * wantedPeak > SoftKnee::startSquared;
        lastCall.level |= matters;
        if (current.excursion)
        {
            const bool isNear =
                excursion.measure(wanted, wantedPeak, SoftKnee::startSquared, gains) > SoftKnee::startSquared;
            lastCall.excursion |= isNear;
            matters = matters || isNear;
        }
        if (!matters && gain.idle())
        {
            std::fill(gains.begin(), gains.end(), 1.0);
            return true;
        }
        for (double& g : gains)
        {
            g = gain.tick(g);
            smallestGain = std::min(smallestGain, g);
        }
        return true;
    }

    /// Lets coil and mass follow drives by whole groups of frames if all are certain to be within the bounds.
    bool advanceFreely(std::span<const double> played, double peak) noexcept
    {
        const CoilHeat before = heat;
        if (current.heat && !heat.advanceFreely(played, peak))
            return false;
        if (!current.excursion || excursion.advanceFreely(played, peak))
            return true;
        heat = before;
        return false;
    }

    /// One frame: from the input and the delayed input to the drive.
    float tick(double input, double delayed) noexcept
    {
        const double g = current.boundsAlone ? 1.0 : gain.tick(measure(input));
        smallestGain = std::min(smallestGain, g);
        return play(delayed, g);
    }

    /// Loss of the output's mean by a gain, as a fraction of the free drive.
    [[nodiscard]] double leakOfGain(double g) const noexcept { return outputMean.leakPerFrame() * (g - 1.0); }

    /// One frame: from the delayed input and its gain to the drive.
    float play(double delayed, double g) noexcept
    {
        const double free = delayed - outputMean.value();
        const double wanted = g * free;
        const double drive = bounded(wanted);
        outputMean.follow(delayed, drive == wanted ? leakOfGain(g) * free : outputMean.leakPerFrame() * (drive - free));
        const double played = inward(drive);
        if (current.heat)
            heat.advance(played);
        if (current.excursion)
            excursion.advance(played);
        return static_cast<float>(played);
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

    /// The drive nearest to `wanted` within all bounds.
    double bounded(double wanted) noexcept
    {
        double drive = clampTo(wanted, -1.0, 1.0);
        if (current.heat)
            drive = heat.admit(drive);
        if (current.excursion)
            drive = excursion.admit(drive);
        if (std::abs(wanted - drive) > 1e-4) // below -80 dB is what the second high-pass adds to a drive at its limit
            ++lastCall.guardedFrames;
        return drive;
    }

    /// toSample() towards 0, for a drive within +-1: without the digits that a float does not have.
    [[nodiscard]] static double inward(double drive) noexcept
    {
        constexpr std::uint64_t kept = ~((std::uint64_t(1) << 29) - 1);
        return std::abs(drive) >= 1e-30 ? std::bit_cast<double>(std::bit_cast<std::uint64_t>(drive) & kept) : 0.0;
    }

    void flush() noexcept
    {
        excursion.flush();
        heat.flush();
        inputMean.flush();
        outputMean.flush();
    }

    double fs = ProcessSpec{}.sampleRate;
    Params current;
    ExcursionGuard excursion;
    CoilHeat heat;
    LimiterGain gain;
    std::vector<double> line = std::vector<double>(lineRoom, 0.0); ///< the input without its mean, oldest first
    std::size_t latency = 0;
    std::size_t position = 0; ///< of the next input in the line
    std::size_t framesIntoGroup = 0;
    RunningMean inputMean;
    RunningMean outputMean;                         ///< leak times the sum of the output
    std::array<double, longestStretch> freeDrive{}; ///< of the stretch at hand, its peak and the mean after it
    double freePeak = 0.0;
    RunningMean freeMean;
    double smallestGain = 1.0;
    ProtectionMeter lastCall;
};

static_assert(DspBlock<Protection>);

} // namespace pacini
