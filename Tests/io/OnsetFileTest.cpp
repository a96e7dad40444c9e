#include "io/OnsetFile.h"

#include "support/Catch.h"
#include "support/TempFolder.h"

#include <string>
#include <vector>

using namespace pacini;
using namespace pacini::test;

namespace
{
const std::vector<double> twoTimes{0.12, 0.8};

std::string failureText(const std::string& text)
{
    const auto onsets = readOnsetText(text);
    REQUIRE_FALSE(onsets.ok());
    return onsets.error().text();
}
} // namespace

TEST_CASE("Onsets of several sounds are found by file name or by stem", "[io]")
{
    const auto onsets = readOnsetText(R"({"door.wav": [0.8, 0.12], "bell": [1], "still.wav": []})");
    REQUIRE(onsets.ok());
    CHECK(onsets->namesFiles);
    REQUIRE(onsets->find("some/folder/door.wav") != nullptr);
    CHECK(*onsets->find("some/folder/door.wav") == twoTimes);
    REQUIRE(onsets->find("bell.flac") != nullptr);
    CHECK(*onsets->find("bell.flac") == std::vector<double>{1.0});
    REQUIRE(onsets->find("still.wav") != nullptr);
    CHECK(onsets->find("still.wav")->empty());
    CHECK(onsets->find("window.wav") == nullptr);
}

TEST_CASE("A list or lines of times are the onsets of any sound", "[io]")
{
    for (const char* text :
         {"[0.12, 0.8]", " \n[ 0.8,0.12 ]\n", "0.12\n0.8\n",
          "0,120000\t0,130000\tknock\n\\\t100,5\t2000\n0,8\t0,9\t2 knocks\n", "0,12\n0,8\n",
          "0,12;0,13;knock\n0.8;0.9;knock", "0,12 knock\n+0,8 knock", "0.12,1,2\n.8,7,knock", "0,12\t0,13\n0.8\t0.9",
          "\xEF\xBB\xBF# by hand\r\n\r\n  0.8\r\n0.12", "0.120000\t0.130000\tknock\n8e-1,second\n"})
    {
        CAPTURE(text);
        const auto onsets = readOnsetText(text);
        REQUIRE(onsets.ok());
        CHECK_FALSE(onsets->namesFiles);
        REQUIRE(onsets->find("x.wav") != nullptr);
        CHECK(*onsets->find("x.wav") == twoTimes);
    }
    const auto none = readOnsetText("[]");
    REQUIRE(none.ok());
    CHECK(none->find("x.wav")->empty());
    for (const char* text : {"", " \n\r\n", "# by hand\n"})
        CHECK_FALSE(readOnsetText(text).ok());
}

TEST_CASE("Tables of audio editors and lines of every system are times", "[io]")
{
    for (const char* text :
         {"0.12\r0.8\r", "0.12\t0.13\tknock\r0.8\t0.9\t\r",                 // of an old Macintosh
          "#,Name,Start,End,Length\nM1,knock,0:00.120,,\nM2,,0:00.800,,\n", // REAPER
          "Name\tStart\tDuration\tTime Format\tType\tDescription\nMarker 01\t0:00.120\t0:00.000\tdecimal\tCue\t\n"
          "Marker 02\t0:00.800\t0:00.000\tdecimal\tCue\t\n", // Audition
          "\"time\",\"label\"\n\"0,12\",\"a, b\"\n\"0.8\",\"c\"\n", "time;label\n0,12;x\n0,8;y\n",
          "sep=;\r\ntime;label\r\n0,12;x\r\n0,8;y\r\n", "onset_time (s),label\n0.12,x\n0.8,y\n",
          "Label,Time\n1,0.12\n2,0.8", "0:00.12\n0:00:00.8"})
    {
        CAPTURE(text);
        const auto onsets = readOnsetText(text);
        REQUIRE(onsets.ok());
        CHECK(*onsets->find("x.wav") == twoTimes);
    }
    CHECK(*readOnsetText("1:02.5\n1:00:00")->find("x.wav") == std::vector<double>{62.5, 3600.0});
    CHECK(failureText("0:61") == "line 1: \"0:61\" is not a time in seconds, 0 or more");
    CHECK(failureText("Name,Start\nM1,1.1.00") == "line 2: \"1.1.00\" is not a time in seconds, 0 or more");
    CHECK(failureText("sep=,\nName,Start\nM1,x") == "line 3: \"x\" is not a time in seconds, 0 or more");
    CHECK(failureText("Name,Start\nM1") == "line 2: \"\" is not a time in seconds, 0 or more");
    CHECK(failureText("Name,Length\nM1,2") == "line 1: \"Name\" is not a time in seconds, 0 or more");

    const auto labels =
        readLabelText("#,Name,Start,End,Length\nR1,\"a, \"\"b\",0:01.000,0:02.500,0:01.500\nM2,,3.5,,\n");
    REQUIRE(labels);
    CHECK(labels->markers == std::vector<Marker>{{1.0, "a, \"b"}, {3.5, "2"}});
    CHECK(labels->warnings.size() == 1);
}

