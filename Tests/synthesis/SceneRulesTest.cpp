#include "support/Catch.h"
#include "support/Numbers.h"

#include <pacini/synthesis/Scene.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace pacini;

namespace
{
Scene ruledScene()
{
    Scene scene;
    Clip clip;
    clip.duration = 2.0;
    scene.clips = {clip, clip};
    scene.clips[1].duration = 86400.0;
    scene.plays.resize(2);
    scene.changes.resize(2);
    return scene;
}

/// `where: message` of the first broken rule, or nothing.
template <typename Change>
std::string broken(Change&& change)
{
    Scene scene = ruledScene();
    change(scene);
    const auto valid = validate(scene);
    return valid ? "" : valid.error().where + ": " + valid.error().message;
}

template <typename Change>
ErrorCode codeOf(Change&& change)
{
    Scene scene = ruledScene();
    change(scene);
    const auto valid = validate(scene);
    REQUIRE_FALSE(valid.ok());
    return valid.error().code;
}

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
} // namespace

TEST_CASE("What a scene, a play and a change are unless told otherwise", "[scene]")
{
    const Scene scene;
    CHECK(scene.duration == 0.0);
    CHECK(scene.gain == 0.0);
    CHECK(scene.actuators == 1);
    CHECK(scene.panLaw == PanLaw::constantPower);
    CHECK(scene.panDelay == 0.01);
    const ScenePlay play;
    CHECK(test::asNumbers(play.clip, play.start, play.loop, play.passes, play.gain, play.pan, play.transposition) ==
          test::Numbers{0, 0.0, 0.0, 0, 0.0, 0.5, 0.0});
    CHECK(test::asNumbers(play.stretch, play.tones, play.events, play.noise, play.priority, play.variation.amount) ==
          test::Numbers{1.0, 0.0, 0.0, 0.0, 0, 0.0});
    CHECK(play.variation.scope == VariationScope::breakpoint);
    CHECK(play.variation.seed == 0);
    const SceneChange change;
    CHECK(change.time == 0.0);
    CHECK(change.play == 0);
    CHECK(change.parameter == SceneParameter::gain);
    CHECK(change.value == 0.0);
    CHECK(change.glide == 0.005);
    CHECK(limits::plays == 10000);
    CHECK(limits::sceneChanges == 1000000);
    CHECK(limits::shortestLoop == 0.005);
    CHECK(limits::actuators == 16);
    CHECK(limits::silentGain == -120.0);
}

TEST_CASE("A gain of a scene is linear, and nothing at -120 dB and below", "[scene]")
{
    CHECK(sceneGain(0.0) == 1.0);
    CHECK(sceneGain(20.0) == Approx(10.0));
    CHECK(sceneGain(-6.0) == Approx(0.501187));
    CHECK(sceneGain(-119.99) == Approx(1.0011519e-6));
    CHECK(sceneGain(-120.0) == 0.0);
    CHECK(sceneGain(-1000.0) == 0.0);
}

TEST_CASE("Each parameter of a play has its range, ends included", "[scene]")
{
    struct Range
    {
        SceneParameter parameter;
        double low, high;
    };
    for (const Range& range :
         {Range{SceneParameter::gain, -1000.0, 60.0}, Range{SceneParameter::pan, 0.0, 1.0},
          Range{SceneParameter::delay, 0.0, 1.0}, Range{SceneParameter::transposition, -96.0, 96.0},
          Range{SceneParameter::stretch, 0.01, 100.0}, Range{SceneParameter::tones, -1000.0, 60.0},
          Range{SceneParameter::events, -1000.0, 60.0}, Range{SceneParameter::noise, -1000.0, 60.0}})
    {
        CAPTURE(range.low, range.high);
        CHECK(inRange(range.parameter, range.low));
        CHECK(inRange(range.parameter, range.high));
        CHECK(inRange(range.parameter, 0.5));
        CHECK_FALSE(inRange(range.parameter, std::nextafter(range.low, -2000.0)));
        CHECK_FALSE(inRange(range.parameter, std::nextafter(range.high, 2000.0)));
        CHECK_FALSE(inRange(range.parameter, notANumber));
    }
    CHECK_FALSE(inRange(static_cast<SceneParameter>(10), 0.5));
}

