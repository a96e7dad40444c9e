#pragma once

// Spectrum of a sound at one time, on a logarithmic frequency axis.

#include "document/view/MonoSource.h"

#include <pacini/foundation/Fft.h>
#include <pacini/foundation/Units.h>
#include <pacini/foundation/Windows.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace pacini
{

/// Rows from `low` to `high` Hz in equal ratios, row 0 at the foot.
struct SpectrumRows
{
    double low = 20.0;
    double high = 2000.0;
    std::size_t count = 128;
    bool operator==(const SpectrumRows&) const = default;

    /// Where a frequency lies: row k reaches from k to k + 1.
    [[nodiscard]] double placeOf(double frequency) const noexcept
    {
        return static_cast<double>(count) * std::log(std::max(frequency, 1e-3) / low) / std::log(high / low);
    }
    [[nodiscard]] double frequencyAt(double place) const noexcept
    {
        return low * std::pow(high / low, place / static_cast<double>(count));
    }
};

/// Levels as bytes: 0 is silence and all below -96 dB, 255 is 0 dB, the level of a sinusoid of amplitude 1.
struct SpectrumLevel
{
    static constexpr double floor = -96.0; ///< dB

    [[nodiscard]] static double decibelsOf(double power) noexcept
    {
        return power > 0.0 ? std::max(floor, Decibels::fromPower(power).value) : floor;
    }
    [[nodiscard]] static std::uint8_t byteOf(double level) noexcept
    {
        return static_cast<std::uint8_t>(std::clamp(std::lround(255.0 * (1.0 - level / floor)), 0L, 255L));
    }
    [[nodiscard]] static double decibels(std::uint8_t level) noexcept { return floor * (1.0 - level / 255.0); }
};

/// Hann windows of 0.2 s for low rows, 60 ms and 20 ms for higher ones: frequency resolution where pitch is felt, time
/// resolution where timing is felt. A row shows the strongest bin within it, so that a tone has the level of its
/// amplitude whatever the row's width. Not for two threads at once.
class SpectrumAnalyzer
{
public:
    /// Of one channel, which must outlive this, at `sampleRate` Hz.
    SpectrumAnalyzer(MonoSource channel, double sampleRate, const SpectrumRows& wanted)
        : sound(std::move(channel)), fs(sampleRate)
    {
        for (const double seconds : windows)
        {
            const std::size_t size = nextFastFftSize(std::max<std::size_t>(64, static_cast<std::size_t>(seconds * fs)));
            Part part(size);
            const double bins = static_cast<double>(size) / fs;
            for (std::size_t k = 0; k < wanted.count; ++k)
                if (const double share = shareOf(parts.size(), wanted.frequencyAt(static_cast<double>(k) + 0.5));
                    share > 0.0)
                    part.rows.push_back({k, bins * wanted.frequencyAt(static_cast<double>(k)),
                                         bins * wanted.frequencyAt(static_cast<double>(k) + 1.0), share});
            parts.push_back(std::move(part));
        }
        sums.resize(wanted.count);
    }

    /// The levels of all rows about `time` s; see SpectrumLevel. 0 outside the sound and above half the sample rate.
    void column(double time, std::span<std::uint8_t> levels)
    {
        std::fill(sums.begin(), sums.end(), 0.0);
        for (Part& part : parts)
        {
            if (part.rows.empty())
                continue;
            part.transform(sound, std::llround(time * fs));
            for (const Row& row : part.rows)
                sums[row.index] += row.share * SpectrumLevel::decibelsOf(part.strongest(row));
        }
        std::transform(sums.begin(), sums.begin() + static_cast<std::ptrdiff_t>(levels.size()), levels.begin(),
                       SpectrumLevel::byteOf);
    }

private:
    static constexpr std::array<double, 3> windows{0.2, 0.06, 0.02}; // s
    static constexpr std::array<double, 2> crossings{160.0, 1000.0}; // Hz

    /// How much a window counts at a frequency: from half an octave below a crossing to half an octave above it one
    /// gives way to the next, else noise, whose level depends on the window, would show a step.
    [[nodiscard]] static double shareOf(std::size_t window, double frequency) noexcept
    {
        const auto above = [frequency](double crossing)
        {
            return std::clamp(std::log2(frequency / crossing) + 0.5, 0.0, 1.0);
        };
        const double from = window == 0 ? 1.0 : above(crossings[window - 1]);
        const double to = window == crossings.size() ? 0.0 : above(crossings[window]);
        return from - to;
    }

    /// A row as a window sees it.
    struct Row
    {
        std::size_t index;
        double from, to; // bins
        double share;
    };

    /// The rows that share a window.
    struct Part
    {
        explicit Part(std::size_t size) : fft(size), frame(size), spectrum(fft.bins()), powers(fft.bins())
        {
            double sum = 0.0;
            for (const double w : hannPeriodic(size))
            {
                window.push_back(static_cast<float>(w));
                sum += w;
            }
            scale = 4.0 / (sum * sum); // a sinusoid of amplitude 1 has power 1
        }

        void transform(const MonoSource& from, std::int64_t centre)
        {
            from.read(centre - static_cast<std::int64_t>(frame.size() / 2), frame);
            for (std::size_t i = 0; i < frame.size(); ++i)
                frame[i] *= window[i];
            fft.forward(frame, spectrum);
            for (std::size_t k = 0; k < powers.size(); ++k)
                powers[k] = scale * static_cast<double>(std::norm(spectrum[k]));
        }

        [[nodiscard]] double at(double bin) const
        {
            const auto below = static_cast<std::size_t>(bin);
            if (below + 1 >= powers.size())
                return 0.0;
            const double part = bin - static_cast<double>(below);
            return powers[below] + part * (powers[below + 1] - powers[below]);
        }

        [[nodiscard]] double strongest(const Row& row) const
        {
            double best = at(0.5 * (row.from + row.to));
            for (auto k = static_cast<std::size_t>(std::ceil(row.from)); static_cast<double>(k) <= row.to; ++k)
                if (k < powers.size())
                    best = std::max(best, powers[k]);
                else
                    break;
            return best;
        }

        RealFft<float> fft;
        std::vector<float> window, frame;
        std::vector<std::complex<float>> spectrum;
        std::vector<double> powers;
        std::vector<Row> rows;
        double scale = 1.0;
    };

    MonoSource sound;
    double fs;
    std::vector<Part> parts;
    std::vector<double> sums; ///< dB
};

} // namespace pacini
