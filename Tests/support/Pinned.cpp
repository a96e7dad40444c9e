#include "support/Pinned.h"

#include "support/Catch.h"
#include "support/Paths.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <map>
#include <sstream>
#include <vector>

namespace pacini
{

namespace
{

using Lines = std::map<std::string, std::string>;

std::vector<double> condensed(std::span<const double> values)
{
    if (values.size() <= 24)
        return {values.begin(), values.end()};
    std::vector<double> sums(6, 0.0);
    sums[0] = static_cast<double>(values.size());
    std::uint64_t state = 1;
    for (const double value : values)
    {
        sums[1] += value * value;
        sums[2] = std::max(sums[2], std::abs(value));
        for (std::size_t i = 3; i < sums.size(); ++i)
        {
            state = state * 6364136223846793005u + 1442695040888963407u; // Knuth, MMIX
            sums[i] += value * (static_cast<double>(state >> 11) * 0x1p-53 - 0.5);
        }
    }
    return sums;
}

std::filesystem::path fileOf(const std::string& name)
{
    return testFolder() / "pinned" / (name.substr(0, name.find('/')) + ".txt");
}

Lines linesOf(const std::filesystem::path& path)
{
    Lines lines;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);)
        if (const auto colon = line.find(": "); colon != std::string::npos)
            lines[line.substr(0, colon)] = line.substr(colon + 2);
    return lines;
}

void pin(const std::string& name, const std::vector<double>& values)
{
    const auto path = fileOf(name);
    auto lines = linesOf(path);
    std::ostringstream text;
    text << std::setprecision(12);
    for (const double value : values)
        text << (text.tellp() > 0 ? " " : "") << value;
    lines[name.substr(name.find('/') + 1)] = text.str();
    std::filesystem::create_directories(path.parent_path());
    std::ofstream file(path);
    for (const auto& [key, line] : lines)
        file << key << ": " << line << '\n';
}

} // namespace

void checkPinned(const std::string& name, std::span<const double> values, double tolerance)
{
    const auto found = condensed(values);
    if (std::getenv("PACINI_PIN") != nullptr)
        pin(name, found);
    INFO("Tests/pinned: " << name << "; made anew by PACINI_PIN=1, see support/Pinned.h");
    static std::map<std::filesystem::path, Lines> files;
    const auto path = fileOf(name);
    if (std::getenv("PACINI_PIN") != nullptr || !files.contains(path))
        files[path] = linesOf(path);
    const Lines& lines = files[path];
    const auto line = lines.find(name.substr(name.find('/') + 1));
    REQUIRE(line != lines.end());
    std::istringstream text(line->second);
    std::vector<double> pinned;
    for (std::string word; text >> word;)
        pinned.push_back(std::strtod(word.c_str(), nullptr)); // knows nan and inf, which >> does not
    REQUIRE(found.size() == pinned.size());
    const bool whole = values.size() <= 24;
    double largest = 1e-300;
    for (const double value : pinned)
        if (whole && std::isfinite(value))
            largest = std::max(largest, std::abs(value));
    for (std::size_t i = 0; i < found.size(); ++i)
    {
        CAPTURE(i, found[i], pinned[i]);
        // A weighted sum is compared with what it would be if all values had one sign.
        const double scale = whole   ? std::max(std::abs(pinned[i]), 1e-4 * largest)
                             : i < 3 ? std::abs(pinned[i])
                                     : std::sqrt(std::abs(pinned[0] * pinned[1]));
        CHECK((found[i] == pinned[i] || (std::isnan(found[i]) && std::isnan(pinned[i])) ||
               std::abs(found[i] - pinned[i]) <= tolerance * scale));
    }
}

void checkPinnedWithEnds(const std::string& name, std::span<const double> values)
{
    checkPinned(name, values, 1e-5);
    if (values.size() <= 24)
        return;
    std::vector<double> ends(values.begin(), values.begin() + 12);
    ends.insert(ends.end(), values.end() - 12, values.end());
    checkPinned(name + ", ends", ends, 1e-4);
}

void checkPinnedCurve(const std::string& name, const std::string& of, const Curve& curve, double tolerance)
{
    std::vector<double> times, values;
    for (const Breakpoint& point : curve)
    {
        times.push_back(point.time);
        values.push_back(point.value);
    }
    checkPinned(name + ", times of " + of, times, 1e-6);
    checkPinned(name + ", values of " + of, values, tolerance);
}

} // namespace pacini
