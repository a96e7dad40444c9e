#include "io/ClipFile.h"
#include "io/formats/json/ClipJson.h"
#include "io/schema/DocumentTool.h"
#include "support/RandomClip.h"

using namespace pacini;

int main(int argc, char** argv)
{
    const auto writeSample = [](const std::filesystem::path& path, int number)
    {
        // The first is the emptiest clip, the last is long.
        const auto clip =
            number == 0 ? Clip{} : test::randomFullClip(static_cast<std::uint64_t>(number), number == 19 ? 2000 : 5);
        return writeClip(path, clip, jsonFormat());
    };
    return test::documentTool(argc, argv, writeSample, [](std::string_view text) { return readClipJson(text); });
}
