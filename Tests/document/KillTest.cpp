// A scripted session is killed at random moments: what had been done a second before is there again.

#include "document/Amendments.h"
#include "document/Autosave.h"
#include "document/ProjectEdits.h"
#include "io/formats/json/ClipJson.h"
#include "support/Catch.h"
#include "support/RandomClip.h"
#include "support/TempFolder.h"

#include <pacini/foundation/Random.h>

#if !defined(_WIN32)
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

using namespace pacini;

namespace
{
using Clock = std::chrono::steady_clock;

/// Steps of a user, the same whenever the seed is.
class Session
{
public:
    Session(std::uint64_t seed, std::filesystem::path folder) : random(seed), file(std::move(folder) / "p.pacini") {}

    Document document;

    void step()
    {
        const auto& clips = document.project().clips;
        const int id = clips.empty() ? 0 : clips[random.next() % clips.size()]->id;
        const auto choice = clips.empty() ? 0 : random.next() % 16;
        if (choice == 0 && clips.size() < 6)
            (void)addClip(document, fileClip(random.next() % 1000));
        else if (choice == 1 && clips.size() < 6)
            open();
        else if (choice == 2)
            (void)document.commit("Duplicate clip",
                                  withDuplicate(document.project(), id, document.steps().newIds().clip));
        else if (choice == 3 && clips.size() > 2)
            (void)document.commit("Remove clip", withoutClips(document.project(), {id}));
        else if (choice == 4)
            document.undo();
        else if (choice == 5)
            document.redo();
        else if (choice == 6)
            document.goTo(random.next() % document.steps().size());
        else if (choice == 7)
            (void)document.saveAs(file);
        else if (choice == 8)
        {
            ProjectProfile profile;
            profile.strength = random.uniform();
            (void)setProfile(document, profile);
        }
        else if (choice == 9)
            (void)document.commit("Notes",
                                  withProjectNotes(document.project(), "note " + std::to_string(random.next() % 1000)));
        else if (choice == 10)
            (void)document.commit("Reverse", withEdit(document.project(), id, ReverseEdit{}));
        else
            (void)document.commit("Gain", withEdit(document.project(), id, GainEdit{{}, random.uniform(-3.0, 1.0)}));
    }

private:
    /// As it comes out of a file: texts are UTF-8.
    static Clip fileClip(std::uint64_t seed)
    {
        return readClipJson(writeClipJson(test::randomFullClip(seed, 60))).value();
    }

    void open()
    {
        const auto number = random.next() % 1000;
        AudioReference sound;
        sound.path = "/sounds/" + std::to_string(number) + ".wav";   // is nowhere
        sound.hash = std::to_string(1'000'000'000'000'000 + number); // 16 digits
        sound.embedded = std::make_shared<const std::string>("RIFF" + std::to_string(number));
        (void)addSound(document, sound, {}, fileClip(number));
    }

    Random random;
    std::filesystem::path file;
};

/// That a state was handed over, and when.
struct Handed
{
    int state = 0;
    Clock::time_point at;
};

[[noreturn]] void work(std::uint64_t seed, const std::filesystem::path& folder, int told)
{
    {
        Session session(seed, folder);
        Autosave autosave(folder / "recovery");
        Random pauses(seed + 1);
        for (int state = 1;; ++state)
        {
            session.step();
            const Handed handed{state, Clock::now()};
            autosave.update(session.document.snapshot());
            if (write(told, &handed, sizeof handed) != sizeof handed)
                break;
            // Some are quick after each other, as in a drag, and sometimes nothing is done for a while.
            const bool rests = pauses.next() % 25 == 0;
            std::this_thread::sleep_for(
                std::chrono::milliseconds(rests ? 200 + pauses.next() % 600 : 1 + pauses.next() % 30));
        }
    }
    _exit(1);
}

struct Child
{
    std::uint64_t seed = 0;
    std::filesystem::path folder;
    pid_t process = 0;
    int told = -1;
    double life = 0.0; ///< s
    std::vector<Handed> handed{Handed{}};
    Clock::time_point killed;
};

/// The newest state of the session that is on the disk; -1: what is there is none of its states.
int stateLeft(const Child& child)
{
    const auto found = listRecoverable(child.folder / "recovery");
    CHECK(found.size() <= 1);
    std::vector<Project> left;
    for (const Recoverable& entry : found)
    {
        CHECK_FALSE(entry.problem);
        auto recovered = Document::recover(entry.file);
        REQUIRE(recovered);
        left.push_back(recovered->project());
    }
    // A recovery file may be older than a project that was saved just then.
    if (auto saved = Document::open(child.folder / "p.pacini"))
        left.push_back(saved->project());
    const test::TempFolder elsewhere;
    Session again(child.seed, elsewhere.path());
    int newest = left.empty() ? 0 : -1;
    for (int state = 0; state <= child.handed.back().state + 1; ++state)
    {
        if (std::any_of(left.begin(), left.end(), [&](const Project& one) { return one == again.document.project(); }))
            newest = state;
        again.step();
    }
    return newest;
}

/// Several sessions at a time, each killed at a random moment of at most `longest` s; how old the oldest change was
/// that got lost, s.
double killSessions(int count, double longest, std::uint64_t seed)
{
    constexpr double allowed = 1.0; // s
    const test::TempFolder folder;
    Random random(seed);
    std::vector<Child> children(static_cast<std::size_t>(count));
    for (Child& child : children)
    {
        child.seed = random.next();
        child.folder = folder / std::to_string(child.seed);
        std::filesystem::create_directory(child.folder);
        child.life = random.uniform(0.02, longest);
        int ends[2];
        REQUIRE(pipe(ends) == 0);
        child.process = fork();
        REQUIRE(child.process >= 0);
        if (child.process == 0)
        {
            close(ends[0]);
            work(child.seed, child.folder, ends[1]);
        }
        close(ends[1]);
        child.told = ends[0];
    }
    const auto start = Clock::now();
    std::sort(children.begin(), children.end(), [](const Child& a, const Child& b) { return a.life < b.life; });
    for (Child& child : children)
    {
        std::this_thread::sleep_until(
            start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(child.life)));
        child.killed = Clock::now();
        kill(child.process, SIGKILL);
    }
    double oldest = 0.0;
    for (Child& child : children)
    {
        waitpid(child.process, nullptr, 0);
        for (Handed one; read(child.told, &one, sizeof one) == sizeof one;)
            child.handed.push_back(one);
        close(child.told);
        const int left = stateLeft(child);
        INFO("seed " << child.seed << ", killed after " << child.life << " s in state " << child.handed.back().state
                     << ", left is " << left);
        REQUIRE(left >= 0);
        const auto lost = std::find_if(child.handed.begin() + 1, child.handed.end(),
                                       [&](const Handed& one) { return one.state > left; });
        if (lost == child.handed.end())
            continue;
        const double age = std::chrono::duration<double>(child.killed - lost->at).count();
        CHECK(age < allowed);
        oldest = std::max(oldest, age);
    }
    return oldest;
}
} // namespace

TEST_CASE("Ten sessions killed at random moments lose at most their last second")
{
    (void)killSessions(10, 1.5, 1);
}

TEST_CASE("Two hundred sessions killed at random moments lose at most their last second", "[slow]")
{
    double oldest = 0.0;
    for (std::uint64_t round = 0; round < 20; ++round)
        oldest = std::max(oldest, killSessions(10, 4.0, 100 + round));
    std::printf("200 kills: the oldest change that was lost had been made %.3f s before\n", oldest);
}
#endif
