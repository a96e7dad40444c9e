#include "io/formats/ahap/AhapFormat.h"

#include "io/formats/ClipFormat.h"
#include "io/formats/EmphasisFit.h"
#include "io/formats/EventsBeyond.h"
#include "io/formats/ahap/SumLimit.h"
#include "io/formats/haptic/HapticFormat.h"
#include "io/formats/players/AhapPlayer.h"
#include "support/Catch.h"
#include "support/RandomClip.h"

#include <pacini/foundation/Random.h>
#include <pacini/synthesis/SingleVoice.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
using Json = nlohmann::json;

/// One band of moving level and pitch with events, as a .haptic file is read.
Clip moving(double duration, std::size_t points, std::size_t events, std::uint64_t seed = 1)
{
    Random random(seed);
    Clip clip;
    clip.name = "moving";
    clip.duration = duration;
    Band band{65.0, 182.5, 300.0, 0, {}, {}};
    for (std::size_t i = 0; i < points; ++i)
    {
        const double time = duration * static_cast<double>(i) / static_cast<double>(points - 1);
        band.amplitude.push_back({time, random.uniform(0.0, 0.8)});
        band.pitch.push_back({time, random.uniform(130.0, 240.0)});
    }
    clip.bands = {band};
    for (std::size_t i = 0; i < events; ++i)
    {
        const double time = duration * static_cast<double>(i) / static_cast<double>(events);
        const double level = valueAt(band.amplitude, time);
        clip.transients.push_back({time, random.uniform(level, 1.0), random.uniform(0.3, 0.7)});
    }
    return clip;
}

std::vector<std::string> writtenFiles(const Clip& clip, bool split = false)
{
    ExportParams params;
    params.split = split;
    const auto exported = writeAhap(clip, params);
    REQUIRE((exported.ok() ? "" : exported.error().text()) == "");
    std::vector<std::string> texts;
    for (const ExportedFile& file : exported->files)
        texts.push_back(file.bytes);
    return texts;
}

/// What a player makes of the intensity at a time: the continuous events, times the curve, squared.
double playedAmplitude(const test::AhapPattern& pattern, double time)
{
    double sum = 0.0;
    for (const test::AhapEvent& event : pattern.events)
        if (!event.transient && event.time <= time && time < event.time + event.duration)
            sum += std::pow(event.intensity * test::controlAt(pattern.intensity, time, 1.0), 2.0);
    return sum;
}

double playedHertz(const test::AhapPattern& pattern, double time)
{
    for (const test::AhapEvent& event : pattern.events)
        if (!event.transient && event.time <= time && time < event.time + event.duration)
            return 65.0 + 235.0 * (event.sharpness + test::controlAt(pattern.sharpness, time, 0.0));
    return 0.0;
}

std::string errorOf(const std::string& text)
{
    const auto read = readAhap(text);
    return read.ok() ? "" : read.error().text();
}

std::string pattern(const std::string& entries)
{
    return R"({"Version": 1.0, "Pattern": [)" + entries + "]}";
}
} // namespace

TEST_CASE("AHAP: curves do not run late after their sixteenth point", "[io][formats]")
{
    const Clip clip = moving(3.0, 200, 0);
    const test::AhapPattern played = test::parseAhap(writtenFiles(clip)[0]);
    for (double time = 0.0; time < 2.99; time += 0.003)
    {
        CAPTURE(time);
        REQUIRE(std::abs(playedAmplitude(played, time) - valueAt(clip.bands[0].amplitude, time)) < 1.5 / 255.0);
        REQUIRE(std::abs(playedHertz(played, time) - valueAt(clip.bands[0].pitch, time)) < 0.1);
    }
}

TEST_CASE("AHAP: curves have at most 16 points, begin at their own time and share their ends", "[io][formats]")
{
    const Json file = Json::parse(writtenFiles(moving(3.0, 200, 5))[0]);
    std::map<std::string, std::pair<double, double>> ends;
    std::map<std::string, std::size_t> curves;
    for (const Json& entry : file["Pattern"])
    {
        if (!entry.contains("ParameterCurve"))
            continue;
        const Json& curve = entry["ParameterCurve"];
        const Json& points = curve["ParameterCurveControlPoints"];
        REQUIRE(points.size() >= 2);
        REQUIRE(points.size() <= 16);
        REQUIRE(points.front()["Time"] == 0.0);
        const auto id = curve["ParameterID"].get<std::string>();
        ++curves[id];
        const double start = curve["Time"].get<double>();
        if (ends.contains(id))
        {
            REQUIRE(std::abs(start - ends[id].first) < 1e-9);
            REQUIRE(points.front()["ParameterValue"] == ends[id].second);
        }
        ends[id] = {start + points.back()["Time"].get<double>(), points.back()["ParameterValue"].get<double>()};
    }
    REQUIRE(ends.size() == 2);
    CHECK(curves["HapticSharpnessControl"] == 14); // 200 points, 15 more with each: as few curves as there can be
}

TEST_CASE("AHAP: continuous events last at most 30 s and leave no gap", "[io][formats]")
{
    const test::AhapPattern played = test::parseAhap(writtenFiles(moving(95.0, 300, 0))[0]);
    REQUIRE(played.events.size() == 4);
    double end = 0.0;
    for (const test::AhapEvent& event : played.events)
    {
        REQUIRE(event.duration <= 30.0);
        REQUIRE(std::abs(event.time - end) < 1e-9);
        end = event.time + event.duration;
    }
    REQUIRE(std::abs(end - 95.0) < 1e-6);
}

