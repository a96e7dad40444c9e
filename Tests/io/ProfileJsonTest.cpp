#include "io/ProfileFile.h"
#include "support/Catch.h"
#include "support/RandomProfile.h"
#include "support/TempFolder.h"

#include <nlohmann/json.hpp>

#include <functional>

using namespace pacini;

namespace
{
nlohmann::json smallest()
{
    return nlohmann::json::parse(R"({"format":"pacini.profile","version":1,"name":"x","technology":"lra",
                                     "resonance":{"frequency":175}})");
}

/// "where: message" of the error that the change to the smallest profile brings; "" when it is accepted.
std::string profileErrorAfter(const std::function<void(nlohmann::json&)>& change)
{
    auto document = smallest();
    change(document);
    const auto profile = readProfileJson(document.dump());
    return profile.ok() ? "" : profile.error().text();
}
} // namespace

TEST_CASE("Random profiles come back from their text as they were", "[io]")
{
    for (std::uint64_t seed = 0; seed < 2000; ++seed)
    {
        CAPTURE(seed);
        const Profile profile = test::randomProfile(seed);
        REQUIRE((validate(profile).ok() ? "" : validate(profile).error().text()) == "");
        const auto text = profileJson(profile);
        const auto back = readProfileJson(text);
        REQUIRE((back.ok() ? "" : back.error().text()) == "");
        REQUIRE(*back == profile);
        REQUIRE(profileJson(*back) == text);
    }
}

TEST_CASE("The text of a profile is read alike by another parser", "[io]")
{
    Profile profile;
    profile.name = "a \"b\"";
    profile.technology = Technology::erm;
    profile.polyphony = 2;
    profile.frequencyMapping = FrequencyMapping::fold;
    profile.drive.impedance = 8.5;
    profile.equalizer.pushBack({EqualizerType::lowShelf, 50.0, -3.0, 0.5, 2});
    profile.transient.shape = TransientShape::sine;
    profile.body = BodyParams{};
    profile.sources = {{"body", "assumed"}};
    const auto json = nlohmann::json::parse(profileJson(profile));
    CHECK(json["name"] == "a \"b\"");
    CHECK(json["technology"] == "erm");
    CHECK(json["polyphony"] == 2);
    CHECK(json["frequencyMapping"] == "fold");
    CHECK(json["drive"]["impedance"] == 8.5);
    CHECK_FALSE(json["drive"].contains("maxPower"));
    CHECK(json["equalizer"][0]["type"] == "lowShelf");
    CHECK(json["transient"]["shape"] == "sine");
    CHECK(json["body"]["skinDamping"] == 2.5);
    CHECK(json["sources"]["body"] == "assumed");
}

TEST_CASE("What a profile file leaves out has the defaults", "[io]")
{
    const auto profile = readProfileJson(smallest().dump());
    REQUIRE(profile.ok());
    Profile expected;
    expected.name = "x";
    expected.technology = Technology::lra;
    expected.resonance.frequency = 175.0;
    CHECK(*profile == expected);
    CHECK_FALSE(profile->body.has_value());

    auto document = smallest();
    document["body"] = nlohmann::json::object();
    document["unknown"] = {{"a", 1}};
    document["drive"] = {{"colour", "red"}};
    const auto withBody = readProfileJson(document.dump());
    REQUIRE(withBody.ok());
    CHECK(withBody->body == BodyParams{});
}

TEST_CASE("A missing entry is named", "[io]")
{
    using Json = nlohmann::json;
    for (const char* name : {"format", "version", "name", "technology", "resonance"})
        CHECK(profileErrorAfter([&](Json& j) { j.erase(name); }) == std::string(name) + ": is missing");
    CHECK(profileErrorAfter([](Json& j) { j["resonance"].erase("frequency"); }) == "resonance.frequency: is missing");
    for (const char* name : {"type", "frequency", "gain"})
        CHECK(profileErrorAfter(
                  [&](Json& j)
                  {
                      j["equalizer"] = {{{"type", "peak"}, {"frequency", 50}, {"gain", 1}}};
                      j["equalizer"][0].erase(name);
                  }) == "equalizer[0]." + std::string(name) + ": is missing");
    CHECK(profileErrorAfter([](Json& j) { j["equalizer"] = {{{"type", "highpass"}, {"frequency", 50}}}; }) == "");
}

