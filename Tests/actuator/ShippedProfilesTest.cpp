#include "io/ShippedProfiles.h"

#include "io/ProfileFile.h"
#include "support/Catch.h"
#include "support/Paths.h"

#include <pacini/actuator/Profile.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

using namespace pacini;

namespace
{

template <typename Check>
void forEachProfile(Check check)
{
    int count = 0;
    for (const ShippedProfile& shipped : shippedProfiles(sourceFolder()))
    {
        CAPTURE(shipped.name);
        const auto profile = readProfile(shipped.path);
        REQUIRE((profile.ok() ? "" : profile.error().text()) == "");
        check(shipped, *profile);
        ++count;
    }
    CHECK(count >= 20);
}

void numbersIn(const nlohmann::json& value, const std::string& path, std::vector<std::string>& paths)
{
    if (value.is_number() && path != "version")
        paths.push_back(path);
    else if (value.is_structured())
        for (const auto& [key, inner] : value.items())
            numbersIn(inner, value.is_array() ? path + "[" + key + "]" : path.empty() ? key : path + "." + key, paths);
}

/// Complex acceleration of the jig per newton on the moving mass: two masses, a spring and a damper between them.
std::complex<double> freeDeviceAcceleration(double frequency, double device, double moving, double stiffness,
                                            double damping)
{
    const std::complex<double> s(0.0, 2.0 * std::numbers::pi * frequency);
    const auto link = stiffness + s * damping;
    // F = (m s^2 + link) x - link y and -F = (M s^2 + link) y - link x, by Cramer's rule.
    const auto a = moving * s * s + link;
    const auto b = device * s * s + link;
    const auto y = (-a + link) / (a * b - link * link);
    return y * s * s;
}
} // namespace

TEST_CASE("Every number of every shipped profile has a source", "[actuator]")
{
    forEachProfile(
        [](const ShippedProfile& shipped, const Profile& profile)
        {
            std::ifstream file(shipped.path);
            std::vector<std::string> paths;
            numbersIn(nlohmann::json::parse(file), "", paths);
            CHECK(paths.size() >= 5);
            for (const std::string& path : paths)
            {
                CAPTURE(path);
                CHECK(sourceOf(profile.sources, path) != nullptr);
            }
            for (const ProfileSource& source : profile.sources)
            {
                CAPTURE(source.path);
                const auto names = [&](const std::string& path)
                {
                    return sourceOf({source}, path) != nullptr;
                };
                CHECK(std::any_of(paths.begin(), paths.end(), names) == (source.path != "frequencyMapping"));
                CHECK(source.text.size() >= 15);
            }
        });
}

TEST_CASE("Shipped profiles are written as the program writes them", "[actuator]")
{
    forEachProfile(
        [](const ShippedProfile& shipped, const Profile& profile)
        {
            std::ifstream file(shipped.path, std::ios::binary);
            const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
            CHECK(profileJson(profile) == text);
        });
}

TEST_CASE("Shipped actuators have a body whose force and mass give the stated excursion", "[actuator]")
{
    forEachProfile(
        [](const ShippedProfile&, const Profile& profile)
        {
            CHECK(profile.body.has_value() == (profile.technology != Technology::pcm));
            if (!profile.body)
                return;
            const double w0 = 2.0 * std::numbers::pi * profile.resonance.frequency;
            const double excursion = profile.body->force / (profile.body->movingMass * w0 * w0);
            REQUIRE(profile.drive.excursion.has_value());
            CHECK(*profile.drive.excursion == Approx(excursion).epsilon(0.2));
            // A shipped limit must not stop the rated drive at resonance.
            if (profile.drive.maxExcursion)
                CHECK(*profile.drive.maxExcursion >= excursion * profile.resonance.q);
        });
}

