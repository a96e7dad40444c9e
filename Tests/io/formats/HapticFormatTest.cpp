#include "io/formats/haptic/HapticFormat.h"

#include "io/formats/EmphasisFit.h"
#include "support/Catch.h"
#include "support/RandomClip.h"

#include <pacini/foundation/Random.h>
#include <pacini/synthesis/SingleVoice.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <string>

using namespace pacini;

namespace
{
using Json = nlohmann::json;

Json plain()
{
    return Json::parse(R"({"version":{"major":1,"minor":0,"patch":0},
        "metadata":{"editor":"","author":"","source":"","project":"","tags":[],"description":""},
        "signals":{"continuous":{"envelopes":{
            "amplitude":[{"time":0,"amplitude":0.5,"emphasis":{"amplitude":0.7,"frequency":0.2}},
                         {"time":1,"amplitude":0.25}],
            "frequency":[{"time":0,"frequency":0.5},{"time":1,"frequency":1}]}}}})");
}

Json& amplitude(Json& file)
{
    return file["signals"]["continuous"]["envelopes"]["amplitude"];
}
Json& frequency(Json& file)
{
    return file["signals"]["continuous"]["envelopes"]["frequency"];
}

/// "where: message" of the error after a change; "" when it is accepted.
std::string errorAfter(const std::function<void(Json&)>& change)
{
    Json file = plain();
    change(file);
    const auto read = readHaptic(file.dump());
    return read.ok() ? "" : read.error().text();
}

bool warnsAfter(const std::function<void(Json&)>& change)
{
    Json file = plain();
    change(file);
    const auto read = readHaptic(file.dump());
    REQUIRE(read.ok());
    return !read->warnings.empty();
}

/// The rules of the strictest reader, on the numbers as 32-bit floats; "" when all hold.
std::string brokenRule(const std::string& text)
{
    const Json file = Json::parse(text);
    if (file.at("version") != Json{{"major", 1}, {"minor", 0}, {"patch", 0}})
        return "version";
    const Json& envelopes = file.at("signals").at("continuous").at("envelopes");
    const Json& points = envelopes.at("amplitude");
    if (points.size() < 2 || points.front().at("time") != 0.0)
        return "amplitude points";
    float before = 0.0f;
    const auto unit = [](const Json& value)
    {
        return value.get<float>() >= 0.0f && value.get<float>() <= 1.0f;
    };
    for (const Json& point : points)
    {
        if (point.at("time").get<float>() < before)
            return "amplitude order";
        before = point.at("time").get<float>();
        if (!unit(point.at("amplitude")))
            return "amplitude range";
        if (!point.contains("emphasis"))
            continue;
        const Json& emphasis = point["emphasis"];
        if (!unit(emphasis.at("amplitude")) || !unit(emphasis.at("frequency")) ||
            emphasis["amplitude"].get<float>() < point["amplitude"].get<float>())
            return "emphasis";
    }
    if (!(before > 0.0f))
        return "duration";
    float last = 0.0f;
    for (const Json& point : envelopes.at("frequency"))
    {
        if (point.at("time").get<float>() < last || point.at("time").get<float>() > before)
            return "frequency order";
        last = point.at("time").get<float>();
        if (!unit(point.at("frequency")))
            return "frequency range";
    }
    return "";
}

std::string written(const Clip& clip, const ExportParams& params = {})
{
    const auto exported = writeHaptic(clip, params);
    REQUIRE((exported.ok() ? "" : exported.error().text()) == "");
    REQUIRE(exported->files.size() == 1);
    return exported->files.front().bytes;
}

