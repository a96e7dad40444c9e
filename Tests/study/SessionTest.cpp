#include "study/Session.h"

#include "io/InputFile.h"
#include "study/Observers.h"
#include "study/PersonalProfile.h"
#include "study/StudyFile.h"
#include "study/StudyResults.h"
#include "study/StudyTemplates.h"
#include "support/Catch.h"
#include "support/ShippedProfile.h"
#include "support/TempFolder.h"

#include <pacini/foundation/Random.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#if !defined(_WIN32)
#include <sys/resource.h>
#endif

using namespace pacini;
using namespace pacini::study;
using test::TempFolder;
namespace fs = std::filesystem;

namespace
{
Study made(const char* name)
{
    auto study = makeStudy(name, {"a.wav", "b.wav", "c.wav"});
    if (!study) // it presents its own tones
        study = makeStudy(name, {});
    REQUIRE(study);
    return *study;
}

std::unique_ptr<Session> begun(const Study& study, const fs::path& folder)
{
    auto session = Session::begin(study, folder, {});
    REQUIRE(session);
    return std::move(*session);
}

std::string textOf(const fs::path& path)
{
    auto text = readWholeFile(path, 100'000'000);
    REQUIRE(text);
    return *text;
}

/// A log without what depends on the clock.
std::string withoutTimes(std::string text)
{
    for (const char* key : {"\"time\":\"", "\"started\":\""})
        for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1))
        {
            const std::size_t start = at + std::string(key).size();
            text.erase(start, text.find('"', start) - start);
        }
    return text;
}
} // namespace

TEST_CASE("Each session takes the next free place, with the pseudonym and the group of that place")
{
    const TempFolder folder;
    const Study study = made("coherence");
    std::set<std::string> names;
    std::map<std::string, int> groups;
    for (int i = 0; i < 33; ++i)
    {
        const auto session = begun(study, folder.path());
        names.insert(session->head().participant);
        ++groups[session->head().group];
    }
    CHECK(names.size() == 33);
    CHECK(groups == std::map<std::string, int>{{"A", 11}, {"B", 11}, {"C", 11}});
    // A place that became free is taken again.
    fs::remove(folder.path() / "sessions" / "P007.jsonl");
    CHECK(begun(study, folder.path())->head().participant == "P007");
    CHECK(begun(study, folder.path())->head().participant == "P034");
}

TEST_CASE("A session that was killed after any byte goes on where it was, with the same trials and answers")
{
    for (const char* name : {"coherence", "jnd", "compression", "abx", "mushra"})
    {
        INFO(name);
        const Study study = made(name);
        const TempFolder whole;
        {
            const auto session = begun(study, whole.path());
            REQUIRE(simulateSession(study, *session, {}));
            CHECK(session->trial() == nullptr);
        }
        const std::string all = textOf(whole.path() / "sessions" / "P001.jsonl");
        Random random(9);
        for (int i = 0; i < 12; ++i)
        {
            // The first line has to be whole: before it there is no session.
            const std::size_t first = all.find('\n') + 1;
            const auto cut =
                first + static_cast<std::size_t>(random.uniform() * static_cast<double>(all.size() - first));
            const TempFolder folder;
            fs::create_directory(folder.path() / "sessions");
            const fs::path log = folder.path() / "sessions" / "P001.jsonl";
            std::ofstream(log, std::ios::binary) << all.substr(0, cut);
            auto session = Session::resume(study, log);
            REQUIRE(session);
            const auto kept = readSession(log);
            REQUIRE(kept);
            CHECK((*session)->answered() == kept->records.size());
            // The simulated person answers anew as before: from the start, without being asked for what is kept.
            Observer observer(study, {}, 0);
            {
                const TempFolder other;
                const auto replay = begun(study, other.path());
                for (std::size_t k = 0; k < kept->records.size(); ++k)
                    REQUIRE(replay->answer(observer.answer(*replay->trial(), replay->level())));
            }
            while (const Trial* trial = (*session)->trial())
                REQUIRE((*session)->answer(observer.answer(*trial, (*session)->level())));
            session->reset();
            const std::string found = withoutTimes(textOf(log)), wanted = withoutTimes(all);
            // Only the line "finished" may have been cut off and come again.
            CHECK(found.substr(0, found.find("{\"type\":\"finished")) ==
                  wanted.substr(0, wanted.find("{\"type\":\"finished")));
        }
    }
}

