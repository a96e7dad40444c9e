#include "io/SceneFile.h"
#include "io/SceneJson.h"
#include "io/schema/DocumentTool.h"
#include "support/RandomScene.h"

using namespace pacini;

int main(int argc, char** argv)
{
    const auto writeSample = [](const std::filesystem::path& path, int number)
    {
        const auto seed = static_cast<std::uint64_t>(number);
        const bool textured = number % 4 == 3;
        return writeScene(path, number == 0 ? Scene{} : textured ? test::texturedScene(seed) : test::randomScene(seed));
    };
    const auto noFiles = [](const std::string&) -> Result<Clip>
    {
        return Error{ErrorCode::io, "", "does not exist"};
    };
    return test::documentTool(argc, argv, writeSample,
                              [&](std::string_view text) { return readSceneJson(text, noFiles); });
}