TEST_CASE("What is no list of times is refused at its place", "[io]")
{
    CHECK(failureText("{\"a.wav\": [0.1, -1]}") == "a.wav[1]: is -1; times are 0 or more, in seconds");
    CHECK(failureText("{\"a.wav\": 3}") == "a.wav: must be a list of times in seconds, such as [0.12, 0.8]");
    CHECK(failureText("{\"a.wav\": [\"0.1\"]}") == "a.wav[0]: must be a time in seconds");
    CHECK(failureText("[[0.1]]") == "[0]: must be a time in seconds");
    CHECK(failureText("[{}]") == "[0]: must be a time in seconds");
    CHECK(failureText("{\"a\": {\"b\": []}}") == "a: must be a list of times in seconds, such as [0.12, 0.8]");
    CHECK(failureText("{\"a\": [], \"a\": []}") == "a: is given twice");
    CHECK(failureText("0.1\n\n-2") == "line 3: \"-2\" is not a time in seconds, 0 or more");
    CHECK(failureText("0.1\nnan") == "line 2: \"nan\" is not a time in seconds, 0 or more");
    CHECK(failureText("0,5\n0,5,1,25") == "line 2: \"0,5,1,25\" is not a time in seconds, 0 or more");
    CHECK(failureText("0,5,knock") == "line 1: \"0,5,knock\" is not a time in seconds, 0 or more");
    CHECK(failureText("-0,5\tknock") == "line 1: \"-0.5\" is not a time in seconds, 0 or more");
    CHECK(failureText(std::string("0\0.\0005\0", 6)) == "line 1, column 1: is UTF-16 text; save it as UTF-8");
    CHECK(failureText("knock 0.1") == "line 1: \"knock\" is not a time in seconds, 0 or more");
    CHECK(failureText("0.1x") == "line 1: \"0.1x\" is not a time in seconds, 0 or more");
    CHECK_FALSE(readOnsetText("[0.1, 0.2").ok());
    CHECK_FALSE(readOnsetText("[1e999]").ok());
    CHECK(readOnsets("does-not-exist.json").error().code == ErrorCode::io);
}