TEST_CASE("AHAP: an event on the first point stays, and silence does not swallow events", "[io][formats]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {{65.0, 182.5, 300.0, 0, {{0.0, 0.0}, {0.4, 0.0}, {0.5, 0.6}, {1.0, 0.0}}, {}}};
    clip.transients = {{0.0, 0.49, 0.4}, {0.2, 0.81, 0.6}, {0.7, 1.0, 0.5}};
    for (const bool split : {false, true})
    {
        CAPTURE(split);
        const test::AhapPattern played = test::parseAhap(writtenFiles(clip, split).back());
        std::vector<double> strengths;
        for (const test::AhapEvent& event : played.events)
            if (event.transient)
                strengths.push_back(event.intensity * test::controlAt(played.intensity, event.time, 1.0));
        REQUIRE(strengths.size() == 3);
        for (std::size_t i = 0; i < strengths.size(); ++i)
            REQUIRE(std::abs(strengths[i] - std::sqrt(clip.transients[i].amplitude)) < 1e-4);
    }
}

TEST_CASE("AHAP: in one file transients feel as if there were no curves", "[io][formats]")
{
    const Clip clip = moving(4.0, 60, 37);
    const test::AhapPattern played = test::parseAhap(writtenFiles(clip)[0]);
    std::size_t next = 0;
    for (const test::AhapEvent& event : played.events)
    {
        if (!event.transient)
            continue;
        CAPTURE(event.time);
        const Transient& wanted = clip.transients[next++];
        REQUIRE(event.intensity <= 1.0);
        REQUIRE(std::abs(event.intensity * test::controlAt(played.intensity, event.time, 1.0) -
                         std::sqrt(wanted.amplitude)) < 1e-4);
        REQUIRE(std::abs(event.sharpness + test::controlAt(played.sharpness, event.time, 0.0) - wanted.sharpness) <
                1e-4);
    }
    REQUIRE(next == clip.transients.size());
}

TEST_CASE("AHAP: events in a row that are too near for curves of their own share one that weakens none",
          "[io][formats]")
{
    const auto strengthsIn = [](const Clip& clip)
    {
        const test::AhapPattern played = test::parseAhap(writtenFiles(clip)[0]);
        std::vector<double> strengths;
        for (const test::AhapEvent& event : played.events)
            if (event.transient)
                strengths.push_back(event.intensity * test::controlAt(played.intensity, event.time, 1.0));
        const auto isContinuous = [](const test::AhapEvent& event)
        {
            return !event.transient;
        };
        REQUIRE(std::count_if(played.events.begin(), played.events.end(), isContinuous) == 3); // before, in, after it
        return strengths;
    };
    Clip clip;
    clip.duration = 1.0;
    // The level rises by a lot within the time that the events need.
    clip.bands = {{65.0, 182.5, 300.0, 0, {{0.0, 0.01}, {0.11, 0.01}, {0.11, 0.64}, {1.0, 0.64}}, {}}};
    clip.transients = {{0.1, 0.25, 0.5}, {0.1019, 0.81, 0.5}, {0.1021, 0.25, 0.5}};
    const std::vector<double> strengths = strengthsIn(clip);
    REQUIRE(strengths.size() == 3);
    CHECK(strengths[0] == Approx(0.5).margin(1e-4));
    CHECK(strengths[1] == Approx(0.9).margin(1e-4));
    CHECK(strengths[2] == Approx(0.5).margin(1e-4));

    clip.transients.clear();
    for (int i = 0; i < 12; ++i) // the last is the strongest
        clip.transients.push_back({0.085 + 0.0019 * i, 0.09 + 0.05 * i, 0.5});
    const std::vector<double> longer = strengthsIn(clip);
    REQUIRE(longer.size() == clip.transients.size());
    for (std::size_t i = 0; i < longer.size(); ++i)
        CHECK(longer[i] == Approx(std::sqrt(clip.transients[i].amplitude)).margin(1e-4));
}

TEST_CASE("AHAP: a raised curve is named as a loss of what it adds to the vibration", "[io][formats]")
{
    const auto raised = [](const Clip& clip)
    {
        const auto exported = writeAhap(clip, {});
        REQUIRE(exported.ok());
        std::vector<FormatLoss> found;
        for (const FormatLoss& loss : exported->losses)
            if (loss.message.find("raised around events") != std::string::npos)
                found.push_back(loss);
        return found;
    };
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {{65.0, 182.5, 300.0, 0, {{0.0, 0.04}, {0.505, 0.04}, {0.505, 0.64}, {1.0, 0.64}}, {}}};
    clip.transients = {{0.5, 0.81, 0.5}};
    const std::vector<FormatLoss> losses = raised(clip);
    REQUIRE(losses.size() == 1);
    const test::AhapPattern played = test::parseAhap(writtenFiles(clip)[0]);
    double most = 0.0;
    for (double time = 0.4; time < 0.6; time += 0.0001)
        most = std::max(most, std::abs(playedAmplitude(played, time) - valueAt(clip.bands[0].amplitude, time)));
    CHECK(most > 0.1);
    REQUIRE(played.events.size() == 4); // before, around and after the event, and itself
    CHECK(played.events[1].time == Approx(0.499));
    CHECK(played.events[1].duration == Approx(0.016)); // 15 ms from the event on
    CHECK(losses[0].error == Approx(most).epsilon(0.01));
    CHECK(losses[0].time == Approx(0.499));
    CHECK(losses[0].duration == Approx(0.006));

    clip.bands[0].amplitude = {{0.0, 0.25}, {1.0, 0.25}}; // as it is, the curve is high enough for any event
    CHECK(raised(clip).empty());
    clip.bands[0].amplitude = {{0.0, 0.0}, {0.6, 0.0}, {0.7, 0.5}, {1.0, 0.5}}; // silence is not made to sound
    CHECK(raised(clip).empty());
    clip.bands[0].amplitude = {{0.0, 1e-6}, {0.4, 1e-6}, {0.6, 2e-6}, {1.0, 0.5}}; // nor what is too weak to be felt
    CHECK(raised(clip).empty());
}