TEST_CASE("Shipped resonant actuators rise and fall as their frequency and Q say", "[actuator]")
{
    forEachProfile(
        [](const ShippedProfile&, const Profile& profile)
        {
            if (profile.technology == Technology::erm || profile.technology == Technology::pcm)
                return;
            const double expected =
                std::log(10.0) * profile.resonance.q / (std::numbers::pi * profile.resonance.frequency);
            CHECK(profile.response.riseTime > expected / 2.0);
            CHECK(profile.response.riseTime < expected * 2.0);
            CHECK(profile.response.fallTime > expected / 2.0);
            CHECK(profile.response.fallTime < expected * 2.0);
            CHECK(profile.range.lowFrequency <= profile.resonance.frequency);
            CHECK(profile.range.highFrequency >= profile.resonance.frequency);
        });
}

TEST_CASE("The jig's profile has the plateau and the peak that the thesis measured", "[actuator]")
{
    const auto profile = readProfile(sourceFolder() / "profiles" / "l5-test-jig.json");
    REQUIRE(profile.ok());
    REQUIRE(profile->body.has_value());
    const BodyParams& body = *profile->body;
    const double w0 = 2.0 * std::numbers::pi * profile->resonance.frequency;
    const double stiffness = body.movingMass * w0 * w0;
    const double damping = body.movingMass * w0 / profile->resonance.q;
    const auto accelerationRms = [&](double frequency)
    {
        constexpr double earth = 9.80665;
        return body.force / std::numbers::sqrt2 / earth *
               std::abs(freeDeviceAcceleration(frequency, body.deviceMass + body.skinMass, body.movingMass, stiffness,
                                               damping));
    };
    CHECK(accelerationRms(1000.0) == Approx(0.8).epsilon(0.01));
    double peak = 0.0;
    double at = 0.0;
    for (double f = 20.0; f < 200.0; f += 0.05)
        if (accelerationRms(f) > peak)
        {
            peak = accelerationRms(f);
            at = f;
        }
    CHECK(peak == Approx(3.2).epsilon(0.01));
    CHECK(at == Approx(67.0).epsilon(0.01));
}

TEST_CASE("Voices of the shipped profiles are those of their technology", "[actuator]")
{
    forEachProfile(
        [](const ShippedProfile& shipped, const Profile& profile)
        {
            if (profile.technology == Technology::erm)
                CHECK(profile.polyphony == 0);
            if (shipped.name.starts_with("lra-") || shipped.name.starts_with("phone-lra-"))
                CHECK(profile.polyphony == 1);
            if (shipped.name == "joycon-hd-rumble")
                CHECK(profile.polyphony == 2);
        });
}

TEST_CASE("A source counts for its path and all below, the nearest first", "[actuator]")
{
    const ProfileSources sources{{"drive", "a"}, {"drive.impedance", "assumed b"}, {"equalizer[1]", "c"}};
    REQUIRE(validate(sources).ok());
    CHECK(sourceOf(sources, "drive.impedance")->text == "assumed b");
    CHECK(isAssumed(*sourceOf(sources, "drive.impedance")));
    CHECK(sourceOf(sources, "drive.maxPower")->text == "a");
    CHECK_FALSE(isAssumed(*sourceOf(sources, "drive.maxPower")));
    CHECK(sourceOf(sources, "driver") == nullptr);
    CHECK(sourceOf(sources, "equalizer[1].q")->text == "c");
    CHECK(sourceOf(sources, "equalizer[10].q") == nullptr);
    CHECK(sourceOf(sources, "") == nullptr);
    CHECK(validate(ProfileSources{{"b", "x"}, {"a", "x"}}).error().where == "sources.a");
    CHECK(validate(ProfileSources{{"a", "x"}, {"a", "x"}}).error().where == "sources.a");
}

TEST_CASE("Every shipped profile has a short name of its own, which fits a box")
{
    std::vector<std::string> names;
    forEachProfile(
        [&](const ShippedProfile&, const Profile& profile)
        {
            CHECK(shortNameOf(profile).size() <= 21);
            names.push_back(shortNameOf(profile));
        });
    std::sort(names.begin(), names.end());
    CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
}
