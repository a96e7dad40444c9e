// The numbers of exported files and of imported clips, for clips of every kind: pinned, since fits and reductions have
// no theory that gives them.

#include "io/formats/ClipFormat.h"
#include "io/formats/FormatSamples.h"
#include "io/formats/NumbersOf.h"
#include "support/Catch.h"
#include "support/ClipSamples.h"
#include "support/Pinned.h"
#include "support/ShippedProfile.h"

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
/// One voice with a step, a glide, loud parts and events: its points stay.
Clip numbersOneVoice()
{
    Clip clip;
    clip.name = "One voice, 2";
    clip.duration = 1.7304;
    Band band;
    band.lowFrequency = 61.3;
    band.centreFrequency = 118.2;
    band.highFrequency = 243.7;
    band.amplitude = {{0.0, 0.0},     {0.0523, 0.713}, {0.211, 0.3217}, {0.211, 1.2},  {0.4446, 0.0},   {0.7337, 0.0},
                      {0.7337, 0.42}, {1.1012, 0.417}, {1.3, 0.0021},   {1.6, 0.0017}, {1.7304, 0.0017}};
    band.pitch = {{0.0, 61.3}, {0.3, 180.1}, {0.9131, 243.7}, {1.4, 99.9}};
    clip.bands.push_back(band);
    clip.transients = {{0.0, 0.9, 0.1},      {0.2113, 0.31, 0.83}, {0.5, 0.7071, 0.5},
                       {0.5174, 0.11, 0.97}, {0.9, 1.3, 0.0},      {1.7, 0.25, 1.0}};
    clip.markers = {{0.3, "here"}};
    clip.source = {"tone.wav", 48000.0, 1};
    return clip;
}

/// Four bands of a levelled clip with noise, long weak parts and a fast train.
Clip numbersFourBands()
{
    Clip clip;
    clip.duration = 2.6137;
    for (int k = 0; k < 4; ++k)
    {
        Band band;
        band.centreFrequency = 45.7 * std::pow(1.83, k);
        band.lowFrequency = 0.8 * band.centreFrequency;
        band.highFrequency = 1.21 * band.centreFrequency;
        band.priority = (5 * k) % 4;
        for (int i = 0; i <= 40; ++i)
        {
            const double t = clip.duration * i / 40.0;
            const double level = 0.45 + 0.4 * std::sin(3.1 * t + 1.7 * k + 0.4 * k * t);
            band.amplitude.push_back({t, i > 24 && i < 32 ? 0.0011 : level * level});
        }
        if (k != 2)
            for (int i = 0; i < 9; ++i)
                band.pitch.push_back({0.29 * i, band.centreFrequency * (1.0 + 0.17 * std::sin(1.3 * i + k))});
        clip.bands.push_back(band);
    }
    for (int i = 0; i <= 33; ++i)
        clip.envelope.push_back({clip.duration * i / 33.0, i > 20 && i < 26 ? 0.0 : 0.6 + 0.38 * std::cos(0.7 * i)});
    clip.centroid = {{0.0, 80.0}, {1.0, 160.0}, {2.6, 110.0}};
    for (int i = 0; i < 9; ++i)
        clip.transients.push_back({0.31 + 0.0237 * i, 0.3 + 0.08 * ((3 * i) % 7), 0.07 + 0.1 * i});
    clip.transients.push_back({1.43, 0.0, 0.4});
    clip.transients.push_back({1.9031, 0.77, 0.13});
    clip.transients.push_back({2.3, 1.0, 0.61});
    clip.noise.push_back({70.0, 210.0, {{0.2, 0.0}, {0.5, 0.31}, {1.1, 0.002}, {1.7, 0.0}, {2.1, 0.24}}});
    clip.encoder = {{"method", std::string("a2vt")}};
    return clip;
}

