#include "support/Catch.h"
#include "support/Numbers.h"

#include <pacini/linearize/MeasuredProfile.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
/// What a profile says of where `path` comes from; empty when it says nothing.
std::string sourceOf(const Profile& profile, const std::string& path)
{
    for (const ProfileSource& source : profile.sources)
        if (source.path == path)
            return source.text;
    return {};
}

MeasurementFindings someFindings()
{
    MeasurementFindings findings;
    findings.features.resonance.frequency = 71.0;
    findings.features.resonance.q = 3.5;
    findings.features.felt = {25.0, 900.0};
    findings.times = ActuatorResponse{0.011, 0.022};
    findings.profileDrive = -3.0;
    findings.outliers = {1, 4};
    return findings;
}
} // namespace

TEST_CASE("A measurement takes the place of what the profile said, with its sources", "[linearize]")
{
    Profile profile;
    profile.body = BodyParams{};
    profile.equalizer.pushBack({EqualizerType::peak, 100.0, 3.0, 1.0});
    for (const char* path : {"response", "response.riseTime", "body", "body.force", "resonance.q", "range", "equalizer",
                             "range.lowFrequency", "range.highFrequency", "drive.maxPower", "range.levels"})
        profile.sources.push_back({path, "assumed"});
    const FrequencyResponse response{{20.0, 60.0, 300.0}, {-10.0, 4.0, 1.5}};
    setMeasurement(profile, response, someFindings(), 7, -6.5, true);

    CHECK(test::asNumbers(profile.resonance.frequency, profile.resonance.q, profile.range.lowFrequency,
                          profile.range.highFrequency, profile.response.riseTime,
                          profile.response.fallTime) == test::Numbers{71.0, 3.5, 25.0, 900.0, 0.011, 0.022});
    CHECK_FALSE(profile.body.has_value());
    CHECK(profile.equalizer.empty());
    REQUIRE(profile.measurement.has_value());
    CHECK(profile.measurement->placements == 5);
    CHECK(profile.measurement->drive == -6.5);
    CHECK(profile.measurement->distortionDrive == -3.0);
    REQUIRE(profile.measurement->points.size() == response.size());
    for (std::size_t i = 0; i < response.size(); ++i)
    {
        CHECK(profile.measurement->points[i].frequency == response.frequency[i]);
        CHECK(profile.measurement->points[i].level == response.level[i]);
        CHECK_FALSE(profile.measurement->points[i].linearised.has_value());
    }

    std::vector<std::string> paths;
    for (const ProfileSource& source : profile.sources)
        paths.push_back(source.path);
    CHECK(paths == std::vector<std::string>{"drive.maxPower", "measurement", "range.highFrequency", "range.levels",
                                            "range.lowFrequency", "resonance", "response"});
    CHECK(hasMeasuredAcceleration(profile));
    CHECK(sourceOf(profile, "drive.maxPower") == "assumed");
    CHECK(sourceOf(profile, "range.levels") == "assumed");
    CHECK(sourceOf(profile, "response") == "measured with swept sines at -6.5 dB, 5 placements");
    CHECK(sourceOf(profile, "resonance") == "measured with swept sines at -6.5 dB, 5 placements, as it is worn");

    setMeasurement(profile, response, MeasurementFindings{}, 1, 0.0, false);
    CHECK_FALSE(hasMeasuredAcceleration(profile));
    CHECK(isAssumed(*pacini::sourceOf(profile.sources, "measurement")));
    CHECK(sourceOf(profile, "range.lowFrequency") ==
          "measured with swept sines at 0 dB, 1 placement, 20 dB below the strongest frequency");
    CHECK(sourceOf(profile, "response").empty()); // its times were not measured this time
    CHECK(profile.response.riseTime == 0.011);
    CHECK(profile.range.lowFrequency == 25.0); // nor was anything felt
}

TEST_CASE("What was measured beyond what a profile may hold is moved to its ends", "[linearize]")
{
    MeasurementFindings findings = someFindings();
    findings.features.resonance = {0.3, 500.0};
    findings.features.felt = {0.2, 40000.0};
    findings.times = ActuatorResponse{3.0, 1.9};
    Profile profile;
    setMeasurement(profile, {{20.0}, {0.0}}, findings, 3, 0.0, true);
    CHECK(test::asNumbers(profile.resonance.frequency, profile.resonance.q, profile.range.lowFrequency,
                          profile.range.highFrequency, profile.response.riseTime,
                          profile.response.fallTime) == test::Numbers{1.0, 100.0, 1.0, 20000.0, 2.0, 1.9});
    findings.features.resonance = {30000.0, 0.001};
    findings.times = ActuatorResponse{1.9, 3.0};
    setMeasurement(profile, {{20.0}, {0.0}}, findings, 3, 0.0, true);
    CHECK(profile.resonance.frequency == 20000.0);
    CHECK(profile.resonance.q == 0.01);
    CHECK(profile.response.fallTime == 2.0);
}

TEST_CASE("An equalizer undoes what was verified with another one, and a proof has a level at each point in its range",
          "[linearize]")
{
    Profile profile;
    setMeasurement(profile, {{20.0, 100.0, 400.0, 2000.0}, {1.0, 2.0, 3.0, 4.0}}, someFindings(), 2, 0.0, true);
    Linearity linearity;
    linearity.worstDeviation = 1.25;
    const FrequencyResponse after{{100.0, 400.0, 1600.0}, {6.0, 8.0, 10.0}};
    setVerification(profile, after, linearity);
    REQUIRE(profile.measurement->linearity.has_value());
    CHECK(profile.measurement->linearity->worstDeviation == 1.25);
    const auto& points = profile.measurement->points;
    REQUIRE(points.size() == 4);
    CHECK_FALSE(points[0].linearised.has_value());
    CHECK(points[1].linearised.value() == Approx(6.0));
    CHECK(points[2].linearised.value() == Approx(8.0));
    CHECK_FALSE(points[3].linearised.has_value());

    EqualizerFit fit;
    fit.sections.pushBack({EqualizerType::peak, 100.0, 3.0, 1.0});
    fit.rms = 0.256;
    fit.max = 1.504;
    profile.sources.push_back({"equalizer.gain", "assumed"});
    setEqualizer(profile, fit, "the measurement", 44100.0);
    CHECK(profile.equalizer == fit.sections);
    CHECK_FALSE(profile.measurement->linearity.has_value());
    for (const MeasuredPoint& point : profile.measurement->points)
        CHECK_FALSE(point.linearised.has_value());
    CHECK(sourceOf(profile, "equalizer") ==
          "fitted to the measurement at 44100 Hz: 0.26 dB RMS, 1.50 dB at most from its mean");
    CHECK(sourceOf(profile, "equalizer.gain").empty());
    CHECK(profile.sources.front().path == "equalizer");

    Profile bare;
    setEqualizer(bare, fit, "a table", 48000.0);
    CHECK_FALSE(bare.measurement.has_value());
    setVerification(bare, after, linearity);
    REQUIRE(bare.measurement.has_value());
    CHECK(bare.measurement->points.empty());
}