TEST_CASE("AHAP: two files keep events out of the curves' way", "[io][formats]")
{
    const auto texts = writtenFiles(moving(2.0, 30, 9), true);
    REQUIRE(texts.size() == 2);
    REQUIRE(texts[0].find("HapticTransient") == std::string::npos);
    REQUIRE(texts[1].find("ParameterCurve") == std::string::npos);
    REQUIRE(readAhap(texts[0])->clip.transients.empty());
    REQUIRE(readAhap(texts[1])->clip.transients.size() == 9);
}

TEST_CASE("AHAP: a .haptic clip without frequencies has no curve of them", "[io][formats]")
{
    for (const char* frequency : {R"(, "frequency": [])", R"(, "frequency": null)", ""})
    {
        const auto read = readHaptic(R"({"version":{"major":1},"signals":{"continuous":{"envelopes":{"amplitude":
            [{"time":0,"amplitude":0.2},{"time":1,"amplitude":0.5}])" +
                                     std::string(frequency) + "}}}}");
        REQUIRE(read.ok());
        REQUIRE(writtenFiles(read->clip)[0].find("HapticSharpnessControl") == std::string::npos);
    }
}

TEST_CASE("AHAP: .haptic clips come back with every emphasis", "[io][formats]")
{
    for (std::uint64_t seed = 1; seed <= 60; ++seed)
    {
        CAPTURE(seed);
        const Clip made = moving(5.0, 100, 7 * (seed % 11), seed);
        const auto haptic = readHaptic(writeHaptic(made, {})->files[0].bytes);
        REQUIRE(haptic.ok());
        const auto back = readAhap(writtenFiles(haptic->clip)[0]);
        REQUIRE(back.ok());
        const auto text = writeHaptic(back->clip, {})->files[0].bytes;
        std::size_t emphases = 0;
        for (std::size_t at = text.find("\"emphasis\""); at != std::string::npos;
             at = text.find("\"emphasis\"", at + 1))
            ++emphases;
        REQUIRE(emphases == made.transients.size());
    }
}

TEST_CASE("AHAP: a file comes back from its clip as it is felt", "[io][formats]")
{
    for (std::uint64_t seed = 1; seed <= 30; ++seed)
    {
        CAPTURE(seed);
        const std::string first = writtenFiles(moving(4.0, 80, seed % 20, seed))[0];
        const auto clip = readAhap(first);
        REQUIRE((clip.ok() ? "" : clip.error().text()) == "");
        REQUIRE(clip->warnings.empty());
        REQUIRE(clip->clip.bands.size() == 1);
        const std::string second = writtenFiles(clip->clip)[0];
        const test::AhapPattern a = test::parseAhap(first), b = test::parseAhap(second);
        for (double time = 0.0005; time < 3.99; time += 0.0037)
        {
            CAPTURE(time);
            REQUIRE(std::abs(std::sqrt(playedAmplitude(a, time)) - std::sqrt(playedAmplitude(b, time))) < 2.0 / 255.0);
        }
        std::vector<double> timesA, timesB;
        for (const auto& event : a.events)
            if (event.transient)
                timesA.push_back(event.time);
        for (const auto& event : b.events)
            if (event.transient)
                timesB.push_back(event.time);
        REQUIRE(timesA == timesB);
    }
}

TEST_CASE("AHAP: any clip is written and read again", "[io][formats]")
{
    for (std::uint64_t seed = 0; seed < 150; ++seed)
    {
        CAPTURE(seed);
        const Clip clip = test::randomFullClip(seed);
        const std::string text = writtenFiles(clip)[0];
        const auto back = readAhap(text);
        REQUIRE((back.ok() ? "" : back.error().text()) == "");
        REQUIRE(back->warnings.empty());
        REQUIRE(back->clip.transients.size() ==
                (isSingleVoice(clip) ? clip.transients.size() : separated(clip.transients, 0.01).size()));
        REQUIRE(writtenFiles(clip)[0] == text);
        ExportParams merged;
        merged.events = EventExport::merged;
        REQUIRE(readAhap(writeAhap(clip, merged)->files[0].bytes)->clip.transients.size() == test::eventsBeyond(clip));
    }
    Clip empty;
    REQUIRE(readAhap(writtenFiles(empty)[0]).ok());
}

