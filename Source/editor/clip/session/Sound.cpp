// SPDX-License-Identifier: GPL-3.0-or-later
#include "editor/clip/session/Sound.h"

#include "io/ClipFile.h"
#include "io/FileExtension.h"

#include <algorithm>
#include <string>

namespace pacini::editor
{

namespace
{
bool mayBeClip(const std::filesystem::path& path)
{
    const auto known = clipFileExtensions();
    return std::find(known.begin(), known.end(), lowerExtension(path)) != known.end();
}
} // namespace

Result<Imported> readFile(const std::filesystem::path& path)
{
    Imported result;
    // The extensions of clips and sounds overlap nowhere but in .wav.
    auto described = describeAudio(path);
    if (!described && mayBeClip(path))
    {
        auto read = readClipOrScene(path);
        if (!read)
            return read.error();
        result.warnings = std::move(read->warnings);
        if (auto* scene = std::get_if<Scene>(&read->content))
        {
            result.scene = std::move(*scene);
            return result;
        }
        result.clip = std::get<Clip>(std::move(read->content));
        if (result.clip.name.empty())
            result.clip.name = path.stem().string();
        return result;
    }
    if (!described)
        return described.error();
    result.warnings = described->audio.warnings();
    result.reference = std::move(described->reference);
    result.sound = std::make_shared<const Sound>(std::move(described->audio));
    return result;
}

Result<Imported> importFile(const std::filesystem::path& path, const EncoderParams& encoder)
{
    auto read = readFile(path);
    if (!read || !read->sound)
        return read;
    auto clip = analyse(read->sound->audio, encoder, read->reference);
    if (!clip)
        return clip.error();
    read->encoder = encoder;
    read->clip = std::move(clip).value();
    return read;
}

} // namespace pacini::editor
