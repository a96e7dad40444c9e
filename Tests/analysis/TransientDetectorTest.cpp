#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Measure.h"
#include "support/Numbers.h"
#include "support/Pinned.h"

#include <pacini/analysis/TransientDetector.h>

#include <cfenv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{

/// The relative score with times for up to 80 events per second.
TransientDetectorParams relativeTransientParams() noexcept
{
    TransientDetectorParams params;
    params.score.reading = TransientScoreReading::relative;
    params.score.fastAttack = Seconds(0.0005);
    params.score.slowAttack = Seconds(0.020);
    params.score.hold = Seconds(0.005);
    params.score.release = Seconds(0.010);
    params.threshold = 2.0;
    params.minimumWindow = Seconds(0.002);
    params.minimumDistance = Seconds(0.008);
    return params;
}

TransientDetectorParams paramsOf(const nlohmann::json& p)
{
    const auto ms = [&p](const char* name)
    {
        return Seconds(p.value(name, 0.0) / 1000.0);
    };
    TransientDetectorParams params;
    params.score.reading =
        p.value("relative", false) ? TransientScoreReading::relative : TransientScoreReading::absolute;
    params.threshold = p["threshold"];
    params.score.floor = p.value("eps", params.score.floor);
    params.score.fastAttack = ms("attack_fast_ms");
    params.score.slowAttack = ms("attack_slow_ms");
    params.score.hold = ms("hold_ms");
    params.score.release = ms("release_ms");
    params.score.decay = p["kind"] == "99" ? DecayDefinition::percent99 : DecayDefinition::percent63;
    params.minimumWindow = ms("min_win_ms");
    params.minimumDistance = ms("min_dist_ms");
    params.minimumAmplitude = p["min_amp"];
    return params;
}

std::vector<float> inputOf(const nlohmann::json& data, const nlohmann::json& entry)
{
    return data["inputs"][entry["signal"].get<std::string>()].get<std::vector<float>>();
}

void checkEvents(const std::vector<DetectedTransient>& found, const nlohmann::json& expected, double tolerance)
{
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
    {
        CHECK(found[i].frame == expected[i][0].get<std::size_t>());
        CHECK(std::abs(found[i].amplitude - expected[i][1].get<double>()) <= tolerance);
    }
}

/// Clicks of decaying amplitude, `rate` per second.
std::vector<float> clicks(std::size_t frames, double fs, double rate)
{
    std::vector<float> x(frames, 0.0f);
    const auto period = static_cast<std::size_t>(fs / rate);
    for (std::size_t start = period / 2; start < frames; start += period)
        for (std::size_t i = 0; i < period && start + i < frames; ++i)
        {
            const double t = static_cast<double>(i) / fs;
            x[start + i] =
                static_cast<float>(0.9 * std::exp(-t / 0.002) * std::cos(2.0 * std::numbers::pi * 300.0 * t));
        }
    return x;
}

} // namespace

TEST_CASE("Detected transients equal the reference exactly", "[analysis][golden]")
{
    const auto data = golden("transients");
    for (const auto& entry : data["cases"])
    {
        CAPTURE(entry["signal"].get<std::string>(), entry["params"].dump());
        const auto params = paramsOf(entry["params"]);
        checkEvents(detectTransients(inputOf(data, entry), data["fs"], params), entry["events"], data["tol"]);
    }
}

TEST_CASE("Without the masks the detector gives every candidate of the reference", "[analysis][golden]")
{
    const auto data = golden("transients");
    for (const auto& entry : data["cases"])
    {
        CAPTURE(entry["signal"].get<std::string>(), entry["params"].dump());
        auto params = paramsOf(entry["params"]);
        params.minimumAmplitude = 0.0;
        params.minimumDistance = 0_s;
        checkEvents(detectTransients(inputOf(data, entry), data["fs"], params), entry["candidates"], data["tol"]);
    }
}

TEST_CASE("The transient score and its windows equal the reference", "[analysis][golden]")
{
    const auto data = golden("transients");
    for (const auto& entry : data["cases"])
    {
        const auto params = paramsOf(entry["params"]);
        auto score = inputOf(data, entry);
        TransientScore block;
        block.setParams(params.score);
        block.prepare({data["fs"], score.size()});
        block.process(score, score);
        CHECK(*std::max_element(score.begin(), score.end()) ==
              Approx(entry["score_max"].get<double>()).epsilon(1e-6).margin(1e-9));
        std::vector<std::vector<std::size_t>> windows;
        for (std::size_t i = 0; i < score.size(); ++i)
        {
            const auto isAbove = [&](std::size_t n)
            {
                return static_cast<double>(score[n]) >= params.threshold;
            };
            const bool above = isAbove(i);
            if (above && (i == 0 || !isAbove(i - 1)))
                windows.push_back({i, score.size()});
            if (!above && i > 0 && isAbove(i - 1))
                windows.back()[1] = i;
        }
        CHECK(windows == entry["windows"].get<std::vector<std::vector<std::size_t>>>());
    }
}