TEST_CASE("AHAP: parameters step, curves move, and both scale and shift events", "[io][formats]")
{
    const auto read = readAhap(pattern(R"(
        {"Event": {"Time": 0, "EventType": "HapticContinuous", "EventDuration": 2,
                   "EventParameters": [{"ParameterID": "HapticIntensity", "ParameterValue": 0.5},
                                       {"ParameterID": "HapticSharpness", "ParameterValue": 0.25}]}},
        {"Event": {"Time": 1.5, "EventType": "HapticTransient"}},
        {"Parameter": {"ParameterID": "HapticSharpnessControl", "ParameterValue": 0.5, "Time": 1}},
        {"ParameterCurve": {"ParameterID": "HapticIntensityControl", "Time": 1, "ParameterCurveControlPoints":
            [{"Time": 0, "ParameterValue": 1}, {"Time": 0.5, "ParameterValue": 0.4}]}})"));
    REQUIRE((read.ok() ? "" : read.error().text()) == "");
    const Clip& clip = read->clip;
    REQUIRE(clip.duration == 2.0);
    REQUIRE(clip.bands.size() == 1);
    const auto amplitude = [&](double time)
    {
        return valueAt(clip.bands[0].amplitude, time);
    };
    REQUIRE(std::abs(amplitude(0.5) - 0.25) < 1e-9);
    REQUIRE(std::abs(amplitude(1.25) - std::pow(0.5 * 0.7, 2.0)) < 1.0 / 255.0);
    REQUIRE(std::abs(amplitude(1.75) - std::pow(0.5 * 0.4, 2.0)) < 1e-9);
    REQUIRE(std::abs(valueAt(clip.bands[0].pitch, 0.5) - (65.0 + 235.0 * 0.25)) < 1e-9);
    REQUIRE(std::abs(valueAt(clip.bands[0].pitch, 1.5) - (65.0 + 235.0 * 0.75)) < 1e-9);
    REQUIRE(clip.transients.size() == 1);
    REQUIRE(std::abs(clip.transients[0].amplitude - 0.16) < 1e-9);
    REQUIRE(clip.transients[0].sharpness == 1.0);
}

TEST_CASE("AHAP: an entry that has an event, a parameter and a curve is read as three entries are", "[io][formats]")
{
    const std::string event = R"("Event": {"Time": 0.5, "EventType": "HapticTransient"})",
                      parameter =
                          R"("Parameter": {"ParameterID": "HapticIntensityControl", "ParameterValue": 0.5, "Time": 0})",
                      curve = R"("ParameterCurve": {"ParameterID": "HapticSharpnessControl", "Time": 0,
                          "ParameterCurveControlPoints": [{"Time": 0, "ParameterValue": -0.25}]})";
    const auto apart = readAhap(pattern("{" + event + "}, {" + parameter + "}, {" + curve + "}"));
    const auto together = readAhap(pattern("{" + event + ", " + parameter + ", " + curve + "}"));
    REQUIRE(apart.ok());
    REQUIRE(together.ok());
    CHECK(together->clip == apart->clip);
    REQUIRE(apart->clip.transients.size() == 1);
    CHECK(std::abs(apart->clip.transients[0].amplitude - 0.25) < 1e-9);
}

TEST_CASE("AHAP: nothing sounds before, between and after continuous events", "[io][formats]")
{
    const auto event = [](const char* time, const char* duration, const char* intensity)
    {
        return R"({"Event": {"EventType": "HapticContinuous", "Time": )" + std::string(time) +
               R"(, "EventDuration": )" + duration +
               R"(, "EventParameters": [{"ParameterID": "HapticIntensity", "ParameterValue": )" + intensity + "}]}}";
    };
    const auto read =
        readAhap(pattern(event("0.2", "0.3", "0.8") + ", " + event("1", "0.5", "1") + ", " +
                         event("1.5", "0.5", "0.6") + R"(, {"Event": {"EventType": "HapticTransient", "Time": 3}})"));
    REQUIRE((read.ok() ? "" : read.error().text()) == "");
    REQUIRE(read->clip.bands.size() == 1); // they take turns
    for (double time = 0.005; time < 3.0; time += 0.01)
    {
        CAPTURE(time);
        const double wanted = time < 0.2 ? 0.0 : time < 0.5 ? 0.64 : time < 1.0 ? 0.0 : time < 1.5 ? 1.0 : 0.36;
        REQUIRE(valueAt(read->clip.bands[0].amplitude, time) == Approx(time < 2.0 ? wanted : 0.0).margin(1e-9));
    }
}

namespace
{
/// A continuous event of full intensity, `members` are more of it.
std::string shapedEvent(const std::string& parameters, const std::string& members = R"(, "EventDuration": 0.4)")
{
    return R"({"Event": {"EventType": "HapticContinuous", "Time": 0.5)" + members + R"(, "EventParameters": [)" +
           parameters + "]}}";
}

std::string parameter(const std::string& id, const std::string& value)
{
    return R"({"ParameterID": ")" + id + R"(", "ParameterValue": )" + value + "}";
}

/// Checks that the root of the one band's amplitude, the intensity, is `wanted(time)`.
template <typename Wanted>
void checkIntensity(const Clip& clip, Wanted wanted)
{
    REQUIRE(clip.bands.size() == 1);
    for (double time = 0.003; time < clip.duration; time += 0.01)
    {
        CAPTURE(time);
        CHECK(std::sqrt(valueAt(clip.bands[0].amplitude, time)) == Approx(wanted(time)).margin(0.07));
    }
}

double ramp(double time, double from, double to)
{
    return std::clamp((time - from) / (to - from), 0.0, 1.0);
}

const std::string inSeconds =
    "Pattern: AttackTime, DecayTime and ReleaseTime are read as seconds, since Apple does not "
    "say how long they are on a phone";
} // namespace

