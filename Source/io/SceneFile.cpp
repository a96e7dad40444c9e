#include "io/SceneFile.h"

#include "io/AtomicFile.h"
#include "io/ClipFile.h"
#include "io/ClipJson.h"
#include "io/InputFile.h"
#include "io/JsonText.h"
#include "io/SceneJson.h"

#include <algorithm>
#include <system_error>

namespace pacini
{

namespace fs = std::filesystem;

namespace
{
/// Looks for the "format" of a document and stops there.
class FormatHandler final : public JsonHandler
{
public:
    std::string format;

    bool openObject() override { return open(); }
    bool openList() override { return open(); }
    bool close() override
    {
        --depth;
        return true;
    }
    bool key(std::string_view name) override
    {
        isFormat = depth == 1 && name == "format";
        return true;
    }
    bool number(double) override { return goOn(); }
    bool text(std::string& value) override
    {
        if (isFormat)
            format = value;
        return goOn();
    }
    bool truth(bool) override { return goOn(); }
    bool null() override { return goOn(); }

private:
    bool goOn() { return !isFormat || stop(ErrorCode::invalidData, "found"); }
    bool open()
    {
        ++depth;
        return goOn();
    }

    int depth = 0;
    bool isFormat = false;
};

Result<Scene> sceneOf(std::string_view text, const fs::path& path, const fs::path& clipFolder)
{
    const fs::path folder = clipFolder.empty() ? path.parent_path() : clipFolder;
    return readSceneJson(text,
                         [&folder](const std::string& file) -> Result<Clip>
                         {
                             const fs::path clip = folder / file;
                             std::error_code ignored;
                             if (fs::exists(clip, ignored) && fs::is_other(clip, ignored))
                                 return Error{ErrorCode::io, "", "is a pipe or a device; name a clip file"};
                             return readClip(clip);
                         });
}
} // namespace

Result<Scene> readScene(const fs::path& path, const fs::path& clipFolder)
{
    const auto text = readWholeFile(path, largestSceneText);
    if (!text)
        return text.error();
    return sceneOf(*text, path, clipFolder);
}

Result<std::variant<Clip, Scene>> readClipOrScene(const fs::path& path, const fs::path& clipFolder)
{
    const auto bytes = readClipBytes(path);
    if (!bytes)
        return bytes.error();
    if (isSceneText(*bytes))
    {
        auto scene = sceneOf(*bytes, path, clipFolder);
        if (!scene)
            return scene.error();
        return std::variant<Clip, Scene>(std::move(*scene));
    }
    auto clip = clipOf(*bytes);
    if (!clip)
        return clip.error();
    return std::variant<Clip, Scene>(std::move(*clip));
}

bool isSceneText(std::string_view text)
{
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || text[first] != '{')
        return false;
    FormatHandler handler;
    (void)parseJson(text, handler, largestClipText);
    return handler.format == sceneFormatName;
}

Result<std::size_t> writeScene(const fs::path& path, const Scene& scene)
{
    if (auto valid = validate(scene); !valid)
        return valid.error();
    return writeFileAtomically(path, writeSceneJson(scene));
}

} // namespace pacini
