#include "document/EditLayer.h"

#include "document/Amendments.h"
#include "document/Analysis.h"
#include "document/Document.h"
#include "document/EditsBetween.h"
#include "document/ProjectEdits.h"
#include "support/Catch.h"

#include <pacini/clip/edits/PointEdits.h>
#include <pacini/clip/edits/TransientEdits.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace pacini;

namespace
{
/// Clicks with a decaying tone, at the given times.
StoredAudio clicks(const std::vector<double>& times, double duration, float noise = 0.0f)
{
    AudioData audio;
    audio.sampleRate = 48000;
    audio.channels = 1;
    audio.samples.resize(static_cast<std::size_t>(duration * 48000.0));
    Random random(7);
    for (float& s : audio.samples)
        s = noise * static_cast<float>(random.uniform(-1.0, 1.0));
    for (double time : times)
        for (std::size_t i = 0; i < 9600; ++i)
        {
            const auto at = static_cast<std::size_t>(time * 48000.0) + i;
            const double t = static_cast<double>(i) / 48000.0;
            if (at < audio.samples.size())
                audio.samples[at] +=
                    static_cast<float>(0.6 * std::exp(-t / 0.03) * std::sin(2.0 * std::numbers::pi * 180.0 * t));
        }
    return StoredAudio(audio);
}

const std::vector<double> times = {0.3, 0.9, 1.4, 2.1, 2.9, 3.3};

std::vector<double> later(double shift)
{
    auto all = times;
    for (double& t : all)
        t += shift;
    return all;
}

AudioReference reference()
{
    AudioReference sound;
    sound.path = "/sounds/clicks.wav";
    sound.hash = "0";
    return sound;
}

struct Edited
{
    Document document;
    int id = 0;
    double drawnAt = 0.0; ///< s: a hand-made plateau of 0.123 begins at the third event
};

Edited editedClicks()
{
    Edited e;
    const Clip clip = analyse(clicks(times, 4.0), {}, reference()).value();
    REQUIRE(clip.transients.size() == times.size());
    e.id = addSound(e.document, reference(), {}, clip).value();
    Clip drawn = clip;
    e.drawnAt = clip.transients[2].time;
    const Curve stroke = {{e.drawnAt, 0.123}, {e.drawnAt + 0.2, 0.123}};
    drawn.envelope = replaceSection(drawn.envelope, {e.drawnAt, e.drawnAt + 0.2}, stroke);
    REQUIRE(e.document.commit("Draw", withClip(e.document.project(), e.id, drawn)));
    Clip moved = drawn;
    moved.transients[4].time += 0.05;
    moved.transients[4].amplitude *= 0.5;
    REQUIRE(e.document.commit("Move event", withClip(e.document.project(), e.id, moved)));
    REQUIRE(e.document.commit(
        "Remove event", withClip(e.document.project(), e.id, deleteTransients(*e.document.clip(e.id)->clip, {1}))));
    return e;
}
} // namespace

TEST_CASE("Another knob of the analysis keeps the hand edits")
{
    Edited e = editedClicks();
    EncoderParams finer;
    finer.breakpoints = 60.0;
    finer.bands = 20;
    const Clip other = analyse(clicks(times, 4.0), finer, reference()).value();
    REQUIRE(e.document.commit(
        "Finer", withAnalysis(e.document.project(), finer, {e.id, other}, e.document.steps().newIds().source)));
    const auto item = e.document.clip(e.id);
    CHECK(item->unfitting.empty());
    CHECK(item->clip->bands.size() == 20);
    REQUIRE(item->clip->transients.size() == times.size() - 1);
    for (double t = 0.01; t < 0.2; t += 0.02)
        CHECK(valueAt(item->clip->envelope, e.drawnAt + t) == Approx(0.123));
    CHECK(item->clip->transients[3].time == Approx(other.transients[4].time + 0.05));
    CHECK(validate(*item->clip));
    // Elsewhere it is the new analysis.
    CHECK(valueAt(item->clip->envelope, 0.32) == valueAt(other.envelope, 0.32));
}

TEST_CASE("Edits move with the events when the sound is replaced by a later take")
{
    for (const double shift : {0.25, 1.7})
    {
        Edited e = editedClicks();
        const Clip other = analyse(clicks(later(shift), 6.0), {}, reference()).value();
        REQUIRE(other.transients.size() == times.size());
        REQUIRE(e.document.commit(
            "Replace", withAnalysis(e.document.project(), {}, {e.id, other}, e.document.steps().newIds().source)));
        const auto item = e.document.clip(e.id);
        CHECK(item->unfitting.empty());
        const double begin = other.transients[2].time;
        for (double t = 0.01; t < 0.19; t += 0.02)
            CHECK(valueAt(item->clip->envelope, begin + t) == Approx(0.123));
        REQUIRE(item->clip->transients.size() == times.size() - 1);
        CHECK(item->clip->transients[1].time == Approx(other.transients[2].time));
        CHECK(item->clip->transients[3].time == Approx(other.transients[4].time + 0.05));
    }
}

