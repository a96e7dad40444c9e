// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sound of the editor: samples in memory with waveform peaks, and the import of files.

#include "document/Analysis.h"
#include "document/AudioReference.h"
#include "document/view/Columns.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace pacini::editor
{

/// A sound in memory with the extremes of its mean over all channels. Immutable.
class Sound
{
public:
    explicit Sound(AudioData data)
        : audio(std::move(data)), mono(meanOf(audio)), peaks(mono, static_cast<double>(audio.sampleRate))
    {
    }
    Sound(const Sound&) = delete;
    Sound& operator=(const Sound&) = delete;

    [[nodiscard]] double duration() const ///< s
    {
        return static_cast<double>(mono.size()) / static_cast<double>(audio.sampleRate);
    }

    const AudioData audio;
    const std::vector<float> mono;
    const WaveformPeaks peaks;

private:
    static std::vector<float> meanOf(const AudioData& data)
    {
        const auto channels = static_cast<std::size_t>(data.channels > 0 ? data.channels : 1);
        std::vector<float> mean(data.samples.size() / channels);
        for (std::size_t i = 0; i < mean.size(); ++i)
        {
            float sum = 0.0f;
            for (std::size_t c = 0; c < channels; ++c)
                sum += data.samples[i * channels + c];
            mean[i] = sum / static_cast<float>(channels);
        }
        return mean;
    }
};

/// The samples of a sound, which they keep alive; null of null.
[[nodiscard]] inline std::shared_ptr<const AudioData> audioOf(const std::shared_ptr<const Sound>& sound)
{
    return sound ? std::shared_ptr<const AudioData>(sound, &sound->audio) : nullptr;
}

/// Content of an imported file: a sound with its analysis, or a clip.
struct Imported
{
    AudioReference reference; ///< of the sound
    std::shared_ptr<const Sound> sound;
    EncoderParams encoder;
    Clip clip;
    std::vector<std::string> warnings; ///< what was let pass in a clip of another format
};

/// Reads a sound, whose clip is still empty, or a clip of any format, which has no sound. Errors: those of
/// describeAudio() and readClip(); for a file that is neither, why it is no sound. [worker]
[[nodiscard]] Result<Imported> readFile(const std::filesystem::path& path);

/// readFile(), and a sound is analysed. Errors: also those of analyse(). [worker]
[[nodiscard]] Result<Imported> importFile(const std::filesystem::path& path, const EncoderParams& encoder);

} // namespace pacini::editor