/// Events alone: crowded, equal in time, weak and at the end.
Clip numbersEvents()
{
    Clip clip;
    clip.name = "7 taps";
    clip.duration = 0.8;
    clip.transients = {{0.0, 1.0, 0.0},  {0.0101, 0.5, 0.2},   {0.0312, 0.21, 1.0}, {0.3, 0.8, 0.4},
                       {0.3, 0.35, 0.9}, {0.3591, 0.002, 0.3}, {0.55, 0.66, 0.75},  {0.79, 0.91, 0.2}};
    return clip;
}

/// Longer than what players take as one event, with a frequency far outside of their range.
Clip numbersLong()
{
    Clip clip;
    clip.duration = 71.25;
    Band low;
    low.lowFrequency = 8.0;
    low.centreFrequency = 12.0;
    low.highFrequency = 20.0;
    Band high;
    high.lowFrequency = 400.0;
    high.centreFrequency = 730.0;
    high.highFrequency = 1200.0;
    for (int i = 0; i <= 57; ++i)
    {
        low.amplitude.push_back({1.25 * i, 0.3 + 0.29 * std::sin(0.9 * i)});
        high.amplitude.push_back({1.25 * i, i % 5 == 0 ? 0.0 : 0.2 + 0.19 * std::cos(1.7 * i)});
    }
    high.pitch = {{0.0, 400.0}, {30.0, 1200.0}, {60.0, 555.5}};
    clip.bands = {low, high, low};
    clip.transients = {{12.5, 0.5, 0.5}, {44.4, 0.9, 0.9}};
    return clip;
}

struct NumbersVariant
{
    std::string name;
    ExportParams params;
};

std::vector<NumbersVariant> numbersVariants()
{
    ExportParams sparse;
    sparse.amplitudePoints = 9.0;
    sparse.frequencyPoints = 3.0;
    sparse.quick = true;
    sparse.name = "Sparse - \"Zwölf\"";
    ExportParams profiled;
    profiled.profile = test::shippedProfile("quest-controller");
    profiled.split = true;
    profiled.quick = true;
    profiled.sampleRate = 3000;
    ExportParams usual;
    usual.quick = true;
    return {{"usual", usual}, {"sparse", sparse}, {"profile", profiled}};
}

void checkNumbers(const std::string& formatName, const std::string& clipName, const Clip& clip,
                  std::size_t variants = 3)
{
    const ClipFormat& format = *clipFormatNamed(formatName);
    std::vector<NumbersVariant> all = numbersVariants();
    all.resize(variants);
    for (const auto& [variant, params] : all)
    {
        const std::string name = "formats/" + formatName + ", " + clipName + ", " + variant;
        CAPTURE(name);
        const auto exported = format.write(clip, params);
        REQUIRE(exported);
        std::vector<double> numbers;
        for (const ExportedFile& file : exported->files)
            test::addNumbers(numbers,
                             format.isSamples && formatName != "c" ? test::bytesAsText(file.bytes) : file.bytes);
        checkPinned(name, numbers, 1e-9);
        checkPinned(name + ", losses", test::numbersOf(exported->losses), 1e-8);
        if (!format.isRead() || exported->files.empty())
            continue;
        for (std::size_t i = 0; i < exported->files.size(); ++i)
        {
            const auto read = format.read(exported->files[i].bytes);
            REQUIRE(read);
            checkPinned(name + ", read " + std::to_string(i), test::numbersOf(*read), 1e-8);
        }
    }
}
} // namespace

TEST_CASE("Files of one voice have the numbers that they had", "[formats]")
{
    for (const char* format : {"haptic", "ahap", "hjif", "haps", "android", "tact", "openxr-json", "csv"})
        checkNumbers(format, "one voice", numbersOneVoice());
}

TEST_CASE("Files of four bands have the numbers that they had", "[formats]")
{
    for (const char* format : {"haptic", "ahap", "hjif", "haps", "android", "tact", "openxr-json", "csv"})
        checkNumbers(format, "four bands", numbersFourBands());
}

