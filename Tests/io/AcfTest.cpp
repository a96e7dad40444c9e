#include "io/AcfFile.h"
#include "io/AtomicFile.h"
#include "support/Catch.h"
#include "support/RandomProfile.h"
#include "support/TempFolder.h"

#include <nlohmann/json.hpp>

#include <functional>

using namespace pacini;

namespace
{
// Made for this test; numbers as of a hand controller.
constexpr auto sample = R"(// a comment
{
  metadata: { version: '2.0.0', device: 'A controller', date: '2026-01-02', author: "Somebody" },
  continuous: { gain: .8, emphasis_ducking: 0.5, frequency_min: 55, frequency_max: +200.0, },
  emphasis: {
    gain: 1, fade_out_percent: 0,
    frequency_min: { output_frequency: 55, duration_ms: 36.4, shape: 'sine' },
    frequency_max: { output_frequency: 165, duration_ms: 12.1, shape: 'square', },
  },
}
)";

nlohmann::json document()
{
    return {{"continuous", {{"frequency_min", 55}, {"frequency_max", 200}}},
            {"emphasis",
             {{"frequency_min", {{"output_frequency", 55}, {"duration_ms", 36.4}, {"shape", "sine"}}},
              {"frequency_max", {{"output_frequency", 165}, {"duration_ms", 12.1}, {"shape", "square"}}}}}};
}

std::string errorAfter(const std::function<void(nlohmann::json&)>& change)
{
    auto json = document();
    change(json);
    const auto acf = readAcf(json.dump());
    return acf.ok() ? "" : acf.error().text();
}

bool mentions(const std::vector<std::string>& warnings, const std::string& what)
{
    for (const std::string& warning : warnings)
        if (warning.find(what) != std::string::npos)
            return true;
    return false;
}
} // namespace

TEST_CASE("An ACF file is read entry by entry", "[io]")
{
    const auto acf = readAcf(sample);
    REQUIRE((acf.ok() ? "" : acf.error().text()) == "");
    CHECK(acf->device == "A controller");
    CHECK(acf->continuousGain == 0.8);
    CHECK(acf->emphasisDucking == 0.5);
    CHECK(acf->lowFrequency == 55.0);
    CHECK(acf->highFrequency == 200.0);
    CHECK(acf->ends[0] == AcfEmphasisEnd{55.0, 36.4, AcfShape::sine});
    CHECK(acf->ends[1] == AcfEmphasisEnd{165.0, 12.1, AcfShape::square});
    CHECK(*readAcf(acfText(*acf)) == *acf);
}

TEST_CASE("A wrong ACF file fails at its place", "[io]")
{
    using Json = nlohmann::json;
    CHECK(errorAfter([](Json&) {}) == "");
    for (const char* name : {"continuous", "emphasis"})
        CHECK(errorAfter([&](Json& j) { j.erase(name); }) == std::string(name) + ": is missing");
    CHECK(errorAfter([](Json& j) { j["continuous"].erase("frequency_max"); }) ==
          "continuous.frequency_max: is missing");
    CHECK(errorAfter([](Json& j) { j["emphasis"].erase("frequency_min"); }) == "emphasis.frequency_min: is missing");
    CHECK(errorAfter([](Json& j) { j["emphasis"]["frequency_max"].erase("shape"); }) ==
          "emphasis.frequency_max.shape: is missing");
    CHECK(errorAfter([](Json& j) { j["emphasis"]["frequency_max"]["shape"] = "round"; }) ==
          "emphasis.frequency_max.shape: must be saw, sine, square or triangle");
    CHECK(errorAfter([](Json& j) { j["emphasis"]["frequency_max"] = 5; }) ==
          "emphasis.frequency_max: must be an object in braces");
    CHECK(errorAfter([](Json& j) { j["emphasis"]["fade_out_percent"] = 101; }) ==
          "emphasis.fade_out_percent: must be 0 to 100");
    CHECK(errorAfter([](Json& j) { j["continuous"]["gain"] = "1"; }) == "continuous.gain: must be a number");
    CHECK(errorAfter([](Json& j) { j["continuous"]["frequency_min"] = 300; }) ==
          "continuous.frequency_max: must not be below frequency_min");
    CHECK(errorAfter([](Json& j) { j["metadata"]["device"] = 1; }) == "metadata.device: must be a text in quotes");
    CHECK(readAcf("[]").error().text() == "is not an ACF file, as it is not an object in braces");
    CHECK(readAcf("{a: 1, a: 2}").error().where == "a");
    CHECK(readAcf("{\n continuous: {gain: Infinity}}").error().where == "line 2, column 21");
}