TEST_CASE("Chunks of any size give the same transients, and each one soon", "[analysis]")
{
    const auto data = golden("transients");
    for (const auto& entry : data["cases"])
        for (const std::size_t chunk : {1u, 7u, 64u, 511u})
        {
            const auto params = paramsOf(entry["params"]);
            const double fs = data["fs"];
            const auto x = inputOf(data, entry);
            TransientDetector detector;
            detector.setParams(params);
            detector.prepare({fs, chunk});
            std::vector<DetectedTransient> events;
            const auto keep = [&events](const DetectedTransient& event)
            {
                events.push_back(event);
            };
            for (int pass = 0; pass < 2; ++pass)
            {
                events.clear();
                for (std::size_t i = 0; i < x.size(); i += chunk)
                    detector.process(std::span(x).subspan(i, std::min(chunk, x.size() - i)), keep);
                detector.finish(keep);
                detector.reset();
                CHECK(events == detectTransients(x, fs, params));
            }
        }
}

TEST_CASE("A transient leaves the detector once its window and the minimum distance have passed", "[analysis]")
{
    const double fs = 8000.0;
    auto x = clicks(8000, fs, 1.0); // one click at 0.5 s
    TransientDetector detector;
    detector.setParams(relativeTransientParams());
    detector.prepare({fs, 1});
    std::size_t left = 0;
    std::size_t frame = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        detector.process(std::span(x).subspan(i, 1),
                         [&](const DetectedTransient& event)
                         {
                             left = i;
                             frame = event.frame;
                         });
    CHECK(frame == 4000);
    CHECK(left > frame);
    CHECK(left - frame < static_cast<std::size_t>(0.030 * fs));
}

TEST_CASE("The relative score follows fast trains that the absolute one is blind to", "[analysis]")
{
    const double fs = 8000.0;
    for (const double rate : {5.0, 20.0, 50.0, 80.0})
    {
        const auto x = clicks(16000, fs, rate);
        const auto relative = detectTransients(x, fs, relativeTransientParams());
        CAPTURE(rate);
        CHECK(std::abs(static_cast<double>(relative.size()) - 2.0 * rate) <= 1.0);
    }
    CHECK(detectTransients(clicks(16000, fs, 80.0), fs, {}).size() < 80);
}

TEST_CASE("Louder copies change the events of the absolute score, not those of the relative one", "[analysis]")
{
    const double fs = 8000.0;
    const auto x = clicks(16000, fs, 4.0);
    auto quiet = x;
    for (float& v : quiet)
        v *= 0.25f;
    auto params = relativeTransientParams();
    CHECK(detectTransients(x, fs, params).size() == detectTransients(quiet, fs, params).size());
    CHECK(detectTransients(x, fs, {}).size() > detectTransients(quiet, fs, {}).size());
}

TEST_CASE("The minimum window and distance count frames exactly", "[analysis]")
{
    const double fs = 1000.0;
    TransientDetectorParams params; // with instant followers every click is a window of one frame
    params.score.fastAttack = params.score.hold = params.score.release = 0_s;
    params.score.slowAttack = 10_s;
    params.minimumDistance = 0_s;
    const auto clicksAt = [](std::size_t second, float level)
    {
        std::vector<float> x(200, 0.0f);
        x[100] = 0.5f;
        x[second] = level;
        return x;
    };
    const DetectedTransient first{100, 0.5};

    params.minimumWindow = 5_ms;
    const DetectedTransient larger{104, 0.75};
    CHECK(detectTransients(clicksAt(104, 0.75f), fs, params) == std::vector{larger, larger});
    CHECK(detectTransients(clicksAt(105, 0.75f), fs, params) == std::vector{first, DetectedTransient{105, 0.75}});

    params.minimumWindow = 0_s;
    params.minimumDistance = 5_ms;
    CHECK(detectTransients(clicksAt(104, 0.4f), fs, params) == std::vector{first});
    CHECK(detectTransients(clicksAt(104, 0.75f), fs, params) == std::vector{larger});
    CHECK(detectTransients(clicksAt(105, 0.75f), fs, params) == std::vector{first, DetectedTransient{105, 0.75}});
}

