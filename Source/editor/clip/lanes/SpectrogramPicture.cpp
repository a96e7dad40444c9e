// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/lanes/SpectrogramPicture.h"

#include "document/view/ColourMap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pacini::editor
{

namespace
{
const std::array<juce::PixelRGB, 256>& coloursFor(bool dark)
{
    const auto make = [](bool onDark)
    {
        std::array<juce::PixelRGB, 256> result;
        const auto colours = levelColours(onDark);
        for (std::size_t i = 0; i < result.size(); ++i)
            result[i].setARGB(255, static_cast<juce::uint8>(colours[i] >> 16),
                              static_cast<juce::uint8>(colours[i] >> 8), static_cast<juce::uint8>(colours[i]));
        return result;
    };
    static const auto night = make(true), paper = make(false);
    return dark ? night : paper;
}
} // namespace

void SpectrogramPicture::show(std::shared_ptr<const Sound> wanted, bool wholeSpectrum)
{
    if (wanted == sound && wholeSpectrum == whole)
        return;
    sound = std::move(wanted);
    whole = wholeSpectrum;
    source.reset();
    spectrogram.reset();
    stale = true;
    scale = SpectrumRows{};
    if (!sound || sound->mono.frames() == 0)
        return;
    const auto fs = static_cast<double>(sound->audio.rate());
    scale.high = whole ? std::max(100.0, 0.5 * fs) : feltHigh;
    spectrogram.emplace(sound->audio.duration(), scale);
    column.resize(scale.count);
}

const juce::Image& SpectrogramPicture::picture(const TimeAxis& axis, int width, int height, bool dark)
{
    const bool same = image.isValid() && image.getWidth() == width && image.getHeight() == height;
    if (same && !stale && axis == axisNow && dark == darkNow)
        return image;
    if (!same)
        image =
            juce::Image(juce::Image::RGB, std::max(1, width), std::max(1, height), false, juce::SoftwareImageType());
    axisNow = axis;
    widthNow = width;
    darkNow = dark;
    stale = false;
    const auto& colours = coloursFor(dark);
    std::vector<std::size_t> rowOf(static_cast<std::size_t>(image.getHeight()));
    for (std::size_t y = 0; y < rowOf.size(); ++y)
        rowOf[y] = (rowOf.size() - 1 - y) * scale.count / rowOf.size();
    juce::Image::BitmapData pixels(image, juce::Image::BitmapData::writeOnly);
    for (int x = 0; x < image.getWidth(); ++x)
    {
        if (spectrogram)
            spectrogram->column(axis.timeAt(x), axis.timeAt(x + 1.0), column);
        else
            std::fill(column.begin(), column.end(), std::uint8_t(0));
        juce::uint8* to = pixels.getPixelPointer(x, 0);
        for (const std::size_t row : rowOf)
        {
            *reinterpret_cast<juce::PixelRGB*>(to) = colours[column.empty() ? 0 : column[row]];
            to += pixels.lineStride;
        }
    }
    next();
    return image;
}

double SpectrogramPicture::levelAt(double time, double frequency) const
{
    if (!spectrogram)
        return SpectrumLevel::floor;
    std::vector<std::uint8_t> levels(scale.count);
    spectrogram->column(time - 0.5 * axisNow.secondsPerPixel, time + 0.5 * axisNow.secondsPerPixel, levels);
    const double place = std::clamp(scale.placeOf(frequency), 0.0, static_cast<double>(scale.count - 1));
    return SpectrumLevel::decibels(levels[static_cast<std::size_t>(place)]);
}

bool SpectrogramPicture::isComplete() const
{
    return !spectrogram || !spectrogram->nextMissing(axisNow, widthNow);
}

void SpectrogramPicture::next()
{
    if (working || !spectrogram)
        return;
    const auto tile = spectrogram->nextMissing(axisNow, widthNow);
    if (!tile)
        return;
    if (!source)
        source = std::make_shared<Source>(sound, scale);
    working = true;
    jobs.run([from = source, wanted = *tile, rows = scale.count]
             { return Spectrogram::compute(from->analyser, wanted, rows); },
             [this, from = source, wanted = *tile](std::vector<std::uint8_t> columns)
             {
                 working = false;
                 if (from == source)
                 {
                     spectrogram->put(wanted, std::move(columns));
                     const TimeRange range = wanted.range(), shown = axisNow.visible(widthNow);
                     if (range.from < shown.to && range.to > shown.from)
                     {
                         stale = true;
                         if (onChanged)
                             onChanged();
                     }
                 }
                 next();
             });
}

} // namespace pacini::editor