TEST_CASE("AHAP: an event that sustains rises for its attack, holds and falls after its end", "[io][formats]")
{
    const auto read =
        readAhap(pattern(shapedEvent(parameter("AttackTime", "0.1") + "," + parameter("ReleaseTime", "0.3"))));
    REQUIRE((read.ok() ? "" : read.error().text()) == "");
    CHECK(read->clip.duration == Approx(1.2));
    CHECK(read->warnings == std::vector<std::string>{inSeconds});
    checkIntensity(read->clip, [](double t) { return ramp(t, 0.5, 0.6) * ramp(t, 1.2, 0.9); });

    const auto late = readAhap(pattern(shapedEvent(parameter("AttackTime", "0.8"))));
    REQUIRE(late.ok());
    CHECK(late->clip.duration == Approx(0.9));
    checkIntensity(late->clip, [](double t) { return t < 0.5 ? 0.0 : (t - 0.5) / 0.8; });
}

TEST_CASE("AHAP: an event that does not sustain is over after attack and decay", "[io][formats]")
{
    const auto read = readAhap(pattern(shapedEvent(parameter("AttackTime", "0.05") + "," +
                                                   parameter("DecayTime", "0.2") + "," + parameter("Sustained", "0"))));
    REQUIRE((read.ok() ? "" : read.error().text()) == "");
    CHECK(read->clip.duration == Approx(0.9)); // as long as the file states
    CHECK(read->warnings == std::vector<std::string>{inSeconds});
    checkIntensity(read->clip, [](double t) { return ramp(t, 0.5, 0.55) * ramp(t, 0.75, 0.55); });

    const auto unstated = readAhap(pattern(shapedEvent(parameter("Sustained", "0"), "")));
    REQUIRE(unstated.ok());
    CHECK(unstated->clip.duration == Approx(0.51)); // the shortest decay
    CHECK(unstated->clip.bands[0].amplitude.back().value == 0.0);
    CHECK(unstated->warnings.empty());
}

TEST_CASE("AHAP: curves go on through a release, and controls add to the times of envelopes", "[io][formats]")
{
    const std::string curve = R"(, {"ParameterCurve": {"ParameterID": "HapticIntensityControl", "Time": 0,
        "ParameterCurveControlPoints": [{"Time": 0, "ParameterValue": 0}, {"Time": 2, "ParameterValue": 1}]}})";
    const auto read = readAhap(pattern(shapedEvent(parameter("ReleaseTime", "1")) + curve));
    REQUIRE(read.ok());
    checkIntensity(read->clip, [](double t) { return t < 0.5 ? 0.0 : t / 2.0 * ramp(t, 1.9, 0.9); });

    const auto control = [](const std::string& id, const std::string& time, const std::string& value)
    {
        return R"(, {"Parameter": {"ParameterID": ")" + id + R"(", "Time": )" + time + R"(, "ParameterValue": )" +
               value + "}}";
    };
    const auto added = readAhap(
        pattern(shapedEvent(parameter("ReleaseTime", "0.3")) + control("HapticReleaseTimeControl", "0.8", "-0.1") +
                control("HapticAttackTimeControl", "0", "0.1") + control("HapticDecayTimeControl", "0", "0.1")));
    REQUIRE(added.ok());
    CHECK(added->clip.duration == Approx(1.1));
    CHECK(added->warnings == std::vector<std::string>{inSeconds});
    checkIntensity(added->clip, [](double t) { return ramp(t, 0.5, 0.6) * ramp(t, 1.1, 0.9); });
}

TEST_CASE("AHAP: parts of an envelope that have no effect, or no event to act on, are named", "[io][formats]")
{
    const std::string noEffect =
        "Pattern: DecayTime of events that sustain and ReleaseTime of those that do not have no "
        "effect in Core Haptics and are not kept";
    const auto warningsOf = [](const std::string& event)
    {
        return readAhap(pattern(event))->warnings;
    };
    CHECK(warningsOf(shapedEvent(parameter("DecayTime", "0.2"))) == std::vector<std::string>{noEffect});
    CHECK(warningsOf(shapedEvent(parameter("ReleaseTime", "0.2") + "," + parameter("Sustained", "0"))) ==
          std::vector<std::string>{noEffect});
    CHECK(warningsOf(shapedEvent(parameter("AttackTime", "0") + "," + parameter("Sustained", "1"))).empty());
    CHECK(warningsOf(shapedEvent(parameter("AttackTime", "2"))) ==
          std::vector<std::string>{"Pattern[0].Event.EventParameters[0].ParameterValue: is outside of 0 to 1 and is "
                                   "limited to this range",
                                   inSeconds});
    CHECK(warningsOf(R"({"Event": {"EventType": "HapticTransient", "Time": 0, "EventParameters": [)" +
                     parameter("DecayTime", "0.2") + "]}}") ==
          std::vector<std::string>{"Pattern: the parameter DecayTime is not kept"});
}

TEST_CASE("AHAP: a version in quotes, null for a name, and any audio event are read", "[io][formats]")
{
    const auto versioned = [](const std::string& version)
    {
        return R"({"Version": )" + version + R"(, "Metadata": {"Project": null}, "Pattern": []})";
    };
    for (const char* version : {"1", "1.0", "\"1.0\"", "\"1\"", "null"})
        CHECK(errorOf(versioned(version)) == "");
    CHECK(errorOf(versioned("\"2.0\"")).starts_with("Version: is 2, but only version 1"));
    CHECK(errorOf(versioned("\"one\"")) == "Version: must be a number");
    CHECK(errorOf(R"({"Metadata": null, "Pattern": []})") == "");
    const auto audio = readAhap(pattern(R"({"Event": {"EventType": "AudioCustom", "EventWaveformPath": 3,
        "EventWaveformUseVolumeEnvelope": false, "EventWaveformID": {"a": []}, "EventParameters": [{"AudioVolume": 1}]}})"));
    REQUIRE((audio.ok() ? "" : audio.error().text()) == "");
    CHECK(audio->warnings == std::vector<std::string>{"Pattern: audio events are not kept"});
}

