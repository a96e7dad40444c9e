#pragma once

// Tone for sound above the range of touch, added to the bands of a clip.

#include <pacini/analysis/BandAnalysis.h>
#include <pacini/analysis/HeardLevel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace pacini
{

/// Puts a tone into the frames of bands. A frame of the bands is a Hann window of eight values of the envelope.
class HeardTone
{
public:
    /// Values of the envelope for each frame of the bands.
    static constexpr std::size_t ratio =
        static_cast<std::size_t>(BandAnalysisResult::bandStep / BandAnalysisResult::envelopeStep + 0.5);

    explicit HeardTone(std::span<const BandEdges> edges)
        : fades(edges, BandAnalysisParams{}.overlap), bands(edges.begin(), edges.end())
    {
    }

    /// The tone in one frame.
    struct Frame
    {
        double power = 0.0;      ///< mean square of the level
        double brightness = 0.0; ///< 0 to 1, see HeardFrame::bright
        bool audible = false;    ///< something is heard above the range of touch
    };

    /// The tone in frame `j` of the bands, from its level at each value of the envelope; `heard` may have more.
    [[nodiscard]] Frame at(std::size_t j, std::span<const HeardFrame> heard, std::span<const double> levels) const
    {
        double weights = 0.0;
        double high = 0.0;
        double bright = 0.0;
        Frame frame;
        for (std::size_t i = first(j); i < end(j, levels.size()); ++i)
        {
            const double w = weight(i, j);
            weights += w;
            high += w * static_cast<double>(heard[i].high);
            bright += w * static_cast<double>(heard[i].bright);
            frame.power += w * (levels[i] * levels[i]);
        }
        frame.power = weights > 0.0 ? frame.power / weights : 0.0;
        frame.audible = high > 0.0;
        frame.brightness = frame.audible ? bright / high : 0.0;
        return frame;
    }

    /// Returns the mean in frame `j` of `values`, one for each value of the envelope; 0 if there are none.
    [[nodiscard]] double mean(std::size_t j, std::span<const float> values) const
    {
        double weights = 0.0;
        double sum = 0.0;
        for (std::size_t i = first(j); i < end(j, values.size()); ++i)
        {
            const double w = weight(i, j);
            weights += w;
            sum += w * static_cast<double>(values[i]);
        }
        return weights > 0.0 ? sum / weights : 0.0;
    }

    /// Scales the bands in frame `j` by `kept` and adds a tone of `power` (amplitude squared) at `frequency` (Hz, moved
    /// into the range of the bands).
    void add(BandAnalysisResult& found, std::size_t j, double kept, double power, double frequency) const
    {
        const double placed = std::clamp(frequency, bands.front().low, bands.back().high);
        for (std::size_t k = 0; k < found.tracks.size(); ++k)
        {
            auto& track = found.tracks[k];
            const double old = kept * static_cast<double>(track.amplitude[j]);
            const double part = fades.weight(k, k, placed);
            const double added = part * part * std::max(0.0, power);
            const double sum = old * old + added;
            if (sum > 0.0)
                track.frequency[j] =
                    static_cast<float>((old * old * static_cast<double>(track.frequency[j]) + added * placed) / sum);
            track.amplitude[j] = static_cast<float>(std::sqrt(sum));
        }
    }

private:
    /// The values of the envelope that frame `j` sees, of `count`.
    [[nodiscard]] static std::size_t first(std::size_t j) noexcept { return j > 0 ? (j - 1) * ratio + 1 : 0; }
    [[nodiscard]] static std::size_t end(std::size_t j, std::size_t count) noexcept
    {
        return std::min(count, (j + 1) * ratio);
    }

    [[nodiscard]] double weight(std::size_t i, std::size_t j) const noexcept
    {
        return window[i + ratio - 1 - j * ratio];
    }

    [[nodiscard]] static std::array<double, 2 * ratio - 1> hann()
    {
        std::array<double, 2 * ratio - 1> weights;
        for (std::size_t i = 0; i < weights.size(); ++i)
            weights[i] = 0.5 + 0.5 * std::cos(std::numbers::pi * (static_cast<double>(i + 1) - ratio) / ratio);
        return weights;
    }

    std::array<double, 2 * ratio - 1> window = hann();
    BandFades fades;
    std::vector<BandEdges> bands;
};

} // namespace pacini