/// A file of `points` random points as a studio could have made it, with steps and emphases.
Json randomFile(std::uint64_t seed)
{
    Random random(seed);
    Json file = plain();
    const auto digits = [](double value)
    {
        return std::round(value * 1e4) / 1e4;
    };
    amplitude(file) = Json::array();
    frequency(file) = Json::array();
    double time = 0.0;
    for (int i = 0; i < 200; ++i)
    {
        const double value = digits(random.uniform(0.0, 1.0));
        Json point{{"time", digits(time)}, {"amplitude", value}};
        if (random.next() % 8 == 0)
            point["emphasis"] = {{"amplitude", digits(random.uniform(value, 1.0))},
                                 {"frequency", digits(random.uniform(0.0, 1.0))}};
        amplitude(file).push_back(point);
        if (i % 3 == 0)
            frequency(file).push_back({{"time", digits(time)}, {"frequency", digits(random.uniform(0.0, 1.0))}});
        if (random.next() % 8 != 0)
            time += random.uniform(0.002, 0.3);
    }
    return file;
}
} // namespace

TEST_CASE(".haptic: what all readers refuse is an error with its place", "[io][formats]")
{
    const std::string envelopes = "signals.continuous.envelopes.";
    REQUIRE(errorAfter([](Json&) {}) == "");
    const auto starts = [](const std::string& text, const std::string& start)
    {
        INFO(text);
        return text.starts_with(start);
    };
    CHECK(starts(errorAfter([](Json& f) { f.erase("version"); }), "version: is missing"));
    for (const char* version : {"2.0.0", "10.0.0", "v1", ""})
        CHECK(starts(errorAfter([&](Json& f) { f["version"] = version; }), "version: must begin with 1"));
    for (const Json& version : {Json(1), Json(nullptr), Json::array({1, 0, 0})})
        CHECK(starts(errorAfter([&](Json& f) { f["version"] = version; }), "version: must be an object"));
    CHECK(starts(errorAfter([](Json& f) { f["version"]["major"] = 2; }), "version.major: is 2"));
    CHECK(starts(errorAfter([](Json& f) { f["version"]["major"] = 1.5; }), "version.major: "));
    CHECK(starts(errorAfter([](Json& f) { f["metadata"] = 3; }), "metadata"));
    CHECK(starts(errorAfter([](Json& f) { f["signals"] = nullptr; }), "signals"));
    CHECK(starts(errorAfter([](Json& f) { f["metadata"]["tags"] = {1}; }), "metadata.tags[0]: "));
    CHECK(starts(errorAfter([](Json& f) { f.erase("signals"); }), "signals: is missing"));
    CHECK(starts(errorAfter([](Json& f) { amplitude(f) = Json::array(); }), envelopes + "amplitude: has no point"));
    CHECK(starts(errorAfter([](Json& f) { amplitude(f) = 3; }), envelopes + "amplitude: must be a list"));
    CHECK(starts(errorAfter([](Json& f) { amplitude(f)[0]["time"] = -0.1; }), envelopes + "amplitude[0].time: "));
    CHECK(starts(errorAfter([](Json& f) { amplitude(f)[0]["time"] = 2.0; }), envelopes + "amplitude[1].time: "));
    CHECK(starts(errorAfter([](Json& f) { amplitude(f)[1]["time"] = "1"; }), envelopes + "amplitude[1].time: must be"));
    CHECK(starts(errorAfter([](Json& f) { amplitude(f)[1].erase("amplitude"); }),
                 envelopes + "amplitude[1].amplitude: is missing"));
    CHECK(starts(errorAfter([](Json& f) { amplitude(f)[1]["amplitude"] = 1.0001; }),
                 envelopes + "amplitude[1].amplitude: "));
    CHECK(starts(errorAfter([](Json& f) { amplitude(f)[0]["emphasis"]["amplitude"] = 0.4999; }),
                 envelopes + "amplitude[0].emphasis.amplitude: is below"));
    CHECK(starts(errorAfter([](Json& f) { amplitude(f)[0]["emphasis"]["frequency"] = "0.5"; }),
                 envelopes + "amplitude[0].emphasis.frequency: must be"));
    CHECK(starts(errorAfter([](Json& f) { frequency(f)[0]["time"] = 2.0; }),
                 envelopes + "frequency[1].time: is earlier"));
    CHECK(starts(errorAfter([](Json& f) { frequency(f)[0]["frequency"] = -0.1; }),
                 envelopes + "frequency[0].frequency: "));
    CHECK(starts(errorAfter([](Json& f) { amplitude(f)[1]["time"] = 1e30; }), envelopes + "amplitude[1].time: "));
}

