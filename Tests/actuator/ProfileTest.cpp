#include "io/ProfileFile.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Golden.h"
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
