#include "io/AudioWriter.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/TempFolder.h"

#include <pacini/analysis/methods/Method.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
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

/// Runs `pacini bench` in the folder; what it says lands in `log`. Returns its exit code.
int bench(const TempFolder& folder, const std::string& arguments)
{
    const std::string line = "cd \"" + folder.path().string() + "\" && \"" + paciniCommand().string() + "\" bench " +
                             arguments + " > log 2>&1";
    const int status = std::system(line.c_str());
    return status > 255 ? status / 256 : status;
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

TEST_CASE("pacini bench measures everything on a folder and writes tables, charts and a page", "[cli][bench][slow]")
{
    const TempFolder folder;
    writeSound(folder / "tone.wav");
    const auto out = folder / "out";
    REQUIRE(bench(folder, "all . -o out --repeat 1 --markdown measurements.md --json") == 0);
    const auto printed = nlohmann::json::parse(bytesOf(folder / "log"));
    CHECK(printed["benches"].size() == 16);
    for (const auto& file : printed["written"])
        CHECK(std::filesystem::exists(folder / file.get<std::string>()));

    for (const std::string name :
         {"simplify", "decimate", "filters", "analysis", "synthesis", "oscillators", "scenes", "actuators",
          "equalizers", "live", "body", "stages", "methods", "match", "runtime", "textures"})
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
    for (const std::string chart : {"simplify-count",
                                    "simplify-tolerance",
                                    "decimate",
                                    "analysis",
                                    "analysis-bands",
                                    "synthesis",
                                    "filters-48",
                                    "filters-768",
                                    "oscillators-steady",
                                    "oscillators-gliding",
                                    "scenes",
                                    "actuators",
                                    "equalizers-48",
                                    "equalizers-8",
                                    "live",
                                    "body-8",
                                    "body-16",
                                    "body-48",
                                    "methods",
                                    "methods-rate",
                                    "match",
                                    "runtime",
                                    "textures-ridges",
                                    "textures-rough"})
        CHECK(bytesOf(out / (chart + ".svg")).find("</svg>") != std::string::npos);
    const std::string text = bytesOf(folder / "measurements.md");
    CHECK(text.find("pacini bench all") != std::string::npos);
    CHECK(text.find("| a2vt |") != std::string::npos);
    CHECK(text.find("tone.wav") != std::string::npos);
}

TEST_CASE("pacini bench methods measures size, quality and speed of every method", "[cli][bench]")
{
    const TempFolder folder;
    writeSound(folder / "tone.wav");
    REQUIRE(bench(folder, "methods tone.wav -o . --repeat 1") == 0);
    CHECK(bytesOf(folder / "log").find("bytesPerSecond") != std::string::npos);
    const auto json = nlohmann::json::parse(bytesOf(folder / "methods.json"));
    // a2vt without what is heard, and with it instead; the sound itself and silence
    REQUIRE(json["rows"].size() == methodTable.size() + 4);
    std::map<std::string, double> references;
    for (const auto& row : json["rows"])
    {
        INFO(row.dump());
        CHECK(row["matchSd"].is_null()); // of one sound
        if (row["method"] == "sound itself" || row["method"] == "silence")
        {
            CHECK(row["encodeSeconds"].is_null());
            references[row["method"]] = row["hts"];
            continue;
        }
        const auto method = methodNamed(row["method"].get<std::string>());
        REQUIRE(method);
        const bool signal = methodInfo(*method).output == MethodOutput::signal;
        CHECK(row["bytesPerSecond"].is_null() == signal);
        CHECK(row["encodeSeconds"].get<double>() > 0.0);
        CHECK(row["hts"].get<double>() >= 0.0);
        CHECK(row["hts"].get<double>() <= 100.0);
        CHECK(row["detectedF1"].is_number());
    }
    // All of this sound lies below 1 kHz: a low-pass there keeps it, a shift by two octaves does not.
    const auto distance = [&](const std::string& method)
    {
        const auto& rows = json["rows"];
        const auto row =
            std::find_if(rows.begin(), rows.end(), [&](const auto& one) { return one["method"] == method; });
        REQUIRE(row != rows.end());
        return (*row)["lsd"].template get<double>();
    };
    REQUIRE(references.size() == 2);
    CHECK(references["sound itself"] > 99.0);
    CHECK(references["silence"] < 50.0);
    // The best match comes first, and what the columns are is said.
    double before = 1000.0;
    for (const auto& row : json["means"])
        if (row["match"].is_number())
        {
            CHECK(row["match"].get<double>() <= before);
            before = row["match"].get<double>();
        }
    CHECK(bytesOf(folder / "log").find("'silence' are what") != std::string::npos);
    CHECK(bytesOf(folder / "methods-match.svg").find("</svg>") != std::string::npos);
    CHECK(distance("lowpass") < 1.0);
    CHECK(distance("pitch-shift") > 5.0);
}

TEST_CASE("pacini bench body shows which integrators break at stiff joints, and where", "[cli][bench]")
{
    const TempFolder folder;
    writeSound(folder / "tone.wav");
    REQUIRE(bench(folder, "body tone.wav -o . --repeat 1") == 0);
    const auto json = nlohmann::json::parse(bytesOf(folder / "body.json"));
    REQUIRE(json["means"].size() == 3 * 4 * 7);
    for (const auto& row : json["means"])
    {
        INFO(row.dump());
        const std::string integrator = row["integrator"];
        if (integrator == "body model" || integrator == "modes and taps")
        {
            CHECK(row["error"].get<double>() < 0.1);
            CHECK(row["breaksAt"].is_null());
        }
        if (integrator == "semi-implicit Euler" || integrator == "Runge-Kutta 4")
        {
            CHECK(row["breaksAt"].get<double>() < 1e9);
            if (row["stiffness"] == "1e+11")
                CHECK(row["error"].is_null());
            if (row["stiffness"] == "4e+04")
                CHECK(row["error"].get<double>() < 50.0);
        }
    }
}

TEST_CASE("pacini bench filters and oscillators show which forms lose digits, once for any number of sounds",
          "[cli][bench][slow]")
{
    const TempFolder folder;
    writeSound(folder / "tone.wav");
    writeSound(folder / "again.wav");
    REQUIRE(bench(folder, "filters . -o . --repeat 1") == 0);
    const auto filters = nlohmann::json::parse(bytesOf(folder / "filters.json"));
    REQUIRE(filters["rows"].size() == 6 * 2 * 7);
    for (const auto& row : filters["rows"])
    {
        INFO(row.dump());
        const std::string form = row["form"];
        if (form == "state variable, increments")
            CHECK(row["level"].get<double>() < -240.0);
        if (form == "transposed form II, float" && row["rate"] == "768 kHz")
            CHECK(row["level"].get<double>() > -20.0);
    }
    REQUIRE(bench(folder, "oscillators . -o . --repeat 1") == 0);
    const auto oscillators = nlohmann::json::parse(bytesOf(folder / "oscillators.json"));
    REQUIRE(oscillators["rows"].size() == 2 * 3 * 6);
    for (const auto& row : oscillators["rows"])
    {
        INFO(row.dump());
        if (row["form"] == "carrier bank")
        {
            CHECK(row["phase"].get<double>() < 1e-6);
            CHECK(row["amplitude"].get<double>() < 1e-5);
            CHECK(row["noise"].get<double>() < -120.0);
        }
        if (row["form"] == "accumulator and sine, float" && row["after"] == "24 h")
            CHECK(row["error"].get<double>() > 10.0);
    }
}

TEST_CASE("pacini bench textures shows autoregressive models nearer than bands of noise, and loops that repeat",
          "[cli][bench][slow]")
{
    const TempFolder folder;
    writeSound(folder / "tone.wav");
    REQUIRE(bench(folder, "textures . -o . --repeat 1") == 0);
    const auto json = nlohmann::json::parse(bytesOf(folder / "textures.json"));
    REQUIRE(json["rows"].size() == 4 * 2 * (9 + 4 + 5 + 6 + 1));
    const auto rowOf = [&](const auto& like, const char* form, const char* size)
    {
        for (const auto& row : json["rows"])
            if (row["surface"] == like["surface"] && row["speeds"] == like["speeds"] && row["form"] == form &&
                row["size"] == size)
                return row;
        FAIL("there is no such row");
        return json["rows"][0];
    };
    for (const auto& row : json["rows"])
    {
        if (row["form"] != "loop")
            continue;
        INFO(row.dump());
        const auto model = rowOf(row, "autoregressive", "32"), bands = rowOf(row, "noise bands", "24");
        CHECK(model["error"].get<double>() < bands["error"].get<double>());
        CHECK(model["error"].get<double>() < (row["surface"] == "ridges" ? 4.0 : 1.2));
        CHECK(model["error"].get<double>() < rowOf(row, "autoregressive", "2")["error"].get<double>());
        const auto tones = rowOf(row, "with tones", "32");
        const bool hasTones = row["surface"] == "ridges" || row["surface"] == "engine";
        CHECK(tones["error"].get<double>() < (hasTones ? 0.8 : 1.05) * model["error"].get<double>());
        if (row["surface"] == "ridges")
            CHECK(tones["error"].get<double>() < 1.0); // no harmonic counts twice
        // Where tones are, one of them is nearer than none, and four are as near as all that are found.
        const auto one = rowOf(row, "number of tones", "1"), four = rowOf(row, "number of tones", "4");
        CHECK(one["error"].get<double>() < (hasTones ? 0.99 : 1.05) * model["error"].get<double>());
        CHECK(four["error"].get<double>() < 1.1 * tones["error"].get<double>());
        CHECK(row["repetition"].get<double>() > 0.7);
        if (row["surface"] != "ridges")
            CHECK(model["repetition"].get<double>() < 0.25);
    }
}

TEST_CASE("pacini bench stages gives shares that add up", "[cli][bench]")
{
    const TempFolder folder;
    writeSound(folder / "tone.wav");
    REQUIRE(bench(folder, "stages . -o . --repeat 2") == 0);
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

TEST_CASE("pacini bench scenes finds the bounds of what is left out kept and fewer plays faster", "[cli][bench]")
{
    const TempFolder folder;
    writeSound(folder / "tone.wav");
    REQUIRE(bench(folder, "scenes . -o . --repeat 1") == 0);
    const auto json = nlohmann::json::parse(bytesOf(folder / "scenes.json"));
    REQUIRE(json["rows"].size() == 16);
    for (const auto& row : json["rows"])
    {
        INFO(row.dump());
        const bool everything = row["tolerance"] == "everything";
        CHECK(row["boundsHold"].is_null() == everything);
        if (!everything)
            CHECK(row["boundsHold"] == 100.0);
        if (row["audible"] == "8 of 64" && row["tolerance"] == "-40 dB")
            CHECK(row["plays"].get<double>() < 20.0);
    }
}

TEST_CASE("pacini bench says what is wrong with its inputs and measures the others", "[cli][bench]")
{
    const TempFolder folder;
    writeSound(folder / "tone.wav");
    put(folder / "broken.wav", "RIFF");
    CHECK(bench(folder, "decimate . -o out --repeat 1") == 1);
    CHECK(bytesOf(folder / "log").find("broken.wav") != std::string::npos);
    CHECK(std::filesystem::exists(folder / "out" / "decimate.csv"));
    CHECK(bench(folder, "decimate none.wav -o none") == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "none"));
    put(folder / "onsets.json", "[]");
    CHECK(bench(folder, "decimate tone.wav -o bad") == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "bad"));
    CHECK(bench(folder, "everything") == 2);
}
