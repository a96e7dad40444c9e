#pragma once

// Short-time power spectra of overlapping frames, for everything that is measured block by block.

#include <pacini/analysis/DecayTime.h>
#include <pacini/foundation/Clamp.h>
#include <pacini/foundation/DspBlock.h>
#include <pacini/foundation/Fft.h>
#include <pacini/foundation/Units.h>
#include <pacini/foundation/Windows.h>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Length and distance of the frames. 46 ms is the shortest window with which a centroid between 30 and 1000 Hz is not
/// mostly noise. Clamped to 0-10 s, then to at least 2 frames and 1 frame.
struct FrameParams
{
    Seconds window{0.0464};
    Seconds hop{0.0116};
    bool operator==(const FrameParams&) const = default;
};

/// The same in frames at one sample rate. The window is rounded up to a size that transforms fast (factors 2, 3 and 5).
struct FrameGrid
{
    std::size_t window;
    std::size_t hop;
    double fs;

    FrameGrid(const FrameParams& params, double sampleRate)
        : window(nextFastFftSize(frames(params.window, sampleRate))),
          hop(std::max<std::size_t>(1, frames(params.hop, sampleRate))),
          fs(sampleRate)
    {
    }

    /// Frames until the signal is covered: the last one is filled up with zeros. None for an empty signal.
    [[nodiscard]] std::size_t count(std::size_t signalFrames) const noexcept
    {
        if (signalFrames == 0)
            return 0;
        return signalFrames <= window ? 1 : (signalFrames - window + hop - 1) / hop + 1;
    }

    /// The time of the middle of frame m in seconds.
    [[nodiscard]] double time(std::size_t m) const noexcept
    {
        return (static_cast<double>(m * hop) + static_cast<double>(window) / 2.0) / fs;
    }

    /// The frequency of bin k in Hz, also between bins.
    [[nodiscard]] double frequency(double k) const noexcept { return k * fs / static_cast<double>(window); }

private:
    static std::size_t frames(Seconds time, double fs)
    {
        return roundedFrames(Seconds(clampTo(time.value, 0.0, 10.0)), fs);
    }
};

/// The signal between half a window of zeros on either side: frame m of it has its middle at sample m hop of the
/// signal.
[[nodiscard]] inline std::vector<float> withCentredFrames(std::span<const float> signal, const FrameGrid& grid)
{
    const auto half = static_cast<std::ptrdiff_t>(grid.window / 2);
    std::vector<float> padded(signal.size() + 2 * (grid.window / 2), 0.0f);
    std::copy(signal.begin(), signal.end(), padded.begin() + half);
    return padded;
}

/// Calls visit(m, power) for every frame m of the signal, power[k] = |X_m(k)|^2, k = 0..window/2, of the periodic
/// Hann-windowed frame that starts at sample m hop (Weber 2020, Eq. 4.1).
template <typename Visit>
void forEachPowerSpectrum(std::span<const float> signal, const FrameGrid& grid, Visit&& visit)
{
    const std::vector<double> window = hannPeriodic(grid.window);
    RealFft<double> fft(grid.window);
    std::vector<double> frame(grid.window);
    std::vector<std::complex<double>> spectrum(fft.bins());
    std::vector<double> power(fft.bins());
    const std::size_t count = grid.count(signal.size());
    for (std::size_t m = 0; m < count; ++m)
    {
        const std::size_t start = std::min(m * grid.hop, signal.size()); // a hop beyond the window may pass the end
        const auto part = signal.subspan(start, std::min(grid.window, signal.size() - start));
        std::fill(frame.begin(), frame.end(), 0.0);
        for (std::size_t i = 0; i < part.size(); ++i)
            frame[i] = finiteOrZero(part[i]) * window[i];
        fft.forward(frame, spectrum);
        std::transform(spectrum.begin(), spectrum.end(), power.begin(),
                       [](std::complex<double> v) { return std::norm(v); });
        visit(m, std::span<const double>(power));
    }
}

} // namespace pacini