TEST_CASE("AHAP: true for Sustained and null for what has a free name are read, and told", "[io][formats]")
{
    const auto read = [](const std::string& parameters, const std::string& more = "")
    {
        return clipFormatNamed("ahap")->read(pattern(
            R"({"Event": {"EventType": "HapticContinuous", "Time": 0, "EventDuration": 0.5, "EventParameters": [)" +
            parameters + "]}}" + more));
    };
    const std::string decays = R"({"ParameterID": "DecayTime", "ParameterValue": 0.2}, )";
    const auto sustained = [&](const std::string& value)
    {
        return read(decays + R"({"ParameterID": "Sustained", "ParameterValue": )" + value + "}");
    };
    REQUIRE(sustained("true"));
    CHECK(sustained("true")->clip == sustained("1")->clip);
    CHECK(sustained("false")->clip == sustained("0")->clip);
    CHECK_FALSE(sustained("false")->clip == sustained("true")->clip);
    CHECK(sustained("true")->warnings.back() == "Pattern: Sustained is true or false instead of 1 or 0");
    const auto plain = read("");
    for (const char* slip :
         {R"({"ParameterID": null, "ParameterValue": 1})", "null",
          R"({"ParameterID": "HapticSharpness", "ParameterValue": null})",
          R"({"ParameterID": "Mine", "ParameterValue": null})", R"({"ParameterID": "Mine", "ParameterValue": true})"})
    {
        CAPTURE(slip);
        const auto mended = read(slip);
        REQUIRE((mended.ok() ? "" : mended.error().text()) == "");
        CHECK(mended->clip == plain->clip);
        CHECK(mended->warnings.size() == 1);
    }
    REQUIRE(read("", ", null"));
    CHECK(read("", ", null")->clip == plain->clip);
    CHECK(read("", ", null")->warnings == std::vector<std::string>{"Pattern: null in the list Pattern is left out"});
    CHECK(read(R"({"ParameterID": "HapticIntensity", "ParameterValue": true})").error().text() ==
          "Pattern[0].Event.EventParameters[0].ParameterValue: must be a number");
    CHECK_FALSE(read(R"({"ParameterID": "Sustained", "ParameterValue": "yes"})"));
    CHECK_FALSE(clipFormatNamed("ahap")->read(R"({"Pattern": null})"));
    CHECK_FALSE(clipFormatNamed("ahap")->read("null"));
}

