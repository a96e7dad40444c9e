// Lets a script in another language see what the library writes and reads.
//
//   write FOLDER   writes sample clips as FOLDER/N.json
//   read           reads documents, each ended by a NUL byte, from standard input and prints one line for each:
//                  "ok", or "error", where and message, separated by tabs

#include "io/ClipFile.h"
#include "io/ClipJson.h"
#include "support/RandomClip.h"

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <string>
#include <string_view>

using namespace pacini;

namespace
{
int writeSamples(const std::filesystem::path& folder)
{
    for (std::uint64_t seed = 0; seed < 20; ++seed)
    {
        // The first is the emptiest clip, the last is long.
        const auto clip = seed == 0 ? Clip{} : test::randomClip(seed, seed == 19 ? 2000 : 5);
        const auto written = writeClip(folder / (std::to_string(seed) + ".json"), clip, ClipFormat::json);
        if (!written)
        {
            std::cerr << written.error().text() << "\n";
            return 1;
        }
    }
    return 0;
}

int readDocuments()
{
    const std::string input{std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
    for (std::size_t start = 0; start < input.size();)
    {
        const auto end = input.find('\0', start);
        const auto clip = readClipJson(std::string_view(input).substr(start, end - start));
        if (clip)
            std::cout << "ok\n";
        else
            std::cout << "error\t" << clip.error().where << "\t" << clip.error().message << "\n";
        if (end == std::string::npos)
            break;
        start = end + 1;
    }
    return 0;
}
} // namespace

int main(int argc, char** argv)
{
    if (argc == 3 && std::string_view(argv[1]) == "write")
        return writeSamples(argv[2]);
    if (argc == 2 && std::string_view(argv[1]) == "read")
        return readDocuments();
    std::cerr << "usage: write FOLDER | read\n";
    return 2;
}
