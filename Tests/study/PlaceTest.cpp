// Touches on several actuators and several at once, and what people say of them.

#include "study/Session.h"
#include "study/StudyFile.h"
#include "study/StudyTemplates.h"
#include "study/TrialPlayback.h"
#include "study/TrialSound.h"
#include "support/Catch.h"
#include "support/ShippedProfile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::study;

namespace
{
double energyOf(const std::vector<float>& samples)
{
    double sum = 0.0;
    for (const float x : samples)
        sum += static_cast<double>(x) * static_cast<double>(x);
    return sum;
}

std::size_t firstFelt(const std::vector<float>& samples)
{
    return static_cast<std::size_t>(std::find_if(samples.begin(), samples.end(), [](float x) { return x != 0.0f; }) -
                                    samples.begin());
}

Study placedAt(double position, PanLaw by, int actuators = 2)
{
    Study study = *makeStudy("place", {});
    study.row.actuators = actuators;
    for (Stimulus& one : study.stimuli)
        one.place = Place{position, by};
    return study;
}

PreparedStimulus preparedAt(double position, PanLaw by, int actuators = 2)
{
    StimulusMaker maker(placedAt(position, by, actuators), {});
    return maker.make(0).value();
}
} // namespace

TEST_CASE("A place by level keeps the power and has no delay; at an end the other actuator is still")
{
    const double whole = energyOf(preparedAt(0.0, PanLaw::constantPower).touch);
    for (const double position : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0})
    {
        INFO(position);
        const auto made = preparedAt(position, PanLaw::constantPower);
        REQUIRE(made.more.size() == 1);
        CHECK(energyOf(made.touch) + energyOf(made.more[0]) == Approx(whole).epsilon(1e-5));
        if (position > 0.0 && position < 1.0)
        {
            CHECK(firstFelt(made.touch) == firstFelt(made.more[0]));
            CHECK(std::sqrt(energyOf(made.more[0]) / energyOf(made.touch)) ==
                  Approx(std::tan(0.5 * 3.14159265358979 * position)).epsilon(1e-4));
        }
    }
    CHECK(energyOf(preparedAt(0.0, PanLaw::constantPower).more[0]) < 1e-12 * whole);
}

TEST_CASE("A place by delay has equal levels, and the farther actuator is late by the study's delay for the whole row")
{
    const auto left = preparedAt(0.0, PanLaw::delay), half = preparedAt(0.5, PanLaw::delay),
               quarter = preparedAt(0.25, PanLaw::delay);
    CHECK(energyOf(left.touch) == Approx(energyOf(left.more[0])).epsilon(1e-6));
    CHECK(firstFelt(left.more[0]) - firstFelt(left.touch) == 480); // 10 ms at 48 kHz
    CHECK(firstFelt(half.more[0]) == firstFelt(half.touch));
    CHECK(firstFelt(quarter.more[0]) - firstFelt(quarter.touch) == 240);
    const auto both = preparedAt(0.25, PanLaw::both);
    CHECK(firstFelt(both.more[0]) - firstFelt(both.touch) == 240);
    CHECK(energyOf(both.touch) > 4.0 * energyOf(both.more[0]));
    const auto three = preparedAt(1.0, PanLaw::both, 3);
    REQUIRE(three.more.size() == 2);
    CHECK(energyOf(three.touch) + energyOf(three.more[0]) < 1e-9 * energyOf(three.more[1]));
}

TEST_CASE("Every actuator plays its own signal of the same trial from the same sample on; without a place all do alike")
{
    Study study = placedAt(0.25, PanLaw::both);
    study.blocks[0].masking = false;
    StimulusMaker maker(study, {});
    const auto trials = trialsOf(study, 0, 0);
    auto trial = makeTrial(maker, trials[0], std::nullopt, 1);
    REQUIRE(trial);
    REQUIRE(trial->more.size() == 1);
    REQUIRE(trial->more[0].size() == trial->touch.size());
    const TrialSound wanted = *trial;
    TrialPlayback playback;
    playback.prepare(48000.0);
    playback.play(std::move(*trial));
    const std::size_t frames = wanted.touch.size() + 100;
    std::vector<float> left(frames), right(frames), first(frames), second(frames), third(frames, 1.0f);
    const std::array<std::span<float>, 3> touches{first, second, third};
    playback.process(left, right, touches);
    CHECK(std::equal(wanted.touch.begin(), wanted.touch.end(), first.begin()));
    CHECK(std::equal(wanted.more[0].begin(), wanted.more[0].end(), second.begin()));
    CHECK(energyOf(third) == 0.0);
    for (Stimulus& one : study.stimuli)
        one.place = std::nullopt;
    StimulusMaker plain(study, {});
    const auto made = plain.make(0);
    REQUIRE(made);
    CHECK(made->touch == made->more[0]);
}

