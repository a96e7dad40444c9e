#include "io/AtomicFile.h"

#include "io/InputFile.h"
#include "support/Catch.h"
#include "support/TempFolder.h"

#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace fs = std::filesystem;

namespace
{
const std::string& message(const Error& error)
{
    return error.message;
}
} // namespace

TEST_CASE("A file written atomically holds exactly the bytes and leaves nothing beside it", "[io]")
{
    const TempFolder folder;
    std::string bytes;
    for (int i = 0; i < 300000; ++i)
        bytes += static_cast<char>(i * 7);
    const auto written = writeFileAtomically(folder / "data", bytes);
    REQUIRE(written.ok());
    CHECK(*written == bytes.size());
    CHECK(bytesOf(folder / "data") == bytes);
    CHECK(folder.entries() == 1);

    REQUIRE(writeFileAtomically(folder / "data", std::string_view("new")).ok());
    CHECK(bytesOf(folder / "data") == "new");
    REQUIRE(writeFileAtomically(folder / "empty", std::string_view()).ok());
    CHECK(fs::file_size(folder / "empty") == 0);
    CHECK(folder.entries() == 2);
}

TEST_CASE("Until commit the target is untouched and the temporary has a recognisable name", "[io]")
{
    const TempFolder folder;
    put(folder / "clip.json", "old");
    {
        auto file = AtomicFile::create(folder / "clip.json");
        REQUIRE(file.ok());
        REQUIRE(file->write(std::as_bytes(std::span<const char>(std::string_view("new")))));
        CHECK(bytesOf(folder / "clip.json") == "old");
        REQUIRE(folder.entries() == 2);
        for (const auto& entry : fs::directory_iterator(folder.path()))
        {
            const auto name = entry.path().filename().string();
            if (name == "clip.json")
                continue;
            CAPTURE(name);
            CHECK(name.starts_with(".clip.json.pacini-"));
            CHECK(name.ends_with(".tmp"));
            CHECK(name.size() == std::string(".clip.json.pacini-XXXXXXXX.tmp").size());
        }
    }
    CHECK(bytesOf(folder / "clip.json") == "old");
    CHECK(folder.entries() == 1);
}

TEST_CASE("A file that is to be kept is kept, also one that appears while ours is written", "[io]")
{
    const TempFolder folder;
    put(folder / "old", "old");
    CHECK_FALSE(writeFileAtomically(folder / "old", std::string_view("new"), Existing::keep).ok());
    CHECK(bytesOf(folder / "old") == "old");

    auto file = AtomicFile::create(folder / "x", Existing::keep);
    REQUIRE(file.ok());
    file->write(std::as_bytes(std::span<const char>(std::string_view("ours"))));
    put(folder / "x", "theirs");
    const auto done = file->commit();
    REQUIRE_FALSE(done.ok());
    CHECK(message(done.error()) == "was created meanwhile and was kept; choose another name");
    CHECK(bytesOf(folder / "x") == "theirs");

    REQUIRE(writeFileAtomically(folder / "y", std::string_view("ours"), Existing::keep).ok());
    CHECK(bytesOf(folder / "y") == "ours");
    CHECK(folder.entries() == 3);
}

TEST_CASE("A name of the longest length can be written", "[io]")
{
    const TempFolder folder;
    const std::string longest(255, 'n');
    REQUIRE(writeFileAtomically(folder / longest, std::string_view("x")).ok());
    CHECK(bytesOf(folder / longest) == "x");
    CHECK(folder.entries() == 1);
    CHECK_FALSE(writeFileAtomically(folder / (longest + "n"), std::string_view("x")).ok());
    CHECK(folder.entries() == 1);
}

TEST_CASE("Replacing a file keeps its permissions and follows links", "[io]")
{
    const TempFolder folder;
    put(folder / "real", "old");
    fs::permissions(folder / "real", fs::perms(0640));
    fs::create_symlink("real", folder / "link");
    REQUIRE(writeFileAtomically(folder / "link", std::string_view("new")).ok());
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(bytesOf(folder / "real") == "new");
    CHECK(fs::status(folder / "real").permissions() == fs::perms(0640));
}

TEST_CASE("Places that cannot be written are named in plain words and left as they are", "[io]")
{
    const TempFolder folder;
    put(folder / "file", "old");
    const std::string_view text = "new";

    const auto noFolder = writeFileAtomically(folder / "no/such/file", text);
    REQUIRE_FALSE(noFolder.ok());
    CHECK(noFolder.error().code == ErrorCode::io);
    CHECK(message(noFolder.error()) == "its folder does not exist; create the folder first");

    const auto belowFile = writeFileAtomically(folder / "file/below", text);
    REQUIRE_FALSE(belowFile.ok());
    CHECK(message(belowFile.error()) == "a part of the path is not a folder; check the path");

    const auto isFolder = writeFileAtomically(folder.path(), text);
    REQUIRE_FALSE(isFolder.ok());
    CHECK(message(isFolder.error()) == "is a folder; give the name of a file");

    for (const auto& none : {fs::path(), folder.path() / ""})
    {
        const auto noName = writeFileAtomically(none, text);
        REQUIRE_FALSE(noName.ok());
        CHECK(noName.error().code == ErrorCode::invalidArgument);
    }

    fs::permissions(folder / "file", fs::perms(0444));
    const auto readOnly = writeFileAtomically(folder / "file", text);
    REQUIRE_FALSE(readOnly.ok());
    CHECK(message(readOnly.error()) == "is marked read-only; choose another name or make it writable");
    CHECK(bytesOf(folder / "file") == "old");
    CHECK(folder.entries() == 1);
}

TEST_CASE("Reading whole files stops at the limit and explains what is wrong", "[io]")
{
    const TempFolder folder;
    const std::string text = "0123456789";
    put(folder / "ten", text);
    put(folder / "empty", "");
    CHECK(*readWholeFile(folder / "ten", 10) == text);
    CHECK(*readWholeFile(folder / "ten", 1000) == text);
    CHECK(readWholeFile(folder / "empty", 0)->empty());

    const auto tooLong = readWholeFile(folder / "ten", 9);
    REQUIRE_FALSE(tooLong.ok());
    CHECK(tooLong.error().code == ErrorCode::tooLarge);

    const auto missing = readWholeFile(folder / "missing", 10);
    REQUIRE_FALSE(missing.ok());
    CHECK(missing.error().code == ErrorCode::io);
    CHECK(message(missing.error()) == "does not exist; check the name and the folder");

    const auto isFolder = readWholeFile(folder.path(), 10);
    REQUIRE_FALSE(isFolder.ok());
    CHECK(message(isFolder.error()) == "is a folder; give the name of a file");

    CHECK(readWholeFile(fs::path(), 10).error().code == ErrorCode::invalidArgument);

    std::string big(1000000, 'x');
    big[777777] = 'y';
    put(folder / "big", big);
    CHECK(*readWholeFile(folder / "big", big.size()) == big);
}
