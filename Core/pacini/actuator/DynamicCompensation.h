#pragma once

// Dynamic compensation: a filter that follows slowly what a worn actuator does to the levels of its drive.

#include <pacini/filters/StateVariable.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace pacini
{

/// Parameters of dynamic compensation. Numbers outside their range are clamped.
struct DynamicCompensationParams
{
    int bands = 12;                 ///< 1 to 24, evenly in octaves, as many as lie half a semitone apart
    Hertz lowFrequency{40.0};       ///< centre of the lowest band, 10 to 1000 Hz
    Hertz highFrequency{640.0};     ///< centre of the highest band, 10 Hz to 0.4 of the sample rate
    Seconds time{5.0};              ///< in which 63 % of a change are followed, 2 to 600 s
    Seconds delay{0.0};             ///< from the drive to the feedback, 0 to 1 s, to 10 ms
    Decibels limit{12.0};           ///< largest gain up or down of a band, 0 to 24 dB
    std::optional<Decibels> target; ///< feedback per drive; none: that of `time`, 2 s after a band first sounds
    bool needsEvidence = false;     ///< gains move only while the feedback is that of the drive, see SensorState
    bool operator==(const DynamicCompensationParams&) const = default;
};

/// What the feedback of the last 10 ms was like, with DynamicCompensationParams::needsEvidence. Full scale is 1.
enum class SensorState
{
    waiting,   ///< nothing was driven that could come back
    good,      ///< it follows the drive in some band
    apart,     ///< it does not follow the drive: unplugged, come off, or with another delay than told
    dead,      ///< it does not move at all
    saturated, ///< it is at full scale
    notANumber ///< it is NaN or infinite
};

/// Follows the response of a worn actuator by the level that comes back from a sensor (W. McMahan and K. J.
/// Kuchenbecker, "Haptic display of realistic tool contact via dynamically compensated control of a dedicated
/// actuator", IROS 2009, do it by a model; Weber 2020, ch. 3.2, by a fixed inverse filter). In each of a few bands, it
/// compares the power of its own output, delayed, with that of the feedback: their ratio P, dB, is the actuator's
/// alone, whatever the filter is. The gain g of the band goes to the wanted level less P by g' = (target - P - g) /
/// time, within
/// +-limit; peak sections make a filter of the gains, which a linear system of their overlaps turns into gains of the
/// sections. Where P is beyond the limit by more than 12 dB, the sensor has come off, and g goes to 0.
///
/// Stability. In dB and for small changes, P depends on g only by what the two powers are apart in time: with W the
/// response of the actuator's level to that of its drive (W(0) = 1, |W| <= 1: a delay, a resonance that rings) and d
/// the delay told, s g = -r g - r (W - exp(-s d)) g with r = 1 / time. It is stable where |W - exp(-s d)| r < |r + s|
/// on the imaginary axis (Rouche):
/// - with the right delay and a resonance that rings for any time, |1 - 1 / (1 + s T)| < 1: always;
/// - with a pure delay that is D off, 2 r |sin(w D / 2)| < |r + i w| holds for r D < 1: with a time of 2 s and more and
///   a delay of at most 1 s, r D <= 0.5, so no delay that can be told, however wrong, and no gain of the loop is
///   unstable. A gain margin of 2 remains at the worst of them.
/// Besides, gains are held within +-limit, and sections of this form stay bounded however they move (Wishnick 2014, see
/// StateVariable.h), so that no feedback at all, not even noise, makes the output grow.
///
/// Evidence. A sensor may come off, break or be unplugged, and what comes then, hum or noise, says nothing of the
/// actuator. With `needsEvidence`, levels of the drive (as it was played) and of the feedback, dB in steps of 10 ms and
/// smoothed over 30 ms, are compared over some 3 s in each band: those of the drive have to vary, and those of the
/// feedback with them, with a correlation of 0.6 at least (of some fifty levels; that of noise of its own is 0 within
/// 0.15) and a slope of 0.2. A band without that, which a steady tone is too, holds the gain that it had before, and so
/// do all bands for half a second after feedback that is no number, saturated or without any motion. So no feedback
/// raises a gain but one that follows the drive. Holding a gain opens the loop, which is as stable as its filter; what
/// was proven holds while it is closed. A held band glides back within 3 s by what it moved in the 6 s before, so in
/// steps of at most twice the largest that following takes.
///
/// Errors. Within a band the response keeps its shape; noise n dB below the feedback counts as 10 log10(1 + 10^(-n/10))
/// dB of response; a band whose drive is below -60 dB or 20 dB below the strongest band is held.
class DynamicCompensation : public DesignedBlock<DynamicCompensation, DynamicCompensationParams>
{
public:
    static constexpr std::size_t maxBands = 24;
    static constexpr double hopTime = 0.01;     ///< s between two updates
    static constexpr std::size_t gainHops = 20; ///< between two gains that are remembered
    static constexpr double returnTime = 3.0;   ///< s, of a held band to its gain of before
    static constexpr double lost = 12.0;        ///< dB beyond the limit from which on the feedback counts as lost

    /// Keeps what was learned unless the bands change.
    void setParams(const Params& params) noexcept
    {
        const auto clampTo = [](double value, double low, double high)
        {
            return value >= low ? std::min(value, high) : low; // NaN is the lowest
        };
        const auto before = bands;
        current = params;
        const double top = 0.4 * fs;
        const double low = clampTo(params.lowFrequency.value, 10.0, std::min(1000.0, top));
        const double high = clampTo(params.highFrequency.value, low, top);
        // Sections that are closer than half a semitone are hardly told apart.
        const int most = 1 + static_cast<int>(std::log2(high / low) * 24.0 + 1e-9);
        count = static_cast<std::size_t>(std::clamp(params.bands, 1, std::min(static_cast<int>(maxBands), most)));
        const double ratio = count > 1 ? std::pow(high / low, 1.0 / static_cast<double>(count - 1)) : 4.0;
        q = std::sqrt(ratio) / (ratio - 1.0);
        for (std::size_t k = 0; k < count; ++k)
            bands[k] = count > 1 ? low * std::pow(ratio, static_cast<double>(k)) : std::sqrt(low * high);
        for (std::size_t k = count; k < maxBands; ++k)
            bands[k] = 0.0;
        limit = clampTo(params.limit.value, 0.0, 24.0);
        hopFrames = static_cast<std::size_t>(std::max(1.0, std::round(hopTime * fs)));
        const double hop = static_cast<double>(hopFrames) / fs;
        follow = 1.0 - std::exp(-hop / clampTo(params.time.value, 2.0, 600.0));
        learning = static_cast<std::size_t>(clampTo(params.time.value, 2.0, 600.0) / hop);
        smooth = 1.0 - std::exp(-hop / 0.5);
        quick = 1.0 - std::exp(-hop / 0.03);
        memory = 1.0 - std::exp(-hop / 3.0);
        holdHops = static_cast<std::size_t>(0.5 / hop);
        returnHops = static_cast<std::size_t>(std::ceil(returnTime / hop));
        settling = static_cast<std::size_t>(2.0 / hop); // the longest delay, and what the smoothing of 0.5 s takes
        delayHops = static_cast<std::size_t>(std::round(clampTo(params.delay.value, 0.0, 1.0) / hop));
        delayHops = std::min(delayHops, history.size() - 1);
        for (std::size_t k = 0; k < count; ++k)
            passes.set(k, StateVariableLoop::design(bands[k], 1.0 / q, fs));
        measureOverlaps();
        if (bands != before)
            reset();
        else
            design();
    }

    void reset() noexcept
    {
        meters.fill({});
        passes.reset();
        for (auto& powers : history)
            powers.fill(0.0);
        states.fill({});
        check = {};
        holding = 0;
        sensorNow = SensorState::waiting;
        hopsDone = 0;
        frame = 0;
        design();
    }

    /// Without feedback: the filter as it is. [audio]
    void process(std::span<const float> in, std::span<float> out) noexcept
    {
        forEachSample(
            in, out, [this](double x) { return filtered(x); }, [this] { flush(); });
    }

    /// The same with what came back from the actuator meanwhile, as many frames. Neither may be `out` unless it is
    /// `in`. [audio]
    void process(std::span<const float> in, std::span<const float> feedback, std::span<float> out) noexcept
    {
        for (std::size_t i = 0; i < in.size(); ++i)
        {
            const double y = filtered(finiteOrZero(in[i]));
            const double back = finiteOrZero(feedback[i]);
            check.add(static_cast<double>(feedback[i]));
            passes.add(count, y, back);
            out[i] = toSample(y);
            if (++frame == hopFrames)
            {
                frame = 0;
                update();
            }
        }
        flush();
    }

    /// Learns from a drive as it was played, behind a limiter for one, and from what came back meanwhile, as many
    /// frames; for filters that were run without feedback. [audio]
    void learn(std::span<const float> played, std::span<const float> feedback) noexcept
    {
        for (std::size_t i = 0; i < played.size(); ++i)
        {
            check.add(static_cast<double>(feedback[i]));
            passes.add(count, finiteOrZero(played[i]), finiteOrZero(feedback[i]));
            if (++frame == hopFrames)
            {
                frame = 0;
                update();
            }
        }
        passes.flush();
    }

    /// What the sensor is like; without needsEvidence it is waiting. [audio]
    [[nodiscard]] SensorState sensor() const noexcept { return sensorNow; }

    /// Whether band k holds its gain, as nothing that followed the drive came back in it.
    [[nodiscard]] bool holds(std::size_t k) const noexcept { return meters[k].held; }

    /// Centres of the bands, Hz.
    [[nodiscard]] std::span<const double> frequencies() const noexcept { return std::span(bands).first(count); }

    /// The gain of band k now, dB.
    [[nodiscard]] double gain(std::size_t k) const noexcept { return meters[k].gain; }

    /// Feedback per drive of band k as measured last, dB; nothing before the band sounded.
    [[nodiscard]] std::optional<double> measured(std::size_t k) const noexcept { return meters[k].measured; }

    /// What band k is held at, dB; nothing while it is learned.
    [[nodiscard]] std::optional<double> reference(std::size_t k) const noexcept
    {
        const Meter& meter = meters[k];
        if (current.target)
            return current.target->value;
        return meter.learned >= learning ? std::optional(meter.sum / static_cast<double>(meter.learned)) : std::nullopt;
    }

    /// The complex gain at f now.
    [[nodiscard]] std::complex<double> response(Hertz f) const noexcept
    {
        std::complex<double> product = 1.0;
        for (std::size_t k = 0; k < count; ++k)
            product *= sections[k].response(f, fs);
        return product;
    }

private:
    /// What is known of one band.
    struct Meter
    {
        double smoothDrive = 0.0;                                    // power of the delayed drive
        double smoothBack = 0.0;                                     // and of the feedback
        double gain = 0.0;                                           // dB
        double heldGain = 0.0;                                       // dB, where it glides while it is held
        std::size_t returning = 0;                                   // hops until it is there
        double sum = 0.0;                                            // dB, of the hops learned from
        std::size_t waited = 0;                                      // hops
        std::size_t learned = 0;                                     // hops
        std::optional<double> measured;                              // dB
        double quickDrive = 0.0, quickBack = 0.0;                    // powers, smoothed over 30 ms
        double meanDrive = 0.0, meanBack = 0.0;                      // dB, over 3 s
        double variance = 0.0, varianceBack = 0.0, covariance = 0.0; // dB^2
        double weight = 0.0;                                         // of these, up to 1
        bool held = false;
        std::array<float, 32> before{}; // gains of the last seconds, dB, the oldest at hopsDone
    };

    /// The feedback of a hop as numbers.
    struct SensorCheck
    {
        double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();
        std::size_t full = 0;
        bool finite = true;

        void add(double x) noexcept
        {
            finite = finite && std::isfinite(x);
            least = std::min(least, x);
            most = std::max(most, x);
            full += std::abs(x) >= 0.999 ? 1u : 0u;
        }
        /// Good here means that nothing is wrong.
        [[nodiscard]] SensorState state() const noexcept
        {
            if (!finite)
                return SensorState::notANumber;
            if (full >= 3)
                return SensorState::saturated;
            return most - least > 1e-7 ? SensorState::good : SensorState::dead;
        }
    };

    /// Two band-passes in series for each band, of the drive and of the feedback, side by side to fill vector
    /// registers.
    struct BandPasses
    {
        using Lanes = std::array<double, maxBands>;
        Lanes g{}, damping{}, a2{}, a3{};
        std::array<Lanes, 4> s1{}, s2{};
        Lanes drive{}, back{}; // sums of squares of this hop

        void set(std::size_t k, const StateVariableLoop& loop) noexcept
        {
            g[k] = loop.g;
            damping[k] = loop.damping;
            a2[k] = loop.a2;
            a3[k] = loop.a3;
        }

        /// StateVariableState::tick, band k of the filter `at`.
        [[nodiscard]] double tick(std::size_t at, std::size_t k, double x) noexcept
        {
            const double u = (x - s2[at][k]) - damping[k] * s1[at][k];
            const double d1 = a2[k] * u;
            const double band = s1[at][k] + d1;
            const double low = s2[at][k] + (g[k] * s1[at][k] + a3[k] * u);
            s1[at][k] = band + d1;
            s2[at][k] = low + (g[k] * (band - d1) + a3[k] * u);
            return band;
        }

        void add(std::size_t bandCount, double y, double feedback) noexcept
        {
            for (std::size_t k = 0; k < bandCount; ++k)
            {
                const double a = tick(1, k, tick(0, k, y));
                const double b = tick(3, k, tick(2, k, feedback));
                drive[k] += a * a;
                back[k] += b * b;
            }
        }

        void reset() noexcept
        {
            for (std::size_t at = 0; at < s1.size(); ++at)
            {
                s1[at].fill(0.0);
                s2[at].fill(0.0);
            }
            drive.fill(0.0);
            back.fill(0.0);
        }

        void flush() noexcept
        {
            for (std::size_t at = 0; at < s1.size(); ++at)
                for (std::size_t k = 0; k < maxBands; ++k)
                {
                    flushTiny(s1[at][k]);
                    flushTiny(s2[at][k]);
                }
        }
    };

    [[nodiscard]] double filtered(double x) noexcept
    {
        for (std::size_t k = 0; k < count; ++k)
            x = states[k].tick(sections[k], x);
        return x;
    }

    void flush() noexcept
    {
        for (std::size_t k = 0; k < count; ++k)
            states[k].flush();
        passes.flush();
    }

    /// The end of a hop: new levels, and new gains of the bands that sound.
    void update() noexcept
    {
        const SensorState state = std::exchange(check, {}).state();
        if (current.needsEvidence && state != SensorState::good)
            holding = holdHops;
        const bool trusted = holding == 0;
        holding -= trusted ? 0 : 1;
        const std::size_t now = hopsDone % history.size();
        const std::size_t then = (hopsDone + history.size() - delayHops) % history.size();
        ++hopsDone;
        // Two band-passes of peak gain q each: a unit is that of full drive.
        const double scale = 1.0 / (q * q * q * q * static_cast<double>(hopFrames));
        double strongest = 0.0;
        bool moved = false, driven = false, followed = false;
        for (std::size_t k = 0; k < count; ++k)
        {
            Meter& meter = meters[k];
            moved = glideBack(meter) || moved;
            history[now][k] = scale * std::exchange(passes.drive[k], 0.0);
            const double back = scale * std::exchange(passes.back[k], 0.0);
            if (!trusted)
            {
                meter.held = true;
                continue;
            }
            meter.smoothDrive += smooth * (history[then][k] - meter.smoothDrive);
            meter.smoothBack += smooth * (back - meter.smoothBack);
            compareLevels(meter, history[then][k], back);
            strongest = std::max(strongest, meter.smoothDrive);
        }
        if (!trusted)
        {
            sensorNow = state != SensorState::good ? state : sensorNow;
            if (moved)
                design();
            return;
        }
        const double least = std::max(1e-6, 0.01 * strongest);
        for (std::size_t k = 0; k < count; ++k)
        {
            Meter& meter = meters[k];
            if (!(meter.smoothDrive >= least))
                continue;
            driven = true;
            if (current.needsEvidence && !hasEvidence(meter))
            {
                hold(meter);
                continue;
            }
            followed = true;
            constexpr double silence = 1e-30;
            meter.measured = 10.0 * std::log10((meter.smoothBack + silence) / meter.smoothDrive);
            const auto wanted = reference(k);
            if (!wanted)
            {
                release(meter);
                if (meter.waited < settling) // until the feedback is there, even if its delay was told wrong
                {
                    ++meter.waited;
                    continue;
                }
                meter.sum += *meter.measured;
                ++meter.learned;
                continue;
            }
            const double lack = *wanted - *meter.measured;
            if (current.needsEvidence && lack > limit + lost)
            {
                hold(meter);
                continue;
            }
            release(meter);
            moved = true;
            const double goal = lack > limit + lost ? 0.0 : std::clamp(lack, -limit, limit);
            meter.gain += follow * (goal - meter.gain);
            if (hopsDone % gainHops == 0)
                meter.before[hopsDone / gainHops % meter.before.size()] = static_cast<float>(meter.gain);
        }
        if (current.needsEvidence)
            sensorNow = !driven ? SensorState::waiting : followed ? SensorState::good : SensorState::apart;
        if (moved)
            design();
    }

    /// Holds a band from now on, at its gain of before the evidence began to fade: some 6 s ago.
    void hold(Meter& meter) noexcept
    {
        if (std::exchange(meter.held, true))
            return;
        const float before = meter.before[(hopsDone / gainHops + 1) % meter.before.size()];
        meter.before.fill(before);
        meter.heldGain = static_cast<double>(before);
        meter.returning = returnHops;
    }

    static void release(Meter& meter) noexcept
    {
        meter.held = false;
        meter.returning = 0;
    }

    /// Takes a held band one step towards its gain of before; whether it was still on its way there.
    [[nodiscard]] static bool glideBack(Meter& meter) noexcept
    {
        if (meter.returning == 0)
            return false;
        meter.gain += (meter.heldGain - meter.gain) / static_cast<double>(meter.returning);
        --meter.returning;
        return true;
    }

    /// Adds the powers of a hop to what is known of how the feedback varies with the drive.
    void compareLevels(Meter& meter, double drive, double back) noexcept
    {
        if (!current.needsEvidence)
            return;
        constexpr double silence = 1e-12;
        meter.quickDrive += quick * (drive - meter.quickDrive);
        meter.quickBack += quick * (back - meter.quickBack);
        // Pauses of the drive count as one level below which nothing has to come back.
        const double x = 10.0 * std::log10(std::max(meter.quickDrive, 1e-6)),
                     y = 10.0 * std::log10(meter.quickBack + silence);
        meter.weight += memory * (1.0 - meter.weight);
        const double share = memory / meter.weight;
        const double dx = x - meter.meanDrive, dy = y - meter.meanBack;
        meter.meanDrive += share * dx;
        meter.meanBack += share * dy;
        meter.variance += share * (dx * (x - meter.meanDrive) - meter.variance);
        meter.varianceBack += share * (dy * (y - meter.meanBack) - meter.varianceBack);
        meter.covariance += share * (dx * (y - meter.meanBack) - meter.covariance);
    }

    [[nodiscard]] static bool hasEvidence(const Meter& meter) noexcept
    {
        constexpr double leastVariance = 0.25; // dB^2: bands of noise vary by a dB and more
        constexpr double leastCorrelation = 0.6, leastSlope = 0.2;
        return meter.weight > 0.2 && meter.variance > leastVariance && meter.covariance > leastSlope * meter.variance &&
               meter.covariance > leastCorrelation * std::sqrt(meter.variance * meter.varianceBack);
    }

    /// Sections whose responses have the gains of the bands at their centres.
    void design() noexcept
    {
        for (std::size_t k = 0; k < count; ++k)
        {
            double level = 0.0;
            for (std::size_t j = 0; j < count; ++j)
                level += inverse[k][j] * std::clamp(meters[j].gain, -limit, limit);
            sections[k] = section(k, std::clamp(level, -40.0, 40.0));
        }
    }

    [[nodiscard]] StateVariableCoefficients section(std::size_t k, double level) const noexcept
    {
        return designStateVariable({BiquadType::peak, Hertz(bands[k]), q, Decibels(level)}, fs);
    }

    /// The inverse of what a gain of one section is at the centres of all, by Gauss and Jordan; the largest part of
    /// each row is on the diagonal.
    void measureOverlaps() noexcept
    {
        constexpr double probe = 6.0; // dB
        std::array<std::array<double, maxBands>, maxBands> overlaps{};
        for (std::size_t k = 0; k < count; ++k)
        {
            for (std::size_t j = 0; j < count; ++j)
                overlaps[k][j] =
                    Decibels::fromGain(std::abs(section(j, probe).response(Hertz(bands[k]), fs))).value / probe;
            inverse[k].fill(0.0);
            inverse[k][k] = 1.0;
        }
        for (std::size_t k = 0; k < count; ++k)
        {
            const double pivot = overlaps[k][k];
            for (std::size_t j = 0; j < count; ++j)
            {
                overlaps[k][j] /= pivot;
                inverse[k][j] /= pivot;
            }
            for (std::size_t i = 0; i < count; ++i)
            {
                const double share = i == k ? 0.0 : overlaps[i][k];
                for (std::size_t j = 0; j < count; ++j)
                {
                    overlaps[i][j] -= share * overlaps[k][j];
                    inverse[i][j] -= share * inverse[k][j];
                }
            }
        }
    }

    std::size_t count = 0;
    std::array<double, maxBands> bands{}; // Hz
    double q = 1.0;
    double limit = 12.0; // dB
    double follow = 0.0; // share of a change in one hop
    double smooth = 0.0, quick = 0.0, memory = 0.0;
    std::size_t holdHops = 50, holding = 0;
    std::size_t returnHops = 300;
    SensorCheck check;
    SensorState sensorNow = SensorState::waiting;
    std::size_t hopFrames = 480;
    std::size_t learning = 0; // hops
    std::size_t settling = 0; // hops
    std::size_t delayHops = 0;
    std::array<std::array<double, maxBands>, maxBands> inverse{};
    std::array<StateVariableCoefficients, maxBands> sections{};
    std::array<StateVariableState, maxBands> states{};
    std::array<Meter, maxBands> meters{};
    BandPasses passes;
    std::array<std::array<double, maxBands>, 104> history{}; // powers of the last second of the drive
    std::size_t hopsDone = 0;
    std::size_t frame = 0;
};

static_assert(DspBlock<DynamicCompensation>);

} // namespace pacini
