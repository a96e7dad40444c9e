#pragma once

// Preprocessing of a recording: calibrated, free of its mean, at no higher a rate than is needed.

#include <pacini/filters/RationalDecimator.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Channels of a recording at a reduced rate.
struct RecordedChannels
{
    double rate = 0.0; ///< Hz
    std::vector<std::vector<double>> channels;

    [[nodiscard]] std::size_t frames() const noexcept { return channels.empty() ? 0 : channels.front().size(); }
    [[nodiscard]] double seconds() const noexcept { return static_cast<double>(frames()) / rate; }

    /// `count` frames of channel c from frame `first` on (may be negative); zeros outside of the recording. The mean of
    /// the recording is removed, because an accelerometer shows gravity.
    [[nodiscard]] std::vector<double> part(std::size_t c, std::ptrdiff_t first, std::size_t count) const
    {
        std::vector<double> out(count, 0.0);
        const auto size = static_cast<std::ptrdiff_t>(channels[c].size());
        const std::ptrdiff_t begin = std::clamp<std::ptrdiff_t>(first, 0, size);
        const std::ptrdiff_t end = std::clamp<std::ptrdiff_t>(first + static_cast<std::ptrdiff_t>(count), 0, size);
        double sum = 0.0;
        for (std::ptrdiff_t i = begin; i < end; ++i)
            sum += channels[c][static_cast<std::size_t>(i)];
        const double mean = begin < end ? sum / static_cast<double>(end - begin) : 0.0;
        for (std::ptrdiff_t i = begin; i < end; ++i)
            out[static_cast<std::size_t>(i - first)] = channels[c][static_cast<std::size_t>(i)] - mean;
        return out;
    }
};

/// The lowest rate of at least `margin` (above 2) times `pass` Hz to which `fs` can be divided by a whole number. The
/// nearer to 2 the longer the filter.
[[nodiscard]] inline int reducedRate(int fs, double pass, double margin) noexcept
{
    const int most = std::max(1, static_cast<int>(static_cast<double>(fs) / (margin * pass)));
    for (int divisor = most; divisor > 1; --divisor)
        if (fs % divisor == 0)
            return fs / divisor;
    return fs;
}

/// All channels at reducedRate(fs, pass, margin), each times its factor; below `pass` Hz within 0.001 dB, aliases 90 dB
/// down. scale has one factor per channel. The channels are finite and of equal lengths.
[[nodiscard]] inline RecordedChannels reduceRate(std::span<const std::vector<float>> recording, int fs, double pass,
                                                 double margin, std::span<const double> scale)
{
    const int rate = reducedRate(fs, pass, margin);
    RecordedChannels reduced{static_cast<double>(rate), {}};
    RationalDecimator decimator(fs, rate, {Hertz(pass), Hertz(static_cast<double>(rate) - pass), 90_dB});
    for (std::size_t c = 0; c < recording.size(); ++c)
    {
        double sum = 0.0;
        for (const float v : recording[c])
            sum += static_cast<double>(v);
        const auto mean = static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(1, recording[c].size())));
        std::vector<float> centred(recording[c]);
        for (float& v : centred)
            v -= mean;
        std::vector<float> out;
        decimator.reset();
        decimator.push(centred, out);
        decimator.finish(out);
        std::vector<double> samples(out.size());
        std::transform(out.begin(), out.end(), samples.begin(),
                       [&](float v) { return scale[c] * static_cast<double>(v); });
        reduced.channels.push_back(std::move(samples));
    }
    return reduced;
}

} // namespace pacini