TEST_CASE("A mix is the sum of its events, and stays within full drive however many there are")
{
    Study study = *makeStudy("events", {});
    StimulusMaker maker(study, {});
    const auto all = maker.make(study.stimuli.size() - 1);
    REQUIRE(all);
    REQUIRE(study.stimuli.back().mix.size() == 4);
    double difference = 0.0;
    for (std::size_t n = 0; n < all->touch.size(); ++n)
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < 4; ++i)
            sum += static_cast<double>(maker.make(i)->touch[n]);
        difference = std::max(difference, std::abs(sum - static_cast<double>(all->touch[n])));
    }
    CHECK(difference < 1e-5);
    for (std::size_t i = 0; i < 4; ++i)
        study.stimuli[i].touchLevel = 0.0;
    StimulusMaker loud(study, {});
    const auto limited = loud.make(study.stimuli.size() - 1);
    REQUIRE(limited);
    for (const float x : limited->touch)
        REQUIRE(std::abs(x) <= 1.0f);
}

TEST_CASE("The right answers of places and events follow from the stimuli")
{
    const Study place = *makeStudy("place", {});
    for (std::size_t i = 0; i < place.stimuli.size(); ++i)
    {
        const double position = place.stimuli[i].place->position;
        CHECK(rightAnswer(place, place.blocks[1], i) == (position == 0.5 ? -1 : position < 0.5 ? 0 : 1));
    }
    const Study events = *makeStudy("events", {});
    CHECK(eventsOf(events, events.blocks[0]).size() == 4);
    CHECK(countsOf(events, events.blocks[0]) == std::vector<int>{1, 2, 3, 4});
    CHECK(guessOf(events, events.blocks[0]) == 0.25);
    CHECK(guessOf(events, events.blocks[1]) == 1.0 / 16.0);
    const std::size_t mix = stimulusNamed(events, "40 Hz + 180 Hz");
    REQUIRE(mix != noStimulus);
    CHECK(rightAnswer(events, events.blocks[0], mix) == 2);
    CHECK(rightAnswer(events, events.blocks[1], mix) == 5);
    for (const Trial& trial : trialsOf(events, 1, 0))
        CHECK(trial.right == rightAnswer(events, events.blocks[1], trial.stimuli.front()));
}

TEST_CASE("Places need a row, and mixes single events that are there")
{
    const auto whereOf = [](Study study, auto change)
    {
        change(study);
        const auto valid = validate(study);
        return valid ? std::string() : valid.error().where;
    };
    const Study place = *makeStudy("place", {}), events = *makeStudy("events", {});
    CHECK(whereOf(place, [](Study& s) { s.row.actuators = 1; }) == "stimuli[0].place");
    CHECK(whereOf(place, [](Study& s) { s.row.actuators = 9; }) == "row.actuators");
    CHECK(whereOf(place, [](Study& s) { s.stimuli[0].place->position = 1.1; }) == "stimuli[0].place.position");
    CHECK(whereOf(place, [](Study& s) { s.stimuli[1].place.reset(); }) == "blocks[0].stimuli");
    CHECK(whereOf(events, [](Study& s) { s.stimuli.back().mix[0] = "nothing"; }) == "stimuli[14].mix[0]");
    CHECK(whereOf(events, [](Study& s) { s.stimuli.back().mix[0] = s.stimuli.back().mix[1]; }) == "stimuli[14].mix[0]");
    CHECK(whereOf(events, [](Study& s) { s.stimuli.back().mix[0] = s.stimuli[5].name; }) == "stimuli[14].mix[0]");
    CHECK(whereOf(events, [](Study& s) { s.stimuli.back().sound = "a.wav"; }) == "stimuli[14]");
    CHECK(whereOf(events, [](Study& s) { s.blocks[0].stimuli = {"40 Hz"}; }) == "blocks[0].stimuli");
}

TEST_CASE("Schaeffer's classes have his signs")
{
    CHECK(signOf({Mass::definite, Facture::continuous}) == "N");
    CHECK(signOf({Mass::complex, Facture::impulse}) == "X'");
    CHECK(signOf({Mass::varying, Facture::iterative}) == "Y''");
    Stimulus one;
    one.object = SoundObject{Mass::complex, Facture::iterative};
    one.tags = {"wood"};
    for (const char* name : {"X''", "complex", "iterative", "wood"})
        CHECK(belongsTo(one, name));
    CHECK_FALSE(belongsTo(one, "X"));
}
