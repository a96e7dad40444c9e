#include "study/TrialPlayback.h"

#include "study/Exposure.h"
#include "study/StudyRun.h"
#include "support/Catch.h"
#include "support/HeapGuard.h"
#include "support/TempFolder.h"

#include <array>
#include <vector>

using namespace pacini;
using namespace pacini::study;
using test::TempFolder;

namespace
{
TrialSound ramp(std::size_t frames)
{
    TrialSound trial;
    for (std::size_t n = 0; n < frames; ++n)
    {
        trial.sound.push_back(static_cast<float>(n + 1) / 10000.0f);
        trial.touch.push_back(-static_cast<float>(n + 1) / 10000.0f);
    }
    trial.soundOnset = 0;
    trial.touchOnset = 0;
    trial.parts = {{0, frames}};
    return trial;
}

struct Buffers
{
    std::vector<float> left, right, touch;
    explicit Buffers(std::size_t frames) : left(frames), right(frames), touch(frames) {}
    void from(TrialPlayback& playback) { playback.process(left, right, touch); }
};

/// A device that plays at once.
class InstantPlayer final : public TrialPlayer
{
public:
    explicit InstantPlayer(TrialPlayback& toFill) : playback(toFill) {}
    [[nodiscard]] int sampleRate() const override { return rate; }
    void play(TrialSound trial) override
    {
        const std::size_t frames = trial.sound.size() + 64;
        playback.play(std::move(trial));
        if (drops)
            playback.drop();
        Buffers block(frames);
        block.from(playback);
    }
    void stop() override { playback.stop(); }
    [[nodiscard]] PlaybackReport report() const override { return playback.report(); }

    void recover() override
    {
        if (returns)
            rate = 48000;
    }

    int rate = 48000;
    bool drops = false;
    bool returns = false; ///< when it is opened again

private:
    TrialPlayback& playback;
};

Study tones()
{
    Study study;
    study.name = "tones";
    study.groups = {{"all", 1}};
    for (const char* name : {"a", "b", "c"})
    {
        Stimulus tone;
        tone.name = name;
        tone.tone = Tone{100.0, 0.1, 0.01, -6.0};
        study.stimuli.push_back(tone);
    }
    Block rating;
    rating.name = "rating";
    rating.presentation = Presentation::touch;
    rating.replays = 1;
    Block page = rating;
    page.name = "ranking";
    page.task = Task::ranking;
    study.blocks = {rating, page};
    return study;
}
} // namespace

TEST_CASE("Sound and touch come out at the same sample, in blocks of any size")
{
    for (const std::size_t size : {1u, 7u, 64u, 500u})
    {
        TrialPlayback playback;
        playback.prepare(48000.0);
        Buffers block(size);
        block.from(playback); // silence before
        playback.play(ramp(300));
        std::vector<float> sound, touch;
        while (playback.report().playing)
        {
            block.from(playback);
            sound.insert(sound.end(), block.left.begin(), block.left.end());
            touch.insert(touch.end(), block.touch.begin(), block.touch.end());
            CHECK(block.left == block.right);
        }
        REQUIRE(sound.size() >= 300);
        for (std::size_t n = 0; n < 300; ++n)
        {
            REQUIRE(sound[n] == static_cast<float>(n + 1) / 10000.0f);
            REQUIRE(touch[n] == -sound[n]);
        }
        const PlaybackReport report = playback.report();
        CHECK(report.complete);
        CHECK(*report.soundOnset == Approx(static_cast<double>(size) / 48000.0));
        CHECK(*report.touchOnset == *report.soundOnset);
    }
}

TEST_CASE("The audio thread never touches the heap, and what stops fades")
{
    TrialPlayback playback;
    playback.prepare(48000.0);
    Buffers block(480);
    playback.play(ramp(48000));
    {
        const test::HeapGuard guard;
        for (int i = 0; i < 10; ++i)
            block.from(playback);
        CHECK(guard.traffic() == 0);
    }
    const float before = block.left.back();
    playback.stop();
    block.from(playback);
    CHECK(block.left.front() == Approx(before).epsilon(0.05));
    CHECK(block.left.back() == 0.0f);
    CHECK_FALSE(playback.report().playing);
    CHECK_FALSE(playback.report().complete);
    playback.play(ramp(100));
    playback.stop(); // before it began
    block.from(playback);
    CHECK(block.left == std::vector<float>(480, 0.0f));
    // Again and again without ever fetching a report.
    for (int i = 0; i < 100; ++i)
    {
        playback.play(ramp(100));
        block.from(playback);
    }
    CHECK(playback.report().complete);
}

