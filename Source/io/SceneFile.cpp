#include "io/SceneFile.h"

#include "io/AtomicFile.h"
#include "io/ClipFile.h"
#include "io/InputFile.h"
#include "io/JsonText.h"
#include "io/SceneJson.h"
#include "io/TextMark.h"
#include "io/TextureFile.h"
#include "io/formats/json/ClipJson.h"

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
} // namespace

Result<Scene> sceneOfText(std::string_view text, const fs::path& clipFolder, ReadWarnings* warnings)
{
    const auto load = [&](const std::string& file) -> Result<Clip>
    {
        const fs::path path = clipFolder / file;
        std::error_code ignored;
        if (fs::exists(path, ignored) && fs::is_other(path, ignored))
            return Error{ErrorCode::io, "", "is a pipe or a device; name a clip file"};
        auto read = readClip(path, warnings != nullptr && warnings->isStrict());
        if (!read)
            return read.error();
        if (warnings != nullptr)
            for (const std::string& warning : read->warnings)
                warnings->add(file, warning);
        return std::move(read->clip);
    };
    const auto loadTexture = [&](const std::string& file) -> Result<Texture>
    {
        const fs::path path = clipFolder / file;
        std::error_code ignored;
        if (fs::exists(path, ignored) && fs::is_other(path, ignored))
            return Error{ErrorCode::io, "", "is a pipe or a device; name a texture file"};
        ReadWarnings passed(warnings != nullptr && warnings->isStrict());
        auto read = readTexture(path, &passed);
        if (read && warnings != nullptr)
            for (const std::string& warning : passed.texts())
                warnings->add(file, warning);
        return read;
    };
    return readSceneJson(text, load, warnings, loadTexture);
}

Result<Scene> readScene(const fs::path& path, const fs::path& clipFolder, ReadWarnings* warnings)
{
    const auto text = readWholeFile(path, largestSceneText);
    if (!text)
        return text.error();
    return sceneOfText(*text, clipFolder.empty() ? path.parent_path() : clipFolder, warnings);
}

bool isSceneText(std::string_view bytes)
{
    const auto unmarked = utf8Text(bytes);
    if (!unmarked)
        return false;
    const std::string_view text = *unmarked;
    const auto first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || text[first] != '{' || text.find(sceneFormatName) == std::string_view::npos)
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