TEST_CASE("Transients of nothing are none, and hostile input does no harm", "[analysis]")
{
    for (const double fs : {8000.0, 44100.0, 384000.0, 768000.0})
        for (const auto& params : {TransientDetectorParams{}, relativeTransientParams()})
        {
            CHECK(detectTransients({}, fs, params).empty());
            CHECK(detectTransients(std::vector<float>(2000, 0.0f), fs, params).empty());
            CHECK(detectTransients(std::vector<float>(1, 0.0f), fs, params).empty());
            CHECK(detectTransients(std::vector<float>(1, 1.0f), fs, params).size() <= 1);
            auto bad = noise(4000, 2);
            bad[5] = std::numeric_limits<float>::quiet_NaN();
            bad[6] = std::numeric_limits<float>::infinity();
            bad[7] = std::numeric_limits<float>::max();
            for (const auto& event : detectTransients(bad, fs, params))
                CHECK(std::isfinite(event.amplitude));
        }

    // A threshold of 0 keeps a window open to the end; one that flickers opens many.
    TransientDetectorParams open;
    open.threshold = 0.0;
    CHECK(detectTransients(noise(5000, 1), 8000.0, open).size() == 1);
    TransientDetectorParams flicker = relativeTransientParams();
    flicker.score.hold = flicker.score.release = flicker.score.fastAttack = 0_s;
    flicker.threshold = 1e-3;
    flicker.minimumWindow = 1_s;
    flicker.minimumDistance = 0_s;
    CHECK(!detectTransients(noise(20000, 1), 8000.0, flicker).empty());
}

TEST_CASE("TransientScore keeps the contract of blocks", "[analysis][contract]")
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto relative = relativeTransientParams().score;
    auto bad = relative;
    bad.floor = nan;
    bad.hold = bad.slowAttack = Seconds(nan);
    checkBlockContract<TransientScore>({}, {.bound = 1.0});
    checkBlockContract<TransientScore>(relative, {.bound = 34.0});
    checkBlockContract<TransientScore>(bad, {.bound = 1e9});
    checkModulation<TransientScore>({TransientScoreParams{}, relative, bad}, 1e9);
    checkSilenceIsCheap<TransientScore>(relative);
}

TEST_CASE("The transient detector makes no heap traffic", "[analysis][contract]")
{
    const auto x = clicks(8000, 8000.0, 50.0);
    TransientDetector detector;
    detector.setParams(relativeTransientParams());
    detector.prepare({8000.0, 8000});
    std::size_t count = 0;
    const HeapGuard guard;
    detector.process(x, [&count](const DetectedTransient&) noexcept { ++count; });
    detector.finish([&count](const DetectedTransient&) noexcept { ++count; });
    detector.setParams({});
    detector.reset();
    CHECK(guard.traffic() == 0);
    CHECK(count > 30);
}

TEST_CASE("The relative score is the fast envelope over the slow one, kept finite by a floor within its range",
          "[analysis]")
{
    const auto scores = [](double floor)
    {
        TransientScoreParams params;
        params.reading = TransientScoreReading::relative;
        params.floor = floor;
        TransientScore score;
        score.setParams(params);
        score.prepare({48000.0, 64});
        std::vector<double> found;
        for (int n = 0; n < 64; ++n)
            found.push_back(score.tick(n < 5 ? 0.0 : 1e-7));
        return found;
    };
    CHECK((scores(0.0) == scores(1e-9)));
    CHECK((scores(-1.0) == scores(1e-9)));
    CHECK((scores(1.1e-9) != scores(1e-9)));
    CHECK((scores(1e12) == scores(1e9)));
    CHECK((scores(0.9e9) != scores(1e9)));
    // Where the floor is far above both envelopes the score is their difference in its unit.
    TransientScoreParams absolute;
    absolute.reading = TransientScoreReading::absolute;
    TransientScore score;
    score.setParams(absolute);
    score.prepare({48000.0, 64});
    const auto relative = scores(1.0);
    for (int n = 0; n < 64; ++n)
    {
        const double difference = score.tick(n < 5 ? 0.0 : 1e-7);
        CHECK(std::abs(relative[static_cast<std::size_t>(n)]) == Approx(difference).epsilon(1e-5).margin(1e-15));
    }
}

