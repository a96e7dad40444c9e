#include "io/formats/hjif/HjifWaves.h"

#include "io/JsonText.h"
#include "io/formats/hjif/HjifFormat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace pacini
{

namespace
{
/// Amplitude of a base signal's first harmonic; none for unknown signals.
std::optional<double> fundamentalOf(std::string_view signal)
{
    constexpr double pi = std::numbers::pi;
    if (signal == "Sine")
        return 1.0;
    if (signal == "Square")
        return 4.0 / pi;
    if (signal == "Triangle")
        return 8.0 / (pi * pi);
    if (signal == "SawToothUp" || signal == "SawToothDown")
        return 2.0 / pi;
    return {};
}

/// Cycles at the start of a clip of a wave that is at `phase` (rad) `start` s later: what a band keeps. 0 for a wave
/// that starts so late that whole numbers of Hz, as files have them, leave it open; later waves of a band go on from
/// the first.
double phaseAtStart(double phase, double start, const Curve& pitch)
{
    constexpr double latest = 0.04; // s: half a Hz is a fiftieth of a cycle until then
    constexpr double least = 0.001; // cycles, of which files have fewer
    if (!(start <= latest) || (pitch.empty() && start > 0.0))
        return 0.0;
    const double cycles = phase / (2.0 * std::numbers::pi) - (pitch.empty() ? 0.0 : pitch.front().value * start);
    const double fraction = cycles - std::floor(cycles);
    return fraction < least || fraction > 1.0 - least ? 0.0 : fraction;
}

/// Between effects there is silence.
void append(Curve& curve, const Curve& next)
{
    if (next.empty())
        return;
    if (!curve.empty() && curve.back().value > 0.0 && next.front().time > curve.back().time)
        curve.push_back({curve.back().time, 0.0});
    const double before = curve.empty() ? 0.0 : curve.back().value;
    if (next.front().time > 0.0 && before == 0.0 && next.front().value > 0.0)
        curve.push_back({next.front().time, 0.0});
    curve.insert(curve.end(), next.begin(), next.end());
}

/// The height of a wave that rises from 0 once and falls back to 0 at one frequency; none for others.
std::optional<double> heightOfPulse(const std::vector<HjifKeyframe>& keyframes)
{
    bool falls = false;
    double peak = 0.0, before = 0.0;
    for (std::size_t i = 0; i < keyframes.size(); ++i)
    {
        if (!keyframes[i].amplitude || (i > 0 && keyframes[i].frequency))
            return {};
        const double value = *keyframes[i].amplitude;
        const bool isEnd = i == 0 || i + 1 == keyframes.size();
        falls = falls || value < before;
        if (isEnd != (value == 0.0) || (falls && value > before))
            return {};
        peak = std::max(peak, value);
        before = value;
    }
    return peak;
}
} // namespace

std::optional<Transient> hjifPulse(const HjifEffect& effect, double position, const HjifScale& scale)
{
    constexpr double longest = 0.030; // s
    const auto& keyframes = effect.keyframes;
    if (keyframes.size() < 3 || effect.baseSignal != "Sine" || !keyframes.front().frequency)
        return {};
    const double length = (keyframes.back().position - keyframes.front().position) / scale.ticks;
    auto peak = heightOfPulse(keyframes);
    const double frequency = *keyframes.front().frequency;
    if (!peak || !(length > 0.0 && length <= longest && frequency >= 1.0))
        return {};
    // Between two ticks lies the peak of a window of an odd number of them.
    const std::size_t steps = keyframes.size() - 1;
    if (steps % 2 == 1 && std::llround(length * scale.ticks) == static_cast<long long>(steps))
        *peak /= hannAt(static_cast<double>(steps / 2) / static_cast<double>(steps));
    const bool alone = frequency * length < 2.5; // periods
    const double sharpness =
        alone ? std::log(frequency / 100.0) / std::log(2.8) : std::log(frequency / 150.0) / std::log(2500.0 / 150.0);
    return Transient{(position + keyframes.front().position) / scale.ticks,
                     std::min(*peak * scale.level, limits::amplitude), std::clamp(sharpness, 0.0, 1.0)};
}

void appendHjifWave(Band& lane, const HjifEffect& effect, double position, const HjifBand& band, const HjifScale& scale,
                    ImportReport& report, const std::string& where)
{
    const auto fundamental = fundamentalOf(effect.baseSignal);
    if (effect.baseSignal != "Sine")
        report.warn(where, fmt::format("the base signal '{}' becomes a sine", shownText(effect.baseSignal)));
    const double level = scale.level * fundamental.value_or(1.0);
    const bool isFirst = lane.amplitude.empty() && lane.pitch.empty();
    Curve amplitude;
    bool inverted = false, clamped = false;
    for (const HjifKeyframe& keyframe : effect.keyframes)
    {
        const double time = (position + keyframe.position) / scale.ticks;
        if (keyframe.amplitude)
        {
            amplitude.push_back({time, std::min(std::abs(*keyframe.amplitude) * level, limits::amplitude)});
            inverted = inverted || *keyframe.amplitude < 0.0;
        }
        if (keyframe.frequency)
        {
            const double f = std::clamp(*keyframe.frequency, std::max(band.low, 1.0), std::max(band.high, 1.0));
            clamped = clamped || f != *keyframe.frequency;
            lane.pitch.push_back({time, f});
        }
    }
    if (inverted)
        report.warn(where, "negative amplitudes are read without sign");
    if (clamped)
        report.warn(where, "frequencies outside of the band are moved to its limits");
    if (amplitude.empty())
        return;
    const double start = position / scale.ticks;
    const double end = (position + effect.keyframes.back().position) / scale.ticks;
    if (start < amplitude.front().time)
        amplitude.insert(amplitude.begin(), {start, amplitude.front().value});
    if (end > amplitude.back().time)
        amplitude.push_back({end, amplitude.back().value});
    if (isFirst && effect.phase)
        lane.phase = phaseAtStart(*effect.phase, start, lane.pitch);
    append(lane.amplitude, amplitude);
}

void appendHjifCurve(Band& lane, const HjifEffect& effect, double position, const HjifScale& scale)
{
    std::vector<Breakpoint> extrema;
    for (const HjifKeyframe& keyframe : effect.keyframes)
    {
        const Breakpoint point{(position + keyframe.position) / scale.ticks,
                               keyframe.amplitude.value_or(0.0) * scale.level};
        const std::size_t n = extrema.size();
        if (n > 0 && (extrema[n - 1].value == point.value || extrema[n - 1].time == point.time))
            continue;
        if (n > 1 && (extrema[n - 1].value - extrema[n - 2].value) * (point.value - extrema[n - 1].value) > 0.0)
            extrema.pop_back(); // the curve goes on in its direction
        extrema.push_back(point);
    }
    Curve amplitude;
    for (std::size_t i = 1; i < extrema.size(); ++i)
    {
        const double middle = 0.5 * (extrema[i - 1].time + extrema[i].time);
        const double half = extrema[i].time - extrema[i - 1].time;
        const double height = 0.5 * std::abs(extrema[i].value - extrema[i - 1].value);
        amplitude.push_back({middle, std::min(height, limits::amplitude)});
        lane.pitch.push_back({middle, std::clamp(0.5 / half, 1.0, limits::frequency)});
    }
    append(lane.amplitude, amplitude);
}

void setHjifFrequencies(Band& lane, const HjifBand& band)
{
    lane.lowFrequency = band.low;
    lane.highFrequency = band.high;
    for (const Breakpoint& point : lane.pitch)
    {
        lane.lowFrequency = std::min(lane.lowFrequency, point.value);
        lane.highFrequency = std::max(lane.highFrequency, point.value);
    }
    double centre = std::sqrt(std::max(band.low, 1.0) * band.high);
    if (!lane.pitch.empty())
    {
        double octaves = 0.0;
        for (const Breakpoint& point : lane.pitch)
            octaves += std::log2(point.value) / static_cast<double>(lane.pitch.size());
        centre = std::exp2(octaves);
        const bool stands =
            std::all_of(lane.pitch.begin(), lane.pitch.end(),
                        [&](const Breakpoint& point) { return std::abs(point.value - centre) < 1e-6 * centre; });
        if (stands)
        {
            centre = lane.pitch.front().value;
            lane.pitch.clear();
        }
    }
    lane.centreFrequency = std::clamp(centre, lane.lowFrequency, lane.highFrequency);
}

} // namespace pacini
