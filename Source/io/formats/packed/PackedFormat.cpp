#include "io/formats/packed/PackedFormat.h"

#include <pacini/clip/PackedClip.h>

#include <span>
#include <utility>

namespace pacini
{

bool isPackedClip(std::string_view bytes)
{
    return bytes.starts_with("PACB");
}

Result<ImportedClip> readPackedClip(std::string_view bytes)
{
    auto clip = unpackClip(std::as_bytes(std::span<const char>(bytes)));
    if (!clip)
        return clip.error();
    return ImportedClip{std::move(clip).value(), {}};
}

void streamPackedClip(Clip clip, const ClipFormat::PieceSink& sink)
{
    const PackParams params = packParamsFor(clip);
    const auto packed = packClip(std::move(clip), params);
    sink({reinterpret_cast<const char*>(packed.data()), packed.size()});
}

} // namespace pacini
