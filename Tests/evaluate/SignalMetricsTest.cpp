#include "evaluate/SyntheticSignal.h"
#include "support/Catch.h"
#include "support/Golden.h"

#include <pacini/evaluate/SignalMetrics.h>

#include <cmath>
#include <vector>

using namespace pacini;

namespace
{
SignalFeatures featuresOf(SignalAnalyzer& analyzer, const std::vector<double>& x, int rate)
{
    return signalFeatures(analyzer, std::span<const double>(x), rate).value();
}

/// Within 0.01 or 1 %.
void checkMeasure(double found, const nlohmann::json& expected)
{
    CHECK(found == Approx(expected.get<double>()).epsilon(0.01).margin(0.01));
}

template <typename Found>
void checkOptional(const std::optional<Found>& found, const nlohmann::json& expected)
{
    REQUIRE(found.has_value() == !expected.is_null());
    if (found)
        checkMeasure(static_cast<double>(*found), expected);
}

void checkScore(const nlohmann::json& c, const std::vector<double>& detections, const nlohmann::json& expected)
{
    const auto onsets = c["onsets"].get<std::vector<double>>();
    const auto ambiguous = c.value("ambiguous", std::vector<double>());
    const auto wide = scoreEvents(onsets, detections, 0.025, ambiguous);
    CHECK(wide.f == Approx(expected["f25"].get<double>()).margin(1e-9));
    CHECK(wide.truePositives == expected["hits"].get<std::size_t>());
    CHECK(wide.falsePositives == expected["spurious"].get<std::size_t>());
    CHECK(wide.falseNegatives == expected["missed"].get<std::size_t>());
    REQUIRE(wide.medianError.has_value() == !expected["error"].is_null());
    if (wide.medianError)
        CHECK(*wide.medianError * 1000.0 == Approx(expected["error"].get<double>()).margin(1e-6));
    const auto narrow = scoreEvents(onsets, detections, 0.010, ambiguous);
    CHECK(narrow.f == Approx(expected["f10"].get<double>()).margin(1e-9));
    CHECK(narrow.truePositives == expected["hits10"].get<std::size_t>());
}

/// A second of decaying tones with a noise floor, by rate.
std::vector<double> knocks(double rate, double seconds = 1.0)
{
    return test::syntheticSignal(
        {{"rate", rate},
         {"frames", static_cast<std::size_t>(rate * seconds)},
         {"partials", {{0.1, 70.0, 0.8, 20.0}, {0.35, 180.0, 0.6, 30.0}, {0.7, 420.0, 0.9, 25.0}}},
         {"noise", {17, 0.001}}});
}
} // namespace

TEST_CASE("Judge measures and detections equal the whole-file reference", "[evaluate]")
{
    const auto file = test::golden("judge");
    for (const auto& c : file["cases"])
    {
        CAPTURE(c["name"].get<std::string>());
        const auto& expected = c["expected"];
        const auto x = test::syntheticSignal(c["reference"]);
        const auto y = test::syntheticSignal(c["candidate"]);
        const int rate = c["reference"]["rate"];
        SignalAnalyzer analyzer(signalAnalysisLength(x.size(), rate));
        const auto candidate = featuresOf(analyzer, y, c["candidate"]["rate"]);
        const auto found = compare(featuresOf(analyzer, x, rate), candidate);
        CHECK(found.silentReference == expected["silentReference"].get<bool>());
        CHECK(found.candidateRms == Approx(expected["candidateRms"].get<double>()).epsilon(1e-4).margin(1e-12));
        CHECK(found.nonFinite == expected["nonFinite"].get<std::size_t>());
        CHECK(candidate.onsets.size() == expected["detections"].size());
        for (std::size_t i = 0; i < std::min(candidate.onsets.size(), expected["detections"].size()); ++i)
            CHECK(candidate.onsets[i] == Approx(expected["detections"][i].get<double>()).margin(1e-9));
        if (c.contains("onsets"))
        {
            const auto& scores = expected["scores"];
            if (scores.contains("detected"))
                checkScore(c, candidate.onsets, scores["detected"]);
            if (scores.contains("stated"))
                checkScore(c, c["events"].get<std::vector<double>>(), scores["stated"]);
        }
        if (found.silentReference)
            continue;
        checkMeasure(found.envelopeSnr, expected["envelopeSnr"]);
        checkMeasure(found.envelopeSnrPerBand, expected["envelopeSnrPerBand"]);
        checkMeasure(found.wideSnr, expected["wideSnr"]);
        checkMeasure(found.logSpectralDistance, expected["logSpectralDistance"]);
        checkMeasure(found.centroidError, expected["centroidError"]);
        checkMeasure(found.centroidBias, expected["centroidBias"]);
        checkOptional(found.lag, expected["lag"]);
        checkOptional(found.outOfBand, expected["outOfBand"]);
        checkOptional(found.gain, expected["gain"]);
    }
}

