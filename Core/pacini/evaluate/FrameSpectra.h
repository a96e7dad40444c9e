#pragma once

// Power spectra of windowed frames.

#include <pacini/foundation/SplitFft.h>
#include <pacini/foundation/SplitRealFft.h>

#include <cstddef>
#include <span>
#include <vector>

namespace pacini
{

/// Power spectra |X[k]|^2 of real frames, two by one complex transform: the frames are its real and imaginary part, and
/// the symmetry of real signals' spectra takes them apart again. In single precision: for measures of thousands of
/// frames per second of run time. The analysis has forEachPowerSpectrum(), in double precision and on its own grid.
class FrameSpectra
{
public:
    /// Frames of frameWindow.size() samples, weighted by it and zero-padded to `transformSize` (no prime factor above
    /// 5).
    FrameSpectra(const std::vector<double>& frameWindow, std::size_t transformSize)
        : window(frameWindow.begin(), frameWindow.end()),
          fft(transformSize),
          frames(transformSize),
          spectrum(transformSize)
    {
    }

    /// Writes the bins firstBin .. firstBin + powerA.size() - 1 (from 1 to at most transformSize / 2) of both frames.
    /// The frames hold as many samples as the window, the outputs have equal size.
    void power(std::span<const float> a, std::span<const float> b, std::size_t firstBin, std::span<float> powerA,
               std::span<float> powerB) noexcept
    {
        for (std::size_t i = 0; i < window.size(); ++i)
        {
            frames.re[i] = a[i] * window[i];
            frames.im[i] = b[i] * window[i];
        }
        fft.forward(frames.re.data(), frames.im.data(), spectrum.re.data(), spectrum.im.data());
        const float* re = spectrum.re.data() + firstBin;
        const float* im = spectrum.im.data() + firstBin;
        const float* mirroredRe = spectrum.re.data() + (fft.size() - firstBin);
        const float* mirroredIm = spectrum.im.data() + (fft.size() - firstBin);
        for (std::size_t i = 0; i < powerA.size(); ++i)
        {
            const float sumRe = re[i] + *(mirroredRe - i);
            const float sumIm = im[i] - *(mirroredIm - i);
            const float differenceRe = re[i] - *(mirroredRe - i);
            const float differenceIm = im[i] + *(mirroredIm - i);
            powerA[i] = 0.25f * (sumRe * sumRe + sumIm * sumIm);
            powerB[i] = 0.25f * (differenceRe * differenceRe + differenceIm * differenceIm);
        }
    }

private:
    std::vector<float> window;
    SplitFft<float> fft;
    SplitArray<float> frames;
    SplitArray<float> spectrum;
};

} // namespace pacini
