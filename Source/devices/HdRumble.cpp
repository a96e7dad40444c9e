#include "devices/HdRumble.h"

#include <algorithm>
#include <cmath>

namespace pacini::devices
{

namespace
{
constexpr double smallest = 0.007843; // the amplitude of code 1, which stands outside the rows

// a = 2^(code / codesPerDoubling) / divisor, from code `first` on.
struct Row
{
    int first;
    double codesPerDoubling;
    double divisor;
};
constexpr std::array<Row, 3> rows{{{2, 4.0, 119.6}, {16, 16.0, 17.0255}, {32, 32.0, 8.6991}}};

double amplitudeIn(const Row& row, int code) noexcept
{
    return std::exp2(code / row.codesPerDoubling) / row.divisor;
}

struct Amplitudes
{
    double high;
    double low;
};

Amplitudes limited(double high, double low) noexcept
{
    // A NaN becomes 0 here, an infinity 1.
    high = high > 0.0 ? std::min(high, 1.0) : 0.0;
    low = low > 0.0 ? std::min(low, 1.0) : 0.0;
    const double scale = 1.0 / std::max(high + low, 1.0);
    return {high * scale, low * scale};
}
} // namespace

Hertz rumbleFrequency(int step) noexcept
{
    return Hertz(10.0 * std::exp2(step / 32.0));
}

int rumbleStep(Hertz frequency, int lowest, int highest) noexcept
{
    if (!(frequency > rumbleFrequency(lowest)))
        return lowest;
    if (frequency > rumbleFrequency(highest))
        return highest;
    return static_cast<int>(std::lround(32.0 * std::log2(frequency.value / 10.0)));
}

double rumbleAmplitude(int code) noexcept
{
    if (code <= 0)
        return 0.0;
    if (code < rows.front().first)
        return smallest;
    code = std::min(code, highestAmplitudeCode);
    const auto row = std::find_if(rows.rbegin(), rows.rend(), [=](const Row& r) { return code >= r.first; });
    return amplitudeIn(*row, code);
}

int rumbleAmplitudeCode(double amplitude) noexcept
{
    if (!(amplitude >= 0.5 * smallest))
        return 0;
    if (amplitude >= rumbleAmplitude(safeAmplitudeCode))
        return safeAmplitudeCode;
    int above = 1;
    while (rumbleAmplitude(above) < amplitude)
        ++above;
    if (above == 1)
        return 1;
    const double ratioBelow = amplitude / rumbleAmplitude(above - 1);
    const double ratioAbove = rumbleAmplitude(above) / amplitude;
    return ratioBelow < ratioAbove ? above - 1 : above;
}

RumbleBytes encodeRumble(const RumbleTones& tones) noexcept
{
    const Amplitudes amplitudes = limited(tones.high.amplitude, tones.low.amplitude);
    int high = rumbleAmplitudeCode(amplitudes.high);
    int low = rumbleAmplitudeCode(amplitudes.low);
    if (high == 0 && low == 0)
        return neutralRumble;
    while (rumbleAmplitude(high) + rumbleAmplitude(low) > rumbleAmplitude(safeAmplitudeCode))
        --(high > low ? high : low);

    const int highFrequency = 4 * (rumbleStep(tones.high.frequency, lowestHighStep, highestHighStep) - 0x60);
    const int lowFrequency = rumbleStep(tones.low.frequency, lowestLowStep, highestLowStep) - 0x40;
    return {static_cast<std::byte>(highFrequency & 0xFF), static_cast<std::byte>(high << 1 | highFrequency >> 8),
            static_cast<std::byte>((low & 1) << 7 | lowFrequency), static_cast<std::byte>(0x40 + (low >> 1))};
}

} // namespace pacini::devices
