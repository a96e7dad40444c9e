#include "evaluate/SyntheticSignal.h"
#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Pinned.h"

#include <pacini/evaluate/SignalMetrics.h>
#include <pacini/foundation/Random.h>

#include <algorithm>
#include <cmath>
#include <string>
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
    const auto sorted = [](std::vector<double> times)
    {
        std::sort(times.begin(), times.end());
        return times;
    };
    const auto error = median(matchEvents(sorted(onsets), sorted(detections), 0.025 + 1e-12));
    REQUIRE(error.has_value() == !expected["error"].is_null());
    if (error)
        CHECK(*error * 1000.0 == Approx(expected["error"].get<double>()).margin(1e-6));
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

TEST_CASE("The measures of unlike pairs of sounds are what they were", "[evaluate]")
{
    // What may be nothing but rounding is compared beside 1.
    const auto pin = [](const std::string& name, const std::vector<double>& x, const std::vector<double>& y)
    {
        SignalAnalyzer analyzer(x.size());
        const auto m = compare(featuresOf(analyzer, x, 8000), featuresOf(analyzer, y, 8000));
        checkPinned("evaluate/measures, " + name,
                    {m.silentReference ? 1.0 : 0.0, m.candidateRms, m.envelopeSnr, m.envelopeSnrPerBand, m.wideSnr,
                     m.logSpectralDistance, m.centroidError, 1.0 + m.centroidBias, m.lag ? *m.lag : -1000.0,
                     m.outOfBand.value_or(-1000.0), 1.0 + m.gain.value_or(-1000.0)},
                    1e-3);
    };
    const auto x = knocks(8000.0);
    auto noisy = x;
    auto half = x;
    auto coarse = x;
    auto late = x;
    Random random(19);
    for (std::size_t n = 0; n < x.size(); ++n)
    {
        noisy[n] += random.uniform(-0.2, 0.2);
        half[n] = n < 4000 ? 0.0 : 3.0 * x[n];
        coarse[n] = 0.1 * std::round(10.0 * x[n]);
    }
    std::rotate(late.begin(), late.end() - 77, late.end());
    pin("noisy", x, noisy);
    pin("clean beside noisy", noisy, x);
    pin("half missing", x, half);
    pin("half present", half, x);
    pin("coarse", x, coarse);
    pin("late", x, late);
    pin("silent", x, std::vector<double>(x.size()));
    for (const std::size_t length : {50u, 900u, 1500u, 1700u})
    {
        const std::vector<double> a(x.begin() + 800, x.begin() + 800 + static_cast<std::ptrdiff_t>(length));
        const std::vector<double> b(noisy.begin() + 810, noisy.begin() + 810 + static_cast<std::ptrdiff_t>(length));
        pin(std::to_string(length) + " samples", a, b);
    }
}

TEST_CASE("Only the in-band level, its fault and what is not finite are measured beside a silent reference",
          "[evaluate]")
{
    SignalFeatures reference;
    reference.rms = 1e-9;
    SignalFeatures candidate;
    candidate.rms = 0.25;
    candidate.scale = 4.0;
    candidate.nonFinite = 7;
    candidate.outOfBand = 3.0;
    const auto m = compare(reference, candidate);
    CHECK(m.silentReference);
    CHECK(m.candidateRms == 1.0);
    CHECK(m.nonFinite == 7);
    CHECK_FALSE(m.outOfBand.has_value());
    CHECK_FALSE(m.lag.has_value());
    CHECK(SignalMetrics{} == SignalMetrics{false, 0.0, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, {}, {}, {}});
    CHECK(SignalFeatures{}.scale == 1.0);
    CHECK(SignalFeatures{}.rms == 0.0);
    CHECK(SignalFeatures{}.nonFinite == 0);
}

TEST_CASE("Sums over the samples of a band lead to its best gain and its signal-to-noise ratio", "[evaluate]")
{
    const std::vector<float> r{1.0f, 2.0f, 3.0f};
    const std::vector<float> c{0.5f, 1.5f, 0.25f};
    auto sums = detail::EnvelopeSums::of(r, c, 2.0);
    CHECK(sums.reference == 28.0);
    CHECK(sums.candidate == 2.0 * 2.5625);
    CHECK(sums.cross == 2.0 * 4.25);
    CHECK(sums.bestGain() == Approx(4.25 / 2.5625));
    CHECK(sums.snr(0.5) == Approx(10.0 * std::log10(14.0 / (0.75 * 0.75 + 1.25 * 1.25 + 2.875 * 2.875))));
    CHECK(sums.snr(0.0) == Approx(0.0).margin(1e-12));
    sums += {1.0, 2.0, 3.0};
    CHECK(sums.reference == 29.0);
    CHECK(sums.candidate == 7.125);
    CHECK(sums.cross == 11.5);
    const detail::EnvelopeSums nothing;
    CHECK(nothing.bestGain() == 0.0);
    CHECK(nothing.snr(1.0) == 0.0);
    CHECK(detail::EnvelopeSums{1.0, 1.0, 1.0}.snr(1.0) == Approx(3000.0));
}