TEST_CASE(".haptic: an emphasis that lacks a number is completed or left out, with a warning", "[io][formats]")
{
    const std::string place = "signals.continuous.envelopes.amplitude[0].emphasis";
    const auto readAfter = [](auto change)
    {
        Json file = plain();
        change(amplitude(file));
        auto read = readHaptic(file.dump());
        REQUIRE((read.ok() ? "" : read.error().text()) == "");
        return std::move(*read);
    };
    const auto empty = readAfter([](Json& points) { points[0]["emphasis"] = Json::object(); });
    CHECK(empty.clip.transients.empty());
    CHECK(empty.warnings == std::vector<std::string>{place + ": has neither amplitude nor frequency and is left out"});
    const auto both = readAfter([](Json& points) { points[0]["emphasis"] = points[1]["emphasis"] = Json::object(); });
    CHECK(both.warnings ==
          std::vector<std::string>{place + ": has neither amplitude nor frequency and is left out, like 1 more"});
    const auto weak = readAfter([](Json& points) { points[0]["emphasis"] = {{"frequency", 0.25}}; });
    CHECK(weak.clip.transients == std::vector<Transient>{{0.0, 0.5, 0.25}});
    CHECK(weak.warnings == std::vector<std::string>{place + ".amplitude: is missing; that of its point is taken"});
    const auto dull = readAfter([](Json& points) { points[0]["emphasis"] = {{"amplitude", 0.75}}; });
    CHECK(dull.clip.transients == std::vector<Transient>{{0.0, 0.75, 0.5}});
    CHECK(dull.warnings == std::vector<std::string>{place + ".frequency: is missing; 0.5 is taken"});
}

TEST_CASE(".haptic: a version that is a text is read with a warning", "[io][formats]")
{
    const auto usual = readHaptic(plain().dump());
    REQUIRE(usual.ok());
    for (const char* version : {"1.0.0", "1", "1.2"})
    {
        Json file = plain();
        file["version"] = version;
        const auto read = readHaptic(file.dump());
        REQUIRE(read.ok());
        CHECK(read->clip == usual->clip);
        CHECK(read->warnings == std::vector<std::string>{"version: is a text; it is read as numbers"});
    }
}

TEST_CASE(".haptic: what some reader takes is taken", "[io][formats]")
{
    CHECK(errorAfter([](Json& f) { amplitude(f).erase(1); }) == "");
    CHECK(warnsAfter([](Json& f) { amplitude(f).erase(1); }));
    CHECK(warnsAfter([](Json& f) { amplitude(f)[1]["time"] = 0.0; }));
    CHECK(warnsAfter([](Json& f) { frequency(f)[1]["time"] = 1.5; }));
    CHECK(warnsAfter([](Json& f) { f["metadata"]["author"] = "somebody"; }));
    CHECK_FALSE(warnsAfter([](Json& f) { amplitude(f)[0]["emphasis"]["amplitude"] = 0.5; }));
    CHECK_FALSE(warnsAfter(
        [](Json& f)
        {
            amplitude(f)[0]["time"] = 0.5;
            frequency(f)[0]["time"] = 0.5;
        }));
    CHECK_FALSE(warnsAfter(
        [](Json& f)
        {
            f["unknown"] = 1;
            amplitude(f)[0]["unknown"] = 2;
        }));
    for (const Json& none : {Json(), Json::array()})
        CHECK_FALSE(warnsAfter([&](Json& f) { frequency(f) = none; }));
    CHECK_FALSE(warnsAfter([](Json& f) { f["signals"]["continuous"]["envelopes"].erase("frequency"); }));
    CHECK(warnsAfter([](Json& f) { f["version"]["minor"] = 3; }));
    CHECK_FALSE(warnsAfter(
        [](Json& f)
        {
            f.erase("metadata");
            f["version"] = {{"major", 1}};
        }));
}

