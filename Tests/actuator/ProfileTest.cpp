#include "io/ProfileFile.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Numbers.h"
#include "support/Paths.h"

#include <pacini/actuator/Profile.h>
#include <pacini/actuator/ProfileMeasurement.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>

using namespace pacini;

TEST_CASE("The wristband profile's equaliser is that of the thesis' Table 3.2", "[actuator][golden]")
{
    const auto profile = readProfile(sourceFolder() / "profiles/l5-wristband.json");
    REQUIRE(profile.ok());
    const auto golden = test::golden("eq_table_3_2");
    int compared = 0;
    for (const auto& c : golden["cases"])
    {
        if (c["filters"] != nlohmann::json::array({2, 3, 4}))
            continue;
        const double fs = c["fs"].get<double>();
        const auto equalizer = designEqualizer(profile->equalizer, fs);
        for (std::size_t i = 0; i < golden["freqs"].size(); ++i, ++compared)
        {
            const double level =
                20.0 * std::log10(std::abs(equalizer.response(Hertz(golden["freqs"][i].get<double>()), fs)));
            CHECK(level == Approx(c["db"][i].get<double>()).margin(1e-4));
        }
    }
    CHECK(compared == 400);
}

TEST_CASE("An equaliser keeps the block contract", "[actuator]")
{
    test::checkBlockContract<Equalizer>(
        {{EqualizerType::peak, 68.0, -10.0, 1.6, 2}, {EqualizerType::highpass, 20.0, 0.0, 1.0, 5}});
}

TEST_CASE("A broken profile fails at the right place", "[actuator]")
{
    const auto where = [](const std::string& text)
    {
        const auto profile = readProfileJson(text);
        REQUIRE_FALSE(profile.ok());
        return profile.error().where;
    };
    const std::string head = R"({"format":"pacini.profile","version":1,"name":"x","technology":"pcm",)";
    CHECK(where("[]").empty());
    CHECK(where("{") == "line 1, column 2");
    CHECK(where(std::string(1000, '[')) == "line 1, column 33");
    CHECK(where(R"({"format":"other","version":1})") == "format");
    CHECK(where(R"({"format":"pacini.profile","version":2})") == "version");
    CHECK(where(R"({"format":"pacini.profile","version":1})") == "name");
    CHECK(where(head + R"("resonance":3})") == "resonance");
    CHECK(where(head + R"("resonance":{"frequency":"x"}})") == "resonance.frequency");
    CHECK(where(head + R"("resonance":{"frequency":-1}})") == "resonance.frequency");
    CHECK(
        where(
            head +
            R"("resonance":{"frequency":50},"equalizer":[{"type":"peak","frequency":5,"gain":1},{"type":"dip","frequency":5,"gain":1}]})") ==
        "equalizer[1].type");
    CHECK(where(head + R"("resonance":{"frequency":50},"equalizer":[{"type":"peak","frequency":5,"gain":99}]})") ==
          "equalizer[0].gain");
    CHECK(where(head + R"("resonance":{"frequency":50},"equalizer":[{"type":"highpass","frequency":5,"order":9}]})") ==
          "equalizer[0].order");
    CHECK(where(head + R"("resonance":{"frequency":50},"equalizer":[7]})") == "equalizer[0]");
}