TEST_CASE("Labels are markers by their names, in order; how long they last is told to be lost", "[io]")
{
    const auto read = [](const std::string& text)
    {
        const auto labels = readLabelText(text);
        REQUIRE(labels);
        return *labels;
    };
    const std::vector<Marker> two{{0.5, "hit"}, {1.25, "2 knocks, loud"}};
    CHECK(read("1.250000\t1.250000\t2 knocks, loud\n0.500000\t0.500000\thit\n").markers == two);
    CHECK(read("0,500000\t0,500000\thit\r\n\\\t100,5\t2000\r\n1,250000\t1,250000\t2 knocks, loud\r\n").markers == two);
    CHECK(read("# by hand\n0.5 hit\n\n1.25;2 knocks, loud").markers.front() == two.front());
    CHECK(read("0.5\t0.5\thit").warnings.empty());
    CHECK(read("0.5\t0.7\thit\n1\t2\t").markers == std::vector<Marker>{{0.5, "hit"}, {1.0, "2"}});
    CHECK(read("0.5\t0.7\thit\n1\t2\t").warnings ==
          std::vector<std::string>{"has labels of regions (2), whose starts are read as markers, but not how long they "
                                   "last"});
    CHECK(read("0.5\t0.5\t7").markers == std::vector<Marker>{{0.5, "7"}});
    CHECK(read("0.5\n0.5").markers == std::vector<Marker>{{0.5, "1"}, {0.5, "2"}});
    CHECK(read("0.5\t0.5\t\xFF").markers == std::vector<Marker>{{0.5, "\xC3\xBF"}});
    CHECK(read("").markers.empty());
    CHECK(readLabelText("soon\t1\thit").error().text() == "line 1: \"soon\" is not a time in seconds, 0 or more");
    CHECK_FALSE(readLabelText("[0.5]"));
    CHECK_FALSE(readLabelText("-1\t0\thit"));
    CHECK_FALSE(readLabels("missing.txt"));
}

TEST_CASE("Tracks of a cue sheet are markers by their titles", "[io]")
{
    const std::string sheet = "REM DATE 2026\r\nTITLE \"Album\"\r\nFILE \"long sound.wav\" WAVE\r\n"
                              "  TRACK 01 AUDIO\r\n    TITLE \"Door, shut\"\r\n    INDEX 01 00:00:00\r\n"
                              "  track 02 audio\n    index 00 00:02:00\n    index 01 00:02:37\n    INDEX 02 01:00:00\n";
    const auto read = readLabelText(sheet);
    REQUIRE(read);
    REQUIRE(read->markers.size() == 3);
    CHECK(read->markers[0] == Marker{0.0, "Door, shut"});
    CHECK(read->markers[1] == Marker{2.0 + 37.0 / 75.0, "02"});
    CHECK(read->markers[2] == Marker{60.0, "02 2"});
    CHECK(read->warnings.empty());
    const auto two = readLabelText(sheet + "FILE other.wav WAVE\n  TRACK 03 AUDIO\n    INDEX 01 00:00:00\n");
    REQUIRE(two);
    CHECK(two->markers == read->markers);
    CHECK(two->warnings == std::vector<std::string>{"names 2 sounds; the markers of the first are read, 1 of others "
                                                    "are left out"});
    for (const char* time : {"2:37", "00:02:x", "", "00:02:37:00", "-1:00:00"})
        CHECK(readLabelText("FILE a.wav WAVE\nTRACK 01 AUDIO\nINDEX 01 " + std::string(time)).error().where ==
              "line 3");
    CHECK(readLabelText("FILE").error().where == "line 1");
}

TEST_CASE("Labels that are no UTF-8 are read as those of western Europe", "[io]")
{
    const auto read = readLabelText("0.5\t0.5\tSchl\xE4ge\n1\t1\tT\xC3\xBCr\n2\t2\tT\xC3\xBCr\xE2\x82\n");
    REQUIRE(read.ok());
    REQUIRE(read->markers.size() == 3);
    CHECK(read->markers[0].name == "Schl\xC3\xA4ge");
    CHECK(read->markers[1].name == "T\xC3\xBCr");
    CHECK(read->markers[2].name == "T\xC3\xBCr"); // cut off within a character
    const auto sheet = readLabelText("FILE \"a.wav\" WAVE\n TRACK 01 AUDIO\n TITLE \"Stra\xDF"
                                     "e\"\n INDEX 01 00:01:00\n");
    REQUIRE(sheet.ok());
    REQUIRE(sheet->markers.size() == 1);
    CHECK(sheet->markers[0].name == "Stra\xC3\x9F"
                                    "e");
}
