#include "cli/CompareJob.h"
#include "cli/CompareReport.h"
#include "io/AudioBytes.h"
#include "io/AudioWriter.h"
#include "io/ClipFile.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/TempFolder.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::cli;
using namespace pacini::test;

namespace fs = std::filesystem;

namespace
{
struct Outcome
{
    int status = 0;
    std::string out;
    std::string messages;
};

/// Runs `pacini compare` in `folder`. Arguments must not need quoting.
Outcome compareIn(const TempFolder& folder, const std::string& arguments)
{
    const std::string command = "cd \"" + folder.path().string() + "\" && \"" + paciniCommand().string() +
                                "\" compare " + arguments + " > out.txt 2> messages.txt";
    const int status = std::system(command.c_str());
    return {status > 255 ? status >> 8 : status, bytesOf(folder / "out.txt"), bytesOf(folder / "messages.txt")};
}

nlohmann::json jsonOf(const TempFolder& folder, const std::string& arguments)
{
    const Outcome outcome = compareIn(folder, arguments + " --json");
    CAPTURE(outcome.messages);
    REQUIRE(outcome.status == 0);
    return nlohmann::json::parse(outcome.out);
}

/// Three decaying tones of which the first starts at 0.1 s, at any rate.
std::vector<float> knocks(int rate, double seconds = 1.0)
{
    std::vector<float> x(static_cast<std::size_t>(rate * seconds));
    for (const auto& [onset, frequency] : {std::pair(0.1, 70.0), std::pair(0.35, 180.0), std::pair(0.7, 320.0)})
        for (std::size_t i = 0; i < x.size(); ++i)
            if (const double t = static_cast<double>(i) / rate - onset; t >= 0.0)
                x[i] +=
                    static_cast<float>(0.5 * std::exp(-25.0 * t) * std::sin(2.0 * std::numbers::pi * frequency * t));
    return x;
}

void putSound(const fs::path& path, const std::vector<float>& interleaved, int rate, int channels = 1)
{
    fs::create_directories(path.parent_path());
    REQUIRE(writeAudio(path, interleaved, {.sampleRate = rate, .channels = channels}).ok());
}
} // namespace

TEST_CASE("A sound compared with itself is perfect, at any rate and with its channels mixed down", "[cli]")
{
    const TempFolder folder;
    const auto x = knocks(44100);
    putSound(folder / "a.wav", x, 44100);
    std::vector<float> stereo;
    for (const float v : x)
        stereo.insert(stereo.end(), {0.75f * v, 0.25f * v}); // their mean is half the sound
    putSound(folder / "stereo.wav", stereo, 44100, 2);
    putSound(folder / "slow.wav", knocks(8000), 8000);

    const auto same = jsonOf(folder, "a.wav a.wav")["files"][0];
    CHECK(same["wideSnr"] == 60.0);
    CHECK(same["bandSnr"] == 60.0);
    CHECK(same["lsd"].get<double>() < 1e-3);
    CHECK(same["centroidError"].get<double>() < 1e-3);
    CHECK(same["htsF"].get<double>() > 98.0); // the source alone is limited to 5-1800 Hz
    CHECK(same["f1"].is_null());
    CHECK(same["duration"] == Approx(1.0));

    const auto mixed = jsonOf(folder, "a.wav stereo.wav")["files"][0];
    CHECK(mixed["wideSnr"] == 60.0);
    CHECK(mixed["gain"].get<double>() == Approx(6.02).margin(0.01));

    const auto slow = jsonOf(folder, "a.wav slow.wav")["files"][0];
    CHECK(slow["wideSnr"].get<double>() > 40.0);
    CHECK(slow["lsd"].get<double>() < 0.5);
}

TEST_CASE("Onsets give F1: of detected events, or of those that a clip states", "[cli]")
{
    const TempFolder folder;
    putSound(folder / "a.wav", knocks(44100), 44100);
    put(folder / "marks.json", R"({"a.wav": [0.1, 0.35, 0.7, 0.9]})");
    put(folder / "marks.txt", "0.1\n0.35\n0.7\n");
    put(folder / "doubtful.json", R"({"a.wav": [0.1, 0.35]})");
    put(folder / "doubtful_ambiguous.json", R"({"a.wav": [0.705]})");
    Clip clip;
    clip.duration = 1.0;
    clip.transients = {{0.1, 1.0, 0.5}, {0.5, 1.0, 0.5}, {0.72, 1.0, 0.5}};
    REQUIRE(writeClip(folder / "a.json", clip, jsonFormat()).ok());
    REQUIRE(writeClip(folder / "a.pacb", clip, packedFormat()).ok());

    const auto detected = jsonOf(folder, "a.wav a.wav --onsets marks.json");
    CHECK(detected["files"][0]["f1"].get<double>() == Approx(6.0 / 7.0)); // three of four, nothing spurious
    CHECK(detected["mean"]["f1"] == detected["files"][0]["f1"]);
    CHECK(detected["events"]["missed"] == 1);
    CHECK(jsonOf(folder, "a.wav a.wav --onsets marks.txt")["mean"]["f1"] == 1.0);
    CHECK(jsonOf(folder, "a.wav a.wav --onsets doubtful.json")["mean"]["f1"] == 1.0);
    for (const char* events : {"a.json", "a.pacb"})
    {
        const auto stated = jsonOf(folder, std::string("a.wav a.wav --onsets marks.txt --events ") + events);
        CHECK(stated["mean"]["f1"].get<double>() == Approx(2.0 / 3.0));
        CHECK(stated["mean"]["f1Within10ms"].get<double>() == Approx(1.0 / 3.0));
    }
}