TEST_CASE("A measurement in a profile has its numbers in their ranges, ends included", "[actuator]")
{
    ProfileMeasurement good;
    good.linearity = Linearity{20.0, 1000.0, 4.0, 10.0, 1.0, 1.0, 2.0, 100.0, {{20.0, 30.0, 5.0}}};
    good.points = {{20.0, 1.0, 0.5}, {1000.0, 2.0, 0.5}};
    good.distortionDrive = -6.0;
    REQUIRE(validate(good, "measurement").ok());
    using Set = std::function<void(ProfileMeasurement&, double)>;
    const auto check = [&](const std::string& where, double low, double high, const Set& set)
    {
        CAPTURE(where);
        for (const double inside : {low, high})
        {
            auto measurement = good;
            set(measurement, inside);
            CHECK(validate(measurement, "measurement").ok());
        }
        for (const double outside : {low - 1e-6 * std::abs(low) - 1e-9, high * (1.0 + 1e-6)})
        {
            auto measurement = good;
            set(measurement, outside);
            const auto valid = validate(measurement, "measurement");
            REQUIRE_FALSE(valid.ok());
            CHECK(valid.error().code == ErrorCode::invalidData);
            CHECK(valid.error().where == "measurement." + where);
        }
    };
    const auto linearity = [&](const std::string& name, double low, double high, double Linearity::*member)
    {
        check("linearity." + name, low, high, [=](ProfileMeasurement& m, double v) { (*m.linearity).*member = v; });
    };
    check("drive", -200.0, 40.0, [](ProfileMeasurement& m, double v) { m.drive = v; });
    check("distortionDrive", -200.0, 40.0, [](ProfileMeasurement& m, double v) { m.distortionDrive = v; });
    linearity("lowFrequency", 0.1, 200000.0, &Linearity::lowFrequency);
    linearity("highFrequency", 0.1, 200000.0, &Linearity::highFrequency);
    linearity("worstFrequency", 0.1, 200000.0, &Linearity::worstFrequency);
    linearity("tolerance", 0.0, 100.0, &Linearity::tolerance);
    linearity("level", -400.0, 400.0, &Linearity::level);
    linearity("meanDeviation", -400.0, 400.0, &Linearity::meanDeviation);
    linearity("standardDeviation", -400.0, 400.0, &Linearity::standardDeviation);
    linearity("worstDeviation", -400.0, 400.0, &Linearity::worstDeviation);
    check("linearity.outliers[0].lowFrequency", 0.1, 200000.0,
          [](ProfileMeasurement& m, double v) { m.linearity->outliers[0].lowFrequency = v; });
    check("linearity.outliers[0].highFrequency", 0.1, 200000.0,
          [](ProfileMeasurement& m, double v) { m.linearity->outliers[0].highFrequency = v; });
    check("linearity.outliers[0].deviation", -400.0, 400.0,
          [](ProfileMeasurement& m, double v) { m.linearity->outliers[0].deviation = v; });
    check("points[1].level", -400.0, 400.0, [](ProfileMeasurement& m, double v) { m.points[1].level = v; });
    check("points[1].linearised", -400.0, 400.0, [](ProfileMeasurement& m, double v) { m.points[1].linearised = v; });

    const auto where = [](const ProfileMeasurement& measurement)
    {
        const auto valid = validate(measurement, "measurement");
        return valid.ok() ? std::string() : valid.error().where;
    };
    auto other = good;
    for (const auto& [placements, place] :
         {std::pair(1, ""), std::pair(1000000, ""), std::pair(0, "measurement.fittings"),
          std::pair(1000001, "measurement.fittings")})
    {
        other.placements = placements;
        CHECK(where(other) == place);
    }
    CHECK(where(ProfileMeasurement{}).empty());
    other = good;
    other.points[0].level = other.points[1].level = 500.0;
    CHECK(where(other) == "measurement.points[0].level");
    other = good;
    other.points[0].frequency = 0.1;
    other.points[1].frequency = 200000.0;
    CHECK(where(other).empty());
    other.points[1].frequency = 0.1;
    CHECK(where(other) == "measurement.points[1].frequency");
    other = good;
    other.points.clear();
    for (std::size_t i = 0; i < ProfileMeasurement::maxPoints; ++i)
        other.points.push_back({1.0 + static_cast<double>(i), 0.0, std::nullopt});
    CHECK(where(other).empty());
    other.points.push_back({9000.0, 0.0, std::nullopt});
    CHECK(where(other) == "measurement.points");
    other = good;
    other.linearity->outliers.assign(ProfileMeasurement::maxOutliers, {20.0, 30.0, 5.0});
    CHECK(where(other).empty());
    other.linearity->outliers.push_back({20.0, 30.0, 5.0});
    CHECK(where(other) == "measurement.linearity.outliers");
    CHECK(validate(other, "measurement").error().code == ErrorCode::tooLarge);
}

namespace
{

/// A profile with everything in it, all of it valid.
Profile fullProfile()
{
    Profile profile;
    profile.range = {2.0, 19000.0, 60.0};
    profile.drive = {8.0, 1.0, 0.5, 1.0, 1e-3, 1e-3}; // ohm, V, W, s, m, m
    profile.body = BodyParams{};
    profile.measurement = ProfileMeasurement{};
    profile.equalizer = {{EqualizerType::peak, 100.0, 3.0, 1.0, 2}};
    return profile;
}

/// "where: message" of what is wrong, empty when nothing is.
std::string wrongWith(const Profile& profile)
{
    const auto valid = validate(profile);
    if (valid.ok())
        return {};
    CHECK(valid.error().code == ErrorCode::invalidData);
    return valid.error().text();
}

} // namespace

