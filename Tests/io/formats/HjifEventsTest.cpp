// Events of a clip are events of its HJIF file, and sound no louder there.

#include "io/formats/DemoSounds.h"
#include "io/formats/hjif/HjifFormat.h"
#include "io/formats/players/HjifPlayer.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
std::string hjifOf(const Clip& clip, EventExport events = EventExport::transients)
{
    ExportParams params;
    params.events = events;
    const auto exported = writeHjif(clip, params);
    REQUIRE(exported);
    return exported->files.at(0).bytes;
}

/// Times of the effects of all Transient bands, ms.
std::vector<double> transientTimes(const std::string& text)
{
    std::vector<double> times;
    const auto root = nlohmann::json::parse(text);
    for (const auto& band : root.at("perceptions").at(0).at("channels").at(0).at("bands"))
        if (band.at("band_type") == "Transient")
            for (const auto& effect : band.at("effects"))
                times.push_back(effect.at("position").get<double>());
    return times;
}

double gapAround(const std::vector<Transient>& events, std::size_t i)
{
    double gap = limits::duration;
    if (i > 0)
        gap = events[i].time - events[i - 1].time;
    return i + 1 < events.size() ? std::min(gap, events[i + 1].time - events[i].time) : gap;
}

double powerOf(const std::vector<float>& samples, double fs, double from, double to)
{
    double power = 0.0;
    const auto end = std::min(static_cast<std::size_t>(to * fs), samples.size());
    for (auto n = static_cast<std::size_t>(std::max(from, 0.0) * fs); n < end; ++n)
        power += static_cast<double>(samples[n]) * static_cast<double>(samples[n]);
    return power;
}

/// One band of 300 Hz whose sum is levelled to `level`, and an event.
Clip clipWithEvent(double level, double event)
{
    Clip clip;
    clip.duration = 1.0;
    clip.envelope = {{0.0, level}, {1.0, level}};
    clip.bands.push_back({280.0, 300.0, 320.0, 0, {{0.0, level}, {1.0, level}}, {}});
    clip.transients = {{0.5, event, 0.4}};
    return clip;
}
} // namespace

TEST_CASE("All events of a clip come back from its HJIF file", "[formats]")
{
    for (const test::DemoSound& sound : test::demoSounds())
    {
        CAPTURE(sound.name);
        const auto& events = sound.clip.transients;
        const auto read = readHjif(hjifOf(sound.clip));
        REQUIRE(read);
        REQUIRE(read->clip.transients.size() == events.size());
        for (std::size_t i = 0; i < events.size(); ++i)
        {
            CAPTURE(i, events[i].time);
            CHECK(read->clip.transients[i].time == Approx(events[i].time).margin(0.00051));
            if (gapAround(events, i) >= 0.06)
                CHECK(read->clip.transients[i].sharpness == Approx(events[i].sharpness).margin(0.003));
        }
    }
}

TEST_CASE("Events are transients of HJIF but where these would fill the gaps of a train", "[formats]")
{
    std::size_t all = 0, transients = 0;
    for (const test::DemoSound& sound : test::demoSounds())
    {
        CAPTURE(sound.name);
        const auto& events = sound.clip.transients;
        const std::vector<double> times = transientTimes(hjifOf(sound.clip));
        for (std::size_t i = 0; i < events.size(); ++i)
        {
            const bool is = std::find(times.begin(), times.end(), std::round(1000.0 * events[i].time)) != times.end();
            CAPTURE(events[i].time);
            CHECK((is || gapAround(events, i) < 0.06));
            ++all;
            transients += is ? 1 : 0;
        }
    }
    CAPTURE(all, transients);
    CHECK(static_cast<double>(transients) > 0.8 * static_cast<double>(all));
}

TEST_CASE("A merged event is as strong in HJIF as beside the bands, not on top of them", "[formats]")
{
    constexpr double fs = 8000.0;
    for (const test::DemoSound& sound : test::demoSounds())
    {
        CAPTURE(sound.name);
        const std::vector<float> own = test::decoded(sound.clip, static_cast<int>(fs));
        const std::vector<float> exported = test::playHjif(hjifOf(sound.clip, EventExport::merged), fs);
        double wanted = 0.0, found = 0.0;
        for (const Transient& event : sound.clip.transients)
        {
            wanted += powerOf(own, fs, event.time - 0.005, event.time + 0.03);
            found += powerOf(exported, fs, event.time - 0.005, event.time + 0.03);
        }
        CHECK(10.0 * std::log10(found / wanted) == Approx(0.0).margin(1.5));
    }
}