TEST_CASE("A scene keeps its rules to the last value that each of them allows", "[scene]")
{
    const double day = 86400.0;
    CHECK(broken([](Scene&) {}) == "");
    CHECK(broken([&](Scene& s) { s.duration = day; }) == "");
    CHECK(broken([](Scene& s) { s.gain = 60.0; }) == "");
    CHECK(broken([](Scene& s) { s.actuators = 16; }) == "");
    CHECK(broken([](Scene& s) { s.panDelay = 0.1; }) == "");
    CHECK(broken([](Scene& s) { s.panDelay = 0.0; }) == "");
    CHECK(broken([](Scene& s) { s.plays.resize(10000); }) == "");
    CHECK(broken([](Scene& s) { s.plays[1].clip = 1; }) == "");
    CHECK(broken([&](Scene& s) { s.plays[1].start = day; }) == "");
    CHECK(broken(
              [](Scene& s)
              {
                  s.plays[1].loop = 0.005;
                  s.plays[1].passes = 1;
              }) == "");
    CHECK(broken(
              [](Scene& s)
              {
                  s.plays[1].loop = 2.0;
                  s.plays[1].passes = 1;
              }) == "");
    CHECK(broken(
              [](Scene& s)
              {
                  s.plays[1].loop = 2.0;
                  s.duration = 5.0;
              }) == "");
    CHECK(broken(
              [&](Scene& s)
              {
                  s.plays[1].clip = 1;
                  s.plays[1].loop = day;
                  s.plays[1].passes = 1;
              }) == "");
    CHECK(broken([](Scene& s) { s.plays[1].variation.amount = 1.0; }) == "");
    CHECK(broken([](Scene& s) { s.changes.resize(1'000'000); }) == "");
    CHECK(broken([&](Scene& s) { s.changes[0].time = s.changes[1].time = day; }) == "");
    CHECK(broken([](Scene& s) { s.changes[1].play = 1; }) == "");
    CHECK(broken([&](Scene& s) { s.changes[1].glide = day; }) == "");
    CHECK(broken(
              [](Scene& s)
              {
                  s.plays.clear();
                  s.changes.clear();
                  s.clips.clear();
              }) == "");
}

