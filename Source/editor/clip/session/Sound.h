// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Sound of the editor: samples in memory with waveform peaks, and the import of files.

#include "document/Analysis.h"
#include "document/AudioReference.h"
#include "document/view/Columns.h"
#include "document/view/MonoSource.h"
#include "io/StoredAudio.h"

#include <pacini/synthesis/Scene.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace pacini::editor
{

/// A sound in memory with the extremes of its mean over all channels. Immutable.
class Sound
{
public:
    explicit Sound(StoredAudio stored)
        : audio(std::move(stored)), mono(meanOf(audio)), peaks(mono, static_cast<double>(audio.rate()))
    {
    }
    Sound(const Sound&) = delete;
    Sound& operator=(const Sound&) = delete;

    const StoredAudio audio;
    const MonoSource mono; ///< of `audio`
    const WaveformPeaks peaks;

private:
    static MonoSource meanOf(const StoredAudio& audio)
    {
        return {audio.frames(), [&audio](std::int64_t first, std::span<float> out)
                {
                    audio.readMean(first, out);
                }};
    }
};

/// The samples of a sound, which they keep alive; null of null.
[[nodiscard]] inline std::shared_ptr<const StoredAudio> audioOf(const std::shared_ptr<const Sound>& sound)
{
    return sound ? std::shared_ptr<const StoredAudio>(sound, &sound->audio) : nullptr;
}

/// Content of an imported file: a sound with its analysis, a clip, or a scene with its clips.
struct Imported
{
    AudioReference reference; ///< of the sound
    std::shared_ptr<const Sound> sound;
    EncoderParams encoder;
    Clip clip;
    std::optional<Scene> scene = {};
    std::vector<std::string> warnings = {}; ///< what was let pass in a scene, or in a clip of another format
};

/// Reads a sound, whose clip is still empty, a clip of any format, which has no sound, or a scene. Errors: those of
/// describeAudio() and readClipOrScene(); for a file that is neither, why it is no sound. [worker]
[[nodiscard]] Result<Imported> readFile(const std::filesystem::path& path);

/// readFile(), and a sound is analysed. Errors: also those of analyse(). [worker]
[[nodiscard]] Result<Imported> importFile(const std::filesystem::path& path, const EncoderParams& encoder);

} // namespace pacini::editor
