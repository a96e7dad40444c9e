#include "io/formats/LossList.h"

#include "io/formats/VoiceReduction.h"
#include "support/Catch.h"

#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;

namespace
{
std::vector<FormatLoss> lossesOf(const std::function<void(LossList&)>& add)
{
    LossList losses;
    add(losses);
    return std::move(losses).sorted();
}
} // namespace

TEST_CASE("Missing points are lost where they are missed, not everywhere", "[formats]")
{
    const Curve before{{0.0, 0.2}, {1.0, 0.2}, {1.1, 0.8}, {1.2, 0.2}, {3.0, 0.2}, {3.1, 0.5}, {3.2, 0.2}, {4.0, 0.2}};
    const Curve after{{0.0, 0.2}, {4.0, 0.2}};
    const auto losses = lossesOf([&](LossList& list) { list.addThinned(before, after); });
    REQUIRE(losses.size() == 2);
    CHECK(losses[0].kind == LossKind::points);
    CHECK(losses[0].time == 1.1);
    CHECK(losses[0].error == Approx(0.6));
    CHECK(losses[1].time == 3.1);
    CHECK(losses[1].error == Approx(0.3));
}

TEST_CASE("A step that is kept loses no points", "[formats]")
{
    const Curve step{{0.0, 0.2}, {1.0, 0.2}, {1.0, 0.9}, {2.0, 0.9}};
    CHECK(lossesOf([&](LossList& list) { list.addThinned(step, step); }).empty());
}

TEST_CASE("A part too weak to be felt is empty, a short one and one with an event are not", "[formats]")
{
    SingleVoice voice;
    voice.duration = 6.0;
    voice.amplitude = {{0.0, 0.5},   {1.0, 0.5},   {1.0, 0.001}, {1.2, 0.001}, {1.2, 0.5},   {2.0, 0.5},
                       {2.0, 0.001}, {3.0, 0.001}, {3.0, 0.5},   {4.0, 0.5},   {4.0, 0.001}, {6.0, 0.001}};
    voice.events = {{2.5, 0.7, 0.5}};
    const auto losses = lossesOf([&](LossList& list) { addEmptyParts(list, voice); });
    REQUIRE(losses.size() == 1);
    CHECK(losses[0].kind == LossKind::empty);
    CHECK(losses[0].time == 4.0);
    CHECK(losses[0].duration == 2.0);
    CHECK(losses[0].error == 0.001);
}

TEST_CASE("Silence that is meant is no loss, but a clip of nothing else is", "[formats]")
{
    SingleVoice voice;
    voice.duration = 3.0;
    voice.amplitude = {{0.0, 0.5}, {1.0, 0.0}, {2.0, 0.0}, {3.0, 0.5}};
    CHECK(lossesOf([&](LossList& list) { addEmptyParts(list, voice); }).empty());
    voice.amplitude = {{0.0, 0.0}, {3.0, 0.0}};
    const auto losses = lossesOf([&](LossList& list) { addEmptyParts(list, voice); });
    REQUIRE(losses.size() == 1);
    CHECK(losses[0].duration == 3.0);
}

TEST_CASE("Amplitudes and events above the most are cut and named where they are", "[formats]")
{
    SingleVoice voice;
    voice.duration = 2.0;
    voice.amplitude = {{0.0, 0.5}, {1.0, 1.5}, {2.0, 0.5}};
    voice.events = {{0.5, 2.0, 0.5}};
    LossList list;
    list.limit(voice.amplitude, 1.0);
    list.limit(voice.events, 1.0);
    CHECK(voice.amplitude[1].value == 1.0);
    CHECK(voice.events[0].amplitude == 1.0);
    const auto losses = std::move(list).sorted();
    REQUIRE(losses.size() == 2);
    CHECK(losses[0].time == 0.5);
    CHECK(losses[0].error == 1.0);
    CHECK(losses[1].time == 1.0);
    CHECK(losses[1].error == 0.5);
}

TEST_CASE("Events nearer than they can be played are named each", "[formats]")
{
    const std::vector<Transient> events{{0.1, 1.0, 0.5}, {0.105, 0.6, 0.5}, {0.5, 1.0, 0.5}, {0.507, 0.4, 0.5}};
    const auto losses = lossesOf([&](LossList& list) { list.addCrowding(events, 0.01); });
    REQUIRE(losses.size() == 2);
    CHECK(losses[0].time == 0.105);
    CHECK(losses[0].error == 0.6);
    CHECK(losses[1].time == 0.507);
    CHECK(losses[1].error == 0.4);
    CHECK(losses[0].message == "events less than 10 ms apart overlap");
    CHECK(lossesOf([&](LossList& list) { list.addCrowding(events, 0.0055); }).at(0).message.find("5.5 ms") !=
          std::string::npos);
}

TEST_CASE("Noise is lost where it sounds, as strong as it is, each band for itself", "[formats]")
{
    Clip clip;
    clip.duration = 4.0;
    clip.noise = {{100.0, 200.0, {{0.0, 0.0}, {1.0, 0.0}, {1.0, 0.3}, {2.0, 0.3}, {2.0, 0.0}, {4.0, 0.0}}},
                  {200.0, 400.0, {{2.5, 0.0}, {3.0, 0.2}, {3.5, 0.0}}},
                  {400.0, 800.0, {{0.0, 0.001}}}}; // too weak to be told from silence
    const auto losses = lossesOf([&](LossList& list) { list.addNoise(clip); });
    REQUIRE(losses.size() == 2);
    CHECK(losses[0].kind == LossKind::noise);
    CHECK(losses[0].time == 1.0);
    CHECK(losses[0].duration == 1.0);
    CHECK(losses[0].error == 0.3);
    CHECK(losses[0].message.find("100 to 200 Hz") != std::string::npos);
    CHECK(losses[1].time == 2.5);
    CHECK(losses[1].duration == 1.0);
    CHECK(losses[1].error == 0.2);
}

TEST_CASE("Events that lose the same are one loss, from the first to the last", "[formats]")
{
    SingleVoice voice;
    voice.duration = 1.0;
    voice.amplitude = {{0.0, 0.5}, {1.0, 0.5}};
    voice.events = {{0.25, 1.0, 0.5}, {0.5, 0.6, 0.5}, {0.75, 1.0, 0.5}};
    const auto losses = lossesOf([&](LossList& list) { addStrengthLosses(list, {}, voice); });
    REQUIRE(losses.size() == 1);
    CHECK(losses[0].kind == LossKind::event);
    CHECK(losses[0].time == 0.25);
    CHECK(losses[0].duration == 0.5);
    CHECK(losses[0].error == 0.0);
}