TEST_CASE("A signal judged against itself is perfect, whatever its gain and polarity", "[evaluate]")
{
    const auto x = knocks(44100.0);
    SignalAnalyzer analyzer(signalAnalysisLength(x.size(), 44100));
    const auto reference = featuresOf(analyzer, x, 44100);
    for (const double gain : {1.0, -1.0, 0.3, -1e-5, 1e7})
    {
        CAPTURE(gain);
        auto y = x;
        for (double& v : y)
            v *= gain;
        const auto m = compare(reference, featuresOf(analyzer, y, 44100));
        CHECK(m.envelopeSnr == 60.0);
        CHECK(m.envelopeSnrPerBand == 60.0);
        CHECK(m.wideSnr == 60.0);
        CHECK(m.logSpectralDistance < 1e-3);
        CHECK(m.centroidError < 1e-3);
        CHECK(m.lag == 0);
        REQUIRE(m.gain.has_value());
        CHECK(*m.gain == Approx(-20.0 * std::log10(std::abs(gain))).margin(1e-4));
    }
}

TEST_CASE("A late candidate is reported with its lag and not aligned", "[evaluate]")
{
    const auto x = knocks(8000.0);
    std::vector<double> late(x.size());
    std::copy(x.begin(), x.end() - 400, late.begin() + 400);
    SignalAnalyzer analyzer(x.size());
    const auto m = compare(featuresOf(analyzer, x, 8000), featuresOf(analyzer, late, 8000));
    CHECK(m.lag == 50);
    CHECK(m.wideSnr < 10.0);
}

TEST_CASE("Features of a sound do not depend on where segments of a long file cut it", "[evaluate]")
{
    const auto x = knocks(8000.0);
    const std::size_t length = 80000; // three segments
    SignalAnalyzer analyzer(length);
    std::vector<double> early(length), crossing(length);
    const std::size_t shift = 32960 - 4000 - 8000; // the middle of the sound lies on the first cut
    std::copy(x.begin(), x.end(), early.begin() + 8000);
    std::copy(x.begin(), x.end(), crossing.begin() + static_cast<std::ptrdiff_t>(8000 + shift));
    const auto a = featuresOf(analyzer, early, 8000);
    const auto b = featuresOf(analyzer, crossing, 8000);
    REQUIRE(a.onsets.size() == 3);
    REQUIRE(b.onsets.size() == 3);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(b.onsets[i] - a.onsets[i] == Approx(shift / 8000.0).margin(1e-9));
    CHECK(b.rms == Approx(a.rms).epsilon(1e-5));
    const float strongest = *std::max_element(a.wide.begin(), a.wide.end());
    for (std::size_t t = 900; t < 2200; ++t)
        CHECK(std::abs(b.wide[t + shift / 8] - a.wide[t]) < 1e-3f * strongest);
    for (std::size_t t = 95; t < 215; ++t)
        CHECK(b.framePower[t + shift / 80] == Approx(a.framePower[t]).epsilon(1e-2).margin(1e-6));
}

TEST_CASE("The judge refuses rates that it cannot resample", "[evaluate]")
{
    SignalAnalyzer analyzer(100);
    const std::vector<float> x(100);
    const auto result = signalFeatures(analyzer, std::span<const float>(x), 100);
    REQUIRE_FALSE(result.ok());
    CHECK(result.error().code == ErrorCode::invalidArgument);
}
