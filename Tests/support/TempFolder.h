#pragma once

// A folder for the files of one test, removed with everything in it.

#include <pacini/foundation/Random.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

namespace pacini::test
{

class TempFolder
{
public:
    TempFolder()
    {
        std::random_device seed;
        Random random(seed());
        for (int attempt = 0; attempt < 100; ++attempt)
        {
            folder = std::filesystem::temp_directory_path() / ("pacini-test-" + std::to_string(random.next()));
            if (std::filesystem::create_directory(folder))
                return;
        }
        throw std::runtime_error("no temporary folder");
    }
    ~TempFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    [[nodiscard]] std::filesystem::path path() const { return folder; }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return folder / name; }

    /// Files and folders in it.
    [[nodiscard]] std::size_t entries() const
    {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
    }

private:
    std::filesystem::path folder;
};

inline std::string bytesOf(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw std::runtime_error("cannot read " + path.string());
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline std::filesystem::path put(const std::filesystem::path& path, std::string_view bytes)
{
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush())
        throw std::runtime_error("cannot write " + path.string());
    return path;
}

} // namespace pacini::test
