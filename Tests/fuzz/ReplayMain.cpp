// Runs a fuzz target over stored inputs, without libFuzzer: every file of every folder given.
//
//   replay FOLDER...     fails when a folder is missing or there is no input at all

#include "FuzzCheck.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

namespace
{
std::size_t replay(const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.is_regular_file())
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& path : files)
    {
        // Named before it runs, so that the culprit of a crash is the last one printed.
        std::cout << path.filename().string() << std::endl;
        std::ifstream file(path, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }
    return files.size();
}
} // namespace

int main(int argc, char** argv)
{
    try
    {
        std::size_t count = 0;
        for (int i = 1; i < argc; ++i)
            count += replay(argv[i]);
        std::cout << count << " inputs\n";
        return count > 0 ? 0 : 1;
    }
    catch (const std::exception& exception)
    {
        std::cerr << exception.what() << "\n";
        return 1;
    }
}