TEST_CASE("What no longer fits is listed, is not lost, and fits again later")
{
    Edited e = editedClicks();
    const Clip before = *e.document.clip(e.id)->clip;
    const Clip analysis = *e.document.clip(e.id)->analysis;
    auto fewer = times;
    fewer.erase(fewer.begin() + 4); // the event that was moved by hand
    REQUIRE(e.document.commit("Replace", withAnalysis(e.document.project(), {},
                                                      {e.id, analyse(clicks(fewer, 4.0), {}, reference()).value()},
                                                      e.document.steps().newIds().source)));
    const auto item = e.document.clip(e.id);
    REQUIRE(item->unfitting.size() == 1);
    CHECK(item->unfitting[0].edit == 1);
    CHECK(item->unfitting[0].reason.find("no longer exists") != std::string::npos);
    CHECK(item->edits.size() == 3);
    REQUIRE(e.document.commit(
        "Back", withAnalysis(e.document.project(), {}, {e.id, analysis}, e.document.steps().newIds().source)));
    CHECK(e.document.clip(e.id)->unfitting.empty());
    CHECK(e.document.clip(e.id)->clip->transients == before.transients);
}

TEST_CASE("Edits of bands find them by frequency, and wait when there is none")
{
    Clip twelve;
    twelve.duration = 1.0;
    for (double f = 50.0; f < 500.0; f *= 1.2)
        twelve.bands.push_back({f, f * 1.1, f * 1.2, 0, {{0.0, 0.5}, {1.0, 0.5}}, {}});
    Clip six = twelve;
    six.bands.clear();
    for (double f = 50.0; f < 200.0; f *= 1.44)
        six.bands.push_back({f, f * 1.2, f * 1.44, 0, {{0.0, 0.4}, {1.0, 0.4}}, {}});
    Document document;
    const int id = addClip(document, twelve).value();
    const auto lower = [&](std::size_t band)
    {
        Clip clip = *document.clip(id)->clip;
        clip.bands[band].amplitude = {{0.0, 0.5}, {0.5, 0.1 + 0.01 * static_cast<double>(band)}, {1.0, 0.5}};
        REQUIRE(document.commit("Edit", withClip(document.project(), id, clip)));
    };
    lower(2);
    lower(11);
    const Clip edited = *document.clip(id)->clip;
    REQUIRE(
        document.commit("Fewer", withAnalysis(document.project(), {}, {id, six}, document.steps().newIds().source)));
    const auto item = document.clip(id);
    CHECK(valueAt(item->clip->bands[1].amplitude, 0.5) == Approx(0.12));
    REQUIRE(item->unfitting.size() == 1);
    CHECK(item->unfitting[0].edit == 1);
    REQUIRE(
        document.commit("More", withAnalysis(document.project(), {}, {id, twelve}, document.steps().newIds().source)));
    CHECK(document.clip(id)->unfitting.empty());
    CHECK(*document.clip(id)->clip == edited);
}

TEST_CASE("Edits behind a trim, a reversal and a repetition still follow their events")
{
    Clip analysis;
    analysis.duration = 4.0;
    for (double t : times)
        analysis.transients.push_back({t, 0.5, 0.5});
    analysis.envelope = {{0.0, 0.5}, {4.0, 0.5}};
    Clip moved = analysis;
    for (Transient& event : moved.transients)
        event.time += 0.02;
    Document document;
    const int id = addClip(document, analysis).value();
    REQUIRE(document.commit("Trim", withEdit(document.project(), id, TrimEdit{{0.8, 3.5}})));
    REQUIRE(document.commit("Reverse", withEdit(document.project(), id, ReverseEdit{})));
    REQUIRE(document.commit("Repeat", withEdit(document.project(), id, RepeatEdit{2})));
    // The event at 2.1 s is at 3.5 - 2.1 = 1.4 s now, and at 2.7 + 1.4 s again.
    Clip clip = *document.clip(id)->clip;
    const auto found = std::find_if(clip.transients.begin(), clip.transients.end(),
                                    [](const Transient& t) { return std::abs(t.time - 4.1) < 1e-6; });
    REQUIRE(found != clip.transients.end());
    found->amplitude = 0.9;
    REQUIRE(document.commit("Louder", withClip(document.project(), id, clip)));
    REQUIRE(
        document.commit("Again", withAnalysis(document.project(), {}, {id, moved}, document.steps().newIds().source)));
    CHECK(document.clip(id)->unfitting.empty());
    const auto& events = document.clip(id)->clip->transients;
    const auto loud = std::find_if(events.begin(), events.end(), [](const Transient& t) { return t.amplitude == 0.9; });
    REQUIRE(loud != events.end());
    const auto whole = document.clip(id)->clip->duration / 2.0;
    CHECK(std::count_if(events.begin(), events.end(), [](const Transient& t) { return t.amplitude == 0.9; }) == 1);
    CHECK(std::abs(loud->time - (whole + 1.4)) < 0.03);
}
