#include "io/AudioReader.h"
#include "io/ShippedProfiles.h"
#include "support/Catch.h"
#include "support/Paths.h"
#include "support/Render.h"
#include "support/ShippedProfile.h"

#include <pacini/actuator/FeltModel.h>
#include <pacini/analysis/Encoder.h>
#include <pacini/evaluate/Hts.h>
#include <pacini/evaluate/HtsAnalyzer.h>

#include <filesystem>
#include <map>
#include <span>
#include <string>

using namespace pacini;

namespace
{
std::vector<float> felt(const Clip& clip, const Profile& profile, bool adapt)
{
    CompileParams params;
    params.adapt = adapt;
    return test::felt(test::drive(clip, profile, params), profile);
}
} // namespace

TEST_CASE("Adapting beats playing it as it is by 5 points of HTS on every narrow actuator", "[adaptation]")
{
    struct Sound
    {
        Clip clip;
        HtsFeatures features;
    };
    HtsAnalyzer analyzer;
    std::vector<Sound> sounds;
    for (const auto& entry : std::filesystem::directory_iterator(sourceFolder() / "Resources/demo"))
    {
        if (entry.path().extension() != ".flac")
            continue;
        auto reader = AudioReader::open(entry.path(), {});
        REQUIRE(reader.ok());
        REQUIRE(reader->channels() == 1);
        std::vector<float> samples(static_cast<std::size_t>(5 * reader->sampleRate()));
        const auto frames = reader->read(samples);
        REQUIRE(frames.ok());
        samples.resize(*frames);
        EncoderParams bands; // HTS hears nothing of what lies above the range of touch
        bands.audible = 0.0;
        Encoder encoder{bands};
        encoder.start(reader->sampleRate(), 1);
        encoder.push(samples);
        const auto features =
            htsSourceFeatures(analyzer, std::span<const float>(samples), static_cast<int>(reader->sampleRate()));
        REQUIRE(features.ok());
        sounds.push_back({encoder.finish(), *features});
    }
    REQUIRE(sounds.size() >= 6);
    for (const char* name : {"lra-175", "lra-235-narrow", "erm-coin", "phone-taptic", "joycon-hd-rumble"})
    {
        const Profile profile = test::shippedProfile(name);
        double gained = 0.0;
        for (const Sound& sound : sounds)
            for (const bool adapt : {false, true})
            {
                const auto y = felt(sound.clip, profile, adapt);
                const auto features = htsCandidateFeatures(analyzer, std::span<const float>(y), 48000);
                REQUIRE(features.ok());
                gained += (adapt ? 1.0 : -1.0) * compare(sound.features, *features, HtsMode::translation).score;
            }
        CAPTURE(name, gained / static_cast<double>(sounds.size()));
        CHECK(gained >= 5.0 * static_cast<double>(sounds.size()));
    }
}