TEST_CASE("A trial in which something dropped out comes again, and its answer does not count")
{
    const TempFolder folder;
    const Study study = made("words");
    std::ofstream(folder.path() / "study.json") << studyJson(study);
    {
        const auto session = begun(study, folder.path());
        Answer answer;
        answer.words = "rough";
        answer.dropouts = 1;
        const std::size_t before = session->trial()->stimuli[0];
        REQUIRE(session->answer(answer));
        CHECK(session->trial()->stimuli[0] == before);
        answer.dropouts = 0;
        REQUIRE(session->answer(answer));
        CHECK(session->trial()->stimuli[0] != before);
        // A device that always drops out does not hold a participant for ever.
        answer.dropouts = 2;
        const std::size_t second = session->trial()->stimuli[0];
        for (int i = 0; i < 4; ++i)
        {
            CHECK(session->trial()->stimuli[0] == second);
            REQUIRE(session->answer(answer));
        }
        CHECK(session->trial()->stimuli[0] != second);
    }
    const auto results = readResults(folder.path());
    REQUIRE(results);
    CHECK(results->descriptions.size() == 1);
    CHECK(results->dropouts == 5);
    CHECK(results->warnings.size() == 1); // is not finished
}

TEST_CASE("Nothing is mixed: another version of the study, another program, something that is no log")
{
    const TempFolder folder;
    const Study study = made("words");
    const auto session = begun(study, folder.path());
    CHECK_FALSE(Session::resume(study, session->path())); // open here
    Study other = study;
    other.blocks[0].pause = 1.0;
    CHECK_FALSE(Session::begin(other, folder.path(), {}));
    const TempFolder empty;
    const fs::path log = empty.path() / "x.jsonl";
    for (const char* text : {"", "\n", "{\"type\":\"answer\"}\n", "[1]\n", "no json\n"})
    {
        std::ofstream(log, std::ios::binary | std::ios::trunc) << text;
        CHECK_FALSE(readSession(log));
    }
    std::ofstream(log, std::ios::binary | std::ios::trunc) << R"({"format":"pacini.session","version":9})"
                                                           << "\n";
    CHECK(readSession(log).error().code == ErrorCode::unsupportedVersion);
}

TEST_CASE("Results of all kinds are found again")
{
    for (const StudyTemplate& one : studyTemplates())
    {
        INFO(one.name);
        const TempFolder folder;
        auto study = made(std::string(one.name).c_str());
        for (Group& group : study.groups)
            group.size = 4;
        std::ofstream(folder.path() / "study.json") << studyJson(study);
        for (int i = 0; i < participantsOf(study); ++i)
            REQUIRE(simulateSession(study, *begun(study, folder.path()), {}));
        const auto results = readResults(folder.path());
        REQUIRE(results);
        CHECK(results->warnings.empty());
        CHECK(results->sessions.size() == static_cast<std::size_t>(participantsOf(study)));
        const std::size_t found = results->ratings.size() + results->ranks.size() + results->descriptions.size() +
                                  results->thresholds.size() + results->choices.size() + results->pairs.size() +
                                  results->items.size() + results->places.size() + results->events.size();
        CHECK(found >= results->sessions.size());
        std::vector<double> errors;
        for (const PersonalThreshold& threshold : results->thresholds)
        {
            const Block& block = *std::find_if(study.blocks.begin(), study.blocks.end(),
                                               [&](const Block& each) { return each.name == threshold.block; });
            const std::size_t slot = std::stoul(threshold.participant.substr(1)) - 1;
            const double unbounded =
                Observer(study, {}, slot).thresholdFor(block, stimulusNamed(study, threshold.stimulus));
            const Grid asked = strengthGrid(block.adaptive);
            const double truth = std::clamp(unbounded, asked.low, asked.high);
            errors.push_back(std::abs(threshold.estimate.strength - truth));
        }
        std::sort(errors.begin(), errors.end());
        if (!errors.empty())
            CHECK(errors[errors.size() / 2] < 3.0);
    }
}

