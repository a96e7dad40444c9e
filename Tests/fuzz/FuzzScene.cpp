// Any text is either refused with a proper error or is a scene that survives being written and read again.

#include "FuzzKeys.h"
#include "FuzzText.h"
#include "io/SceneJson.h"

#include <string>
#include <string_view>

using namespace pacini;

namespace
{
/// One small clip is there, whatever it is called; names that start with "no" are missing.
Result<Clip> anyClip(const std::string& file)
{
    if (file.starts_with("no"))
        return Error{ErrorCode::io, "", "does not exist"};
    Clip clip;
    clip.name = "fuzz";
    clip.duration = 1.0;
    return clip;
}
} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = fuzzedText(data, size);
    ReadWarnings warnings, strict(true);
    const auto scene = readSceneJson(text, anyClip, &warnings);
    checkWarnings(warnings, scene.ok(), readSceneJson(text, anyClip, &strict).ok());
    if (!scene)
        return refused(scene.error());
    FUZZ_CHECK(validate(*scene).ok());
    const auto written = writeSceneJson(*scene);
    const auto again = readSceneJson(written, anyClip);
    FUZZ_CHECK(again.ok());
    FUZZ_CHECK(*again == *scene);
    FUZZ_CHECK(writeSceneJson(*again) == written);
    return 0;
}