TEST_CASE("A profile made of an ACF file is valid and has what the file knows", "[io]")
{
    const auto [profile, warnings] = profileOfAcf(*readAcf(sample));
    REQUIRE((validate(profile).ok() ? "" : validate(profile).error().text()) == "");
    CHECK(profile.name == "A controller");
    CHECK(profile.range.lowFrequency == 55.0);
    CHECK(profile.range.highFrequency == 200.0);
    CHECK(profile.drive.overdrive == Approx(1.25));
    CHECK(profile.transient.shape == TransientShape::adaptive);
    CHECK(profile.resonance.frequency == Approx(79.4).margin(0.05)); // by hand: sqrt(55 * 165) / 1.2
    CHECK(isAssumed(*sourceOf(profile.sources, "resonance.frequency")));
    for (const char* lost : {"metadata.author", "continuous.emphasis_ducking", "emphasis.frequency_min", "technology"})
        CHECK(mentions(warnings, lost));
    CHECK_FALSE(mentions(warnings, "fade_out_percent"));
}

TEST_CASE("An ACF file with one frequency is an actuator of amplitude only, and becomes one again", "[io]")
{
    Acf acf;
    acf.device = "Motor";
    acf.lowFrequency = acf.highFrequency = 60.0;
    const auto profile = profileOfAcf(acf).profile;
    REQUIRE(validate(profile).ok());
    CHECK(profile.polyphony == 0);
    CHECK(profile.resonance.frequency == 60.0);
    const auto back = acfOfProfile(profile).acf;
    CHECK(back.lowFrequency == 60.0);
    CHECK(back.highFrequency == 60.0);
}

TEST_CASE("An actuator of the lowest frequencies that an ACF file can tell has a resonance of 1 Hz", "[io]")
{
    Acf acf = *readAcf(sample);
    const auto resonanceOf = [&](double dull, double crisp)
    {
        acf.ends[0].frequency = dull;
        acf.ends[1].frequency = crisp;
        const auto profile = profileOfAcf(acf).profile;
        CHECK((validate(profile).ok() ? "" : validate(profile).error().text()) == "");
        return profile.resonance.frequency;
    };
    CHECK(resonanceOf(1.0, 1.0) == 1.0);
    CHECK(resonanceOf(1.0, 1.3) == 1.0);
    CHECK(resonanceOf(1.2, 1.2) == Approx(1.0));
    CHECK(resonanceOf(1.8, 1.8) == Approx(1.5));
}

TEST_CASE("From ACF to profile and back, what both know stays", "[io]")
{
    Random random(11);
    for (int round = 0; round < 500; ++round)
    {
        Acf acf;
        acf.device = "device " + std::to_string(round);
        acf.lowFrequency = random.uniform(1.0, 200.0);
        acf.highFrequency = random.uniform(acf.lowFrequency, 20000.0);
        acf.continuousGain = random.uniform(0.1, 1.0);
        acf.ends.fill({random.uniform(10.0, 2000.0), random.uniform(10.0, 50.0),
                       round % 2 == 0 ? AcfShape::sine : AcfShape::square});
        const auto first = profileOfAcf(acf).profile;
        REQUIRE((validate(first).ok() ? "" : validate(first).error().text()) == "");
        const auto text = acfText(acfOfProfile(first).acf);
        const auto back = readAcf(text);
        REQUIRE((back.ok() ? "" : back.error().text()) == "");
        CHECK(back->device == acf.device);
        CHECK(back->lowFrequency == Approx(acf.lowFrequency).epsilon(1e-5));
        CHECK(back->highFrequency == Approx(acf.highFrequency).epsilon(1e-5));
        CHECK(back->continuousGain == Approx(acf.continuousGain).epsilon(1e-5));
        CHECK(back->ends[0].frequency == Approx(acf.ends[0].frequency).epsilon(1e-5));
        CHECK(back->ends[0].duration == Approx(acf.ends[0].duration).epsilon(1e-5));
        CHECK(back->ends[1].shape == acf.ends[1].shape);
        // Once more changes nothing.
        const auto second = profileOfAcf(*back).profile;
        CHECK(second.resonance.frequency == Approx(first.resonance.frequency).epsilon(1e-4));
    }
}

TEST_CASE("Every valid profile makes a valid ACF file that names what it lost", "[io]")
{
    for (std::uint64_t seed = 0; seed < 500; ++seed)
    {
        CAPTURE(seed);
        const Profile profile = test::randomProfile(seed);
        const auto [acf, warnings] = acfOfProfile(profile);
        const auto back = readAcf(acfText(acf));
        REQUIRE((back.ok() ? "" : back.error().text()) == "");
        CHECK(mentions(warnings, "body") == profile.body.has_value());
        CHECK(mentions(warnings, "equalizer") == !profile.equalizer.empty());
        CHECK(mentions(warnings, "emphasis is made up") == (profile.transient.shape == TransientShape::adaptive));
    }
}

TEST_CASE("ACF files are told by their extension", "[io]")
{
    CHECK(hasAcfExtension("a/b.acf"));
    CHECK(hasAcfExtension("B.ACF"));
    CHECK_FALSE(hasAcfExtension("acf"));
    CHECK_FALSE(hasAcfExtension("a.json"));
    const test::TempFolder folder;
    CHECK(writeFileAtomically(folder.path() / "x.acf", acfText(Acf{})).ok());
    CHECK(readAcfFile(folder.path() / "x.acf").ok());
}