TEST_CASE("AHAP: what Core Haptics mends is mended with a warning, the rest refused with its place", "[io][formats]")
{
    const auto event = [](const std::string& members)
    {
        return pattern(R"({"Event": {)" + members + "}}");
    };
    const std::string good = R"("Time": 0.5, "EventType": "HapticTransient")";
    REQUIRE(errorOf(event(good)) == "");
    const auto loud =
        readAhap(event(good + R"(, "EventParameters": [{"ParameterID": "HapticIntensity", "ParameterValue": 1.5}])"));
    REQUIRE(loud.ok());
    REQUIRE(loud->warnings.size() == 1);
    REQUIRE(loud->warnings[0].starts_with("Pattern[0].Event.EventParameters[0].ParameterValue: "));
    REQUIRE(loud->clip.transients[0].amplitude == 1.0);
    REQUIRE(
        readAhap(event(R"("Time": 0, "EventType": "AudioCustom", "EventWaveformPath": "a.wav")"))->warnings.size() ==
        1);

    CHECK(errorOf("{}").starts_with("Pattern: is missing"));
    CHECK(errorOf(R"({"Version": 2, "Pattern": []})").starts_with("Version: is 2"));
    CHECK(errorOf(R"({"Pattern": 1})").starts_with("Pattern: must be a list"));
    CHECK(errorOf(pattern("{}")).starts_with("Pattern[0]: is neither"));
    CHECK(errorOf(pattern("3")).starts_with("Pattern[0]: must be an object"));
    CHECK(errorOf(event(R"("EventType": "HapticTransient")")).starts_with("Pattern[0].Event.Time: is missing"));
    CHECK(errorOf(event(R"("Time": -1, "EventType": "HapticTransient")"))
              .starts_with("Pattern[0].Event.Time: is before"));
    CHECK(errorOf(event(R"("Time": 0, "EventType": "Haptic")")).starts_with("Pattern[0].Event.EventType: is no type"));
    CHECK(
        errorOf(event(R"("Time": "0", "EventType": "HapticTransient")")).starts_with("Pattern[0].Event.Time: must be"));
    CHECK(errorOf(event(R"("Time": 1e9, "EventType": "HapticTransient")")).starts_with("Pattern[0].Event.Time: "));
    CHECK(errorOf(event(R"("Time": 0, "EventDuration": -1, "EventType": "HapticContinuous")"))
              .starts_with("Pattern[0].Event.EventDuration: "));
    CHECK(errorOf(pattern(R"({"ParameterCurve": {"ParameterID": "HapticIntensityControl", "Time": 0,
                             "ParameterCurveControlPoints": []}})"))
              .starts_with("Pattern[0].ParameterCurve.ParameterCurveControlPoints: has no point"));
    CHECK(errorOf(pattern(R"({"ParameterCurve": {"ParameterID": "HapticIntensityControl", "Time": 0,
        "ParameterCurveControlPoints": [{"Time": 1, "ParameterValue": 0}, {"Time": 0, "ParameterValue": 0}]}})"))
              .starts_with("Pattern[0].ParameterCurve.ParameterCurveControlPoints[1].Time: is earlier"));
    CHECK(errorOf(pattern(R"({"Parameter": {"ParameterID": "HapticIntensityControl", "Time": 0}})"))
              .starts_with("Pattern[0].Parameter.ParameterValue: is missing"));
    CHECK(errorOf(R"({"Pattern": [], "Pattern": []})").starts_with("Pattern: is given twice"));
    CHECK(errorOf(event(good + R"(, "Time": 0.5)")).starts_with("Pattern[0].Event.Time: is given twice"));
    CHECK(errorOf("\xEF\xBB\xBF" + event(good)) == "");
    CHECK_FALSE(errorOf(std::string("{\0", 2)).empty());
    CHECK_FALSE(errorOf(R"({"Pattern": [],})").empty());
    CHECK_FALSE(errorOf(std::string(50'000, '[')).empty());

    std::string crowd;
    for (int i = 0; i < 300; ++i)
        crowd += std::string(i > 0 ? "," : "") +
                 R"({"Event": {"Time": 0, "EventDuration": 1, "EventType": "HapticContinuous"}})";
    CHECK(errorOf(pattern(crowd)).starts_with("Pattern: has more than 256"));
}

TEST_CASE("AHAP: no rate of events makes continuous events that have no end", "[io][formats]")
{
    for (double rate = 50.0; rate < 75.0; rate += 0.25)
    {
        CAPTURE(rate);
        Clip clip;
        clip.duration = 1.0;
        clip.bands = {{65.0, 182.5, 300.0, 0, {{0.0, 0.1}, {0.5, 0.2}, {1.0, 0.05}}, {}}};
        for (double time = 0.0501234; time < 0.97; time += 1.0 / rate)
            clip.transients.push_back({time, 0.8, 0.5});
        const std::string text = writtenFiles(clip)[0];
        for (const test::AhapEvent& event : test::parseAhap(text).events)
            REQUIRE((event.transient || event.duration >= 0.0009));
        const auto back = readAhap(text);
        REQUIRE(back.ok());
        REQUIRE(back->warnings.empty());
        REQUIRE(back->clip.bands.size() == 1);
        REQUIRE(back->clip.duration == 1.0);
        for (const Breakpoint& point : back->clip.bands[0].amplitude)
            REQUIRE(point.value <= 1.0);
    }
}

TEST_CASE("AHAP: what is left after whole half minutes is no event without an end", "[io][formats]")
{
    for (const double more : {0.0, 4e-7, 6e-7, 0.0004})
    {
        CAPTURE(more);
        double end = 0.0;
        for (const test::AhapEvent& event : test::parseAhap(writtenFiles(moving(60.0 + more, 90, 0))[0]).events)
        {
            REQUIRE(event.duration >= 15.0);
            REQUIRE(event.duration <= 30.0);
            REQUIRE(std::abs(event.time - end) < 1e-9);
            end = event.time + event.duration;
        }
        REQUIRE(std::abs(end - 60.0 - more) < 1e-6);
    }
}

TEST_CASE("AHAP: continuous events without a duration end with the pattern", "[io][formats]")
{
    const std::string endless = R"({"Event": {"Time": 0.5, "EventType": "HapticContinuous", "EventDuration": 0}})";
    const std::string tap = R"(, {"Event": {"Time": 1.5, "EventType": "HapticTransient"}})";
    const auto withTap = readAhap(pattern(endless + tap));
    REQUIRE(withTap.ok());
    REQUIRE(withTap->warnings.size() == 1);
    REQUIRE(withTap->clip.bands[0].amplitude.back().time == withTap->clip.duration);
    REQUIRE(withTap->clip.duration > 1.5);
    REQUIRE(withTap->clip.duration < 1.53);
    REQUIRE(readAhap(pattern(endless))->clip.duration == 30.5); // as long as Core Haptics plays it
    const std::string late = R"(, {"Event": {"Time": 100, "EventType": "HapticTransient"}})";
    const auto withLate = readAhap(pattern(endless + late));
    REQUIRE(valueAt(withLate->clip.bands[0].amplitude, 30.0) == 1.0);
    REQUIRE(valueAt(withLate->clip.bands[0].amplitude, 31.0) == 0.0);
}

TEST_CASE("AHAP: continuous events together are no more than full drive", "[io][formats]")
{
    std::string events;
    for (int i = 0; i < 20; ++i)
        events += (i > 0 ? ", " : "") + std::string(R"({"Event": {"EventType": "HapticContinuous", "Time": )") +
                  std::to_string(0.05 * i) + R"(, "EventDuration": 0, "EventParameters": [{"ParameterID":
                  "HapticIntensity", "ParameterValue": 0.7}]}})";
    events += R"(, {"Event": {"EventType": "HapticContinuous", "Time": 2, "EventDuration": 0.5}})";
    const auto read = readAhap(pattern(events));
    REQUIRE((read.ok() ? "" : read.error().text()) == "");
    REQUIRE(read->warnings.size() == 2);
    const auto sum = [&](double time)
    {
        double all = 0.0;
        for (const Band& band : read->clip.bands)
            all += valueAt(band.amplitude, time);
        return all;
    };
    for (double time = 0.0; time < 2.5; time += 0.00137)
    {
        CAPTURE(time);
        const double begun = std::min(std::floor(time / 0.05) + 1.0, 20.0);
        const double wanted = time < 2.0 ? std::min(1.0, 0.49 * begun) : 1.0;
        if (std::abs(time / 0.05 - std::round(time / 0.05)) > 0.01)
            REQUIRE(std::abs(sum(time) - wanted) < 1e-6);
    }
}

