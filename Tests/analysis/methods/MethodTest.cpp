#include "MethodSignals.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Measure.h"

#include <pacini/analysis/methods/Method.h>

#include <limits>
#include <set>
#include <string>

using namespace pacini;
using namespace pacini::test;

namespace
{

std::vector<Method> methodsThatMake(MethodOutput output)
{
    std::vector<Method> found;
    for (const MethodInfo& info : methodTable)
        if (info.output == output && info.method != Method::a2vt)
            found.push_back(info.method);
    return found;
}

/// Sounds that have broken encoders before: next to nothing, extremes, and no numbers at all.
std::vector<std::pair<std::string, std::vector<float>>> awkwardSounds(double fs)
{
    const auto second = static_cast<std::size_t>(fs / 4.0);
    std::vector<std::pair<std::string, std::vector<float>>> sounds{
        {"nothing", {}},
        {"one sample", {1.0f}},
        {"two samples", {-0.5f, 0.25f}},
        {"thirteen samples", noise(13, 3)},
        {"silence", std::vector<float>(second, 0.0f)},
        {"a constant", std::vector<float>(second, 0.7f)},
        {"a click", impulse(second, second / 3)},
        {"noise", noise(second, 5)},
        {"a tiny sound", sine(second, 200.0, fs, 1e-38)},
        {"a huge sound", sine(second, 200.0, fs, 3e38)},
        {"a tone at half the rate", sine(second, fs / 2.0, fs, 1.0, 1.0)},
    };
    auto bad = noise(second, 9);
    bad[7] = std::numeric_limits<float>::quiet_NaN();
    bad[70] = std::numeric_limits<float>::infinity();
    sounds.emplace_back("noise with NaN", bad);
    return sounds;
}

} // namespace

TEST_CASE("Every method is in the table once, under its own name", "[methods]")
{
    std::set<std::string_view> names;
    for (std::size_t i = 0; i < methodTable.size(); ++i)
    {
        const MethodInfo& info = methodTable[i];
        CHECK(static_cast<std::size_t>(info.method) == i);
        CHECK(methodInfo(info.method).name == info.name);
        CHECK(methodNamed(info.name) == info.method);
        CHECK(names.insert(info.name).second);
        CHECK(!info.description.empty());
        CHECK(info.description.find('\n') == std::string_view::npos);
    }
    for (const char* unknown : {"", "A2VT", "thesis ", "vocoder", "lowpass\n"})
        CHECK(!methodNamed(unknown));
}

TEST_CASE("Every clip is valid, as long as its sound and named after its method", "[methods]")
{
    for (const double fs : {8000.0, 44100.0, 384000.0})
        for (const auto& [name, sound] : awkwardSounds(fs))
            for (const Method method : methodsThatMake(MethodOutput::clip))
            {
                const Clip clip = translateToClip(method, sound, fs);
                CAPTURE(fs, name, std::string(methodInfo(method).name));
                const auto valid = validate(clip);
                CHECK((valid ? "valid" : valid.error().text()) == "valid");
                CHECK(clip.duration == Approx(static_cast<double>(sound.size()) / fs).margin(0.0));
                CHECK(clip.name.empty());
                CHECK(encoderText(clip, "method", "") == methodInfo(method).name);
                CHECK(!clip.bands.empty());
            }
}

TEST_CASE("Priorities rank the bands of every clip by energy", "[methods]")
{
    const double fs = 16000.0;
    const auto sound = noise(16000, 2);
    for (const Method method : methodsThatMake(MethodOutput::clip))
    {
        const Clip clip = translateToClip(method, sound, fs);
        CAPTURE(std::string(methodInfo(method).name));
        std::set<int> priorities;
        for (const Band& band : clip.bands)
            priorities.insert(band.priority);
        CHECK(priorities.size() == clip.bands.size());
        for (const Band& a : clip.bands)
            for (const Band& b : clip.bands)
                if (a.priority < b.priority)
                    CHECK(curveEnergy(a.amplitude, clip.duration) >= curveEnergy(b.amplitude, clip.duration));
    }
}