TEST_CASE("Sums over coarse samples of a smooth curve are those over the 1 kHz grid", "[evaluate]")
{
    // Steep at both ends, where simple sums would be wrong most.
    const auto curve = [](double t)
    {
        return 1.0 + 0.5 * std::sin(0.021 * t + 0.9);
    };
    const auto other = [](double t)
    {
        return 0.7 + 0.2 * std::cos(0.033 * t);
    };
    for (const std::size_t spacing : {4u, 8u, 16u, 20u})
        for (const std::size_t length : {801u, 1600u, 1607u, 1608u, 1609u})
        {
            const std::size_t grid = (length + 7) / 8;
            BandEnvelope r{spacing, {}};
            BandEnvelope c{spacing, {}};
            for (std::size_t at = 0; at < length; at += spacing)
            {
                r.values.push_back(static_cast<float>(curve(static_cast<double>(at) / 8.0)));
                c.values.push_back(static_cast<float>(other(static_cast<double>(at) / 8.0)));
            }
            detail::EnvelopeSums exact;
            for (std::size_t i = 0; i < grid; ++i)
            {
                const auto t = static_cast<double>(i);
                exact += {curve(t) * curve(t), other(t) * other(t), curve(t) * other(t)};
            }
            const auto found = detail::sumBand(r, c, grid);
            CAPTURE(spacing, length);
            CHECK(found.reference == Approx(exact.reference).epsilon(3e-4));
            CHECK(found.candidate == Approx(exact.candidate).epsilon(3e-4));
            CHECK(found.cross == Approx(exact.cross).epsilon(3e-4));
            checkPinned("evaluate/band sums of " + std::to_string(length) + " by " + std::to_string(spacing),
                        {found.reference, found.candidate, found.cross});
        }
    const BandEnvelope single{20, {2.0f}};
    CHECK(detail::sumBand(single, single, 1).reference == Approx(4.0 * 2.5));
    const BandEnvelope pair{20, {2.0f, 2.0f}};
    CHECK(detail::sumBand(pair, pair, 4).reference == Approx(16.0).epsilon(0.01));
}

TEST_CASE("Bands below -40 dB of the strongest have no say, and each counts from -10 to 60 dB", "[evaluate]")
{
    SignalFeatures a;
    a.wide.assign(10, 1.0f);
    for (auto& band : a.bands)
        band = {8, std::vector<float>(10, 0.009f)};
    a.bands[2].values.assign(10, 1.0f);
    a.bands[5].values.assign(10, 0.02f);
    auto b = a;
    SignalMetrics m;
    detail::compareBands(a, b, m);
    CHECK(m.envelopeSnr == 60.0);
    CHECK(m.envelopeSnrPerBand == 60.0);
    b.bands[5].values.assign(10, 0.2f); // ten times too strong: 10 log10(1 / 81) is below -10 dB
    detail::compareBands(a, b, m);
    CHECK(m.envelopeSnrPerBand > 0.5 * (10.0 - 10.0));
    CHECK(m.envelopeSnrPerBand < 0.5 * (60.0 - 10.0));
    b.bands[2].values.assign(10, 1.0f);
    b.bands[5].values.assign(10, 0.04f);
    b.bands[7].values.assign(10, 0.5f); // of no weight beside its reference, but it moves the common gain
    detail::compareBands(a, b, m);
    const double gain =
        (1.0 + 0.02 * 0.04 + 0.009 * 0.5 + 9.0 * 0.009 * 0.009) / (1.0 + 0.0016 + 0.25 + 9.0 * 0.009 * 0.009);
    const double one = -20.0 * std::log10(1.0 - gain);
    const double two = -20.0 * std::log10(std::abs(1.0 - 2.0 * gain));
    CHECK(m.envelopeSnrPerBand == Approx(0.5 * (one + two)).epsilon(1e-3));
}

TEST_CASE("The distance of spectra is the RMS over cells within 40 dB, on average over frames", "[evaluate]")
{
    SignalFeatures a, b;
    for (std::size_t k = 0; k < a.thirdOctaves.size(); ++k)
    {
        a.thirdOctaves[k] = {0.0f, 0.0f, 0.0f};
        b.thirdOctaves[k] = {0.0f, 0.0f, 0.0f};
    }
    CHECK(detail::logSpectralDistance(a, b, 1.0) == 0.0);
    a.thirdOctaves[3] = {1.0f, 0.01f, 0.0f};
    b.thirdOctaves[3] = {0.1f, 0.01f, 0.0f};
    CHECK(detail::logSpectralDistance(a, b, 1.0) == Approx(5.0));
    CHECK(detail::logSpectralDistance(a, b, 10.0) == Approx(5.0));
    a.thirdOctaves[9] = {0.5f, 0.0f, 0.00009f};
    b.thirdOctaves[9] = {0.5f, 0.0f, 0.00009f};
    CHECK(detail::logSpectralDistance(a, b, 1.0) == Approx(std::sqrt(50.0) / 2.0));
    b.thirdOctaves[9][2] = 0.1f; // nothing of it in the reference: the distance from the floor
    CHECK(detail::logSpectralDistance(a, b, 1.0) == Approx((std::sqrt(50.0) + 30.0) / 3.0));
    b.thirdOctaves[9][2] = 0.0f;
    a.thirdOctaves[9][2] = 0.02f;
    CHECK(detail::logSpectralDistance(a, b, 1.0) == Approx((std::sqrt(50.0) + 10.0 * std::log10(200.0)) / 3.0));
}

