// What only a POSIX system can show: full disks, limits, devices, kills.
#if !defined(_WIN32)

#include "io/AtomicFile.h"
#include "io/AudioFile.h"
#include "io/ClipFile.h"
#include "io/InputFile.h"
#include "support/Catch.h"
#include "support/Skip.h"
#include "support/TempFolder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <functional>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace fs = std::filesystem;

namespace
{
/// Runs `work` in a child process and returns what it returned. The child ends without the tests' clean-up.
int inChild(const std::function<int()>& work)
{
    const pid_t child = fork();
    if (child == 0)
        _exit(work());
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Lets this process write files of at most `bytes`; more is refused as on a full disk.
void limitFileSize(rlim_t bytes)
{
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
}

enum ChildOutcome
{
    failedCleanly = 10,
    succeeded = 11,
    wrongError = 12,
};

template <typename T>
int outcome(const Result<T>& result)
{
    if (result.ok())
        return succeeded;
    return result.error().code == ErrorCode::io && !result.error().message.empty() ? failedCleanly : wrongError;
}
} // namespace

TEST_CASE("A disk that fills up leaves the old file and no temporary", "[io]")
{
    const TempFolder folder;
    for (const char* name : {"text", "sound.wav", "sound.flac"})
        put(folder / name, "old");
    // Noise: FLAC must not make it small.
    std::vector<float> samples(200000);
    std::uint32_t state = 1;
    for (float& x : samples)
    {
        state = state * 1664525u + 1013904223u;
        x = static_cast<float>(state >> 8) / 8388608.0f - 1.0f;
    }
    AudioWriteParams params;
    CHECK(inChild(
              [&]
              {
                  limitFileSize(50000);
                  return outcome(writeFileAtomically(folder / "text", std::string(100000, 'x')));
              }) == failedCleanly);
    CHECK(inChild(
              [&]
              {
                  limitFileSize(50000);
                  return outcome(writeAudio(folder / "sound.wav", samples, params));
              }) == failedCleanly);
    params.encoding = SampleEncoding::pcm16;
    CHECK(inChild(
              [&]
              {
                  limitFileSize(50000);
                  return outcome(writeAudio(folder / "sound.flac", samples, params));
              }) == failedCleanly);
    // The last bytes leave the buffer only when the file is closed: that failure must be seen too.
    CHECK(inChild(
              [&]
              {
                  limitFileSize(100);
                  return outcome(writeFileAtomically(folder / "text", std::string(200, 'x')));
              }) == failedCleanly);
    CHECK(inChild(
              [&]
              {
                  limitFileSize(100);
                  return outcome(writeAudio(folder / "sound.wav", std::span(samples).first(300), {}));
              }) == failedCleanly);
    for (const char* name : {"text", "sound.wav", "sound.flac"})
        CHECK(bytesOf(folder / name) == "old");
    CHECK(folder.entries() == 3);
}

TEST_CASE("Devices are written to: a full one is reported, none is replaced", "[io]")
{
    if (!fs::is_character_file("/dev/full"))
    {
        test::skip("there is no /dev/full");
        return;
    }
    const auto full = writeFileAtomically("/dev/full", std::string_view("x"));
    REQUIRE_FALSE(full.ok());
    CHECK(full.error().message == "the disk is full; free some space and try again");
    CHECK(fs::is_character_file("/dev/full"));

    const auto clip = writeClip("/dev/full", Clip{}, jsonFormat());
    REQUIRE_FALSE(clip.ok());
    CHECK(clip.error().code == ErrorCode::diskFull);

    CHECK(writeFileAtomically("/dev/null", std::string(100000, 'x')).ok());
    CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("Endless devices are refused instead of read for ever, pipes are taken in and filled", "[io]")
{
    const auto endless = readWholeFile("/dev/zero", 1000000);
    REQUIRE_FALSE(endless.ok());
    CHECK(endless.error().code == ErrorCode::tooLarge);

    const auto device = AudioReader::open("/dev/zero");
    REQUIRE_FALSE(device.ok());
    CHECK(device.error().code == ErrorCode::io);

    const TempFolder folder;
    const auto pipe = (folder / "pipe.wav").string();
    REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
    const auto path = folder / "sound.wav";
    const std::vector<float> samples(1000, 0.25f);
    REQUIRE(writeAudio(path, samples, {}).ok());
    std::thread filling([&] { CHECK(writeAudio(pipe, samples, {}).ok()); });
    const auto bytes = bytesOf(pipe);
    filling.join();
    CHECK(bytes == bytesOf(path));
    std::thread feeding([&] { put(pipe, bytes); });
    const auto sound = readAudio(pipe);
    feeding.join();
    REQUIRE(sound.ok());
    CHECK(sound->samples == samples);
    CHECK(fs::is_fifo(pipe));
}

TEST_CASE("A folder without the right to write is reported", "[io]")
{
    // The system's own folder cannot be written even by the administrator.
    const auto system = writeFileAtomically("/proc/pacini-test", std::string_view("x"));
    if (fs::exists("/proc"))
    {
        REQUIRE_FALSE(system.ok());
        CHECK(system.error().code == ErrorCode::io);
    }
    const TempFolder folder;
    fs::permissions(folder.path(), fs::perms(0555));
    CHECK(inChild(
              [&]() -> int
              {
                  // The administrator may write everywhere: a user of no rights tries instead.
                  constexpr uid_t nobody = 65534;
                  if (geteuid() == 0 && setuid(nobody) != 0)
                      return succeeded;
                  const auto closed = writeFileAtomically(folder / "x", std::string_view("x"));
                  return !closed && closed.error().message ==
                                        "permission denied; check the permissions of the file and its folder"
                             ? failedCleanly
                             : wrongError;
              }) == failedCleanly);
}

TEST_CASE("What is written is never taken for left behind on its way into its place", "[io]")
{
    const TempFolder folder;
    REQUIRE(writeFileAtomically(folder / "clip.json", std::string_view("whole")).ok());
    std::atomic<bool> over = false;
    std::atomic<int> looks = 0, free = 0;
    // Looks at temporaries as another program does that clears up; one with content could be removed if it is not kept.
    std::thread other(
        [&]
        {
            while (!over)
            {
                std::error_code gone;
                for (fs::directory_iterator entry(folder.path(), gone); !gone && entry != fs::directory_iterator();
                     entry.increment(gone))
                {
                    if (entry->path().extension() != ".tmp")
                        continue;
                    const int file = ::open(entry->path().c_str(), O_RDWR | O_CLOEXEC);
                    struct stat status = {};
                    ++looks;
                    if (file >= 0 && ::flock(file, LOCK_EX | LOCK_NB) == 0 && ::fstat(file, &status) == 0 &&
                        status.st_nlink == 1 && status.st_size > 0 && fs::exists(entry->path(), gone))
                        ++free;
                    ::close(file);
                }
            }
        });
    int failed = 0;
    for (int i = 0; i < 5000 || (looks < 1000 && i < 500000); ++i)
        failed += writeFileAtomically(folder / "clip.json", std::string_view("whole")).ok() ? 0 : 1;
    over = true;
    other.join();
    CHECK(looks >= 1000);
    CHECK(free == 0);
    CHECK(failed == 0);
}

TEST_CASE("A program killed while it writes leaves the old file whole", "[io]")
{
    const TempFolder folder;
    put(folder / "sound.wav", "old");
    int ready[2] = {-1, -1};
    REQUIRE(pipe(ready) == 0);
    const pid_t child = fork();
    if (child == 0)
    {
        auto writer = AudioWriter::create(folder / "sound.wav", {});
        const std::vector<float> block(48000, 0.5f);
        for (int second = 0; writer.ok() && second < 20; ++second)
            if (!writer->write(block).ok())
                _exit(1);
        const char done = 'x';
        if (write(ready[1], &done, 1) != 1)
            _exit(1);
        pause();
        _exit(0);
    }
    char done = 0;
    REQUIRE(read(ready[0], &done, 1) == 1);
    REQUIRE(kill(child, SIGKILL) == 0);
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WIFSIGNALED(status));
    close(ready[0]);
    close(ready[1]);

    CHECK(bytesOf(folder / "sound.wav") == "old");
    REQUIRE(folder.entries() == 2);
    for (const auto& entry : fs::directory_iterator(folder.path()))
    {
        const auto name = entry.path().filename().string();
        CHECK((name == "sound.wav" || (name.starts_with(".sound.wav.pacini-") && name.ends_with(".tmp"))));
    }
    // A process looks into each folder once, and this one has done so: another clears up.
    CHECK(inChild(
              [&]
              {
                  const auto again = folder / "again";
                  fs::create_directory(again);
                  fs::rename(folder / "sound.wav", again / "sound.wav");
                  for (const auto& entry : fs::directory_iterator(folder.path()))
                      if (entry.path().extension() == ".tmp")
                          fs::rename(entry.path(), again / entry.path().filename());
                  return outcome(writeFileAtomically(again / "x", std::string_view("x")));
              }) == succeeded);
    CHECK(std::distance(fs::directory_iterator(folder / "again"), fs::directory_iterator()) == 2);
    REQUIRE(writeAudio(folder / "sound.wav", std::vector<float>(10, 0.25f), {}).ok());
    CHECK(readAudio(folder / "sound.wav")->samples == std::vector<float>(10, 0.25f));
}

#endif
