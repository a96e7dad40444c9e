// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Image of the visible part of a sound's spectrogram, computed in the background.

#include "document/view/Spectrogram.h"
#include "editor/clip/session/Jobs.h"
#include "editor/clip/session/Sound.h"

#include <juce_gui_basics/juce_gui_basics.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pacini::editor
{

/// Computes in the background, first the part visible last, then the rest. [message]
class SpectrogramPicture
{
public:
    static constexpr double feltHigh = 2000.0; ///< Hz: above that nothing is felt

    std::function<void()> onChanged; ///< there is more to draw

    /// Null: none. `wholeSpectrum`: up to half the sample rate.
    void show(std::shared_ptr<const Sound> wanted, bool wholeSpectrum);

    /// Of a view; begins to compute what is missing. Valid until the next call.
    [[nodiscard]] const juce::Image& picture(const TimeAxis& axis, int width, int height, bool dark);

    [[nodiscard]] const SpectrumRows& rows() const noexcept { return scale; }
    /// dB at a time and a frequency, re a sinusoid of amplitude 1, as far as is known.
    [[nodiscard]] double levelAt(double time, double frequency) const;
    /// Whether everything that the last picture needs is there.
    [[nodiscard]] bool isComplete() const;

private:
    /// What the worker has: one for each sound and scale.
    struct Source
    {
        Source(std::shared_ptr<const Sound> from, const SpectrumRows& wanted)
            : sound(std::move(from)), analyser(sound->mono, static_cast<double>(sound->audio.rate()), wanted)
        {
        }
        std::shared_ptr<const Sound> sound;
        SpectrumAnalyzer analyser;
    };

    void next();

    std::shared_ptr<const Sound> sound;
    bool whole = false;
    SpectrumRows scale;
    std::shared_ptr<Source> source;
    std::optional<Spectrogram> spectrogram;
    TimeAxis axisNow;
    int widthNow = 0;
    bool darkNow = true, working = false;
    bool stale = true; ///< the image
    juce::Image image;
    std::vector<std::uint8_t> column;
    Jobs jobs; ///< ends before the rest
};

} // namespace pacini::editor
