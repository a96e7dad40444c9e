#include "document/Autosave.h"

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
    (void)document.addClip("Add", clip);
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
    REQUIRE(document.addSound("Import", sound, {}, *document.clip(1)->clip));
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

#if !defined(_WIN32)
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
            const int id = document.addClip("Add", clip).value();
            Autosave autosave(recovery, std::chrono::milliseconds(1));
            for (int i = 1;; ++i)
            {
                clip.name = std::to_string(i);
                (void)document.setClip(id, "Edit", clip);
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
