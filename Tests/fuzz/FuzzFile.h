#pragma once

// A file with the bytes of a fuzz target, for readers that take a path.

#include "FuzzCheck.h"

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

namespace pacini
{

/// In the folder of temporary files, one for each process; goes with it.
class FuzzFile
{
public:
    explicit FuzzFile(const std::string& ending)
        : path(std::filesystem::temp_directory_path() /
               ("pacini-fuzz-" + std::to_string(std::random_device()()) + ending))
    {
    }
    ~FuzzFile()
    {
        std::error_code unknown;
        std::filesystem::remove(path, unknown);
    }
    FuzzFile(const FuzzFile&) = delete;
    FuzzFile& operator=(const FuzzFile&) = delete;

    const std::filesystem::path& with(const std::uint8_t* data, std::size_t size) const
    {
        std::ofstream file(path, std::ios::binary | std::ios::trunc);
        file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
        FUZZ_CHECK(file.good());
        return path;
    }

private:
    std::filesystem::path path;
};

} // namespace pacini
