#include "io/FinishedClip.h"

#include "io/ClipSeal.h"
#include "io/Utf8.h"

#include <utility>

namespace pacini
{

std::string sourceNameOf(const std::filesystem::path& input)
{
    return input == "-" ? std::string() : wellFormedUtf8(input.filename().string());
}

ClipNames clipNamesOf(const std::filesystem::path& input)
{
    return input == "-" ? ClipNames{"stdin", ""} : ClipNames{input.stem().string(), input.filename().string()};
}

Clip finishClip(Clip clip, ClipNames names)
{
    clip.name = wellFormedUtf8(std::move(names.clip));
    clip.source.file = wellFormedUtf8(std::move(names.sound));
    sealClip(clip);
    return clip;
}

} // namespace pacini