TEST_CASE(".haptic: texts that are no JSON are refused where they go wrong", "[io][formats]")
{
    const std::string good = plain().dump();
    const auto refused = [](const std::string& text)
    {
        const auto read = readHaptic(text);
        return !read.ok() && !read.error().message.empty();
    };
    REQUIRE_FALSE(refused(good));
    CHECK(refused(""));
    CHECK_FALSE(refused("\xEF\xBB\xBF" + good)); // as some editors on Windows save it
    CHECK(refused("{\xEF\xBB\xBF" + good.substr(1)));
    CHECK(refused(std::string("\xFF\xFE{\0", 4)));
    CHECK(refused(good.substr(0, good.size() / 2)));
    CHECK(refused(std::string(good).replace(good.find("}]"), 2, "},]")));
    CHECK(refused(std::string(good).replace(good.find("0.25"), 4, "NaN")));
    CHECK(refused(std::string(good).replace(good.find("0.25"), 4, "1e999")));
    CHECK(refused(std::string(100'000, '[')));
    CHECK(refused("[]"));
}

TEST_CASE(".haptic: a clip is read as one band, in Hz, with events", "[io][formats]")
{
    Json file = plain();
    file["metadata"]["source"] = "C:\\sounds\\door.wav";
    file["metadata"]["project"] = "door";
    const auto read = readHaptic(file.dump());
    REQUIRE(read.ok());
    const Clip& clip = read->clip;
    REQUIRE(clip.duration == 1.0);
    REQUIRE(clip.source.file == "door.wav");
    REQUIRE(clip.name == "door");
    REQUIRE(clip.bands.size() == 1);
    REQUIRE(clip.bands[0].amplitude == Curve{{0.0, 0.5}, {1.0, 0.25}});
    REQUIRE(clip.bands[0].pitch == Curve{{0.0, 127.5}, {1.0, 200.0}});
    REQUIRE(clip.transients.size() == 1);
    REQUIRE(std::abs(clip.transients[0].amplitude - 0.7) < 1e-6);
    REQUIRE(std::abs(clip.transients[0].sharpness - 0.2) < 1e-6);
}

TEST_CASE(".haptic: files come back from clips point by point", "[io][formats]")
{
    for (std::uint64_t seed = 1; seed <= 100; ++seed)
    {
        CAPTURE(seed);
        Json file = randomFile(seed);
        const auto read = readHaptic(file.dump());
        REQUIRE((read.ok() ? "" : read.error().text()) == "");
        const std::string text = written(read->clip);
        REQUIRE(brokenRule(text) == "");
        Json back = Json::parse(text);
        // What ends with an emphasis goes on silently until that has sounded, in at most two more points.
        const double end = amplitude(file).back()["time"].get<double>();
        REQUIRE(amplitude(back).size() >= amplitude(file).size());
        REQUIRE(amplitude(back).size() <= amplitude(file).size() + (read->clip.duration > end + 1e-3 ? 2u : 0u));
        for (std::size_t i = amplitude(file).size(); i < amplitude(back).size(); ++i)
            REQUIRE((amplitude(back)[i]["amplitude"] == 0.0 && amplitude(back)[i]["time"].get<double>() > end - 1e-3));
        for (std::size_t i = 0; i < amplitude(file).size(); ++i)
        {
            const Json& a = amplitude(file)[i];
            const Json& b = amplitude(back)[i];
            REQUIRE(std::abs(a["time"].get<double>() - b["time"].get<double>()) < 0.5e-3);
            REQUIRE(std::abs(a["amplitude"].get<double>() - b["amplitude"].get<double>()) < 1.0 / 255.0);
        }
        std::size_t before = 0, after = 0;
        for (const Json& point : amplitude(file))
            before += point.contains("emphasis");
        for (const Json& point : amplitude(back))
            after += point.contains("emphasis");
        REQUIRE(after == before);
        const auto again = readHaptic(text);
        REQUIRE(again.ok());
        REQUIRE(again->warnings.empty());
        REQUIRE(written(again->clip) == text);
    }
}

TEST_CASE(".haptic: any clip is written by the strictest rules", "[io][formats]")
{
    for (std::uint64_t seed = 0; seed < 200; ++seed)
    {
        CAPTURE(seed);
        const Clip clip = test::randomFullClip(seed);
        const std::string text = written(clip);
        REQUIRE(brokenRule(text) == "");
        const Clip back = readHaptic(text)->clip;
        REQUIRE(
            back.transients.size() ==
            (isSingleVoice(clip) ? clip.transients.size() : separated(clip.transients, questPlayer.separation).size()));
        for (const Transient& emphasis : back.transients)
            REQUIRE(std::any_of(clip.transients.begin(), clip.transients.end(),
                                [&](const Transient& event) { return std::abs(event.time - emphasis.time) < 1e-4; }));
        REQUIRE(back.transients.size() <= clip.transients.size());
        REQUIRE(written(clip) == text);
    }
    Clip empty;
    REQUIRE(brokenRule(written(empty)) == "");
    empty.transients = {{0.0, 3.0, 0.5}, {0.0, 0.0, 0.5}};
    REQUIRE(brokenRule(written(empty)) == "");
    Clip day;
    day.duration = 86400.0;
    day.transients = {{86399.9995, 1.0, 0.0}, {86399.9996, 1.0, 0.0}};
    REQUIRE(brokenRule(written(day)) == "");
}

TEST_CASE(".haptic: points are at most as many as asked for, and what they lose is said", "[io][formats]")
{
    Clip clip;
    clip.duration = 4.0;
    clip.bands = {{50.0, 100.0, 200.0, 0, {}, {}}};
    Random random(7);
    for (int i = 0; i <= 4000; ++i)
        clip.bands[0].amplitude.push_back({0.001 * i, random.uniform(0.0, 1.0)});
    clip.envelope = clip.bands[0].amplitude;
    ExportParams params;
    params.amplitudePoints = 20.0;
    Json file = Json::parse(written(clip, params));
    REQUIRE(amplitude(file).size() <= 80);
    REQUIRE(amplitude(file).size() > 70);
    const auto losses = writeHaptic(clip, params)->losses;
    REQUIRE(std::any_of(losses.begin(), losses.end(),
                        [](const FormatLoss& loss) { return loss.kind == LossKind::points && loss.error > 0.3; }));
    Json usual = Json::parse(written(clip));
    REQUIRE(amplitude(usual).size() <= 160);
}

TEST_CASE(".haptic: frequencies beyond the range move to its end, and a profile sets the range", "[io][formats]")
{
    Clip clip;
    clip.duration = 1.0;
    clip.bands = {{50.0, 400.0, 500.0, 0, {{0.0, 1.0}, {1.0, 1.0}}, {}}};
    const auto exported = writeHaptic(clip, {});
    Json file = Json::parse(exported->files[0].bytes);
    REQUIRE(frequency(file)[0]["frequency"] == 1.0);
    REQUIRE(exported->losses.size() == 1);
    REQUIRE(exported->losses[0].kind == LossKind::frequency);
    REQUIRE(std::abs(exported->losses[0].error - 1.0) < 1e-9); // 400 Hz are an octave above 200 Hz
    ExportParams params;
    params.profile.emplace();
    params.profile->technology = Technology::pcm;
    params.profile->range.lowFrequency = 200.0;
    params.profile->range.highFrequency = 600.0;
    Json wide = Json::parse(written(clip, params));
    REQUIRE(std::abs(frequency(wide)[0]["frequency"].get<double>() - 0.5) < 1e-6);
}
