#include "io/ProfileFile.h"
#include "io/schema/DocumentTool.h"
#include "support/RandomProfile.h"

using namespace pacini;

int main(int argc, char** argv)
{
    const auto writeSample = [](const std::filesystem::path& path, int number)
    {
        return writeProfile(path, number == 0 ? Profile{} : test::randomProfile(static_cast<std::uint64_t>(number)));
    };
    return test::documentTool(argc, argv, writeSample, [](std::string_view text) { return readProfileJson(text); });
}
