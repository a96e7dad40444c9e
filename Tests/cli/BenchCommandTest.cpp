#include "cli/Command.h"
#include "io/AudioWriter.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
/// A quarter of a second of decaying tones with an onset that a list beside it states.
void writeSound(const std::filesystem::path& path)
{
    std::vector<float> samples(2000);
    for (std::size_t i = 800; i < samples.size(); ++i)
    {
        const double t = static_cast<double>(i - 800) / 8000.0;
        samples[i] = static_cast<float>(std::exp(-20.0 * t) * (0.5 * std::sin(2.0 * std::numbers::pi * 90.0 * t) +
                                                               0.3 * std::sin(2.0 * std::numbers::pi * 410.0 * t)));
    }
    AudioWriteParams params;
    params.sampleRate = 8000;
    auto writer = AudioWriter::create(path, params);
    REQUIRE(writer.ok());
    REQUIRE(writer->write(samples).ok());
    REQUIRE(writer->finish().ok());
    put(path.parent_path() / "onsets.json", "{\"" + path.filename().string() + "\": [0.1]}");
}

int run(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), "pacini");
    std::vector<const char*> argv;
    for (const std::string& argument : arguments)
        argv.push_back(argument.c_str());
    return cli::runCommandLine(static_cast<int>(argv.size()), argv.data());
}

std::vector<std::string> linesOf(const std::filesystem::path& path)
{
    std::istringstream stream(bytesOf(path));
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}
} // namespace

TEST_CASE("pacini bench measures everything on a folder and writes tables, charts and a page", "[cli][bench]")
{
    const TempFolder folder;
    writeSound(folder / "tone.wav");
    const auto out = folder / "out";
    const auto page = folder / "measurements.md";
    REQUIRE(run({"bench", "all", folder.path().string(), "-o", out.string(), "--repeat", "1", "--markdown",
                 page.string(), "--json"}) == 0);

    for (const std::string name : {"simplify", "decimate", "analysis", "synthesis", "stages", "methods"})
    {
        INFO(name);
        const auto json = nlohmann::json::parse(bytesOf(out / (name + ".json")));
        CHECK(json["bench"] == name);
        CHECK(json["sounds"] == 1);
        REQUIRE(json["rows"].size() > 4);
        CHECK(json["means"].size() == json["rows"].size());
        const auto lines = linesOf(out / (name + ".csv"));
        REQUIRE(lines.size() == json["rows"].size() + 1);
        CHECK(lines[0].rfind("clip,", 0) == 0);
        for (const auto& [key, value] : json["rows"][0].items())
            CHECK(lines[0].find(key) != std::string::npos);
    }
    for (const std::string chart : {"simplify-count", "simplify-tolerance", "decimate", "analysis", "analysis-bands",
                                    "synthesis", "methods", "methods-rate"})
        CHECK(bytesOf(out / (chart + ".svg")).find("</svg>") != std::string::npos);
    const std::string text = bytesOf(page);
    CHECK(text.find("pacini bench all") != std::string::npos);
    CHECK(text.find("| a2vt |") != std::string::npos);
    CHECK(text.find("tone.wav") != std::string::npos);
}

TEST_CASE("pacini bench methods measures size, quality and speed of every method", "[cli][bench]")
{
    const TempFolder folder;
    writeSound(folder / "tone.wav");
    REQUIRE(run({"bench", "methods", (folder / "tone.wav").string(), "-o", folder.path().string(), "--repeat", "1",
                 "--json"}) == 0);
    const auto json = nlohmann::json::parse(bytesOf(folder / "methods.json"));
    REQUIRE(json["rows"].size() == 8);
    for (const auto& row : json["rows"])
    {
        INFO(row.dump());
        const bool signal = row["method"] == "lowpass" || row["method"] == "pitch-shift";
        CHECK(row["bytesPerSecond"].is_null() == signal);
        CHECK(row["encodeSeconds"].get<double>() > 0.0);
        CHECK(row["hts"].get<double>() >= 0.0);
        CHECK(row["hts"].get<double>() <= 100.0);
        CHECK(row["detectedF1"].is_number());
    }
    // All of this sound lies below 1 kHz: a low-pass there keeps it, a shift by two octaves does not.
    CHECK(json["rows"][6]["lsd"].get<double>() < 1.0);
    CHECK(json["rows"][7]["lsd"].get<double>() > 5.0);
}

TEST_CASE("pacini bench stages gives shares that add up", "[cli][bench]")
{
    const TempFolder folder;
    writeSound(folder / "tone.wav");
    REQUIRE(run({"bench", "stages", folder.path().string(), "-o", folder.path().string(), "--repeat", "2", "--json"}) ==
            0);
    const auto json = nlohmann::json::parse(bytesOf(folder / "stages.json"));
    double sum = 0.0;
    for (const auto& row : json["means"])
    {
        if (row["stage"] == "all of these")
            break;
        sum += row["share"].get<double>();
    }
    CHECK(sum == Approx(100.0));
}

TEST_CASE("pacini bench says what is wrong with its inputs and measures the others", "[cli][bench]")
{
    const TempFolder folder;
    writeSound(folder / "tone.wav");
    put(folder / "broken.wav", "RIFF");
    CHECK(run({"bench", "decimate", folder.path().string(), "-o", (folder / "out").string(), "--repeat", "1"}) == 1);
    CHECK(std::filesystem::exists(folder / "out" / "decimate.csv"));
    CHECK(run({"bench", "decimate", (folder / "none.wav").string(), "-o", (folder / "none").string()}) == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "none"));
    put(folder / "onsets.json", "[]");
    CHECK(run({"bench", "decimate", (folder / "tone.wav").string(), "-o", (folder / "bad").string()}) == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "bad"));
    CHECK(run({"bench", "everything"}) == 2);
}