TEST_CASE("An event of any sharpness is a transient of HJIF that keeps its strength and amplitude", "[formats]")
{
    constexpr double fs = 8000.0;
    for (const double sharpness : {0.0, 0.2, 0.21, 0.4, 0.6, 0.8, 1.0})
    {
        CAPTURE(sharpness);
        Clip clip;
        clip.duration = 1.0;
        clip.transients = {{0.5, 0.6, sharpness}};
        const std::string text = hjifOf(clip);
        CHECK(transientTimes(text) == std::vector<double>{500.0});
        const auto read = readHjif(text);
        REQUIRE(read);
        REQUIRE(read->clip.transients.size() == 1);
        CHECK(read->clip.transients.front().amplitude == Approx(0.6).margin(0.015));
        CHECK(read->clip.transients.front().sharpness == Approx(sharpness).margin(0.003));
        const double wanted = powerOf(test::decoded(clip, static_cast<int>(fs)), fs, 0.49, 0.55);
        CHECK(10.0 * std::log10(powerOf(test::playHjif(text, fs), fs, 0.49, 0.55) / wanted) == Approx(0.0).margin(1.0));
    }
}

TEST_CASE("A merged event that the bands reach is an event of HJIF that adds nothing", "[formats]")
{
    constexpr double fs = 8000.0;
    const auto levelAround = [](const std::vector<float>& samples)
    {
        return 10.0 * std::log10(powerOf(samples, fs, 0.5, 0.55) / (0.05 * fs));
    };
    const Clip covered = clipWithEvent(0.4, 0.7); // bands peak at up to twice their envelope
    Clip without = covered;
    without.transients.clear();
    CHECK(transientTimes(hjifOf(covered, EventExport::merged)) == std::vector<double>{500.0});
    CHECK(levelAround(test::playHjif(hjifOf(covered, EventExport::merged), fs)) ==
          Approx(levelAround(test::playHjif(hjifOf(without), fs))).margin(0.3));

    const Clip above = clipWithEvent(0.1, 0.9);
    CHECK(transientTimes(hjifOf(above)) == std::vector<double>{500.0});
    CHECK(levelAround(test::playHjif(hjifOf(above), fs)) ==
          Approx(levelAround(test::decoded(above, static_cast<int>(fs)))).margin(1.0));
}

TEST_CASE("An HJIF file of the demo sounds takes few bytes", "[formats]")
{
    double bytes = 0.0, seconds = 0.0;
    for (const test::DemoSound& sound : test::demoSounds())
    {
        const std::string text = hjifOf(sound.clip);
        CAPTURE(sound.name, text.size());
        CHECK(static_cast<double>(text.size()) < 30e3 * sound.clip.duration); // a roll of 44 strokes takes most
        bytes += static_cast<double>(text.size());
        seconds += sound.clip.duration;
    }
    CAPTURE(bytes, seconds);
    CHECK(bytes < 12e3 * seconds);
}

TEST_CASE("Most events are Transients of HJIF of a quarter of their amplitude, the others are losses", "[formats]")
{
    std::size_t all = 0, taps = 0;
    for (const test::DemoSound& sound : test::demoSounds())
    {
        CAPTURE(sound.name);
        ExportParams params;
        params.events = EventExport::transients;
        const auto exported = writeHjif(sound.clip, params);
        REQUIRE(exported);
        const auto lost = static_cast<std::size_t>(std::count_if(exported->losses.begin(), exported->losses.end(),
                                                                 [](const FormatLoss& loss)
                                                                 { return loss.kind == LossKind::transient; }));
        const auto root = nlohmann::json::parse(exported->files.at(0).bytes);
        const auto& channel = root.at("perceptions").at(0).at("channels").at(0);
        std::size_t strong = 0;
        for (const auto& band : channel.at("bands"))
            if (band.at("band_type") == "Transient")
                for (const auto& effect : band.at("effects"))
                    for (const Transient& event : sound.clip.transients)
                        strong += std::round(1000.0 * event.time) == effect.at("position").get<double>() &&
                                          effect.at("keyframes").at(0).at("amplitude_modulation").get<double>() *
                                                  channel.at("gain").get<double>() >=
                                              0.245 * event.amplitude
                                      ? std::size_t{1}
                                      : std::size_t{0};
        CHECK(strong + lost == sound.clip.transients.size());
        all += sound.clip.transients.size();
        taps += strong;
    }
    CAPTURE(all, taps);
    CHECK(static_cast<double>(taps) > 0.8 * static_cast<double>(all));
}
