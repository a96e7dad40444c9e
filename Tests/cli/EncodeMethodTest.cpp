#include "io/AudioReader.h"
#include "io/AudioWriter.h"
#include "io/ClipFile.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"
#include "support/Paths.h"
#include "support/TempFolder.h"

#include <pacini/analysis/methods/Method.h>
#include <pacini/clip/PackedClip.h>

#include <cstdlib>

using namespace pacini;
using namespace pacini::test;

namespace
{

struct MethodOutcome
{
    int status = 0;
    std::string out; ///< stdout, then stderr
};

/// Runs `pacini encode` in `folder`. Arguments must not need quoting.
MethodOutcome encode(const TempFolder& folder, const std::string& arguments)
{
    const auto log = folder / "log";
    const std::string command = "cd \"" + folder.path().string() + "\" && \"" + paciniCommand().string() +
                                "\" encode " + arguments + " > log 2>&1";
    const int status = std::system(command.c_str());
    MethodOutcome outcome{status > 255 ? status >> 8 : status, bytesOf(log)};
    std::filesystem::remove(log);
    return outcome;
}

bool has(const MethodOutcome& outcome, const std::string& text)
{
    return outcome.out.find(text) != std::string::npos;
}

/// Half a second of two tones at 16 kHz.
std::vector<float> tones()
{
    auto x = sine(8000, 120.0, 16000.0, 0.4);
    const auto high = sine(8000, 3000.0, 16000.0, 0.2);
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] += high[i];
    return x;
}

void putSoundFile(const std::filesystem::path& path, std::span<const float> interleaved, int channels = 1)
{
    REQUIRE(writeAudio(path, interleaved, {.sampleRate = 16000, .channels = channels}).ok());
}

} // namespace

TEST_CASE("encode lists every method with its description", "[cli]")
{
    const TempFolder folder;
    const auto list = encode(folder, "--list-methods");
    CHECK(list.status == 0);
    for (const MethodInfo& info : methodTable)
    {
        CHECK(has(list, std::string(info.name)));
        CHECK(has(list, std::string(info.description)));
    }
    const auto help = encode(folder, "--help");
    CHECK(help.status == 0);
    for (const MethodInfo& info : methodTable)
        CHECK((has(help, std::string(info.name)) || has(help, "--list-methods")));
}

TEST_CASE("encode makes the clip of every method in both formats", "[cli]")
{
    const TempFolder folder;
    putSoundFile(folder / "door.wav", tones());
    for (const MethodInfo& info : methodTable)
        if (info.output == MethodOutput::clip)
        {
            const std::string name(info.name);
            CAPTURE(name);
            CHECK(encode(folder, "door.wav -o " + name + ".json --method " + name).status == 0);
            CHECK(encode(folder, "door.wav -o " + name + ".pacb --method " + name).status == 0);
            const auto read = readClip(folder / (name + ".json"));
            const auto packed = readClip(folder / (name + ".pacb"));
            REQUIRE(read.ok());
            REQUIRE(packed.ok());
            CHECK((read->clip == packed->clip));
            const Clip* clip = &read->clip;
            CHECK(encoderText(*clip, "method", "") == info.name);
            CHECK(clip->name == "door");
            CHECK(clip->source == ClipSource{"door.wav", 16000.0, 1});
            CHECK(clip->duration == 0.5);
            CHECK(breakpointCount(*clip) > 0);
        }
}