TEST_CASE("A profile has its numbers in their ranges, ends included, and says which range was left", "[actuator]")
{
    REQUIRE(wrongWith(fullProfile()).empty());
    const double nan = std::nan("");
    const auto check = [&](const std::string& where, double low, double high, const std::string& message,
                           const std::function<void(Profile&, double)>& set)
    {
        CAPTURE(where);
        const auto with = [&](double value)
        {
            Profile profile = fullProfile();
            set(profile, value);
            return wrongWith(profile);
        };
        CHECK(with(low).empty());
        CHECK(with(high).empty());
        const std::string text = where + ": must be " + message;
        CHECK(with(low - 1e-9 * std::abs(low) - (low == 0.0 ? 1e-12 : 0.0)) == text);
        CHECK(with(high * (1.0 + 1e-9)) == text);
        CHECK(with(nan) == text);
    };
    check("resonance.frequency", 1.0, 20000.0, "1 to 20000 Hz",
          [](Profile& p, double v) { p.resonance.frequency = v; });
    check("resonance.q", 0.01, 1000.0, "0.01 to 1000", [](Profile& p, double v) { p.resonance.q = v; });
    check("range.dynamicRange", 1.0, 140.0, "1 to 140 dB", [](Profile& p, double v) { p.range.dynamicRange = v; });
    check("response.riseTime", 0.0, 2.0, "0 to 2 s", [](Profile& p, double v) { p.response.riseTime = v; });
    check("response.fallTime", 0.0, 2.0, "0 to 2 s", [](Profile& p, double v) { p.response.fallTime = v; });
    check("drive.impedance", 0.1, 1e6, "0.1 to 1000000 ohm", [](Profile& p, double v) { p.drive.impedance = v; });
    check("drive.maxVoltageRms", 1e-3, 1e3, "0.001 to 1000 V", [](Profile& p, double v) { p.drive.maxVoltageRms = v; });
    check("drive.maxPower", 1e-6, 1e3, "0.000001 to 1000 W", [](Profile& p, double v) { p.drive.maxPower = v; });
    check("drive.thermalTime", 0.01, 1e4, "0.01 to 10000 s", [](Profile& p, double v) { p.drive.thermalTime = v; });
    check("drive.maxExcursion", 1e-7, 0.1, "0.0000001 to 0.1 m",
          [](Profile& p, double v) { p.drive.maxExcursion = v; });
    check("drive.excursion", 1e-9, 1.0, "0.000000001 to 1 m", [](Profile& p, double v) { p.drive.excursion = v; });
    check("drive.overdrive", 1.0, 10.0, "1 to 10", [](Profile& p, double v) { p.drive.overdrive = v; });
    check("transient.frequency", 1.0, 2000.0, "1 to 2000 Hz", [](Profile& p, double v) { p.transient.frequency = v; });
    check("transient.cycles", 0.1, 100.0, "0.1 to 100", [](Profile& p, double v) { p.transient.cycles = v; });
    check("body.force", 1e-6, 1e3, "0.000001 to 1000 N", [](Profile& p, double v) { p.body->force = v; });
    check("body.movingMass", 1e-7, 10.0, "0.0000001 to 10 kg", [](Profile& p, double v) { p.body->movingMass = v; });
    check("body.deviceMass", 1e-6, 100.0, "0.000001 to 100 kg", [](Profile& p, double v) { p.body->deviceMass = v; });
    check("body.jointStiffness", 1.0, 1e13, "1 to 1e13 N/m", [](Profile& p, double v) { p.body->jointStiffness = v; });
    check("body.jointDamping", 0.0, 1e9, "0 to 1e9 N s/m", [](Profile& p, double v) { p.body->jointDamping = v; });
    check("body.skinMass", 1e-7, 100.0, "0.0000001 to 100 kg", [](Profile& p, double v) { p.body->skinMass = v; });
    check("body.skinStiffness", 0.0, 1e9, "0 to 1e9 N/m", [](Profile& p, double v) { p.body->skinStiffness = v; });
    check("body.skinDamping", 0.0, 1e6, "0 to 1000000 N s/m", [](Profile& p, double v) { p.body->skinDamping = v; });

    const auto ranged = [](double low, double high)
    {
        Profile profile = fullProfile();
        profile.range.lowFrequency = low;
        profile.range.highFrequency = high;
        return wrongWith(profile);
    };
    CHECK(ranged(1.0, 20000.0).empty());
    CHECK(ranged(0.999, 20000.0) == "range.lowFrequency: must be 1 to 20000 Hz");
    CHECK(ranged(20000.0, 20001.0) == "range.highFrequency: must be 1 to 20000 Hz");
    CHECK(ranged(20001.0, 20002.0) == "range.lowFrequency: must be 1 to 20000 Hz");
    CHECK(ranged(1.0, 1.0) == "range.highFrequency: must be above lowFrequency");
    CHECK(ranged(1.0, 0.5) == "range.highFrequency: must be 1 to 20000 Hz");
    CHECK(ranged(100.0, 99.0) == "range.highFrequency: must be above lowFrequency");
    CHECK(ranged(100.0, 100.001).empty());

    const auto voices = [](int polyphony)
    {
        Profile profile = fullProfile();
        profile.polyphony = polyphony;
        return wrongWith(profile);
    };
    CHECK(voices(0).empty());
    CHECK(voices(64).empty());
    CHECK(voices(-1) == "polyphony: must be 0 to 64 voices");
    CHECK(voices(65) == "polyphony: must be 0 to 64 voices");
}

