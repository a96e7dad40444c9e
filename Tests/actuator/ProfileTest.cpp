#include "io/ProfileFile.h"
#include "support/BlockContract.h"
#include "support/Catch.h"
#include "support/Golden.h"
#include "support/Paths.h"

#include <pacini/actuator/Profile.h>

using namespace pacini;

TEST_CASE("The wristband profile's equaliser is that of the thesis' Table 3.2", "[actuator][golden]")
{
    const auto profile = readProfile(sourceFolder() / "profiles/l5-wristband.json");
    REQUIRE(profile.ok());
    const auto golden = test::golden("eq_table_3_2");
    int compared = 0;
    for (const auto& c : golden["cases"])
    {
        if (c["filters"] != nlohmann::json::array({2, 3, 4}))
            continue;
        const double fs = c["fs"].get<double>();
        const auto equalizer = designEqualizer(profile->equalizer, fs);
        for (std::size_t i = 0; i < golden["freqs"].size(); ++i, ++compared)
        {
            const double level =
                20.0 * std::log10(std::abs(equalizer.response(Hertz(golden["freqs"][i].get<double>()), fs)));
            CHECK(level == Approx(c["db"][i].get<double>()).margin(1e-4));
        }
    }
    CHECK(compared == 400);
}

TEST_CASE("An equaliser keeps the block contract", "[actuator]")
{
    test::checkBlockContract<Equalizer>(
        {{EqualizerType::peak, 68.0, -10.0, 1.6, 2}, {EqualizerType::highpass, 20.0, 0.0, 1.0, 5}});
}

TEST_CASE("A broken profile fails at the right place", "[actuator]")
{
    const auto where = [](const std::string& text)
    {
        const auto profile = readProfileJson(text);
        REQUIRE_FALSE(profile.ok());
        return profile.error().where;
    };
    const std::string head = R"({"format":"pacini.profile","version":1,"name":"x","technology":"pcm",)";
    CHECK(where("[]").empty());
    CHECK(where("{") == "line 1, column 2");
    CHECK(where(std::string(1000, '[')) == "line 1, column 33");
    CHECK(where(R"({"format":"other","version":1})") == "format");
    CHECK(where(R"({"format":"pacini.profile","version":2})") == "version");
    CHECK(where(R"({"format":"pacini.profile","version":1})") == "name");
    CHECK(where(head + R"("resonance":3})") == "resonance");
    CHECK(where(head + R"("resonance":{"frequency":"x"}})") == "resonance.frequency");
    CHECK(where(head + R"("resonance":{"frequency":-1}})") == "resonance.frequency");
    CHECK(
        where(
            head +
            R"("resonance":{"frequency":50},"equalizer":[{"type":"peak","frequency":5,"gain":1},{"type":"dip","frequency":5,"gain":1}]})") ==
        "equalizer[1].type");
    CHECK(where(head + R"("resonance":{"frequency":50},"equalizer":[{"type":"peak","frequency":5,"gain":99}]})") ==
          "equalizer[0].gain");
    CHECK(where(head + R"("resonance":{"frequency":50},"equalizer":[{"type":"highpass","frequency":5,"order":9}]})") ==
          "equalizer[0].order");
    CHECK(where(head + R"("resonance":{"frequency":50},"equalizer":[7]})") == "equalizer[0]");
}
