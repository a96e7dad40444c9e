#pragma once

// Energy estimates of the parts of a scene, computed from their curves without rendering.

#include <pacini/clip/Clip.h>
#include <pacini/filters/BiquadCascade.h>
#include <pacini/synthesis/DecoderParams.h>
#include <pacini/synthesis/PlayClock.h>
#include <pacini/synthesis/PlayTimeline.h>
#include <pacini/synthesis/TransientPulse.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// The largest gains of an output filter for the parts of a clip.
struct PartGains
{
    std::vector<double> bands;
    std::vector<double> noise;
    double events = 1.0;

    [[nodiscard]] double largest() const noexcept
    {
        double most = 0.0;
        for (const double gain : bands)
            most = std::max(most, gain);
        for (const double gain : noise)
            most = std::max(most, gain);
        return most;
    }
};

/// Energies in (drive^2) s over all actuators.
struct PlayEnergy
{
    double least = 0.0;        ///< the play certainly carries this
    double most = 0.0;         ///< leaving the play out costs at most this
    std::vector<double> bands; ///< leaving one band out costs at most this
    std::vector<double> noise; ///< the same for bands of noise
    PartGains gains;
    bool levelled = false;   ///< bands are levelled to the envelope
    double bandErrors = 1.0; ///< energy of the error over that of a band left out

    /// Beats that are too fast to be levelled stand out by up to 4 / pi of power (Rayleigh).
    static constexpr double fastBeats = 1.3;
};

namespace detail
{
/// A curve over clip seconds as one over scene seconds.
inline Curve inSceneTime(const Curve& curve, const PlayClock& clock, double start)
{
    Curve result;
    result.reserve(curve.size());
    for (const Breakpoint& point : curve)
        result.push_back({start + clock.frameOf(point.time), point.value});
    return result;
}

/// Integral of (a b)^2 over [from, to]. Exact: between breakpoints this is a quartic, which three Gauss points
/// integrate (Abramowitz and Stegun 25.4.29). Curves are constant outside their points.
inline double energyOfProduct(const Curve& a, const Curve& b, double from, double to)
{
    double sum = 0.0;
    CurveReader readA(a), readB(b);
    std::size_t i = 0, k = 0;
    for (double t = from; t < to;)
    {
        while (i < a.size() && a[i].time <= t)
            ++i;
        while (k < b.size() && b[k].time <= t)
            ++k;
        double end = to;
        if (i < a.size())
            end = std::min(end, a[i].time);
        if (k < b.size())
            end = std::min(end, b[k].time);
        const std::array<std::array<double, 2>, 3> gauss = {
            {{0.1127016653792583, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.8872983346207417, 5.0 / 18.0}}};
        for (const auto& [at, weight] : gauss)
        {
            const double x = t + at * (end - t);
            const double v = readA.at(x) * readB.at(x);
            sum += weight * (end - t) * v * v;
        }
        t = end;
    }
    return sum;
}

/// Gains times a level (empty: 1), between `from` and `to`. Where both move the product is straight over a sixteenth.
inline std::vector<Curve> withLevel(const std::vector<Curve>& gains, const Curve& level, double from, double to)
{
    if (level.empty())
        return gains;
    std::vector<Curve> products;
    for (const Curve& gain : gains)
    {
        std::vector<double> times = bends(gain, level, 16);
        for (const double time : bends(level, gain, 16))
            times.push_back(time);
        times.push_back(from);
        times.push_back(to);
        std::sort(times.begin(), times.end());
        times.erase(std::unique(times.begin(), times.end()), times.end());
        Curve product;
        for (const double time : times)
            if (time >= from && time <= to)
                appendSides(product, time, [&](double t) { return valueAt(gain, t) * valueAt(level, t); });
        products.push_back(std::move(product));
    }
    return products;
}

/// Smallest and largest power gain of an equaliser between two frequencies.
struct PowerRange
{
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    void include(double power)
    {
        least = std::min(least, power);
        most = std::max(most, power);
    }
};

inline PowerRange equalizerPower(const BiquadCascadeCoefficients& equalizer, double low, double high, double fs)
{
    PowerRange range;
    constexpr int steps = 8;
    for (int i = 0; i <= steps; ++i)
    {
        const double f = std::clamp(low * std::pow(high / low, static_cast<double>(i) / steps), 0.5, 0.49 * fs);
        range.include(std::norm(equalizer.response(Hertz(f), fs)));
    }
    return range;
}

/// Sums the energies of the parts of a play.
class PlayEnergySum
{
public:
    PlayEnergySum(const Clip& played, const DecoderParams& decoder, const PlayTimeline& moving, double from,
                  double duration, const BiquadCascadeCoefficients& filter)
        : clip(played),
          params(decoder),
          timeline(moving),
          cascade(filter),
          clock(makeClock(decoder.stretch, moving)),
          start(from),
          end(std::min(duration, from + clock.frameOf(played.duration))),
          lowest(decoder.transposition),
          highest(decoder.transposition),
          mixed(hasRoleLevels(moving))
    {
        for (const DecoderChange& change : timeline.changes)
        {
            lowest = std::min(lowest, change.transposition);
            highest = std::max(highest, change.transposition);
        }
        for (const Role role : allRoles)
            if (mixed)
                gainsOf[role] = withLevel(timeline.gains, timeline.roles[role], start, end);
        result.levelled = params.followEnvelope && !clip.envelope.empty();
    }