TEST_CASE("Folders are matched by name, and what has no counterpart is said", "[cli]")
{
    const TempFolder folder;
    const auto x = knocks(16000);
    for (const char* name : {"ref/a.wav", "ref/deep/b.wav", "ref/c.wav", "cand/a.wav", "cand/deep/b.wav", "cand/d.wav"})
        putSound(folder / name, x, 16000);
    fs::rename(folder / "cand/a.wav", folder / "cand/a.aif"); // the content decides the format
    const Outcome outcome = compareIn(folder, "ref cand");
    CHECK(outcome.status == 1);
    CHECK(outcome.messages.find("pacini: ref/c.wav: has no counterpart c.* in cand\n") != std::string::npos);
    CHECK(outcome.messages.find("pacini: cand/d.wav: warning: has no reference") != std::string::npos);
    CHECK(outcome.out.find("file") == 0);
    CHECK(outcome.out.find("\na.wav ") != std::string::npos);
    CHECK(outcome.out.find("\ndeep/b.wav ") != std::string::npos);
    CHECK(outcome.out.find("\nmean ") != std::string::npos);
    CHECK(outcome.out.find("\n2 compared, 1 failed") != std::string::npos);
    // Aligned columns: all rows of the table are as long as the heading.
    const auto width = outcome.out.find('\n');
    CHECK(outcome.out.find('\n', width + 1) == 2 * width + 1);
    CHECK(outcome.out.find('\n', 2 * width + 2) == 3 * width + 2);

    putSound(folder / "cand/a.wav", x, 16000);
    fs::remove(folder / "ref/c.wav");
    CHECK(compareIn(folder, "ref cand").messages.find("pacini: ref/a.wav: has two counterparts") != std::string::npos);
}

TEST_CASE("A candidate of another length, a silent reference and samples that are no numbers are warned of", "[cli]")
{
    const TempFolder folder;
    auto x = knocks(16000);
    putSound(folder / "a.wav", x, 16000);
    putSound(folder / "short.wav", {x.begin(), x.end() - 1000}, 16000);
    putSound(folder / "silent.wav", std::vector<float>(16000), 16000);
    x[8000] = std::numeric_limits<float>::quiet_NaN();
    put(folder / "nan.wav", wavBytes({.sampleRate = 16000, .bits = 32, .tag = 3}, float32(x)));

    const Outcome shorter = compareIn(folder, "a.wav short.wav");
    CHECK(shorter.status == 0);
    CHECK(shorter.messages.find("pacini: short.wav: warning: lasts 0.938 s, its reference 1.000 s") == 0);
    const Outcome silent = compareIn(folder, "silent.wav a.wav --json");
    CHECK(silent.status == 0);
    CHECK(silent.messages.find("pacini: silent.wav: warning: is silent") == 0);
    const auto measures = nlohmann::json::parse(silent.out);
    CHECK(measures["files"][0]["lsd"].is_null());
    CHECK(measures["mean"]["lsd"].is_null());
    CHECK(measures["files"][0]["hts"] == 0.0);
    const Outcome bad = compareIn(folder, "a.wav nan.wav --json");
    CHECK(bad.status == 0);
    CHECK(bad.messages.find("pacini: nan.wav: warning: 1 sample ") == 0);
    CHECK(nlohmann::json::parse(bad.out)["files"][0]["notFinite"] == 1);
}

TEST_CASE("Compare says what is wrong with its input and exits with 1, or 2 for wrong usage", "[cli]")
{
    const TempFolder folder;
    putSound(folder / "a.wav", knocks(16000), 16000);
    putSound(folder / "folder/a.wav", knocks(16000), 16000);
    put(folder / "not.wav", "not audio");
    put(folder / "other.json", R"({"b.wav": [0.1]})");
    put(folder / "bad.txt", "0.1\nsoon\n");
    put(folder / "clip.json", "{}");
    const auto check = [&](const std::string& arguments, int status, const std::string& message)
    {
        CAPTURE(arguments);
        const Outcome outcome = compareIn(folder, arguments);
        CAPTURE(outcome.messages);
        CHECK(outcome.status == status);
        CHECK(outcome.messages.find(message) == 0);
    };
    check("a.wav none.wav", 1, "pacini: none.wav: does not exist");
    check("none.wav a.wav", 1, "pacini: none.wav: does not exist");
    check("a.wav not.wav", 1, "pacini: not.wav: is not audio");
    check("a.wav a.wav --onsets none.json", 1, "pacini: none.json: does not exist");
    check("a.wav a.wav --onsets other.json", 1, "pacini: other.json: has no onsets of a.wav");
    check("a.wav a.wav --onsets bad.txt", 1, "pacini: bad.txt: line 2: \"soon\" is not a time");
    put(folder / "good.txt", "0.1\n");
    check("a.wav a.wav --onsets good.txt --events clip.json", 1, "pacini: clip.json: format: is missing");
    check("a.wav folder", 2, "pacini: folder is a folder and a.wav is not");
    check("folder a.wav", 2, "pacini: folder is a folder and a.wav is not");
    check("a.wav", 2, "pacini: ");
    check("a.wav a.wav --events clip.json", 2, "pacini: ");
    check("a.wav a.wav -j 0", 2, "pacini: ");
}