TEST_CASE("Overlapping slopes are limited where they pass the limit, not before", "[io][formats]")
{
    std::vector<Band> bands(2);
    bands[0].amplitude = {{0.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}};
    bands[1].amplitude = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.5}, {2.0, 0.0}};
    const std::vector<Band> before = bands;
    REQUIRE(limitSum(bands, 1.0, 1000).ok());
    for (double time = 0.0; time <= 2.0; time += 0.01)
    {
        CAPTURE(time);
        const double a = valueAt(before[0].amplitude, time), b = valueAt(before[1].amplitude, time);
        REQUIRE(std::abs(valueAt(bands[0].amplitude, time) + valueAt(bands[1].amplitude, time) - std::min(a + b, 1.0)) <
                1e-9);
    }
    REQUIRE(valueAt(bands[0].amplitude, 0.5) == 0.5);
    std::vector<Band> quiet(2);
    quiet[0].amplitude = quiet[1].amplitude = {{0.0, 0.5}, {1.0, 0.5}};
    const std::vector<Band> kept = quiet;
    REQUIRE_FALSE(*limitSum(quiet, 1.0, 1000));
    REQUIRE(quiet == kept);
    REQUIRE_FALSE(limitSum(bands = before, 0.5, 3).ok());
}

TEST_CASE("Slopes that pass the limit between their points stay as they are until there", "[io][formats]")
{
    for (const double most : {0.5, 1.0})
        for (const bool falls : {false, true})
        {
            CAPTURE(most, falls);
            std::vector<Band> bands(2);
            bands[0].amplitude = {{3.0, 0.1 * most}, {5.0, 1.2 * most}};
            bands[1].amplitude = {{3.0, 0.3 * most}, {5.0, 0.8 * most}};
            if (falls)
                for (Band& band : bands)
                    std::swap(band.amplitude[0].value, band.amplitude[1].value);
            const std::vector<Band> before = bands;
            REQUIRE(*limitSum(bands, most, 1000));
            for (double time = 3.0; time <= 5.0; time += 0.01)
            {
                CAPTURE(time);
                double sum = 0.0, wanted = 0.0;
                for (std::size_t i = 0; i < bands.size(); ++i)
                {
                    sum += valueAt(bands[i].amplitude, time);
                    wanted += valueAt(before[i].amplitude, time);
                }
                REQUIRE(sum == Approx(std::min(wanted, most)).margin(1e-9));
                for (std::size_t i = 0; i < bands.size() && wanted < most; ++i)
                    REQUIRE(valueAt(bands[i].amplitude, time) ==
                            Approx(valueAt(before[i].amplitude, time)).margin(1e-9));
            }
        }
}

TEST_CASE("AHAP: every event of a clip of bands is a transient under which the voice is ducked", "[io][formats]")
{
    Clip clip;
    clip.duration = 2.0;
    for (const double hertz : {80.0, 150.0})
        clip.bands.push_back({hertz, hertz, hertz, 0, {{0.0, 0.3}, {2.0, 0.3}}, {}});
    clip.envelope = {{0.0, 0.4}, {2.0, 0.4}};
    clip.transients = {{0.5, 0.3, 0.5}, {1.0, 0.3, 0.0}, {1.5, 0.2, 0.5}, {1.506, 0.3, 0.5}};
    for (const bool split : {false, true})
    {
        CAPTURE(split);
        ExportParams params;
        params.split = split;
        const auto exported = writeAhap(clip, params);
        REQUIRE(exported.ok());
        const test::AhapPattern voice = test::parseAhap(exported->files.front().bytes);
        const test::AhapPattern taps = test::parseAhap(exported->files.back().bytes);
        std::vector<double> times;
        for (const test::AhapEvent& event : taps.events)
            if (event.transient)
            {
                times.push_back(event.time);
                const double played = std::pow(event.intensity * test::controlAt(taps.intensity, event.time, 1.0), 2.0);
                CHECK(played == Approx(0.4 * std::sqrt(1.0 - 0.15 * 0.15)).epsilon(0.02)); // instead of the voice
                CHECK(playedAmplitude(voice, event.time + 0.003) == Approx(0.15 * 0.4).margin(1.5 / 255.0));
            }
        CHECK(times == std::vector<double>{0.5, 1.0, 1.506});
        CHECK(playedAmplitude(voice, 0.4) == Approx(0.4).margin(1.5 / 255.0));
        std::vector<FormatLoss> omitted;
        for (const FormatLoss& loss : exported->losses)
            if (loss.kind == LossKind::transient)
                omitted.push_back(loss);
        REQUIRE(omitted.size() == 1);
        CHECK(omitted[0].time == 1.5);
        CHECK(omitted[0].error == 0.2);
    }
    ExportParams merged;
    merged.events = EventExport::merged;
    const auto exported = writeAhap(clip, merged);
    REQUIRE(exported.ok());
    CHECK(std::count_if(exported->losses.begin(), exported->losses.end(),
                        [](const FormatLoss& loss) { return loss.kind == LossKind::transient; }) == 4);
    CHECK(exported->files[0].bytes.find("HapticTransient") == std::string::npos);
}
