// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/LoadedSound.h"

#include "io/AudioReader.h"

#include <pacini/filters/Resampler.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace pacini::app
{

Result<LoadedSound> loadSound(const std::filesystem::path& path, double sampleRate)
{
    auto reader = AudioReader::open(path, {.allowTruncated = true, .allowNan = true});
    if (!reader)
        return reader.error();
    const auto channels = static_cast<std::size_t>(reader->channels());
    const auto most = static_cast<std::size_t>(longestSound * reader->sampleRate());
    LoadedSound sound;
    std::vector<float> piece(channels * 4096);
    while (sound.frames() < most)
    {
        const auto got = reader->read(piece);
        if (!got)
            return got.error();
        if (*got == 0)
            break;
        for (std::size_t i = 0; i < *got; ++i)
        {
            sound.channels[0].push_back(piece[i * channels]);
            sound.channels[1].push_back(piece[i * channels + std::min<std::size_t>(1, channels - 1)]);
        }
    }
    const int rate = static_cast<int>(std::lround(sampleRate));
    for (auto& channel : sound.channels)
    {
        auto converted = resample<float>(std::span<const float>(channel), reader->sampleRate(), rate);
        if (!converted)
            return converted.error();
        channel = std::move(converted).value();
    }
    sound.sampleRate = sampleRate;
    return sound;
}

} // namespace pacini::app