TEST_CASE("Bands of noise of a decomposition are in its JSON, in its packed form and in what both play", "[cli]")
{
    const TempFolder folder;
    putSoundFile(folder / "rain.wav", noise(16000, 4, 0.5));
    REQUIRE(encode(folder, "rain.wav -o rain.json --method decomposition").status == 0);
    REQUIRE(encode(folder, "rain.wav -o rain.pacb --method decomposition").status == 0);
    const auto clip = readClip(folder / "rain.json");
    const auto packed = readClip(folder / "rain.pacb");
    REQUIRE(clip.ok());
    REQUIRE(packed.ok());
    CHECK(clip->clip.noise.size() == 6);
    CHECK((clip->clip.noise == packed->clip.noise));
    Clip alone = clip->clip;
    alone.bands.clear();
    REQUIRE(writeClip(folder / "alone.json", alone, jsonFormat()).ok());
    REQUIRE(writeClip(folder / "alone.pacb", alone, packedFormat()).ok());
    for (const std::string name : {"rain", "alone"})
        for (const std::string form : {".json", ".pacb"})
            REQUIRE(std::system(("cd \"" + folder.path().string() + "\" && \"" + paciniCommand().string() +
                                 "\" render " + name + form + " -o " + name + form + ".wav --rate 8000 > log 2>&1")
                                    .c_str()) == 0);
    const auto samplesOf = [&folder](const char* name)
    {
        const auto audio = readAudio(folder / name);
        REQUIRE(audio.ok());
        return audio->samples;
    };
    CHECK((samplesOf("rain.json.wav") == samplesOf("rain.pacb.wav")));
    CHECK((samplesOf("alone.json.wav") == samplesOf("alone.pacb.wav")));
    CHECK((samplesOf("alone.json.wav") != samplesOf("rain.json.wav")));
    CHECK(rms(samplesOf("alone.json.wav")) > 0.05);
}

TEST_CASE("encode writes the signal of a method as a WAV that never replaces the recording", "[cli]")
{
    const TempFolder folder;
    const auto x = tones();
    putSoundFile(folder / "door.wav", x);
    const auto recording = bytesOf(folder / "door.wav");
    for (const auto& [method, name] :
         {std::pair(Method::lowpass, "lowpass"), std::pair(Method::pitchShift, "pitch-shift")})
    {
        CAPTURE(std::string(name));
        CHECK(encode(folder, std::string("door.wav --method ") + name).status == 0);
        const auto beside = readAudio(folder / ("door." + std::string(name) + ".wav"));
        REQUIRE(beside.ok());
        CHECK((beside->samples == translateToSignal(method, x, 16000.0)));
        CHECK(beside->sampleRate == 16000);
        CHECK(beside->channels == 1);
        std::filesystem::create_directory(folder / name);
        CHECK(encode(folder, std::string("door.wav --method ") + name + " -o " + name).status == 0);
        // Their marks say where the recording lies as seen from each.
        CHECK((readAudio(folder / name / "door.wav")->samples == beside->samples));
        CHECK(encode(folder, std::string("door.wav --method ") + name + " -o door.wav").status == 1);
        CHECK(encode(folder, std::string("door.wav --method ") + name + " -o ./").status == 0);
    }
    CHECK(bytesOf(folder / "door.wav") == recording);
}

TEST_CASE("encode refuses options that a method does not have", "[cli]")
{
    const TempFolder folder;
    putSoundFile(folder / "door.wav", tones());
    const std::size_t before = folder.entries();
    for (const char* arguments :
         {"--method envelope-sine --bands 3", "--method envelope-sine --low 50", "--method vocoder16 --quantise 8",
          "--method centroid-flatness --spacing linear", "--method thesis --keep-level",
          "--method thesis --sensitivity 2", "--sensitivity 9", "--audible 1.1", "--method thesis --audible 1",
          "--method thesis --spacing log", "--method lowpass --breakpoints 5", "--method lowpass --format json",
          "--method pitch-shift --format packed", "--method lowpass -o a.json", "--method lowpass -o a.pacb",
          "--method lowpass .", "--method A2VT", "--method thesis --bands 0", "--method thesis --breakpoints 5000"})
    {
        CAPTURE(std::string(arguments));
        const auto outcome = encode(folder, std::string("door.wav ") + arguments);
        CHECK(outcome.status == 2);
        CHECK(has(outcome, "pacini: "));
    }
    CHECK(encode(folder, "--method thesis").status == 2);
    CHECK(folder.entries() == before);
}

