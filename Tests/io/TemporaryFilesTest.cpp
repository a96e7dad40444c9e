#include "io/TemporaryFiles.h"

#include "support/Catch.h"
#include "support/TempFolder.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>

using namespace pacini;
using test::put;
using test::TempFolder;

namespace fs = std::filesystem;

namespace
{
/// A file that was last written to `hours` ago.
fs::path putOld(const fs::path& path, int hours)
{
    put(path, "x");
    fs::last_write_time(path, fs::file_time_type::clock::now() - std::chrono::hours(hours));
    return path;
}

/// The ending of temporaries that another computer makes: of its four digits the first is another one.
std::string endingElsewhere()
{
    std::string ending = temporaryEnding(7);
    char& digit = ending.at(std::string(".pacini-").size());
    digit = digit == '0' ? '1' : '0';
    return ending;
}
} // namespace

TEST_CASE("The ending of temporaries tells their number, in the same digits each time", "[io]")
{
    CHECK(temporaryEnding(7).size() == std::string(".pacini-XXXXXXXX.tmp").size());
    CHECK(temporaryEnding(7) == temporaryEnding(7));
    CHECK(temporaryEnding(7) != temporaryEnding(8));
    CHECK(temporaryEnding(0x7000) != temporaryEnding(0x8000));
    CHECK(temporaryEnding(1).substr(0, 12) == temporaryEnding(2).substr(0, 12)); // of this computer
}

TEST_CASE("Temporaries that were left behind are removed, other files of such names are not", "[io]")
{
    const TempFolder folder;
    put(folder / (".clip.json" + temporaryEnding(1)), "x");
    put(folder / (".x" + temporaryEnding(2)), "x");
    putOld(folder / (".y" + endingElsewhere()), 30);
    putOld(folder / ".z.pacini-0af9.tmp", 30); // of earlier versions
    const std::size_t stale = folder.entries();
    put(folder / (".new" + endingElsewhere()), "x"); // may be in use there
    putOld(folder / (".newer" + endingElsewhere()), 20);
    put(folder / ".new.pacini-0123.tmp", "x");
    for (const char* name :
         {".pacini-01234567.tmp", "..pacini-01234567.tmp", "x.pacini-01234567.tmp", ".x.pacini-01234567",
          ".x.pacini-01234567.bak", ".x.pacini-0123456.tmp", ".x.pacini-012345678.tmp", ".x.pacini-0123456g.tmp",
          ".x.pacini-0123456A.tmp", ".x.pacini-.tmp", ".x.tmp", ".01234567.tmp", ".x"})
        putOld(folder / name, 30);
    fs::create_directory(folder / (".folder" + temporaryEnding(3)));
    fs::create_symlink("missing", folder / (".link" + temporaryEnding(4)));
    fs::create_hard_link(folder / ".x", folder / (".twice" + temporaryEnding(5)));
    const std::size_t all = folder.entries();
    removeStaleTemporaries(folder.path());
    CHECK(folder.entries() == all - stale);
    CHECK_FALSE(fs::exists(folder / (".clip.json" + temporaryEnding(1))));
    CHECK_FALSE(fs::exists(folder / (".x" + temporaryEnding(2))));
    CHECK_FALSE(fs::exists(folder / (".y" + endingElsewhere())));
    CHECK_FALSE(fs::exists(folder / ".z.pacini-0af9.tmp"));

    put(folder / (".later" + temporaryEnding(6)), "x"); // each folder is looked at once
    removeStaleTemporaries(folder.path());
    CHECK(fs::exists(folder / (".later" + temporaryEnding(6))));
}

TEST_CASE("A temporary that is kept stays until it is closed", "[io]")
{
    const TempFolder folder;
    const fs::path path = folder / (".clip.json" + temporaryEnding(1));
    std::FILE* file = std::fopen(path.string().c_str(), "wb");
    REQUIRE(file != nullptr);
    CHECK(keepTemporary(file));
    removeStaleTemporaries(folder.path());
    CHECK(fs::exists(path));
    std::fclose(file);
}

TEST_CASE("A temporary that is marked stays although its stream is closed", "[io]")
{
    const TempFolder folder;
    const fs::path path = folder / (".clip.json" + temporaryEnding(1));
    std::FILE* file = std::fopen(path.string().c_str(), "wb");
    REQUIRE(file != nullptr);
    CHECK(keepTemporary(file));
    const TemporaryMark mark(file);
    std::fclose(file);
    removeStaleTemporaries(folder.path());
#if !defined(_WIN32)
    CHECK(fs::exists(path));
#endif
}