TEST_CASE("Limits of a profile need what they are reckoned from, and the first error is told", "[actuator]")
{
    const auto without = [](const std::function<void(Profile&)>& change)
    {
        Profile profile = fullProfile();
        change(profile);
        return wrongWith(profile);
    };
    const std::string power = "drive.maxPower: also needs drive.impedance and drive.maxVoltageRms";
    CHECK(without([](Profile& p) { p.drive.impedance.reset(); }) == power);
    CHECK(without([](Profile& p) { p.drive.maxVoltageRms.reset(); }) == power);
    CHECK(without([](Profile& p) { p.drive.maxVoltageRms.reset(), p.drive.maxPower.reset(); }).empty());
    CHECK(without([](Profile& p) { p.drive.excursion.reset(); }) == "drive.maxExcursion: also needs drive.excursion");
    CHECK(without([](Profile& p) { p.drive.maxExcursion.reset(); }).empty());
    CHECK(without([](Profile& p) { p.drive.thermalTime.reset(); }).empty());
    CHECK(without([](Profile& p) { p.body.reset(); }).empty());
    CHECK(without([](Profile& p) { p.measurement.reset(); }).empty());
    CHECK(without([](Profile& p) { p.equalizer[0].gain = 41.0; }) == "equalizer[0].gain: must be -40 to 40 dB");
    CHECK(without([](Profile& p) { p.measurement->placements = 0; }) == "measurement.fittings: must be 1 to 1000000");
    CHECK(without([](Profile& p) { p.sources = {{"drive", ""}}; }) == "sources.drive: must not be empty");
    // Of several the first in this order.
    const auto several = [&](int from)
    {
        return without(
            [=](Profile& p)
            {
                if (from < 1)
                    p.resonance.q = 0.0;
                if (from < 2)
                    p.equalizer[0].gain = 41.0;
                if (from < 3)
                    p.body->force = 0.0;
                if (from < 4)
                    p.measurement->drive = 100.0;
                p.sources = {{"", "x"}};
            });
    };
    CHECK(several(0) == "resonance.q: must be 0.01 to 1000");
    CHECK(several(1) == "equalizer[0].gain: must be -40 to 40 dB");
    CHECK(several(2) == "body.force: must be 0.000001 to 1000 N");
    CHECK(several(3) == "measurement.drive: must be -200 to 40 dB");
    CHECK(several(4) == "sources: has an entry without a path");
}

