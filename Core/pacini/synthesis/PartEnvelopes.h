#pragma once

// Envelopes of the low and the high part of a clip, to which the parts are levelled before their sum.

#include <pacini/clip/Clip.h>
#include <pacini/synthesis/Roles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace pacini
{

/// Parts of a clip: below and above 200 Hz, where the fibres that feel flutter hand over to the Pacinian ones (S.
/// Bolanowski et al., "Four channels mediate the mechanical aspects of touch", 1988: both act from 40 Hz on, with equal
/// strength up to about 200 Hz for a small contact). Beats within a part are felt, even if the other part fills the
/// gaps of the sum.
constexpr std::size_t clipParts = 2;

/// Returns the part that contains `frequency`, Hz.
[[nodiscard]] constexpr std::size_t clipPartOf(double frequency) noexcept
{
    return frequency < 200.0 ? 0 : 1;
}

/// Divides the clip's envelope between the parts by the powers of their bands and noise; the amplitude share is the
/// root of the power share. Points lie at the points of the levels, at least 1 ms apart. Empty for a silent part; the
/// clip's own envelope for the only part that sounds.
[[nodiscard]] inline std::array<Curve, clipParts> partEnvelopes(const Clip& clip)
{
    struct Level
    {
        std::size_t part;
        CurveReader reader;
        double powerOfSquare; // noise is told as its RMS
    };
    std::vector<Level> levels;
    std::vector<double> times;
    std::array<bool, clipParts> sounds{};
    const auto add = [&](const Curve& curve, double frequency, double powerOfSquare)
    {
        if (std::all_of(curve.begin(), curve.end(), [](const Breakpoint& point) { return point.value == 0.0; }))
            return;
        const std::size_t part = clipPartOf(frequency);
        levels.push_back({part, CurveReader(curve), powerOfSquare});
        sounds[part] = true;
        for (const Breakpoint& point : curve)
            times.push_back(point.time);
    };
    for (const Band& band : clip.bands)
        add(band.amplitude, band.centreFrequency, 1.0);
    for (const NoiseBand& band : clip.noise)
        add(band.amplitude, 0.5 * (band.lowFrequency + band.highFrequency), 2.0);

    std::array<Curve, clipParts> envelopes;
    if (!sounds[0] || !sounds[1])
    {
        for (std::size_t part = 0; part < clipParts; ++part)
            if (sounds[part])
                envelopes[part] = clip.envelope;
        return envelopes;
    }
    for (const Breakpoint& point : clip.envelope)
        times.push_back(point.time);
    std::sort(times.begin(), times.end());
    constexpr double nearest = 0.001; // s
    CurveReader envelope(clip.envelope);
    double last = -1.0;
    for (const double time : times)
    {
        if (time < last + nearest)
            continue;
        last = time;
        std::array<double, clipParts> power{};
        for (Level& level : levels)
        {
            const double a = level.reader.at(time);
            power[level.part] += level.powerOfSquare * a * a;
        }
        const double total = power[0] + power[1];
        const double whole = envelope.at(time);
        for (std::size_t part = 0; part < clipParts; ++part)
            envelopes[part].push_back({time, total > 0.0 ? whole * std::sqrt(power[part] / total) : 0.0});
    }
    return envelopes;
}

/// Product of two curves, both constant outside their points; empty where one is. Between points of either it is taken
/// as straight.
[[nodiscard]] inline Curve productOf(const Curve& a, const Curve& b)
{
    Curve product;
    if (a.empty() || b.empty())
        return product;
    product.reserve(a.size() + b.size());
    CurveReader readA(a), readB(b);
    for (std::size_t i = 0, k = 0; i < a.size() || k < b.size();)
    {
        const double time = k == b.size() || (i < a.size() && a[i].time <= b[k].time) ? a[i].time : b[k].time;
        while (i < a.size() && a[i].time <= time)
            ++i;
        while (k < b.size() && b[k].time <= time)
            ++k;
        product.push_back({time, readA.at(time) * readB.at(time)});
    }
    return product;
}

/// Returns the amplitude share of tones or noise over the time of a clip: the root of the share of their power. First
/// the share in each part, empty if the role is silent there, then the share in the whole.
[[nodiscard]] inline std::array<Curve, clipParts + 1> roleShares(const Clip& clip, Role role)
{
    struct Level
    {
        std::size_t part;
        bool counts; // is of the role
        CurveReader reader;
        double powerOfSquare;
    };
    std::vector<Level> levels;
    std::vector<double> times;
    std::array<bool, clipParts + 1> sounds{};
    const auto add = [&](const Curve& curve, double frequency, double powerOfSquare, Role of)
    {
        if (std::all_of(curve.begin(), curve.end(), [](const Breakpoint& point) { return point.value == 0.0; }))
            return;
        const std::size_t part = clipPartOf(frequency);
        levels.push_back({part, of == role, CurveReader(curve), powerOfSquare});
        if (of == role)
            sounds[part] = sounds[clipParts] = true;
        for (const Breakpoint& point : curve)
            times.push_back(point.time);
    };
    for (const Band& band : clip.bands)
        add(band.amplitude, band.centreFrequency, 1.0, Role::tones);
    for (const NoiseBand& band : clip.noise)
        add(band.amplitude, 0.5 * (band.lowFrequency + band.highFrequency), 2.0, Role::noise);
    std::sort(times.begin(), times.end());
    std::array<Curve, clipParts + 1> shares;
    constexpr double nearest = 0.001; // s
    double last = -1.0;
    for (const double time : times)
    {
        if (time < last + nearest)
            continue;
        last = time;
        double total = 0.0;
        std::array<double, clipParts + 1> power{};
        for (Level& level : levels)
        {
            const double a = level.reader.at(time);
            total += level.powerOfSquare * a * a;
            if (level.counts)
                power[level.part] += level.powerOfSquare * a * a;
        }
        for (std::size_t part = 0; part < clipParts; ++part)
            power[clipParts] += power[part];
        for (std::size_t k = 0; k <= clipParts; ++k)
            if (sounds[k])
                shares[k].push_back({time, total > 0.0 ? std::sqrt(power[k] / total) : 0.0});
    }
    return shares;
}

} // namespace pacini