TEST_CASE("encode passes on to a method what the user chose, and only that", "[cli]")
{
    const TempFolder folder;
    putSoundFile(folder / "door.wav", tones());
    const auto clipOf = [&folder](const std::string& arguments)
    {
        CHECK(encode(folder, "door.wav -f -o x.json " + arguments).status == 0);
        return readClip(folder / "x.json")->clip;
    };
    // 6 bands and 12 bits are the thesis's own defaults, 12 and 6 those of a2vt.
    const Clip usual = clipOf("--method thesis");
    CHECK(usual.bands.size() == 6);
    CHECK(packParamsFor(usual).bits == 12);
    CHECK(usual.bands.front().centreFrequency == Approx(30.0).epsilon(0.01));
    const Clip chosen = clipOf("--method thesis --bands 3 --low 60 --high 500 --quantise 8 --breakpoints 5");
    CHECK(chosen.bands.size() == 3);
    CHECK(packParamsFor(chosen).bits == 8);
    CHECK(chosen.bands.front().centreFrequency == Approx(60.0).epsilon(0.02));
    CHECK(chosen.bands.back().centreFrequency == Approx(500.0).epsilon(0.02));
    CHECK(breakpointCount(chosen) < breakpointCount(usual) / 2);
    CHECK(breakpointCount(clipOf("--method envelope-sine --breakpoints 60")) >
          breakpointCount(clipOf("--method envelope-sine")));
}

TEST_CASE("More sensitivity gives more transients", "[cli]")
{
    const TempFolder folder;
    // Noise that gets louder by 6 dB now and then.
    auto x = noise(48000, 4);
    for (std::size_t i = 0; i < x.size(); ++i)
        x[i] *= (i / 3200) % 2 != 0 ? 0.5f : 0.25f;
    putSoundFile(folder / "door.wav", x);
    const auto transients = [&folder](const std::string& sensitivity)
    {
        CHECK(encode(folder, "door.wav -f -o x.json --sensitivity " + sensitivity).status == 0);
        return readClip(folder / "x.json")->clip.transients.size();
    };
    CHECK(transients("0.25") <= 1);
    CHECK(transients("4") > transients("0.25") + 5);
}

TEST_CASE("A clip is up to date only for the method and options that made it", "[cli]")
{
    const TempFolder folder;
    putSoundFile(folder / "door.wav", tones());
    const std::vector<std::string> ways{"",
                                        "--low 50",
                                        "--spacing linear",
                                        "--keep-level",
                                        "--sensitivity 2",
                                        "--method thesis",
                                        "--method thesis --low 50",
                                        "--method thesis --high 700",
                                        "--method thesis --bands 5",
                                        "--method thesis --quantise 10",
                                        "--method envelope-sine",
                                        "--method envelope-sine --breakpoints 10",
                                        "--method envelope-centroid",
                                        "--method vocoder16",
                                        "--method modulation",
                                        "--method centroid-flatness"};
    for (const char* output : {" -o x.json", " -o x.pacb"})
        for (std::size_t i = 0; i < ways.size(); ++i)
        {
            CAPTURE(ways[i], std::string(output));
            CHECK(has(encode(folder, "door.wav " + ways[i] + output), "1 encoded"));
            CHECK(has(encode(folder, "door.wav " + ways[i] + output), "1 up to date"));
            // Back to the first way, which must not be taken for done, and on to the next.
            if (i > 0)
                CHECK(has(encode(folder, "door.wav" + std::string(output)), "1 encoded"));
        }
}

TEST_CASE("No method loses channels in antiphase", "[cli]")
{
    const TempFolder folder;
    const auto x = tones();
    std::vector<float> stereo;
    for (const float v : x)
        stereo.insert(stereo.end(), {v, -v});
    putSoundFile(folder / "mono.wav", x);
    putSoundFile(folder / "stereo.wav", stereo, 2);
    for (const char* method : {"thesis", "envelope-sine"})
    {
        CHECK(encode(folder, std::string("mono.wav stereo.wav -o out/ -f --method ") + method).status == 0);
        const auto mono = readClip(folder.path() / "out" / "mono.json")->clip;
        const auto both = readClip(folder / "out" / "stereo.json")->clip;
        CHECK((mono.bands == both.bands));
        CHECK(both.source.channels == 2);
    }
    CHECK(encode(folder, "mono.wav stereo.wav -o signals/ --method lowpass").status == 0);
    CHECK(
        (readAudio(folder / "signals" / "mono.wav")->samples == readAudio(folder / "signals" / "stereo.wav")->samples));
}