TEST_CASE("The gain on record is what raised the sound to full drive", "[methods]")
{
    for (const double amplitude : {0.01, 0.25, 4.0})
        for (const Method method : methodsThatMake(MethodOutput::clip))
        {
            const Clip clip = translateToClip(method, sine(8000, 300.0, 16000.0, amplitude), 16000.0);
            const auto gain = std::find_if(clip.encoder.begin(), clip.encoder.end(),
                                           [](const EncoderParameter& p) { return p.name == "gain"; });
            CAPTURE(amplitude, std::string(methodInfo(method).name));
            REQUIRE(gain != clip.encoder.end());
            CHECK(std::get<double>(gain->value) == Approx(1.0 / amplitude).epsilon(0.1)); // the high-pass rings
        }
}

TEST_CASE("Silence costs no breakpoint and plays as silence", "[methods]")
{
    const std::vector<float> silence(12000, 0.0f);
    for (const Method method : methodsThatMake(MethodOutput::clip))
    {
        const Clip clip = translateToClip(method, silence, 8000.0);
        CAPTURE(std::string(methodInfo(method).name));
        CHECK(breakpointCount(clip) == 0);
        CHECK(clip.transients.empty());
        CHECK(played(clip, 8000.0) == silence);
    }
    for (const Method method : methodsThatMake(MethodOutput::signal))
        CHECK(translateToSignal(method, silence, 8000.0) == silence);
}

TEST_CASE("Signals are as long as the sound and finite", "[methods]")
{
    for (const double fs : {8000.0, 44100.0, 384000.0})
        for (const auto& [name, sound] : awkwardSounds(fs))
            for (const Method method : methodsThatMake(MethodOutput::signal))
            {
                const auto out = translateToSignal(method, sound, fs);
                CAPTURE(fs, name, std::string(methodInfo(method).name));
                CHECK(out.size() == sound.size());
                CHECK(allFinite(out));
            }
}

TEST_CASE("Curves have as many points as the active time allows", "[methods]")
{
    // 2 s of sound between silences.
    const double fs = 8000.0;
    std::vector<float> sound(static_cast<std::size_t>(6.0 * fs), 0.0f);
    const auto middle = noise(static_cast<std::size_t>(2.0 * fs), 4);
    std::copy(middle.begin(), middle.end(), sound.begin() + static_cast<std::ptrdiff_t>(2.0 * fs));
    for (const double breakpoints : {5.0, 20.0, 60.0})
        for (const Method method : methodsThatMake(MethodOutput::clip))
        {
            MethodChoices choices;
            choices.breakpoints = breakpoints;
            const Clip clip = translateToClip(method, sound, fs, choices);
            CAPTURE(breakpoints, std::string(methodInfo(method).name));
            for (const Band& band : clip.bands)
            {
                // The high-pass at 5 Hz rings for some 0.2 s at -75 dB.
                CHECK(static_cast<double>(band.amplitude.size()) >= 2.0 * breakpoints);
                CHECK(static_cast<double>(band.amplitude.size()) <= 2.6 * breakpoints);
            }
        }
}

TEST_CASE("Choices that a method does not have leave it as it is", "[methods]")
{
    const auto sound = noise(8000, 8);
    MethodChoices choices;
    choices.bands = 3;
    choices.quantise = 5;
    choices.lowFrequency = 50.0;
    choices.highFrequency = 500.0;
    for (const Method method : methodsThatMake(MethodOutput::clip))
        if (method != Method::thesis)
            CHECK(translateToClip(method, sound, 8000.0, choices) == translateToClip(method, sound, 8000.0));
    const Clip clip = translateToClip(Method::thesis, sound, 8000.0, choices);
    REQUIRE(clip.bands.size() == 3);
    CHECK(clip.bands.front().centreFrequency == Approx(50.0));
    CHECK(clip.bands.back().centreFrequency == Approx(500.0));
    for (const Band& band : clip.bands)
        for (const Breakpoint& point : band.amplitude)
            CHECK(point.value * 31.0 == Approx(std::round(point.value * 31.0)).margin(1e-9));
}
