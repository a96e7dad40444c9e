#include "io/ClipFile.h"

#include "io/formats/json/ClipJson.h"
#include "support/Catch.h"
#include "support/RandomClip.h"
#include "support/TempFolder.h"

#include <limits>
#include <string>

using namespace pacini;
using namespace pacini::test;

TEST_CASE("A clip file is recognised by its content, not by its name", "[io]")
{
    const TempFolder folder;
    const auto clip = randomFullClip(3);
    const auto size = writeClip(folder / "clip.wav", clip, jsonFormat());
    REQUIRE(size.ok());
    CHECK(*size == std::filesystem::file_size(folder / "clip.wav"));
    CHECK(bytesOf(folder / "clip.wav") == writeClipJson(clip));
    CHECK(readClip(folder / "clip.wav")->clip == clip);
    put(folder / "spaces.pacb", " \r\n\t" + writeClipJson(clip));
    CHECK(readClip(folder / "spaces.pacb")->clip == clip);
    CHECK(folder.entries() == 2);
}

TEST_CASE("A file of a format of ours is told by its first bytes, whatever its name", "[io]")
{
    const TempFolder folder;
    const auto clip = randomFullClip(4);
    std::size_t own = 0;
    for (const ClipFormat& format : clipFormats())
        if (format.isOwn())
        {
            CAPTURE(format.name);
            ++own;
            REQUIRE(writeClip(folder / "clip.wav", clip, format).ok());
            CHECK(ownFormatOf(folder / "clip.wav") == &format);
        }
    CHECK(own == 2);
    CHECK(ownFormatOf(put(folder / "cut.json", writeClipJson(clip).substr(0, 60))) == &jsonFormat());
    const auto foreign = clipFormatNamed("csv")->write(clip, {});
    REQUIRE(foreign.ok());
    CHECK(ownFormatOf(put(folder / "clip.json", foreign->files.at(0).bytes)) == nullptr);
    CHECK(ownFormatOf(put(folder / "sound.json", "RIFF....WAVEfmt ")) == nullptr);
    CHECK(ownFormatOf(put(folder / "empty.json", "")) == nullptr);
    CHECK(ownFormatOf(folder / "missing.json") == nullptr);
    CHECK(ownFormatOf(folder.path()) == nullptr);
}

TEST_CASE("Files that hold no clip are refused with one clear line", "[io]")
{
    const TempFolder folder;
    const auto failure = [&](const std::string& bytes)
    {
        const auto clip = readClip(put(folder / "x", bytes));
        REQUIRE_FALSE(clip.ok());
        return clip.error();
    };
    const auto noClip = "is not a clip: neither JSON nor packed; encode audio to get a clip";
    CHECK(failure("RIFF....WAVEfmt ").message == noClip);
    CHECK(failure("PAC").message == noClip);
    CHECK(failure("[]").message == noClip);
    CHECK(failure(" \n ").message == noClip);
    CHECK(failure("").message == "is empty; choose a file with a clip");
    CHECK(failure("\xEF\xBB\xBF{").where == "line 1, column 2"); // the mark is no character of the line
    CHECK(failure("{").where == "line 1, column 2");
    CHECK_FALSE(failure("PACB").message.empty());
    CHECK(readClip(folder / "missing").error().message == "does not exist; check the name and the folder");
    CHECK(readClip(folder.path()).error().code == ErrorCode::io);
}

TEST_CASE("A file in a format that is only written is named as that", "[io][formats]")
{
    const TempFolder folder;
    const auto clip = randomFullClip(3);
    for (const ClipFormat& format : clipFormats())
        if (format.isWritten() && !format.isRead() && format.extension != ".wav")
        {
            CAPTURE(format.name);
            const auto path = folder / ("clip" + std::string(format.extension));
            put(path, format.write(clip)->files.at(0).bytes);
            CHECK(looksLikeClip(path));
            const auto read = readClip(path);
            REQUIRE_FALSE(read.ok());
            CHECK(read.error().message == "is a file of format " + std::string(format.name) + " (" +
                                              std::string(format.title) + "), which Pacini writes but does not read");
        }
    put(folder / "other.h", "#pragma once");
    CHECK_FALSE(looksLikeClip(folder / "other.h"));
}

TEST_CASE("A file looks like a clip by the ending of a format that is read, or by how it begins", "[io][formats]")
{
    const TempFolder folder;
    for (const ClipFormat& format : clipFormats())
        if (format.isRead() && !format.isOwn())
        {
            CAPTURE(format.name);
            CHECK(looksLikeClip(put(folder / ("broken" + std::string(format.extension)), "neither here nor there")));
        }
    CHECK(looksLikeClip(put(folder / "clip.wav", writeClipJson(randomFullClip(3)))));
    CHECK_FALSE(looksLikeClip(put(folder / "sound.wav", "RIFF....WAVEfmt ")));
    CHECK_FALSE(looksLikeClip(folder / "missing.wav"));
}

TEST_CASE("A clip that breaks a rule is not written", "[io]")
{
    const TempFolder folder;
    put(folder / "clip.json", "old");
    auto clip = randomFullClip(4);
    clip.envelope = {{0.0, std::numeric_limits<double>::quiet_NaN()}};
    const auto notFinite = writeClip(folder / "clip.json", clip, jsonFormat());
    REQUIRE_FALSE(notFinite.ok());
    CHECK(notFinite.error().where == "envelope[0].amplitude");

    clip = randomFullClip(4);
    clip.encoder = {{"bands", 6.0}, {"bands", 7.0}};
    CHECK(writeClip(folder / "clip.json", clip, jsonFormat()).error().where == "encoder");
    clip.encoder = {{"bands", std::numeric_limits<double>::infinity()}};
    CHECK(writeClip(folder / "clip.json", clip, jsonFormat()).error().code == ErrorCode::notFinite);
    CHECK(bytesOf(folder / "clip.json") == "old");
    CHECK(folder.entries() == 1);
}