TEST_CASE("Sources of a profile are sorted, few enough and say something", "[actuator]")
{
    const auto text = [](const ProfileSources& sources)
    {
        const auto valid = validate(sources);
        return valid.ok() ? std::string() : valid.error().text();
    };
    CHECK(text({}).empty());
    CHECK(text({{"a", "x"}, {"b", "y"}, {"b.c", "z"}}).empty());
    CHECK(text({{"", "x"}}) == "sources: has an entry without a path");
    CHECK(text({{"a", "x"}, {"b", ""}}) == "sources.b: must not be empty");
    CHECK(text({{"b", "x"}, {"a", "y"}}) == "sources.a: is out of order or given twice");
    CHECK(text({{"a", "x"}, {"a", "y"}}) == "sources.a: is out of order or given twice");
    CHECK(text({{"a", "x"}, {"c", "y"}, {"b", "y"}}) == "sources.b: is out of order or given twice");
    ProfileSources many;
    for (int i = 0; i < 256; ++i)
        many.push_back({"p" + std::to_string(1000 + i), "x"});
    CHECK(text(many).empty());
    many.push_back({"p2", "x"});
    CHECK(text(many) == "sources: has more than 256 entries");
    CHECK(validate(many).error().code == ErrorCode::tooLarge);
    CHECK(validate(ProfileSources{{"", "x"}}).error().code == ErrorCode::invalidData);
}

TEST_CASE("The source of a number is the nearest entry around it", "[actuator]")
{
    const ProfileSources sources{{"drive", "a"},        {"drive.maxPower", "b"}, {"equalizer", "c"},
                                 {"equalizer[1]", "d"}, {"equalizer[1].q", "e"}, {"res", "f"}};
    const auto found = [&](std::string_view path)
    {
        const ProfileSource* source = sourceOf(sources, path);
        return source == nullptr ? std::string("none") : source->text;
    };
    CHECK(found("drive") == "a");
    CHECK(found("drive.impedance") == "a");
    CHECK(found("drive.maxPower") == "b");
    CHECK(found("drive.maxPowerOfAll") == "a");
    CHECK(found("driven") == "none");
    CHECK(found("equalizer[0].q") == "c");
    CHECK(found("equalizer[1].gain") == "d");
    CHECK(found("equalizer[1].q") == "e");
    CHECK(found("equalizer[10].q") == "c");
    CHECK(found("resonance.q") == "none");
    CHECK(found("") == "none");
    // In any order of the entries the longest counts.
    const ProfileSources turned{{"drive.maxPower", "b"}, {"drive", "a"}};
    CHECK(sourceOf(turned, "drive.maxPower")->text == "b");
    CHECK(isAssumed({"q", "assumed: as the others"}));
    CHECK(isAssumed({"q", "assumed"}));
    CHECK_FALSE(isAssumed({"q", "measured, not assumed"}));
    CHECK_FALSE(isAssumed({"q", "Assumed"}));
}

TEST_CASE("A new profile has the numbers that its fields state", "[actuator]")
{
    const Profile profile;
    CHECK(profile.name.empty());
    CHECK(profile.technology == Technology::pcm);
    CHECK(test::asNumbers(profile.resonance.frequency, profile.resonance.q, profile.range.lowFrequency,
                          profile.range.highFrequency,
                          profile.range.dynamicRange) == test::Numbers{67.0, 1.0, 20.0, 1000.0, 60.0});
    CHECK(profile.response == ActuatorResponse{0.0, 0.0});
    CHECK(profile.polyphony == 64);
    CHECK(profile.frequencyMapping == FrequencyMapping::clamp);
    CHECK(profile.drive.overdrive == 1.0);
    CHECK_FALSE((profile.drive.impedance || profile.drive.maxVoltageRms || profile.drive.maxPower ||
                 profile.drive.thermalTime || profile.drive.maxExcursion || profile.drive.excursion));
    CHECK(profile.transient.shape == TransientShape::adaptive);
    CHECK(profile.transient.frequency == 67.0);
    CHECK(profile.transient.cycles == 1.0);
    CHECK(BodyParams{} == BodyParams{1.0, 0.012, 0.040, 4.0e4, 5.0, 0.010, 800.0, 2.5});
    CHECK(validate(profile).ok());
    CHECK(ProfileMeasurement{}.placements == 1);
    CHECK(ProfileMeasurement{}.drive == 0.0);
    CHECK(Linearity{} == Linearity{0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0, {}});
    CHECK(Linearity{}.passed());
    CHECK_FALSE(Linearity{20.0, 1000.0, 4.0, 10.0, 1.0, 1.0, 2.0, 100.0, {{}}}.passed());
    CHECK(LinearityOutlier{} == LinearityOutlier{0.0, 0.0, 0.0});
    CHECK(MeasuredPoint{} == MeasuredPoint{0.0, 0.0, std::nullopt});
}

