#include "io/AtomicFile.h"
#include "io/TextureFile.h"
#include "io/schema/DocumentTool.h"
#include "support/RandomTexture.h"

using namespace pacini;

int main(int argc, char** argv)
{
    const auto writeSample = [](const std::filesystem::path& path, int number)
    {
        return writeFileAtomically(path, textureJson(test::randomTexture(static_cast<std::uint64_t>(number))));
    };
    return test::documentTool(argc, argv, writeSample, [](std::string_view text) { return readTextureJson(text); });
}
