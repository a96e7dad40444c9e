#include "io/SweepFile.h"

#include "support/Catch.h"
#include "support/ChangedText.h"
#include "support/Refused.h"

#include <pacini/foundation/Random.h>

#include <string>

using namespace pacini;
using test::changed;

TEST_CASE("The description of a sweep comes back as it was written")
{
    Random random(11);
    for (int i = 0; i < 200; ++i)
    {
        SweepFile file;
        file.sweep.lowFrequency = random.uniform(1.0, 100.0);
        file.sweep.highFrequency = random.uniform(200.0, 2000.0);
        file.sweep.duration = random.uniform(0.5, 30.0);
        file.sweep.fadeIn = random.uniform(0.0, 0.1);
        file.sweep.fadeOut = random.uniform(0.0, 0.1);
        file.sweep.repeats = 1 + static_cast<int>(random.next() % 3);
        file.sweep.pause = random.uniform(0.2, 3.0);
        file.sweep.levels.clear();
        for (std::uint64_t k = random.next() % 4 + 1; k > 0; --k)
            file.sweep.levels.push_back(random.uniform(-80.0, 0.0));
        file.sweep.markerDuration = random.next() % 2 == 0 ? 0.0 : random.uniform(0.2, 5.0);
        file.sweep.sampleRate = 44100.0;
        if (random.next() % 2 == 0)
        {
            file.equalizedFor = "Ein \"Band\" \n";
            file.gain = random.uniform(0.0, 60.0);
        }
        REQUIRE(validate(file.sweep));
        const auto read = readSweepJson(sweepJson(file));
        REQUIRE(read);
        CHECK(*read == file);
    }
}

TEST_CASE("A description of a sweep with something missing or wrong is refused at its name")
{
    const std::string good = sweepJson({});
    REQUIRE(readSweepJson(good));
    const auto where = [](const std::string& text)
    {
        return test::refusedAt(readSweepJson(text));
    };
    for (const char* name : {"format", "version", "lowFrequency", "highFrequency", "duration", "fadeIn", "fadeOut",
                             "pause", "levels", "markerDuration", "sampleRate"})
        CHECK(where(changed(good, std::string("\"") + name + "\"", "\"other\"")) == name);
    CHECK(where(changed(good, "pacini.sweep", "pacini.profile")) == "format");
    CHECK(where(changed(good, "\"version\": 1", "\"version\": 2")) == "version");
    CHECK(where(changed(good, "[-10]", "[]")) == "levels");
    CHECK(where(changed(good, "[-10]", "[-10, \"x\"]")) == "levels[1]");
    CHECK(where(changed(good, "[-10]", "[-10, 3]")) == "levels[1]");
    CHECK(where(changed(good, "\"gain\": 0", "\"gain\": 201")) == "gain");
    CHECK(readSweepJson(changed(good, "\"gain\"", "\"other\""))); // written before there was one
    CHECK(where(changed(good, "\"repeats\": 1", "\"repeats\": 1.5")) == "repeats");
    CHECK(where(changed(good, "\"duration\": 20", "\"duration\": 1e300")) == "duration");
    CHECK(where("[]").empty());
    CHECK_FALSE(readSweepJson("{"));
}