TEST_CASE("A profile becomes a person's: who feels more has a larger dynamic range")
{
    Study study = made("threshold");
    study.groups[0].size = 2;
    study.blocks[0].adaptive.trials = 40;
    const TempFolder folder;
    std::ofstream(folder.path() / "study.json") << studyJson(study);
    ObserverParams sharp, dull;
    sharp.threshold = -50.0;
    dull.threshold = -35.0;
    sharp.thresholdSd = dull.thresholdSd = 0.0;
    REQUIRE(simulateSession(study, *begun(study, folder.path()), sharp));
    REQUIRE(simulateSession(study, *begun(study, folder.path()), dull));
    const auto results = readResults(folder.path());
    REQUIRE(results);
    Profile profile = test::shippedProfile("l5-wristband");
    profile.equalizer = {};
    profile.range.lowFrequency = 100.0; // where the dull one feels something
    profile.range.highFrequency = 300.0;
    const auto first = personalProfile(profile, *results, "P001"), second = personalProfile(profile, *results, "P002");
    REQUIRE(first);
    REQUIRE(second);
    // 125, 180 and 250 Hz: the thresholds are 12, 5.7 and 0 dB above that at 250 Hz.
    CHECK(first->range.dynamicRange == Approx(50.0 - 5.9).margin(1.5));
    CHECK(second->range.dynamicRange == Approx(35.0 - 5.9).margin(1.5));
    CHECK(validate(*first));
    CHECK(sourceOf(first->sources, "range.dynamicRange")->text.find("P001") != std::string::npos);
    // An equaliser in front of the drive adds its gain to what is left.
    Profile louder = profile;
    louder.equalizer.pushBack({EqualizerType::peak, 180.0, 6.0, 0.1});
    const auto equalized = personalProfile(louder, *results, "P001");
    REQUIRE(equalized);
    CHECK(equalized->range.dynamicRange == Approx(first->range.dynamicRange + 6.0).margin(0.5));
    CHECK_FALSE(personalProfile(profile, *results, "P009"));
    profile.range.lowFrequency = 30.0; // at 31.5 Hz the dull one felt nothing at full drive
    CHECK_FALSE(personalProfile(profile, *results, "P002"));
}

#if !defined(_WIN32)
TEST_CASE("A full disk loses no answer: it is said, and the same answer can be given again")
{
    const TempFolder folder;
    const Study study = made("words");
    const auto session = begun(study, folder.path());
    Answer answer;
    answer.words = std::string(200, 'x');
    REQUIRE(session->answer(answer));
    const std::string before = textOf(session->path());
    const Trial* trial = session->trial();

    // Files may grow by some bytes alone, as on a disk with hardly any room.
    struct rlimit unlimited = {};
    getrlimit(RLIMIT_FSIZE, &unlimited);
    struct rlimit small = unlimited;
    small.rlim_cur = before.size() + 20;
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    const auto refused = session->answer(answer);
    setrlimit(RLIMIT_FSIZE, &unlimited);
    std::signal(SIGXFSZ, handler);

    REQUIRE_FALSE(refused);
    CHECK_FALSE(refused.error().message.empty());
    CHECK(session->trial() == trial);
    CHECK(textOf(session->path()) == before);
    REQUIRE(session->answer(answer));
    const auto logged = readSession(session->path());
    REQUIRE(logged);
    CHECK(logged->records.size() == 2);
    CHECK(logged->records[1].answer.words == answer.words);
}
#endif
