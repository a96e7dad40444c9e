#pragma once

// Lets a script in another language see what the library writes and reads.
//
//   write FOLDER   writes samples as FOLDER/N.json
//   read           reads documents, each ended by a NUL byte, from standard input and prints one line for each:
//                  "ok", or "error", where and message, separated by tabs

#include <filesystem>
#include <iostream>
#include <iterator>
#include <string>
#include <string_view>

namespace pacini::test
{

/// The tool's main: `writeSample(path, number)` writes one of 20 samples, `read(text)` reads a document.
template <typename WriteSample, typename Read>
int documentTool(int argc, char** argv, WriteSample writeSample, Read read)
{
    if (argc == 3 && std::string_view(argv[1]) == "write")
    {
        for (int number = 0; number < 20; ++number)
            if (const auto written =
                    writeSample(std::filesystem::path(argv[2]) / (std::to_string(number) + ".json"), number);
                !written)
            {
                std::cerr << written.error().text() << "\n";
                return 1;
            }
        return 0;
    }
    if (argc == 2 && std::string_view(argv[1]) == "read")
    {
        const std::string input{std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
        for (std::size_t start = 0; start < input.size();)
        {
            const auto end = input.find('\0', start);
            if (const auto document = read(std::string_view(input).substr(start, end - start)))
                std::cout << "ok\n";
            else
                std::cout << "error\t" << document.error().where << "\t" << document.error().message << "\n";
            if (end == std::string::npos)
                break;
            start = end + 1;
        }
        return 0;
    }
    std::cerr << "usage: write FOLDER | read\n";
    return 2;
}

} // namespace pacini::test