TEST_CASE("What is wrong in a measurement is told in words", "[actuator]")
{
    ProfileMeasurement good;
    good.linearity = Linearity{20.0, 1000.0, 4.0, 10.0, 1.0, 1.0, 2.0, 100.0, {{20.0, 30.0, 5.0}, {40.0, 50.0, 5.0}}};
    good.points = {{20.0, 1.0, 0.5}, {100.0, 2.0, std::nullopt}, {1000.0, 2.0, 0.5}};
    good.distortionDrive = -6.0;
    const auto text = [&](const std::function<void(ProfileMeasurement&)>& change)
    {
        auto measurement = good;
        change(measurement);
        const auto valid = validate(measurement, "m");
        return valid.ok() ? std::string() : valid.error().text();
    };
    CHECK(text([](auto&) {}).empty());
    CHECK(text([](auto& m) { m.placements = 0; }) == "m.fittings: must be 1 to 1000000");
    CHECK(text([](auto& m) { m.drive = 41.0; }) == "m.drive: must be -200 to 40 dB");
    CHECK(text([](auto& m) { m.distortionDrive = 41.0; }) == "m.distortionDrive: must be -200 to 40 dB");
    CHECK(text([](auto& m) { m.linearity->tolerance = -1.0; }) == "m.linearity.tolerance: must be 0 to 100 dB");
    CHECK(text([](auto& m) { m.linearity->level = 401.0; }) == "m.linearity.level: must be -400 to 400 dB");
    CHECK(text([](auto& m) { m.linearity->worstFrequency = 0.0; }) ==
          "m.linearity.worstFrequency: must be 0.1 to 200000 Hz");
    CHECK(text([](auto& m) { m.linearity->outliers[1].deviation = 401.0; }) ==
          "m.linearity.outliers[1].deviation: must be -400 to 400 dB");
    CHECK(text(
              [](auto& m) {
                  m.linearity->outliers.resize(257, {20.0, 30.0, 5.0});
              }) == "m.linearity.outliers: has more than 256 outliers");
    CHECK(text([](auto& m) { m.points.resize(4097); }) == "m.points: has more than 4096 points");
    CHECK(text([](auto& m) { m.points[2].linearised = -401.0; }) == "m.points[2].linearised: must be -400 to 400 dB");
    CHECK(text([](auto& m) { m.points[1].frequency = 20.0; }) == "m.points[1].frequency: must be above the one before");
    CHECK(text([](auto& m) { m.points[1].frequency = 1000.0; }) ==
          "m.points[2].frequency: must be above the one before");
    CHECK(text([](auto& m) { m.points[1].frequency = 1.0, m.points[1].level = 500.0; }) ==
          "m.points[1].frequency: must be above the one before");
    // The first of two errors is told, wherever they are.
    CHECK(text([](auto& m) { m.drive = 41.0, m.distortionDrive = 41.0; }) == "m.drive: must be -200 to 40 dB");
    CHECK(text([](auto& m) { m.drive = 41.0, m.linearity->outliers[0].deviation = 500.0; }) ==
          "m.drive: must be -200 to 40 dB");
    CHECK(text([](auto& m) { m.drive = 41.0, m.linearity->outliers.resize(300); }) == "m.drive: must be -200 to 40 dB");
    CHECK(text([](auto& m) { m.drive = 41.0, m.points.resize(5000); }) == "m.drive: must be -200 to 40 dB");
    CHECK(text([](auto& m) { m.drive = 41.0, m.points[1].frequency = 1.0; }) == "m.drive: must be -200 to 40 dB");
    CHECK(text([](auto& m) { m.points[0].frequency = 1e6; }) == "m.points[0].frequency: must be 0.1 to 200000 Hz");
    CHECK(text([](auto& m) { m.linearity->outliers[0].deviation = m.linearity->outliers[1].deviation = 500.0; }) ==
          "m.linearity.outliers[0].deviation: must be -400 to 400 dB");
    // Negative frequencies are not above anything; the range is told first.
    CHECK(text([](auto& m) { m.points[1].frequency = -1.0; }) == "m.points[1].frequency: must be 0.1 to 200000 Hz");
}