TEST_CASE("Files of events alone have the numbers that they had", "[formats]")
{
    for (const char* format : {"haptic", "ahap", "hjif", "haps", "android", "tact", "openxr", "c"})
        checkNumbers(format, "events", numbersEvents());
}

TEST_CASE("Files of more than a minute have the numbers that they had", "[formats]")
{
    for (const char* format : {"haptic", "ahap", "haps", "android", "tact"})
        checkNumbers(format, "long", numbersLong());
}

TEST_CASE("Files of clips with next to nothing have the numbers that they had", "[formats]")
{
    Clip silent;
    silent.duration = 0.4;
    Clip tick;
    tick.transients = {{0.0, 0.5, 0.5}};
    for (const char* format : {"haptic", "ahap", "hjif", "haps", "android", "tact", "openxr-json", "csv", "wav8", "c"})
    {
        checkNumbers(format, "nothing", {}, 1);
        checkNumbers(format, "silence", silent, 1);
        checkNumbers(format, "a tick", tick, 1);
    }
}

TEST_CASE("All texts of one vibration effect have the numbers that they had", "[formats]")
{
    for (const char* format :
         {"android-xml", "android-kotlin", "android-java", "openxr", "wav8", "wav16", "raw8", "raw16", "c"})
        checkNumbers(format, "one voice", numbersOneVoice());
}

TEST_CASE("Bands that are not levelled have the numbers in HJIF that they had", "[formats]")
{
    Clip clip = numbersLong();
    clip.duration = 12.5;
    clip.bands[0].amplitude = {{0.5, 1.31}, {1.0, 0.0}, {2.0, 0.0}, {2.0, 0.7}, {2.0004, 0.2}, {3.0, 0.0}, {3.0, 0.4}};
    clip.bands[1].amplitude = {{0.0, 0.0}, {1.0, 0.45}, {1.0, 0.0}, {4.0, 0.0}, {5.0, 0.013}, {12.5, 0.0021}};
    clip.bands[1].pitch = {{0.25, 400.4}, {1.1, 1200.7}, {4.6, 555.5}};
    clip.bands[2].amplitude = {{0.0, 0.0}, {12.5, 0.0}};
    clip.transients = {{0.1, 0.4, 0.1}, {1.5, 0.8, 0.9}, {1.5004, 0.3, 0.5}, {6.0, 0.0, 0.5}, {7.7771, 0.6, 0.63}};
    clip.noise.push_back({70.0, 210.0, {{0.2, 0.0}, {0.5, 0.31}}});
    checkNumbers("hjif", "not levelled", clip);
    Clip many;
    many.duration = 0.5;
    for (int k = 0; k < 70; ++k)
        many.bands.push_back({20.0 + 10.0 * k, 22.5 + 10.0 * k, 25.0 + 10.0 * k, k, {{0.0, 0.01 + 0.001 * k}}, {}});
    checkNumbers("hjif", "70 bands", many, 1);
    many.transients = {{0.2, 1.0, 0.9}};
    checkNumbers("hjif", "70 bands and an event", many, 1);
    many.bands.resize(7);
    checkNumbers("hjif", "7 bands", many, 1);
}

TEST_CASE("Files for an actuator with a range of its own have the numbers that they had", "[formats]")
{
    ExportParams params;
    params.quick = true;
    for (const char* profile : {"lra-175", "erm-coin", "phone-taptic"})
    {
        params.profile = test::shippedProfile(profile);
        for (const char* format : {"haptic", "haps", "android", "tact", "openxr-json"})
        {
            const auto exported = clipFormatNamed(format)->write(numbersFourBands(), params);
            REQUIRE(exported);
            std::vector<double> numbers;
            test::addNumbers(numbers, exported->files.at(0).bytes);
            checkPinned(std::string("formats/") + format + " for " + profile, numbers, 1e-8);
        }
    }
}