TEST_CASE("Centroids are compared where the reference sounds, and a silent candidate is 100 % too low", "[evaluate]")
{
    SignalFeatures a, b;
    a.framePower = {1.0f, 1.0f, 1.0f, 0.00009f, 0.5f};
    a.centroid = {100.0f, 200.0f, 100.0f, 50.0f, 400.0f};
    b.framePower = {1.0f, 1.0f, 1.0f, 1.0f, 1.0f};
    b.centroid = {110.0f, 190.0f, 130.0f, 500.0f, 320.0f};
    SignalMetrics m;
    detail::compareCentroids(a, b, 1.0, m);
    CHECK(m.centroidBias == Approx(2.5).epsilon(1e-5)); // of -20, -5, 10 and 30
    CHECK(m.centroidError == Approx(15.0).epsilon(1e-5));
    b.framePower[0] = b.framePower[1] = b.framePower[2] = 0.9e-6f;
    detail::compareCentroids(a, b, 1.0, m);
    CHECK(m.centroidBias == -100.0);
    CHECK(m.centroidError == 100.0);
    detail::compareCentroids(a, b, 2.0, m);
    CHECK(m.centroidBias == Approx(2.5).epsilon(1e-5));
    a.framePower = {0.0f};
    a.centroid = {0.0f};
    detail::compareCentroids(a, b, 2.0, m);
    CHECK(m.centroidError == 0.0);
    CHECK(m.centroidBias == 0.0);
}

TEST_CASE("The lag of envelopes is found within 100 ms and where there are more than 200", "[evaluate]")
{
    const auto bump = [](std::size_t size, double at)
    {
        std::vector<float> x(size);
        for (std::size_t i = 0; i < size; ++i)
            x[i] = static_cast<float>(std::exp(-std::pow((static_cast<double>(i) - at) / 6.0, 2.0)));
        return x;
    };
    for (const int lag : {-100, -99, -1, 0, 37, 100})
        CHECK(detail::envelopeLag(bump(5000, 2040.0), bump(5000, 2040.0 + lag)) == lag);
    CHECK(detail::envelopeLag(bump(201, 100.0), bump(201, 130.0)) == 30);
    CHECK_FALSE(detail::envelopeLag(bump(200, 100.0), bump(200, 130.0)).has_value());
    CHECK_FALSE(detail::envelopeLag(bump(300, 100.0), std::vector<float>(300, 0.5f)).has_value());
    // An offset of either does not matter.
    auto raised = bump(900, 300.0);
    for (float& v : raised)
        v += 3.0f;
    CHECK(detail::envelopeLag(raised, bump(900, 280.0)) == -20);
    CHECK(detail::envelopeLag(bump(900, 280.0), raised) == 20);
}

TEST_CASE("A candidate without level has no gain, and nothing of it is heard", "[evaluate]")
{
    const auto x = knocks(8000.0, 0.5);
    SignalAnalyzer analyzer(x.size());
    const auto reference = featuresOf(analyzer, x, 8000);
    const auto m = compare(reference, featuresOf(analyzer, std::vector<double>(x.size()), 8000));
    CHECK_FALSE(m.gain.has_value());
    CHECK_FALSE(m.lag.has_value());
    CHECK_FALSE(m.outOfBand.has_value());
    CHECK(m.candidateRms == 0.0);
    CHECK(m.envelopeSnr == 0.0);
    CHECK(m.wideSnr == 0.0);
    CHECK(m.centroidBias == -100.0);
    auto faint = x;
    for (double& v : faint)
        v *= 0.9e-12 / (reference.rms * reference.scale);
    CHECK_FALSE(compare(reference, featuresOf(analyzer, faint, 8000)).gain.has_value());
    for (double& v : faint)
        v *= 1.2;
    CHECK(compare(reference, featuresOf(analyzer, faint, 8000)).gain.has_value());
}

TEST_CASE("Signals at other rates are resampled to 8 kHz before they are judged", "[evaluate]")
{
    CHECK(signalAnalysisLength(44100, 44100) == 8000);
    CHECK(signalAnalysisLength(8000, 8000) == 8000);
    CHECK(signalAnalysisLength(1, 48000) == 1);
    const auto x = knocks(16000.0, 0.4);
    SignalAnalyzer analyzer(3200);
    const auto resampled = resample(std::span<const double>(x), 16000, 8000).value();
    CHECK(featuresOf(analyzer, x, 16000).wide == featuresOf(analyzer, resampled, 8000).wide);
    for (const int rate : {1999, 768001})
        CHECK(signalFeatures(analyzer, std::span<const double>(x), rate).error().code == ErrorCode::invalidArgument);
    CHECK(signalFeatures(analyzer, std::span<const double>(x), 2000).ok());
    CHECK(signalFeatures(analyzer, std::span<const double>(x), 768000).ok());
}
