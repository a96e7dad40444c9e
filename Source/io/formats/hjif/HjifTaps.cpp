#include "io/formats/hjif/HjifTaps.h"

#include "io/formats/LossList.h"
#include "io/formats/hjif/HjifFormat.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pacini
{

namespace
{
constexpr double step = 0.001; // s, between the points of the bands

/// How strong an amplitude at `hertz` is felt beside one of the reference player's Transient: the weighting of HTS,
/// flat up to 300 Hz and -24 dB per octave above.
double feltBesideTap(double hertz)
{
    const auto weight = [](double frequency)
    {
        return 1.0 / (1.0 + std::pow(frequency / 300.0, 4.0));
    };
    return weight(hertz) / weight(2.0 / hjifTransientLength);
}

/// The bands of a clip while a Transient plays.
class BandsUnderTap
{
public:
    BandsUnderTap(Clip& clipToDuck, double start, double end, const Curve& envelope)
        : clip(clipToDuck), from(start), to(end)
    {
        double steps = 0.0, level = 0.0, power = 0.0, felt = 0.0;
        for (double time = from + 0.5 * step; time < to; time += step, steps += 1.0)
            level += std::pow(valueAt(envelope, time), 2.0);
        forEachPoint(
            [&](const Band& band, Breakpoint& point)
            {
                const double hertz = band.pitch.empty() ? band.centreFrequency : valueAt(band.pitch, from);
                power += point.value * point.value;
                felt += std::pow(feltBesideTap(hertz) * point.value, 2.0);
            });
        feltPower = power > 0.0 && steps > 0.0 ? level / steps * felt / power : 0.0;
    }

    /// As that of a Transient of this squared amplitude.
    [[nodiscard]] double powerFelt() const noexcept { return feltPower; }

    void duck(double share)
    {
        forEachPoint([&](const Band&, Breakpoint& point) { point.value *= std::sqrt(1.0 - share); });
    }

private:
    template <typename Visit>
    void forEachPoint(Visit visit)
    {
        for (Band& band : clip.bands)
        {
            auto point = std::lower_bound(band.amplitude.begin(), band.amplitude.end(), from - 0.5 * step,
                                          [](const Breakpoint& p, double time) { return p.time <= time; });
            for (; point != band.amplitude.end() && point->time < to - 0.5 * step; ++point)
                visit(band, *point);
        }
    }

    Clip& clip;
    double from, to;
    double feltPower = 0.0;
};
} // namespace

void hjifMakeRoom(Clip& clip, std::vector<HjifEvent>& events, const std::vector<HjifTapShare>& shares,
                  const Curve& envelope)
{
    constexpr double shortest = 0.005; // s
    constexpr double mostTaken = 0.95; // of the bands: they go on
    for (std::size_t i = 0; i < events.size(); ++i)
    {
        if (shares[i].least <= 0.0)
            continue; // it stays as it is told
        HjifEvent& told = events[i];
        const Transient& event = clip.transients[i];
        double end = event.time + hjifTransientLength;
        if (i + 1 < events.size())
            end = std::min(end, std::max(clip.transients[i + 1].time, event.time + shortest));
        BandsUnderTap bands(clip, event.time, end, envelope);
        double taken = shares[i].share;
        const double natural = told.tap * told.tap + taken * bands.powerFelt();
        double missing = shares[i].least * shares[i].least - natural;
        told.tap = std::sqrt(std::max(natural, shares[i].least * shares[i].least));
        if (missing > 0.0 && told.wave > 0.0)
        {
            // Hann windows have 3/8 of the energy of what they are over.
            const double perSquare = 3.0 / 8.0 * told.length / hjifTransientLength;
            const double fromWave = std::min(missing, perSquare * told.wave * told.wave);
            told.wave = std::sqrt(told.wave * told.wave - fromWave / perSquare);
            if (told.wave < leastAmplitude)
                told.wave = 0.0;
            missing -= fromWave;
        }
        if (missing > 0.0 && bands.powerFelt() > 0.0)
            taken = std::max(taken, std::min(taken + missing / bands.powerFelt(), mostTaken));
        bands.duck(taken);
    }
}

bool isHjifTap(const HjifEvent& told, double amplitude)
{
    return told.tap > 0.0 && told.tap >= 0.999 * hjifLeastTap * amplitude;
}

} // namespace pacini
