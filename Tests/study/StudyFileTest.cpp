#include "study/StudyFile.h"

#include "study/StudyTemplates.h"
#include "support/Catch.h"
#include "support/ChangedText.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

using namespace pacini;
using namespace pacini::study;
using test::changed;

namespace
{
const std::vector<std::string> sounds{"sounds/a.wav", "sounds/b.wav", "sounds/a.wav", "c.wav"};
} // namespace

TEST_CASE("Every template is a study that comes back as it was written")
{
    for (const StudyTemplate& one : studyTemplates())
    {
        const auto made = makeStudy(one.name, one.mostSounds == 0 ? std::vector<std::string>() : sounds);
        INFO(one.name);
        REQUIRE(made);
        CHECK(validate(*made));
        ReadWarnings warnings;
        const auto read = readStudyJson(studyJson(*made), &warnings);
        REQUIRE(read);
        CHECK(*read == *made);
        CHECK(warnings.texts().empty());
        if (one.fewestSounds > 0)
            CHECK_FALSE(makeStudy(one.name, {}));
        // All that is given is presented, or nothing is made.
        for (std::size_t count = 1; count < 8; ++count)
        {
            std::vector<std::string> given;
            for (std::size_t i = 0; i < count; ++i)
                given.push_back(fmt::format("sounds/{}.wav", i));
            const auto from = makeStudy(one.name, given);
            INFO(count);
            if (from)
                for (const std::string& sound : given)
                    CHECK(std::any_of(from->stimuli.begin(), from->stimuli.end(),
                                      [&](const Stimulus& stimulus) { return stimulus.sound == sound; }));
            else
            {
                CHECK((count < one.fewestSounds || count < one.fewestOwn || count > one.mostSounds));
                CHECK(from.error().where == "sounds");
            }
        }
    }
    CHECK(makeStudy("nothing", sounds).error().where == "template");
}

TEST_CASE("What is wrong with a study is said where it is")
{
    const auto made = makeStudy("coherence", {"a.wav", "b.wav"});
    REQUIRE(made);
    const std::string good = studyJson(*made);
    for (const auto& [from, to, where] : std::vector<std::array<std::string, 3>>{
             {"\"version\": 1", "\"version\": 2", "version"},
             {"\"seed\": 1", "\"seed\": -1", "seed"},
             {"\"seed\": 1", "\"seed\": 1.5", "seed"},
             {"\"size\": 11", "\"size\": 0", "groups[0].size"},
             {"\"name\": \"B\"", "\"name\": \"A\"", "groups[1].name"},
             {"\"task\": \"words\"", "\"task\": \"singing\"", "blocks[0].task"},
             {"\"groups\": [\"A\"]", "\"groups\": [\"X\"]", "blocks[0].groups[0]"},
             {"\"groups\": [\"A\"]", "\"groups\": \"A\"", "blocks[0].groups"},
             {"\"replays\": -1", "\"replays\": -2", "blocks[0].replays"},
             {"\"delay\": 0", "\"delay\": 9", "blocks[0].delay"},
             {"\"name\": \"b\"", "\"name\": \"\"", "stimuli[1].name"},
             {"\"sound\": \"a.wav\"", "\"sound\": \"a.wav\", \"tone\": {}, \"silence\": 1", "stimuli[0]"},
             {"\"sound\": \"a.wav\"", "\"sound\": \"a.wav\", \"method\": \"magic\"", "stimuli[0].method"},
             {"\"sound\": \"a.wav\"", "\"sound\": \"a.wav\", \"bands\": 99", "stimuli[0].bands"},
             {"\"daily\": 2.5", "\"daily\": 50", "limits.daily"}})
    {
        const auto read = readStudyJson(changed(good, from, to));
        INFO(from << " -> " << to);
        REQUIRE_FALSE(read);
        CHECK(read.error().where == where);
        CHECK_FALSE(read.error().message.empty());
    }
    CHECK_FALSE(readStudyJson("[]"));
    CHECK_FALSE(readStudyJson("{"));
    CHECK_FALSE(readStudyJson(R"({"format": "pacini.clip", "version": 1})"));
}

TEST_CASE("A key that no study has is a warning that names the nearest")
{
    const auto made = makeStudy("words", {"a.wav"});
    REQUIRE(made);
    ReadWarnings warnings;
    REQUIRE(readStudyJson(changed(studyJson(*made), "\"replays\"", "\"replay\""), &warnings));
    REQUIRE(warnings.texts().size() == 1);
    CHECK(warnings.texts()[0].find("\"replays\"") != std::string::npos);
    ReadWarnings strict(true);
    CHECK_FALSE(readStudyJson(changed(studyJson(*made), "\"replays\"", "\"replay\""), &strict));
}

TEST_CASE("A comparison without its reference cannot be run")
{
    auto made = makeStudy("jnd", {});
    REQUIRE(made);
    made->blocks[1].reference.clear();
    const auto valid = validate(*made);
    REQUIRE_FALSE(valid);
    CHECK(valid.error().where == "blocks[1].reference");
}

TEST_CASE("A text is in the language that is asked for, else in English, else in any")
{
    const Text both{{"de", "Hallo"}, {"en", "Hello"}};
    CHECK(inLanguage(both, "de") == "Hallo");
    CHECK(inLanguage(both, "ja") == "Hello");
    CHECK(inLanguage({{"ja", "やあ"}}, "de") == "やあ");
    CHECK(inLanguage({}, "de").empty());
}
