#include "document/Autosave.h"

#include "document/Amendments.h"
#include "document/ProcessId.h"
#include "document/ProjectEdits.h"
#include "document/ProjectJson.h"
#include "support/Catch.h"
#include "support/RandomClip.h"
#include "support/TempFolder.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#if !defined(_WIN32)
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

using namespace pacini;

namespace
{
Document smallDocument()
{
    Document document;
    Clip clip;
    clip.name = "clip";
    clip.duration = 1.0;
    clip.envelope = {{0.0, 0.5}, {1.0, 0.25}};
    (void)addClip(document, clip);
    return document;
}
} // namespace

TEST_CASE("What was autosaved comes back as the unsaved project that it was")
{
    const test::TempFolder folder;
    Document document = smallDocument();
    REQUIRE(document.saveAs(folder / "p.pacini"));
    AudioReference sound;
    sound.path = folder / "s.wav";
    sound.hash = "0123456789abcdef";
    sound.embedded = std::make_shared<const std::string>(std::string("RIFF\0\xFF bytes", 12));
    REQUIRE(addSound(document, sound, {}, *document.clip(1)->clip));
    {
        Autosave autosave(folder / "recovery");
        autosave.update(document.snapshot());
        autosave.flush();
        CHECK_FALSE(autosave.lastError());
        auto recovered = Document::recover(autosave.file());
        REQUIRE(recovered);
        CHECK(recovered->project() == document.project());
        CHECK(*recovered->project().sources[0].embedded == *sound.embedded);
        CHECK(recovered->path() == folder / "p.pacini");
        CHECK(recovered->isDirty());
        CHECK(listRecoverable(folder / "recovery").empty()); // this program still runs

        REQUIRE(document.save());
        autosave.update(document.snapshot());
        autosave.flush();
        CHECK_FALSE(std::filesystem::exists(autosave.file()));
    }
    CHECK(std::filesystem::is_empty(folder / "recovery"));
}

TEST_CASE("A recovery folder that cannot be written is reported, and tried again")
{
    const test::TempFolder folder;
    test::put(folder / "recovery", "a file where the folder should be");
    Document document = smallDocument();
    Autosave autosave(folder / "recovery", std::chrono::milliseconds(5));
    autosave.update(document.snapshot());
    autosave.flush();
    REQUIRE(autosave.lastError());
    CHECK(autosave.lastError()->code == ErrorCode::io);
    std::filesystem::remove(folder / "recovery");
    autosave.update(document.snapshot());
    for (int i = 0; i < 1000 && !std::filesystem::exists(autosave.file()); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    CHECK(std::filesystem::exists(autosave.file()));
}

TEST_CASE("A change is on disk within a second, also right after another")
{
    const test::TempFolder folder;
    Document document = smallDocument();
    Autosave autosave(folder / "recovery");
    autosave.update(document.snapshot());
    autosave.flush();
    REQUIRE(document.commit("Notes", withProjectNotes(document.project(), "second")));
    autosave.update(document.snapshot());
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(1);
    std::string notes;
    while (notes != "second" && std::chrono::steady_clock::now() < end)
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        if (const auto written = Document::recover(autosave.file()))
            notes = written->project().notes;
    }
    CHECK(notes == "second");
}

TEST_CASE("A recovery file is offered also when another program has the id of its own by now")
{
    const test::TempFolder folder;
    const Document document = smallDocument();
    const auto file = folder / (std::to_string(processId()) + "-1-5e1.pacini-recovery");
    REQUIRE(writeRecovery(file, document.snapshot()));
    const auto found = listRecoverable(folder.path());
    REQUIRE(found.size() == 1);
    CHECK(found[0].file == file);
    discardRecoverable(found[0]);
    CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("Discarding what one program has left keeps the sounds that another one needs")
{
    const test::TempFolder folder;
    const auto recovery = folder / "recovery";
    Document document = smallDocument();
    AudioReference sound;
    sound.hash = "0123456789abcdef";
    sound.embedded = std::make_shared<const std::string>("RIFF");
    REQUIRE(addSound(document, sound, {}, *document.clip(1)->clip));
    Autosave running(recovery);
    running.update(document.snapshot());
    running.flush();
    const auto left = recovery / "1-1-5e1.pacini-recovery";
    REQUIRE(writeRecovery(left, document.snapshot()));
    const auto found = listRecoverable(recovery);
    REQUIRE(found.size() == 1);
    CHECK(found[0].file == left);
    std::filesystem::remove(running.file()); // it is about to write the first one
    discardRecoverable(found[0]);
    CHECK(std::filesystem::exists(recovery / "0123456789abcdef.sound"));
    running.discard();
    CHECK(std::filesystem::is_empty(recovery));
}

#if !defined(_WIN32)
TEST_CASE("What a killed program has left is offered before its parent has noticed")
{
    const test::TempFolder folder;
    int pipeEnds[2];
    REQUIRE(pipe(pipeEnds) == 0);
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0)
    {
        Autosave autosave(folder / "recovery");
        autosave.update(smallDocument().snapshot());
        autosave.flush();
        const char done = 1;
        if (write(pipeEnds[1], &done, 1) != 1)
            _exit(1);
        for (;;)
            pause();
    }
    close(pipeEnds[1]);
    char done = 0;
    REQUIRE(read(pipeEnds[0], &done, 1) == 1);
    close(pipeEnds[0]);
    CHECK(listRecoverable(folder / "recovery").empty());
    kill(child, SIGKILL);
    siginfo_t ended = {};
    REQUIRE(waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT) == 0);
    CHECK(listRecoverable(folder / "recovery").size() == 1);
    waitpid(child, nullptr, 0);
}

TEST_CASE("A program killed at any time leaves a project that opens, with all but the last moments of work")
{
    const test::TempFolder folder;
    for (int round = 0; round < 12; ++round)
    {
        const auto recovery = folder / ("recovery" + std::to_string(round));
        int pipeEnds[2];
        REQUIRE(pipe(pipeEnds) == 0);
        const pid_t child = fork();
        REQUIRE(child >= 0);
        if (child == 0)
        {
            // Edits as fast as it can; tells how many it had made when each state was handed over.
            Document document;
            Clip clip = test::randomFullClip(1, 400);
            const int id = addClip(document, clip).value();
            Autosave autosave(recovery, std::chrono::milliseconds(1));
            for (int i = 1;; ++i)
            {
                clip.name = std::to_string(i);
                (void)document.commit("Edit", withClip(document.project(), id, clip));
                autosave.update(document.snapshot());
                if (i % 10 == 0)
                {
                    autosave.flush();
                    if (write(pipeEnds[1], &i, sizeof i) != sizeof i)
                        _exit(1);
                }
            }
        }
        close(pipeEnds[1]);
        int saved = 0;
        REQUIRE(read(pipeEnds[0], &saved, sizeof saved) == sizeof saved);
        std::this_thread::sleep_for(std::chrono::microseconds(3700 * round));
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        for (int more = 0; read(pipeEnds[0], &more, sizeof more) == sizeof more;)
            saved = more;
        close(pipeEnds[0]);

        const auto found = listRecoverable(recovery);
        REQUIRE(found.size() == 1);
        CHECK_FALSE(found[0].problem);
        auto document = Document::recover(found[0].file);
        REQUIRE(document);
        REQUIRE(document->project().clips.size() == 1);
        CHECK(std::stoi(document->clip(1)->clip->name) >= saved);
        discardRecoverable(found[0]);
        CHECK(std::filesystem::is_empty(recovery)); // no temporaries are left
    }
}
#endif