TEST_CASE("A trial can be answered once it was played, and replayed as often as the block says")
{
    const TempFolder folder;
    const Study study = tones();
    auto session = Session::begin(study, folder.path(), {});
    REQUIRE(session);
    TrialPlayback playback;
    InstantPlayer player(playback);
    StudyRun run(study, std::move(*session), {}, player);
    for (int i = 0; i < 3; ++i)
    {
        CHECK_FALSE(run.canAnswer());
        CHECK(run.playsLeft() == 2);
        CHECK(run.play() == PlayRefusal::none);
        CHECK_FALSE(run.poll().now);
        CHECK(run.canAnswer());
        CHECK(run.play() == PlayRefusal::none);
        run.poll();
        CHECK(run.play() == PlayRefusal::noReplayLeft);
        Answer answer;
        answer.value = 5.0;
        REQUIRE(run.answer(answer));
    }
    // A page: every stimulus has to be felt.
    REQUIRE(run.trial() != nullptr);
    CHECK(run.isPage());
    for (std::size_t part = 0; part < 3; ++part)
    {
        CHECK_FALSE(run.canAnswer());
        CHECK(run.play(part) == PlayRefusal::none);
        run.poll();
    }
    CHECK(run.canAnswer());
    Answer places;
    places.values = {1.0, 2.0, 3.0};
    REQUIRE(run.answer(places));
    CHECK(run.trial() == nullptr);

    const auto logged = readSession(run.session().path());
    REQUIRE(logged);
    REQUIRE(logged->records.size() == 4);
    CHECK(logged->finished);
    CHECK(logged->records[0].answer.replays == 1);
    CHECK(logged->records[0].answer.touchOnset);
    CHECK(logged->exposure > 0.0);
    CHECK(run.exposure() == Approx(dailyExposure(logged->exposure)));
}

TEST_CASE("Nothing is played beyond the limit of exposure, without a device, or that dropped out unseen")
{
    const TempFolder folder;
    Study study = tones();
    study.limits.daily = 0.008;
    auto session = Session::begin(study, folder.path(), {});
    REQUIRE(session);
    TrialPlayback playback;
    InstantPlayer player(playback);
    StudyRun run(study, std::move(*session), {}, player);
    player.rate = 0;
    CHECK(run.play() == PlayRefusal::noDevice);
    player.rate = 44100; // not the one that the session has begun with
    CHECK(run.play() == PlayRefusal::failed);
    CHECK(run.failure()->message.find("44100") != std::string::npos);
    player.rate = 0;
    player.returns = true;
    player.drops = true;
    const std::size_t first = run.trial()->stimuli[0];
    CHECK(run.play() == PlayRefusal::none);
    run.poll();
    Answer answer;
    answer.value = 5.0;
    REQUIRE(run.answer(answer));
    CHECK(run.trial()->stimuli[0] == first);
    player.drops = false;
    PlayRefusal refusal = PlayRefusal::none;
    for (int i = 0; i < 10 && refusal == PlayRefusal::none && run.trial() != nullptr && !run.isPage(); ++i)
    {
        refusal = run.play();
        run.poll();
        if (refusal == PlayRefusal::none)
            REQUIRE(run.answer(answer));
    }
    CHECK(refusal == PlayRefusal::exposure);
    CHECK(run.exposure() <= 0.008);
    // What was felt and not answered counts, too, also for who goes on later.
    const auto kept = readSession(run.session().path());
    REQUIRE(kept);
    CHECK(dailyExposure(kept->exposure) == Approx(run.exposure()));
    run.lowerTouch(6.0);
    run.lowerTouch(6.0);
    CHECK(run.touchTrim() == -12.0);
}