TEST_CASE("A wrong entry of a profile fails at its place and says what is right", "[io]")
{
    using Json = nlohmann::json;
    CHECK(profileErrorAfter([](Json& j) { j["technology"] = "motor"; }) ==
          "technology: must be erm, lra, piezo, eap, vca or pcm, not 'motor'");
    CHECK(profileErrorAfter([](Json& j) { j["technology"] = 3; }) ==
          "technology: must be erm, lra, piezo, eap, vca or pcm");
    CHECK(profileErrorAfter([](Json& j) { j["frequencyMapping"] = "octave"; }) ==
          "frequencyMapping: must be clamp, rescale or fold, not 'octave'");
    CHECK(profileErrorAfter([](Json& j) { j["transient"]["shape"] = ""; }) ==
          "transient.shape: must be adaptive, square or sine, not ''");
    CHECK(profileErrorAfter([](Json& j) { j["resonance"]["q"] = 0; }) == "resonance.q: must be 0.01 to 1000");
    CHECK(profileErrorAfter([](Json& j) { j["resonance"]["q"] = "10"; }) == "resonance.q: must be a number");
    CHECK(profileErrorAfter([](Json& j) { j["resonance"]["q"] = true; }) == "resonance.q: must be a number");
    CHECK(profileErrorAfter(
              [](Json& j) {
                  j["range"] = {{"lowFrequency", 200}, {"highFrequency", 100}};
              }) == "range.highFrequency: must be above lowFrequency");
    CHECK(profileErrorAfter([](Json& j) { j["range"] = 5; }) == "range: must be an object in braces");
    CHECK(profileErrorAfter([](Json& j) { j["polyphony"] = 1.5; }) ==
          "polyphony: must be a whole number of voices, 0 to 64");
    CHECK(profileErrorAfter([](Json& j) { j["polyphony"] = 1e99; }) ==
          "polyphony: must be a whole number of voices, 0 to 64");
    CHECK(profileErrorAfter([](Json& j) { j["polyphony"] = 65; }) == "polyphony: must be 0 to 64 voices");
    CHECK(profileErrorAfter([](Json& j) { j["drive"]["impedance"] = false; }) == "drive.impedance: must be a number");
    CHECK(profileErrorAfter([](Json& j) { j["drive"]["maxPower"] = 1; }) ==
          "drive.maxPower: also needs drive.impedance and drive.maxVoltageRms");
    CHECK(profileErrorAfter([](Json& j) { j["body"]["movingMass"] = -1; }) ==
          "body.movingMass: must be 0.0000001 to 10 kg");
    CHECK(profileErrorAfter([](Json& j) { j["body"] = 3; }) == "body: must be an object in braces");
    CHECK(profileErrorAfter([](Json& j) { j["body"] = j["resonance"]["q"] = nullptr; }) == ""); // as if left out
    CHECK(profileErrorAfter([](Json& j) { j["sources"]["drive"] = 1; }) == "sources.drive: must be a text in quotes");
    CHECK(profileErrorAfter([](Json& j) { j["sources"]["drive"] = ""; }) == "sources.drive: must not be empty");
    CHECK(profileErrorAfter([](Json& j) { j["sources"]["a\nb"] = ""; }) == "sources.a?b: must not be empty");
    CHECK(profileErrorAfter([](Json& j) { j["sources"][""] = "x"; }) == "sources: has an entry without a path");
    CHECK(profileErrorAfter(
              [](Json& j)
              {
                  for (int i = 0; i < 257; ++i)
                      j["sources"]["path" + std::to_string(i)] = "x";
              }) == "sources: has more than 256 entries");
    CHECK(profileErrorAfter(
              [](Json& j)
              {
                  for (int i = 0; i < 1000; ++i)
                      j["equalizer"].push_back({{"type", "peak"}, {"frequency", 50}, {"gain", 1}});
              }) == "equalizer: has more than 16 sections");
    CHECK(profileErrorAfter([](Json& j) { j["version"] = 2; }) ==
          "version: was written by a newer version (2) of the format; this program reads version 1");
    // JSON has no NaN, so it fails as text.
    CHECK(readProfileJson(R"({"format":NaN})").error().where == "line 1, column 11");
    CHECK(readProfileJson(R"({"resonance":{"frequency":1e999}})").error().text() ==
          "resonance.frequency: is beyond the range of numbers");
}

TEST_CASE("A profile goes to a file and back; an invalid one leaves no file", "[io]")
{
    const test::TempFolder folder;
    const auto path = folder.path() / "p.json";
    Profile profile = test::randomProfile(1);
    const auto written = writeProfile(path, profile);
    REQUIRE(written.ok());
    CHECK(*written == std::filesystem::file_size(path));
    CHECK(*readProfile(path) == profile);
    CHECK(isProfile(path));

    profile.resonance.q = 0.0;
    CHECK(writeProfile(folder.path() / "bad.json", profile).error().where == "resonance.q");
    CHECK_FALSE(std::filesystem::exists(folder.path() / "bad.json"));
    CHECK_FALSE(isProfile(folder.path() / "bad.json"));
    CHECK_FALSE(isProfile(folder.path()));
}

TEST_CASE("A profile without a short name is called by its name, and a new name takes the short one away")
{
    auto read = readProfileJson(smallest().dump());
    REQUIRE(read.ok());
    CHECK(shortNameOf(*read) == "x");
    CHECK_FALSE(nlohmann::json::parse(profileJson(*read)).contains("shortName"));
    auto named = smallest();
    named["shortName"] = "short";
    read = readProfileJson(named.dump());
    REQUIRE(read.ok());
    CHECK(shortNameOf(*read) == "short");
    CHECK(nlohmann::json::parse(profileJson(*read))["shortName"] == "short");
    renameProfile(*read, "another");
    CHECK(shortNameOf(*read) == "another");
    CHECK(profileErrorAfter([](nlohmann::json& j) { j["shortName"] = 3; }) == "shortName: must be a text in quotes");
}