TEST_CASE("The parameters of transient detection are the documented ones", "[analysis]")
{
    const TransientDetectorParams usual;
    CHECK(usual.threshold == 0.3);
    CHECK(usual.minimumWindow.value == 0.0);
    CHECK(usual.minimumDistance.value == 0.010);
    CHECK(usual.minimumAmplitude == 0.05);
    CHECK(usual.score.reading == TransientScoreReading::absolute);
    CHECK(test::asNumbers(usual.score.floor, usual.score.fastAttack.value, usual.score.slowAttack.value,
                          usual.score.hold.value,
                          usual.score.release.value) == test::Numbers{0.03, 0.001, 0.030, 0.016, 0.100});
    const auto relative = relativeTransientParams();
    CHECK(relative.score.reading == TransientScoreReading::relative);
    CHECK(test::asNumbers(relative.score.fastAttack.value, relative.score.slowAttack.value, relative.score.hold.value,
                          relative.score.release.value, relative.threshold, relative.minimumWindow.value,
                          relative.minimumDistance.value) ==
          test::Numbers{0.0005, 0.020, 0.005, 0.010, 2.0, 0.002, 0.008});
    CHECK(DetectedTransient{} == DetectedTransient{0, 0.0});
}

TEST_CASE("Transients of a dense train are what they were by both scores", "[analysis]")
{
    auto x = noise(16000, 21);
    for (std::size_t n = 0; n < x.size(); ++n)
        x[n] *= static_cast<float>(0.04 + 0.9 * std::exp(-static_cast<double>((n * 7 / 3) % 911) / 60.0));
    const auto pin = [&x](const std::string& name, TransientDetectorParams params)
    {
        std::vector<double> all;
        for (const DetectedTransient& event : detectTransients(x, 8000.0, params))
            all.insert(all.end(), {static_cast<double>(event.frame), event.amplitude});
        checkPinned("analysis/transients, " + name, all, 1e-6);
    };
    pin("absolute", {});
    pin("relative", relativeTransientParams());
    auto params = relativeTransientParams();
    params.minimumWindow = Seconds(0.03);
    params.minimumDistance = Seconds(0.0);
    params.threshold = 0.4;
    pin("overlapping windows", params);
    params.minimumWindow = Seconds(1.0);
    pin("more windows than fit", params);
    params.minimumDistance = Seconds(0.2);
    params.minimumAmplitude = 0.5;
    pin("far apart", params);
}

TEST_CASE("A transient score that was never told its parameters has the default ones", "[analysis]")
{
    const auto x = noise(4000, 13);
    TransientScore told, untold;
    told.setParams({});
    told.prepare({8000.0, 4000});
    untold.prepare({8000.0, 4000});
    CHECK(runInBlocks(told, x, 512) == runInBlocks(untold, x, 512));
}

TEST_CASE("Detecting transients in silence is cheap", "[analysis]")
{
    TransientDetector detector;
    TransientDetectorParams params;
    params.score.release = Seconds(0.01);
    detector.setParams(params);
    detector.prepare({8000.0, 512});
    const auto sink = [](const DetectedTransient&) noexcept {
    };
    detector.process(noise(512, 3), sink);
    const std::vector<float> silence(40000, 0.0f);
    detector.process(silence, sink);
    std::feclearexcept(FE_UNDERFLOW);
    detector.process(silence, sink);
    CHECK(std::fetestexcept(FE_UNDERFLOW) == 0);
}

TEST_CASE("A detector that is reset or prepared within an event is a new one", "[analysis]")
{
    const auto before = noise(3000, 17);
    const auto after = noise(9000, 18);
    auto params = relativeTransientParams();
    params.threshold = 0.2;
    params.minimumWindow = Seconds(0.05);
    params.minimumDistance = Seconds(0.0);
    const auto expected = detectTransients(after, 8000.0, params);
    REQUIRE(expected.size() > 5);
    for (const bool again : {false, true})
        for (std::size_t used = 1; used <= before.size(); used += 173)
        {
            TransientDetector detector;
            detector.setParams(params);
            detector.prepare({8000.0, 9000});
            detector.process(std::span(before).first(used), [](const DetectedTransient&) noexcept {});
            if (again)
                detector.prepare({8000.0, 9000});
            else
                detector.reset();
            std::vector<DetectedTransient> found;
            const auto keep = [&found](const DetectedTransient& event)
            {
                found.push_back(event);
            };
            detector.process(after, keep);
            detector.finish(keep);
            CHECK(found == expected);
        }
}