    [[nodiscard]] PlayEnergy sum()
    {
        for (const Band& band : clip.bands)
        {
            double low = std::max(band.centreFrequency, 1.0), high = low;
            if (params.carriers == CarrierMode::pitch && !band.pitch.empty())
            {
                const auto [a, b] = std::minmax_element(band.pitch.begin(), band.pitch.end(),
                                                        [](const auto& p, const auto& q) { return p.value < q.value; });
                low = std::max(a->value, 1.0);
                high = std::max(b->value, low);
            }
            add(band.amplitude, 0.5, Role::tones, power(low, high), result.bands, result.gains.bands);
        }
        for (const NoiseBand& band : clip.noise)
            add(band.amplitude, 1.0, Role::noise,
                power(std::max(1.0, band.lowFrequency), std::max(2.0, band.highFrequency)), result.noise,
                result.gains.noise);
        result.most = heardSum * whole.most;
        if (result.levelled && ownSum > 0.0)
            level();
        addEvents();
        return std::move(result);
    }

private:
    [[nodiscard]] double energyBy(const Curve& curve, const std::vector<Curve>& gains) const
    {
        const Curve inScene = inSceneTime(curve, clock, start);
        double energy = 0.0;
        for (const Curve& gain : gains)
            energy += energyOfProduct(inScene, gain, start, end);
        return energy * params.gain * params.gain;
    }

    [[nodiscard]] PowerRange power(double low, double high) const
    {
        return equalizerPower(cascade, low * std::pow(2.0, lowest / 12.0), high * std::pow(2.0, highest / 12.0),
                              params.sampleRate);
    }

    /// A band whose curve squared carries `share` of its energy.
    void add(const Curve& amplitude, double share, Role role, const PowerRange& range, std::vector<double>& energies,
             std::vector<double>& gains)
    {
        const double own = share * energyBy(amplitude, timeline.gains);
        const double heard = mixed ? share * energyBy(amplitude, gainsOf[role]) : own;
        energies.push_back(heard * range.most);
        gains.push_back(std::sqrt(range.most));
        ownSum += own;
        heardSum += heard;
        if (own > 0.0)
        {
            result.least += heard * range.least;
            whole.include(range.most);
        }
    }

    /// The bands are levelled to the envelope, so the envelope determines their energy.
    void level()
    {
        const double wanted = 0.5 * energyBy(clip.envelope, timeline.gains);
        result.least *= wanted / ownSum;
        result.most = (mixed ? heardSum / ownSum * wanted : wanted) * whole.most * PlayEnergy::fastBeats;
        result.bandErrors = 4.0 * std::max(1.0, wanted / ownSum);
        for (double& band : result.bands)
            band *= result.bandErrors;
        for (double& band : result.noise)
            band *= result.bandErrors;
        // A band that is missing raises what is levelled with it, which may be at another level.
        if (mixed && !clip.bands.empty() && !clip.noise.empty())
            std::fill(result.bands.begin(), result.bands.end(), std::numeric_limits<double>::infinity());
    }

    void addEvents()
    {
        const auto broad = power(40.0, 400.0);
        result.gains.events = std::sqrt(broad.most);
        for (const Transient& event : clip.transients)
        {
            const double at = start + clock.frameOf(event.time);
            if (at >= end)
                break;
            double gain = 0.0;
            for (const Curve& curve : mixed ? gainsOf[Role::events] : timeline.gains)
                gain += std::pow(valueAt(curve, at), 2.0);
            // A sine under a squared sine: 3 / 16 of its length, which is at most 20 ms alone and at least 5 ms in
            // trains.
            const double unit = 3.0 / 16.0 * gain * params.gain * params.gain * event.amplitude * event.amplitude;
            const double longest = params.pulses.shape == TransientShape::adaptive
                                       ? 0.02
                                       : 5.0 * params.pulses.cycles / params.pulses.frequency;
            result.most += unit * longest * broad.most;
            if (!result.levelled || valueAt(clip.envelope, event.time) == 0.0)
                result.least += unit * 0.004 * broad.least;
        }
    }

    const Clip& clip;
    const DecoderParams& params;
    const PlayTimeline& timeline;
    const BiquadCascadeCoefficients& cascade;
    const PlayClock clock;
    const double start, end; ///< s of the scene
    double lowest, highest;  ///< semitones of transposition
    const bool mixed;        ///< roles have levels of their own
    PerRole<std::vector<Curve>> gainsOf;
    double ownSum = 0.0, heardSum = 0.0;
    PowerRange whole;
    PlayEnergy result;
};
} // namespace detail

/// Returns the energy that a play's clip (as it will be decoded) adds to a scene of `duration` seconds, after the
/// output filter `cascade`, designed for the rate of `params`. Sinusoids carry half their squared amplitude. If the
/// bands are levelled to the envelope, the envelope determines the energy, and the other bands make up for a missing
/// band: that costs at most its amplitude twice.
[[nodiscard]] inline PlayEnergy playEnergy(const Clip& clip, const DecoderParams& params, const PlayTimeline& timeline,
                                           double start, double duration, const BiquadCascadeCoefficients& cascade)
{
    return detail::PlayEnergySum(clip, params, timeline, start, duration, cascade).sum();
}

} // namespace pacini