TEST_CASE("A scene says in plain words which rule it breaks, and where", "[scene]")
{
    const std::string outsideADay = "is outside 0 to 86400";
    const double late = std::nextafter(86400.0, 1e6);
    CHECK(broken([&](Scene& s) { s.duration = late; }) == "duration: " + outsideADay);
    CHECK(broken([](Scene& s) { s.duration = -1e-9; }) == "duration: " + outsideADay);
    CHECK(broken([](Scene& s) { s.gain = 60.1; }) == "gain: must be -1000 to 60 dB");
    CHECK(broken([](Scene& s) { s.actuators = 0; }) == "actuators: must be 1 to 16");
    CHECK(broken([](Scene& s) { s.actuators = 17; }) == "actuators: must be 1 to 16");
    CHECK(broken([](Scene& s) { s.panDelay = -0.001; }) == "panDelay: is outside 0 to 0.1");
    CHECK(broken([](Scene& s) { s.panDelay = 0.101; }) == "panDelay: is outside 0 to 0.1");
    CHECK(broken([](Scene& s) { s.plays.resize(10001); }) == "plays: has more than 10000 plays");
    CHECK(codeOf([](Scene& s) { s.plays.resize(10001); }) == ErrorCode::tooLarge);
    CHECK(broken([](Scene& s) { s.clips[1].duration = notANumber; }) == "clips[1].duration: is not a finite number");
    CHECK(codeOf([](Scene& s) { s.clips[1].duration = notANumber; }) == ErrorCode::notFinite);
    CHECK(broken([](Scene& s) { s.plays[1].clip = 2; }) == "plays[1].clip: is not one of the scene's 2 clips");
    CHECK(codeOf([](Scene& s) { s.plays[1].clip = 2; }) == ErrorCode::invalidData);
    CHECK(broken([&](Scene& s) { s.plays[1].start = late; }) == "plays[1].start: " + outsideADay);
    CHECK(broken([](Scene& s) { s.plays[1].start = -1.0; }) == "plays[1].start: " + outsideADay);
    const std::string once = "plays[1].loop: must be 0 (play once) or 0.005 s and longer";
    for (const double loop : {0.00499, -0.005, -1.0, notANumber})
        CHECK(broken(
                  [&](Scene& s)
                  {
                      s.plays[1].loop = loop;
                      s.plays[1].passes = 1;
                  }) == once);
    CHECK(broken(
              [&](Scene& s)
              {
                  s.plays[1].loop = late;
                  s.plays[1].passes = 1;
              }) == once);
    CHECK(broken(
              [](Scene& s)
              {
                  s.plays[1].loop = 2.001;
                  s.plays[1].passes = 1;
              }) == "plays[1].loop: is longer than the clip");
    CHECK(broken([](Scene& s) { s.plays[1].loop = 1.0; }) ==
          "plays[1].passes: is needed, or a duration of the scene: the loop would never end");
    CHECK(broken([](Scene& s) { s.plays[1].gain = 61.0; }) == "plays[1].gain: must be -1000 to 60 dB");
    CHECK(broken([](Scene& s) { s.plays[1].pan = -0.1; }) == "plays[1].pan: must be 0 to 1");
    CHECK(broken([](Scene& s) { s.plays[1].transposition = 97.0; }) ==
          "plays[1].transposition: must be -96 to 96 semitones");
    CHECK(broken([](Scene& s) { s.plays[1].stretch = 101.0; }) == "plays[1].stretch: must be 0.01 to 100");
    CHECK(broken([](Scene& s) { s.plays[1].variation.amount = 1.1; }) == "plays[1].variation: is outside 0 to 1");
    CHECK(broken([](Scene& s) { s.plays[1].variation.amount = -0.1; }) == "plays[1].variation: is outside 0 to 1");
    CHECK(broken([](Scene& s) { s.changes.resize(1'000'001); }) == "changes: has more than 1000000 changes");
    CHECK(codeOf([](Scene& s) { s.changes.resize(1'000'001); }) == ErrorCode::tooLarge);
    CHECK(broken([](Scene& s) { s.changes[0].time = -1e-9; }) == "changes[0].time: " + outsideADay);
    CHECK(broken([&](Scene& s) { s.changes[1].time = late; }) == "changes[1].time: " + outsideADay);
    CHECK(broken(
              [](Scene& s)
              {
                  s.changes[0].time = 1.0;
                  s.changes[1].time = 0.999;
              }) == "changes[1].time: is earlier than the change before it");
    CHECK(broken([](Scene& s) { s.changes[1].play = 2; }) == "changes[1].play: is not one of the scene's plays");
    CHECK(broken([](Scene& s) { s.changes[1].value = 61.0; }) == "changes[1].value: must be -1000 to 60 dB");
    CHECK(broken(
              [](Scene& s) {
                  s.changes[1] = {0.0, 0, SceneParameter::stretch, 0.0, 0.0};
              }) == "changes[1].value: must be 0.01 to 100");
    CHECK(broken([&](Scene& s) { s.changes[1].glide = late; }) == "changes[1].glide: " + outsideADay);
    CHECK(broken([](Scene& s) { s.changes[1].glide = -1.0; }) == "changes[1].glide: " + outsideADay);
    // A change that is out of order late in the list, after two in order.
    CHECK(broken(
              [](Scene& s) {
                  s.changes = {{0.1, 0}, {0.5, 0}, {0.3, 0}};
              }) == "changes[2].time: is earlier than the change before it");
}
